#pragma once
// checkpoint.json: everything from which an unfinished run goes on, bit by bit the same.
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
// Nothing if there is none, or one of another run.
std::optional<SavedRun> read_checkpoint(const std::filesystem::path &directory, const std::string &identity);
void remove_checkpoint(const std::filesystem::path &directory);

} // namespace capsule
