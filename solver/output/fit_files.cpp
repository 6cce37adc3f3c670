#include "output/fit_files.hpp"
#include "base/atomic_file.hpp"
#include "base/csv.hpp"
#include "base/failure.hpp"
#include "base/json_file.hpp"
#include "base/text.hpp"
#include "observe/gauge.hpp"
#include "output/tables.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace capsule {
namespace {

namespace fs = std::filesystem;

Json candidate_json(const Candidate &candidate) {
  Json json{{"law", candidate.law}};
  json["failure"] = candidate.failure.empty() ? Json() : Json(candidate.failure);
  json["values"] = Json::object();
  for (std::size_t j = 0; j < candidate.names.size(); ++j)
    if (!candidate.names[j].starts_with("place"))
      json["values"][candidate.names[j]] = candidate.parameters[static_cast<Eigen::Index>(j)];
  json["residual"] = candidate.residual;
  json["chi_squared"] = candidate.chi_squared;
  json["aic"] = finite_or_null(candidate.aic);
  json["evidence_ratio"] = candidate.evidence_ratio;
  return json;
}

std::string fit_json(const std::string &identity, std::span<const Contour> contours,
                     const FitOutcome &outcome) {
  const FitResult &fit = outcome.result;
  Json json;
  json["fit"] = identity;
  json["profiles"] = Json::array();
  for (const Contour &contour : contours)
    json["profiles"].push_back(contour.file.filename().string());
  json["failure"] = outcome.failure.empty() ? Json() : Json(outcome.failure);
  json["law"] = fit.law;
  for (const char *object : {"values", "standard_errors", "intervals_90", "correlations"})
    json[object] = Json::object();
  for (std::size_t i = 0; i < fit.values.size(); ++i) {
    const FittedValue &value = fit.values[i];
    json["values"][value.name] = finite_or_null(value.value);
    json["standard_errors"][value.name] = finite_or_null(value.standard_error);
    json["intervals_90"][value.name] = {finite_or_null(value.low), finite_or_null(value.high)};
    for (std::size_t k = 0; static_cast<Eigen::Index>(i) < fit.correlations.rows() && k < i; ++k)
      json["correlations"][fit.values[k].name][value.name] =
          finite_or_null(fit.correlations(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)));
  }
  json["residual"] = fit.residual;
  json["noise"] = fit.noise;
  json["noise_is_given"] = fit.noise_is_given;
  json["chi_squared"] = fit.chi_squared;
  json["degrees_of_freedom"] = fit.degrees_of_freedom;
  json["candidates"] = Json::array();
  for (const Candidate &candidate : fit.candidates)
    json["candidates"].push_back(candidate_json(candidate));
  json["warnings"] = fit.warnings;
  json["cpu_seconds"] = outcome.cpu_seconds;
  return json_text(json, 2) + "\n";
}

struct Shapes {
  std::string profiles, points;
};
Shapes shapes_of(std::span<const Contour> contours, const FitResult &fit) {
  std::vector<Profile> profiles;
  std::string points = csv_row({"profile", "x", "r", "foot_x", "foot_r", "distance"});
  for (std::size_t k = 0; k < fit.contours.size(); ++k) {
    const FittedContour &fitted = fit.contours[k];
    const SteadySystem &system = *fitted.state.system;
    const Gauge gauge(system.pore(), system.membrane());
    Vector position = fitted.state.unknowns.head(2 * system.nodes());
    const double centre = gauge.centre(position); // of mass; the model's origin is the centre of its area
    position.head(system.nodes()).array() -= centre;
    profiles.push_back(gauge.profile(static_cast<double>(k), position, system.flow(position).velocity));
    profiles.back().x_g = 0;
    for (std::size_t i = 0; i < fitted.feet.size(); ++i) {
      const Foot &foot = fitted.feet[i];
      const auto row = static_cast<Eigen::Index>(i);
      std::vector<std::string> fields{std::to_string(k)};
      for (const double number : {contours[k].x[row] - fitted.place - centre, contours[k].r[row],
                                  foot.x - fitted.place - centre, foot.r, foot.distance})
        fields.push_back(number_text(number));
      points += csv_row(fields);
    }
  }
  return {profiles_csv(profiles), points};
}

// Files that are there and no fit has written.
void require_own(const fs::path &directory) {
  std::error_code ignored;
  for (const char *name : {"fit.json", "profiles.csv", "points.csv"}) {
    if (!fs::exists(directory / name, ignored))
      continue;
    const auto json = read_json(directory / "fit.json");
    if (!json || !json->contains("fit"))
      throw FileError(
          fmt::format("cannot write into '{}': {} is not of a fit; move it away, or give another --out",
                      directory.string(), name));
  }
}

std::vector<double> values_of(const std::vector<FitRow> &rows, const std::string &name) {
  std::vector<double> values;
  for (const FitRow &row : rows)
    for (const FittedValue &value : row.values)
      if (value.name == name)
        values.push_back(value.value);
  std::ranges::sort(values);
  return values;
}

double quantile(const std::vector<double> &sorted, double part) {
  const double at = part * static_cast<double>(sorted.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(at), sorted.size() - 1);
  const double next = sorted[std::min(k + 1, sorted.size() - 1)];
  return sorted[k] + (at - static_cast<double>(k)) * (next - sorted[k]);
}

