#include "output/checkpoint.hpp"
#include "base/atomic_file.hpp"
#include "base/json_file.hpp"
#include "base/text.hpp"
#include "observe/quantities.hpp"
#include <cmath>

namespace capsule {
namespace {

namespace fs = std::filesystem;

// JSON has no word for what is not finite.
Json exact(double value) {
  return std::isfinite(value) ? Json(value) : Json(number_text(value));
}
double exact(const Json &json) {
  return json.is_string() ? std::stod(json.get<std::string>()) : json.get<double>();
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

} // namespace

void write_checkpoint(const fs::path &directory, const std::string &identity, const SavedRun &saved) {
  const Checkpoint &checkpoint = saved.checkpoint;
  Json json;
  json["identity"] = identity;
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
  write_atomically(directory / "checkpoint.json", json.dump() + "\n");
}

std::optional<SavedRun> read_checkpoint(const fs::path &directory, const std::string &identity) {
  const fs::path file = directory / "checkpoint.json";
  const auto json = read_json(file);
  try {
    if (!json || json->at("identity") != identity)
      return std::nullopt;
    SavedRun saved;
    saved.effort = {json->at("started"), json->at("cpu_seconds"), json->at("wall_seconds")};
    Checkpoint &checkpoint = saved.checkpoint;
    checkpoint.time = exact(json->at("time"));
    checkpoint.steps = json->at("steps");
    checkpoint.position = exact_vector(json->at("position"));
    for (const Json &values : json->at("series")) {
      SeriesRow row;
      std::size_t i = 0;
      for (const ReportedQuantity &quantity : reported_quantities())
        row.*quantity.value = exact(values.at(i++));
      checkpoint.series.push_back(row);
    }
    for (const Json &values : json->at("profiles")) {
      Profile profile;
      profile.time = exact(values.at("time"));
      profile.x_g = exact(values.at("x_g"));
      for (const ProfileQuantity &quantity : profile_quantities())
        profile.*quantity.values = exact_vector(values.at(quantity.name));
      checkpoint.profiles.push_back(std::move(profile));
    }
    return saved;
  } catch (const Json::exception &error) {
    fail_to_use(file, error);
  }
}

void remove_checkpoint(const fs::path &directory) {
  remove_file(directory / "checkpoint.json");
}

} // namespace capsule
