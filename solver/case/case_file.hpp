#pragma once
// Case files: TOML -> validated runs. The keys are those of case/keys.hpp, and two more:
//   inherit = "file.toml"             values of another file, relative to this one, that this file overrides
//   inherit = ["a", "b"]              the runs of the first file and those of the second, and so on
//   sweep."flow.viscosity_ratio" = []  one run per value; several sweeps make every combination
// A plain value overrides an inherited sweep of the same key and the other way round; --set overrides both. A plain value of
// --set leaves one run of a sweep, which keeps its name.
// Every error of all files is collected and thrown as one InputError (located_text.hpp). The way of the data: toml_text,
// case_reader (what the keys are given), case_file (the runs), case_checks (what values must be to each other).
#include "case/case.hpp"
#include "case/task.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace capsule {

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

// The input of a run, as it stands in its results. Throws InputError.
Case read_resolved(const std::filesystem::path &file, const Task &task = {});

} // namespace capsule
