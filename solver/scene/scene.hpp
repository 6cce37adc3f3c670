#pragma once
// What a case describes as objects, the same for marches and steady states: the pore, the membrane, its place at the
// start, and whether the membrane is still a capsule in the pore. Lengths are scaled with R_t, positions are 2N.
#include "case/case.hpp"
#include "geometry/pore.hpp"
#include "membrane/membrane.hpp"
#include "scene/resolution.hpp"
#include <optional>

namespace capsule {

struct Scene {
  std::optional<Pore> pore; // none: the liquid is unbounded
  Membrane membrane;
  Vector start; // position of the nodes at t = 0
};

// With the membrane's mesh of either preset.
Scene make_scene(const Case &physics);

// The membrane on the standard preset's mesh, nodes clustered as the resolution says.
Membrane standard_membrane(const CapsuleSpec &capsule, const MembraneSpec &material,
                           const Resolution &resolution);

// Where the flow finds a membrane. In an extension the centre of the flow moves with the capsule: that is an unstable
// place, and rounding errors would grow as exp(t).
Vector place_in_flow(FlowType flow, Vector position);

// What to try where the membrane touches the wall or reaches the end of the pore.
struct Advice {
  const char *at_the_wall, *at_the_end;
};
// Throws NumericsFailure for positions that no flow is computed for: "not-a-number"; "folded", across the axis; "exit",
// within 0.1 of the end of the way, such as a section where the flow is taken for Poiseuille's; "touching" the wall.
void require_capsule(const std::optional<Pore> &pore, const Vector &position, const Advice &advice);

} // namespace capsule
