#pragma once
// Limits of the work of a search for a steady state and of its parts (Control::spend).
#include "base/failure.hpp"
#include "observe/outcome.hpp"

namespace capsule {

// Counts the work that is spent in `work`, which outlives what is returned; beyond the most of it Exhausted is thrown.
inline Control counting(double &work, double most, const Control &control) {
  Control limited = control;
  limited.spend = [&work, most, spend = control.spend](double more) {
    if (spend)
      spend(more);
    work += more;
    if (work > most)
      throw Exhausted{};
  };
  return limited;
}

// A part of a search, which may cost so much. Throws NumericsFailure where it costs more.
template <class Part>
auto within(double most, const Control &control, const Part &part) {
  double work = 0;
  try {
    return part(counting(work, most, control));
  } catch (const Exhausted &) {
    if (work <= most) // it is the whole search that has cost too much
      throw;
    throw NumericsFailure(failure_kind::unresolved, "it takes too long",
                          "begin with a profile of a march (--from)");
  }
}

} // namespace capsule
