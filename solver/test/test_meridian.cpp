// The bases of the meridian on functions whose derivatives are known.
#include "geometry/meridian.hpp"
#include "geometry/quadrature.hpp"
#include "geometry/sampling.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace capsule;
using std::numbers::pi;

namespace {

// Smooth, of the right parity and not in the span of any basis: e = exp(a cos z), o = sin z exp(a cos z).
constexpr double a = 1.3;
double even_function(double z, int derivative) {
  const double e = std::exp(a * std::cos(z)), c = std::cos(z), s = std::sin(z);
  switch (derivative) {
  case 0:
    return e;
  case 1:
    return -a * s * e;
  case 2:
    return (a * a * s * s - a * c) * e;
  default:
    return a * s * (1 + 3 * a * c - a * a * s * s) * e;
  }
}
// The odd one is minus the first derivative of the even one over a.
double odd_function(double z, int derivative) {
  const double e = std::exp(a * std::cos(z)), c = std::cos(z), s = std::sin(z);
  if (derivative < 3) {
    return -even_function(z, derivative + 1) / a;
  }
  const double p = 1 + 3 * a * c - a * a * s * s; // -(s p e)'
  return -(c * p + s * (-3 * a * s - 2 * a * a * s * c) - a * s * s * p) * e;
}

Vector tabulate(double (*f)(double, int), const Vector &points, int derivative) {
  return points.unaryExpr([=](double z) { return f(z, derivative); });
}

// Largest error of a derivative over the meridian, poles included, and what rounding may make of it: each of
// the N terms of a sum is rounded a few times, independently.
struct Error {
  double found, rounding;
};
Error error_of(const Matrix &derivative_matrix, const Vector &nodal, const Vector &exact) {
  const double roundings = 2 * std::sqrt(static_cast<double>(nodal.size())) * 0x1p-52;
  const double amplification = derivative_matrix.cwiseAbs().rowwise().sum().maxCoeff();
  return {(derivative_matrix * nodal - exact).lpNorm<Eigen::Infinity>(),
          roundings * amplification * nodal.lpNorm<Eigen::Infinity>()};
}
Error even_error(const MeridianBasis &basis, int derivative) {
  const Vector points = Vector::LinSpaced(1001, 0, pi);
  return error_of(basis.even(points, derivative), tabulate(even_function, basis.nodes, 0),
                  tabulate(even_function, points, derivative));
}
Error odd_error(const MeridianBasis &basis, int derivative) {
  const Vector points = Vector::LinSpaced(1001, 0, pi);
  return error_of(basis.odd(points, derivative), tabulate(odd_function, basis.nodes, 0),
                  tabulate(odd_function, points, derivative));
}

} // namespace

BOOST_AUTO_TEST_CASE(spectral_basis_converges_exponentially) {
  // The interpolation error of exp(a x) falls like (a/2)^N/N!: at 12 nodes about 1e-11.
  BOOST_TEST(even_error(spectral_basis(6), 0).found > 1e-6);
  BOOST_TEST(even_error(spectral_basis(12), 0).found < 1e-9);
  BOOST_TEST(odd_error(spectral_basis(12), 0).found < 1e-9);
  const MeridianBasis basis = spectral_basis(24);
  for (int derivative = 0; derivative <= 3; ++derivative) {
    const Error even = even_error(basis, derivative), odd = odd_error(basis, derivative);
    BOOST_TEST(even.found < even.rounding);
    BOOST_TEST(odd.found < odd.rounding);
  }
}

