#pragma once
// Reads JSON files. Only for the sources that write such files, because the library's header takes a second to compile.
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace capsule {

using Json = nlohmann::ordered_json;

// JSON has no infinity and no number that is none.
inline Json finite_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

// The file's content, or nothing if there is no such file. Throws FileError.
std::optional<Json> read_json(const std::filesystem::path &file);
// The library's parser and printer take long to compile: in json_file.cpp and nowhere else. The first throws Json::exception;
// without an indentation all is on one line.
Json parsed_json(const std::string &text);
std::string json_text(const Json &json, int indentation = -1);
// What is wrong with a content: "it is not valid JSON (byte 17)", "an entry is missing".
std::string in_words(const Json::exception &error);
// Throws FileError: the file's content is not what it should be.
[[noreturn]] void fail_to_use(const std::filesystem::path &file, const Json::exception &error);

} // namespace capsule
