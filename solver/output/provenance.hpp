#pragma once
// run.json: which program made a run's results of which input, when and where, and which files they are.
#include "case/task.hpp"
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace capsule {

struct Case;
struct Effort;

// Name and content of each file.
using FileContents = std::vector<std::pair<std::string, std::string>>;

std::string provenance_text(const Case &physics, const Effort &effort, const Task &task,
                            const FileContents &files);

// Of the results in a directory. Throw FileError.
std::string identity_of(const std::filesystem::path &directory); // empty if there is no run.json
// The task's name; without a run.json, and by earlier versions, it was `run`.
std::string task_of(const std::filesystem::path &directory);

// What run.json says of a run's files.
struct Written {
  bool by_a_run = false;                      // run.json is of this program, and not damaged
  std::map<std::string, std::string> digests; // name -> digest of the content; empty by earlier versions
};
// Throws nothing.
Written written_in(const std::filesystem::path &directory);

} // namespace capsule
