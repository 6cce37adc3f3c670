// Derivatives of the steady equations and of their solutions with respect to keys of the case: against exact
// dependences, differences of solutions, and the scaling of an unbounded flow.
#include "case/key_path.hpp"
#include "law/evans_skalak.hpp"
#include "law/generalised_hooke.hpp"
#include "law/mooney_rivlin.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "steady/mesh_change.hpp"
#include "steady/newton.hpp"
#include "steady/slopes.hpp"
#include "steady/steady_state.hpp"
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace capsule;

namespace {

Case skalak_case() {
  Case input;
  input.membrane.law = {skalak, {0.7}};
  input.membrane.bending_ratio = 1e-2;
  input.capsule.radius = 0.7;
  input.capsule.aspect_ratio = 0.8;
  input.flow.capillary_number = 0.05;
  input.mesh.membrane = 48;
  return input;
}

Case extension_case() {
  Case input = skalak_case();
  input.capsule.radius = 1;
  input.pore.shape = PoreShape::none;
  input.flow.type = FlowType::extension;
  return input;
}

// A shape that is not steady.
Vector some_unknowns(SteadySystem &system) {
  const Eigen::Index n = system.nodes();
  const auto zeta = system.membrane().basis.nodes.array();
  Vector unknowns = system.initial();
  unknowns.head(n).array() += 0.02 * (3 * zeta).cos() + 0.03 * (2 * zeta).cos();
  unknowns.segment(n, n).array() += 0.02 * zeta.sin() - 0.01 * (4 * zeta).sin();
  system.fit_tube(unknowns);
  return unknowns;
}

Vector slope(SteadySystem &system, const Vector &unknowns, const std::string &key) {
  return slopes(system, unknowns, system.linearise(unknowns), std::span(&key, 1));
}

double largest(const Vector &v) {
  return v.cwiseAbs().maxCoeff();
}

Vector residual_of(SteadySystem &system, const Case &input, const Vector &unknowns) {
  system.set_parameters(input);
  return system.residual(unknowns);
}

// Against differences of the whole residual, of sixth order.
void check_slope(SteadySystem &system, const Case &input, const Vector &unknowns, const std::string &key) {
  const double value = number(key, input);
  const auto at = [&](double step) {
    return residual_of(system, with_number(input, key, value + step), unknowns);
  };
  constexpr double h = 1e-3;
  const Vector difference =
      (45 * (at(h) - at(-h)) - 9 * (at(2 * h) - at(-2 * h)) + at(3 * h) - at(-3 * h)) / (60 * h);
  system.set_parameters(input);
  BOOST_TEST(largest(slope(system, unknowns, key) - difference) < 1e-8 * largest(difference), key);
}

} // namespace

BOOST_AUTO_TEST_SUITE(slopes_along_keys)

// The residual is A + B/epsilon, linear in the bending stiffness, and in Skalak's C without bending: two values give
// these slopes without any error of differences.
BOOST_AUTO_TEST_CASE(exact_dependences) {
  for (const Case &input : {skalak_case(), extension_case()}) {
    const auto system = system_on_mesh(input, spectral_basis(48).nodes);
    const Vector unknowns = some_unknowns(*system);
    const auto at = [&](const std::string &key, double value) {
      return residual_of(*system, with_number(input, key, value), unknowns);
    };
    const double epsilon = input.flow.capillary_number;
    const Vector by_inverse =
        (at("flow.capillary_number", epsilon) - at("flow.capillary_number", 2 * epsilon)) * 2 * epsilon;
    const Vector by_stiffness = (at("membrane.bending_ratio", 1e-2) - at("membrane.bending_ratio", 0)) / 1e-2;
    system->set_parameters(input);
    BOOST_TEST(largest(slope(*system, unknowns, "flow.capillary_number") + by_inverse / (epsilon * epsilon)) <
               1e-9 * largest(by_inverse) / (epsilon * epsilon));
    BOOST_TEST(largest(slope(*system, unknowns, "membrane.bending_ratio") - by_stiffness) <
               1e-9 * largest(by_stiffness));
    system->set_parameters(with_number(input, "membrane.bending_ratio", 0));
    const Vector without = slope(*system, unknowns, "membrane.dilatation");
    Case thin = with_number(input, "membrane.bending_ratio", 0);
    const Vector above = residual_of(*system, with_number(thin, "membrane.dilatation", 1.7), unknowns);
    const Vector difference = above - residual_of(*system, thin, unknowns);
    BOOST_TEST(largest(without - difference) < 1e-9 * largest(difference));
  }
}

