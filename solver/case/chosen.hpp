#pragma once
// What one run of a case, and each of its capsules, was given, of all that case files and --set say (case_reader.hpp). Throws
// nothing.
#include "case/case_reader.hpp"
#include <cstddef>
#include <string>
#include <vector>

namespace capsule {

// The values of one run: for each assignment the index of its value.
using Selection = std::vector<std::size_t>;

// What one of the runs was given.
struct Chosen {
  CaseReader &reader;
  const Selection &selection;
  std::size_t capsule = 0; // whose values are meant, 0: the leading one's
  bool of_one = false;     // complaints are this capsule's: where it stands in a list, they say its number

  // What an assignment gives this capsule.
  Value value(std::size_t assignment) const;

  // As many as the longest list has values.
  std::size_t capsules() const;
  // Null: not given.
  const GivenValue *given(const std::string &name) const;
  // Whether it was given, and not at a lower level than another key that its value would have to follow.
  bool stands(const std::string &name, const std::string &over) const;
  // At the first of the keys that was given, or else at the file's beginning.
  void complain(const std::vector<std::string> &names, const std::string &message,
                const std::string &hint = "") const;
};

} // namespace capsule
