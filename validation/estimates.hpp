#pragma once
// How the studies hold an error estimate of a march against a refined run.
#include "study.hpp"

namespace capsule {

// What is known of one quantity of one run: its error lies within `floor` of `difference`, because the refined value has
// an error of its own.
struct Verdict {
  double difference, floor, estimate;
  bool determined() const { return difference > 2 * floor; }
  bool bounds() const { return difference - floor <= estimate; }
  bool is_sharp() const { return estimate <= 30 * (difference + floor); }
};

inline bool is_of_the_way(const std::string &quantity) {
  return quantity.ends_with("@x_g");
}

// Where rows are taken: no quantity that a march computes.
inline bool is_a_place(const std::string &quantity) {
  return quantity == "x_g" || quantity.starts_with("x_g@");
}

// Of one estimate of a march to until.x_g. Throws std::out_of_range if a run lacks the quantity.
Verdict verdict_of(const std::string &quantity, const Case &physics, const StudyRun &run,
                   const StudyRun &exact);

} // namespace capsule
