#pragma once
// run.json: which program made a run's results of which input, when and where.
#include "case/task.hpp"
#include <filesystem>
#include <string>

namespace capsule {

struct Case;
struct Effort;

std::string provenance_text(const Case &physics, const Effort &effort, const Task &task);

// Of the results in a directory. Throw FileError.
std::string identity_of(const std::filesystem::path &directory); // empty if there is no run.json
// The task's name; without a run.json, and by earlier versions, it was `run`.
std::string task_of(const std::filesystem::path &directory);

} // namespace capsule
