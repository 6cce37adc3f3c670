#include "output/summary.hpp"
#include "base/atomic_file.hpp"
#include "base/json_file.hpp"
#include "case/key_path.hpp"
#include "case/keys.hpp"
#include "case/physical.hpp"
#include "case/value_lists.hpp"
#include "observe/outcome.hpp"
#include "observe/quantities.hpp"
#include "observe/transit.hpp"
#include "observe/unit_of.hpp"
#include "output/checkpoint.hpp"
#include "output/tables.hpp"
#include "scene/resolution.hpp"
#include <cerrno>
#include <cmath>
#include <fmt/format.h>

namespace capsule {
namespace {

Json to_json(const Value &value) {
  return std::visit(
      [](const auto &v) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(v)>, Unsupported>)
          return {};
        else
          return v;
      },
      value);
}

// Of the change of the resistance over the empty pore's.
Json relative_pulse_height(const Json &summary) {
  const Json &height = summary.at("transit").at("pulse_height"), &empty = summary.at("empty_resistance");
  return height.is_number() && empty.is_number() ? Json(height.get<double>() / empty.get<double>()) : Json();
}

// The values of a summary in SI units, by their name and unit.
Json physical_json(const Case &physics, const Json &summary) {
  const Scales scales = physical_scales(physics);
  const auto in_units = [&](const Json &values, const std::string &prefix) {
    Json table = Json::object();
    for (const auto &[name, value] : values.items())
      if (const auto unit = unit_of(prefix + name); value.is_number() && has_scale(unit, scales))
        table[name_with_unit(name, *unit)] = value.get<double>() * scales.*unit->scale;
    return table;
  };
  Json json = in_units(summary, "");
  if (const auto transit = summary.find("transit"); transit != summary.end())
    json["transit"] = in_units(*transit, "transit_");
  json[fmt::format("tension scale [{}]", unit_text(dimension::tension))] = scales.tension;
  return json;
}

Json errors_json(const std::map<std::string, double> &errors) {
  Json json = Json::object();
  for (const auto &[quantity, error] : errors)
    json[quantity] = finite_or_null(error);
  return json;
}

// The last row of a capsule behind the leading one.
Json end_of(const std::vector<SeriesRow> &series) {
  Json json = Json::object();
  if (!series.empty())
    for (const ReportedQuantity &quantity : reported_quantities())
      if (is_reported(quantity, series.back()))
        json[quantity.name] = finite_or_null(series.back().*quantity.value);
  return json;
}

bool applies(const ReportedQuantity &quantity, const Case &physics) {
  return physics.flow.type == FlowType::pore || !quantity.of_the_pore;
}

Json fold_json(const Case &physics, const std::string &along, const BranchRow &fold) {
  Json json{{along, fold.parameter}, {"growth_rate", fold.growth_rate}};
  for (const ReportedQuantity &quantity : branch_quantities())
    if (applies(quantity, physics) && is_reported(quantity, fold.row))
      json[quantity.name] = finite_or_null(fold.row.*quantity.value);
  if (has_physical(physics))
    for (const auto &[name, value] : physical_values(physics, along, fold))
      json["physical"][name] = finite_or_null(value);
  json["error_estimate"] = errors_json(fold.error_estimate);
  return json;
}

} // namespace

