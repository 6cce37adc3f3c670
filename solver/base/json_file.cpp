#include "base/json_file.hpp"
#include "base/atomic_file.hpp"
#include "base/failure.hpp"
#include <cerrno>
#include <fmt/format.h>
#include <fstream>

namespace capsule {

Json parsed_json(const std::string &text) {
  return Json::parse(text);
}

std::string json_text(const Json &json, int indentation) {
  return json.dump(indentation);
}

std::string in_words(const Json::exception &error) {
  if (const auto *syntax = dynamic_cast<const Json::parse_error *>(&error))
    return fmt::format("it is not valid JSON (byte {})", syntax->byte);
  if (dynamic_cast<const Json::out_of_range *>(&error))
    return "an entry is missing";
  return "an entry is of another kind than it should be";
}

void fail_to_use(const std::filesystem::path &file, const Json::exception &error) {
  throw FileError(
      fmt::format("cannot use '{}': {}; remove it or run with --fresh", file.string(), in_words(error)));
}

std::optional<Json> read_json(const std::filesystem::path &file) {
  errno = 0;
  std::ifstream stream(file);
  if (!stream) {
    if (errno == ENOENT)
      return std::nullopt;
    fail_at("cannot read", file, errno);
  }
  try {
    return Json::parse(stream);
  } catch (const Json::exception &error) {
    fail_to_use(file, error);
  }
}

} // namespace capsule
