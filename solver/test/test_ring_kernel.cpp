// Ring kernels, every instruction set that runs here: against brute-force integration of eq. 18 in quadruple
// precision, and against the identities of Stokes flow.
#include "integrals/ring_kernel.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

using namespace capsule;

namespace {

constexpr double pi = std::numbers::pi;

struct Components {
  double xx;
  double xr;
  double rx;
  double rr;
};

struct Ring {
  double x;
  double r;
  double normal_x;
  double normal_r;
};

struct Point {
  double x;
  double r;
};

double largest(const Components &c) {
  return std::max({std::abs(c.xx), std::abs(c.xr), std::abs(c.rx), std::abs(c.rr)});
}

double distance(const Components &a, const Components &b) {
  return largest({a.xx - b.xx, a.xr - b.xr, a.rx - b.rx, a.rr - b.rr});
}

// Results for many rings.
struct Rows {
  std::vector<double> xx;
  std::vector<double> xr;
  std::vector<double> rx;
  std::vector<double> rr;
  explicit Rows(std::size_t count) : xx(count), xr(count), rx(count), rr(count) {}
  KernelRow view() { return {xx.data(), xr.data(), rx.data(), rr.data()}; }
  Components operator[](std::size_t k) const { return {xx[k], xr[k], rx[k], rr[k]}; }
};

struct RingArrays {
  std::vector<double> x;
  std::vector<double> r;
  std::vector<double> normal_x;
  std::vector<double> normal_r;
  void add(const Ring &ring) {
    x.push_back(ring.x);
    r.push_back(ring.r);
    normal_x.push_back(ring.normal_x);
    normal_r.push_back(ring.normal_r);
  }
  std::size_t size() const { return x.size(); }
  Ring operator[](std::size_t k) const { return {x[k], r[k], normal_x[k], normal_r[k]}; }
  Rings view() const {
    return {static_cast<int>(x.size()), x.data(), r.data(), normal_x.data(), normal_r.data()};
  }
};

double ln_m1(const Point &target, const Ring &ring) {
  const double nearest = std::hypot(ring.x - target.x, ring.r - target.r);
  const double farthest = std::hypot(ring.x - target.x, ring.r + target.r);
  const double m = 4 * ring.r * target.r / (farthest * farthest);
  return m < 0.5 ? std::log1p(-m) : 2 * std::log(nearest / farthest);
}

Components single(decltype(RingKernel::plain) kernel, const Point &target, const Ring &ring) {
  Components c{};
  kernel(target.x, target.r, {1, &ring.x, &ring.r, &ring.normal_x, &ring.normal_r},
         {&c.xx, &c.xr, &c.rx, &c.rr});
  return c;
}

Components single_split_sum(decltype(RingKernel::split) kernel, const Point &target, const Ring &ring) {
  Components p{};
  Components q{};
  const Rings rings{1, &ring.x, &ring.r, &ring.normal_x, &ring.normal_r};
  kernel(target.r, rings, separations(target.x, target.r, rings), {&p.xx, &p.xr, &p.rx, &p.rr},
         {&q.xx, &q.xr, &q.rx, &q.rr});
  const double l = ln_m1(target, ring);
  return {p.xx - l * q.xx, p.xr - l * q.xr, p.rx - l * q.rx, p.rr - l * q.rr};
}

using Wide = boost::multiprecision::cpp_bin_float_quad;
using WideVector = std::array<Wide, 3>;

Wide dot(const WideVector &a, const WideVector &b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The integrals of eq. 18 by definition, and a measure for the stresslet's error: 3/(4 pi) int 1/rho^2, which
// bounds it for any normal.
struct BruteForce {
  Components stokeslet;
  Components stresslet;
  double stresslet_bound;
  Components source; // alone as xx
  Components dipole;
};

// With tan(phi/2) = e^u the integrand is analytic for |Im u| < pi/2 however near the target is, so the
// trapezoid rule of step h errs by exp(-pi^2/h).
BruteForce brute_force(const Point &target, const Ring &ring) {
  const double nearest = std::hypot(ring.x - target.x, ring.r - target.r);
  const double farthest = std::hypot(ring.x - target.x, ring.r + target.r);
  const double h = 0.2;
  const int first = static_cast<int>(std::floor((std::log(nearest / farthest) - 44) / h));
  const int last = static_cast<int>(std::ceil(44 / h));
  std::array<Wide, 11> sum{};
  const Wide growth = exp(Wide(h));
  Wide t = exp(Wide(first * h));
  for (int i = first; i <= last; ++i) {
    const Wide weight = 4 * h * t / (1 + t * t); // both half circles, d phi = 2 dt/(1 + t^2)
    const Wide cosine = (1 - t * t) / (1 + t * t);
    const Wide sine = 2 * t / (1 + t * t);
    const WideVector difference{Wide(target.x) - ring.x, // x - y of eq. 18, no cancellation in the second
                                Wide(target.r) - ring.r + ring.r * (2 * t * t / (1 + t * t)), -ring.r * sine};
    const WideVector normal{Wide(ring.normal_x), ring.normal_r * cosine, ring.normal_r * sine};
    const std::array<WideVector, 2> at_target{WideVector{1, 0, 0}, WideVector{0, 1, 0}};
    const std::array<WideVector, 2> at_ring{WideVector{1, 0, 0}, WideVector{0, cosine, sine}};
    const Wide rho2 = dot(difference, difference);
    const Wide over_rho = 1 / sqrt(rho2);
    const Wide over_rho3 = over_rho / rho2;
    const Wide k_factor =
        -3 / (4 * boost::math::constants::pi<Wide>()) * dot(difference, normal) * over_rho3 / rho2;
    for (std::size_t a = 0; a < 2; ++a) {
      for (std::size_t b = 0; b < 2; ++b) {
        const Wide product = dot(difference, at_target[a]) * dot(difference, at_ring[b]);
        sum[2 * a + b] += weight * (dot(at_target[a], at_ring[b]) * over_rho + product * over_rho3);
        sum[4 + 2 * a + b] += weight * k_factor * product;
      }
    }
    sum[8] += weight * over_rho * over_rho;
    sum[9] += weight * over_rho;
    sum[10] -= weight * dot(difference, normal) * over_rho3; // from target to ring
    t *= growth;
  }
  std::array<double, 11> result{};
  std::transform(sum.begin(), sum.end(), result.begin(),
                 [](const Wide &value) { return static_cast<double>(value); });
  return {{result[0], result[1], result[2], result[3]},
          {result[4], result[5], result[6], result[7]},
          3 / (4 * pi) * result[8],
          {result[9] / (4 * pi), 0, 0, 0},
          {result[10] / (4 * pi), 0, 0, 0}};
}

struct Case {
  std::string name;
  Point target;
  Ring ring;
};

std::vector<Case> cases() {
  std::mt19937 random(1992);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Case> list;
  const auto add = [&](const std::string &name, const Point &target, double x, double r) {
    const double angle = 2 * pi * uniform(random);
    list.push_back({name, target, {x, std::abs(r), std::cos(angle), std::sin(angle)}});
  };
  const auto add_at_distance = [&](const std::string &name, const Point &target, double d) {
    const double angle = 2 * pi * uniform(random);
    add(name, target, target.x + d * std::cos(angle), target.r + d * std::sin(angle));
  };
  for (int i = 0; i < 8; ++i) {
    add("apart", {2 * uniform(random) - 1, uniform(random)}, 2 * uniform(random) - 1, uniform(random));
  }
  for (const double d : {1e-2, 1e-4, 1e-6, 1e-8}) {
    for (int i = 0; i < 3; ++i) {
      add_at_distance("near", {uniform(random), uniform(random)}, d);
    }
  }
  for (const double near_axis : {0.0, 1e-8, 1e-3}) {
    for (int i = 0; i < 2; ++i) {
      add("target near the axis", {uniform(random), near_axis}, uniform(random), uniform(random));
      add("ring near the axis", {uniform(random), uniform(random)}, uniform(random), near_axis);
      add("both near the axis", {uniform(random), near_axis}, uniform(random), 1e-3 * uniform(random));
      add_at_distance("both near the axis and each other", {uniform(random), near_axis}, 1e-6);
    }
  }
  add("both on the axis", {0.25, 0}, 0.5, 0);
  add("in one plane", {0.5, 0.25}, 0.5, 0.75);
  add("on one cylinder", {0.5, 0.25}, 0.75, 0.25);
  add("far", {0, 0.5}, 1e4, 0.7);
  add("far aside", {0, 0.5}, 3, 1e4);
  return list;
}

// A smooth closed meridian (half ellipse), its rings with weights 2 pi free: rows are multiplied with r times
// line element times quadrature weight.
struct Ellipse {
  double length;
  double radius;
  Point at(double zeta) const { return {-length * std::cos(zeta), radius * std::sin(zeta)}; }
};

// Rings of a surface of revolution; the weights hold r times the line element, the azimuth is in the kernels.
struct Surface {
  RingArrays rings;
  std::vector<double> weights;
};

// Gauss panels between the given values of zeta.
Surface surface(const Ellipse &ellipse, const std::vector<double> &ends) {
  using Rule = boost::math::quadrature::gauss<double, 20>;
  Surface result;
  for (std::size_t panel = 0; panel + 1 < ends.size(); ++panel) {
    const double half = (ends[panel + 1] - ends[panel]) / 2;
    const double middle = (ends[panel + 1] + ends[panel]) / 2;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      for (const double sign : {-1.0, 1.0}) {
        const double zeta = middle + sign * half * Rule::abscissa()[i];
        const Point p = ellipse.at(zeta);
        const double dx = ellipse.length * std::sin(zeta);
        const double dr = ellipse.radius * std::cos(zeta);
        const double g = std::hypot(dx, dr);
        result.rings.add({p.x, p.r, -dr / g, dx / g});
        result.weights.push_back(half * Rule::weights()[i] * g * p.r);
      }
    }
  }
  return result;
}

std::vector<double> even_panels(double from, double to, int count) {
  std::vector<double> ends;
  for (int i = 0; i <= count; ++i) {
    ends.push_back(from + (to - from) * i / count);
  }
  return ends;
}

Surface whole_surface(const Ellipse &ellipse) {
  return surface(ellipse, even_panels(0, pi, 10));
}

// Panels from an end that become ever smaller towards zeta.
std::vector<double> graded_panels(double from, double zeta) {
  std::vector<double> ends;
  for (double length = zeta - from; std::abs(length) > 1e-11; length /= 3) {
    ends.push_back(zeta - length);
  }
  ends.push_back(zeta);
  return ends;
}

using Velocity = std::array<double, 2>;
using Density = std::function<Velocity(const Ring &)>;

Velocity weighted_sum(const Surface &surface, const Rows &rows, const Density &density) {
  Velocity velocity{0, 0};
  for (std::size_t k = 0; k < surface.rings.size(); ++k) {
    const auto [fx, fr] = density(surface.rings[k]);
    velocity[0] += surface.weights[k] * (rows.xx[k] * fx + rows.xr[k] * fr);
    velocity[1] += surface.weights[k] * (rows.rx[k] * fx + rows.rr[k] * fr);
  }
  return velocity;
}

// Integral over the surface of a kernel times a density (axial and radial): a velocity at the target.
Velocity potential(decltype(RingKernel::plain) kernel, const Point &target, const Surface &surface,
                   const Density &density) {
  Rows rows(surface.rings.size());
  kernel(target.x, target.r, surface.rings.view(), rows.view());
  return weighted_sum(surface, rows, density);
}

// The same on the surface: the smooth part with plain panels, which shows that it is smooth; the logarithmic
// part, whose factor ln(m1) is not, with graded ones.
Velocity potential_on_surface(decltype(RingKernel::split) kernel, const Ellipse &ellipse, double zeta,
                              const Density &density) {
  const Point target = ellipse.at(zeta);
  Velocity velocity{0, 0};
  for (const double end : {0.0, pi}) {
    const Surface plain = surface(ellipse, even_panels(end, zeta, 8));
    Rows smooth(plain.rings.size());
    Rows unused(plain.rings.size());
    kernel(target.r, plain.rings.view(), separations(target.x, target.r, plain.rings.view()), smooth.view(),
           unused.view());
    const Velocity part = weighted_sum(plain, smooth, density);

    Surface graded = surface(ellipse, graded_panels(end, zeta));
    Rows unused_too(graded.rings.size());
    Rows logarithmic(graded.rings.size());
    kernel(target.r, graded.rings.view(), separations(target.x, target.r, graded.rings.view()),
           unused_too.view(), logarithmic.view());
    for (std::size_t k = 0; k < graded.rings.size(); ++k) {
      const Ring ring = graded.rings[k];
      graded.weights[k] *= ln_m1(target, ring);
    }
    const Velocity other_part = weighted_sum(graded, logarithmic, density);
    const double sign = end == 0 ? 1 : -1;
    velocity[0] += sign * (part[0] - other_part[0]);
    velocity[1] += sign * (part[1] - other_part[1]);
  }
  return velocity;
}

Velocity along_axis(const Ring & /*ring*/) {
  return {1, 0};
}
Velocity along_normal(const Ring &ring) {
  return {ring.normal_x, ring.normal_r};
}

// Derivative by central differences of order 8.
double derivative(const std::function<double(double)> &f, double x) {
  const double h = 0.02;
  constexpr std::array<double, 4> weights{4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    sum += weights[i] * (f(x + (i + 1) * h) - f(x - (i + 1) * h));
  }
  return sum / h;
}

} // namespace

