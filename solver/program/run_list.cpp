#include "program/run_list.hpp"
#include "base/atomic_file.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/case_file.hpp"
#include "case/keys.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <system_error>

namespace capsule {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path &file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// Whether a text is the list of runs that the program has left in a directory: names of a sweep's runs, or of directories
// where there is a run.
bool is_run_list(const std::string &text, const fs::path &directory) {
  const auto is_swept = [](const std::string &name) {
    const std::size_t end = name.find('='), comma = name.rfind(',', end);
    const std::size_t begin = comma == std::string::npos ? 0 : comma + 1;
    const std::string key = name.substr(begin, end == std::string::npos ? 0 : end - begin);
    return std::ranges::any_of(keys(), [&](const Key &k) { return short_name(k) == key; });
  };
  const auto has_run = [](const fs::path &place) {
    std::error_code ignored;
    return fs::exists(place / "run.json", ignored) || fs::exists(place / "checkpoint.json", ignored);
  };
  std::istringstream lines(text);
  for (std::string name; std::getline(lines, name);)
    if (!(name == "." || is_swept(name) || has_run(directory / name)))
      return false;
  return true;
}

} // namespace

void write_run_list(const CaseInput &input, const fs::path &directory) {
  std::string text;
  for (const RunInput &run : input.runs)
    text += (run.name.empty() ? "." : run.name) + "\n";
  const fs::path file = directory / "runs.txt";
  const std::string present = content_of(file);
  if (present == text) // then it need not be a place where files can be written
    return;
  if (!is_run_list(present, directory))
    throw FileError(
        fmt::format("cannot write '{}': it is there and no list of runs; move it away, or give another "
                    "--out",
                    file.string()));
  make_directories(directory);
  write_atomically(file, text);
}

} // namespace capsule
