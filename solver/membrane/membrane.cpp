#include "membrane/membrane.hpp"
#include "geometry/reference_shape.hpp"
#include <cmath>
#include <complex>
#include <numbers>

namespace capsule {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

// What the energy density at one point depends on, in this order: x', x'', r, r', r''.
enum Local { x1, x2, r0, r1, r2, local_size };
using LocalVector = Eigen::Matrix<double, local_size, 1>;
using LocalMatrix = Eigen::Matrix<double, local_size, local_size>;
using LocalShapes = Eigen::Matrix<double, local_size, Eigen::Dynamic>; // a column per point

// The matrix that takes nodal values to a local variable at all points.
const BasisMatrix &matrix_of(const Sampling &at, int local) {
  return local <= x2 ? at.even[local + 1] : at.odd[local - r0];
}

LocalShapes local_shapes(const Sampling &at, const Vector &position) {
  const Eigen::Index n = position.size() / 2;
  LocalShapes shapes(static_cast<int>(local_size), at.zeta.size());
  for (int i = 0; i <= x2; ++i)
    shapes.row(i) = at.even[i + 1] * position.head(n);
  for (int i = r0; i <= r2; ++i)
    shapes.row(i) = at.odd[i - r0] * position.tail(n);
  return shapes;
}

// The tangent as a complex number, z = x' + i r' = g exp(i alpha). Its logarithm is analytic, so derivatives
// with respect to x', r', x'' and r'' are real and imaginary parts of powers of 1/z. The curve bends by
// kappa_s g = -alpha' = -Im(z'/z).
struct Tangent {
  double g;                     // ds/dzeta
  double t_x, t_r;              // unit vector
  std::complex<double> inverse; // 1/z
  std::complex<double> turning; // z'/z
};
Tangent tangent_of(const LocalVector &shape) {
  const double g = std::sqrt(shape(x1) * shape(x1) + shape(r1) * shape(r1));
  const double t_x = shape(x1) / g, t_r = shape(r1) / g;
  const std::complex<double> inverse(t_x / g, -t_r / g);
  return {g, t_x, t_r, inverse, std::complex<double>(shape(x2), shape(r2)) * inverse};
}

// Stretches lambda and bends lambda kappa.
struct Strain {
  double stretch_meridional, stretch_azimuthal;
  double bend_meridional, bend_azimuthal;
};
// radius and arc are R and S' of the undeformed shape.
Strain strain_of(const LocalVector &shape, const Tangent &tangent, double radius, double arc) {
  return {tangent.g / arc, shape(r0) / radius, -tangent.turning.imag() / arc, tangent.t_x / radius};
}
// At a pole the strain is the same in all directions. Closer to it than this, 0/0 is less accurate than the
// limit.
bool is_pole(double zeta) {
  return std::sin(zeta) < 1e-6;
}
Strain isotropic(const Strain &strain) {
  return {strain.stretch_meridional, strain.stretch_meridional, strain.bend_meridional,
          strain.bend_meridional};
}

// How the bends and their couples, lambda_phi M_s and lambda_s M_phi, depend on each other (eq. 6).
Eigen::Matrix2d bending_stiffness(const Membrane &membrane) {
  const double poisson_ratio = membrane.law.poisson_ratio();
  return membrane.bending_ratio * Eigen::Matrix2d{{1, poisson_ratio}, {poisson_ratio, 1}};
}

// Energy per reference area and its derivatives with respect to the strain.
struct Elasticity {
  double energy;
  StrainEnergy in_plane;
  double couple_meridional, couple_azimuthal; // with respect to the bends
};
Elasticity elasticity(const Membrane &membrane, const Strain &strain, double bend0_meridional,
                      double bend0_azimuthal) {
  const StrainEnergy in_plane =
      strain_energy(membrane.law, strain.stretch_meridional, strain.stretch_azimuthal);
  const Eigen::Vector2d bending(strain.bend_meridional - bend0_meridional,
                                strain.bend_azimuthal - bend0_azimuthal);
  const Eigen::Vector2d couple = bending_stiffness(membrane) * bending;
  return {in_plane.w + 0.5 * couple.dot(bending), in_plane, couple(0), couple(1)};
}

// One point of the energy's quadrature.
struct Point {
  double radius, arc;    // R and S'
  double reference_area; // that the point stands for
  Tangent tangent;
  Elasticity stress;
};
// Calls use(i, point) for each of them.
template <class Use>
void at_each_point(const Membrane &membrane, const Vector &position, Use &&use) {
  const LocalShapes shapes = local_shapes(membrane.sampling, position);
  const UndeformedMeridian &undeformed = membrane.undeformed;
  for (Eigen::Index i = 0; i < shapes.cols(); ++i) {
    const LocalVector shape = shapes.col(i);
    const double radius = undeformed.radius(i), arc = undeformed.arc(i);
    const Tangent tangent = tangent_of(shape);
    const Strain strain = strain_of(shape, tangent, radius, arc);
    use(i, Point{.radius = radius,
                 .arc = arc,
                 .reference_area = two_pi * radius * arc * membrane.sampling.weights(i),
                 .tangent = tangent,
                 .stress = elasticity(membrane, strain, undeformed.curvature_meridional(i),
                                      undeformed.curvature_azimuthal(i))});
  }
}

// Derivatives of the strain with respect to the local variables.
struct StrainSlopes {
  LocalVector stretch_meridional, stretch_azimuthal, bend_meridional, bend_azimuthal;
};
StrainSlopes strain_slopes(const Point &point) {
  const auto &[g, t_x, t_r, inverse, turning] = point.tangent;
  const double radius = point.radius, arc = point.arc;
  const std::complex<double> turning_slope = turning * inverse; // -d(z'/z)/dz
  return {.stretch_meridional = LocalVector(t_x, 0, 0, t_r, 0) / arc,
          .stretch_azimuthal = LocalVector(0, 0, 1, 0, 0) / radius,
          .bend_meridional =
              LocalVector(turning_slope.imag(), -inverse.imag(), 0, turning_slope.real(), -inverse.real()) /
              arc,
          .bend_azimuthal = LocalVector(t_r * t_r, 0, 0, -t_r * t_x, 0) / (g * radius)};
}

// Second derivatives of the strain, summed with the stress that works on each; stretch_azimuthal has none.
LocalMatrix strain_curvature(const Point &point) {
  const auto &[g, t_x, t_r, inverse, turning] = point.tangent;
  const double stretching = point.stress.in_plane.w_a / (g * point.arc);
  const double bending = point.stress.couple_meridional / point.arc;
  const double leaning = point.stress.couple_azimuthal / point.radius;
  const std::complex<double> square = inverse * inverse, twice = 2.0 * turning * square;
  LocalMatrix h = LocalMatrix::Zero();
  // cos(alpha): -cos(alpha) d alpha d alpha - sin(alpha) d^2 alpha, with d alpha = Im(dz/z).
  h(x1, x1) = stretching * t_r * t_r - bending * twice.imag() +
              leaning * (-t_x * inverse.imag() * inverse.imag() + t_r * square.imag());
  h(x1, r1) = -stretching * t_x * t_r - bending * twice.real() +
              leaning * (-t_x * inverse.imag() * inverse.real() + t_r * square.real());
  h(r1, r1) = stretching * t_x * t_x + bending * twice.imag() +
              leaning * (-t_x * inverse.real() * inverse.real() - t_r * square.imag());
  h(x1, x2) = bending * square.imag();
  h(x1, r2) = h(x2, r1) = bending * square.real();
  h(r1, r2) = -bending * square.imag();
  return h.selfadjointView<Eigen::Upper>();
}

// Second derivatives of the energy of each point with respect to the local variables: a column of 25 per
// point.
Matrix local_hessians(const Membrane &membrane, const Vector &position) {
  Matrix local(membrane.sampling.zeta.size(), local_size * local_size);
  Eigen::Matrix4d stiffness = Eigen::Matrix4d::Zero();
  stiffness.bottomRightCorner<2, 2>() = bending_stiffness(membrane);
  at_each_point(membrane, position, [&](Eigen::Index i, const Point &point) {
    const StrainSlopes slopes = strain_slopes(point);
    const StrainEnergy &in_plane = point.stress.in_plane;
    Eigen::Matrix<double, local_size, 4> strains;
    strains << slopes.stretch_meridional, slopes.stretch_azimuthal, slopes.bend_meridional,
        slopes.bend_azimuthal;
    stiffness.topLeftCorner<2, 2>() << in_plane.w_aa, in_plane.w_ab, in_plane.w_ab, in_plane.w_bb;
    const LocalMatrix h =
        point.reference_area * (strains * stiffness * strains.transpose() + strain_curvature(point));
    local.row(i) = h.reshaped();
  });
  return local;
}

} // namespace

