// The membrane's load against an independent form of eq. 7 and exact shapes, its derivatives against differences.
#include "membrane/load.hpp"
#include "membranes.hpp"
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace capsule;
using std::numbers::pi;
namespace tt = boost::test_tools;

namespace {

// ---- Eqs. 2 to 7 written again for a shape given by formulas, in quadruple precision; what eq. 7
// differentiates is differentiated by differences ----
using Real = boost::multiprecision::cpp_bin_float_quad;
using Function = std::function<Real(const Real &)>;

Real slope(const Function &f, const Real &z) {
  const Real h = 1e-6; // error h^4
  return (8 * (f(z + h) - f(z - h)) - (f(z + 2 * h) - f(z - 2 * h))) / (12 * h);
}

struct Curve {
  Real x, r, speed, t_x, t_r, curvature_s, curvature_phi;
};
Curve curve(const Real &x, const Real &x1, const Real &x2, const Real &r, const Real &r1, const Real &r2) {
  const Real g = sqrt(x1 * x1 + r1 * r1);
  return {x, r, g, x1 / g, r1 / g, (r1 * x2 - x1 * r2) / (g * g * g), x1 / g / r};
}

struct StrongForm {
  bool rubber; // neo-Hookean; otherwise Skalak
  Real dilatation, poisson_ratio, delta;
  Real half_length, radius; // A and B of the reference

  Curve reference(const Real &c, const Real &s) const {
    return curve(-half_length * c, half_length * s, half_length * c, radius * s, radius * c, -radius * s);
  }
  // Fuller behind than in front, with a dent: x = 0.3 exp(-0.7 c) - 0.6 c, r = 0.8 s exp(0.4 c) (c, s of z).
  static Curve deformed(const Real &c, const Real &s) {
    const Real e = Real(0.3) * exp(Real(-0.7) * c), b = Real(0.7);
    const Real f = Real(0.8) * exp(Real(0.4) * c), a = Real(0.4);
    return curve(e - Real(0.6) * c, b * s * e + Real(0.6) * s, b * (c + b * s * s) * e + Real(0.6) * c, s * f,
                 (c - a * s * s) * f, -s * (1 + 3 * a * c - a * a * s * s) * f);
  }

  Real tension(const Real &a, const Real &b) const {
    const Real j = a * b;
    return rubber ? Real((a * a - 1 / (j * j)) / j)
                  : Real((a * a * (a * a - 1) + dilatation * j * j * (j * j - 1)) / j);
  }
  struct Resultants {
    Real t_s, t_phi, m_s, m_phi;
    Curve now;
  };
  Resultants at(const Real &z) const {
    const Real c = cos(z), s = sin(z);
    const Curve now = deformed(c, s), before = reference(c, s);
    const Real a = now.speed / before.speed, b = now.r / before.r;
    const Real k_s = a * now.curvature_s - before.curvature_s;
    const Real k_phi = b * now.curvature_phi - before.curvature_phi;
    return {tension(a, b), tension(b, a), delta / b * (k_s + poisson_ratio * k_phi),
            delta / a * (k_phi + poisson_ratio * k_s), now};
  }

  // Transverse shear N.
  Real shear(const Real &z) const {
    const Resultants here = at(z);
    const Function r_moment = [this](const Real &y) {
      const Resultants there = at(y);
      return Real(there.now.r * there.m_s);
    };
    return (slope(r_moment, z) / here.now.speed - here.m_phi * here.now.t_r) / here.now.r;
  }
  // Axial and radial components of q.
  Eigen::Vector2d load(const Real &z) const {
    const auto [t_s, t_phi, m_s, m_phi, now] = at(z);
    const Function r_shear = [this](const Real &y) { return Real(at(y).now.r * shear(y)); };
    const Function meridional_tension = [this](const Real &y) { return at(y).t_s; };
    const Real along = slope(meridional_tension, z) / now.speed + now.t_r / now.r * (t_s - t_phi) +
                       now.curvature_s * shear(z);
    const Real out =
        -now.curvature_s * t_s - now.curvature_phi * t_phi + slope(r_shear, z) / now.speed / now.r;
    return {static_cast<double>(along * now.t_x - out * now.t_r),
            static_cast<double>(along * now.t_r + out * now.t_x)};
  }
};

} // namespace

BOOST_AUTO_TEST_SUITE(load)

