// The membrane's strain and energy against exact shapes and virtual work.
#include "membrane/load.hpp"
#include "membranes.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <tuple>

using namespace capsule;
using std::numbers::pi;
namespace tt = boost::test_tools;

BOOST_AUTO_TEST_CASE(spheroid_has_its_volume_area_and_curvatures) {
  const Case physics = capsule_case(std::cbrt(0.28), 0.28, neo_hookean, 0); // B = 1
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
  const Case physics = capsule_case(0.8, 0.28, {skalak, {1}}, 1e-2);
  for (const Membrane &membrane : {spectral_membrane(physics, 48), spline_membrane(physics, 48)}) {
    BOOST_TEST(elastic_energy(membrane, membrane.reference) < 1e-20);
    BOOST_TEST(largest(energy_gradient(membrane, membrane.reference)) < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(poles_have_one_stretch_and_one_curvature) {
  for (const Case &physics : all_laws(1e-2)) {
    for (const Membrane &membrane : {spectral_membrane(physics, 40), spline_membrane(physics, 100)}) {
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
        // Both are even: next to the pole they differ from it by the distance squared, with splines by its product
        // with the length of an element, because their second derivatives bend at the pole.
        const double close = membrane.basis.spline ? 10 * tolerance : tolerance;
        for (const Vector *field : {meridional, azimuthal}) {
          BOOST_TEST((*field)(0) == (*field)(1), tt::tolerance(close));
          BOOST_TEST((*field)(3) == (*field)(2), tt::tolerance(close));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(inflated_sphere) {
  const double radius = 0.8, s = 1.3;
  for (const auto &[law, tension] :
       {std::pair(MembraneLaw(neo_hookean), 1 - std::pow(s, -6)),
        std::pair(MembraneLaw(skalak, {0.5}), s * s - 1 + 0.5 * s * s * (s * s * s * s - 1))}) {
    const Case physics = capsule_case(radius, 1, law, 1e-2);
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
      work << at.even[0].transposed_times(pull.cwiseProduct(shape.normal_x)),
          at.odd[0].transposed_times(pull.cwiseProduct(shape.normal_r));
      Vector difference = energy_gradient(membrane, position) - work;
      if (membrane.basis.spline) { // the poles stay on the axis: what holds them there is no load
        difference(n) = difference(2 * n - 1) = 0;
      }
      // The curvature of a spline's sphere is good to about 1e-4.
      BOOST_TEST(largest(difference) < (membrane.basis.spline ? 1e-4 : 1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(dilated_sphere_does_not_bend) {
  // The gradient is the same with and without bending stiffness, up to the rounding of second derivatives
  // that are differentiated twice again: N^4 times 2e-16.
  for (const double s : {0.6, 1.0, 2.0}) {
    const Membrane soft = spectral_membrane(capsule_case(1, 1, {skalak, {0}}, 0), 30);
    const Membrane stiff = spectral_membrane(capsule_case(1, 1, {skalak, {0}}, 1), 30);
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
          if (membrane.basis.spline) { // the poles stay on the axis
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
          if (membrane.basis.spline) {
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
