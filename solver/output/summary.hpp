#pragma once
// summary.json: the end of a run in one object, with its error estimates, its cost and its complete parameters.
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace capsule {

struct Case;
struct Effort;
struct Outcome;

std::string summary_text(const Case &physics, const Outcome &outcome, const Effort &effort);

// The key's value on a branch, and the membrane's largest stretch; the error of the value where it is estimated.
struct FoldPlace {
  double value = 0, stretch = 0;
  std::optional<double> error = {};
};
// Read back. Quantities that do not apply are absent.
struct Summary {
  std::string status;
  std::string failure;
  std::string message;
  std::map<std::string, double> quantities;
  std::map<std::string, double> error_estimate;
  std::string along = {}; // of a branch: the key that varies
  std::vector<FoldPlace> folds = {};
  std::string fold_along = {}; // the key along which the last of them is followed, and where that has led
  double fold_along_value = 0;
  std::optional<FoldPlace> end_of_fold_curve = {};

  // The failure, unless it is what the status says.
  std::string reason() const { return failure == status ? "" : failure; }
};
// Throws FileError.
Summary read_summary(const std::filesystem::path &directory);

} // namespace capsule
