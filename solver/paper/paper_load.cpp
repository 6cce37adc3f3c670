#include "paper/paper_load.hpp"
#include "geometry/reference_shape.hpp"
#include <cmath>
#include <numbers>

namespace capsule {
namespace {

using Eigen::Index;

// Geometry at one point, derivatives with respect to the elements' parameter u.
struct Frame {
  double r, r_slope;
  double arc, arc_slope;       // g = ds/du and dg/du
  double tangent_x, tangent_r; // t; the normal is (-t_r, t_x)
  double curvature_meridional; // eq. 3
  double curvature_azimuthal;
};

Frame frame_at(const MeridianSamples &m, Index i) {
  const double dx = m.x_slope(i), dr = m.r_slope(i), ddx = m.x_second(i), ddr = m.r_second(i);
  const double g = std::sqrt(dx * dx + dr * dr);
  return {
      m.r(i),           dr, g, (dx * ddx + dr * ddr) / g, dx / g, dr / g, (dr * ddx - dx * ddr) / (g * g * g),
      dx / (g * m.r(i))};
}

// At a pole the surface is umbilic.
Frame pole_at(const MeridianSamples &m, Index i) {
  Frame frame = frame_at(m, i);
  frame.curvature_azimuthal = frame.curvature_meridional;
  return frame;
}

struct Moments {
  double meridional, azimuthal;
};

Moments moments(const PaperLoad &load, const Frame &now, const Frame &reference, double stretch_meridional,
                double stretch_azimuthal) {
  const double nu = load.law.poisson_ratio();
  const double bend_meridional =
      stretch_meridional * now.curvature_meridional - reference.curvature_meridional;
  const double bend_azimuthal = stretch_azimuthal * now.curvature_azimuthal - reference.curvature_azimuthal;
  return {load.bending_ratio / stretch_azimuthal * (bend_meridional + nu * bend_azimuthal),
          load.bending_ratio / stretch_meridional * (bend_azimuthal + nu * bend_meridional)};
}

// Value, slope and second derivative of a spline at its nodes.
Vector nodal_values(const Vector &c) {
  const Index n = c.size() - 2;
  return (c.head(n) + 4 * c.segment(1, n) + c.tail(n)) / 6;
}
Vector nodal_slopes(const Vector &c) {
  return (c.tail(c.size() - 2) - c.head(c.size() - 2)) / 2;
}
Vector nodal_seconds(const Vector &c) {
  const Index n = c.size() - 2;
  return c.head(n) - 2 * c.segment(1, n) + c.tail(n);
}

MeridianSamples nodal_samples(const MeridianSpline &m) {
  return {nodal_values(m.x), nodal_values(m.r),  nodal_slopes(m.x),
          nodal_slopes(m.r), nodal_seconds(m.x), nodal_seconds(m.r)};
}

} // namespace

MeridianSamples sample_meridian(const MeridianSpline &m, const ShapeTable &shapes) {
  return {evaluate_spline(m.x, shapes.value),  evaluate_spline(m.r, shapes.value),
          evaluate_spline(m.x, shapes.slope),  evaluate_spline(m.r, shapes.slope),
          evaluate_spline(m.x, shapes.second), evaluate_spline(m.r, shapes.second)};
}

MeridianSpline spline_through(const PaperLoad &load, const Vector &position) {
  const Index nodes = position.size() / 2;
  return {load.even_coefficients * position.head(nodes), load.odd_coefficients * position.tail(nodes)};
}

PaperLoad make_paper_load(const CapsuleSpec &capsule, const MembraneSpec &material, int elements) {
  PaperLoad load;
  load.law = material.law;
  load.bending_ratio = material.bending_ratio;
  load.even_coefficients = spline_coefficients(elements, 1).leftCols(elements + 1);
  load.odd_coefficients = spline_coefficients(elements, 2).leftCols(elements + 1);
  Vector zeta(elements + 1);
  for (Index j = 0; j <= elements; ++j)
    zeta(j) = std::numbers::pi * static_cast<double>(j) / elements;
  Vector position = reference_position(capsule, zeta);
  position(2 * elements + 1) = 0; // the pole lies on the axis to the last digit
  load.reference = spline_through(load, position);
  return load;
}

MomentSplines moment_splines(const PaperLoad &load, const MeridianSpline &meridian) {
  const MeridianSamples now = nodal_samples(meridian), before = nodal_samples(load.reference);
  const Index last = now.x.size() - 1;
  Vector meridional(last + 1), azimuthal(last + 1);
  for (Index i = 0; i <= last; ++i) {
    const bool pole = i == 0 || i == last;
    const Frame frame = pole ? pole_at(now, i) : frame_at(now, i);
    const Frame reference = pole ? pole_at(before, i) : frame_at(before, i);
    const double stretch = frame.arc / reference.arc;
    const Moments m = moments(load, frame, reference, stretch, pole ? stretch : frame.r / reference.r);
    meridional(i) = m.meridional;
    azimuthal(i) = m.azimuthal;
  }
  return {load.even_coefficients * meridional, load.even_coefficients * azimuthal};
}

LoadSamples load_samples(const PaperLoad &load, const MeridianSpline &meridian, const MomentSplines &moments,
                         const ShapeTable &shapes) {
  const MeridianSamples now = sample_meridian(meridian, shapes),
                        before = sample_meridian(load.reference, shapes);
  const Vector moment = evaluate_spline(moments.meridional, shapes.value);
  const Vector moment_slope = evaluate_spline(moments.meridional, shapes.slope);
  const Vector moment_second = evaluate_spline(moments.meridional, shapes.second);
  const Vector hoop = evaluate_spline(moments.azimuthal, shapes.value);
  const Vector hoop_slope = evaluate_spline(moments.azimuthal, shapes.slope);
  LoadSamples q{Vector(now.x.size()), Vector(now.x.size())};
  for (Index i = 0; i < now.x.size(); ++i) {
    const Frame f = frame_at(now, i), f0 = frame_at(before, i);
    const double g = f.arc, kappa_s = f.curvature_meridional, kappa_phi = f.curvature_azimuthal;

    // Tensions: T_s = w_a/b with a = lambda_s, b = lambda_phi.
    const double a = g / f0.arc, b = f.r / f0.r;
    const double a_slope = (f.arc_slope - a * f0.arc_slope) / f0.arc;
    const double b_slope = (f.r_slope - b * f0.r_slope) / f0.r;
    const StrainEnergy w = strain_energy(load.law, a, b);
    const double tension = w.w_a / b, hoop_tension = w.w_b / a;
    const double tension_slope = (w.w_aa * a_slope + (w.w_ab - tension) * b_slope) / b;

    // Derivatives in s; d^2r/ds^2 = -kappa_s n_r makes the last term of the divergence of the shear.
    const double spread = f.tangent_r / f.r; // (1/r) dr/ds
    const double m_s = moment_slope(i) / g;
    const double m_ss = (moment_second(i) - moment_slope(i) * f.arc_slope / g) / (g * g);
    const double shear = m_s + spread * (moment(i) - hoop(i));                // N
    const double divergence = m_ss + spread * (2 * m_s - hoop_slope(i) / g) - // (1/r) d(r N)/ds
                              kappa_s * kappa_phi * (moment(i) - hoop(i));
    const double q_t = tension_slope / g + spread * (tension - hoop_tension) + kappa_s * shear;
    const double q_n = -kappa_s * tension - kappa_phi * hoop_tension + divergence;
    q.x(i) = q_t * f.tangent_x - q_n * f.tangent_r;
    q.r(i) = q_t * f.tangent_r + q_n * f.tangent_x;
  }
  return q;
}

} // namespace capsule
