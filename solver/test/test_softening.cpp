// Where a law softens: on spheres that are compressed evenly, and against the waves of the whole energy.
#include "membrane/load.hpp"
#include "membrane/softening.hpp"
#include "membranes.hpp"
#include <Eigen/Eigenvalues>
#include <boost/test/unit_test.hpp>
#include <cmath>

using namespace capsule;

namespace {

const MembraneLaw skalak_0{skalak, {0}};

Membrane sphere(const MembraneLaw &law, int nodes, double bending_ratio = 0) {
  return spectral_membrane(capsule_case(1, 1, law, bending_ratio), nodes);
}

SoftestPoint compressed(const MembraneLaw &law, double stretch) {
  const Membrane membrane = sphere(law, 16);
  return softest_point(membrane, stretch * membrane.initial);
}

// The most negative energy of a displacement of a compressed sphere, over the square of its mean.
double least_rigidity(double stretch, int nodes) {
  const Membrane membrane = sphere(skalak_0, nodes, 1);
  const Vector position = stretch * membrane.initial;
  const Vector root = nodal_area(membrane, position).replicate(2, 1).cwiseSqrt().cwiseInverse();
  const Matrix rigidity = root.asDiagonal() * energy_hessian(membrane, position) * root.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Matrix>(rigidity, Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
}

} // namespace

BOOST_AUTO_TEST_SUITE(softening)

// Skalak's law with C = 0 resists as long as 3 lambda_s^2 > 1, the neo-Hookean law always.
BOOST_AUTO_TEST_CASE(evenly_compressed_spheres) {
  const double limit = 1 / std::sqrt(3.0);
  BOOST_TEST(std::abs(compressed(skalak_0, limit).stiffness) < 1e-9);
  BOOST_TEST(!softens(compressed(skalak_0, 1.01 * limit)));
  BOOST_TEST(softens(compressed(skalak_0, 0.99 * limit)));
  BOOST_TEST(compressed(skalak_0, 0.99 * limit).stretch_meridional == 0.99 * limit,
             boost::test_tools::tolerance(1e-9));
  for (const double stretch : {0.1, 0.5, 2.0})
    BOOST_TEST(!softens(compressed(neo_hookean, stretch)));
}

// A membrane with surface viscosity slows its short waves.
BOOST_AUTO_TEST_CASE(a_viscous_membrane_is_not_asked) {
  Case physics = capsule_case(1, 1, skalak_0, 0);
  const Membrane membrane = sphere(skalak_0, 16);
  BOOST_TEST(softest_if_elastic(physics.membrane, membrane, membrane.initial).has_value());
  physics.membrane.viscosity.shear = 1;
  BOOST_TEST(!softest_if_elastic(physics.membrane, membrane, membrane.initial).has_value());
}

// Bending holds waves along the normal. Of waves along the meridian those of a softened membrane gain energy with the
// square of their number; before that none gains any.
BOOST_AUTO_TEST_CASE(short_waves_of_a_softened_membrane) {
  const double softened = least_rigidity(0.5, 24);
  BOOST_TEST(softened < 0);
  BOOST_TEST(least_rigidity(0.5, 48) == 4 * softened, boost::test_tools::tolerance(0.1));
  BOOST_TEST(least_rigidity(0.62, 48) > 1e-6 * softened); // a translation gains nothing
}

BOOST_AUTO_TEST_SUITE_END()
