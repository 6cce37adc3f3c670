#include "output/checkpoint.hpp"
#include "base/atomic_file.hpp"
#include "base/digest.hpp"
#include "base/json_file.hpp"
#include "base/text.hpp"
#include "observe/quantities.hpp"
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <system_error>

namespace capsule {
namespace {

namespace fs = std::filesystem;

// JSON has no word for what is not finite.
Json exact(double value) {
  return std::isfinite(value) ? Json(value) : Json(number_text(value));
}
double exact(const Json &json) {
  return json.is_string() ? to_number(json.get<std::string>()).value() : json.get<double>();
}

Json exact(const Vector &values) {
  Json list = Json::array();
  for (const double value : values)
    list.push_back(exact(value));
  return list;
}
Vector exact_vector(const Json &json) {
  Vector values(static_cast<Eigen::Index>(json.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values[i] = exact(json.at(static_cast<std::size_t>(i)));
  return values;
}

constexpr const char *file_name = "checkpoint.json";
// {"identity":"...","digest":"...","run":...}
constexpr std::string_view file_begin = "{\"identity\":", run_begin = "\"run\":";

Json to_json(const SavedRun &saved) {
  const Checkpoint &checkpoint = saved.checkpoint;
  Json json;
  json["started"] = saved.effort.started;
  json["cpu_seconds"] = saved.effort.cpu_seconds;
  json["wall_seconds"] = saved.effort.wall_seconds;
  json["time"] = exact(checkpoint.time);
  json["steps"] = checkpoint.steps;
  json["position"] = exact(checkpoint.position);
  json["series"] = Json::array();
  for (const SeriesRow &row : checkpoint.series) {
    Json values = Json::array();
    for (const ReportedQuantity &quantity : reported_quantities())
      values.push_back(exact(row.*quantity.value));
    json["series"].push_back(std::move(values));
  }
  json["profiles"] = Json::array();
  for (const Profile &profile : checkpoint.profiles) {
    Json values{{"time", exact(profile.time)}, {"x_g", exact(profile.x_g)}};
    for (const ProfileQuantity &quantity : profile_quantities())
      values[quantity.name] = exact(profile.*quantity.values);
    json["profiles"].push_back(std::move(values));
  }
  return json;
}

SavedRun saved_run(const Json &json) {
  SavedRun saved;
  saved.effort = {json.at("started"), json.at("cpu_seconds"), json.at("wall_seconds")};
  Checkpoint &checkpoint = saved.checkpoint;
  checkpoint.time = exact(json.at("time"));
  checkpoint.steps = json.at("steps");
  checkpoint.position = exact_vector(json.at("position"));
  for (const Json &values : json.at("series")) {
    SeriesRow row;
    std::size_t i = 0;
    for (const ReportedQuantity &quantity : reported_quantities())
      row.*quantity.value = exact(values.at(i++));
    checkpoint.series.push_back(row);
  }
  for (const Json &values : json.at("profiles")) {
    Profile profile;
    profile.time = exact(values.at("time"));
    profile.x_g = exact(values.at("x_g"));
    for (const ProfileQuantity &quantity : profile_quantities())
      profile.*quantity.values = exact_vector(values.at(quantity.name));
    checkpoint.profiles.push_back(std::move(profile));
  }
  return saved;
}

} // namespace

void write_checkpoint(const fs::path &directory, const std::string &identity, const SavedRun &saved) {
  const std::string run = to_json(saved).dump();
  write_atomically(directory / file_name, fmt::format("{}\"{}\",\"digest\":\"{}\",{}{}}}\n", file_begin,
                                                      identity, digest(run), run_begin, run));
}

FoundCheckpoint read_checkpoint(const fs::path &directory, const std::string &identity) {
  const fs::path file = directory / file_name;
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    return {};
  try {
    const std::string text = read_file(file);
    const Json json = Json::parse(text);
    if (json.at("identity") != identity)
      return {.of_another_run = true};
    const std::size_t begin = text.find(run_begin) + run_begin.size(); // "}\n" ends the text
    if (digest(std::string_view(text).substr(begin, text.size() - begin - 2)) != json.at("digest"))
      return {.damage = "its content is not what was written"};
    const SavedRun saved = saved_run(json.at("run"));
    if (!std::isfinite(saved.checkpoint.time) || !saved.checkpoint.position.allFinite())
      return {.damage = "a position is not a number"};
    return {.run = saved};
  } catch (const Json::exception &error) {
    return {.damage = error.what()};
  } catch (const std::bad_optional_access &) {
    return {.damage = "a number is none"};
  }
}

bool has_foreign_checkpoint(const fs::path &directory) {
  const fs::path file = directory / file_name;
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    return false;
  const std::string text = read_file(file);
  return !text.empty() && !text.starts_with(file_begin);
}

void remove_checkpoint(const fs::path &directory) {
  remove_file(directory / file_name);
}

} // namespace capsule
