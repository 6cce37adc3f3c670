#pragma once
// Where a march records a row: the values of x_g or of time at which one is due, and when a march comes there. Throws nothing.
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace capsule {

struct Station {
  double value;
  bool profile; // with a profile along the meridian
  bool regular; // due whatever profiles are asked for
  bool end;     // of the march
};

// In ascending order, beyond `from`: multiples of the spacing up to the end, the end, and where profiles are asked for:
// at places, and up to the end at multiples of a distance. Without an end there are those of the places alone. Two that are
// the same but for a millionth of the spacing are one.
std::vector<Station> stations(double from, double spacing, std::optional<double> end,
                              const std::vector<double> &profiles, std::optional<double> profiles_every = {});

// A time, and how far a function is beyond zero there.
struct Ahead {
  double time, value;
};
// Root of a function that rises between two times; the first of them where it lies before, infinite where it lies behind.
// Values at both are known. x_g is nearly linear between steps: the secant rule needs about three more; halving guards it.
template <class Function>
double crossing_time(const Function &ahead, Ahead before, Ahead now) {
  if (!(now.value >= 0))
    return std::numeric_limits<double>::infinity();
  if (before.value >= 0)
    return before.time;
  double low = before.time, high = now.time;
  for (int k = 0; k < 100 && std::abs(now.value) > 1e-13; ++k) {
    const double secant = now.time - now.value * (now.time - before.time) / (now.value - before.value);
    const double time = secant > low && secant < high ? secant : (low + high) / 2;
    before = std::exchange(now, {time, ahead(time)});
    (now.value < 0 ? low : high) = time;
  }
  return now.time;
}

} // namespace capsule
