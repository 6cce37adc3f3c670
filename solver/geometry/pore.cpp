#include "geometry/pore.hpp"
#include "base/failure.hpp"
#include "geometry/quadrature.hpp"
#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <utility>

namespace capsule {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool right_angled(const Pore &pore) {
  return pore.cosine == 0;
}

// The hyperbola is traced by w >= 0:
//   x = -k c sinh w,  r = sqrt(1 + k^2 sinh^2 w),  k = cos(alpha), c = cot(alpha),
// whose speed k c cosh^2 w/r is analytic in a strip of half-width pi/2 whatever alpha is: equal steps in w
// resolve the lip, where the radius of curvature is c^2.
struct HyperbolaPoint {
  double x, r, slope_x, slope_r; // position and derivative with respect to w
};

HyperbolaPoint hyperbola_point(const Pore &pore, double w) {
  const double k = pore.cosine, c = k / pore.sine;
  const double sine = std::sinh(w), cosine = std::cosh(w);
  const double r = std::hypot(1.0, k * sine);
  return {-k * c * sine, r, -k * c * cosine, k * k * sine * cosine / r};
}

double hyperbola_speed(const Pore &pore, double w) {
  const HyperbolaPoint p = hyperbola_point(pore, w);
  return std::hypot(p.slope_x, p.slope_r);
}

// Arc length between two w.
double hyperbola_arc(const Pore &pore, double w_begin, double w_end) {
  static const GaussRule rule = gauss_legendre(20);
  const int pieces = static_cast<int>(std::ceil(std::abs(w_end - w_begin))) + 1;
  const double width = (w_end - w_begin) / pieces;
  double arc = 0;
  for (int i = 0; i < pieces; ++i) {
    const double from = w_begin + i * width, to = w_begin + (i + 1) * width;
    const double middle = (from + to) / 2, half = (to - from) / 2;
    double sum = 0;
    for (Eigen::Index k = rule.size() / 2; k < rule.size(); ++k) { // nodes lie in pairs
      const double step = half * rule.nodes[k];
      sum += (hyperbola_speed(pore, middle + step) + hyperbola_speed(pore, middle - step)) * rule.weights[k];
    }
    arc += half * sum;
  }
  return arc;
}

// Inverse of hyperbola_arc: Newton's method from the right, where the arc is a convex function of w.
double hyperbola_parameter(const Pore &pore, double arc) {
  if (arc <= 0)
    return 0;
  const double k = pore.cosine; // arc > |x|, arc > r - 1
  double w = std::asinh(std::min(arc * pore.sine / (k * k), std::sqrt(arc * (arc + 2)) / k));
  double beyond = hyperbola_arc(pore, 0, w) - arc;
  for (int i = 0; i < 100; ++i) {
    const double step = beyond / hyperbola_speed(pore, w);
    if (std::abs(step) <= 4e-16 * w)
      break;
    beyond -= hyperbola_arc(pore, w - step, w); // shorter than the whole arc
    w -= step;
  }
  return w;
}

// Signed distance to the hyperbola of a point with x < 0. With t = sinh(w) the foot is the root of
//   f(t) = (t/sin^2 - r t/rho) cos^2 + cos cot x,  rho^2 = 1 + cos^2 t^2,
// half the derivative of the squared distance. The solid wall is convex, so the foot of a point of the liquid
// is unique: f changes sign there once.
double hyperbola_distance(const Pore &pore, double x, double r) {
  const double k = pore.cosine, c = k / pore.sine;
  const auto radius = [&](double t) { return std::sqrt(1 + k * k * t * t); };
  const auto condition = [&](double t) {
    const double rho = radius(t), flat = 1 / (pore.sine * pore.sine);
    return std::pair(k * k * t * (flat - r / rho) + k * c * x, k * k * (flat - r / (rho * rho * rho)));
  };
  // The foot lies between the lip and the point of the wall at the distance of (x, r) from the origin, or at its x.
  const double farthest = (std::hypot(x, r) + 1) * pore.sine / (k * k);
  constexpr int digits = 48; // binary, of 53
  const double t = boost::math::tools::newton_raphson_iterate(condition, -x / (k * c), 0.0, farthest, digits);
  const double distance = std::hypot(x + k * c * t, r - radius(t));
  return r <= wall_radius(pore, x) ? distance : -distance;
}

// Behind a second lip the wall is the mirror image of that before the first.
bool behind_exit(const Pore &pore, double x) {
  return pore.shape == PoreShape::two_mouths && x > pore.exit_x;
}

double right_angle_distance(double x, double r) {
  return r > 1 ? -x : std::hypot(x, 1 - r);
}

} // namespace

