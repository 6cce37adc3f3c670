#include "output.hpp"
#include "build_info.hpp"
#include "case_keys.hpp"
#include "failure.hpp"
#include "resolution.hpp"
#include "text.hpp"
#include <algorithm>
#include <array>
#include <cblas.h>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <gsl/gsl_version.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sundials/sundials_config.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace capsule {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct SeriesColumn {
  const char *name;
  double SeriesRow::*value;
};
constexpr std::array series_columns{
    SeriesColumn{"time", &SeriesRow::time},
    SeriesColumn{"x_g", &SeriesRow::x_g},
    SeriesColumn{"v_g", &SeriesRow::v_g},
    SeriesColumn{"pressure_drop", &SeriesRow::pressure_drop},
    SeriesColumn{"max_stretch", &SeriesRow::max_stretch},
    SeriesColumn{"min_film", &SeriesRow::min_film},
    SeriesColumn{"volume_change", &SeriesRow::volume_change},
    SeriesColumn{"pressure_drop_reciprocal", &SeriesRow::pressure_drop_reciprocal},
    SeriesColumn{"front_stretch", &SeriesRow::front_stretch},
    SeriesColumn{"length", &SeriesRow::length},
    SeriesColumn{"deformation", &SeriesRow::deformation},
    SeriesColumn{"area_change", &SeriesRow::area_change},
    SeriesColumn{"max_axial_residual", &SeriesRow::max_axial_residual},
    SeriesColumn{"max_radial_velocity", &SeriesRow::max_radial_velocity},
    SeriesColumn{"dents", &SeriesRow::dents},
    SeriesColumn{"roughness", &SeriesRow::roughness},
};

constexpr std::array branch_columns{
    SeriesColumn{"v_g", &SeriesRow::v_g},
    SeriesColumn{"pressure_drop", &SeriesRow::pressure_drop},
    SeriesColumn{"max_stretch", &SeriesRow::max_stretch},
    SeriesColumn{"min_film", &SeriesRow::min_film},
    SeriesColumn{"front_stretch", &SeriesRow::front_stretch},
    SeriesColumn{"length", &SeriesRow::length},
    SeriesColumn{"deformation", &SeriesRow::deformation},
    SeriesColumn{"volume_change", &SeriesRow::volume_change},
    SeriesColumn{"area_change", &SeriesRow::area_change},
    SeriesColumn{"dents", &SeriesRow::dents},
};

struct ProfileColumn {
  const char *name;
  Vector Profile::*values;
};
constexpr std::array profile_columns{
    ProfileColumn{"S", &Profile::S},
    ProfileColumn{"x", &Profile::x},
    ProfileColumn{"r", &Profile::r},
    ProfileColumn{"stretch_meridional", &Profile::stretch_meridional},
    ProfileColumn{"stretch_azimuthal", &Profile::stretch_azimuthal},
    ProfileColumn{"tension_meridional", &Profile::tension_meridional},
    ProfileColumn{"tension_azimuthal", &Profile::tension_azimuthal},
    ProfileColumn{"moment_meridional", &Profile::moment_meridional},
    ProfileColumn{"moment_azimuthal", &Profile::moment_azimuthal},
    ProfileColumn{"curvature_meridional", &Profile::curvature_meridional},
    ProfileColumn{"curvature_azimuthal", &Profile::curvature_azimuthal},
    ProfileColumn{"velocity_x", &Profile::velocity_x},
    ProfileColumn{"velocity_r", &Profile::velocity_r},
};

[[noreturn]] void fail(const std::string &what, const fs::path &path, int error) {
  throw FileError(fmt::format("{} '{}': {}", what, path.string(), std::strerror(error)));
}

const char *status_text(Status status) {
  switch (status) {
  case Status::reached:
    return "reached";
  case Status::steady:
    return "steady";
  case Status::unbounded:
    return "unbounded";
  case Status::failed:
    return "failed";
  case Status::interrupted:
    break;
  }
  return "interrupted";
}

