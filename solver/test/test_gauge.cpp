// What a row reports, on shapes and velocities for which it is known.
#include "case/case.hpp"
#include "observe/gauge.hpp"
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <vector>

using namespace capsule;

namespace {

constexpr double pi = std::numbers::pi;

struct Body {
  MeridianBasis basis;
  Membrane membrane;
  Gauge gauge;
};

// A sphere in the pore of 78.5 degrees.
Body sphere(double radius, int nodes) {
  const MeridianBasis basis = spectral_basis(nodes);
  const Membrane membrane = make_membrane({.radius = radius}, {}, basis, basis.nodes, basis.weights);
  return {basis, membrane, Gauge(make_pore({}), membrane)};
}

Vector moved(const Vector &reference, double x) {
  Vector position = reference;
  position.head(reference.size() / 2).array() += x;
  return position;
}

} // namespace

BOOST_AUTO_TEST_SUITE(gauge)

BOOST_AUTO_TEST_CASE(sphere_in_the_tube) {
  const double a = 0.7;
  const Body b = sphere(a, 24);
  const Vector position = moved(b.membrane.reference, 5);
  // v = (u + s (x - 5), c r): flux through the sphere moves its centre by u, with c = -s/2 its volume stays.
  const double u = 1.3;
  const double s = 0.2;
  const Eigen::Index n = b.basis.size();
  Vector velocity(2 * n);
  velocity << u + s * (position.head(n).array() - 5), -s / 2 * position.tail(n).array();
  const SeriesRow row = b.gauge.row(2, position, velocity);
  BOOST_TEST(std::abs(row.x_g - 5) < 1e-12);
  BOOST_TEST(std::abs(row.v_g - u) < 1e-12);
  BOOST_TEST(std::abs(row.min_film - (1 - a)) < 1e-9);
  BOOST_TEST(std::abs(row.length - 2 * a) < 1e-9);
  BOOST_TEST(std::abs(row.deformation) < 1e-9);
  BOOST_TEST(std::abs(row.max_stretch - 1) < 1e-10);
  BOOST_TEST(std::abs(row.volume_change) < 1e-12);
  BOOST_TEST(std::abs(row.area_change) < 1e-12);
  BOOST_TEST(std::abs(row.max_axial_residual - s * a * std::cos(b.basis.nodes[0])) < 1e-12);
  BOOST_TEST(row.dents == 0);
  BOOST_TEST(row.roughness < 1e-10);
}

// In the reservoir the nearest point of the wall is the lip's side of the hyperbola; where the mouth ends, the distance along
// the meridian has a jump in its second derivative; brute force over the wall.
BOOST_AUTO_TEST_CASE(film_in_the_mouth) {
  const double a = 0.8;
  const Body b = sphere(a, 48);
  const double slope = std::tan(78.5 * pi / 180);
  for (const double centre : {-1.1, -0.05, -0.01, -0.002, 0.0, 0.003}) {
    double nearest = 10;
    for (int i = 0; i <= 400000; ++i) {
      const double x = -2 + i * 1e-5;
      const double r = x < 0 ? std::sqrt(1 + x * x * slope * slope) : 1;
      nearest = std::min(nearest, std::hypot(x - centre, r) - a);
    }
    BOOST_TEST(std::abs(b.gauge.film(moved(b.membrane.reference, centre)) - nearest) < 2e-9);
  }
}

BOOST_AUTO_TEST_CASE(film_without_a_wall) {
  const Body b = sphere(1, 24);
  BOOST_TEST(std::isinf(Gauge(std::nullopt, b.membrane).film(b.membrane.reference)));
}