Membrane make_membrane(const CapsuleSpec &capsule, const MembraneSpec &material, const MeridianBasis &basis,
                       const Vector &zeta, const Vector &weights) {
  Membrane membrane{.law = {},
                    .bending_ratio = 0,
                    .basis = basis,
                    .node_angle = basis.nodes,
                    .initial = {},
                    .reference = {},
                    .sampling = sample(basis, zeta, weights),
                    .undeformed = {},
                    .at_nodes = sample(basis, basis.nodes, basis.weights),
                    .undeformed_at_nodes = {}};
  set_material(capsule, material, membrane);
  return membrane;
}

void set_material(const CapsuleSpec &capsule, const MembraneSpec &material, Membrane &membrane) {
  membrane.law = material.law;
  membrane.bending_ratio = material.bending_ratio;
  membrane.initial = initial_position(capsule, membrane.node_angle);
  membrane.reference = reference_position(capsule, membrane.node_angle);
  membrane.undeformed = undeformed_at(membrane.sampling, membrane.reference);
  membrane.undeformed_at_nodes = undeformed_at(membrane.at_nodes, membrane.reference);
}

UndeformedMeridian undeformed_at(const Sampling &at, const Vector &reference) {
  const LocalShapes shapes = local_shapes(at, reference);
  const Eigen::Index points = at.zeta.size();
  UndeformedMeridian undeformed{Vector(points), Vector(points), Vector(points), Vector(points)};
  for (Eigen::Index i = 0; i < points; ++i) {
    const LocalVector shape = shapes.col(i);
    const Tangent tangent = tangent_of(shape);
    Strain strain = strain_of(shape, tangent, shape(r0), tangent.g);
    strain = is_pole(at.zeta(i)) ? isotropic(strain) : strain;
    undeformed.radius(i) = shape(r0);
    undeformed.arc(i) = tangent.g;
    undeformed.curvature_meridional(i) = strain.bend_meridional;
    undeformed.curvature_azimuthal(i) = strain.bend_azimuthal;
  }
  return undeformed;
}

