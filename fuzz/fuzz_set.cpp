// libFuzzer: any bytes as the arguments of --set, one argument a line, over a good case file.
#include "reading.hpp"
#include <cstddef>
#include <cstdint>
#include <sstream>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  static const std::filesystem::path file = [] {
    std::filesystem::path place = capsule::scratch_file();
    capsule::write_scratch(place,
                           "capsule.radius = 0.9\nmembrane.law = \"skalak\"\nflow.capillary_number = 0.04\n");
    return place;
  }();
  std::istringstream lines(std::string(reinterpret_cast<const char *>(data), size));
  std::vector<std::string> overrides;
  for (std::string line; std::getline(lines, line);)
    overrides.push_back(line);
  capsule::check_reading(file, overrides);
  return 0;
}