std::string now_utc() {
  return fmt::format("{:%FT%TZ}", fmt::gmtime(std::chrono::system_clock::now()));
}

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

Json finite_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

[[noreturn]] void fail_to_use(const fs::path &file, const Json::exception &error) {
  throw FileError(
      fmt::format("cannot use '{}': {}; remove it or run with --fresh", file.string(), error.what()));
}

// Parsed, or nothing if there is no such file.
std::optional<Json> read_json(const fs::path &file) {
  errno = 0;
  std::ifstream stream(file);
  if (!stream) {
    if (errno == ENOENT)
      return std::nullopt;
    fail("cannot read", file, errno);
  }
  try {
    return Json::parse(stream);
  } catch (const Json::exception &error) {
    fail_to_use(file, error);
  }
}

std::string series_csv(const std::vector<SeriesRow> &series) {
  std::string text;
  for (const SeriesColumn &column : series_columns)
    text += fmt::format("{}{}", text.empty() ? "" : ",", column.name);
  for (const SeriesRow &row : series) {
    char separator = '\n';
    for (const SeriesColumn &column : series_columns) {
      text += separator + number_text(row.*column.value);
      separator = ',';
    }
  }
  return text + "\n";
}

std::string branch_csv(const Outcome &outcome) {
  std::string text = outcome.along;
  for (const SeriesColumn &column : branch_columns)
    text += fmt::format(",{}", column.name);
  text += ",growth_rate\n";
  for (const BranchRow &point : outcome.branch) {
    text += number_text(point.parameter);
    for (const SeriesColumn &column : branch_columns)
      text += ',' + number_text(point.row.*column.value);
    text += fmt::format(",{}\n", number_text(point.growth_rate));
  }
  return text;
}

std::string profiles_header() {
  std::string text = "time,x_g";
  for (const ProfileColumn &column : profile_columns)
    text += fmt::format(",{}", column.name);
  return text;
}

std::string profiles_csv(const std::vector<Profile> &profiles) {
  std::string text = profiles_header();
  for (const Profile &profile : profiles)
    for (Eigen::Index i = 0; i < profile.x.size(); ++i) {
      text += fmt::format("\n{},{}", number_text(profile.time), number_text(profile.x_g));
      for (const ProfileColumn &column : profile_columns)
        text += ',' + number_text((profile.*column.values)[i]);
    }
  return text + "\n";
}

// Which points of a profile a picture needs: at most 128 steps along the meridian, from pole to pole.
std::vector<Eigen::Index> pictured_points(const Profile &profile) {
  const Eigen::Index last = profile.x.size() - 1, stride = 1 + last / 128;
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index i = 0; i < last; i += stride)
    chosen.push_back(i);
  chosen.push_back(last);
  return chosen;
}

// One profile turned about the axis: a strip of triangles between each two of its points, around `turns` meridians.
std::string surface_vtp(const Profile &profile) {
  constexpr int turns = 32;
  const std::vector<Eigen::Index> chosen = pictured_points(profile);
  const auto points = std::ssize(chosen);
  std::string positions, connectivity, offsets;
  for (const Eigen::Index i : chosen)
    for (int k = 0; k < turns; ++k) {
      const double azimuth = 2 * std::numbers::pi * k / turns;
      positions += fmt::format("{:.6g} {:.6g} {:.6g}\n", profile.x[i], profile.r[i] * std::cos(azimuth),
                               profile.r[i] * std::sin(azimuth));
    }
  const auto point = [](Eigen::Index i, int k) { return i * turns + k % turns; };
  for (Eigen::Index i = 0; i + 1 < points; ++i) {
    for (int k = 0; k <= turns; ++k)
      connectivity += fmt::format("{} {}\n", point(i, k), point(i + 1, k));
    offsets += fmt::format("{}\n", (i + 1) * 2 * (turns + 1));
  }
  std::string fields;
  for (const ProfileColumn &column : profile_columns) {
    const std::string_view name = column.name;
    if (!name.starts_with("stretch") && !name.starts_with("tension"))
      continue;
    fields += fmt::format("<DataArray type=\"Float32\" Name=\"{}\" format=\"ascii\">\n", name);
    for (const Eigen::Index i : chosen)
      for (int k = 0; k < turns; ++k)
        fields += fmt::format("{:.5g}\n", (profile.*column.values)[i]);
    fields += "</DataArray>\n";
  }
  return fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\">\n<PolyData>\n"
                     "<Piece NumberOfPoints=\"{}\" NumberOfStrips=\"{}\">\n<PointData>\n{}</PointData>\n"
                     "<Points>\n<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">\n{}"
                     "</DataArray>\n</Points>\n<Strips>\n"
                     "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n{}</DataArray>\n"
                     "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n{}</DataArray>\n"
                     "</Strips>\n</Piece>\n</PolyData>\n</VTKFile>\n",
                     points * turns, points - 1, fields, positions, connectivity, offsets);
}

