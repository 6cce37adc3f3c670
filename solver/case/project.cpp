#include "case/project.hpp"
#include "base/text.hpp"
#include "case/taken_names.hpp"
#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace capsule {

namespace fs = std::filesystem;

namespace {

constexpr std::array folders{"cases", "validation"};
constexpr std::size_t longest_name = 100;

bool is_digit(unsigned char c) {
  return std::isdigit(c) != 0;
}

bool is_plain_name(const std::string &name) {
  const auto allowed = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
  };
  return !name.empty() && name[0] != '.' && name[0] != '-' && std::ranges::all_of(name, allowed);
}

bool is_taken_name(const std::string &name) {
  constexpr std::string_view table = "table";
  return std::ranges::find(taken_names, name) != taken_names.end() ||
         (name.size() > table.size() && name.starts_with(table) &&
          std::ranges::all_of(name.substr(table.size()), is_digit));
}

} // namespace

std::string name_complaint(const fs::path &root, const std::string &name) {
  if (!is_plain_name(name))
    return "a case's name is made of letters, digits, '-', '_' and '.', and begins with neither '-' nor '.'";
  if (name.size() > longest_name)
    return fmt::format("a case's name has at most {} characters", longest_name);
  if (is_taken_name(name))
    return fmt::format("'{}' is taken: by a target of the build, or in results/, figures/ or tables/", name);
  std::error_code ignored;
  for (const char *folder : folders)
    if (fs::exists(root / folder / name, ignored))
      return fmt::format("{}/{} already exists", folder, name);
  if (const auto stored = find_project_case(root, name))
    return fmt::format("it is the name of '{}'", fs::relative(stored->file, root).string());
  return "";
}

std::optional<ProjectCase> find_project_case(const fs::path &root, const std::string &name) {
  std::error_code ignored;
  for (const char *folder : folders) {
    if (fs::exists(root / folder / name / "case.toml", ignored))
      return ProjectCase{root / folder / name, {}};
    // "<id>-<name>": each dash may be the one between them.
    for (std::size_t dash = name.find('-'); dash != std::string::npos; dash = name.find('-', dash + 1)) {
      const fs::path directory = root / folder / name.substr(0, dash);
      const fs::path file = directory / (name.substr(dash + 1) + ".toml");
      const fs::path stored = directory / name.substr(dash + 1);
      if (fs::exists(file, ignored))
        return ProjectCase{file, fs::is_directory(stored, ignored) ? stored : fs::path()};
    }
  }
  return std::nullopt;
}

fs::path nearest_project_case(const fs::path &root, const std::string &name) {
  if (const auto exact = find_project_case(root, name))
    return exact->file;
  std::vector<std::string> names;
  std::error_code ec;
  for (const char *folder : folders)
    for (fs::directory_iterator entry(root / folder, ec), end; !ec && entry != end; entry.increment(ec))
      if (fs::exists(entry->path() / "case.toml", ec))
        names.push_back(entry->path().filename().string());
  std::ranges::sort(names); // of two that are as near, always the same
  const std::string near = nearest_word(name, names);
  return near.empty() ? fs::path() : find_project_case(root, near)->file;
}

} // namespace capsule
