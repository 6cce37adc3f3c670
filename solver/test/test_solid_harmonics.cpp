// The series of a distant cap against the rings themselves.
#include "electric/solid_harmonics.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace capsule;

namespace {

// Of a sphere around a place of the axis that is not the series' centre, with the normal away from it.
Curve cap(double place, double radius, double half_angle) {
  const Panels across = make_panels(Vector::LinSpaced(3, 0, half_angle), 12);
  Curve curve;
  curve.panel_points = 12;
  curve.weights = across.weights;
  curve.x = place + radius * across.points.array().cos();
  curve.r = radius * across.points.array().sin();
  curve.x_zeta = -radius * across.points.array().sin();
  curve.r_zeta = radius * across.points.array().cos();
  complete(curve);
  return curve;
}

} // namespace

BOOST_AUTO_TEST_SUITE(solid_harmonics)

BOOST_AUTO_TEST_CASE(as_the_rings) {
  const Targets points{Vector{{-2, 3, 3.5, 9, 20}}, Vector{{0, 0.1, 4, 0.8, 11}}};
  const NearRule near(12, 1e-12);
  for (const double half_angle : {1.5, std::numbers::pi - 0.5}) {
    const Curve curve = cap(6, 240, half_angle);
    for (const RingKernel *kernel : {&ring_source, &ring_dipole}) {
      RowMatrix rings;
      assemble_layer(*kernel, points, curve, nullptr, near, rings);
      const SolidHarmonics series(*kernel, curve, 3);
      BOOST_REQUIRE(series.hold(points));
      const Vector expected = rings.rowwise().sum();
      BOOST_TEST((series.at(points) - expected).cwiseAbs().maxCoeff() <
                 1e-13 * expected.cwiseAbs().maxCoeff());
    }
  }
}

BOOST_AUTO_TEST_CASE(not_beyond_its_reach) {
  const SolidHarmonics series(ring_source, cap(0, 240, 1.5), 3);
  BOOST_TEST(!series.hold({Vector{{3, 60}}, Vector{{0, 0}}}));
  BOOST_TEST(!SolidHarmonics().hold({Vector{{0}}, Vector{{0.5}}}));
}

BOOST_AUTO_TEST_SUITE_END()
