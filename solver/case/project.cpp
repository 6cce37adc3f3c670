#include "case/project.hpp"
#include "base/text.hpp"
#include <algorithm>
#include <array>
#include <vector>

namespace capsule {

namespace fs = std::filesystem;

namespace {

constexpr std::array folders{"cases", "validation"};

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
