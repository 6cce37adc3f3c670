#pragma once
// The kernels of ring_kernel.hpp for one target and one ring, from the elliptic integrals that they share. Inlined into the
// loops of ring_kernel.cpp, which is compiled for several classes of processors.
#include "integrals/elliptic.hpp"
#include <cmath>
#include <numbers>

namespace capsule::ring_formulas {

// What all kernels need of a target and a ring: d is the distance to the nearest, R to the farthest point.
struct Pair {
  double dx;
  double dr;
  double r0;
  double r;
  double m;
  double m1;
  double ln_m1;
  double over_d2;
  double over_R2;
  double over_R;
};

// Of the vector e from target to ring, whose product with the ring's normal depends on the azimuth.
struct Normal {
  double along; // e.n in the target's half plane
  double r;
};

struct Components {
  double xx;
  double xr;
  double rx;
  double rr;
};

[[gnu::always_inline]] inline Pair pair_of(double dx, double dr, double r0, double r) {
  const double R2 = dx * dx + (r + r0) * (r + r0);
  const double difference = 4 * r * r0;
  const Ratio m1 = ratio(dx * dx + dr * dr, R2, difference);
  return {.dx = dx,
          .dr = dr,
          .r0 = r0,
          .r = r,
          .m = difference * m1.over_denominator,
          .m1 = m1.value,
          .ln_m1 = m1.natural_logarithm,
          .over_d2 = m1.over_numerator,
          .over_R2 = m1.over_denominator,
          .over_R = std::sqrt(R2) * m1.over_denominator};
}

struct Stokeslet {
  static constexpr int dimension = 2;
  static constexpr bool takes_normal = false;
  // From the integrals B, D and E/d^2. The rings' C drops out: m (D - C) = B - m1 D.
  [[gnu::always_inline]] static Components value(const Pair &p, double b, double d, double e_over_d2) {
    const double f = 4 * p.over_R;
    const double g = 2 * d * p.over_R2;
    return {.xx = f * (b + d + p.dx * p.dx * e_over_d2),
            .xr = f * p.dx * (p.dr * e_over_d2 + p.r0 * g),
            .rx = f * p.dx * (p.dr * e_over_d2 - p.r * g),
            .rr = f * (d * (1 + p.m1) - 2 * b + p.dr * p.dr * (e_over_d2 - g))};
  }

  [[gnu::always_inline]] static Components value(const Pair &p, const Normal & /*normal*/,
                                                 const EllipticIntegrals &i) {
    return value(p, i.b, i.d, (i.b + p.m1 * i.d) * p.over_d2);
  }

  // E = B + m1 D has the factor m1, which turns 1/d^2 into 1/R^2.
  [[gnu::always_inline]] static Components value(const Pair &p, const Normal & /*normal*/,
                                                 const EllipticLogarithms &i) {
    return value(p, p.m1 * i.b_over_m1, i.d, (i.b_over_m1 + i.d) * p.over_R2);
  }
};

struct Stresslet {
  static constexpr int dimension = 2;
  static constexpr bool takes_normal = true;
  // The vector from target to ring has the components dx, dr - 2 r c at the target, dr + 2 r0 c at the ring,
  // and e.n = a + b c; I_n = int c^n/Delta^5. Given are 3 a I_0/R^4, 3 I_1/R^4, 3 I_2/R^4 and 3 m I_3/R^2.
  [[gnu::always_inline]] static Components value(const Pair &p, double a, double b, double a_i0, double i1,
                                                 double i2, double m_i3) {
    const double f = std::numbers::inv_pi * p.over_R;
    const double g = a_i0 + b * i1;
    const double h = 2 * (a * i1 + b * i2);
    return {.xx = f * (p.dx * p.dx * g),
            .xr = f * p.dx * (p.dr * g + p.r0 * h),
            .rx = f * p.dx * (p.dr * g - p.r * h),
            .rr = f * (p.dr * p.dr * (g - h) - 4 * p.r * p.r0 * a * i2 - b * m_i3)};
  }

  [[gnu::always_inline]] static Components value(const Pair &p, const Normal &normal,
                                                 const EllipticIntegrals &i) {
    const double a = normal.along;
    const double quintic = (2 + p.m1) * i.b + p.m1 * (1 + 2 * p.m1) * i.d;
    return value(p, a, 2 * p.r0 * normal.r, (a * p.over_d2) * quintic * p.over_d2,
                 (i.b + 2 * p.m1 * i.d) * p.over_d2 * p.over_R2, (i.c + 2 * i.d) * p.over_R2 * p.over_R2,
                 (i.d - 4 * i.c + p.m * (i.c + 2 * i.d)) * p.over_R2);
  }

  [[gnu::always_inline]] static Components value(const Pair &p, const Normal &normal,
                                                 const EllipticLogarithms &i) {
    const double a = normal.along;
    const double over_R4 = p.over_R2 * p.over_R2;
    return value(p, a, 2 * p.r0 * normal.r, a * i.quintic_over_m1_squared * over_R4,
                 (i.b_over_m1 + 2 * i.d) * over_R4, (i.c + 2 * i.d) * over_R4,
                 (i.d - 4 * i.c + p.m * (i.c + 2 * i.d)) * p.over_R2);
  }
};

// K = B + D
struct Source {
  static constexpr int dimension = 1;
  static constexpr bool takes_normal = false;
  [[gnu::always_inline]] static double value(const Pair &p, const Normal & /*normal*/,
                                             const EllipticIntegrals &i) {
    return std::numbers::inv_pi * p.over_R * (i.b + i.d);
  }
  [[gnu::always_inline]] static double value(const Pair &p, const Normal & /*normal*/,
                                             const EllipticLogarithms &i) {
    return std::numbers::inv_pi * p.over_R * (p.m1 * i.b_over_m1 + i.d);
  }
};

// int 1/Delta^3 = E/m1 and int c/Delta^3 = D
struct Dipole {
  static constexpr int dimension = 1;
  static constexpr bool takes_normal = true;
  [[gnu::always_inline]] static double value(const Pair &p, double r0, const Normal &normal, double d,
                                             double e_over_d2) {
    return std::numbers::inv_pi * p.over_R * (normal.along * e_over_d2 + 2 * r0 * normal.r * d * p.over_R2);
  }
  [[gnu::always_inline]] static double value(const Pair &p, const Normal &normal,
                                             const EllipticIntegrals &i) {
    return value(p, p.r0, normal, i.d, (i.b + p.m1 * i.d) * p.over_d2);
  }
  [[gnu::always_inline]] static double value(const Pair &p, const Normal &normal,
                                             const EllipticLogarithms &i) {
    return value(p, p.r0, normal, i.d, (i.b_over_m1 + i.d) * p.over_R2);
  }
};

} // namespace capsule::ring_formulas