BOOST_AUTO_TEST_CASE(spectral_basis_keeps_its_digits_with_many_nodes) {
  for (const int n : {96, 255, 256}) {
    const MeridianBasis basis = spectral_basis(n);
    BOOST_TEST(even_error(basis, 0).found < 1e-13);
    BOOST_TEST(odd_error(basis, 0).found < 1e-13);
    for (int derivative = 0; derivative <= 3; ++derivative) {
      const Error even = even_error(basis, derivative), odd = odd_error(basis, derivative);
      BOOST_TEST_MESSAGE("nodes " << n << " derivative " << derivative << ": errors " << even.found << " "
                                  << odd.found << ", rounding may make " << even.rounding);
      BOOST_TEST(even.found < even.rounding);
      BOOST_TEST(odd.found < odd.rounding);
    }
    // Every wave of the space is reproduced, the highest too.
    const Vector points = Vector::LinSpaced(333, 0, pi);
    const Vector cosine = basis.even(points, 0) * ((n - 1) * basis.nodes).array().cos().matrix();
    const Vector sine = basis.odd(points, 0) * (n * basis.nodes).array().sin().matrix();
    BOOST_TEST((cosine - ((n - 1) * points).array().cos().matrix()).lpNorm<Eigen::Infinity>() < 3e-12);
    BOOST_TEST((sine - (n * points).array().sin().matrix()).lpNorm<Eigen::Infinity>() < 3e-12);
  }
}

BOOST_AUTO_TEST_CASE(spectral_quadrature_is_exact) {
  for (const int n : {5, 64, 256}) {
    const MeridianBasis basis = spectral_basis(n);
    for (const int degree : {0, 2, 2 * n - 2}) { // sin z cos^d z integrates to 2/(d + 1)
      const auto f = basis.nodes.array().sin() * basis.nodes.array().cos().pow(degree);
      BOOST_TEST(basis.weights.dot(f.matrix()) == 2.0 / (degree + 1), boost::test_tools::tolerance(2e-13));
    }
    const auto odd_degree = basis.nodes.array().sin() * basis.nodes.array().cos().pow(2 * n - 1);
    BOOST_TEST(std::abs(basis.weights.dot(odd_degree.matrix())) < 1e-15);
    const auto too_high = basis.nodes.array().sin() * basis.nodes.array().cos().pow(2 * n);
    BOOST_TEST(basis.weights.minCoeff() > 0);
    if (n == 5) { // Gauss's rule of five nodes ends at degree nine
      BOOST_TEST(std::abs(basis.weights.dot(too_high.matrix()) - 2.0 / 11) > 1e-4);
    }
  }
}

