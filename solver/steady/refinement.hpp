#pragma once
// A steady state on finer and finer meshes until its error is as small as asked for, and what is reported of it.
#include "observe/gauge.hpp"
#include "observe/outcome.hpp"
#include "steady/mesh_change.hpp"
#include <array>
#include <map>
#include <string>
#include <vector>

namespace capsule {

struct RefinedState {
  SteadyState state;
  std::map<std::string, double> error_estimate; // from coarser meshes and the two pressure drops
  std::string warning;                          // when they are larger than asked for
  std::vector<SteadyState> coarser = {};        // of a train: what it was compared with
};
// Until the last two meshes agree to the accuracy asked for, in the pressure drop and other integrals to a tenth of it.
// With a given mesh.membrane, on that mesh and on two coarser ones. Throws NumericsFailure,
// Interrupted, and what `spend` of `control` throws.
RefinedState refine(const Case &input, const SteadyState &state, const Control &control);

// At time 0 and x_g = 0.
struct SteadyRecord {
  SeriesRow row;
  Profile profile;
  // growth_rate, oscillation_rate, growth_per_length; of a train apparent_viscosity and pairing_growth_rate, too
  std::map<std::string, double> further;
};
SteadyRecord record_steady(const SteadyState &state);
// The same where the linearisation at the state is known, and a gauge of the state's membrane and pore.
SteadyRecord record_steady(const SteadyState &state, const SteadySystem::Linearisation &linear,
                           const Gauge &gauge);
Gauge gauge_of(const SteadySystem &system);

inline constexpr double error_safety = 2; // for what agrees by accident (paper-notes/methods.md)
// Errors of the finest of several meshes: its differences from coarser ones, and the quadrature's error, which all may
// share; times error_safety.
std::map<std::string, double> errors_of(const SeriesRow &fine, const std::vector<SeriesRow> &coarser);
// It shows between the two pressure drops, and is as large a part of any quantity.
double relative_error_of_quadrature(const SeriesRow &row);
// Of a state, without rates.
SeriesRow row_of(const SteadyState &state);

// Of a train: two meshes of the membrane may have one wall and err alike. How much a wall errs depends on where its panels
// end beside the capsules, and with either sign: one other wall may agree by accident.
inline constexpr std::array coarser_walls{CoarserMesh{.longer = 10.0 / 9}, CoarserMesh{.longer = 5.0 / 4}};

// One coarser mesh may agree by accident; in one of many quantities it often does. The second one has a coarser wall, too,
// because meshes that share a wall err alike.
inline constexpr CoarserMesh first_mesh{.nodes = 0.75},
    second_mesh{.nodes = 0.875, .longer = coarser_walls[1].longer};

// Of `further` of a train, as of all else: the differences from coarser meshes and the error of the quadrature.
std::map<std::string, double> errors_of_further(const RefinedState &refined, const SteadyRecord &record);

} // namespace capsule
