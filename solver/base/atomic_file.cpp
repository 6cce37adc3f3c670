#include "base/atomic_file.hpp"
#include "base/failure.hpp"
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace capsule {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view temporary_prefix = ".writing-";

// Temporary names beside the file's place: one that all processes use, and one for each process.
fs::path common_temporary(const fs::path &file) {
  return file.parent_path() / fmt::format("{}{}", temporary_prefix, file.filename().string());
}
fs::path own_temporary(const fs::path &file) {
  return common_temporary(file) += fmt::format(".{}", getpid());
}

bool is_open_at(int descriptor, const fs::path &path) {
  struct stat open {};
  struct stat there {};
  return fstat(descriptor, &open) == 0 && stat(path.c_str(), &there) == 0 && open.st_dev == there.st_dev &&
         open.st_ino == there.st_ino;
}

// An open temporary file. If it cannot be opened, the descriptor is negative and errno says why.
struct Temporary {
  fs::path path;
  int descriptor = -1;
};

// Opens the common one, so that what a killed process has left in it is overwritten; the own one if another process is
// writing the common one, if that belongs to another user, or if the file system has no locks.
Temporary open_temporary(const fs::path &file) {
  const fs::path common = common_temporary(file);
  const int descriptor = open(common.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor >= 0) {
    const bool locked = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    if (!locked && errno != EWOULDBLOCK)
      unlink(common.c_str());
    // Another process may have renamed it in the meantime.
    if (locked && is_open_at(descriptor, common) && ftruncate(descriptor, 0) == 0)
      return {common, descriptor};
    close(descriptor);
  }
  const fs::path own = own_temporary(file);
  return {own, open(own.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
}

} // namespace

void fail_at(std::string_view what, const fs::path &path, int error) {
  throw FileError(fmt::format("{} '{}': {}", what, path.string(), std::strerror(error)));
}

std::string read_file(const fs::path &file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  if (stream && stream.peek() != std::ifstream::traits_type::eof())
    bytes << stream.rdbuf();
  if (!stream.is_open() || stream.bad())
    fail_at("cannot read", file, errno);
  return bytes.str();
}

void make_directories(const fs::path &directory) {
  std::error_code ec;
  fs::create_directories(directory, ec);
  if (ec)
    fail_at("cannot create directory", directory, ec.value());
}

void write_atomically(const fs::path &file, std::string_view content) {
  const auto [temporary, descriptor] = open_temporary(file);
  int error = descriptor < 0 ? errno : 0;
  for (std::size_t done = 0; error == 0 && done < content.size();) {
    const ssize_t written = write(descriptor, content.data() + done, content.size() - done);
    if (written >= 0)
      done += static_cast<std::size_t>(written);
    else if (errno != EINTR)
      error = errno;
  }
  if (error == 0 && fsync(descriptor) != 0)
    error = errno;
  if (error == 0 && rename(temporary.c_str(), file.c_str()) != 0)
    error = errno;
  if (error != 0)
    unlink(temporary.c_str());
  if (descriptor >= 0) // not before: this releases the lock
    close(descriptor);
  if (error != 0)
    fail_at("cannot write", file, error);
}

void copy_atomically(const fs::path &from, const fs::path &to) {
  std::error_code ec, ignored;
  const fs::path temporary = own_temporary(to);
  if (fs::copy_file(from, temporary, fs::copy_options::overwrite_existing, ec))
    fs::rename(temporary, to, ec);
  if (!ec)
    return;
  fs::remove(temporary, ignored);
  fail_at("cannot write", to, ec.value());
}

void remove_file(const fs::path &file) {
  std::error_code ec, ignored;
  fs::remove(file, ec); // complains on a read-only disk even about a file that is not there
  if (ec && fs::exists(fs::symlink_status(file, ignored)))
    fail_at("cannot remove", file, ec.value());
}

std::vector<fs::path> files_in(const fs::path &directory,
                               const std::function<bool(const fs::path &)> &wanted) {
  std::vector<fs::path> files;
  std::error_code ec;
  for (fs::directory_iterator entry(directory, ec), end; !ec && entry != end; entry.increment(ec))
    if (wanted(entry->path()))
      files.push_back(entry->path());
  if (ec)
    fail_at("cannot list", directory, ec.value());
  return files;
}

std::vector<fs::path> final_names(const fs::path &temporary) {
  const std::string name = temporary.filename().string();
  if (!name.starts_with(temporary_prefix))
    return {};
  const fs::path common = name.substr(temporary_prefix.size());
  return {common, common.stem()};
}

} // namespace capsule
