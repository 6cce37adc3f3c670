#include "geometry/meridian.hpp"
#include <algorithm>
#include <cmath>
#include <gsl/gsl_bspline.h>
#include <gsl/gsl_errno.h>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace capsule {
namespace {

using std::numbers::pi;

void require(bool condition, const char *what) {
  if (!condition) {
    throw std::invalid_argument(what);
  }
}

// ---- Spectral basis ----

// Legendre polynomial P_n(cos zeta) and its derivative in zeta, 0 < zeta <= pi/2. The recurrence runs on the
// differences P_(l+1) - P_l and on 1 - cos(zeta), whose digits the angle keeps near the pole.
struct Legendre {
  double value, slope;
};
Legendre legendre(int n, double zeta) {
  const double sine_of_half = std::sin(0.5 * zeta);
  const double depth = 2 * sine_of_half * sine_of_half;
  double value = 1, step = -depth;
  for (int l = 1; l < n; ++l) {
    value += step;
    step = (l * step - (2 * l + 1) * depth * value) / (l + 1);
  }
  value += step;
  return {value, n * (step - depth * value) / std::sin(zeta)};
}

// Nodes and weights of Gauss's rule in the angle: the weights of the integral over cos(zeta) are
// 2/(dP_n/dzeta)^2. Tricomi's estimate is close enough for Newton's method to end in five steps.
void set_gauss_legendre(int n, MeridianBasis &basis) {
  basis.nodes.resize(n);
  basis.weights.resize(n);
  for (int j = 0; j < (n + 1) / 2; ++j) {
    double zeta = pi * (j + 0.75) / (n + 0.5);
    for (int step = 0; step < 5; ++step) {
      const Legendre p = legendre(n, zeta);
      zeta -= p.value / p.slope;
    }
    const double slope = legendre(n, zeta).slope;
    basis.nodes(n - 1 - j) = pi - zeta;
    basis.nodes(j) = zeta;
    basis.weights(j) = basis.weights(n - 1 - j) = 2 / (slope * slope * std::sin(zeta));
  }
}

// cos(k zeta) and sin(k zeta) of some points: each wave follows from the one before by a turn by zeta. The error of k turns
// is that of rounding k zeta.
template <class Array>
struct Turning {
  Array turn_c, turn_s, c, s, turned;
  explicit Turning(const Array &zeta)
      : turn_c(zeta.cos()), turn_s(zeta.sin()), c(Array::Ones(zeta.size())), s(Array::Zero(zeta.size())),
        turned(zeta.size()) {}
  void turn() {
    turned = c * turn_c - s * turn_s;
    s = s * turn_c + c * turn_s;
    c = turned;
  }
};

// Eight points at a time: sums of their waves stay in registers.
constexpr Eigen::Index together = 8;
using Block = Eigen::Array<double, together, 1>;

// Applies `use(first point, number of them, their waves with k = 0)`.
template <class Use>
void for_each_block(const Vector &points, const Use &use) {
  for (Eigen::Index begin = 0; begin < points.size(); begin += together) {
    const Eigen::Index size = std::min(together, points.size() - begin);
    Block zeta = Block::Zero();
    zeta.head(size) = points.segment(begin, size);
    use(begin, size, Turning<Block>(zeta));
  }
}

// cos(k zeta), or sin(k zeta), k = first, first + 1 ...
Matrix waves(bool cosine, const Vector &points, Eigen::Index first, Eigen::Index count) {
  Matrix values(points.size(), count);
  Turning<Eigen::ArrayXd> turning(points.array());
  for (Eigen::Index k = 0; k < first + count; ++k) {
    if (k >= first)
      values.col(k - first) = cosine ? turning.c : turning.s;
    turning.turn();
  }
  return values;
}

// Their series.
Vector series(bool cosine, const Vector &points, Eigen::Index first, const Vector &coefficients) {
  Vector values(points.size());
  for_each_block(points, [&](Eigen::Index begin, Eigen::Index size, Turning<Block> turning) {
    Block sum = Block::Zero();
    for (Eigen::Index k = 0; k < first; ++k)
      turning.turn();
    for (const double coefficient : coefficients) {
      sum += coefficient * (cosine ? turning.c : turning.s);
      turning.turn();
    }
    values.segment(begin, size) = sum.head(size);
  });
  return values;
}

// A derivative of cos(k zeta) where quarter_turns is 0, of sin(k zeta) where it is -1, k = first, first + 1 ...: factors times
// cosines or sines.
struct DifferentiatedWaves {
  bool cosine;
  Vector factors;
  DifferentiatedWaves(Eigen::Index count, Eigen::Index first, int quarter_turns, int derivative) {
    const int turn = (quarter_turns + derivative + 4) % 4;
    cosine = turn % 2 == 0;
    const auto k =
        Eigen::ArrayXd::LinSpaced(count, static_cast<double>(first), static_cast<double>(first + count - 1));
    factors = (turn == 1 || turn == 2 ? -1 : 1) * k.pow(derivative);
  }
};

// ---- Cubic splines ----

constexpr int degree = 3;

struct FreeBspline {
  void operator()(gsl_bspline_workspace *workspace) const { gsl_bspline_free(workspace); }
};
using Bspline = std::unique_ptr<gsl_bspline_workspace, FreeBspline>;

void check(int gsl_status) {
  require(gsl_status == GSL_SUCCESS, gsl_strerror(gsl_status));
}

// B-splines with simple knots at the nodes. The one place where GSL is prevented from ending the program: its
// return codes are checked instead.
Bspline bspline(const Vector &nodes) {
  gsl_set_error_handler_off();
  Bspline workspace(gsl_bspline_alloc(degree + 1, nodes.size()));
  const auto breakpoints = gsl_vector_const_view_array(nodes.data(), nodes.size());
  check(gsl_bspline_knots(&breakpoints.vector, workspace.get()));
  return workspace;
}

// The few B-splines that do not vanish at a point: a row per B-spline, a column per derivative.
struct LocalBsplines {
  Eigen::Index first;
  RowMatrix values;
};
LocalBsplines local_bsplines(gsl_bspline_workspace *workspace, double point, int derivative) {
  LocalBsplines local{0, RowMatrix(gsl_bspline_order(workspace), derivative + 1)};
  auto values = gsl_matrix_view_array(local.values.data(), local.values.rows(), local.values.cols());
  std::size_t first = 0, last = 0;
  check(gsl_bspline_deriv_eval_nonzero(point, derivative, &values.matrix, &first, &last, workspace));
  local.first = static_cast<Eigen::Index>(first);
  return local;
}

Matrix spline_values(const Vector &nodes, const Matrix &coefficients, const Vector &points, int derivative) {
  const Bspline workspace = bspline(nodes);
  Matrix values(points.size(), coefficients.cols());
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    require(points(i) >= nodes(0) && points(i) <= nodes(nodes.size() - 1), "a point outside of the spline");
    const auto [first, local] = local_bsplines(workspace.get(), points(i), derivative);
    values.row(i).noalias() =
        local.col(derivative).transpose() * coefficients.middleRows(first, local.rows());
  }
  return values;
}

