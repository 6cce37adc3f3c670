#pragma once
// Where the project keeps its cases, beside tables/published.csv:
//   cases/<id>/case.toml, validation/<id>/case.toml
//   cases/<id>/<name>.toml   whose results may be stored in cases/<id>/<name>/
// Throws std::filesystem::filesystem_error only where a path cannot be resolved.
#include <filesystem>
#include <optional>
#include <string>

namespace capsule {

struct ProjectCase {
  std::filesystem::path file;   // what read_case takes
  std::filesystem::path stored; // results kept with the sources; empty: they are computed
};

// Why a new case cannot be called so, or nothing: a name is of the letters, digits and signs that make a file, a target
// of CMake and a test, is not one of the build's or the project's own (cmake/taken_names.cmake), and belongs to no other
// case or study, nor to results that are stored with one.
std::string name_complaint(const std::filesystem::path &root, const std::string &name);

// Nothing if there is no such case.
std::optional<ProjectCase> find_project_case(const std::filesystem::path &root, const std::string &name);

// The case of that name, or the one whose directory's name is nearest to it, as read_case takes it; empty if none is
// near.
std::filesystem::path nearest_project_case(const std::filesystem::path &root, const std::string &name);

} // namespace capsule
