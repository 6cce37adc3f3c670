#pragma once
// checkpoint.json: everything from which an unfinished run goes on, bit by bit the same, with a digest of it.
// Every function throws FileError with the path and the system's reason.
#include "observe/outcome.hpp"
#include <filesystem>
#include <optional>
#include <string>

namespace capsule {

// What a run has cost, over all interruptions.
struct Effort {
  std::string started; // UTC
  double cpu_seconds = 0;
  double wall_seconds = 0;
};

struct SavedRun {
  Checkpoint checkpoint;
  Effort effort;
};
void write_checkpoint(const std::filesystem::path &directory, const std::string &identity,
                      const SavedRun &saved);

// What there is of a run.
struct FoundCheckpoint {
  std::optional<SavedRun> run = {};
  bool of_another_run = false;
  std::string damage = {}; // why it is of no use, if it is not what was written
};
FoundCheckpoint read_checkpoint(const std::filesystem::path &directory, const std::string &identity);
// Whether the directory has a checkpoint.json that no run has left.
bool has_foreign_checkpoint(const std::filesystem::path &directory);
void remove_checkpoint(const std::filesystem::path &directory);

} // namespace capsule
