#pragma once
// Files of JSON read back. For the sources that write them: compiling the library's header takes a second.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

namespace capsule {

using Json = nlohmann::ordered_json;

// Parsed, or nothing if there is no such file. Throws FileError.
std::optional<Json> read_json(const std::filesystem::path &file);
// Throws FileError: the file's content isn't what it should be.
[[noreturn]] void fail_to_use(const std::filesystem::path &file, const Json::exception &error);

} // namespace capsule
