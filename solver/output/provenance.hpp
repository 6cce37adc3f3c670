#pragma once
// run.json: which program made a run's results of which input, when and where, and which files they are; with a digest of
// each file and of itself, by which an alteration is noticed.
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

// What the run.json of a directory says of the run whose files are there.
struct Written {
  bool by_a_run = false; // there is one, and not somebody else's file of that name
  bool altered =
      false; // since it was written: then only `digests` is known, as far as its text still has them
  std::string identity = {};
  std::string task = Task{}.name;                  // its name; earlier versions did not write it
  std::map<std::string, std::string> digests = {}; // name -> digest of the content; empty by earlier versions
};
// Throws FileError if run.json cannot be read.
Written written_in(const std::filesystem::path &directory);

} // namespace capsule