MembraneState membrane_state(const Membrane &membrane, const Sampling &at, const Vector &position) {
  return membrane_state(membrane, at, undeformed_at(at, membrane.reference), position);
}

MembraneState membrane_state(const Membrane &membrane, const Sampling &at,
                             const UndeformedMeridian &undeformed, const Vector &position) {
  const Eigen::Index n = membrane.basis.size(), points = at.zeta.size();
  const LocalShapes shapes = local_shapes(at, position);
  MembraneState state;
  state.x = at.even[0] * position.head(n);
  state.r = shapes.row(r0);
  for (Vector *field :
       {&state.arc, &state.normal_x, &state.normal_r, &state.stretch_meridional, &state.stretch_azimuthal,
        &state.tension_meridional, &state.tension_azimuthal, &state.curvature_meridional,
        &state.curvature_azimuthal, &state.moment_meridional, &state.moment_azimuthal}) {
    field->resize(points);
  }
  for (Eigen::Index i = 0; i < points; ++i) {
    const LocalVector shape = shapes.col(i);
    const Tangent tangent = tangent_of(shape);
    Strain strain = strain_of(shape, tangent, undeformed.radius(i), undeformed.arc(i));
    strain = is_pole(at.zeta(i)) ? isotropic(strain) : strain;
    const auto [stretch_s, stretch_phi, bend_s, bend_phi] = strain;
    const Elasticity stress =
        elasticity(membrane, strain, undeformed.curvature_meridional(i), undeformed.curvature_azimuthal(i));
    state.arc(i) = tangent.g;
    state.normal_x(i) = -tangent.t_r;
    state.normal_r(i) = tangent.t_x;
    state.stretch_meridional(i) = stretch_s;
    state.stretch_azimuthal(i) = stretch_phi;
    const Tensions tension = tensions(membrane.law, stretch_s, stretch_phi);
    state.tension_meridional(i) = tension.meridional;
    state.tension_azimuthal(i) = tension.azimuthal;
    state.curvature_meridional(i) = bend_s / stretch_s;
    state.curvature_azimuthal(i) = bend_phi / stretch_phi;
    state.moment_meridional(i) = stress.couple_meridional / stretch_phi;
    state.moment_azimuthal(i) = stress.couple_azimuthal / stretch_s;
  }
  return state;
}

