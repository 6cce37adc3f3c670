// libFuzzer: any bytes as a checkpoint. What is taken for one is the same when it is written again.
#include "base/atomic_file.hpp"
#include "base/failure.hpp"
#include "output/checkpoint.hpp"
#include "reading.hpp"
#include <cstddef>
#include <cstdint>

using namespace capsule;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  static const std::string identity = "0123456789abcdef"; // of the run that the corpus is of
  const std::filesystem::path file = scratch_directory() / "checkpoint.json";
  write_scratch(file, {reinterpret_cast<const char *>(data), size});
  try {
    const auto saved = read_checkpoint(scratch_directory(), identity);
    if (!saved)
      return 0;
    write_checkpoint(scratch_directory(), identity, *saved);
    const std::string once = read_file(file);
    write_checkpoint(scratch_directory(), identity, read_checkpoint(scratch_directory(), identity).value());
    if (read_file(file) != once)
      finding("a checkpoint that is written again is another one:\n" + once);
  } catch (const FileError &) { // not a checkpoint
  }
  return 0;
}