std::string summary_text(const Case &physics, const Outcome &outcome, const Effort &effort) {
  Json json;
  json["status"] = word_of(outcome.status);
  json["failure"] = outcome.failure.empty() ? Json() : Json(outcome.failure);
  json["message"] = outcome.message.empty() ? Json() : Json(outcome.message);
  const std::vector<SeriesRow> &series = outcome.last.series;
  for (std::size_t k = 0; k < outcome.last.followers.size(); ++k) {
    Json &follower = json["capsules"][std::to_string(k + 2)];
    follower = end_of(outcome.last.followers[k].series);
    if (in_physical_units(physics, outcome))
      follower["physical"] = physical_json(physics.followers.at(k), follower);
  }
  for (const ReportedQuantity &quantity : reported_quantities())
    if (is_reported(quantity, series.empty() ? SeriesRow{} : series.back()))
      json[quantity.name] = applies(quantity, physics) && !series.empty()
                                ? finite_or_null(series.back().*quantity.value)
                                : Json();
  const bool has_pore = physics.flow.type == FlowType::pore;
  const bool moved = outcome.status != Status::steady && outcome.along.empty();
  const auto peak = moved && has_pore ? entry_peak(series) : std::nullopt;
  for (const PeakQuantity &quantity : peak_quantities())
    json[quantity.name] = peak ? finite_or_null((*peak).*quantity.value) : Json();
  for (const LargestQuantity &quantity : largest_quantities()) {
    const auto largest = moved ? largest_on_the_way(series, quantity.value, quantity.S) : std::nullopt;
    const std::string name = std::string("largest_") + quantity.name;
    json[name] = largest ? finite_or_null(largest->value) : Json();
    json["x_g_at_" + name] = largest && has_pore ? finite_or_null(largest->x_g) : Json();
    json["S_at_" + name] = largest ? finite_or_null(largest->S) : Json();
  }
  if (const auto transit = moved ? transit_of(physics, series) : std::nullopt)
    for (const TransitQuantity &quantity : transit_quantities())
      json["transit"][quantity.name] = finite_or_null(quantity.of(*transit));
  for (const auto &[quantity, value] : outcome.further)
    json[quantity] = finite_or_null(value);
  if (json.contains("transit") && json.contains("empty_resistance"))
    json["transit"]["relative_pulse_height"] = relative_pulse_height(json);
  if (in_physical_units(physics, outcome))
    json["physical"] = physical_json(physics, json);
  if (!outcome.along.empty()) {
    json["along"] = outcome.along;
    json["folds"] = Json::array();
    for (const BranchRow &fold : outcome.folds)
      json["folds"].push_back(fold_json(physics, outcome.along, fold));
    if (!outcome.fold_along.empty())
      json["fold_along"] = outcome.fold_along;
    if (!outcome.fold_curve.empty()) {
      const auto &[second, fold] = outcome.fold_curve.back();
      Json &end = json["fold_curve_end"];
      end = fold_json(with_number(physics, outcome.fold_along, second), outcome.along, fold);
      end[outcome.fold_along] = second;
    }
  }
  json["error_estimate"] = errors_json(outcome.error_estimate);
  json["steps"] = outcome.last.steps;
  json["cpu_seconds"] = effort.cpu_seconds;
  json["wall_seconds"] = effort.wall_seconds;
  // Complete: also what followed from the accuracy asked for.
  Case resolved = physics;
  const Resolution chosen = choose_resolution(physics);
  resolved.mesh.membrane = outcome.membrane_nodes > 0 ? outcome.membrane_nodes : chosen.membrane_nodes;
  for (std::size_t k = 0; k < resolved.followers.size(); ++k)
    resolved.followers[k].mesh.membrane = outcome.nodes_of_followers.empty()
                                              ? choose_resolution(resolved.followers[k]).membrane_nodes
                                              : outcome.nodes_of_followers.at(k);
  if (physics.time.scheme == Scheme::bdf)
    resolved.time.tolerance = chosen.time_tolerance;
  json["parameters"] = Json::object();
  for (const Key &key : keys()) {
    if (is_of_fits(key))
      continue;
    const auto value = value_of(key, resolved);
    json["parameters"][key.name] = value ? to_json(*value) : Json();
  }
  return json_text(json, 2) + "\n";
}

Summary read_summary(const std::filesystem::path &directory) {
  const std::filesystem::path file = directory / "summary.json";
  const auto json = read_json(file);
  if (!json)
    fail_at("cannot read", file, ENOENT);
  try {
    Summary summary;
    const auto text = [&](const char *key) {
      const Json &value = json->at(key);
      return value.is_string() ? value.get<std::string>() : std::string();
    };
    summary.status = text("status");
    summary.failure = text("failure");
    summary.message = text("message");
    if (json->contains("along")) {
      summary.along = text("along");
      const auto place_of = [&](const Json &fold) -> FoldPlace {
        const Json errors = fold.value("error_estimate", Json::object()); // not of earlier versions
        const Json error = errors.value(summary.along, Json());
        return {fold.at(summary.along), fold.at("max_stretch"),
                error.is_number() ? std::optional(error.get<double>()) : std::nullopt};
      };
      for (const Json &fold : json->at("folds"))
        summary.folds.push_back(place_of(fold));
      if (json->contains("fold_curve_end")) {
        const Json &end = json->at("fold_curve_end");
        const std::string second = text("fold_along");
        summary.end_of_fold_curve = {second, end.at(second), place_of(end)};
      }
    }
    for (const auto &[name, value] : json->items())
      if (value.is_number())
        summary.quantities[name] = value;
    if (json->contains("capsules"))
      for (const auto &[number, values] : json->at("capsules").items())
        for (const auto &[name, value] : values.items())
          if (value.is_number())
            summary.quantities[fmt::format("{}#{}", name, number)] = value;
    if (json->contains("transit"))
      for (const auto &[name, value] : json->at("transit").items())
        if (value.is_number())
          summary.quantities["transit_" + name] = value;
    for (const auto &[name, value] : json->at("error_estimate").items())
      if (value.is_number())
        summary.error_estimate[name] = value;
    return summary;
  } catch (const Json::exception &error) {
    fail_to_use(file, error);
  }
}

} // namespace capsule
