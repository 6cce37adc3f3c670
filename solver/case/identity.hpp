#pragma once
// When two inputs are the same, and the name of what is computed from one. Throws nothing.
#include "case/task.hpp"
#include <string>

namespace capsule {

struct Case;

// All keys that mean something to a run and are not chosen automatically, as a case file that gives the same run again.
std::string resolved_toml(const Case &physics);

// Of these keys those that have another value in a second case, or none.
std::string changed_toml(const Case &physics, const Case &than);

// Whether two inputs are the same to a task, whatever their title.
bool same_input(const Case &a, const Case &b, const Task &task = {});

// 16 hexadecimal digits that name what is computed and written: equal for the same input to a program made of the same
// sources, different otherwise.
std::string run_identity(const Case &physics, const Task &task = {});

} // namespace capsule
