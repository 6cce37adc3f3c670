#pragma once
// What must hold of any input to the reader of case files, whatever bytes it is made of. Aborts where it doesn't, so
// that the fuzzer keeps the input.
#include <filesystem>
#include <string>
#include <vector>

namespace capsule {

// Either every error is located, "label:line:column: error: ...", or each run's resolved input reads back as the same
// input.
void check_reading(const std::filesystem::path &file, const std::vector<std::string> &overrides);

// The file of this process for the bytes that are tried, in memory where there is such a place.
std::filesystem::path scratch_file();
void write_scratch(const std::filesystem::path &file, std::string_view content);

} // namespace capsule
