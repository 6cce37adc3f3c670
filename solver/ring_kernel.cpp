#include "ring_kernel.hpp"

#include "elliptic.hpp"

#include <cmath>
#include <numbers>

namespace capsule {

namespace {

// What both kernels need of a target and a ring.
struct Pair {
  double dx;
  double dr;
  double r0;
  double r;
  double m1;
  double ln_m1;
  double over_d2; // 1/d^2
  double over_R2; // 1/R^2
  double over_R;
};

[[gnu::always_inline]] inline Pair pair_of(double x0, double r0, double x, double r) {
  const double dx = x - x0;
  const double dr = r - r0;
  const double R2 = dx * dx + (r + r0) * (r + r0);
  const Ratio m1 = ratio_with_logarithm(dx * dx + dr * dr, R2);
  return {.dx = dx,
          .dr = dr,
          .r0 = r0,
          .r = r,
          .m1 = m1.value,
          .ln_m1 = m1.natural_logarithm,
          .over_d2 = m1.over_numerator,
          .over_R2 = m1.over_denominator,
          .over_R = std::sqrt(R2) * m1.over_denominator};
}

struct Components {
  double xx;
  double xr;
  double rx;
  double rr;
};

// e_over_d2 stands for E/d^2, E = B + m1 D.
[[gnu::always_inline]] inline Components stokeslet(const Pair &p, double b, double d, double e_over_d2) {
  const double f = 4 * p.over_R;
  const double twice_d = 2 * d * p.over_R2;
  return {.xx = f * (b + d + p.dx * p.dx * e_over_d2),
          .xr = f * p.dx * (p.dr * e_over_d2 + p.r0 * twice_d),
          .rx = f * p.dx * (p.dr * e_over_d2 - p.r * twice_d),
          .rr = f * (d * (1 + p.m1) - 2 * b + p.dr * p.dr * (e_over_d2 - twice_d))};
}

// With e = dx, dr + 2 r0 c (at the ring), dr - 2 r c (at the target), e.n = a + b c, and I_n = int
// c^n/Delta^5:
//   i0 = 3 a I0/R^4,  i1 = 3 I1/R^4,  i2 = 3 I2/R^4,  i3 = 3 m I3/R^2
[[gnu::always_inline]] inline Components stresslet(const Pair &p, double a, double b, double i0, double i1,
                                                   double i2, double i3) {
  const double h = std::numbers::inv_pi * p.over_R;
  const double dr2 = p.dr * p.dr;
  const double both = i0 + b * i1;
  return {.xx = h * (p.dx * p.dx * both),
          .xr = h * p.dx * (p.dr * both + 2 * p.r0 * (a * i1 + b * i2)),
          .rx = h * p.dx * (p.dr * both - 2 * p.r * (a * i1 + b * i2)),
          .rr = h * (dr2 * (both - 2 * a * i1) - (2 * b * dr2 + 4 * p.r * p.r0 * a) * i2 - b * i3)};
}

[[gnu::always_inline]] inline Components stokeslet_sum(const Pair &p) {
  const EllipticIntegrals i = elliptic_sum(elliptic_smooth(p.m1), elliptic_logarithmic(p.m1), p.m1, p.ln_m1);
  return stokeslet(p, i.b, i.d, (i.b + p.m1 * i.d) * p.over_d2);
}

[[gnu::always_inline]] inline Components stokeslet_smooth(const Pair &p) {
  const EllipticIntegrals i = elliptic_smooth(p.m1);
  return stokeslet(p, i.b, i.d, (i.b + p.m1 * i.d) * p.over_d2);
}

[[gnu::always_inline]] inline Components stokeslet_logarithmic(const Pair &p) {
  const EllipticLogarithms i = elliptic_logarithmic(p.m1);
  return stokeslet(p, p.m1 * i.b_over_m1, i.d, (i.b_over_m1 + i.d) * p.over_R2);
}

[[gnu::always_inline]] inline Components stresslet_of(const Pair &p, const EllipticIntegrals &i,
                                                      double normal_x, double normal_r) {
  const double m = 4 * p.r * p.r0 * p.over_R2;
  const double a = p.dx * normal_x + p.dr * normal_r;
  const double cube = (2 + p.m1) * i.b + p.m1 * (1 + 2 * p.m1) * i.d;
  return stresslet(p, a, 2 * p.r0 * normal_r, a * p.over_d2 * cube * p.over_d2,
                   (i.b + 2 * p.m1 * i.d) * p.over_d2 * p.over_R2, (i.c + 2 * i.d) * p.over_R2 * p.over_R2,
                   (i.d - 4 * i.c + m * (i.c + 2 * i.d)) * p.over_R2);
}

[[gnu::always_inline]] inline Components stresslet_sum(const Pair &p, double normal_x, double normal_r) {
  const EllipticIntegrals i = elliptic_sum(elliptic_smooth(p.m1), elliptic_logarithmic(p.m1), p.m1, p.ln_m1);
  return stresslet_of(p, i, normal_x, normal_r);
}

[[gnu::always_inline]] inline Components stresslet_smooth(const Pair &p, double normal_x, double normal_r) {
  return stresslet_of(p, elliptic_smooth(p.m1), normal_x, normal_r);
}

[[gnu::always_inline]] inline Components stresslet_logarithmic(const Pair &p, double normal_x,
                                                               double normal_r) {
  const EllipticLogarithms i = elliptic_logarithmic(p.m1);
  const double m = 4 * p.r * p.r0 * p.over_R2;
  const double a = p.dx * normal_x + p.dr * normal_r;
  const double over_R4 = p.over_R2 * p.over_R2;
  return stresslet(p, a, 2 * p.r0 * normal_r, a * i.cube_over_m1_squared * over_R4,
                   (i.b_over_m1 + 2 * i.d) * over_R4, (i.c + 2 * i.d) * over_R4,
                   (i.d - 4 * i.c + m * (i.c + 2 * i.d)) * p.over_R2);
}

[[gnu::always_inline]] inline void store(const KernelRow &out, int k, const Components &value) {
  out.xx[k] = value.xx;
  out.xr[k] = value.xr;
  out.rx[k] = value.rx;
  out.rr[k] = value.rr;
}

} // namespace

void ring_stokeslet(double x0, double r0, const Rings &rings, const KernelRow &out) {
  for (int k = 0; k < rings.count; ++k) {
    store(out, k, stokeslet_sum(pair_of(x0, r0, rings.x[k], rings.r[k])));
  }
}

void ring_stresslet(double x0, double r0, const Rings &rings, const KernelRow &out) {
  for (int k = 0; k < rings.count; ++k) {
    store(out, k,
          stresslet_sum(pair_of(x0, r0, rings.x[k], rings.r[k]), rings.normal_x[k], rings.normal_r[k]));
  }
}

void ring_stokeslet_split(double x0, double r0, const Rings &rings, const KernelRow &smooth,
                          const KernelRow &logarithmic) {
  for (int k = 0; k < rings.count; ++k) {
    const Pair pair = pair_of(x0, r0, rings.x[k], rings.r[k]);
    store(smooth, k, stokeslet_smooth(pair));
    store(logarithmic, k, stokeslet_logarithmic(pair));
  }
}

void ring_stresslet_split(double x0, double r0, const Rings &rings, const KernelRow &smooth,
                          const KernelRow &logarithmic) {
  for (int k = 0; k < rings.count; ++k) {
    const Pair pair = pair_of(x0, r0, rings.x[k], rings.r[k]);
    store(smooth, k, stresslet_smooth(pair, rings.normal_x[k], rings.normal_r[k]));
    store(logarithmic, k, stresslet_logarithmic(pair, rings.normal_x[k], rings.normal_r[k]));
  }
}

} // namespace capsule
