// Growth rates against the small motions of a sphere at rest in an unbounded liquid, whose waves are Legendre's
// polynomials: rates that were derived on paper and computed apart from this program.
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "steady/growth_rates.hpp"
#include "steady/mesh_change.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>

using namespace capsule;

namespace {

// Rates are scaled with G/(mu a).
Case sphere_at_rest(const MembraneLaw &law, double bending_ratio, double viscosity_ratio) {
  Case physics;
  physics.pore.shape = PoreShape::none;
  physics.capsule.radius = 1;
  physics.membrane.law = law;
  physics.membrane.bending_ratio = bending_ratio;
  physics.flow.capillary_number = 1;
  physics.flow.viscosity_ratio = viscosity_ratio;
  physics.accuracy = 1e-7;
  return physics;
}

Eigen::ArrayXd decay_rates(const Case &physics) {
  const auto system = system_on_mesh(physics, spectral_basis(40).nodes);
  const Eigen::VectorXcd rates = all_growth_rates(*system, system->initial());
  BOOST_TEST(rates.imag().cwiseAbs().maxCoeff() < 1e-9);
  return -rates.real().array();
}

double distance_to(double rate, const Eigen::ArrayXd &rates) {
  return (rates - rate).abs().minCoeff();
}

} // namespace

BOOST_AUTO_TEST_SUITE(growth_rates)

// Each wave has two rates: P_2's are known for several viscosity ratios and with a bending stiffness.
BOOST_AUTO_TEST_CASE(elastic_sphere_at_rest) {
  struct Row {
    double viscosity_ratio, bending_ratio, rate;
  };
  for (const Row &row :
       {Row{1, 0, 0.24835904}, Row{1, 0, 2.20878382}, Row{0.2, 0, 0.380357158}, Row{5, 0, 0.0906330254},
        Row{1, 0, 0.198677815}, Row{1, 0, 0.159827407}, Row{1, 0.01, 0.267989146}, Row{1, 0.01, 2.215868}}) {
    const Eigen::ArrayXd rates =
        decay_rates(sphere_at_rest(neo_hookean, row.bending_ratio, row.viscosity_ratio));
    BOOST_TEST(distance_to(row.rate, rates) < 1e-6, "no rate of " << row.rate);
  }
}

BOOST_AUTO_TEST_CASE(viscous_sphere_at_rest) {
  Case physics = sphere_at_rest(neo_hookean, 0, 1);
  physics.membrane.viscosity.shear = 1;
  const Eigen::ArrayXd rates = decay_rates(physics);
  for (const double rate : {0.204339371, 1.7083879})
    BOOST_TEST(distance_to(rate, rates) < 1e-6, "no rate of " << rate);
}

// As the area becomes constant 1/rate comes to 2 + 23 lambda/16 + mu_s for P_2 and to 2.125 + 1.9 lambda + mu_s for P_3,
// in proportion to 1/C; the dilatational viscosity has no part in it.
BOOST_AUTO_TEST_CASE(sphere_of_constant_area) {
  for (const double lambda : {0.2, 1.0, 5.0})
    for (const SurfaceViscosity viscosity : {SurfaceViscosity{0, 0}, {1, 0}, {10, 2}}) {
      const double limits[] = {2 + 23 * lambda / 16 + viscosity.shear,
                               2.125 + 1.9 * lambda + viscosity.shear};
      for (const double limit : limits) {
        const auto error = [&](double c) {
          Case physics = sphere_at_rest({skalak, {c}}, 0, lambda);
          physics.membrane.viscosity = viscosity;
          return distance_to(limit, 1 / decay_rates(physics));
        };
        const double at_thousand = error(1e3), at_ten_thousand = error(1e4);
        BOOST_TEST_MESSAGE(lambda << ' ' << viscosity.shear << ' ' << limit << ' ' << at_thousand << ' '
                                  << at_ten_thousand);
        BOOST_TEST(at_thousand < 3e-3 * limit);
        BOOST_TEST(std::abs(at_thousand / at_ten_thousand - 10) < 0.3);
      }
    }
}

BOOST_AUTO_TEST_SUITE_END()
