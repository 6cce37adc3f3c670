#pragma once
// A new case directory that begins as a copy of another.
#include <filesystem>
#include <string>

namespace capsule {

// Copies the files of the case directory `like`, or of cases/<like> below `root`, to cases/<id> there and
// returns that path. The copy has its own title, expectations that any case meets, and a README.md to fill in; it is of no
// item of the paper. What
// `inherit` names is looked for from the new place. Throws InputError if `like` is no valid case, if the id
// is no name for a new case (project.hpp), or if the copy is no valid case there; FileError.
std::filesystem::path new_case(const std::filesystem::path &root, const std::string &id,
                               const std::filesystem::path &like_what);

} // namespace capsule
