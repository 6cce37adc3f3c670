// libFuzzer: any bytes as a case file.
#include "reading.hpp"
#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  const std::filesystem::path file = capsule::scratch_file();
  capsule::write_scratch(file, {reinterpret_cast<const char *>(data), size});
  capsule::check_reading(file, {});
  return 0;
}
