#pragma once
// A case: the physics and numerics of one run, complete and validated.
#include "case/parameters.hpp"

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
};

} // namespace capsule
