// The membrane's strain, energy and load against exact shapes, virtual work and an independent form of eq. 7.
#include "membrane/membrane.hpp"
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

using namespace capsule;
using std::numbers::pi;
namespace tt = boost::test_tools;

namespace {

Case capsule_case(double radius, double aspect_ratio, LawName law, double dilatation, double bending_ratio) {
  Case physics;
  physics.capsule.radius = radius;
  physics.capsule.aspect_ratio = aspect_ratio;
  physics.membrane.law = law;
  physics.membrane.dilatation = dilatation;
  physics.membrane.bending_ratio = bending_ratio;
  return physics;
}

// Sampled on the Gauss colatitudes of 5/2 as many nodes.
Membrane spectral_membrane(const Case &physics, int nodes) {
  const MeridianBasis dense = spectral_basis(nodes * 5 / 2);
  return make_membrane(physics, spectral_basis(nodes), dense.nodes, dense.weights);
}

// Quintic splines, sampled in the same way: their shapes have kinks in the fourth derivative only.
Membrane spline_membrane(const Case &physics, int elements) {
  const MeridianBasis dense = spectral_basis(elements * 4);
  return make_membrane(physics, spline_basis(elements, 5), dense.nodes, dense.weights);
}

std::vector<Case> all_laws(double bending_ratio) {
  return {capsule_case(0.9, 0.7, LawName::neo_hookean, 1, bending_ratio),
          capsule_case(0.9, 0.7, LawName::skalak, 0, bending_ratio),
          capsule_case(0.9, 0.7, LawName::skalak, 1.5, bending_ratio)};
}

// A strongly deformed smooth shape: the reference plus random waves of decaying amplitude, parities kept.
Vector random_position(const Membrane &membrane, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> amplitude(-0.15, 0.15);
  const Vector &zeta = membrane.basis.nodes;
  const Eigen::Index n = zeta.size();
  Vector position = membrane.reference;
  for (int k = 1; k <= 5; ++k) {
    position.head(n) += (amplitude(random) / k * (k * zeta).array().cos()).matrix();
    // An even factor keeps r positive.
    position.tail(n).array() *= 1 + amplitude(random) / k * (k * zeta).array().cos();
  }
  position.head(n).array() += 2.5;
  return position;
}

Vector random_direction(Eigen::Index size, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> component(-1, 1);
  return Vector::NullaryExpr(size, [&] { return component(random); });
}

// Derivative at 0 by central differences of eighth order.
template <class Value>
Value derivative(const std::function<Value(double)> &f, double h) {
  const double weight[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  Value sum = weight[0] / h * (f(h) - f(-h));
  for (int k = 2; k <= 4; ++k) {
    sum += weight[k - 1] / h * (f(k * h) - f(-k * h));
  }
  return sum;
}

double largest(const Vector &v) {
  return v.lpNorm<Eigen::Infinity>();
}

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

BOOST_AUTO_TEST_CASE(spheroid_has_its_volume_area_and_curvatures) {
  const Case physics = capsule_case(std::cbrt(0.28), 0.28, LawName::neo_hookean, 1, 0); // B = 1
  const Membrane membrane = spectral_membrane(physics, 40);
  const MembraneState state = membrane_state(membrane, membrane.sampling, membrane.reference);
  const Vector &z = membrane.sampling.zeta, &w = membrane.sampling.weights;
  const double area = 2 * pi * (state.r.array() * state.arc.array()).matrix().dot(w);
  const double volume =
      2 * pi / 3 *
      ((state.x.cwiseProduct(state.normal_x) + state.r.cwiseProduct(state.normal_r)).array() *
       state.r.array() * state.arc.array())
          .matrix()
          .dot(w);
  // A sharp rim: the area's integrand has singularities close to the meridian.
  BOOST_TEST(area == 7.281684, tt::tolerance(1e-7));
  BOOST_TEST(volume == 4 * pi / 3 * 0.28, tt::tolerance(1e-13));
  BOOST_TEST(volume == 1.172861, tt::tolerance(1e-6));
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    const double g = std::hypot(0.28 * std::sin(z(i)), std::cos(z(i)));
    BOOST_TEST(state.curvature_meridional(i) == 0.28 / (g * g * g), tt::tolerance(1e-10));
    BOOST_TEST(state.curvature_azimuthal(i) == 0.28 / g, tt::tolerance(1e-10));
    BOOST_TEST(state.normal_x(i) == -std::cos(z(i)) / g, tt::tolerance(1e-11));
    BOOST_TEST(state.normal_r(i) == 0.28 * std::sin(z(i)) / g, tt::tolerance(1e-11));
  }
}

BOOST_AUTO_TEST_CASE(reference_is_free_of_stress) {
  const Case physics = capsule_case(0.8, 0.28, LawName::skalak, 1, 1e-2);
  for (const Membrane &membrane : {spectral_membrane(physics, 48), spline_membrane(physics, 48)}) {
    BOOST_TEST(elastic_energy(membrane, membrane.reference) < 1e-20);
    BOOST_TEST(largest(energy_gradient(membrane, membrane.reference)) < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(poles_have_one_stretch_and_one_curvature) {
  for (const Case &physics : all_laws(1e-2)) {
    for (const Membrane &membrane : {spectral_membrane(physics, 40), spline_membrane(physics, 160)}) {
      const Vector position = random_position(membrane, 5);
      const Vector zeta = Eigen::Vector4d(0, 1e-4, pi - 1e-4, pi);
      const MembraneState at =
          membrane_state(membrane, sample(membrane.basis, zeta, Vector::Zero(4)), position);
      for (const auto &[meridional, azimuthal, tolerance] :
           {std::tuple(&at.stretch_meridional, &at.stretch_azimuthal, 1e-6),
            std::tuple(&at.tension_meridional, &at.tension_azimuthal, 1e-5),
            std::tuple(&at.curvature_meridional, &at.curvature_azimuthal, 1e-4),
            std::tuple(&at.moment_meridional, &at.moment_azimuthal, 1e-4)}) {
        for (const int pole : {0, 3}) {
          BOOST_TEST((*meridional)(pole) == (*azimuthal)(pole), tt::tolerance(1e-14));
        }
        // Both are even: next to the pole they differ from it by the distance squared.
        for (const Vector *field : {meridional, azimuthal}) {
          BOOST_TEST((*field)(0) == (*field)(1), tt::tolerance(tolerance));
          BOOST_TEST((*field)(3) == (*field)(2), tt::tolerance(tolerance));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(inflated_sphere) {
  const double radius = 0.8, s = 1.3;
  for (const auto &[law, tension] :
       {std::pair(LawName::neo_hookean, 1 - std::pow(s, -6)),
        std::pair(LawName::skalak, s * s - 1 + 0.5 * s * s * (s * s * s * s - 1))}) {
    const Case physics = capsule_case(radius, 1, law, 0.5, 1e-2);
    const double jump = 2 * tension / (s * radius); // q = -jump n
    const Membrane smooth = spectral_membrane(physics, 24);
    const Vector inflated = s * smooth.reference;
    // No moments, whatever the size, so the bending ratio doesn't matter.
    const MembraneState state = membrane_state(smooth, smooth.sampling, inflated);
    BOOST_TEST(largest(state.moment_meridional) < 1e-14);
    BOOST_TEST(largest(state.moment_azimuthal) < 1e-14);
    const Vector load = membrane_load(smooth, inflated);
    BOOST_TEST(largest(load.head(24) - jump * smooth.basis.nodes.array().cos().matrix()) < 1e-11);
    BOOST_TEST(largest(load.tail(24) + jump * smooth.basis.nodes.array().sin().matrix()) < 1e-11);
    // Any basis: dW = -integral of q.dx.
    for (const Membrane &membrane : {smooth, spline_membrane(physics, 40)}) {
      const Sampling &at = membrane.sampling;
      const Vector position = s * membrane.reference;
      const MembraneState shape = membrane_state(membrane, at, position);
      const Vector pull = 2 * pi * jump * shape.r.array() * shape.arc.array() * at.weights.array();
      const Eigen::Index n = membrane.basis.size();
      Vector work(2 * n);
      work << at.even[0].transpose() * pull.cwiseProduct(shape.normal_x),
          at.odd[0].transpose() * pull.cwiseProduct(shape.normal_r);
      Vector difference = energy_gradient(membrane, position) - work;
      if (membrane.basis.spline_degree > 0) { // the poles stay on the axis: what holds them there is no load
        difference(n) = difference(2 * n - 1) = 0;
      }
      // The curvature of a spline's sphere is good to about 1e-7.
      BOOST_TEST(largest(difference) < (membrane.basis.spline_degree == 0 ? 1e-12 : 1e-7));
    }
  }
}

BOOST_AUTO_TEST_CASE(dilated_sphere_does_not_bend) {
  // The gradient is the same with and without bending stiffness, up to the rounding of second derivatives
  // that are differentiated twice again: N^4 times 2e-16.
  for (const double s : {0.6, 1.0, 2.0}) {
    const Membrane soft = spectral_membrane(capsule_case(1, 1, LawName::skalak, 0, 0), 30);
    const Membrane stiff = spectral_membrane(capsule_case(1, 1, LawName::skalak, 0, 1), 30);
    const Vector position = s * soft.reference;
    BOOST_TEST(largest(energy_gradient(stiff, position) - energy_gradient(soft, position)) < 1e-10);
    BOOST_TEST(elastic_energy(stiff, position) == elastic_energy(soft, position), tt::tolerance(1e-13));
  }
}

BOOST_AUTO_TEST_CASE(closed_shapes_feel_no_axial_resultant) {
  for (const Case &physics : all_laws(1e-2)) {
    for (const Membrane &membrane : {spectral_membrane(physics, 40), spline_membrane(physics, 40)}) {
      for (const unsigned seed : {1U, 2U, 3U}) {
        const Vector gradient = energy_gradient(membrane, random_position(membrane, seed));
        BOOST_TEST(largest(gradient) > 1e-2);
        BOOST_TEST(std::abs(gradient.head(membrane.basis.size()).sum()) < 1e-13);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(dilation_works_against_the_tensions_alone) {
  // The integral of q.x is minus that of T_s + T_phi; with the energy of eq. 6 bending has no part in it,
  // since lambda kappa does not change with size.
  for (const double bending_ratio : {0.0, 1e-1}) {
    for (const Case &physics : all_laws(bending_ratio)) {
      const Membrane membrane = spectral_membrane(physics, 40);
      const Vector position = random_position(membrane, 11);
      const MembraneState state = membrane_state(membrane, membrane.sampling, position);
      const double tensions =
          2 * pi *
          ((state.tension_meridional + state.tension_azimuthal).array() * state.r.array() * state.arc.array())
              .matrix()
              .dot(membrane.sampling.weights);
      BOOST_TEST(energy_gradient(membrane, position).dot(position) == tensions, tt::tolerance(1e-11));
    }
  }
}

BOOST_AUTO_TEST_CASE(gradient_is_the_energy_s) {
  for (const double bending_ratio : {0.0, 1e-3, 1.0}) {
    for (const Case &physics : all_laws(bending_ratio)) {
      for (const Membrane &membrane : {spectral_membrane(physics, 20), spline_membrane(physics, 20)}) {
        const Vector position = random_position(membrane, 21);
        const Vector gradient = energy_gradient(membrane, position);
        // Smooth and fully random displacements; the latter bend sharply, so their steps are shorter.
        const Eigen::Index size = position.size();
        for (const unsigned seed : {31U, 32U, 33U}) {
          Vector rough = random_direction(size, seed);
          if (membrane.basis.spline_degree > 0) { // the poles stay on the axis
            rough(size / 2) = rough(size - 1) = 0;
          }
          const Vector smooth = random_position(membrane, seed) - membrane.reference;
          for (const auto &[direction, h] : {std::pair(smooth, 2e-2), std::pair(rough, 2e-4)}) {
            const std::function<double(double)> energy = [&, &direction = direction](double step) {
              return elastic_energy(membrane, position + step * direction);
            };
            const double scale = elastic_energy(membrane, position);
            const double rounding = 1e-14 * scale / h;
            BOOST_TEST(std::abs(gradient.dot(direction) - derivative(energy, h)) <
                       rounding + 1e-10 * std::abs(gradient.dot(direction)));
          }
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(hessian_is_the_gradient_s) {
  for (const double bending_ratio : {0.0, 1e-3, 1.0}) {
    for (const Case &physics : all_laws(bending_ratio)) {
      for (const Membrane &membrane : {spectral_membrane(physics, 20), spline_membrane(physics, 20)}) {
        const Vector position = random_position(membrane, 41);
        const Matrix hessian = energy_hessian(membrane, position);
        BOOST_TEST((hessian - hessian.transpose()).lpNorm<Eigen::Infinity>() <
                   1e-13 * hessian.lpNorm<Eigen::Infinity>());
        const Eigen::Index size = position.size();
        for (const unsigned seed : {51U, 52U}) {
          Vector direction = random_direction(size, seed);
          if (membrane.basis.spline_degree > 0) {
            direction(size / 2) = direction(size - 1) = 0;
          }
          const std::function<Vector(double)> gradient = [&](double step) {
            return energy_gradient(membrane, position + step * direction);
          };
          const Vector exact = hessian * direction;
          BOOST_TEST(largest(exact - derivative(gradient, 2e-4)) < 1e-9 * largest(exact));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(load_is_that_of_eq_7) {
  for (const Case &physics : all_laws(2e-2)) {
    const bool rubber = physics.membrane.law == LawName::neo_hookean;
    const Real c = physics.membrane.dilatation, radius = 0.9 / std::cbrt(0.7);
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
  const Membrane membrane = spline_membrane(capsule_case(0.8, 1, LawName::neo_hookean, 1, 1e-3), 16);
  BOOST_CHECK_THROW(membrane_load(membrane, membrane.reference), std::invalid_argument);
}
