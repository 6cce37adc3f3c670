#include "case/new_case.hpp"
#include "base/atomic_file.hpp"
#include "base/failure.hpp"
#include "case/case_file.hpp"
#include "case/project.hpp"
#include <fmt/format.h>

namespace capsule {
namespace {

namespace fs = std::filesystem;

void copy_files(const fs::path &from, const fs::path &to) {
  for (const auto &entry : fs::directory_iterator(from))
    if (entry.is_regular_file())
      fs::copy_file(entry.path(), to / entry.path().filename());
}

} // namespace

fs::path new_case(const fs::path &root, const std::string &id, const fs::path &like_what) {
  if (const std::string complaint = name_complaint(root, id); !complaint.empty())
    throw InputError(fmt::format("{}:1:1: error: {}\n", id, complaint));
  fs::path directory = root / "cases" / id;
  // A case of this project goes by its name.
  const fs::path like = fs::is_directory(like_what) ? like_what : root / "cases" / like_what;
  if (!fs::is_directory(like))
    throw InputError(fmt::format("{}:1:1: error: is not a case directory\n", like_what.string()));
  read_case(like);
  make_directories(directory);
  try {
    copy_files(like, directory);
    read_case(directory);
  } catch (const fs::filesystem_error &error) {
    fs::remove_all(directory);
    throw FileError(fmt::format("cannot copy '{}': {}", error.path1().string(), error.code().message()));
  } catch (const InputError &) {
    fs::remove_all(directory);
    throw;
  }
  return directory;
}

} // namespace capsule
