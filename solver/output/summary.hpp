#pragma once
// summary.json: the end of a run in one object, with its error estimates, its cost and its complete parameters.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace capsule {

struct Case;
struct Effort;
struct Outcome;

std::string summary_text(const Case &physics, const Outcome &outcome, const Effort &effort);

// Read back. Quantities that do not apply are absent.
struct Summary {
  std::string status;
  std::string failure;
  std::string message;
  std::map<std::string, double> quantities;
  std::map<std::string, double> error_estimate;
  std::string along = {};         // of a branch: the key that varies
  std::vector<double> folds = {}; // its values there
};
// Throws FileError.
Summary read_summary(const std::filesystem::path &directory);

} // namespace capsule
