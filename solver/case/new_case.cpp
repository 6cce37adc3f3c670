#include "case/new_case.hpp"
#include "base/atomic_file.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/case_file.hpp"
#include "case/project.hpp"
#include <fmt/format.h>
#include <sstream>

namespace capsule {
namespace {

namespace fs = std::filesystem;

void copy_files(const fs::path &from, const fs::path &to) {
  for (const auto &entry : fs::directory_iterator(from))
    if (entry.is_regular_file())
      fs::copy_file(entry.path(), to / entry.path().filename());
}

bool is_key(const std::string &line, const std::string &key) {
  return line.starts_with(key) && trimmed(line.substr(key.size())).starts_with("=");
}

// The case's text as one of its own: with its title, and of no item of the paper.
std::string of_its_own(const std::string &toml, const std::string &id, const std::string &like) {
  std::istringstream lines(toml);
  std::string text = fmt::format(
      "# Which question does this case answer? (It began as a copy of {}.)\ntitle = \"{}\"\n", like, id);
  bool in_head = true;
  for (std::string line; std::getline(lines, line);) {
    in_head = in_head && (line.starts_with("#") || trimmed(line).empty());
    if (!in_head && !is_key(line, "title") && !is_key(line, "paper"))
      text += line + "\n";
  }
  return text;
}

// What every case may expect, and how a row of its own looks.
constexpr const char *expectations =
    "id,run,quantity,expected,allowed,reason\n"
    "volume,,max(abs(volume_change@x_g=-100..1000)),<1e-4,,the liquid inside is incompressible\n"
    "film,,min(min_film@x_g=-100..1000),>0,,the membrane does not touch the wall\n"
    "# pressure,radius=0.9,pressure_drop,7.74,1 %,where the value is from\n"
    "# pascals,,pressure_drop [Pa],390,1 %,of a case in physical units\n";

std::string readme(const std::string &id) {
  return fmt::format("# {}\n\n**Question.** ...\n\n**Answer.** ...\n\n**Check.** What else says "
                     "so?\n\n**Cost.** ... s of one core.\n",
                     id);
}

} // namespace

fs::path new_case(const fs::path &root, const std::string &id, const fs::path &like_what) {
  if (!fs::is_directory(root / "cases"))
    throw InputError(
        "error: there is no directory cases/ here: a new case is made in the project's directory; "
        "elsewhere any .toml file is a case\n");
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
    const fs::path file = directory / "case.toml";
    write_atomically(file, of_its_own(read_file(file), id, like.filename().string()));
    write_atomically(directory / "expected.csv", expectations);
    write_atomically(directory / "README.md", readme(id));
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