std::string surface_name(std::size_t index) {
  return fmt::format("membrane_{:04}.vtp", index);
}

std::string surfaces_pvd(const std::vector<Profile> &profiles) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (std::size_t i = 0; i < profiles.size(); ++i)
    text += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>\n", number_text(profiles[i].time),
                        surface_name(i));
  return text + "</Collection>\n</VTKFile>\n";
}

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

// What the end of a run says of the pore means nothing in an unbounded liquid.
bool applies(std::string_view quantity, const Case &physics) {
  const bool of_the_pore = quantity.find("pressure_drop") != std::string_view::npos ||
                           quantity == "x_g_at_peak" || quantity == "min_film";
  return !of_the_pore || physics.flow.type == FlowType::pore;
}

// What carries a unit, of a row and of a summary.
struct PhysicalColumn {
  const char *name;
  double Scales::*scale;
  Dimension of;
};
constexpr std::array physical_columns{
    PhysicalColumn{"time", &Scales::time, dimension::time},
    PhysicalColumn{"x_g", &Scales::length, dimension::length},
    PhysicalColumn{"v_g", &Scales::velocity, dimension::velocity},
    PhysicalColumn{"pressure_drop", &Scales::pressure, dimension::pressure},
    PhysicalColumn{"min_film", &Scales::length, dimension::length},
    PhysicalColumn{"length", &Scales::length, dimension::length},
    PhysicalColumn{"peak_pressure_drop", &Scales::pressure, dimension::pressure},
    PhysicalColumn{"x_g_at_peak", &Scales::length, dimension::length},
};

// The values of a summary in SI units, by their name and unit.
Json physical_json(const Case &physics, const Json &summary) {
  const Scales scales = physical_scales(physics);
  Json json = Json::object();
  for (const PhysicalColumn &column : physical_columns)
    if (const Json &value = summary.at(column.name); value.is_number())
      json[fmt::format("{} [{}]", column.name, unit_text(column.of))] =
          value.get<double>() * scales.*column.scale;
  json[fmt::format("tension scale [{}]", unit_text(dimension::tension))] = scales.tension;
  return json;
}

// The series in SI units, the unit in each column's head.
std::string physical_series_csv(const Case &physics, const std::vector<SeriesRow> &series) {
  const Scales scales = physical_scales(physics);
  struct Scaled {
    double SeriesRow::*value;
    double scale;
  };
  std::vector<Scaled> columns;
  std::string text;
  for (const PhysicalColumn &column : physical_columns)
    if (const auto *const source =
            std::ranges::find(series_columns, std::string_view(column.name), &SeriesColumn::name);
        source != series_columns.end()) {
      text += fmt::format("{}{} [{}]", text.empty() ? "" : ",", column.name, unit_text(column.of));
      columns.push_back({source->value, scales.*column.scale});
    }
  for (const SeriesRow &row : series) {
    char separator = '\n';
    for (const Scaled &column : columns) {
      text += separator + number_text(row.*column.value * column.scale);
      separator = ',';
    }
  }
  return text + "\n";
}

