#pragma once
// Velocity, or Laplace's potential, at a target point made by rings of sources: eq. 18, or 1/|e|, integrated over the
// azimuth of the ring.
//   target (x0, r0) at azimuth 0, rings (x_k, r_k), k = 0 ... count-1, in separate arrays
//   four components xx, xr, rx, rr: the first letter is the velocity's at the target, the second the
//     force's (stokeslet) or the velocity's (stresslet) at the ring; no area or line element is included
//   stokeslet   S_ab = integral of J_ab over the azimuth, 0 to 2 pi
//   stresslet   T_ab = integral of K_bak n_k over the azimuth, n the ring's normal
// and one component, which stands as xx:
//   source      integral of 1/(4 pi |e|) over the azimuth
//   dipole      integral of e.n/(4 pi |e|^3) over the azimuth
// Sign: with e from target to ring, eq. 18 gives K_ijk n_k = +3/(4 pi) e_i e_j (e.n)/|e|^5. So with n
// outward the integral of K_ijk n_k over a closed surface is delta_ij times 1 inside, 1/2 on it, 0 outside;
// and inside v_j = 1/(8 pi) int J_ji f_i dA + int v_i K_ijk n_k dA, f the traction on the side that n
// points to. The dipole has the same sign: with n outward its integral over a closed surface is 1 inside, 1/2 on it, 0
// outside.
// Every kernel is the sum smooth - ln(m1) logarithmic, m1 = d^2/R^2, d the distance to the nearest and R to
// the farthest point of the ring. Both parts are smooth along a smooth meridian, on the scale of the
// target's distance to the axis; the split form hands them out apart for product quadrature next to the
// target. There it asks for separations, because differences of positions may have no digits left.
// Accuracy: 1e-15 of the largest component (stokeslet, source), 2e-15 of 3/(4 pi) int 1/|e|^2 (stresslet, whose e.n
// may cancel; dipole, of a third of this), typically 2e-16, at any distance from 1e-50 to 1e50 and on the axis too.
// A ring that coincides with the target gives infinities or NaN: terms like dx^2/d^2 depend on the
// direction there. Only the logarithmic parts have a limit, and return it. Nothing is thrown.
#include "base/linear_algebra.hpp"
#include <numbers>
#include <string>
#include <vector>

namespace capsule {

// Where the components go: arrays of the rings' number. A scalar kernel has the first one alone.
struct KernelRow {
  double *xx;
  double *xr = nullptr;
  double *rx = nullptr;
  double *rr = nullptr;
};

struct Rings {
  int count;
  const double *x;
  const double *r;
  const double *normal_x; // unit normals; only stresslet and dipole read them
  const double *normal_r;
};

// The rings through some points of a curve that has these members.
template <class Curve>
Rings rings_of(const Curve &curve, Eigen::Index first, Eigen::Index count) {
  return {static_cast<int>(count), curve.x.data() + first, curve.r.data() + first,
          curve.normal_x.data() + first, curve.normal_r.data() + first};
}

// The vector e from the target to the rings' points in its half plane, axial and radial, and e.n: three columns.
using Separations = Eigen::Matrix<double, Eigen::Dynamic, 3>;
// By differences of positions.
Separations separations(double x0, double r0, const Rings &rings);

// A kernel as a value, in its plain and its split form.
struct RingKernel {
  int dimension; // 2: of vectors, with four components; 1: of scalars
  void (*plain)(double x0, double r0, const Rings &rings, const KernelRow &out);
  void (*split)(double r0, const Rings &rings, const Separations &apart, const KernelRow &smooth,
                const KernelRow &logarithmic);
};
extern const RingKernel ring_stokeslet, ring_stresslet, ring_source, ring_dipole;

// The dipole at a target from each ring and, with target and ring in each other's place, at the rings from the target's own
// ring, which has this normal. As accurate as the plain dipole, in little more than its time.
using MutualDipoles = void (*)(double x0, double r0, double normal_x0, double normal_r0, const Rings &rings,
                               double *at_target, double *at_rings);
extern const MutualDipoles ring_mutual_dipoles;

// What the single layer has in front of the stokeslet in eq. 16. No kernel and no layer includes it.
constexpr double stokeslet_factor = 1 / (8 * std::numbers::pi);

// The kernels compiled for a class of processors. Those above are the first of those that run here; the others
// are for tests and benchmarks.
struct RingKernels {
  std::string instructions; // "avx512", "avx2", "baseline"
  RingKernel stokeslet, stresslet, source, dipole;
  MutualDipoles mutual_dipoles;
};
std::vector<RingKernels> available_ring_kernels();

} // namespace capsule
