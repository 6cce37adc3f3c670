#include "output/checkpoint.hpp"
#include "base/atomic_file.hpp"
#include "base/digest.hpp"
#include "base/json_file.hpp"
#include "base/text.hpp"
#include "observe/quantities.hpp"
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <iterator>
#include <string_view>
#include <system_error>

namespace capsule {
namespace {

namespace fs = std::filesystem;

// Why a content is no checkpoint.
struct Damage {
  const char *what;
};

// JSON has no word for what is not finite.
Json exact(double value) {
  return std::isfinite(value) ? Json(value) : Json(number_text(value));
}
double exact(const Json &json) {
  if (!json.is_string())
    return json.get<double>();
  if (const auto value = to_number(json.get<std::string>()))
    return *value;
  throw Damage{"an entry is not a number"};
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

// Many numbers, 16 hexadecimal digits each.
std::string packed(const double *values, Eigen::Index size) {
  std::string text;
  text.reserve(16 * static_cast<std::size_t>(size));
  for (Eigen::Index i = 0; i < size; ++i)
    fmt::format_to(std::back_inserter(text), "{:016x}", std::bit_cast<std::uint64_t>(values[i]));
  return text;
}
Vector unpacked(const std::string &text) {
  Vector values(static_cast<Eigen::Index>(text.size() / 16));
  const char *digits = text.data();
  for (double &value : values) {
    std::uint64_t bits = 0;
    std::from_chars(digits, digits + 16, bits, 16);
    value = std::bit_cast<double>(bits);
    digits += 16;
  }
  return values;
}

Json packed(const std::vector<Vector> &list) {
  Json json = Json::array();
  for (const Vector &values : list)
    json.push_back(packed(values.data(), values.size()));
  return json;
}
std::vector<Vector> unpacked_list(const Json &json) {
  std::vector<Vector> list;
  for (const std::string text : json)
    list.push_back(unpacked(text));
  return list;
}

Json packed(const Recycled &recycled) {
  return {{"inverse", packed(recycled.inverse.data(), recycled.inverse.size())},
          {"positions", packed(recycled.positions)},
          {"solutions", packed(recycled.solutions)}};
}
Recycled unpacked_recycled(const Json &json) {
  const Vector inverse = unpacked(json.at("inverse"));
  const Eigen::Index rows = std::lround(std::sqrt(static_cast<double>(inverse.size())));
  if (rows * rows != inverse.size())
    throw Damage{"a matrix is not square"};
  return {inverse.reshaped(rows, rows), unpacked_list(json.at("positions")),
          unpacked_list(json.at("solutions"))};
}

constexpr const char *file_name = "checkpoint.json";
// {"identity":"...","digest":"...","run":...}
constexpr std::string_view file_begin = "{\"identity\":", run_begin = "\"run\":";

Json series_json(const std::vector<SeriesRow> &series) {
  Json json = Json::array();
  for (const SeriesRow &row : series) {
    Json values = Json::array();
    for (const ReportedQuantity &quantity : reported_quantities())
      values.push_back(exact(row.*quantity.value));
    json.push_back(std::move(values));
  }
  return json;
}
std::vector<SeriesRow> series_of(const Json &json) {
  std::vector<SeriesRow> series;
  for (const Json &values : json) {
    SeriesRow row;
    std::size_t i = 0;
    for (const ReportedQuantity &quantity : reported_quantities())
      row.*quantity.value = exact(values.at(i++));
    series.push_back(row);
  }
  return series;
}

Json profiles_json(const std::vector<Profile> &profiles) {
  Json json = Json::array();
  for (const Profile &profile : profiles) {
    Json values{{"time", exact(profile.time)}, {"x_g", exact(profile.x_g)}};
    for (const ProfileQuantity &quantity : profile_quantities())
      values[quantity.name] = exact(profile.*quantity.values);
    json.push_back(std::move(values));
  }
  return json;
}
std::vector<Profile> profiles_of(const Json &json) {
  std::vector<Profile> profiles;
  for (const Json &values : json) {
    Profile profile;
    profile.time = exact(values.at("time"));
    profile.x_g = exact(values.at("x_g"));
    for (const ProfileQuantity &quantity : profile_quantities())
      profile.*quantity.values = exact_vector(values.at(quantity.name));
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

Json to_json(const StepMemory &memory) {
  Json past = Json::array();
  for (const StepMemory::Point &point : memory.past)
    past.push_back({{"time", exact(point.time)},
                    {"state", packed(point.state.data(), point.state.size())},
                    {"load", packed(point.load.data(), point.load.size())},
                    {"rate", packed(point.rate.data(), point.rate.size())},
                    {"rate_at_state", packed(point.rate_at_state.data(), point.rate_at_state.size())},
                    {"further", packed(point.further.data(), point.further.size())}});
  const auto frozen = [](const StepMemory::Frozen &matrix) -> Json {
    return {{"at", packed(matrix.at.data(), matrix.at.size())}, {"age", matrix.age}};
  };
  return {{"past", past},
          {"order", memory.order},
          {"steps_at_order", memory.steps_at_order},
          {"step", exact(memory.step)},
          {"left_over", exact(memory.left_over)},
          {"mobility", frozen(memory.mobility)},
          {"load_jacobian", frozen(memory.load_jacobian)},
          {"factored", exact(memory.factored)}};
}

StepMemory step_memory_of(const Json &json) {
  StepMemory memory;
  for (const Json &point : json.at("past"))
    memory.past.push_back({exact(point.at("time")), unpacked(point.at("state")), unpacked(point.at("load")),
                           unpacked(point.at("rate")), unpacked(point.at("rate_at_state")),
                           unpacked(point.at("further"))});
  const auto frozen = [](const Json &matrix) -> StepMemory::Frozen {
    return {unpacked(matrix.at("at")), matrix.at("age")};
  };
  memory.order = json.at("order");
  memory.steps_at_order = json.at("steps_at_order");
  memory.step = exact(json.at("step"));
  memory.left_over = exact(json.at("left_over"));
  memory.mobility = frozen(json.at("mobility"));
  memory.load_jacobian = frozen(json.at("load_jacobian"));
  memory.factored = exact(json.at("factored"));
  return memory;
}

Json to_json(const Checkpoint &checkpoint) {
  Json json;
  json["time"] = exact(checkpoint.time);
  json["steps"] = checkpoint.steps;
  json["position"] = exact(checkpoint.position);
  json["series"] = series_json(checkpoint.series);
  json["profiles"] = profiles_json(checkpoint.profiles);
  json["followers"] = Json::array();
  for (const CapsuleRecord &follower : checkpoint.followers)
    json["followers"].push_back(
        {{"series", series_json(follower.series)}, {"profiles", profiles_json(follower.profiles)}});
  json["memory"] = to_json(checkpoint.memory);
  json["velocity"] = packed(checkpoint.recycled.velocity);
  json["traction"] = packed(checkpoint.recycled.traction);
  json["next_x_g"] = checkpoint.next_x_g;
  json["next_time"] = checkpoint.next_time;
  json["checked"] = exact(checkpoint.checked);
  json["companion"] = Json::array();
  for (const Checkpoint &companion : checkpoint.companion)
    json["companion"].push_back(to_json(companion));
  return json;
}

Checkpoint checkpoint_of(const Json &json) {
  Checkpoint checkpoint;
  checkpoint.time = exact(json.at("time"));
  checkpoint.steps = json.at("steps");
  checkpoint.position = exact_vector(json.at("position"));
  checkpoint.series = series_of(json.at("series"));
  checkpoint.profiles = profiles_of(json.at("profiles"));
  for (const Json &follower : json.at("followers"))
    checkpoint.followers.push_back({series_of(follower.at("series")), profiles_of(follower.at("profiles"))});
  checkpoint.memory = step_memory_of(json.at("memory"));
  checkpoint.recycled = {unpacked_recycled(json.at("velocity")), unpacked_recycled(json.at("traction"))};
  checkpoint.next_x_g = json.at("next_x_g");
  checkpoint.next_time = json.at("next_time");
  checkpoint.checked = exact(json.at("checked"));
  for (const Json &companion : json.at("companion"))
    checkpoint.companion.push_back(checkpoint_of(companion));
  return checkpoint;
}

Json to_json(const SavedRun &saved) {
  return {{"started", saved.effort.started},
          {"cpu_seconds", saved.effort.cpu_seconds},
          {"wall_seconds", saved.effort.wall_seconds},
          {"checkpoint", to_json(saved.checkpoint)}};
}

SavedRun saved_run(const Json &json) {
  return {checkpoint_of(json.at("checkpoint")),
          {json.at("started"), json.at("cpu_seconds"), json.at("wall_seconds")}};
}

} // namespace

void write_checkpoint(const fs::path &directory, const std::string &identity, const SavedRun &saved) {
  const std::string run = json_text(to_json(saved));
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
    const Json json = parsed_json(text);
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
    return {.damage = in_words(error)};
  } catch (const Damage &damage) {
    return {.damage = damage.what};
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
