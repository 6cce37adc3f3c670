#pragma once
// A lock on a directory that one process holds at a time. It ends with the process, however that ends.
// Throws nothing.
#include <filesystem>

namespace capsule {

class DirectoryLock {
public:
  explicit DirectoryLock(const std::filesystem::path &directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock &) = delete;
  DirectoryLock &operator=(const DirectoryLock &) = delete;

  // Returns at once whether this object holds the lock now. On network file systems without locks, and of a directory
  // that cannot be opened, everybody does.
  bool acquire() const;

private:
  int descriptor_;
};

} // namespace capsule