BOOST_AUTO_TEST_CASE(dents_and_crossings_are_seen) {
  const Body b = sphere(0.8, 48);
  const Eigen::Index n = b.basis.size();
  const Eigen::ArrayXd zeta = b.basis.nodes;
  Vector wavy(2 * n); // a ripple of 12 waves, deep enough to turn the meridian back
  const Eigen::ArrayXd radius = 0.8 + 0.02 * (24 * zeta).cos();
  wavy << -radius * zeta.cos(), radius * zeta.sin();
  const SeriesRow row = b.gauge.row(0, wavy, Vector::Zero(2 * n));
  BOOST_TEST(row.dents == 12);
  BOOST_TEST(!b.gauge.crosses_itself(wavy));
  Vector looped = b.membrane.reference; // x = 4.8 z^3 - 4.4 z with z = cos(zeta) meets itself at x = 0
  looped.head(n).array() += 1.2 * (3 * zeta).cos();
  BOOST_TEST(b.gauge.crosses_itself(looped));
}

// S runs from pole to pole, half the circumference; profiles carry the sphere's curvature.
BOOST_AUTO_TEST_CASE(profile_of_a_sphere) {
  const Body b = sphere(0.8, 32);
  const Profile profile = b.gauge.profile(1, b.membrane.reference, Vector::Ones(64));
  const Eigen::Index last = profile.S.size() - 1;
  BOOST_TEST(std::abs(profile.S[last] - 0.8 * pi) < 1e-4);
  BOOST_TEST((profile.curvature_meridional.array() - 1 / 0.8).abs().maxCoeff() < 1e-8);
  BOOST_TEST((profile.curvature_azimuthal.array() - 1 / 0.8).abs().maxCoeff() < 1e-8);
  BOOST_TEST(profile.tension_meridional.cwiseAbs().maxCoeff() < 1e-9);
}

