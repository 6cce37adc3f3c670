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
// Where the last fold of a branch has been followed to: the second key, its value, and the fold there.
struct EndOfFoldCurve {
  std::string along;
  double value = 0;
  FoldPlace fold;
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
  std::optional<EndOfFoldCurve> end_of_fold_curve = {};

  // The failure, unless it is what the status says.
  std::string reason() const { return failure == status ? "" : failure; }
};
// Throws FileError.
Summary read_summary(const std::filesystem::path &directory);

} // namespace capsule