std::optional<Pore> make_pore(const PoreSpec &spec) {
  if (spec.shape == PoreShape::none)
    return std::nullopt;
  const double degrees = spec.opening_angle_deg;
  if (!(degrees > 0 && degrees <= 90))
    throw InputError(fmt::format("pore.opening_angle_deg = {} is not in (0, 90]", degrees));
  if (!(spec.exit_x > 0))
    throw InputError(fmt::format("pore.exit_x = {} is not positive", spec.exit_x));
  if (!(spec.entrance_distance > 1))
    throw InputError(fmt::format("pore.entrance_distance = {} is not above 1", spec.entrance_distance));
  const double alpha = degrees * std::numbers::pi / 180;
  Pore pore;
  pore.shape = spec.shape;
  pore.sine = std::sin(alpha);
  pore.cosine = degrees == 90 ? 0 : std::cos(alpha);
  return with_ends(pore, spec.exit_x, spec.entrance_distance);
}

Pore with_ends(Pore pore, double exit_x, double entrance_distance) {
  pore.exit_x = exit_x;
  pore.entrance_distance = entrance_distance;
  const double reach = std::sqrt(pore.entrance_distance * pore.entrance_distance - 1);
  if (pore.shape == PoreShape::tube)
    pore.entrance_arc = pore.exit_x + pore.entrance_distance;
  else if (right_angled(pore))
    pore.entrance_arc = pore.exit_x + pore.entrance_distance - 1;
  else // on the cap r = cosh u with sinh u = sin(alpha) reach = k sinh w
    pore.entrance_arc = pore.exit_x + hyperbola_arc(pore, 0, std::asinh(pore.sine * reach / pore.cosine));
  if (pore.shape == PoreShape::two_mouths)
    pore.exit_arc = pore.exit_x - pore.entrance_arc;
  pore.end_of_way =
      end_of_way({.shape = pore.shape, .exit_x = exit_x, .entrance_distance = entrance_distance});
  return pore;
}

WallPoint wall_point(const Pore &pore, double arc) {
  if (arc < 0) {
    const WallPoint image = wall_point(pore, pore.exit_x - arc);
    return {pore.exit_x - image.x, image.r, -image.normal_x, image.normal_r};
  }
  const double beyond = arc - pore.exit_x; // of the lip
  if (pore.shape == PoreShape::tube || beyond <= 0)
    return {-beyond, 1, 0, 1};
  if (right_angled(pore))
    return {0, 1 + beyond, 1, 0};
  const HyperbolaPoint p = hyperbola_point(pore, hyperbola_parameter(pore, beyond));
  const double speed = std::hypot(p.slope_x, p.slope_r);
  return {p.x, p.r, p.slope_r / speed, -p.slope_x / speed};
}

double wall_radius(const Pore &pore, double x) {
  if (behind_exit(pore, x))
    return wall_radius(pore, pore.exit_x - x);
  if (pore.shape == PoreShape::tube || x >= 0)
    return 1;
  return right_angled(pore) ? infinity : std::hypot(1.0, x * pore.sine / pore.cosine);
}

double wall_slope(const Pore &pore, double x) {
  if (behind_exit(pore, x))
    return -wall_slope(pore, pore.exit_x - x);
  if (pore.shape == PoreShape::tube || x >= 0)
    return 0;
  const double tangent = pore.sine / pore.cosine;
  return right_angled(pore) ? -infinity : tangent * tangent * x / wall_radius(pore, x);
}

double wall_distance(const Pore &pore, double x, double r) {
  if (behind_exit(pore, x))
    return wall_distance(pore, pore.exit_x - x, r);
  if (pore.shape == PoreShape::tube || x >= 0)
    return 1 - r;
  return right_angled(pore) ? right_angle_distance(x, r) : hyperbola_distance(pore, x, r);
}

} // namespace capsule
