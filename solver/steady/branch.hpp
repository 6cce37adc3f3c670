#pragma once
// The branch of a case's steady states along one of its keys, through folds.
#include "observe/outcome.hpp"
#include "steady/search.hpp"
#include <optional>
#include <string>

namespace capsule {

struct Case;

// A key and its value at the end of a branch, or of a fold that is followed.
struct BranchEnd {
  std::string key;
  double value = 0;
};

// From the case's own value of the key to its end, by way of folds if need be. The outcome's branch holds the
// points, its folds the turning points (slope zero to rounding error of the parameter), its series and
// profiles the first point, the folds and the last point. Status: reached; unbounded if the membrane stretches
// beyond runaway_stretch behind a fold, or much further without one; failed. With `second` its last fold is
// followed as this other key goes to its end. Both are as require_branch has them. The accuracy is at least
// 1e-6.
Outcome follow_branch(const Case &asked, const BranchEnd &end, const Control &control,
                      const MarchToRest &march = {}, const std::optional<BranchEnd> &second = {});

// Throws InputError unless the keys are two numbers that steady states depend on, and the ends are in their ranges and not
// where the branch, or the fold along `second`, begins.
void require_branch(const Case &input, const BranchEnd &end, const std::optional<BranchEnd> &second = {});

// The options that name the end of a branch and of the curve of its folds, for messages.
inline const std::string to_option = "--to", fold_to_option = "--fold-to";

// What is typed as --along and --to, for a case. A quantity with its unit ("20 ul/min") along a physical key is the value of
// the one dimensionless key that this changes. Throws InputError if it is no number or quantity, or changes more than that.
BranchEnd end_of_branch(const Case &input, const std::string &along, const std::string &to,
                        const std::string &option = to_option);

} // namespace capsule
