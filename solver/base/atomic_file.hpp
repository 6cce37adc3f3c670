#pragma once
// Files that are there whole or not at all, whatever happens while they are written: each is written under a temporary
// name beside its place and then renamed. Several processes may write one file at the same time. What a killed process
// leaves is overwritten by the next one. Every function throws FileError with the path and the system's reason.
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace capsule {

// Throws FileError with the text of a system's error number: "cannot write 'a/b.csv': No space left on device".
[[noreturn]] void fail_at(std::string_view what, const std::filesystem::path &path, int error);

// All bytes of a file.
std::string read_file(const std::filesystem::path &file);
void make_directories(const std::filesystem::path &directory);
void write_atomically(const std::filesystem::path &file, std::string_view content);
void copy_atomically(const std::filesystem::path &from, const std::filesystem::path &to);
// Does nothing if there is no such file.
void remove_file(const std::filesystem::path &file);
std::vector<std::filesystem::path> files_in(const std::filesystem::path &directory,
                                            const std::function<bool(const std::filesystem::path &)> &wanted);
// The final names, without directory, that a temporary file may stand for; none if it is not a temporary file.
std::vector<std::filesystem::path> final_names(const std::filesystem::path &temporary);

} // namespace capsule