// B-spline coefficients from the nodal values and a derivative at both ends, which vanishes. It is scaled with the
// element next to the end: the matrix to be inverted is then free of units.
Matrix spline_coefficients(const Vector &nodes, int end_derivative) {
  const Eigen::Index n = nodes.size(), size = n + degree - 1;
  require((nodes.tail(n - 1) - nodes.head(n - 1)).minCoeff() > 0, "the nodes of a spline must ascend");
  const Bspline workspace = bspline(nodes);
  Matrix conditions = Matrix::Zero(size, size);
  Vector scale = Vector::Ones(size);
  Eigen::Index row = 0;
  const auto add = [&](double point, int derivative, double element) {
    const auto [first, local] = local_bsplines(workspace.get(), point, derivative);
    scale(row) = std::pow(element, derivative);
    conditions.row(row).segment(first, local.rows()) = scale(row) * local.col(derivative).transpose();
    ++row;
  };
  for (const double node : nodes) {
    add(node, 0, 1);
  }
  add(nodes(0), end_derivative, nodes(1) - nodes(0));
  add(nodes(n - 1), end_derivative, nodes(n - 1) - nodes(n - 2));
  return (lu_inverse(conditions) * scale.asDiagonal()).leftCols(n);
}

// The integral of a B-spline is its support over its order.
Vector bspline_integrals(const Vector &nodes) {
  const Eigen::Index last = nodes.size() - 1;
  Vector integrals(nodes.size() + degree - 1);
  for (Eigen::Index i = 0; i < integrals.size(); ++i) {
    integrals(i) =
        (nodes(std::min(i + 1, last)) - nodes(std::max<Eigen::Index>(i - degree, 0))) / (degree + 1);
  }
  return integrals;
}

} // namespace

Vector cosine_series(const Vector &coefficients, const Vector &points) {
  return series(true, points, 0, coefficients);
}

Vector sine_series(const Vector &coefficients, const Vector &points) {
  return series(false, points, 1, coefficients);
}

