// libFuzzer: any bytes as what a checkpoint says of its run, with the digest that belongs to them. What is taken for a
// checkpoint is the same when it is written again.
#include "base/atomic_file.hpp"
#include "base/digest.hpp"
#include "output/checkpoint.hpp"
#include "reading.hpp"
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>

using namespace capsule;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  static const std::string identity = "0123456789abcdef";
  const std::filesystem::path file = scratch_directory() / "checkpoint.json";
  const std::string run(reinterpret_cast<const char *>(data), size);
  write_scratch(file, fmt::format("{{\"identity\":\"{}\",\"digest\":\"{}\",\"run\":{}}}\n", identity,
                                  digest(run), run));
  const auto saved = read_checkpoint(scratch_directory(), identity).run;
  if (!saved)
    return 0;
  write_checkpoint(scratch_directory(), identity, *saved);
  const std::string once = read_file(file);
  write_checkpoint(scratch_directory(), identity, read_checkpoint(scratch_directory(), identity).run.value());
  if (read_file(file) != once)
    finding("a checkpoint that is written again is another one:\n" + once);
  return 0;
}