BOOST_AUTO_TEST_CASE(entry_peak_of_a_pulse) {
  // Rises to a peak between two rows, dips, and goes on to a higher plateau with ripples below a thousandth.
  std::vector<SeriesRow> series;
  const double peak_at = 0.123;
  for (int i = 0; i <= 300; ++i) {
    SeriesRow row;
    row.x_g = -4 + 0.05 * i + 0.004 * std::sin(i); // uneven
    const double entry = 6 * std::exp(-std::pow((row.x_g - peak_at) / 0.8, 2));
    const double plateau = 14 / (1 + std::exp(-4 * (row.x_g - 4)));
    row.pressure_drop = entry + plateau + 0.001 * std::sin(3 * i);
    series.push_back(row);
  }
  const auto peak = entry_peak(series);
  BOOST_REQUIRE(peak);
  BOOST_TEST(std::abs(peak->x_g - peak_at) < 0.05);
  BOOST_TEST(std::abs(peak->pressure_drop - 6) < 0.01);

  // A parabola is met exactly, wherever the rows are.
  std::vector<SeriesRow> parabola(4);
  for (std::size_t i = 0; i < 4; ++i) {
    parabola[i].x_g = std::array{0.0, 0.7, 1.1, 2.0}.at(i);
    parabola[i].pressure_drop = 3 - std::pow(parabola[i].x_g - 0.8, 2);
  }
  BOOST_TEST(entry_peak(parabola)->x_g == 0.8, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(entry_peak(parabola)->pressure_drop == 3, boost::test_tools::tolerance(1e-14));

  // Without a fall: the largest value.
  parabola.resize(2);
  BOOST_TEST(entry_peak(parabola)->pressure_drop == parabola[1].pressure_drop);
  BOOST_TEST(!entry_peak({}));
}

// Values of test_conductor and test_long_conductor.
BOOST_AUTO_TEST_CASE(resistance_where_it_is_asked_for) {
  const Body b = sphere(0.8, 60);
  const Vector position = moved(b.membrane.reference, 1), at_rest = Vector::Zero(120);
  BOOST_TEST(std::isnan(b.gauge.row(0, position, at_rest).resistance));
  BOOST_TEST(!b.gauge.empty_resistance().has_value());
  const Gauge gauge(make_pore({}), b.membrane, FlowResolution{});
  const SeriesRow row = gauge.row(0, position, at_rest);
  BOOST_TEST(std::abs(row.resistance - 1.728995) < 3e-6);
  BOOST_TEST(std::abs(row.resistance_long_conductor - 1.490984) < 1e-6);
  BOOST_TEST(std::abs(gauge.empty_resistance().value() - 15.9773755) < 3e-6);
}

// A deformed sphere whose stretches have a closed form: lambda_s = s'(zeta)/a, lambda_phi = r/(a sin zeta), beside their
// largest values on a dense grid; S = a zeta.
BOOST_AUTO_TEST_CASE(where_a_membrane_is_strained_most) {
  const double a = 0.8;
  const Body b = sphere(a, 48);
  const Eigen::Index n = b.basis.size();
  const auto shape = [&](const Eigen::ArrayXd &z) {
    Eigen::ArrayXXd columns(z.size(), 4); // x, r, and their slopes
    columns << -a * z.cos() + 0.05 * (2 * z).cos(), a * z.sin() * (1.2 + 0.2 * z.cos()),
        a * z.sin() - 0.1 * (2 * z).sin(), a * (1.2 * z.cos() + 0.2 * (2 * z).cos());
    return columns;
  };
  Vector position(2 * n);
  const Eigen::ArrayXXd at_nodes = shape(b.basis.nodes);
  position << at_nodes.col(0), at_nodes.col(1);
  const SeriesRow row = b.gauge.row(0, position, Vector::Zero(2 * n));
  const Eigen::ArrayXd zeta = Eigen::ArrayXd::LinSpaced(200001, 1e-6, pi - 1e-6);
  const Eigen::ArrayXXd dense = shape(zeta);
  const Eigen::ArrayXd stretch_s = (dense.col(2).square() + dense.col(3).square()).sqrt() / a;
  const Eigen::ArrayXd stretch_phi = dense.col(1) / (a * zeta.sin());
  const Eigen::ArrayXd area = stretch_s * stretch_phi;
  // Eq. 4, neo-Hookean: T_s = (lambda_s^2 - 1/(lambda_s lambda_phi)^2)/(lambda_s lambda_phi), and s <-> phi.
  const Eigen::ArrayXd fall = 1 / area.square();
  const Eigen::ArrayXd tension_s = (stretch_s.square() - fall) / area;
  const Eigen::ArrayXd tension_phi = (stretch_phi.square() - fall) / area;
  const Eigen::ArrayXd tension = tension_s.max(tension_phi);
  Eigen::Index at_area = 0, at_tension = 0;
  const double largest_area = area.maxCoeff(&at_area), largest_tension = tension.maxCoeff(&at_tension);
  BOOST_TEST(row.max_area_stretch == largest_area, boost::test_tools::tolerance(1e-8));
  BOOST_TEST(row.max_tension == largest_tension, boost::test_tools::tolerance(1e-8));
  BOOST_TEST(std::abs(row.S_at_max_area_stretch - a * zeta[at_area]) < 2e-4);
  BOOST_TEST(std::abs(row.S_at_max_tension - a * zeta[at_tension]) < 2e-4);
}

// A parabola in time is met exactly, and a capsule that moves evenly is between its rows at the largest value.
BOOST_AUTO_TEST_CASE(largest_value_over_the_way) {
  std::vector<SeriesRow> series(4);
  for (std::size_t i = 0; i < 4; ++i) {
    SeriesRow &row = series[i];
    row.time = std::array{0.0, 0.7, 1.1, 2.0}.at(i);
    row.x_g = 3 + 2 * row.time;
    row.max_tension = 3 - std::pow(row.time - 0.8, 2);
    row.S_at_max_tension = static_cast<double>(i);
  }
  const auto of = [](const std::vector<SeriesRow> &rows) {
    return largest_on_the_way(rows, &SeriesRow::max_tension, &SeriesRow::S_at_max_tension);
  };
  BOOST_TEST(of(series)->value == 3, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(of(series)->x_g == 4.6, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(of(series)->S == 1);
  series.resize(2);
  BOOST_TEST(of(series)->value == series[1].max_tension);
  BOOST_TEST(!of({}));
}

BOOST_AUTO_TEST_SUITE_END()
