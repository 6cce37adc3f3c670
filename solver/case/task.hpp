#pragma once
// What is computed of a case.
#include <string>

namespace capsule {

// Its motion, or steady states, to which start, end and time steps mean nothing.
struct Task {
  bool motion = true;
  std::string name = "run"; // with all its arguments: results of the same case are told apart by it
  bool branch = false;      // steady states along a key
  bool fit = false;         // of measured profiles: its unknowns need no values
};

} // namespace capsule
