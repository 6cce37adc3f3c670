#pragma once
// Load of the membrane on the liquids, eqs. 2-7, on the cubic splines of section 3.
//   Nodes: N + 1, equidistant in the parameter zeta of the reference ellipse X = -A cos(zeta), R = B
//   sin(zeta). q is the force per deformed area, scaled with G/R_t.
// How eq. 7 is differentiated, on which the paper is silent:
//   tensions   from the derivatives of the meridian's spline at the very point where q is asked for
//   moments    eq. 6 at the nodes, splined with even parity; eq. 7 takes first and second derivatives of
//   these splines
// Splines of the shear force or of q through their nodal values do not see a mode that alternates from node
// to node and let it grow; the measurements are in paper-notes/paper-preset.md.
// Throws nothing.
#include "case/parameters.hpp"
#include "law/law.hpp"
#include "paper/paper_elements.hpp"

namespace capsule {

// A meridian as a pair of splines, x even and r odd at both poles (eqs. 19-22): N + 3 coefficients each.
struct MeridianSpline {
  Vector x, r;
};

// Position and derivatives with respect to the elements' parameter.
struct MeridianSamples {
  Vector x, r;
  Vector x_slope, r_slope;
  Vector x_second, r_second;
};
MeridianSamples sample_meridian(const MeridianSpline &meridian, const ShapeTable &shapes);

struct PaperLoad {
  MembraneLaw law;
  double bending_ratio = 0;
  Matrix even_coefficients; // (N+3) x (N+1), from nodal values: first derivative zero at both ends
  Matrix odd_coefficients;  // second derivative zero
  MeridianSpline
      reference; // through the nodes of the stress-free ellipse, so that the undeformed capsule is free of load
};
PaperLoad make_paper_load(const CapsuleSpec &capsule, const MembraneSpec &material, int elements);

MeridianSpline spline_through(const PaperLoad &load, const Vector &position);

// Splines of eq. 6.
struct MomentSplines {
  Vector meridional, azimuthal;
};
MomentSplines moment_splines(const PaperLoad &load, const MeridianSpline &meridian);

// Components of q at the points of a rule; not at the poles.
struct LoadSamples {
  Vector x, r;
};
LoadSamples load_samples(const PaperLoad &load, const MeridianSpline &meridian, const MomentSplines &moments,
                         const ShapeTable &shapes);

} // namespace capsule
