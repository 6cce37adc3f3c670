// The undeformed spheroid: its volume, its half axes and the angles of its nodes.
#include "geometry/reference_shape.hpp"
#include "geometry/sampling.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace capsule;
using std::numbers::pi;
namespace tt = boost::test_tools;

BOOST_AUTO_TEST_SUITE(reference_shape)

BOOST_AUTO_TEST_CASE(a_spheroid_has_the_volume_of_its_sphere) {
  for (const double aspect_ratio : {0.28, 1.0, 2.5}) {
    const CapsuleSpec capsule{.radius = 0.9, .aspect_ratio = aspect_ratio};
    const auto [half_length, half_width] = extent(capsule);
    BOOST_TEST(half_length / half_width == aspect_ratio, tt::tolerance(1e-14));
    const MeridianBasis basis = spectral_basis(40);
    const Vector position = reference_position(capsule, basis.nodes);
    const Trace curve = trace(sample(basis, basis.nodes, basis.weights), position);
    const double volume =
        pi * (basis.weights.array() * curve.r.array().square() * curve.x_zeta.array()).sum();
    BOOST_TEST(volume == 4 * pi / 3 * std::pow(0.9, 3), tt::tolerance(1e-13));
    const Eigen::ArrayXd equation = (position.head(40) / half_length).array().square() +
                                    (position.tail(40) / half_width).array().square();
    BOOST_TEST((equation - 1).abs().maxCoeff() < 1e-14);
  }
}

// Evans and Fung's cell of R_0 = 3.91 um: volume 94.0911 um^3, area 134.0897 um^2, and its thickness point by point. The
// references were computed by adaptive quadrature of the formula over r.
BOOST_AUTO_TEST_CASE(a_red_cell_by_evans_and_fung) {
  const double width = 3.91;
  CapsuleSpec capsule{.radius = 1, .shape = CapsuleShape::biconcave};
  capsule.radius = width / extent(capsule).half_width;
  BOOST_TEST(capsule.radius == 2.82154257433, tt::tolerance(1e-8));
  const MeridianBasis basis = spectral_basis(48);
  const Vector position = initial_position(capsule, basis.nodes);
  const Trace curve = trace(sample(basis, basis.nodes, basis.weights), position);
  const double volume = pi * (basis.weights.array() * curve.r.array().square() * curve.x_zeta.array()).sum();
  const double area = 2 * pi * (basis.weights.array() * curve.r.array() * curve.arc.array()).sum();
  BOOST_TEST(volume == 94.0910754537, tt::tolerance(1e-8));
  BOOST_TEST(area == 134.089701713, tt::tolerance(1e-8));
  BOOST_TEST(volume == 4 * pi / 3 * std::pow(capsule.radius, 3), tt::tolerance(1e-12));
  const Eigen::ArrayXd p2 = (position.tail(48) / width).array().square();
  const Eigen::ArrayXd thickness =
      width / 2 * (1 - p2).max(0).sqrt() * (0.207161 + 2.002558 * p2 - 1.122762 * p2.square());
  BOOST_TEST((position.head(48).array().abs() - thickness).abs().maxCoeff() < 1e-7);
  const Vector dense = Vector::LinSpaced(20001, 0, pi);
  const Vector fine = initial_position(capsule, dense);
  BOOST_TEST(fine.head(20001).maxCoeff() == extent(capsule).half_length, tt::tolerance(1e-7));
}

// Spheroids scale alike: before the flow they have the radius that the case says.
BOOST_AUTO_TEST_CASE(the_stress_free_shape_of_an_inflated_capsule_is_smaller) {
  const CapsuleSpec capsule{.radius = 0.9, .aspect_ratio = 0.7}, inflated{0.9, 0.7, 0.05};
  const Vector angle = Vector::LinSpaced(9, 0, pi);
  BOOST_TEST((initial_position(inflated, angle) - initial_position(capsule, angle)).cwiseAbs().maxCoeff() ==
             0);
  BOOST_TEST((reference_position(capsule, angle) - initial_position(capsule, angle)).cwiseAbs().maxCoeff() ==
             0);
  BOOST_TEST(
      (1.05 * reference_position(inflated, angle) - initial_position(inflated, angle)).cwiseAbs().maxCoeff() <
      1e-15);
}

// Between a quarter and half of the meridian 1.8 times as dense as even nodes, at the front pole 1.7 times less dense.
BOOST_AUTO_TEST_CASE(clustered_angles_ascend_and_are_denser_at_the_rear) {
  const Vector zeta = Vector::LinSpaced(401, 0, pi);
  BOOST_TEST((clustered_angles(zeta, 0) - zeta).cwiseAbs().maxCoeff() == 0);
  const Vector angles = clustered_angles(zeta, 0.72);
  BOOST_TEST(angles[0] == 0);
  BOOST_TEST(angles[400] == pi, tt::tolerance(1e-15));
  const Vector step = (angles.tail(400) - angles.head(400)) / zeta[1];
  Eigen::Index densest = 0;
  BOOST_TEST(step.minCoeff(&densest) == 1 / 1.76, tt::tolerance(0.02));
  BOOST_TEST(zeta[densest] > pi / 4);
  BOOST_TEST(zeta[densest] < pi / 2);
  Eigen::Index sparsest = 0;
  BOOST_TEST(step.maxCoeff(&sparsest) == 1.7, tt::tolerance(0.02));
  BOOST_TEST(sparsest == 399);
}

BOOST_AUTO_TEST_SUITE_END()