BOOST_AUTO_TEST_CASE(load_is_that_of_eq_7) {
  for (const Case &physics : all_laws(2e-2)) {
    const bool rubber = physics.membrane.law.is(neo_hookean);
    const Real c = rubber ? 0 : physics.membrane.law.values()[0], radius = 0.9 / std::cbrt(0.7);
    const StrongForm exact{.rubber = rubber,
                           .dilatation = c,
                           .poisson_ratio = rubber ? Real(0.5) : Real(c / (1 + c)),
                           .delta = 2e-2,
                           .half_length = Real(0.7) * radius,
                           .radius = radius};
    double previous = 1;
    for (const int nodes : {16, 32, 64}) {
      const Membrane membrane = spectral_membrane(physics, nodes);
      Vector position(2 * nodes), load(2 * nodes);
      for (int j = 0; j < nodes; ++j) {
        const Real z = membrane.basis.nodes(j);
        const Curve shape = exact.at(z).now;
        position(j) = static_cast<double>(shape.x);
        position(nodes + j) = static_cast<double>(shape.r);
        const Eigen::Vector2d q = exact.load(z);
        load(j) = q(0);
        load(nodes + j) = q(1);
      }
      const double error = largest(membrane_load(membrane, position) - load) / largest(load);
      BOOST_TEST_MESSAGE("load of eq. 7, " << nodes << " nodes: relative error " << error);
      BOOST_TEST(error < previous / 20);
      previous = error;
    }
    BOOST_TEST(previous < 1e-8);
  }
}

BOOST_AUTO_TEST_CASE(nodal_load_of_splines_is_refused) {
  const Membrane membrane = spline_membrane(capsule_case(0.8, 1, neo_hookean, 1e-3), 16);
  BOOST_CHECK_THROW(membrane_load(membrane, membrane.reference), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(nodes_share_the_area_of_the_sphere) {
  const Membrane membrane = spectral_membrane(capsule_case(0.8, 1, neo_hookean, 0), 20);
  Vector shifted = 1.5 * membrane.reference;
  shifted.head(20).array() += 3;
  BOOST_TEST(nodal_area(membrane, shifted).sum() == 4 * pi * 1.44, tt::tolerance(1e-13));
}

// With frozen areas the load changes as the force on a node does.
BOOST_AUTO_TEST_CASE(jacobians_are_the_load_s) {
  constexpr double capillary_number = 0.3;
  for (const Case &physics : all_laws(1e-2)) {
    const Membrane membrane = spectral_membrane(physics, 20);
    const Vector position = random_position(membrane, 61);
    const Vector direction = random_direction(position.size(), 62);
    const Vector area = nodal_area(membrane, position).replicate(2, 1);
    const std::function<Vector(double)> load = [&](double step) -> Vector {
      return membrane_load(membrane, position + step * direction) / capillary_number;
    };
    const std::function<Vector(double)> force = [&](double step) -> Vector {
      return load(step).cwiseProduct(nodal_area(membrane, position + step * direction).replicate(2, 1));
    };
    const Vector exact = load_jacobian(membrane, position, capillary_number) * direction;
    const Vector frozen = frozen_load_jacobian(membrane, position, capillary_number) * direction;
    BOOST_TEST(largest(exact - derivative(load, 2e-4)) < 1e-9 * largest(exact));
    BOOST_TEST(largest(frozen.cwiseProduct(area) - derivative(force, 2e-4)) <
               1e-9 * largest(frozen.cwiseProduct(area)));
    BOOST_TEST(largest(exact - frozen) > 1e-3 * largest(exact));
  }
}

// Laplace's law, p = 2 T_0/a: the bending moments of a sphere vanish at any size. 2 T_0/G by hand, for 5 %.
BOOST_AUTO_TEST_CASE(an_inflated_sphere_rests_under_its_pressure) {
  struct Row {
    MembraneLaw law;
    double pressure;
  };
  for (const Row &row : {Row{neo_hookean, 0.5075692}, Row{{skalak, {1}}, 0.6801913}}) {
    Case physics = capsule_case(0.9, 1, row.law, 1e-2);
    physics.capsule.inflation = 0.05;
    const Membrane membrane = spectral_membrane(physics, 24);
    const Vector normal = membrane.initial / 0.9;
    BOOST_TEST(largest(membrane_load(membrane, membrane.initial) + row.pressure / 0.9 * normal) < 1e-7);
  }
}

BOOST_AUTO_TEST_SUITE_END()