// Of all values that the fits have.
std::vector<std::string> value_names(const std::vector<FitRow> &rows) {
  std::vector<std::string> names;
  for (const FitRow &row : rows)
    for (const FittedValue &value : row.values)
      if (std::ranges::find(names, value.name) == names.end())
        names.push_back(value.name);
  return names;
}

std::string fit_csv(const std::vector<FitRow> &rows, const std::vector<std::string> &names) {
  std::vector<std::string> fields{"profile", "law", "failure", "residual", "noise", "warnings"};
  for (const std::string &name : names)
    for (const char *what : {"", " error", " low", " high"})
      fields.push_back(fmt::format("{}{}", name, what));
  std::string text = csv_row(fields);
  for (const FitRow &row : rows) {
    fields = {row.name,
              row.law,
              row.failure,
              number_text(row.residual),
              number_text(row.noise),
              std::to_string(row.warnings)};
    for (const std::string &name : names) {
      const auto found = std::ranges::find(row.values, name, &FittedValue::name);
      for (const auto member :
           {&FittedValue::value, &FittedValue::standard_error, &FittedValue::low, &FittedValue::high})
        fields.push_back(found == row.values.end() ? "" : number_text((*found).*member));
    }
    text += csv_row(fields);
  }
  return text;
}

std::string population_csv(const std::vector<FitRow> &rows, const std::vector<std::string> &names) {
  std::string text = csv_row(
      {"quantity", "profiles", "mean", "standard_deviation", "median", "from_5_percent", "to_95_percent"});
  for (const std::string &name : names) {
    const std::vector<double> values = values_of(rows, name);
    const Eigen::Map<const Eigen::ArrayXd> all(values.data(), std::ssize(values));
    const double mean = all.mean();
    const double deviation = std::sqrt((all - mean).square().sum() /
                                       static_cast<double>(std::max<Eigen::Index>(all.size() - 1, 1)));
    std::vector<std::string> fields{name, std::to_string(values.size())};
    for (const double number :
         {mean, deviation, quantile(values, 0.5), quantile(values, 0.05), quantile(values, 0.95)})
      fields.push_back(number_text(number));
    text += csv_row(fields);
  }
  return text;
}

std::string histogram_csv(const std::vector<FitRow> &rows, const std::vector<std::string> &names) {
  constexpr std::size_t most_bins = 20;
  std::string text = csv_row({"quantity", "from", "to", "profiles"});
  for (const std::string &name : names) {
    const std::vector<double> values = values_of(rows, name);
    const double low = values.front(), range = values.back() - low;
    const std::size_t bins =
        range > 0
            ? std::min(most_bins, 1 + static_cast<std::size_t>(std::sqrt(static_cast<double>(values.size()))))
            : 1;
    std::vector<std::size_t> counts(bins, 0);
    for (const double value : values)
      ++counts[range > 0 ? std::min(bins - 1, static_cast<std::size_t>((value - low) / range *
                                                                       static_cast<double>(bins)))
                         : 0];
    for (std::size_t k = 0; k < bins; ++k)
      text += csv_row({name, number_text(low + range * static_cast<double>(k) / static_cast<double>(bins)),
                       number_text(low + range * static_cast<double>(k + 1) / static_cast<double>(bins)),
                       std::to_string(counts[k])});
  }
  return text;
}

} // namespace

void write_fit(const fs::path &directory, const std::string &identity, std::span<const Contour> contours,
               const FitOutcome &outcome) {
  make_directories(directory);
  require_own(directory);
  if (outcome.failure.empty()) {
    const Shapes shapes = shapes_of(contours, outcome.result);
    write_atomically(directory / "profiles.csv", shapes.profiles);
    write_atomically(directory / "points.csv", shapes.points);
  }
  write_atomically(directory / "fit.json", fit_json(identity, contours, outcome));
}

std::optional<FitRow> read_fit(const fs::path &directory, const std::string &identity) {
  const fs::path file = directory / "fit.json";
  const auto json = read_json(file);
  if (!json || !json->contains("fit") || json->at("fit") != identity)
    return std::nullopt;
  try {
    FitRow row;
    for (const Json &profile : json->at("profiles"))
      row.name = fmt::format("{}{}{}", row.name, row.name.empty() ? "" : " ", profile.get<std::string>());
    row.law = json->at("law");
    if (json->at("failure").is_string())
      row.failure = json->at("failure");
    const auto number = [](const Json &value) { return value.is_number() ? value.get<double>() : NAN; };
    for (const auto &[name, value] : json->at("values").items()) {
      const Json &interval = json->at("intervals_90").at(name);
      row.values.push_back({name, number(value), number(json->at("standard_errors").at(name)),
                            number(interval.at(0)), number(interval.at(1))});
    }
    row.residual = json->at("residual");
    row.noise = json->at("noise");
    row.warnings = json->at("warnings").size();
    return row;
  } catch (const Json::exception &error) {
    fail_to_use(file, error);
  }
}

void write_fit_tables(const fs::path &directory, const std::vector<FitRow> &rows) {
  const std::vector<std::string> names = value_names(rows);
  write_atomically(directory / "fit.csv", fit_csv(rows, names));
  if (rows.size() < 2)
    return;
  write_atomically(directory / "population.csv", population_csv(rows, names));
  write_atomically(directory / "histogram.csv", histogram_csv(rows, names));
}

} // namespace capsule