BOOST_AUTO_TEST_CASE(kernels_equal_brute_force) {
  for (const Case &c : cases()) {
    const BruteForce exact = brute_force(c.target, c.ring);
    const Ring own{c.target.x, c.target.r, 0.28, 0.96};
    const BruteForce back = brute_force({c.ring.x, c.ring.r}, own);
    const double stokeslet_tolerance = 1e-15 * largest(exact.stokeslet);
    const double stresslet_tolerance = 2e-15 * exact.stresslet_bound;
    for (const RingKernels &kernels : available_ring_kernels()) {
      BOOST_TEST_CONTEXT(c.name << ", " << kernels.instructions << ": target " << c.target.x << ' '
                                << c.target.r << ", ring " << c.ring.x << ' ' << c.ring.r) {
        BOOST_TEST(distance(single(kernels.stokeslet.plain, c.target, c.ring), exact.stokeslet) <
                   stokeslet_tolerance);
        BOOST_TEST(distance(single(kernels.stresslet.plain, c.target, c.ring), exact.stresslet) <
                   stresslet_tolerance);
        BOOST_TEST(distance(single_split_sum(kernels.stokeslet.split, c.target, c.ring), exact.stokeslet) <
                   stokeslet_tolerance);
        BOOST_TEST(distance(single_split_sum(kernels.stresslet.split, c.target, c.ring), exact.stresslet) <
                   stresslet_tolerance);
        const double source_tolerance = 1e-15 * largest(exact.source);
        const double dipole_tolerance = stresslet_tolerance / 3;
        BOOST_TEST(distance(single(kernels.source.plain, c.target, c.ring), exact.source) < source_tolerance);
        BOOST_TEST(distance(single(kernels.dipole.plain, c.target, c.ring), exact.dipole) < dipole_tolerance);
        BOOST_TEST(distance(single_split_sum(kernels.source.split, c.target, c.ring), exact.source) <
                   source_tolerance);
        BOOST_TEST(distance(single_split_sum(kernels.dipole.split, c.target, c.ring), exact.dipole) <
                   dipole_tolerance);
        Components at_target{};
        Components at_ring{};
        kernels.mutual_dipoles(own.x, own.r, own.normal_x, own.normal_r,
                               {1, &c.ring.x, &c.ring.r, &c.ring.normal_x, &c.ring.normal_r}, &at_target.xx,
                               &at_ring.xx);
        BOOST_TEST(distance(at_target, exact.dipole) < dipole_tolerance);
        BOOST_TEST(distance(at_ring, back.dipole) < 2e-15 / 3 * back.stresslet_bound);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(public_functions_are_the_first_available_set) {
  const RingKernels best = available_ring_kernels().front();
  const Point target{0.1, 0.4};
  const Ring ring{0.3, 0.7, 0.6, 0.8};
  BOOST_TEST(distance(single(ring_source.plain, target, ring), single(best.source.plain, target, ring)) == 0);
  BOOST_TEST(distance(single(ring_dipole.plain, target, ring), single(best.dipole.plain, target, ring)) == 0);
  BOOST_TEST(
      distance(single(ring_stokeslet.plain, target, ring), single(best.stokeslet.plain, target, ring)) == 0);
  BOOST_TEST(
      distance(single(ring_stresslet.plain, target, ring), single(best.stresslet.plain, target, ring)) == 0);
  BOOST_TEST(distance(single_split_sum(ring_stokeslet.split, target, ring),
                      single_split_sum(best.stokeslet.split, target, ring)) == 0);
  BOOST_TEST(distance(single_split_sum(ring_stresslet.split, target, ring),
                      single_split_sum(best.stresslet.split, target, ring)) == 0);
}

BOOST_AUTO_TEST_CASE(any_number_of_rings) {
  const int most = 21;
  const double untouched = -7;
  for (const RingKernels &kernels : available_ring_kernels()) {
    for (int count = 0; count <= most; ++count) {
      RingArrays rings;
      for (int k = 0; k < count; ++k) {
        rings.add({0.1 * k, 0.5 + 0.01 * k * k, std::cos(k), std::sin(k)});
      }
      Rows rows(most + 1);
      std::fill(rows.rr.begin(), rows.rr.end(), untouched);
      const Point target{0.33, 0.44};
      kernels.stresslet.plain(target.x, target.r, rings.view(), rows.view());
      Rows scalars(most + 1);
      std::fill(scalars.xx.begin(), scalars.xx.end(), untouched);
      kernels.dipole.plain(target.x, target.r, rings.view(), {scalars.xx.data()});
      for (int k = 0; k < count; ++k) {
        const Components one = single(kernels.stresslet.plain, target, rings[k]);
        BOOST_TEST(distance(rows[k], one) <= 1e-15 * largest(one));
        const Components dipole = single(kernels.dipole.plain, target, rings[k]);
        BOOST_TEST(distance(scalars[k], dipole) <= 1e-15 * largest(dipole));
      }
      BOOST_TEST(rows.rr[count] == untouched);
      BOOST_TEST(scalars.xx[count] == untouched);
    }
  }
}

BOOST_AUTO_TEST_CASE(reciprocity) {
  for (const Case &c : cases()) {
    const Components there = single(ring_stokeslet.plain, c.target, c.ring);
    const Components back =
        single(ring_stokeslet.plain, {c.ring.x, c.ring.r}, {c.target.x, c.target.r, 0, 0});
    BOOST_TEST(distance(there, {back.xx, back.rx, back.xr, back.rr}) < 2e-15 * largest(there));
  }
}

BOOST_AUTO_TEST_CASE(fields_are_free_of_divergence) {
  const Ring ring{0.2, 0.9, 0.6, -0.8};
  for (const auto kernel : {ring_stokeslet.plain, ring_stresslet.plain}) {
    for (const Point p : {Point{-0.7, 0.5}, Point{1.1, 0.3}, Point{0.2, 1.9}}) {
      const auto at = [&](double x, double r) { return single(kernel, {x, r}, ring); };
      const double axial = derivative([&](double x) { return at(x, p.r).xx; }, p.x) +
                           derivative([&](double r) { return at(p.x, r).rx; }, p.r) + at(p.x, p.r).rx / p.r;
      const double radial = derivative([&](double x) { return at(x, p.r).xr; }, p.x) +
                            derivative([&](double r) { return at(p.x, r).rr; }, p.r) + at(p.x, p.r).rr / p.r;
      BOOST_TEST(std::abs(axial) < 1e-10);
      BOOST_TEST(std::abs(radial) < 1e-10);
    }
  }
}

BOOST_AUTO_TEST_CASE(constant_pressure_moves_nothing) {
  const Ellipse ellipsoid{0.5, 0.9};
  for (const Point target : {Point{0.1, 0.3}, Point{0.2, 0}, Point{0.7, 0.7}, Point{-2, 0}}) {
    const auto [vx, vr] = potential(ring_stokeslet.plain, target, whole_surface(ellipsoid), along_normal);
    BOOST_TEST(std::abs(vx) < 2e-14);
    BOOST_TEST(std::abs(vr) < 2e-14);
  }
  for (const double zeta : {0.3, 0.7, 2.0}) {
    const auto [vx, vr] = potential_on_surface(ring_stokeslet.split, ellipsoid, zeta, along_normal);
    BOOST_TEST(std::abs(vx) < 2e-13);
    BOOST_TEST(std::abs(vr) < 2e-13);
  }
}

BOOST_AUTO_TEST_CASE(even_load_on_a_sphere) {
  const Ellipse sphere{0.8, 0.8};
  const double exact = 16 * pi * 0.8 / 3;
  const auto check = [&](const Velocity &velocity) {
    BOOST_TEST(std::abs(velocity[0] - exact) < 2e-13);
    BOOST_TEST(std::abs(velocity[1]) < 2e-13);
  };
  for (const Point target : {Point{0.1, 0.3}, Point{0.3, 0}}) {
    check(potential(ring_stokeslet.plain, target, whole_surface(sphere), along_axis));
  }
  for (const double zeta : {0.3, 0.7, 2.0}) {
    check(potential_on_surface(ring_stokeslet.split, sphere, zeta, along_axis));
  }
}

// With n out of the ellipsoid: the identity fixes sign and factor of K.
BOOST_AUTO_TEST_CASE(double_layer_of_a_constant) {
  const Ellipse ellipsoid{0.5, 0.9};
  const auto check = [&](const Velocity &velocity, double exact, double tolerance) {
    BOOST_TEST(std::abs(velocity[0] - exact) < tolerance);
    BOOST_TEST(std::abs(velocity[1]) < tolerance);
  };
  for (const Point target : {Point{0.1, 0.3}, Point{-0.2, 0}}) {
    check(potential(ring_stresslet.plain, target, whole_surface(ellipsoid), along_axis), 1, 1e-13);
  }
  for (const Point target : {Point{0.7, 0.7}, Point{-1, 0}}) {
    check(potential(ring_stresslet.plain, target, whole_surface(ellipsoid), along_axis), 0, 1e-13);
  }
  for (const double zeta : {0.3, 0.7, 2.0}) {
    check(potential_on_surface(ring_stresslet.split, ellipsoid, zeta, along_axis), 0.5, 1e-11);
  }
}

// v_j = 1/(8 pi) int J_ji f_i dA + int v_i K_ijk n_k dA inside, 0 outside, f the traction on the side of n:
// an extension plus a Poiseuille flow, v = (x + 1 - r^2, -r/2), p = -4 x.
BOOST_AUTO_TEST_CASE(greens_representation_of_a_flow) {
  const Ellipse ellipsoid{0.5, 0.9};
  const Surface body = whole_surface(ellipsoid);
  const auto velocity = [](const Ring &p) -> Velocity { return {p.x + 1 - p.r * p.r, -p.r / 2}; };
  const auto traction = [](const Ring &p) -> Velocity {
    return {(2 + 4 * p.x) * p.normal_x - 2 * p.r * p.normal_r,
            -2 * p.r * p.normal_x + (4 * p.x - 1) * p.normal_r};
  };
  for (const Point target :
       {Point{0.1, 0.3}, Point{-0.2, 0}, Point{0.05, 0.55}, Point{0.7, 0.7}, Point{0.9, 0}}) {
    const auto [sx, sr] = potential(ring_stokeslet.plain, target, body, traction);
    const auto [dx, dr] = potential(ring_stresslet.plain, target, body, velocity);
    const bool inside = std::hypot(target.x / ellipsoid.length, target.r / ellipsoid.radius) < 1;
    const auto exact = inside ? velocity({target.x, target.r, 0, 0}) : Velocity{0, 0};
    BOOST_TEST(std::abs(sx / (8 * pi) + dx - exact[0]) < 1e-12);
    BOOST_TEST(std::abs(sr / (8 * pi) + dr - exact[1]) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(far_ring_acts_like_a_point) {
  const double far = 1e7;
  const Components stokeslet = single(ring_stokeslet.plain, {0, 0.3}, {far, 0.5, 0, 0});
  const Components stresslet = single(ring_stresslet.plain, {0, 0.3}, {far, 0.5, 1, 0});
  BOOST_TEST(std::abs(stokeslet.xx * far / (4 * pi) - 1) < 1e-13);
  BOOST_TEST(std::abs(stresslet.xx * far * far / 1.5 - 1) < 1e-13);
}

// Along a curve the smooth part has a limit, too, which any separation shows that has its digits.
BOOST_AUTO_TEST_CASE(at_the_target_only_the_logarithmic_part_has_a_value) {
  const Ring ring{0.3, 0.5, 0.6, 0.8};
  const Rings rings{1, &ring.x, &ring.r, &ring.normal_x, &ring.normal_r};
  const double curvature = 0.7;
  const auto apart = [&](double d) { return Separations{{0.8 * d, -0.6 * d, curvature / 2 * d * d}}; };
  for (const RingKernels &kernels : available_ring_kernels()) {
    for (const auto kernel : {kernels.stokeslet.split, kernels.stresslet.split}) {
      Rows smooth(1), logarithmic(1), smooth_beside(1), logarithmic_beside(1);
      kernel(ring.r, rings, apart(1e-9), smooth_beside.view(), logarithmic_beside.view());
      kernel(ring.r, rings, apart(1e-30), smooth.view(), logarithmic.view());
      BOOST_TEST(distance(smooth[0], smooth_beside[0]) < 1e-8);
      kernel(ring.r, rings, apart(0), smooth.view(), logarithmic.view());
      BOOST_TEST(std::isnan(smooth.xx[0]));
      BOOST_TEST(std::isnan(smooth.rr[0]));
      BOOST_TEST(distance(logarithmic[0], logarithmic_beside[0]) < 1e-8);
    }
    BOOST_TEST(!std::isfinite(single(kernels.stokeslet.plain, {ring.x, ring.r}, ring).xx));
    BOOST_TEST(!std::isfinite(single(kernels.stresslet.plain, {ring.x, ring.r}, ring).xx));
  }
}
