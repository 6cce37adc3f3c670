#pragma once
// What a case describes as objects, the same for marches and steady states: the pore, the membranes, their place at the
// start, and whether a membrane is still a capsule in the pore. Lengths are scaled with R_t. The position of one membrane
// is 2N; those of several are stacked as in membrane_mesh.hpp.
#include "base/failure.hpp"
#include "case/case.hpp"
#include "geometry/pore.hpp"
#include "membrane/membrane.hpp"
#include "scene/resolution.hpp"
#include <cstddef>
#include <fmt/format.h>
#include <optional>
#include <vector>

namespace capsule {

struct Scene {
  std::optional<Pore> pore;        // none: the liquid is unbounded
  Membrane membrane;               // the leading capsule's
  std::vector<Membrane> followers; // of those behind it
  Vector start;                    // position of all nodes at t = 0

  std::size_t capsules() const { return 1 + followers.size(); }
  const Membrane &membrane_of(std::size_t capsule) const {
    return capsule == 0 ? membrane : followers.at(capsule - 1);
  }
};

// With the membranes' meshes of either preset.
Scene make_scene(const Case &physics);
// The electric resistance of the empty pore, where the case asks for resistances.
std::optional<double> empty_resistance(const Case &physics);
// Where the components of each membrane stand in a position of all.
std::vector<std::vector<Eigen::Index>> rows_of_capsules(const Scene &scene);

// The membrane on the standard preset's mesh, nodes clustered as the resolution says.
Membrane standard_membrane(const CapsuleSpec &capsule, const MembraneSpec &material,
                           const Resolution &resolution);

// Where the flow finds a membrane. In an extension the centre of the flow moves with the capsule: that is an unstable
// place, and rounding errors would grow as exp(t).
Vector place_in_flow(FlowType flow, Vector position);

// The gap in a tube beyond which capsules do not feel each other, to a relative accuracy: what one does to the liquid falls
// with the distance d like exp(-4.466 d), the slowest of Stokes flows at rest on the wall.
double gap_without_interaction(double accuracy);

// What to try where the membrane touches the wall or reaches the end of the pore.
struct Advice {
  const char *at_the_wall, *at_the_end;
};
// Throws NumericsFailure for positions that no flow is computed for: "not-a-number"; "folded", across the axis; "exit",
// within 0.1 of the end of the way, such as a section where the flow is taken for Poiseuille's; "touching" the wall.
void require_capsule(const std::optional<Pore> &pore, const Vector &position, const Advice &advice);
// Of the membranes of a scene, and "touching" where two of them do. Where there are several, failures name the capsule.
void require_capsules(const Scene &scene, const Vector &position, const Advice &advice);

// What a function of one capsule's number throws, with that number before it where the scene has several.
template <class Function>
void for_each_capsule(const Scene &scene, const Function &function) {
  for (std::size_t k = 0; k < scene.capsules(); ++k)
    try {
      function(k);
    } catch (const NumericsFailure &failure) {
      if (scene.capsules() == 1)
        throw;
      NumericsFailure named(failure.kind, fmt::format("capsule {}: {}", k + 1, failure.what()),
                            failure.advice);
      named.capsule = k;
      throw named;
    }
}

} // namespace capsule
