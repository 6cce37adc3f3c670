#pragma once
// What a run leaves on disk. Every file is there whole or not at all (atomic_file.hpp).
//   summary.json   the end of the run in one object, and its parameters
//   series.csv     one row per recorded instant
//   series_physical.csv   the same in SI units, where the case has physical ones
//   profiles.csv   one row per point of each profile
//   membrane.pvd, membrane_0000.vtp ...   the profiles as surfaces of revolution, for ParaView
//   resolved.toml  the complete input, itself a case file
//   branch.csv     of a branch of steady states: one row per point, its first column the key that varies
//   run.json       provenance, and the identity by which a finished run is found again
//   checkpoint.json   while the run is not finished
// Every function throws FileError with the path and the system's reason.
#include "case/task.hpp"
#include <filesystem>
#include <string>

namespace capsule {

struct Case;
struct Effort;
struct Outcome;

// All files of a finished run, summary.json last; then the checkpoint goes.
void write_results(const std::filesystem::path &directory, const Case &physics, const Outcome &outcome,
                   const Effort &effort, const Task &task = {});

// Whether the directory holds the finished run of this identity.
bool is_finished(const std::filesystem::path &directory, const std::string &identity);
// Whether the directory holds what the task makes of this input, by whatever version of the program.
bool is_finished_input(const std::filesystem::path &directory, const Case &physics, const Task &task = {});
// Results of another input or task in the directory, in words, for whoever replaces them: "the results of `capsule
// steady`", "a run with flow.viscosity_ratio = 1", "an interrupted run"; empty if there are none. Throws nothing.
std::string other_results(const std::filesystem::path &directory, const Case &physics, const Task &task = {});

// Removes the results of whatever run the directory holds, the summary first, and what a killed process has left.
void remove_results(const std::filesystem::path &directory);
// Puts the results of one directory into another, too, by hard links where the file system has them.
void share_results(const std::filesystem::path &from, const std::filesystem::path &to);

} // namespace capsule
