#pragma once
// Where a march records a row: the values of x_g or of time at which one is due. Throws nothing.
#include <optional>
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

} // namespace capsule
