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

// From the case's own value of the key to `to`, by way of folds if need be. The outcome's branch holds the
// points, its folds the turning points (slope zero to rounding error of the parameter), its series and
// profiles the first point, the folds and the last point. Status: reached; unbounded if the membrane stretches
// beyond runaway_stretch behind a fold, or much further without one; failed. With `second` its last fold is
// followed as this other key goes to its end. Throws what require_branch throws. The accuracy is at least
// 1e-6.
Outcome follow_branch(const Case &asked, const std::string &key, double to, const Control &control,
                      const MarchToRest &march = {}, const std::optional<BranchEnd> &second = {});

// Throws InputError unless the key is a number that steady states depend on and `to` is in its range and not
// where the branch begins.
void require_branch(const Case &input, const std::string &key, double to);
// The same of the key along which the branch's fold is followed.
void require_fold_curve(const Case &input, const std::string &key, const BranchEnd &second);

// What is typed as --along and --to, for a case. A flow rate with its unit ("20 ul/min") along
// physical.flow_rate is a capillary number. Throws InputError if it is no number, or no flow rate.
BranchEnd end_of_branch(const Case &input, const std::string &along, const std::string &to);

} // namespace capsule
