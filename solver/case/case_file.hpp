#pragma once
// Case files: TOML -> validated runs. The keys are those of case/key.hpp, and two more:
//   inherit = "file.toml"             values of another file, relative to this one, that this file overrides
//   inherit = ["a", "b"]              the runs of the first file and those of the second, and so on
//   sweep."flow.viscosity_ratio" = []  one run per value; several sweeps make every combination
// A plain value overrides an inherited sweep of the same key and the other way round; --set overrides both.
// Every error of all files is collected and thrown as one InputError (located_text.hpp). The way of the data: toml_text,
// case_reader (what the keys are given), case_file (the runs), case_checks (what values must be to each other).
#include "case/case.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace capsule {

// What is computed of a case: its motion, or steady states, to which start, end and time steps mean nothing.
struct Task {
  bool motion = true;
  std::string name = "run"; // with all its arguments: results of the same case are told apart by it
};

struct RunInput {
  // "viscosity_ratio=0.2,radius=0.9" with sweeps, after the inherited case's name if there are several, or empty
  std::string name;
  Case physics;
};

struct CaseInput {
  std::string name; // of the case directory, or of the file
  std::filesystem::path file;
  std::vector<RunInput> runs; // the last sweep varies fastest
};

// `path`: a case directory (that holds case.toml) or a .toml file; each override is "key=value", where the
// value is TOML or a bare word. Throws InputError.
CaseInput read_case(const std::filesystem::path &path, const std::vector<std::string> &overrides = {},
                    const Task &task = {});

// All keys of a run that are not chosen automatically, as a case file that gives the same run again.
std::string resolved_toml(const Case &physics);

// Whether two inputs are the same to a task: whatever their title and, with the paper's numerics, their
// accuracy.
bool same_input(const Case &a, const Case &b, const Task &task = {});

// 16 hexadecimal digits that name what is computed and written: equal for the same input to a program made of
// the same sources, different otherwise.
std::string run_identity(const Case &physics, const Task &task = {});

} // namespace capsule
