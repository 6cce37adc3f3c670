#include "output/provenance.hpp"
#include "base/atomic_file.hpp"
#include "base/build_info.hpp"
#include "base/digest.hpp"
#include "base/json_file.hpp"
#include "base/text.hpp"
#include "case/identity.hpp"
#include "output/checkpoint.hpp"
#include <algorithm>
#include <cblas.h>
#include <chrono>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fstream>
#include <gsl/gsl_version.h>
#include <sstream>
#include <vector>

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

constexpr const char *digest_entry = "digest"; // of all other entries

bool is_as_written(Json json) {
  if (!json.contains(digest_entry)) // by earlier versions
    return true;
  const Json written = json[digest_entry];
  json.erase(digest_entry);
  return written == digest(json_text(json, 2));
}

// The files that an altered run.json still names: a line for each, "series.csv": "0123456789abcdef".
std::map<std::string, std::string> digests_in(const std::string &text) {
  constexpr const char *entry = R"re(^ *"([A-Za-z0-9_-]+\.[a-z]+)": *"([0-9a-f]{16})",?$)re";
  constexpr std::size_t longest = 200;
  std::map<std::string, std::string> digests;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.size() < longest)
      if (const std::vector<std::string> found = groups_in(line, entry); !found.empty())
        digests[found[0]] = found[1];
  return digests;
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
      {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)}};
  json["processor"] = processor_name();
  json["started"] = effort.started;
  json["finished"] = now_utc();
  for (const auto &[name, content] : files)
    json["files"][name] = digest(content);
  json[digest_entry] = digest(json_text(json, 2));
  return json_text(json, 2) + "\n";
}

Written written_in(const fs::path &directory) {
  const fs::path file = directory / "run.json";
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored))
    return {};
  const std::string text = read_file(file);
  try {
    const Json json = parsed_json(text);
    if (json.contains("identity") && is_as_written(json))
      return {.by_a_run = true,
              .identity = json.at("identity"),
              .task = json.value("task", Task{}.name),
              .digests = json.value("files", std::map<std::string, std::string>{})};
  } catch (const Json::exception &) { // it is damaged, or somebody else's
  }
  if (!text.empty() && text.find("\"identity\":") == std::string::npos)
    return {};
  return {.by_a_run = true, .altered = true, .digests = digests_in(text)};
}

} // namespace capsule
