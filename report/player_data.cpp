#include "player_data.hpp"
#include "base/atomic_file.hpp"
#include "base/csv.hpp"
#include "base/text.hpp"
#include "law/law.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <numbers>
#include <string>

namespace report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct PlayerField {
  std::string column, name;
  double neutral; // the value of the undeformed membrane
};
const std::vector<PlayerField> player_fields = {{"stretch_meridional", "meridional stretch", 1},
                                                {"stretch_azimuthal", "azimuthal stretch", 1},
                                                {"tension_meridional", "meridional tension", 0},
                                                {"tension_azimuthal", "azimuthal tension", 0}};

// A column of the series, in the second capsule's file where it stands behind another.
struct PlayerQuantity {
  std::string column, name, symbol; // after _ and ^ one letter is set lower or higher
  double base;                      // the axis begins here, or lower
  bool of_second_capsule = false;
};
const std::vector<PlayerQuantity> player_quantities = {
    {"pressure_drop", "extra pressure drop", "ΔP / (μQ/πR_t^3)", 0},
    {"v_g", "velocity", "v_g / (Q/πR_t^2)", 0},
    {"min_film", "film", "film / R_t", 0},
    {"max_stretch", "largest stretch", "largest stretch", 1},
    {"max_tension", "largest tension", "largest tension / G", 0},
    {"resistance", "resistance pulse", "ΔR / (ρ/πR_t)", 0},
    {"flow_rate", "flow rate", "Q / Q_0", 0},
    {"min_gap", "gap between the capsules", "gap / R_t", 0, true}};

Json rounded(const std::vector<double> &values, int decimals) {
  const double scale = std::pow(10, decimals);
  Json numbers = Json::array();
  for (const double value : values)
    numbers.push_back(std::round(value * scale) / scale);
  return numbers;
}

// The rows at which the profiles of a run begin, in the order in which they were taken, and the end of the last one.
std::vector<std::size_t> profile_bounds(const std::vector<double> &time) {
  std::vector<std::size_t> bounds;
  for (std::size_t i = 0; i < time.size(); ++i)
    if (i == 0 || time[i] != time[i - 1])
      bounds.push_back(i);
  bounds.push_back(time.size());
  return bounds;
}

// A capsule in a frame of the player: the profile in the rows from `first` to before `last`.
Json player_capsule(const capsule::Columns &profiles, std::size_t first, std::size_t last) {
  constexpr std::size_t most_points = 128; // of a profile; the eye sees no more
  constexpr int decimals = 3;
  const std::size_t stride = 1 + (last - first) / most_points;
  const auto part = [&](const std::string &name) {
    const std::vector<double> &whole = profiles.at(name);
    std::vector<double> thinned;
    for (std::size_t i = first; i + 1 < last; i += stride)
      thinned.push_back(whole[i]);
    thinned.push_back(whole[last - 1]);
    return rounded(thinned, decimals);
  };
  Json fields = Json::array();
  for (const PlayerField &field : player_fields)
    fields.push_back(part(field.column));
  return {{"x", part("x")}, {"r", part("r")}, {"fields", fields}};
}

fs::path file_of(const fs::path &run, const std::string &name, std::size_t capsule) {
  return run / (capsule == 1 ? name + ".csv" : fmt::format("{}-{}.csv", name, capsule));
}

// The frames of a run with all its capsules, whose profiles are of the same times; empty if there are too few to be played.
Json player_frames(const fs::path &run) {
  constexpr std::size_t fewest_frames = 20;
  Json frames = Json::array();
  for (std::size_t capsule = 1;; ++capsule) {
    const fs::path file = file_of(run, "profiles", capsule);
    if (!fs::exists(file))
      return frames;
    const capsule::Columns profiles = capsule::read_columns(file);
    const std::vector<std::size_t> bounds = profile_bounds(profiles.at("time"));
    if (bounds.size() <= fewest_frames + 1)
      return frames;
    for (std::size_t k = 0; k + 1 < bounds.size(); ++k) {
      if (capsule == 1)
        frames.push_back({{"time", profiles.at("time")[bounds[k]]},
                          {"x_g", profiles.at("x_g")[bounds[k]]},
                          {"capsules", Json::array()}});
      frames.at(k).at("capsules").push_back(player_capsule(profiles, bounds[k], bounds[k + 1]));
    }
  }
}

