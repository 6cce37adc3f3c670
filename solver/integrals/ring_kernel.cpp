#include "integrals/ring_kernel.hpp"

#include "integrals/ring_formulas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace capsule {

namespace {

using namespace ring_formulas;

[[gnu::always_inline]] inline void store(const KernelRow &out, int k, const Components &value) {
  out.xx[k] = value.xx;
  out.xr[k] = value.xr;
  out.rx[k] = value.rx;
  out.rr[k] = value.rr;
}

[[gnu::always_inline]] inline void store(const KernelRow &out, int k, double value) {
  out.xx[k] = value;
}

// Kernels as the loop sees them: one row of components for each part.
template <class Kernel>
struct Plain : Kernel {
  static constexpr std::size_t parts = 1;
  [[gnu::always_inline]] static void evaluate(const Pair &p, const Normal &normal,
                                              const std::array<KernelRow, parts> &out, int k) {
    store(out[0], k, Kernel::value(p, normal, elliptic_integrals(p.m, p.m1, p.ln_m1)));
  }
};

template <class Kernel>
struct Split : Kernel {
  static constexpr std::size_t parts = 2;
  [[gnu::always_inline]] static void evaluate(const Pair &p, const Normal &normal,
                                              const std::array<KernelRow, parts> &out, int k) {
    store(out[0], k, Kernel::value(p, normal, elliptic_integrals(p.m, p.m1, 0)));
    store(out[1], k, Kernel::value(p, normal, elliptic_logarithmic(p.m1)));
  }
};

// The normals of a ring and of the target's own, each with e from the other one.
struct Normals {
  Normal ring;
  Normal target;
};

// One dipole a part.
struct BothDipoles {
  static constexpr std::size_t parts = 2;
  static constexpr int dimension = 1;
  static constexpr bool takes_normal = true;
  [[gnu::always_inline]] static void evaluate(const Pair &p, const Normals &normals,
                                              const std::array<KernelRow, parts> &out, int k) {
    const EllipticIntegrals i = elliptic_integrals(p.m, p.m1, p.ln_m1);
    const double e_over_d2 = (i.b + p.m1 * i.d) * p.over_d2;
    store(out[0], k, Dipole::value(p, p.r0, normals.ring, i.d, e_over_d2));
    store(out[1], k, Dipole::value(p, p.r, normals.target, i.d, e_over_d2));
  }
};

// Where a target and its rings come from. By reference: vector loads of copies that were just made number by number
// would wait for them.
struct ByPosition {
  double x0;
  double r0;
  const Rings &rings;
  [[gnu::always_inline]] Pair pair(int k) const {
    return pair_of(rings.x[k] - x0, rings.r[k] - r0, r0, rings.r[k]);
  }
  [[gnu::always_inline]] Normal normal(const Pair &p, int k) const {
    return {p.dx * rings.normal_x[k] + p.dr * rings.normal_r[k], rings.normal_r[k]};
  }
};

struct ByPositionWithNormal : ByPosition {
  double normal_x0;
  double normal_r0;
  [[gnu::always_inline]] Normals normal(const Pair &p, int k) const {
    return {ByPosition::normal(p, k), {-(p.dx * normal_x0 + p.dr * normal_r0), normal_r0}};
  }
};

struct BySeparation {
  double r0;
  const Rings &rings;
  const double *dx;
  const double *dr;
  const double *along_normal;
  [[gnu::always_inline]] Pair pair(int k) const { return pair_of(dx[k], dr[k], r0, rings.r[k]); }
  [[gnu::always_inline]] Normal normal(const Pair & /*p*/, int k) const {
    return {along_normal[k], rings.normal_r[k]};
  }
};

template <class Kernel, class Source>
[[gnu::always_inline]] inline void evaluate(const Source &source, int ring,
                                            const std::array<KernelRow, Kernel::parts> &out, int k) {
  const Pair pair = source.pair(ring);
  if constexpr (Kernel::takes_normal) {
    Kernel::evaluate(pair, source.normal(pair, ring), out, k);
  } else {
    Kernel::evaluate(pair, {0, 0}, out, k);
  }
}

// Rings that go through the arithmetic together: the widest vector, or several of narrower ones.
constexpr int block = 8;
using Block = std::array<double, block>;

// Fewer rings than a block: the last one is repeated.
template <class Kernel, class Source>
[[gnu::always_inline]] inline void few_rings(const Source &source,
                                             const std::array<KernelRow, Kernel::parts> &out) {
  const int count = source.rings.count;
  std::array<std::array<Block, 4>, Kernel::parts> results;
  std::array<KernelRow, Kernel::parts> rows;
  for (std::size_t part = 0; part < Kernel::parts; ++part) {
    auto &[xx, xr, rx, rr] = results[part];
    rows[part] = {xx.data(), xr.data(), rx.data(), rr.data()};
  }
#pragma omp simd
  for (int k = 0; k < block; ++k) {
    evaluate<Kernel>(source, std::min(k, count - 1), rows, k);
  }
  for (std::size_t part = 0; part < Kernel::parts; ++part) {
    std::copy_n(rows[part].xx, count, out[part].xx);
    if constexpr (Kernel::dimension == 2) {
      std::copy_n(rows[part].xr, count, out[part].xr);
      std::copy_n(rows[part].rx, count, out[part].rx);
      std::copy_n(rows[part].rr, count, out[part].rr);
    }
  }
}

// Whole blocks; the last one overlaps the one before.
template <class Kernel, class Source>
[[gnu::always_inline]] inline void all_rings(const Source &source,
                                             const std::array<KernelRow, Kernel::parts> &out) {
  const int count = source.rings.count;
  if (count > 0 && count < block) {
    few_rings<Kernel>(source, out);
    return;
  }
  for (int first = 0; first < count; first += block) {
    const int begin = std::min(first, count - block);
#pragma omp simd
    for (int k = 0; k < block; ++k) {
      evaluate<Kernel>(source, begin + k, out, begin + k);
    }
  }
}

// The same loops, compiled once for each class of processors.
struct Baseline {
  template <class Kernel, class Source, class... Rows>
  static void run(const Source &source, const Rows &...rows) {
    all_rings<Kernel>(source, {rows...});
  }
};

#ifdef __x86_64__
struct Avx2 {
  template <class Kernel, class Source, class... Rows>
  [[gnu::target("avx2,fma")]] static void run(const Source &source, const Rows &...rows) {
    all_rings<Kernel>(source, {rows...});
  }
};

struct Avx512 {
  template <class Kernel, class Source, class... Rows>
  [[gnu::target("avx512f,avx512dq,avx512vl,fma")]] static void run(const Source &source,
                                                                   const Rows &...rows) {
    all_rings<Kernel>(source, {rows...});
  }
};
#endif

template <class Processor, class Kernel>
void by_position(double x0, double r0, const Rings &rings, const KernelRow &out) {
  Processor::template run<Kernel>(ByPosition{x0, r0, rings}, out);
}

template <class Processor, class Kernel>
void by_separation(double r0, const Rings &rings, const Separations &apart, const KernelRow &smooth,
                   const KernelRow &logarithmic) {
  Processor::template run<Kernel>(
      BySeparation{r0, rings, apart.col(0).data(), apart.col(1).data(), apart.col(2).data()}, smooth,
      logarithmic);
}

template <class Processor>
void both_dipoles(double x0, double r0, double normal_x0, double normal_r0, const Rings &rings,
                  double *at_target, double *at_rings) {
  Processor::template run<BothDipoles>(ByPositionWithNormal{{x0, r0, rings}, normal_x0, normal_r0},
                                       KernelRow{at_target}, KernelRow{at_rings});
}

template <class Processor, class Kernel>
RingKernel kernel_for() {
  return {Kernel::dimension, by_position<Processor, Plain<Kernel>>, by_separation<Processor, Split<Kernel>>};
}

template <class Processor>
RingKernels kernels_for(const std::string &instructions) {
  return {instructions,
          kernel_for<Processor, Stokeslet>(),
          kernel_for<Processor, Stresslet>(),
          kernel_for<Processor, Source>(),
          kernel_for<Processor, Dipole>(),
          both_dipoles<Processor>};
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

Separations separations(double x0, double r0, const Rings &rings) {
  const auto array = [&](const double *values) {
    return Eigen::Map<const Eigen::ArrayXd>(values, rings.count);
  };
  Separations apart(rings.count, 3);
  apart.col(0) = array(rings.x) - x0;
  apart.col(1) = array(rings.r) - r0;
  apart.col(2) = apart.col(0).array() * array(rings.normal_x) + apart.col(1).array() * array(rings.normal_r);
  return apart;
}

// The best of a kind, found when it is first called.
template <RingKernel RingKernels::*kind, int dimension>
constexpr RingKernel best_of() {
  return {dimension,
          [](double x0, double r0, const Rings &rings, const KernelRow &out) {
            (best().*kind).plain(x0, r0, rings, out);
          },
          [](double r0, const Rings &rings, const Separations &apart, const KernelRow &smooth,
             const KernelRow &logarithmic) { (best().*kind).split(r0, rings, apart, smooth, logarithmic); }};
}

const RingKernel ring_stokeslet = best_of<&RingKernels::stokeslet, 2>();
const RingKernel ring_stresslet = best_of<&RingKernels::stresslet, 2>();
const RingKernel ring_source = best_of<&RingKernels::source, 1>();
const RingKernel ring_dipole = best_of<&RingKernels::dipole, 1>();
const MutualDipoles ring_mutual_dipoles = [](double x0, double r0, double normal_x0, double normal_r0,
                                             const Rings &rings, double *at_target, double *at_rings) {
  best().mutual_dipoles(x0, r0, normal_x0, normal_r0, rings, at_target, at_rings);
};

} // namespace capsule
