#include "project.hpp"

namespace capsule {

namespace fs = std::filesystem;

std::optional<ProjectCase> find_project_case(const fs::path &root, const std::string &name) {
  std::error_code ignored;
  for (const char *folder : {"cases", "validation"}) {
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

} // namespace capsule
