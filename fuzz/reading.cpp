#include "reading.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/case_file.hpp"
#include "case/identity.hpp"
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <regex>
#include <unistd.h>

namespace capsule {
namespace {

namespace fs = std::filesystem;

// Of each error one line says where it is, and is printable.
void check_message(const std::string &message) {
  static const std::regex located("(^|\n)[^\n]*:[1-9][0-9]*:[1-9][0-9]*: error: [^\n]+");
  if (!std::regex_search(message, located))
    finding("an error without its place: " + message);
  for (const char32_t c : decoded(message))
    if (!is_printable(c) && c != U'\n' && c != U'\t')
      finding("a control character or a byte that is none in the message: " + message);
}

void check_round_trip(const Case &physics) {
  const fs::path resolved = scratch_file().replace_extension(".resolved.toml");
  write_scratch(resolved, resolved_toml(physics));
  try {
    const CaseInput again = read_case(resolved);
    if (again.runs.size() != 1 || resolved_toml(again.runs[0].physics) != resolved_toml(physics))
      finding("the resolved input reads back as another:\n" + resolved_toml(physics));
  } catch (const InputError &error) {
    finding(fmt::format("the resolved input is refused: {}\n{}", error.what(), resolved_toml(physics)));
  }
}

} // namespace

void finding(const std::string &what) {
  fmt::print(stderr, "finding: {}\n", what);
  std::abort();
}

void check_refusal(const std::function<void()> &read) {
  try {
    read();
  } catch (const InputError &error) {
    check_message(error.what());
  }
}

void check_reading(const fs::path &file, const std::vector<std::string> &overrides) {
  try {
    const CaseInput input = read_case(file, overrides);
    if (input.runs.empty())
      finding("neither a run nor an error");
    check_round_trip(input.runs.front().physics);
    check_round_trip(input.runs.back().physics);
  } catch (const InputError &error) {
    check_message(error.what());
  }
}

fs::path scratch_file() {
  const fs::path memory = "/dev/shm";
  const fs::path parent = access(memory.c_str(), W_OK) == 0 ? memory : fs::temp_directory_path();
  return parent / fmt::format("capsule-fuzz-{}.toml", getpid());
}

fs::path scratch_directory() {
  static const fs::path directory = scratch_file().replace_extension("");
  fs::create_directories(directory);
  return directory;
}

void write_scratch(const fs::path &file, std::string_view content) {
  std::ofstream(file, std::ios::binary) << content;
}

} // namespace capsule