BOOST_AUTO_TEST_CASE(spectral_nodes_ascend_and_mirror) {
  for (const int n : {3, 64, 255}) {
    const Vector z = spectral_basis(n).nodes;
    BOOST_TEST((z.tail(n - 1) - z.head(n - 1)).minCoeff() > 0);
    BOOST_TEST((z + z.reverse() - Vector::Constant(n, pi)).lpNorm<Eigen::Infinity>() < 1e-15);
  }
  // The nodes of the three-point Gauss rule.
  BOOST_TEST(std::cos(spectral_basis(3).nodes(0)) == std::sqrt(0.6), boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(splines_have_their_order) {
  const MeridianBasis coarse = spline_basis(48), fine = spline_basis(96);
  for (int derivative = 0; derivative <= 2; ++derivative) {
    const double even = std::log2(even_error(coarse, derivative).found / even_error(fine, derivative).found);
    const double odd = std::log2(odd_error(coarse, derivative).found / odd_error(fine, derivative).found);
    BOOST_TEST_MESSAGE("derivative " << derivative << ": orders " << even << " " << odd);
    BOOST_TEST(even == 4 - derivative, boost::test_tools::tolerance(0.05));
    BOOST_TEST(odd == 4 - derivative, boost::test_tools::tolerance(0.05));
  }
}

BOOST_AUTO_TEST_CASE(splines_pass_through_their_nodes) {
  const MeridianBasis basis = spline_basis(60);
  const Matrix identity = Matrix::Identity(basis.size(), basis.size());
  BOOST_TEST((basis.even(basis.nodes, 0) - identity).lpNorm<Eigen::Infinity>() < 1e-13);
  BOOST_TEST((basis.odd(basis.nodes, 0) - identity).lpNorm<Eigen::Infinity>() < 1e-13);
}

BOOST_AUTO_TEST_CASE(parity_at_the_poles_is_exact) {
  const Vector poles = Eigen::Vector2d(0, pi);
  for (const MeridianBasis &basis : {spectral_basis(40), spline_basis(40)}) {
    // Nodal values without any smoothness: parity belongs to the space, not to the function.
    const Vector even = basis.nodes.unaryExpr([](double z) { return std::cos(37 * z * z); });
    Vector odd = basis.nodes.unaryExpr([](double z) { return std::sin(41 * z * z); });
    if (basis.spline) {
      odd(0) = odd(basis.size() - 1) = 0;
    }
    const auto zero = [&](const Matrix &derivative, const Vector &nodal, double scale) {
      BOOST_TEST((derivative * nodal).lpNorm<Eigen::Infinity>() < 1e-14 * scale);
    };
    const double k = 40;
    zero(basis.even(poles, 1), even, k * k);
    zero(basis.odd(poles, 0), odd, k);
    zero(basis.odd(poles, 2), odd, k * k * k);
    if (!basis.spline) { // a cubic's third derivative jumps at every knot, the poles included
      zero(basis.even(poles, 3), even, k * k * k * k);
    }
  }
}

BOOST_AUTO_TEST_CASE(spline_quadrature_integrates_the_odd_spline) {
  const MeridianBasis basis = spline_basis(20);
  const Panels elements = make_panels(basis.nodes, 4);
  const Vector integrals = basis.odd(elements.points, 0).transpose() * elements.weights;
  BOOST_TEST((integrals - basis.weights).lpNorm<Eigen::Infinity>() < 1e-14);
}

// With and without a node or a point on the equator, against the matrices themselves.
BOOST_AUTO_TEST_CASE(mirrored_products_are_the_matrices) {
  for (const int nodes : {30, 31})
    for (const int points : {40, 41}) {
      const MeridianBasis basis = spectral_basis(nodes);
      const Vector zeta = Vector::LinSpaced(points, 0.01, pi - 0.01);
      const Sampling at = sample(basis, zeta, Vector::Ones(points));
      const Vector nodal =
          (3 * basis.nodes.array()).sin() + basis.nodes.array().exp(); // neither is symmetric
      const Vector values = (2 * zeta.array()).cos() + zeta.array();
      RowMatrix rows(3, points);
      rows << values.transpose(), zeta.transpose(), zeta.array().square().matrix().transpose();
      for (int derivative = 0; derivative <= 2; ++derivative) {
        const auto check = [](const Matrix &one, const Matrix &other) {
          BOOST_TEST((one - other).norm() < 1e-13 * other.norm());
        };
        check(at.even[derivative].whole(), basis.even(zeta, derivative));
        check(at.odd[derivative].whole(), basis.odd(zeta, derivative));
        for (const BasisMatrix &matrix : {at.even[derivative], at.odd[derivative]}) {
          BOOST_REQUIRE(matrix.is_mirrored());
          check(matrix * nodal, matrix.whole() * nodal);
          check(matrix.transposed_times(values), matrix.whole().transpose() * values);
          check(rows * matrix, rows * matrix.whole());
        }
      }
    }
}

BOOST_AUTO_TEST_CASE(points_that_do_not_mirror_are_taken_as_they_are) {
  const MeridianBasis basis = spectral_basis(30);
  const Vector zeta = Vector::LinSpaced(20, 0.1, 2);
  const Sampling at = sample(basis, zeta, Vector::Ones(20));
  BOOST_TEST(!at.even[1].is_mirrored());
  const Vector x = at.even[1] * tabulate(even_function, basis.nodes, 0);
  BOOST_TEST((x - tabulate(even_function, zeta, 1)).norm() < 1e-11);
}

BOOST_AUTO_TEST_CASE(impossible_bases_are_refused) {
  BOOST_CHECK_THROW(spectral_basis(2), std::invalid_argument);
  BOOST_CHECK_THROW(spline_basis(2), std::invalid_argument);
  const Vector outside = Vector::Constant(1, 4);
  BOOST_CHECK_THROW(spline_basis(8).even(outside, 0), std::invalid_argument);
}