double elastic_energy(const Membrane &membrane, const Vector &position) {
  double energy = 0;
  at_each_point(membrane, position, [&](Eigen::Index, const Point &point) {
    energy += point.reference_area * point.stress.energy;
  });
  return energy;
}

Vector energy_gradient(const Membrane &membrane, const Vector &position) {
  Matrix local(membrane.sampling.zeta.size(), static_cast<int>(local_size));
  at_each_point(membrane, position, [&](Eigen::Index i, const Point &point) {
    const StrainSlopes slopes = strain_slopes(point);
    const auto &[energy, in_plane, couple_meridional, couple_azimuthal] = point.stress;
    local.row(i) = point.reference_area *
                   (in_plane.w_a * slopes.stretch_meridional + in_plane.w_b * slopes.stretch_azimuthal +
                    couple_meridional * slopes.bend_meridional + couple_azimuthal * slopes.bend_azimuthal);
  });
  const Eigen::Index n = membrane.basis.size();
  Vector gradient = Vector::Zero(2 * n);
  for (int i = 0; i <= x2; ++i)
    gradient.head(n) += membrane.sampling.even[i + 1].transposed_times(local.col(i));
  for (int i = r0; i <= r2; ++i)
    gradient.tail(n) += membrane.sampling.odd[i - r0].transposed_times(local.col(i));
  return gradient;
}

Matrix energy_hessian(const Membrane &membrane, const Vector &position) {
  const Sampling &at = membrane.sampling;
  const Matrix local = local_hessians(membrane, position);
  const Eigen::Index n = membrane.basis.size();
  Matrix hessian(2 * n, 2 * n);
  // Each block is a sum of (local row of a variable, applied to the matrices of the others)^T times its own matrix. It is
  // summed on its own: columns of the Hessian may lie a power of two apart and would then share places in the cache.
  RowMatrix row_applied(n, at.zeta.size());
  Matrix sum(n, n);
  const auto block = [&](Local first_row, Local end_row, Local first_column,
                         Local end_column) -> const Matrix & {
    sum.setZero();
    for (int row = first_row; row < end_row; ++row) {
      for (Eigen::Index j = 0; j < n; ++j) { // node by node: the sum stays in the nearest cache
        row_applied.row(j).setZero();
        for (int column = first_column; column < end_column; ++column) {
          row_applied.row(j) += local.col(row * local_size + column)
                                    .cwiseProduct(matrix_of(at, column).whole().col(j))
                                    .transpose();
        }
      }
      sum += row_applied * matrix_of(at, row);
    }
    return sum;
  };
  hessian.topLeftCorner(n, n) = block(x1, r0, x1, r0);
  hessian.bottomLeftCorner(n, n) = block(x1, r0, r0, local_size);
  hessian.bottomRightCorner(n, n) = block(r0, local_size, r0, local_size);
  hessian.topRightCorner(n, n) = hessian.bottomLeftCorner(n, n).transpose();
  return hessian;
}

} // namespace capsule