// Keys that change the undeformed shape, and parameters of laws, zero too.
BOOST_AUTO_TEST_CASE(differences_of_the_residual) {
  for (const Case &input : {skalak_case(), extension_case()}) {
    const auto system = system_on_mesh(input, spectral_basis(48).nodes);
    const Vector unknowns = some_unknowns(*system);
    check_slope(*system, input, unknowns, "capsule.radius");
    check_slope(*system, input, unknowns, "capsule.aspect_ratio");
    for (const double dilatation : {0.7, 0.0}) {
      check_slope(*system, with_number(input, "membrane.dilatation", dilatation), unknowns,
                  "membrane.dilatation");
    }
    for (const double inflation : {0.0, 1e-7, 0.05})
      check_slope(*system, with_number(input, "capsule.inflation", inflation), unknowns, "capsule.inflation");
    Case other = input;
    other.membrane.law = {mooney_rivlin, {0.3}};
    check_slope(*system, other, unknowns, "membrane.psi");
    other.membrane.law = {generalised_hooke, {0.3}};
    check_slope(*system, other, unknowns, "membrane.poisson_ratio");
    other.membrane.law = {evans_skalak, {2}};
    check_slope(*system, other, unknowns, "membrane.area_modulus");
    system->set_parameters(input);
    const Eigen::Index volume = unknowns.size() - 1;
    const double area = 4 * std::numbers::pi * std::pow(input.capsule.radius, 2);
    BOOST_TEST(std::abs(slope(*system, unknowns, "capsule.radius")[volume] + area) < 1e-9);
  }
}

// What a steady state does not depend on has no slope at all, and the system keeps its parameters.
BOOST_AUTO_TEST_CASE(keys_without_effect) {
  Case input = skalak_case();
  input.membrane.law = neo_hookean;
  const auto system = system_on_mesh(input, spectral_basis(48).nodes);
  const Vector unknowns = some_unknowns(*system);
  const Vector before = system->residual(unknowns);
  const std::array<std::string, 4> keys{"flow.viscosity_ratio", "membrane.dilatation", "capsule.start_x",
                                        "capsule.radius"};
  const Matrix slope = slopes(*system, unknowns, system->linearise(unknowns), keys);
  BOOST_TEST(slope.leftCols(3).cwiseAbs().maxCoeff() == 0);
  BOOST_TEST(slope.col(3).cwiseAbs().maxCoeff() > 1);
  BOOST_TEST((system->residual(unknowns).array() == before.array()).all());
}

// Differences of steady states approach the sensitivities with the square of the step.
BOOST_AUTO_TEST_CASE(sensitivities_are_limits_of_differences) {
  for (const Case &input : {skalak_case(), extension_case()}) {
    SteadyState state{system_on_mesh(input, spectral_basis(48).nodes), {}};
    const SteadyState found = find_steady(input, {}, {});
    state.unknowns = solve_steady(*state.system, moved_to(*state.system, *found.system, found.unknowns));
    const std::array<std::string, 5> keys{"flow.capillary_number", "capsule.radius", "capsule.aspect_ratio",
                                          "membrane.bending_ratio", "membrane.dilatation"};
    const Matrix slope = sensitivities(*state.system, state.unknowns, keys);
    for (Eigen::Index k = 0; k < slope.cols(); ++k) {
      const std::string &key = keys[static_cast<std::size_t>(k)];
      const double value = number(key, input);
      const auto error = [&](double relative) {
        const double h = relative * value;
        const auto at = [&](double step) {
          state.system->set_parameters(with_number(input, key, value + step));
          return solve_steady(*state.system, state.unknowns + step * slope.col(k));
        };
        return largest((at(h) - at(-h)) / (2 * h) - slope.col(k)) / largest(slope.col(k));
      };
      const double coarse = error(0.04), fine = error(0.02);
      BOOST_TEST(fine < 0.01);
      BOOST_TEST(std::abs(coarse / fine - 4) < 0.2, key << ": " << coarse << " " << fine);
    }
  }
}

// Without walls a capsule of radius a is a times the one of radius 1 at the capillary number a epsilon and the bending
// stiffness delta/a^2: du/da = u + epsilon du/d epsilon - 2 delta du/d delta at a = 1, for positions.
BOOST_AUTO_TEST_CASE(scaling_in_an_unbounded_flow) {
  const Case input = extension_case();
  SteadyState state = find_steady(input, {}, {});
  const std::array<std::string, 3> keys{"capsule.radius", "flow.capillary_number", "membrane.bending_ratio"};
  const Matrix slope = sensitivities(*state.system, state.unknowns, keys);
  const Vector scaled = state.unknowns + input.flow.capillary_number * slope.col(1) -
                        2 * input.membrane.bending_ratio * slope.col(2);
  const Eigen::Index n2 = 2 * state.system->nodes();
  BOOST_TEST(largest((slope.col(0) - scaled).head(n2)) < 1e-7);
}

BOOST_AUTO_TEST_SUITE_END()