Json summary_json(const Case &physics, const Outcome &outcome, const Effort &effort) {
  Json json;
  json["status"] = status_text(outcome.status);
  json["failure"] = outcome.failure.empty() ? Json() : Json(outcome.failure);
  json["message"] = outcome.message.empty() ? Json() : Json(outcome.message);
  const std::vector<SeriesRow> &series = outcome.last.series;
  const auto put = [&](const char *name, std::optional<double> value) {
    json[name] = value && applies(name, physics) ? finite_or_null(*value) : Json();
  };
  for (const SeriesColumn &column : series_columns)
    put(column.name, series.empty() ? std::nullopt : std::optional(series.back().*column.value));
  const bool moved = outcome.status != Status::steady && outcome.along.empty();
  const auto peak = moved ? entry_peak(series) : std::nullopt;
  put("peak_pressure_drop", peak ? std::optional(peak->pressure_drop) : std::nullopt);
  put("x_g_at_peak", peak ? std::optional(peak->x_g) : std::nullopt);
  if (has_physical(physics))
    json["physical"] = physical_json(physics, json);
  for (const auto &[quantity, value] : outcome.further)
    json[quantity] = finite_or_null(value);
  if (!outcome.along.empty()) {
    json["along"] = outcome.along;
    json["folds"] = Json::array();
    for (const BranchRow &fold : outcome.folds) {
      Json entry{{outcome.along, fold.parameter}, {"growth_rate", fold.growth_rate}};
      for (const SeriesColumn &column : branch_columns)
        if (applies(column.name, physics))
          entry[column.name] = finite_or_null(fold.row.*column.value);
      json["folds"].push_back(std::move(entry));
    }
  }
  json["error_estimate"] = Json::object();
  for (const auto &[quantity, error] : outcome.error_estimate)
    json["error_estimate"][quantity] = finite_or_null(error);
  json["steps"] = outcome.last.steps;
  json["cpu_seconds"] = effort.cpu_seconds;
  json["wall_seconds"] = effort.wall_seconds;
  // Complete: also what followed from the accuracy asked for.
  Case resolved = physics;
  const Resolution chosen = choose_resolution(physics);
  resolved.mesh.membrane = outcome.membrane_nodes > 0 ? outcome.membrane_nodes : chosen.membrane_nodes;
  if (physics.time.scheme == Scheme::bdf)
    resolved.time.tolerance = chosen.time_tolerance;
  json["parameters"] = Json::object();
  for (const Key &key : keys()) {
    const auto value = get_value(key, resolved);
    json["parameters"][key.name] = value ? to_json(*value) : Json();
  }
  return json;
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      return line.substr(std::min(line.size(), line.find(':') + 2));
  return "unknown";
}

Json provenance_json(const Case &physics, const Effort &effort, const Task &task) {
  Json json;
  json["identity"] = run_identity(physics, task);
  json["task"] = task.name;
  json["version"] = build_info::version;
  json["git_commit"] = build_info::git_commit;
  json["sources"] = build_info::source_digest;
  json["compiler"] = build_info::compiler;
  json["flags"] = build_info::flags;
  json["libraries"] = {
      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"OpenBLAS", openblas_get_config()},
      {"GSL", GSL_VERSION},
      {"SUNDIALS", SUNDIALS_VERSION},
      {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)}};
  json["processor"] = processor_name();
  json["started"] = effort.started;
  json["finished"] = now_utc();
  return json;
}

bool is_result(const fs::path &file) {
  const std::string name = file.filename().string();
  return name == "summary.json" || name == "series.csv" || name == "series_physical.csv" ||
         name == "profiles.csv" || name == "resolved.toml" || name == "run.json" || name == "membrane.pvd" ||
         name == "branch.csv" || (name.starts_with("membrane_") && name.ends_with(".vtp"));
}

std::vector<fs::path> files_in(const fs::path &directory,
                               const std::function<bool(const fs::path &)> &wanted) {
  std::vector<fs::path> files;
  std::error_code ec;
  for (fs::directory_iterator entry(directory, ec), end; !ec && entry != end; entry.increment(ec))
    if (wanted(entry->path()))
      files.push_back(entry->path());
  if (ec)
    fail("cannot list", directory, ec.value());
  return files;
}