// The decimals that an estimated error leaves; two if there is no estimate.
int known_decimals(const Json &estimates, const std::string &quantity) {
  constexpr int most = 6;
  const Json error = estimates.value(quantity, Json());
  if (!error.is_number() || error.get<double>() <= 0)
    return error.is_number() ? most : 2;
  return std::clamp(static_cast<int>(-std::floor(std::log10(error.get<double>()))), 0, most);
}

// By name: {decimals, values[]}; what the run has not, or what does not change in it, is left out.
Json player_series(const fs::path &run, const Json &estimates) {
  const capsule::Columns leading = capsule::read_columns(file_of(run, "series", 1));
  const fs::path second_file = file_of(run, "series", 2);
  const capsule::Columns second =
      fs::exists(second_file) ? capsule::read_columns(second_file) : capsule::Columns();
  Json series;
  for (const std::string name : {"x_g", "time"})
    series[name] = {{"decimals", std::min(known_decimals(estimates, "time@x_g"), 4)},
                    {"values", rounded(leading.at(name), 6)}};
  for (const PlayerQuantity &quantity : player_quantities) {
    const capsule::Columns &columns = quantity.of_second_capsule ? second : leading;
    const auto found = columns.find(quantity.column);
    if (found == columns.end() ||
        !std::ranges::all_of(found->second, [](double v) { return std::isfinite(v); }) ||
        std::ranges::all_of(found->second, [&](double v) { return v == found->second.front(); }))
      continue;
    const int decimals =
        known_decimals(estimates, quantity.column + (quantity.of_second_capsule ? "#2@x_g" : "@x_g"));
    series[quantity.column] = {{"decimals", decimals},
                               {"values", rounded(found->second, std::max(decimals, 4))}};
  }
  return series;
}

// Physical keys of a run in its name, where they were given.
const std::vector<std::pair<std::string, std::string>> physical_parts = {
    {"physical.capsule_radius", "radius"},
    {"physical.flow_rate", "Q ="},
    {"physical.pressure", "pressure"},
    {"physical.shear_modulus", "G ="},
    {"physical.young_modulus", "Young's modulus"},
    {"physical.viscosity", "viscosity"},
    {"physical.internal_viscosity", "inside"},
    {"physical.bending_modulus", "bending"},
    {"physical.tube_radius", "tube"}};

