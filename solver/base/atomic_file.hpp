#pragma once
// Files that are there whole or not at all, whatever happens while they are written: each is written beside its
// place and renamed into it. Several processes may write one file at once; what one that was killed leaves is
// overwritten by the next.
// Every function throws FileError with the path and the system's reason.
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace capsule {

// Throws: "cannot write 'a/b.csv': No space left on device", of an error number of the system.
[[noreturn]] void fail_at(std::string_view what, const std::filesystem::path &path, int error);

// All bytes of a file.
std::string read_file(const std::filesystem::path &file);
void make_directories(const std::filesystem::path &directory);
void write_atomically(const std::filesystem::path &file, std::string_view content);
// As atomically: a hard link, or a copy where there can be none.
void share_file(const std::filesystem::path &from, const std::filesystem::path &to);
// Nothing happens if it isn't there.
void remove_file(const std::filesystem::path &file);
std::vector<std::filesystem::path> files_in(const std::filesystem::path &directory,
                                            const std::function<bool(const std::filesystem::path &)> &wanted);
// If this is what a process has written into before its file would take its place: the names that the file may
// have, without directory.
std::vector<std::filesystem::path> meant_by(const std::filesystem::path &temporary);

} // namespace capsule