void remove_file(const fs::path &file) {
  std::error_code ec, ignored;
  fs::remove(file, ec); // complains on a read-only disk even about a file that is not there
  if (ec && fs::exists(fs::symlink_status(file, ignored)))
    fail("cannot remove", file, ec.value());
}

constexpr std::string_view temporary_prefix = ".writing-";

// Beside the file's place: one that all processes know, and one of each process.
fs::path common_temporary(const fs::path &file) {
  return file.parent_path() / fmt::format("{}{}", temporary_prefix, file.filename().string());
}
fs::path own_temporary(const fs::path &file) {
  return common_temporary(file) += fmt::format(".{}", getpid());
}

// What a killed process leaves behind of a run's files; of others, another process may be writing.
bool is_left_over(const fs::path &file) {
  const std::string name = file.filename().string();
  if (!name.starts_with(temporary_prefix))
    return false;
  const fs::path common = name.substr(temporary_prefix.size());
  return std::ranges::any_of(std::array{common, common.stem()}, [](const fs::path &meant) {
    return is_result(meant) || meant == "checkpoint.json";
  });
}

bool is_open_at(int descriptor, const fs::path &path) {
  struct stat open {};
  struct stat there {};
  return fstat(descriptor, &open) == 0 && stat(path.c_str(), &there) == 0 && open.st_dev == there.st_dev &&
         open.st_ino == there.st_ino;
}

// What a file is written into before it takes its place. The descriptor is negative, and errno says why, where there can
// be none.
struct Temporary {
  fs::path path;
  int descriptor = -1;
};

// The common one, so that what a killed process has left in it is overwritten; one's own where another process is
// writing that one, where it is another user's, or where the file system has no locks.
Temporary open_temporary(const fs::path &file) {
  const fs::path common = common_temporary(file);
  const int descriptor = open(common.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor >= 0) {
    const bool locked = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    if (!locked && errno != EWOULDBLOCK)
      unlink(common.c_str());
    // Its writer may have been faster: then it is the file by now.
    if (locked && is_open_at(descriptor, common) && ftruncate(descriptor, 0) == 0)
      return {common, descriptor};
    close(descriptor);
  }
  const fs::path own = own_temporary(file);
  return {own, open(own.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
}

// A hard link, or a copy where there can be none.
void share_file(const fs::path &from, const fs::path &to) {
  std::error_code ec;
  const fs::path temporary = own_temporary(to);
  fs::create_hard_link(from, temporary, ec);
  if (ec && !fs::copy_file(from, temporary, fs::copy_options::overwrite_existing, ec))
    fail("cannot write", temporary, ec.value());
  fs::rename(temporary, to, ec);
  if (ec)
    fail("cannot write", to, ec.value());
}

// An entry of run.json; empty if there is none.
std::string provenance(const fs::path &directory, const char *entry) {
  const fs::path file = directory / "run.json";
  const auto json = read_json(file);
  try {
    return json ? json->value(entry, "") : "";
  } catch (const Json::exception &error) {
    fail_to_use(file, error);
  }
}

// What made the results of a directory, and from which input. Earlier versions knew no task but to run.
std::string task_of(const fs::path &directory) {
  const std::string made_by = provenance(directory, "task");
  return made_by.empty() ? Task{}.name : made_by;
}
Case input_of(const fs::path &directory, const Task &task) {
  return read_case(directory / "resolved.toml", {}, task).runs.at(0).physics;
}

// "flow.viscosity_ratio = 1, no until.time": what the first has in place of the second.
std::string what_differs(const Case &first, const Case &second) {
  std::string text;
  for (const Key &key : keys()) {
    const auto value = get_value(key, first), instead = get_value(key, second);
    if (key.name == "title" || key.name == "paper" ||
        (value ? value_text(*value) : "") == (instead ? value_text(*instead) : ""))
      continue;
    text += text.empty() ? "" : ", ";
    text += value ? fmt::format("{} = {}", key.name, value_text(*value)) : fmt::format("no {}", key.name);
  }
  return text;
}

} // namespace

void make_directories(const fs::path &directory) {
  std::error_code ec;
  fs::create_directories(directory, ec);
  if (ec)
    fail("cannot create directory", directory, ec.value());
}

void write_atomically(const fs::path &file, std::string_view content) {
  const auto [temporary, descriptor] = open_temporary(file);
  int error = descriptor < 0 ? errno : 0;
  for (std::size_t done = 0; error == 0 && done < content.size();) {
    const ssize_t written = write(descriptor, content.data() + done, content.size() - done);
    if (written >= 0)
      done += static_cast<std::size_t>(written);
    else if (errno != EINTR)
      error = errno;
  }
  if (error == 0 && fsync(descriptor) != 0)
    error = errno;
  if (error == 0 && rename(temporary.c_str(), file.c_str()) != 0)
    error = errno;
  if (error != 0)
    unlink(temporary.c_str());
  if (descriptor >= 0) // only now: with it goes the lock
    close(descriptor);
  if (error != 0)
    fail("cannot write", file, error);
}

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
    for (const SeriesColumn &column : series_columns)
      values.push_back(exact(row.*column.value));
    json["series"].push_back(std::move(values));
  }
  json["profiles"] = Json::array();
  for (const Profile &profile : checkpoint.profiles) {
    Json values{{"time", exact(profile.time)}, {"x_g", exact(profile.x_g)}};
    for (const ProfileColumn &column : profile_columns)
      values[column.name] = exact(profile.*column.values);
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
      for (std::size_t i = 0; i < series_columns.size(); ++i)
        row.*series_columns.at(i).value = exact(values.at(i));
      checkpoint.series.push_back(row);
    }
    for (const Json &values : json->at("profiles")) {
      Profile profile;
      profile.time = exact(values.at("time"));
      profile.x_g = exact(values.at("x_g"));
      for (const ProfileColumn &column : profile_columns)
        profile.*column.values = exact_vector(values.at(column.name));
      checkpoint.profiles.push_back(std::move(profile));
    }
    return saved;
  } catch (const Json::exception &error) {
    fail_to_use(file, error);
  }
}

