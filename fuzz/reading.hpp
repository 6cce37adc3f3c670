#pragma once
// What must hold of any input to the readers of files, whatever bytes it is made of. Aborts where it doesn't, so
// that the fuzzer keeps the input.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace capsule {

// Either every error is located, "label:line:column: error: ...", or each run's resolved input reads back as the same
// input.
void check_reading(const std::filesystem::path &file, const std::vector<std::string> &overrides);

// Any reader, which either throws nothing or InputError with a located message that can be printed.
void check_refusal(const std::function<void()> &read);
// Keeps the input, and says what is wrong with what has been made of it.
[[noreturn]] void finding(const std::string &what);

// Of this process, for the bytes that are tried, in memory where there is such a place: a file, and a directory.
std::filesystem::path scratch_file();
std::filesystem::path scratch_directory();
void write_scratch(const std::filesystem::path &file, std::string_view content);

} // namespace capsule
