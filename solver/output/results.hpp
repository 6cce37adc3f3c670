#pragma once
// What a run leaves on disk. Every file is there whole or not at all (atomic_file.hpp).
//   summary.json   the end of the run in one object, and its parameters
//   series.csv     one row per recorded instant
//   series_physical.csv   the same in SI units, where the case has physical ones
//   profiles.csv   one row per point of each profile
//   membrane.pvd, membrane_0000.vtp ...   the profiles as surfaces of revolution, for ParaView
//   series-2.csv, profiles-2.csv, membrane-2_0000.vtp ...   the same of a second capsule, and so on
//   resolved.toml  the complete input, itself a case file
//   branch.csv     of a branch of steady states: one row per point, its first column the key that varies
//   run.json       provenance, the identity by which a finished run is found again, and the digest of each file
//   checkpoint.json   while the run is not finished
// Every function throws FileError with the path and the system's reason.
#include "case/task.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace capsule {

struct Case;
struct Effort;
struct Outcome;

// All files of a finished run in place of those of another one: run.json first, which names them, summary.json last; then
// the checkpoint goes.
void write_results(const std::filesystem::path &directory, const Case &physics, const Outcome &outcome,
                   const Effort &effort, const Task &task = {});

// Whether the directory holds the finished run of this identity.
bool is_finished(const std::filesystem::path &directory, const std::string &identity);
// Whether the directory holds what the task makes of this input, by whatever version of the program.
bool is_finished_input(const std::filesystem::path &directory, const Case &physics, const Task &task = {});
// Results of another input or task in the directory, in words, for whoever replaces them: "the results of `capsule
// steady`", "a run with flow.viscosity_ratio = 1", "an interrupted run"; empty if there are none. Throws nothing.
std::string other_results(const std::filesystem::path &directory, const Case &physics, const Task &task = {});

// Throws FileError if there is a file that is not of a run, but where a run's file would come. So what the program has not
// written is neither overwritten nor removed.
void require_free(const std::filesystem::path &directory);
// Gives files of a run that were altered since they were written another name, "series.csv.altered", and returns their
// paths. Where run.json itself was altered, the run's other files go: they are to be computed again with it.
std::vector<std::filesystem::path> set_aside_altered(const std::filesystem::path &directory);
// Whether all files are there that a run has left; of those of earlier versions it is not known.
bool is_complete(const std::filesystem::path &directory);

// Removes the results of whatever run the directory holds, the summary first, and what a killed process has left.
void remove_results(const std::filesystem::path &directory);
// Copies the results of one directory into another, in place of others; not if they are there.
void share_results(const std::filesystem::path &from, const std::filesystem::path &to);

} // namespace capsule
