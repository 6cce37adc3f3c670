#pragma once
// The reasons to stop a march before its end, each a line of a table (stops.cpp).
#include "case/parameters.hpp"
#include "membrane/softening.hpp"
#include "observe/gauge.hpp"
#include "observe/records.hpp"
#include <limits>
#include <optional>
#include <span>
#include <string>

namespace capsule {

// So many dents are wrinkles.
inline constexpr int dents_of_wrinkles = 3;
// Roughness (quantities.cpp) beyond which dents are wrinkles that the mesh does not resolve.
constexpr double wrinkle_roughness = 0.4;
// The same on nodes that were chosen from the accuracy: there wrinkles have to be resolved to it.
double wrinkle_roughness_on_chosen_nodes(double accuracy);

// What to try where a membrane comes to touch the wall.
inline constexpr const char *touching_advice =
    "try a stricter accuracy (a smaller number) or a finer mesh.membrane; a capsule that is wider than the "
    "pore may need a stronger flow or a larger membrane.bending_ratio";

// By how much a membrane is strained beyond what it bears; negative: it holds.
double beyond_bearing(const UntilSpec &limits, const LargestStrain &strain);

// What is known of the membrane at an instant.
struct Instant {
  const SeriesRow &row;
  bool crosses_itself = false;
  double roughness_limit = std::numeric_limits<double>::infinity(); // beyond it dents are wrinkles
  bool bursts = false;                                              // it has come to what it bears
  std::optional<SoftestPoint> softest = {}; // unless surface viscosity slows short waves
};

struct Stop {
  const char *kind; // of the NumericsFailure
  bool (*holds)(const Instant &);
  std::string (*what)(const Instant &);
  const char *advice;
};
// In the order in which they are looked for.
std::span<const Stop> stops();

// Throws NumericsFailure for the first one that holds.
void throw_if_stopped(const Instant &instant);

} // namespace capsule