void write_results(const fs::path &directory, const Case &physics, const Outcome &outcome,
                   const Effort &effort, const Task &task) {
  const std::vector<Profile> &profiles = outcome.last.profiles;
  write_atomically(directory / "series.csv", series_csv(outcome.last.series));
  if (has_physical(physics))
    write_atomically(directory / "series_physical.csv", physical_series_csv(physics, outcome.last.series));
  write_atomically(directory / "profiles.csv", profiles_csv(profiles));
  if (!outcome.along.empty())
    write_atomically(directory / "branch.csv", branch_csv(outcome));
  for (std::size_t i = 0; i < profiles.size(); ++i)
    write_atomically(directory / surface_name(i), surface_vtp(profiles[i]));
  write_atomically(directory / "membrane.pvd", surfaces_pvd(profiles));
  write_atomically(directory / "resolved.toml", resolved_toml(physics));
  write_atomically(directory / "run.json", provenance_json(physics, effort, task).dump(2) + "\n");
  write_atomically(directory / "summary.json", summary_json(physics, outcome, effort).dump(2) + "\n");
  remove_checkpoint(directory);
}

void remove_checkpoint(const fs::path &directory) {
  remove_file(directory / "checkpoint.json");
}

Summary read_summary(const fs::path &directory) {
  const fs::path file = directory / "summary.json";
  const auto json = read_json(file);
  if (!json)
    fail("cannot read", file, ENOENT);
  try {
    Summary summary;
    const auto text = [&](const char *key) {
      const Json &value = json->at(key);
      return value.is_string() ? value.get<std::string>() : std::string();
    };
    summary.status = text("status");
    summary.failure = text("failure");
    summary.message = text("message");
    for (const auto &[name, value] : json->items())
      if (value.is_number())
        summary.quantities[name] = value;
    for (const auto &[name, value] : json->at("error_estimate").items())
      if (value.is_number())
        summary.error_estimate[name] = value;
    return summary;
  } catch (const Json::exception &error) {
    fail_to_use(file, error);
  }
}

