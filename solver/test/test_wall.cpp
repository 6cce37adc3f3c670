// The empty pore against exact solutions.
#include "flow/wall.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

using namespace capsule;

namespace {

constexpr double pi = std::numbers::pi;

Wall pore_wall(double opening_angle_deg) {
  return {make_pore({.opening_angle_deg = opening_angle_deg}).value(), {}};
}

const Wall &papers_wall() {
  static const Wall wall = pore_wall(78.5);
  return wall;
}

} // namespace

BOOST_AUTO_TEST_SUITE(wall)

BOOST_AUTO_TEST_CASE(empty_pore_is_poiseuille_in_the_tube) {
  const Wall &pore = papers_wall();
  Targets points{Vector(6), Vector(6)};
  points.x << 1.5, 3, 5, 8, 11, 13.5;
  points.r << 0, 0.3, 0.9, 0.7, 0.05, 0.5;
  const Vector velocity = pore.base_velocity(points);
  const Vector poiseuille = 2 * (1 - points.r.array().square());
  BOOST_TEST((velocity.head(6) - poiseuille).tail(5).cwiseAbs().maxCoeff() < 1e-6);
  BOOST_TEST(velocity.tail(6).cwiseAbs().tail(5).maxCoeff() < 1e-6);
  const Matrix wall = pore.base_traction(); // arc length from the exit, f_x, f_r
  for (Eigen::Index k = 0; k < wall.rows(); ++k)
    if (wall(k, 0) > 3 && wall(k, 0) < 12)
      BOOST_TEST(std::abs(wall(k, 1) + 4) < 1e-5);
}

// The same flux pi crosses every section of the mouth.
BOOST_AUTO_TEST_CASE(flux_is_conserved_across_the_mouth) {
  const Wall &pore = papers_wall();
  const GaussRule rule = gauss_legendre(24);
  for (const double x : {-3.0, -0.5, -0.02, 0.02, 0.5, 6.0}) {
    const double wall = x < 0 ? std::sqrt(1 + x * x * std::pow(std::tan(78.5 * pi / 180), 2)) : 1;
    const Vector r = wall / 2 * (1 + rule.nodes.array());
    const Vector velocity = pore.base_velocity({Vector::Constant(24, x), r});
    const double flux =
        2 * pi * wall / 2 * rule.weights.dot((velocity.head(24).array() * r.array()).matrix());
    BOOST_TEST(std::abs(flux - pi) < 1e-5);
  }
}

// A square mouth adds half of Sampson's 3 pi for an orifice (Dagan, Weinbaum and Pfeffer: within 1 % of the
// total).
BOOST_AUTO_TEST_CASE(entrance_loss_of_a_square_mouth) {
  const double sampson = 3 * pi / 2;
  BOOST_TEST(std::abs(pore_wall(90).base_pressure_drop() - 8 * 15 - sampson) < 0.01 * (8 * 15 + sampson));
}

// Both mouths add the same (scenes.md, another program: 4.924572 each, to 1e-5), less what the flow costs beyond the
// wall's end.
BOOST_AUTO_TEST_CASE(drop_of_a_pore_with_two_mouths) {
  for (const double length : {4.0, 12.0}) {
    const Wall pore(
        make_pore({.shape = PoreShape::two_mouths, .exit_x = length, .entrance_distance = 60}).value(), {});
    const double drop = 8 * length + 2 * 4.924572;
    BOOST_TEST(std::abs(pore.base_pressure_drop() / drop - 1) < 1e-7);
  }
  const Wall shorter(make_pore({.shape = PoreShape::two_mouths, .exit_x = 4}).value(), {});
  BOOST_TEST(std::abs(shorter.base_pressure_drop() / (8 * 4 + 2 * 4.924572) - 1) < 1e-6);
}

// Half of the pressure drop through a whole hyperboloid, 3 pi sin^3/((1 - cos)^2 (1 + 2 cos)), is what the
// mouth adds, but for the tube that replaces the other half.
BOOST_AUTO_TEST_CASE(entrance_loss_of_the_hyperbolic_mouth) {
  for (const double degrees : {60.0, 78.5}) {
    const double sine = std::sin(degrees * pi / 180);
    const double cosine = std::cos(degrees * pi / 180);
    const double hyperboloid = 3 * pi * std::pow(sine, 3) / (std::pow(1 - cosine, 2) * (1 + 2 * cosine));
    const double loss = pore_wall(degrees).base_pressure_drop() - 8 * 15;
    BOOST_TEST(std::abs(loss - hyperboloid / 2) < 0.02 * loss);
  }
}

// Of equations that do not change when the points are mirrored, but for the outlet's, which is at one end.
BOOST_AUTO_TEST_CASE(mirrored_inverse_is_that_of_the_whole_matrix) {
  constexpr int n = 6;
  const Vector mirror = (Vector(2 * n) << -Vector::Ones(n), Vector::Ones(n)).finished();
  RowMatrix between_points(2 * n, 2 * n);
  for (int i = 0; i < 2 * n; ++i)
    for (int j = 0; j < 2 * n; ++j)
      between_points(i, j) = std::sin(1.0 + 1.3 * i + 2.7 * i * j + 0.4 * j);
  const auto mirrored = [&](int i) { return i < n ? n - 1 - i : 3 * n - 1 - i; };
  RowMatrix symmetric = between_points;
  for (int i = 0; i < 2 * n; ++i)
    for (int j = 0; j < 2 * n; ++j)
      symmetric(i, j) += mirror[i] * mirror[j] * between_points(mirrored(i), mirrored(j));
  RowMatrix whole = RowMatrix::Zero(2 * n + 1, 2 * n + 1);
  const std::vector<Eigen::Index> points = {0, 1, 2, 3, 4, 5, 7, 8, 9, 10, 11, 12};
  whole(points, points) = symmetric;
  for (int i = 0; i <= 2 * n; ++i) {
    whole(i, n) = std::cos(2.0 * i);
    whole(n, i) = std::cos(1 + 5.0 * i);
  }
  RowMatrix of_first_half(n, 2 * n + 1);
  of_first_half << whole.topRows(n / 2), whole.middleRows(n + 1, n / 2);
  const Vector column = whole(points, n);
  const WallInverse inverse(of_first_half, column, whole.row(n));
  const RowMatrix exact = whole.inverse();
  const Vector left_sides = Vector::LinSpaced(2 * n + 1, -1, 2).array().square();
  const double scale = exact.cwiseAbs().maxCoeff();
  BOOST_TEST((inverse.answer(left_sides) - exact * left_sides).cwiseAbs().maxCoeff() < 1e-12 * scale);
  BOOST_TEST(std::abs(inverse.answer_of_outlet(left_sides) - exact.row(n).dot(left_sides)) < 1e-12 * scale);
  BOOST_TEST((inverse.matrix() - exact).cwiseAbs().maxCoeff() < 1e-12 * scale);
  const RowMatrix from_unknowns = exact.topRows(3), answers = from_unknowns * exact;
  const double largest = answers.cwiseAbs().maxCoeff();
  BOOST_TEST((inverse.answers(from_unknowns) - answers).cwiseAbs().maxCoeff() < 1e-12 * largest);
  const RoughMatrix rough = inverse.answers<RoughMatrix>(from_unknowns);
  BOOST_TEST((rough.cast<double>() - answers).cwiseAbs().maxCoeff() < 1e-5 * largest);
  BOOST_CHECK_THROW(WallInverse(of_first_half, Vector::Ones(2L * (n - 1)), whole.row(n)),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
