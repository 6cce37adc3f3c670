// Time of what a step is made of, for Table 1's capsule at the mouth: assembly, velocity, Jacobian and its factors, a
// whole step of each preset.
#include "membrane/load.hpp"
#include "motion/dynamics.hpp"
#include "scene/make_flow.hpp"
#include "scene/resolution.hpp"

#include <benchmark/benchmark.h>

using namespace capsule;

namespace {

Case table1(double viscosity_ratio, int nodes) {
  Case physics;
  physics.capsule.radius = 0.8;
  physics.capsule.start_x = -0.2;
  physics.flow.capillary_number = 0.09;
  physics.flow.viscosity_ratio = viscosity_ratio;
  physics.mesh.membrane = nodes;
  return physics;
}

// Ranges: the nodes of the membrane, the viscosity ratio.
Case asked_for(const benchmark::State &state) {
  return table1(static_cast<double>(state.range(1)), static_cast<int>(state.range(0)));
}

void assembly(benchmark::State &state) {
  const Case physics = asked_for(state);
  const Dynamics dynamics = make_dynamics(physics);
  const Flow flow = make_flow(dynamics.scene->pore, physics.flow, dynamics.scene->membrane.basis,
                              choose_resolution(physics).flow);
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(flow.interact(dynamics.scene->start));
}

void load(benchmark::State &state) {
  const Dynamics dynamics = make_dynamics(asked_for(state));
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(membrane_load(dynamics.scene->membrane, dynamics.scene->start));
}

void velocity(benchmark::State &state) {
  const Dynamics dynamics = make_dynamics(asked_for(state));
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(dynamics.flow(dynamics.scene->start));
}

void jacobian(benchmark::State &state) {
  const Dynamics dynamics = make_dynamics(asked_for(state));
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(dynamics.jacobian(dynamics.scene->start));
}

void factors(benchmark::State &state) {
  const Dynamics dynamics = make_dynamics(asked_for(state));
  const Matrix matrix = dynamics.jacobian(dynamics.scene->start);
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(matrix.partialPivLu());
}

// Euler's step of the paper: one velocity with a new LU decomposition.
void paper_step(benchmark::State &state) {
  Case physics = asked_for(state);
  physics.numerics = Numerics::paper;
  physics.mesh.wall = 120;
  physics.mesh.exit = 30;
  const Dynamics dynamics = make_dynamics(physics);
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(dynamics.flow(dynamics.scene->start));
}

const std::vector<std::vector<std::int64_t>> sizes{{64, 96}, {1, 5}};
BENCHMARK(assembly)->ArgsProduct(sizes)->Unit(benchmark::kMicrosecond);
BENCHMARK(load)->ArgsProduct({{64, 96}, {1}})->Unit(benchmark::kMicrosecond);
BENCHMARK(velocity)->ArgsProduct(sizes)->Unit(benchmark::kMicrosecond);
BENCHMARK(jacobian)->ArgsProduct(sizes)->Unit(benchmark::kMicrosecond);
BENCHMARK(factors)->ArgsProduct({{64, 96}, {1}})->Unit(benchmark::kMicrosecond);
BENCHMARK(paper_step)->ArgsProduct({{30, 60, 120}, {1}})->Unit(benchmark::kMicrosecond);

} // namespace

BENCHMARK_MAIN();
