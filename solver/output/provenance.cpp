#include "output/provenance.hpp"
#include "base/build_info.hpp"
#include "base/digest.hpp"
#include "base/json_file.hpp"
#include "case/identity.hpp"
#include "output/checkpoint.hpp"
#include <algorithm>
#include <cblas.h>
#include <chrono>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fstream>
#include <gsl/gsl_version.h>
#include <sundials/sundials_config.h>

namespace capsule {
namespace {

namespace fs = std::filesystem;

std::string now_utc() {
  return fmt::format("{:%FT%TZ}", fmt::gmtime(std::chrono::system_clock::now()));
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      return line.substr(std::min(line.size(), line.find(':') + 2));
  return "unknown";
}

// An entry of run.json; empty if there is none.
std::string entry_of(const fs::path &directory, const char *entry) {
  const fs::path file = directory / "run.json";
  const auto json = read_json(file);
  try {
    return json ? json->value(entry, "") : "";
  } catch (const Json::exception &error) {
    fail_to_use(file, error);
  }
}

} // namespace

std::string provenance_text(const Case &physics, const Effort &effort, const Task &task,
                            const FileContents &files) {
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
  for (const auto &[name, content] : files)
    json["files"][name] = digest(content);
  return json.dump(2) + "\n";
}

std::string identity_of(const fs::path &directory) {
  return entry_of(directory, "identity");
}

std::string task_of(const fs::path &directory) {
  const std::string task = entry_of(directory, "task");
  return task.empty() ? Task{}.name : task;
}

Written written_in(const fs::path &directory) {
  try {
    const auto json = read_json(directory / "run.json");
    if (!json || !json->contains("identity"))
      return {};
    return {true, json->value("files", std::map<std::string, std::string>{})};
  } catch (const std::exception &) { // it cannot be read, or is damaged
    return {};
  }
}

} // namespace capsule
