#include "ring_kernel.hpp"

#include "elliptic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace capsule {

namespace {

// What both kernels need of a target and a ring: d is the distance to the nearest, R to the farthest point.
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

struct Normal {
  double x;
  double r;
};

struct Components {
  double xx;
  double xr;
  double rx;
  double rr;
};

[[gnu::always_inline]] inline Pair pair_of(double x0, double r0, double x, double r) {
  const double dx = x - x0;
  const double dr = r - r0;
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

// From the integrals B, D and E/d^2. The rings' C drops out: m (D - C) = B - m1 D.
[[gnu::always_inline]] inline Components stokeslet(const Pair &p, double b, double d, double e_over_d2) {
  const double f = 4 * p.over_R;
  const double g = 2 * d * p.over_R2;
  return {.xx = f * (b + d + p.dx * p.dx * e_over_d2),
          .xr = f * p.dx * (p.dr * e_over_d2 + p.r0 * g),
          .rx = f * p.dx * (p.dr * e_over_d2 - p.r * g),
          .rr = f * (d * (1 + p.m1) - 2 * b + p.dr * p.dr * (e_over_d2 - g))};
}

[[gnu::always_inline]] inline Components stokeslet(const Pair &p, const EllipticIntegrals &i) {
  return stokeslet(p, i.b, i.d, (i.b + p.m1 * i.d) * p.over_d2);
}

// E = B + m1 D has the factor m1, which turns 1/d^2 into 1/R^2.
[[gnu::always_inline]] inline Components stokeslet(const Pair &p, const EllipticLogarithms &i) {
  return stokeslet(p, p.m1 * i.b_over_m1, i.d, (i.b_over_m1 + i.d) * p.over_R2);
}

// The vector from target to ring has the components dx, dr - 2 r c at the target, dr + 2 r0 c at the ring,
// and e.n = a + b c; I_n = int c^n/Delta^5. Given are 3 a I_0/R^4, 3 I_1/R^4, 3 I_2/R^4 and 3 m I_3/R^2.
[[gnu::always_inline]] inline Components stresslet(const Pair &p, double a, double b, double a_i0, double i1,
                                                   double i2, double m_i3) {
  const double f = std::numbers::inv_pi * p.over_R;
  const double g = a_i0 + b * i1;
  const double h = 2 * (a * i1 + b * i2);
  return {.xx = f * (p.dx * p.dx * g),
          .xr = f * p.dx * (p.dr * g + p.r0 * h),
          .rx = f * p.dx * (p.dr * g - p.r * h),
          .rr = f * (p.dr * p.dr * (g - h) - 4 * p.r * p.r0 * a * i2 - b * m_i3)};
}

[[gnu::always_inline]] inline Components stresslet(const Pair &p, const Normal &normal,
                                                   const EllipticIntegrals &i) {
  const double a = p.dx * normal.x + p.dr * normal.r;
  const double quintic = (2 + p.m1) * i.b + p.m1 * (1 + 2 * p.m1) * i.d;
  return stresslet(p, a, 2 * p.r0 * normal.r, (a * p.over_d2) * quintic * p.over_d2,
                   (i.b + 2 * p.m1 * i.d) * p.over_d2 * p.over_R2, (i.c + 2 * i.d) * p.over_R2 * p.over_R2,
                   (i.d - 4 * i.c + p.m * (i.c + 2 * i.d)) * p.over_R2);
}

[[gnu::always_inline]] inline Components stresslet(const Pair &p, const Normal &normal,
                                                   const EllipticLogarithms &i) {
  const double a = p.dx * normal.x + p.dr * normal.r;
  const double over_R4 = p.over_R2 * p.over_R2;
  return stresslet(p, a, 2 * p.r0 * normal.r, a * i.quintic_over_m1_squared * over_R4,
                   (i.b_over_m1 + 2 * i.d) * over_R4, (i.c + 2 * i.d) * over_R4,
                   (i.d - 4 * i.c + p.m * (i.c + 2 * i.d)) * p.over_R2);
}

[[gnu::always_inline]] inline void store(const KernelRow &out, int k, const Components &value) {
  out.xx[k] = value.xx;
  out.xr[k] = value.xr;
  out.rx[k] = value.rx;
  out.rr[k] = value.rr;
}

// The four kernels as the loop sees them: one row of components for each part.
struct Stokeslet {
  static constexpr bool takes_normal = false;
  static constexpr std::size_t parts = 1;
  [[gnu::always_inline]] static void evaluate(const Pair &p, const Normal & /*normal*/,
                                              const std::array<KernelRow, parts> &out, int k) {
    store(out[0], k, stokeslet(p, elliptic_integrals(p.m, p.m1, p.ln_m1)));
  }
};

struct Stresslet {
  static constexpr bool takes_normal = true;
  static constexpr std::size_t parts = 1;
  [[gnu::always_inline]] static void evaluate(const Pair &p, const Normal &normal,
                                              const std::array<KernelRow, parts> &out, int k) {
    store(out[0], k, stresslet(p, normal, elliptic_integrals(p.m, p.m1, p.ln_m1)));
  }
};

struct StokesletSplit {
  static constexpr bool takes_normal = false;
  static constexpr std::size_t parts = 2;
  [[gnu::always_inline]] static void evaluate(const Pair &p, const Normal & /*normal*/,
                                              const std::array<KernelRow, parts> &out, int k) {
    store(out[0], k, stokeslet(p, elliptic_integrals(p.m, p.m1, 0)));
    store(out[1], k, stokeslet(p, elliptic_logarithmic(p.m1)));
  }
};

struct StressletSplit {
  static constexpr bool takes_normal = true;
  static constexpr std::size_t parts = 2;
  [[gnu::always_inline]] static void evaluate(const Pair &p, const Normal &normal,
                                              const std::array<KernelRow, parts> &out, int k) {
    store(out[0], k, stresslet(p, normal, elliptic_integrals(p.m, p.m1, 0)));
    store(out[1], k, stresslet(p, normal, elliptic_logarithmic(p.m1)));
  }
};

// Rings that go through the arithmetic together: the widest vector, or several of narrower ones.
constexpr int block = 8;
using Block = std::array<double, block>;

template <class Kernel>
[[gnu::always_inline]] inline void block_of_rings(double x0, double r0, const Rings &rings,
                                                  const std::array<KernelRow, Kernel::parts> &out) {
#pragma omp simd
  for (int k = 0; k < block; ++k) {
    Normal normal{0, 0};
    if constexpr (Kernel::takes_normal) {
      normal = {rings.normal_x[k], rings.normal_r[k]};
    }
    Kernel::evaluate(pair_of(x0, r0, rings.x[k], rings.r[k]), normal, out, k);
  }
}

// Fewer rings than a block: the last one is repeated, in a copy.
template <class Kernel>
[[gnu::always_inline]] inline void few_rings(double x0, double r0, const Rings &rings,
                                             const std::array<KernelRow, Kernel::parts> &out) {
  Block x{};
  Block r{};
  Block normal_x{};
  Block normal_r{};
  for (int k = 0; k < block; ++k) {
    const int ring = std::min(k, rings.count - 1);
    x[k] = rings.x[ring];
    r[k] = rings.r[ring];
    if constexpr (Kernel::takes_normal) {
      normal_x[k] = rings.normal_x[ring];
      normal_r[k] = rings.normal_r[ring];
    }
  }
  std::array<std::array<Block, 4>, Kernel::parts> results;
  std::array<KernelRow, Kernel::parts> rows;
  for (std::size_t part = 0; part < Kernel::parts; ++part) {
    auto &[xx, xr, rx, rr] = results[part];
    rows[part] = {xx.data(), xr.data(), rx.data(), rr.data()};
  }
  block_of_rings<Kernel>(x0, r0, {block, x.data(), r.data(), normal_x.data(), normal_r.data()}, rows);
  for (std::size_t part = 0; part < Kernel::parts; ++part) {
    std::copy_n(rows[part].xx, rings.count, out[part].xx);
    std::copy_n(rows[part].xr, rings.count, out[part].xr);
    std::copy_n(rows[part].rx, rings.count, out[part].rx);
    std::copy_n(rows[part].rr, rings.count, out[part].rr);
  }
}

// Whole blocks; the last one overlaps the one before.
template <class Kernel>
[[gnu::always_inline]] inline void all_rings(double x0, double r0, const Rings &rings,
                                             const std::array<KernelRow, Kernel::parts> &out) {
  if (rings.count > 0 && rings.count < block) {
    few_rings<Kernel>(x0, r0, rings, out);
    return;
  }
  for (int first = 0; first < rings.count; first += block) {
    const int k = std::min(first, rings.count - block);
    Rings from{block, rings.x + k, rings.r + k, nullptr, nullptr};
    if constexpr (Kernel::takes_normal) {
      from.normal_x = rings.normal_x + k;
      from.normal_r = rings.normal_r + k;
    }
    std::array<KernelRow, Kernel::parts> to;
    for (std::size_t part = 0; part < Kernel::parts; ++part) {
      to[part] = {out[part].xx + k, out[part].xr + k, out[part].rx + k, out[part].rr + k};
    }
    block_of_rings<Kernel>(x0, r0, from, to);
  }
}

// The same loops, compiled once for each class of processors.
struct Baseline {
  template <class Kernel, class... Rows>
  static void run(double x0, double r0, const Rings &rings, const Rows &...rows) {
    all_rings<Kernel>(x0, r0, rings, {rows...});
  }
};

#ifdef __x86_64__
struct Avx2 {
  template <class Kernel, class... Rows>
  [[gnu::target("avx2,fma")]] static void run(double x0, double r0, const Rings &rings, const Rows &...rows) {
    all_rings<Kernel>(x0, r0, rings, {rows...});
  }
};

struct Avx512 {
  template <class Kernel, class... Rows>
  [[gnu::target("avx512f,avx512dq,avx512vl,fma")]] static void run(double x0, double r0, const Rings &rings,
                                                                   const Rows &...rows) {
    all_rings<Kernel>(x0, r0, rings, {rows...});
  }
};
#endif

template <class Processor>
RingKernels kernels_for(const std::string &instructions) {
  return {instructions, Processor::template run<Stokeslet, KernelRow>,
          Processor::template run<Stresslet, KernelRow>,
          Processor::template run<StokesletSplit, KernelRow, KernelRow>,
          Processor::template run<StressletSplit, KernelRow, KernelRow>};
}

const RingKernels &best() {
  static const RingKernels kernels = available_ring_kernels().front();
  return kernels;
}

} // namespace

std::vector<RingKernels> available_ring_kernels() {
  std::vector<RingKernels> kernels;
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    kernels.push_back(kernels_for<Avx512>("avx512"));
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    kernels.push_back(kernels_for<Avx2>("avx2"));
  }
#endif
  kernels.push_back(kernels_for<Baseline>("baseline"));
  return kernels;
}

void ring_stokeslet(double x0, double r0, const Rings &rings, const KernelRow &out) {
  best().stokeslet(x0, r0, rings, out);
}

void ring_stresslet(double x0, double r0, const Rings &rings, const KernelRow &out) {
  best().stresslet(x0, r0, rings, out);
}

void ring_stokeslet_split(double x0, double r0, const Rings &rings, const KernelRow &smooth,
                          const KernelRow &logarithmic) {
  best().stokeslet_split(x0, r0, rings, smooth, logarithmic);
}

void ring_stresslet_split(double x0, double r0, const Rings &rings, const KernelRow &smooth,
                          const KernelRow &logarithmic) {
  best().stresslet_split(x0, r0, rings, smooth, logarithmic);
}

} // namespace capsule
