#include "base/directory_lock.hpp"
#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace capsule {

DirectoryLock::DirectoryLock(const std::filesystem::path &directory)
    : descriptor_(open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {}

DirectoryLock::~DirectoryLock() {
  if (descriptor_ >= 0)
    close(descriptor_);
}

bool DirectoryLock::acquire() const {
  return flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

} // namespace capsule
