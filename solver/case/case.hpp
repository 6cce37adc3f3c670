#pragma once
// A case: the physics and numerics of one run, complete and validated.
#include "case/parameters.hpp"
#include <string>
#include <vector>

namespace capsule {

struct Case {
  std::string title;
  std::string paper; // the item of the paper that the case replicates
  Numerics numerics = Numerics::standard;
  double accuracy = 1e-4; // relative error asked for

  PoreSpec pore;
  CapsuleSpec capsule;
  MembraneSpec membrane;
  FlowSpec flow;
  MeshSpec mesh;
  TimeSpec time;
  UntilSpec until;
  PhysicalSpec physical;
  OutputSpec output;
  FitSpec fit;

  // The capsules behind this one, the nearest first, each as a case of its own: the same scene with that capsule alone.
  std::vector<Case> followers;
};

// Every capsule as a case of its own, the leading one first. They refer to the case.
std::vector<const Case *> capsules_of(const Case &physics);

} // namespace capsule
