#include "observe/gauge.hpp"
#include "electric/long_conductor.hpp"
#include "geometry/quadrature.hpp"
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace capsule {
namespace {

using std::numbers::pi;

// Distance in zeta of the first and the last point from the poles, where ratios such as r/R are 0/0. Even fields differ
// from their limits there by its square.
constexpr double pole_gap = 1e-5;

Sampling integration_points(const MeridianBasis &basis) {
  const Eigen::Index nodes = basis.size();
  const Panels panels =
      make_panels(Vector::LinSpaced(basis.spline ? nodes : nodes / 6 + 2, 0, pi), basis.spline ? 4 : 12);
  return sample(basis, panels.points, panels.weights);
}

Sampling pole_to_pole(const MeridianBasis &basis) {
  const Eigen::Index n = 4 * basis.size() + 1;
  return sample(basis, Vector::LinSpaced(n, pole_gap, pi - pole_gap), Vector::Zero(n));
}

// At an index between those of the samples.
struct Maximum {
  double value, index;
};

// Of the quartic through the largest sample and two neighbours on each side; next to an end, of the parabola through
// three.
Maximum maximum(const Vector &f) {
  Eigen::Index k = 0;
  const double best = f.maxCoeff(&k);
  const Maximum sample{best, static_cast<double>(k)};
  if (k == 0 || k == f.size() - 1)
    return sample;
  const bool inside = k > 1 && k + 2 < f.size();
  const double near_sum = f[k + 1] + f[k - 1], near_difference = f[k + 1] - f[k - 1];
  const double far_sum = inside ? f[k + 2] + f[k - 2] : 4 * near_sum - 6 * best;
  const double far_difference = inside ? f[k + 2] - f[k - 2] : 2 * near_difference;
  // Derivatives in units of the spacing.
  const double d1 = (8 * near_difference - far_difference) / 12,
               d2 = (16 * near_sum - far_sum - 30 * best) / 12;
  const double d3 = far_difference / 2 - near_difference, d4 = far_sum - 4 * near_sum + 6 * best;
  double t = 0;
  for (int step = 0; step < 4; ++step) {
    const double bend = d2 + t * (d3 + t * d4 / 2);
    if (!(bend < 0))
      return sample;
    t = std::clamp(t - (d1 + t * (d2 + t * (d3 / 2 + t * d4 / 6))) / bend, -1.0, 1.0);
  }
  const double top = best + t * (d1 + t * (d2 / 2 + t * (d3 / 6 + t * d4 / 24)));
  return top > best ? Maximum{top, sample.index + t} : sample;
}

// The number of stretches of negative kappa_s whose integral over the arc is more than dent_angle.
int count_dents(const MembraneState &state, double step) {
  int dents = 0;
  double turned_back = 0;
  for (Eigen::Index k = 0; k < state.arc.size(); ++k) {
    const double turn = -state.curvature_meridional[k] * state.arc[k] * step;
    if (turn <= 0) {
      turned_back = 0;
      continue;
    }
    if (turned_back <= dent_angle && turned_back + turn > dent_angle)
      ++dents;
    turned_back += turn;
  }
  return dents;
}

// Amplitudes of the waves cos(k zeta), k = 0 ... n - 1, from the values at n nodes.
Matrix waves_from_nodes(const Vector &nodes) {
  const Eigen::Index n = nodes.size();
  Matrix waves(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    waves.col(k) = (static_cast<double>(k) * nodes.array()).cos();
  return lu_inverse(waves);
}

// Root of the share that the shortest third of the waves has in the sum of squares of k^2 times the
// amplitudes of x.
double roughness_of(const Vector &amplitudes) {
  const Eigen::ArrayXd wave =
      Eigen::ArrayXd::LinSpaced(amplitudes.size(), 0, static_cast<double>(amplitudes.size() - 1));
  const Eigen::ArrayXd bending = (wave.square() * amplitudes.array()).square();
  return std::sqrt(bending.tail(amplitudes.size() / 3).sum() / bending.sum());
}

} // namespace

Gauge::Gauge(const std::optional<Pore> &pore, const Membrane &membrane,
             const std::optional<FlowResolution> &conductor)
    : membrane_(membrane), pore_(pore), panels_(integration_points(membrane.basis)),
      fine_(pole_to_pole(membrane.basis)), undeformed_(undeformed_at(fine_, membrane.reference)) {
  initial_ = integrals(trace(panels_, membrane_.initial));
  if (pore_ && conductor) {
    const FlowResolution resolution = conductor_resolution(*conductor);
    conductor_.emplace(*pore_, resolution);
    conductor_mesh_ = make_membrane_mesh(membrane_.basis, resolution);
  }
  waves_ = waves_from_nodes(membrane_.basis.nodes);

  // S by Gauss's rule between neighbouring points.
  const GaussRule rule = gauss_legendre(6);
  const Vector x = membrane_.initial.head(membrane_.basis.size());
  const Vector r = membrane_.initial.tail(membrane_.basis.size());
  arc_from_pole_ = Vector::Zero(fine_.zeta.size());
  const double step = fine_.zeta[1] - fine_.zeta[0];
  Vector points(rule.size() * (fine_.zeta.size() - 1));
  for (Eigen::Index k = 0; k + 1 < fine_.zeta.size(); ++k)
    points.segment(k * rule.size(), rule.size()) = fine_.zeta[k] + step / 2 * (1 + rule.nodes.array());
  const Vector speed = (membrane_.basis.even(points, 1, x).array().square() +
                        membrane_.basis.odd(points, 1, r).array().square())
                           .sqrt();
  for (Eigen::Index k = 0; k + 1 < fine_.zeta.size(); ++k)
    arc_from_pole_[k + 1] =
        arc_from_pole_[k] + step / 2 * rule.weights.dot(speed.segment(k * rule.size(), rule.size()));
}

Gauge::Integrals Gauge::integrals(const Trace &curve) const {
  const auto r = curve.r.array();
  const Eigen::ArrayXd slice = pi * panels_.weights.array() * r.square() * curve.x_zeta.array();
  return {slice.sum(), (slice * curve.x.array()).sum(),
          2 * pi * (panels_.weights.array() * r * curve.arc.array()).sum()};
}

double Gauge::centre(const Vector &position) const {
  const Eigen::Index n = membrane_.basis.size();
  const Vector x = panels_.even[0] * position.head(n);
  const Vector x_zeta = panels_.even[1] * position.head(n);
  const Vector r = panels_.odd[0] * position.tail(n);
  const Eigen::ArrayXd slice = panels_.weights.array() * r.array().square() * x_zeta.array();
  return (slice * x.array()).sum() / slice.sum();
}

double Gauge::film(const Vector &position) const {
  const Eigen::Index n = membrane_.basis.size();
  return film(fine_.even[0] * position.head(n), fine_.odd[0] * position.tail(n));
}

double Gauge::film(const Vector &x, const Vector &r) const {
  if (!pore_)
    return std::numeric_limits<double>::infinity();
  // Between two points the distance to the wall falls by no more than the points are apart: those that are surely farther than
  // the nearest one are skipped.
  const Eigen::Index last_point = x.size() - 1;
  const auto way = [&](Eigen::Index from, Eigen::Index to) {
    return std::hypot(x[to] - x[from], r[to] - r[from]);
  };
  Vector distance(x.size());
  double nearest = std::numeric_limits<double>::infinity(), apart = 0;
  Eigen::Index last = 0;
  for (Eigen::Index k = 0; k <= last_point; ++k) {
    if (k > 0)
      apart = std::max(apart, way(k - 1, k));
    if (k > 0 && distance[last] - way(last, k) > nearest + apart) {
      distance[k] = distance[last] - way(last, k);
      continue;
    }
    distance[k] = wall_distance(*pore_, x[k], r[k]);
    last = k;
    nearest = std::min(nearest, distance[k]);
  }
  // The distance has a kink in its slope's change where the mouth ends: it is taken from the smooth meridian, not interpolated.
  const Vector five = Vector::LinSpaced(5, 0, 4);
  const auto between = [&](Eigen::Index middle) {
    const Eigen::Index first = std::clamp<Eigen::Index>(middle - 2, 0, last_point - 4);
    const auto along = [&, first](double place) {
      const Matrix quartic = lagrange_matrix(five, Vector::Constant(1, place - static_cast<double>(first)));
      const double at_x = quartic.row(0).dot(x.segment<5>(first));
      const double at_r = quartic.row(0).dot(r.segment<5>(first));
      return wall_distance(*pore_, at_x, at_r);
    };
    constexpr int half_of_the_digits = 26; // in bits: a minimum is flat
    const auto low = static_cast<double>(std::max<Eigen::Index>(middle - 1, 0));
    const auto high = static_cast<double>(std::min(middle + 1, last_point));
    return boost::math::tools::brent_find_minima(along, low, high, half_of_the_digits).second;
  };
  const double sampled = nearest;
  for (Eigen::Index k = 0; k <= last_point; ++k)
    if (distance[k] <= sampled + apart && distance[k] <= distance[std::max<Eigen::Index>(k - 1, 0)] &&
        distance[k] <= distance[std::min(k + 1, last_point)])
      nearest = std::min(nearest, between(k));
  return nearest;
}

bool Gauge::crosses_itself(const Vector &position) const {
  const Eigen::Index n = membrane_.basis.size();
  const Vector x = fine_.even[0] * position.head(n), r = fine_.odd[0] * position.tail(n);
  // Twice the area of the triangle of points a, b, c: its sign tells the side of the line ab on which c lies.
  const auto side = [&](Eigen::Index a, Eigen::Index b, Eigen::Index c) {
    return (x[b] - x[a]) * (r[c] - r[a]) - (r[b] - r[a]) * (x[c] - x[a]);
  };
  // Runs of segments do not cross if their bounding boxes do not overlap.
  constexpr Eigen::Index run = 8;
  const Eigen::Index runs = (x.size() - 1 + run - 1) / run;
  Matrix box(4, runs);
  for (Eigen::Index a = 0; a < runs; ++a) {
    const Eigen::Index points = std::min(run + 1, x.size() - a * run);
    const auto run_x = x.segment(a * run, points), run_r = r.segment(a * run, points);
    box.col(a) << run_x.minCoeff(), run_x.maxCoeff(), run_r.minCoeff(), run_r.maxCoeff();
  }
  const auto apart = [&](Eigen::Index a, Eigen::Index b) {
    return box(0, a) > box(1, b) || box(0, b) > box(1, a) || box(2, a) > box(3, b) || box(2, b) > box(3, a);
  };
  const auto cross = [&](Eigen::Index i, Eigen::Index j) {
    return side(i, i + 1, j) * side(i, i + 1, j + 1) < 0 && side(j, j + 1, i) * side(j, j + 1, i + 1) < 0;
  };
  const auto end = [&](Eigen::Index a) { return std::min((a + 1) * run, x.size() - 1); };
  for (Eigen::Index a = 0; a < runs; ++a)
    for (Eigen::Index b = a; b < runs; ++b) {
      if (apart(a, b))
        continue;
      for (Eigen::Index i = a * run; i < end(a); ++i)
        for (Eigen::Index j = std::max(b * run, i + 2); j < end(b); ++j)
          if (cross(i, j))
            return true;
    }
  return false;
}

// S at an index between those of fine_.
double Gauge::arc_at(double index) const {
  const auto k = std::min(static_cast<Eigen::Index>(index), arc_from_pole_.size() - 2);
  return arc_from_pole_[k] + (index - static_cast<double>(k)) * (arc_from_pole_[k + 1] - arc_from_pole_[k]);
}

LargestStrain Gauge::largest_strain(const MembraneState &state) const {
  const Maximum area = maximum(state.stretch_meridional.cwiseProduct(state.stretch_azimuthal));
  const Maximum meridional = maximum(state.tension_meridional), azimuthal = maximum(state.tension_azimuthal);
  const Maximum tension = azimuthal.value > meridional.value ? azimuthal : meridional;
  return {area.value, arc_at(area.index), tension.value, arc_at(tension.index)};
}

LargestStrain Gauge::largest_strain(const Vector &position) const {
  return largest_strain(membrane_state(membrane_, fine_, undeformed_, position));
}

SeriesRow Gauge::row(double time, const Vector &position, const Vector &velocity) const {
  const Eigen::Index n = membrane_.basis.size();
  SeriesRow row;
  row.time = time;
  const Trace curve = trace(panels_, position), moving = trace(panels_, velocity);
  const Integrals now = integrals(curve);
  row.x_g = now.first_moment / now.volume;
  row.volume_change = (now.volume - initial_.volume) / initial_.volume;
  row.area_change = (now.area - initial_.area) / initial_.area;

  // v_g = (1/V) int (x - x_g) v.n dA, with n dA = 2 pi r (-r', x') dzeta
  const Eigen::ArrayXd flux =
      moving.r.array() * curve.x_zeta.array() - moving.x.array() * curve.r_zeta.array();
  row.v_g = 2 * pi * (panels_.weights.array() * (curve.x.array() - row.x_g) * curve.r.array() * flux).sum() /
            now.volume;
  row.max_axial_residual = (velocity.head(n).array() - row.v_g).abs().maxCoeff();
  row.max_radial_velocity = velocity.tail(n).cwiseAbs().maxCoeff();

  const MembraneState state = membrane_state(membrane_, fine_, undeformed_, position);
  row.max_stretch = maximum(state.stretch_meridional).value;
  const LargestStrain strain = largest_strain(state);
  row.max_area_stretch = strain.area_stretch;
  row.S_at_max_area_stretch = strain.area_stretch_S;
  row.max_tension = strain.tension;
  row.S_at_max_tension = strain.tension_S;
  row.front_stretch = state.stretch_meridional[state.stretch_meridional.size() - 1];
  row.min_film = film(state.x, state.r);
  row.length = maximum(state.x).value + maximum(-state.x).value;
  const double diameter = 2 * maximum(state.r).value;
  row.deformation = (row.length - diameter) / (row.length + diameter);
  row.roughness = roughness_of(waves_ * position.head(n));
  row.dents = count_dents(state, fine_.zeta[1] - fine_.zeta[0]);
  if (conductor_) {
    row.resistance = conductor_->change(conductor_mesh_, position);
    row.resistance_long_conductor = long_conductor_change(*pore_, membrane_.basis, position);
  }
  return row;
}

std::optional<double> Gauge::empty_resistance() const {
  return conductor_ ? std::optional(conductor_->empty_resistance()) : std::nullopt;
}

Profile Gauge::profile(double time, const Vector &position, const Vector &velocity) const {
  const Eigen::Index n = membrane_.basis.size();
  const MembraneState state = membrane_state(membrane_, fine_, undeformed_, position);
  Profile profile;
  profile.time = time;
  profile.x_g = centre(position);
  profile.S = arc_from_pole_;
  profile.x = state.x;
  profile.r = state.r;
  profile.stretch_meridional = state.stretch_meridional;
  profile.stretch_azimuthal = state.stretch_azimuthal;
  profile.tension_meridional = state.tension_meridional;
  profile.tension_azimuthal = state.tension_azimuthal;
  profile.moment_meridional = state.moment_meridional;
  profile.moment_azimuthal = state.moment_azimuthal;
  profile.curvature_meridional = state.curvature_meridional;
  profile.curvature_azimuthal = state.curvature_azimuthal;
  profile.velocity_x = fine_.even[0] * velocity.head(n);
  profile.velocity_r = fine_.odd[0] * velocity.tail(n);
  return profile;
}

} // namespace capsule
