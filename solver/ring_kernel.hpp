#pragma once
// Velocity at a target point made by rings of sources: eq. 18 integrated over the azimuth of the ring.
//   target (x0, r0) at azimuth 0, rings (x_k, r_k), k = 0 ... count-1, in separate arrays
//   a kernel has four components: xx, xr, rx, rr; the first letter is the velocity's at the target, the
//   second the force's (stokeslet) or the velocity's (stresslet) at the ring. No area or line element is
//   included. stokeslet   S_ab = integral of J_ab over the azimuth, 0 to 2 pi stresslet   T_ab = integral of
//   K_bak n_k over the azimuth, n the ring's normal, K of eq. 18: with e from the target
//               to the ring, K_ijk n_k = +3/(4 pi) e_i e_j (e.n)/|e|^5, so that the integral of K_ijk n_k
//               over a closed surface with n outward is delta_ij times 1 inside, 1/2 on it (principal value),
//               0 outside
// Every kernel is the sum  smooth(k) - ln(m1(k)) * logarithmic(k),  m1 = d^2/R^2 with d the distance to the
// nearest and R to the farthest point of the ring; both parts are smooth functions along a smooth meridian,
// and the split form hands them out apart for product quadrature on the panels that hold the target. All are
// finite for r0 = 0 or r_k = 0; a ring that coincides with the target gives an infinity or a NaN in the
// unsplit kernels. Accuracy: see elliptic.hpp.
#include <string>
#include <vector>

namespace capsule {

// Where the four components go: arrays of the rings' number.
struct KernelRow {
  double *xx;
  double *xr;
  double *rx;
  double *rr;
};

struct Rings {
  int count;
  const double *x;
  const double *r;
  const double *normal_x; // unit normals; only the stresslet reads them
  const double *normal_r;
};

void ring_stokeslet(double x0, double r0, const Rings &rings, const KernelRow &out);
void ring_stresslet(double x0, double r0, const Rings &rings, const KernelRow &out);
void ring_stokeslet_split(double x0, double r0, const Rings &rings, const KernelRow &smooth,
                          const KernelRow &logarithmic);
void ring_stresslet_split(double x0, double r0, const Rings &rings, const KernelRow &smooth,
                          const KernelRow &logarithmic);

// The four kernels compiled for a class of processors. The functions above are the first of those that run
// here; the others are for tests and benchmarks.
struct RingKernels {
  std::string instructions; // "avx512", "avx2", "baseline"
  decltype(&ring_stokeslet) stokeslet;
  decltype(&ring_stresslet) stresslet;
  decltype(&ring_stokeslet_split) stokeslet_split;
  decltype(&ring_stresslet_split) stresslet_split;
};
std::vector<RingKernels> available_ring_kernels();

} // namespace capsule