Profile read_last_profile(const fs::path &directory) {
  const fs::path file = directory / "profiles.csv";
  errno = 0;
  std::ifstream stream(file);
  std::string header, line;
  if (!std::getline(stream, header))
    fail("cannot read", file, errno != 0 ? errno : ENODATA);
  if (header != profiles_header())
    throw FileError(fmt::format("cannot use '{}': its columns are not those of a profile", file.string()));
  constexpr std::size_t columns = 2 + profile_columns.size();
  std::vector<std::array<double, columns>> rows;
  while (std::getline(stream, line)) {
    std::array<double, columns> row{};
    const char *next = line.c_str();
    for (double &value : row) {
      char *end = nullptr;
      value = std::strtod(next, &end);
      if (end == next)
        throw FileError(fmt::format("cannot use '{}': '{}' is no row of a profile", file.string(), line));
      next = *end == ',' ? end + 1 : end;
    }
    if (!rows.empty() && (rows.back()[0] != row[0] || rows.back()[1] != row[1])) // of an earlier profile
      rows.clear();
    rows.push_back(row);
  }
  if (rows.empty())
    throw FileError(fmt::format("cannot use '{}': no profile in it", file.string()));
  Profile profile;
  profile.time = rows.back()[0];
  profile.x_g = rows.back()[1];
  for (std::size_t k = 0; k < profile_columns.size(); ++k) {
    Vector &values = profile.*profile_columns.at(k).values;
    values.resize(std::ssize(rows));
    for (std::size_t i = 0; i < rows.size(); ++i)
      values[static_cast<Eigen::Index>(i)] = rows[i].at(k + 2);
  }
  return profile;
}

bool is_finished(const fs::path &directory, const std::string &identity) {
  std::error_code ignored;
  return fs::exists(directory / "summary.json", ignored) && provenance(directory, "identity") == identity;
}

bool is_finished_input(const fs::path &directory, const Case &physics, const Task &task) {
  std::error_code ignored;
  if (!fs::exists(directory / "summary.json", ignored) || !fs::exists(directory / "resolved.toml", ignored) ||
      task_of(directory) != task.name)
    return false;
  try {
    return same_input(input_of(directory, task), physics, task);
  } catch (const InputError &) { // an input that is none any more
    return false;
  }
}

std::string other_results(const fs::path &directory, const Case &physics, const Task &task) {
  std::error_code ignored;
  try {
    if (!fs::exists(directory / "summary.json", ignored))
      return fs::exists(directory / "checkpoint.json", ignored) &&
                     !read_checkpoint(directory, run_identity(physics, task))
                 ? "an interrupted run"
                 : "";
    if (const std::string made_by = task_of(directory); made_by != task.name)
      return fmt::format("the results of `capsule {}`", made_by);
    const Case other = input_of(directory, task);
    return same_input(other, physics, task) ? "" : fmt::format("a run with {}", what_differs(other, physics));
  } catch (const std::exception &) { // files that are damaged, or of an input that is none any more
    return "results that cannot be read any more";
  }
}

void remove_results(const fs::path &directory) {
  remove_file(directory / "summary.json");
  for (const fs::path &file :
       files_in(directory, [](const fs::path &f) { return is_result(f) || is_left_over(f); }))
    remove_file(file);
}

void share_results(const fs::path &from, const fs::path &to) {
  std::error_code ignored;
  if (fs::equivalent(from / "summary.json", to / "summary.json", ignored))
    return;
  make_directories(to);
  remove_results(to);
  for (const fs::path &file : files_in(from, is_result))
    if (file.filename() != "summary.json")
      share_file(file, to / file.filename());
  share_file(from / "summary.json", to / "summary.json");
}

} // namespace capsule