Vector cosine_moments(const Vector &values, const Vector &points, Eigen::Index count) {
  Eigen::Array<double, together, Eigen::Dynamic> sums = decltype(sums)::Zero(together, count);
  for_each_block(points, [&](Eigen::Index begin, Eigen::Index size, Turning<Block> turning) {
    Block here = Block::Zero();
    here.head(size) = values.segment(begin, size);
    for (Eigen::Index k = 0; k < count; ++k) {
      sums.col(k) += here * turning.c;
      turning.turn();
    }
  });
  return sums.colwise().sum();
}

MeridianBasis spectral_basis(int nodes) {
  require(nodes >= 3, "a spectral basis needs three nodes");
  MeridianBasis basis;
  set_gauss_legendre(nodes, basis);
  // Both matrices are as well conditioned as those of the cosine and sine transforms, whose nodes are close
  // by.
  basis.even_from_nodes = lu_inverse(waves(true, basis.nodes, 0, nodes));
  basis.odd_from_nodes = lu_inverse(waves(false, basis.nodes, 1, nodes));
  return basis;
}

MeridianBasis spline_basis(int elements) {
  require(elements >= degree, "a spline needs as many elements as its degree");
  MeridianBasis basis;
  basis.spline = true;
  basis.nodes = Vector::LinSpaced(elements + 1, 0, pi);
  basis.even_from_nodes = spline_coefficients(basis.nodes, 1);
  basis.odd_from_nodes = spline_coefficients(basis.nodes, 2);
  basis.weights = basis.odd_from_nodes.transpose() * bspline_integrals(basis.nodes);
  return basis;
}

Matrix MeridianBasis::even(const Vector &points, int derivative) const {
  if (spline)
    return spline_values(nodes, even_from_nodes, points, derivative);
  const DifferentiatedWaves of(size(), 0, 0, derivative);
  return waves(of.cosine, points, 0, size()) * of.factors.asDiagonal() * even_from_nodes;
}

Matrix MeridianBasis::odd(const Vector &points, int derivative) const {
  if (spline)
    return spline_values(nodes, odd_from_nodes, points, derivative);
  const DifferentiatedWaves of(size(), 1, -1, derivative);
  return waves(of.cosine, points, 1, size()) * of.factors.asDiagonal() * odd_from_nodes;
}

Vector MeridianBasis::even(const Vector &points, int derivative, const Vector &at_nodes) const {
  if (spline)
    return even(points, derivative) * at_nodes;
  const DifferentiatedWaves of(size(), 0, 0, derivative);
  return series(of.cosine, points, 0, of.factors.cwiseProduct(even_from_nodes * at_nodes));
}

Vector MeridianBasis::odd(const Vector &points, int derivative, const Vector &at_nodes) const {
  if (spline)
    return odd(points, derivative) * at_nodes;
  const DifferentiatedWaves of(size(), 1, -1, derivative);
  return series(of.cosine, points, 1, of.factors.cwiseProduct(odd_from_nodes * at_nodes));
}

Meridian::Meridian(const MeridianBasis &basis, const Vector &position)
    : basis_(&basis), x_(basis.even_from_nodes * position.head(basis.size())),
      r_(basis.odd_from_nodes * position.tail(basis.size())) {}

Meridian::Points Meridian::at(const Vector &zeta) const {
  if (basis_->spline) {
    const auto x = [&](int derivative) { return spline_values(basis_->nodes, x_, zeta, derivative); };
    return {x(0), x(1), x(2), spline_values(basis_->nodes, r_, zeta, 0)};
  }
  const Eigen::Index n = basis_->size();
  Points points{Vector(zeta.size()), Vector(zeta.size()), Vector(zeta.size()), Vector(zeta.size())};
  for_each_block(zeta, [&](Eigen::Index begin, Eigen::Index size, Turning<Block> turning) {
    Block x = Block::Constant(x_[0]), x_1 = Block::Zero(), x_2 = Block::Zero(), r = Block::Zero();
    for (Eigen::Index k = 1; k <= n; ++k) {
      turning.turn();
      r += r_[k - 1] * turning.s;
      if (k == n)
        break;
      const auto wave = static_cast<double>(k);
      x += x_[k] * turning.c;
      x_1 -= wave * x_[k] * turning.s;
      x_2 -= wave * wave * x_[k] * turning.c;
    }
    points.x.segment(begin, size) = x.head(size);
    points.x_1.segment(begin, size) = x_1.head(size);
    points.x_2.segment(begin, size) = x_2.head(size);
    points.r.segment(begin, size) = r.head(size);
  });
  return points;
}

} // namespace capsule