// Which capsule in which flow, in parts: "sphere", "Skalak C = 0", "size 0.9", "ε = 0.04", "λ = 10"; what was given with a unit
// as it was typed, "radius 40 um", "Q = 10 nl/s". Where several capsules differ, what each has.
std::vector<std::string> parts_of_name(const Json &parameters) {
  const auto values = [&](const std::string &key) {
    const Json &value = parameters.at(key);
    return value.is_array() ? value : Json::array({value});
  };
  const auto number = [&](const std::string &key) {
    std::vector<std::string> texts;
    for (const Json &value : values(key))
      texts.push_back(capsule::with_minus_signs(fmt::format("{:.4g}", value.get<double>())));
    return fmt::format("{}", fmt::join(texts, " and "));
  };
  const auto is_typed = [&](const std::string &key) { return !parameters.at("physical." + key).is_null(); };
  const Json &aspect_ratio = parameters.at("capsule.aspect_ratio");
  std::vector<std::string> parts = {aspect_ratio.is_null() ? "biconcave"
                                    : aspect_ratio == 1.0
                                        ? "sphere"
                                        : "spheroid A/B = " + number("capsule.aspect_ratio")};
  const Json laws_there = values("membrane.law");
  for (const capsule::Law *law : capsule::laws())
    if (std::ranges::find(laws_there, Json(law->name)) != laws_there.end()) {
      parts.emplace_back(law->title);
      for (const capsule::LawParameter &declared : law->parameters)
        parts.back() +=
            fmt::format(" {} = {}", declared.symbol, number(std::string("membrane.") + declared.name));
    }
  for (const auto &[key, title] : physical_parts)
    if (!parameters.at(key).is_null()) {
      std::vector<std::string> texts;
      for (const Json &value : values(key))
        texts.push_back(value.get<std::string>());
      parts.push_back(fmt::format("{} {}", title, fmt::join(texts, " and ")));
    }
  if (!is_typed("capsule_radius"))
    parts.push_back("size " + number("capsule.radius"));
  if (!is_typed("flow_rate") && !is_typed("pressure"))
    parts.push_back("ε = " + number("flow.capillary_number"));
  if (!is_typed("internal_viscosity"))
    parts.push_back("λ = " + number("flow.viscosity_ratio"));
  if (parameters.at("membrane.shear_viscosity") != 0.0)
    parts.push_back("viscous membrane " + number("membrane.shear_viscosity"));
  if (parameters.at("capsule.start_x").is_array())
    parts.push_back("starting at " + number("capsule.start_x"));
  if (const Json &nodes = parameters.at("mesh.membrane"); !nodes.is_null())
    parts.push_back(nodes.dump() + " nodes");
  return parts;
}

Json player_run(const fs::path &run, const Json &frames) {
  const Json summary = Json::parse(capsule::read_file(run / "summary.json"));
  const Json &parameters = summary.at("parameters");
  const Json &shape = parameters.at("pore.shape"), &title = parameters.at("title");
  const Json &opening_angle = parameters.at("pore.opening_angle_deg"); // a tube has none
  return {
      {"case", title.is_null() ? run.parent_path().filename().string() : title.get<std::string>()},
      {"parts", parts_of_name(parameters)},
      {"directory", run.string()},
      {"walls", !shape.is_null() && shape != "none"},
      {"opening_angle", opening_angle.is_null() ? 0 : opening_angle.get<double>() * std::numbers::pi / 180},
      {"second_mouth", shape == "two-mouths" ? parameters.at("pore.exit_x") : Json()},
      {"series", player_series(run, summary.at("error_estimate"))},
      {"frames", frames}};
}

// Gives each run its name, of all parts, and a label of those in which the runs of its case differ.
void name_runs(Json &runs) {
  const auto joined = [](const std::vector<std::string> &parts) {
    return fmt::format("{}", fmt::join(parts, ", "));
  };
  const auto has = [](const Json &run, const std::string &part) {
    return std::ranges::find(run.at("parts"), Json(part)) != run.at("parts").end();
  };
  for (Json &run : runs) {
    const std::vector<std::string> parts = run.at("parts");
    std::vector<std::string> own;
    std::ranges::copy_if(parts, std::back_inserter(own), [&](const std::string &part) {
      return !std::ranges::all_of(
          runs, [&](const Json &other) { return other.at("case") != run.at("case") || has(other, part); });
    });
    run["name"] = joined(parts);
    run["label"] = joined(own.empty() ? parts : own);
  }
  for (Json &run : runs)
    run.erase("parts");
}

} // namespace

Json player_data(const std::vector<fs::path> &runs) {
  Json fields = Json::array(), quantities = Json::array(), played = Json::array();
  for (const PlayerField &field : player_fields)
    fields.push_back({{"name", field.name}, {"neutral", field.neutral}});
  for (const PlayerQuantity &quantity : player_quantities)
    quantities.push_back({{"column", quantity.column},
                          {"name", quantity.name},
                          {"symbol", quantity.symbol},
                          {"base", quantity.base}});
  for (const fs::path &run : runs)
    if (const Json frames = player_frames(run); !frames.empty())
      played.push_back(player_run(run, frames));
  name_runs(played);
  return {{"fields", fields}, {"quantities", quantities}, {"runs", played}};
}

} // namespace report
