#pragma once
// A run of a case with what it has left.
#include "case/case_file.hpp"
#include "output/summary.hpp"
#include <filesystem>
#include <optional>

namespace capsule {

struct RunResult {
  RunInput input;
  std::filesystem::path directory;
  std::optional<Summary> summary; // none: interrupted
};

} // namespace capsule
