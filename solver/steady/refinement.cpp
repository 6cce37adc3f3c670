#include "steady/refinement.hpp"
#include "case/physical.hpp"
#include "flow/undisturbed.hpp"
#include "observe/quantities.hpp"
#include "steady/growth_rates.hpp"
#include "steady/work.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <fmt/format.h>

namespace capsule {
namespace {

double error_of_quadrature(const SeriesRow &row) {
  return std::abs(row.pressure_drop - row.pressure_drop_reciprocal);
}

// Whether two meshes agree to the accuracy, or as much of it as each quantity asks for. The finer mesh is closer to the
// truth by an order or more.
bool agree(const SeriesRow &a, const SeriesRow &b, double accuracy) {
  return std::ranges::all_of(reported_quantities(), [&](const ReportedQuantity &quantity) {
    const auto &[share, relative] = quantity.agreement;
    const double value = a.*quantity.value;
    return share == 0 || !is_reported(quantity, a) ||
           std::abs(value - b.*quantity.value) <= share * accuracy * (relative ? std::abs(value) : 1);
  });
}

std::string poorly_resolved(int nodes) {
  return fmt::format("meshes up to {} nodes differ by more than the accuracy asked for; a larger "
                     "membrane.bending_ratio has smoother shapes",
                     nodes);
}

// Row and profile of a state with its centre at x = 0; no rates yet.
SteadyRecord measure(const SteadyState &state, const Gauge &gauge) {
  const SteadySystem &system = *state.system;
  Vector position = state.unknowns.head(2 * system.nodes());
  position.head(system.nodes()).array() -= gauge.centre(position);
  const FlowState flow = system.flow(position);
  SteadyRecord record{gauge.row(0, position, flow.velocity), gauge.profile(0, position, flow.velocity), {}};
  record.row.x_g = 0; // exactly
  record.profile.x_g = 0;
  record.row.pressure_drop = flow.pressure_drop;
  record.row.pressure_drop_reciprocal = flow.pressure_drop_reciprocal;
  record.row.flow_rate = flow.flow_rate;
  if (system.input().flow.period > 0)
    record.row.min_gap = system.gap_to_next(position);
  return record;
}

// Its errors by states on coarser meshes and, of a train, with coarser walls. The row of the first of them is known.
void estimate_errors(RefinedState &refined, const SeriesRow &row, const SeriesRow &first,
                     std::vector<SteadyState> coarser) {
  const bool is_train = refined.state.system->input().flow.period > 0;
  if (is_train)
    for (const CoarserMesh &mesh : coarser_walls)
      coarser.push_back(on_coarser(refined.state, mesh));
  std::vector<SeriesRow> rows{first};
  std::transform(coarser.begin() + 1, coarser.end(), std::back_inserter(rows), row_of);
  refined.error_estimate = errors_of(row, rows);
  if (is_train)
    refined.coarser = std::move(coarser);
}

SteadyState second_coarser(const Case &input, const SteadyState &fine, const Control &control) {
  try {
    return on_coarser(fine, second_mesh);
  } catch (const NumericsFailure &) {
    return on_mesh(input, nodes_of(second_mesh, fine.system->nodes()), fine, control);
  }
}

// Throws NumericsFailure, which says that a coarser mesh has a state.
SteadyState on_finer_mesh(const Case &input, int nodes, const SteadyState &coarser, const Control &control) {
  constexpr double most_work = 400; // where Newton's method does not go there at once
  try {
    return within(most_work, control,
                  [&](const Control &limited) { return on_mesh(input, nodes, coarser, limited); });
  } catch (const NumericsFailure &failure) {
    throw NumericsFailure(failure.kind,
                          fmt::format("a state on {} nodes is not found on {}: {}", coarser.system->nodes(),
                                      nodes, failure.what()),
                          failure.advice);
  }
}

} // namespace

double relative_error_of_quadrature(const SeriesRow &row) {
  return error_of_quadrature(row) / std::max(std::abs(row.pressure_drop), 1.0);
}

std::map<std::string, double> errors_of(const SeriesRow &fine, const std::vector<SeriesRow> &coarser) {
  const double quadrature = error_of_quadrature(fine);
  const double relative = relative_error_of_quadrature(fine);
  const auto of_quadrature = [&](double SeriesRow::*value) {
    return value == &SeriesRow::pressure_drop ? quadrature
           : value == &SeriesRow::flow_rate   ? (1 - fine.flow_rate) * relative
                                              : relative;
  };
  std::map<std::string, double> errors;
  for (const ReportedQuantity &quantity : reported_quantities()) {
    const double value = fine.*quantity.value;
    if (quantity.error == ErrorEstimate::by_value_itself)
      errors[quantity.name] = std::abs(value);
    else if (quantity.error == ErrorEstimate::of_all && is_reported(quantity, fine)) {
      double &error = errors[quantity.name];
      error = of_quadrature(quantity.value);
      for (const SeriesRow &coarse : coarser)
        error += std::abs(value - coarse.*quantity.value);
      error *= error_safety;
    }
  }
  return errors;
}

SeriesRow row_of(const SteadyState &state) {
  return measure(state, gauge_of(*state.system)).row;
}

RefinedState refine(const Case &input, const SteadyState &state, const Control &control) {
  const bool given = input.mesh.membrane > 0;
  RefinedState refined{given ? on_mesh(input, input.mesh.membrane, state, control) : state, {}, ""};
  auto nodes = static_cast<int>(refined.state.system->nodes());
  refined.state.system->require_stiffness(refined.state.unknowns);
  SeriesRow row = row_of(refined.state);
  if (given || finer_mesh(nodes) > most_nodes) { // no finer mesh: coarser ones tell the error
    const SteadyState coarser = on_mesh(input, nodes_of(first_mesh, nodes), refined.state, control);
    const SeriesRow coarse = row_of(coarser);
    estimate_errors(refined, row, coarse, {coarser, second_coarser(input, refined.state, control)});
    if (!given && !agree(row, coarse, input.accuracy))
      refined.warning = with_physical_keys(poorly_resolved(nodes), input);
    return refined;
  }
  for (;;) {
    throw_if_interrupted(control);
    nodes = finer_mesh(nodes);
    const SteadyState coarser = refined.state;
    refined.state = on_finer_mesh(input, nodes, coarser, control);
    const SeriesRow before = row;
    refined.state.system->require_stiffness(refined.state.unknowns);
    row = row_of(refined.state);
    const bool enough = agree(row, before, input.accuracy);
    if (!enough && finer_mesh(nodes) <= most_nodes)
      continue;
    estimate_errors(refined, row, before, {coarser, second_coarser(input, refined.state, control)});
    if (!enough)
      refined.warning = with_physical_keys(poorly_resolved(nodes), input);
    return refined;
  }
}

SteadyRecord record_steady(const SteadyState &state) {
  return record_steady(state, state.system->linearise(state.unknowns), gauge_of(*state.system));
}

Gauge gauge_of(const SteadySystem &system) {
  return {system.pore(), system.membrane(),
          system.input().output.resistance ? std::optional(system.resolution().flow) : std::nullopt};
}

SteadyRecord record_steady(const SteadyState &state, const SteadySystem::Linearisation &linear,
                           const Gauge &gauge) {
  const SteadySystem &system = *state.system;
  SteadyRecord record = measure(state, gauge);
  const std::complex<double> slowest = slowest_rate(system, linear);
  record.further = {{"growth_rate", slowest.real()}, {"oscillation_rate", std::abs(slowest.imag())}};
  if (system.input().flow.type == FlowType::pore)
    record.further["growth_per_length"] = slowest.real() / record.row.v_g;
  const double period = system.input().flow.period;
  if (period > 0) {
    record.further["apparent_viscosity"] = 1 + record.row.pressure_drop / poiseuille_pressure_drop(period);
    record.further["pairing_growth_rate"] =
        slowest_rate(system, system.linearise(state.unknowns, Neighbours::opposed), Neighbours::opposed)
            .real();
  }
  return record;
}

std::map<std::string, double> errors_of_further(const RefinedState &refined, const SteadyRecord &record) {
  std::map<std::string, double> errors;
  for (const SteadyState &coarse : refined.coarser)
    for (const auto &[quantity, value] : record_steady(coarse).further)
      errors[quantity] += std::abs(record.further.at(quantity) - value);
  for (auto &[quantity, error] : errors)
    error = error_safety * (error + relative_error_of_quadrature(record.row));
  return errors;
}

} // namespace capsule
