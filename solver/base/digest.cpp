#include "base/digest.hpp"
#include <cstdint>
#include <fmt/format.h>

namespace capsule {

std::string digest(std::string_view content) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const char c : content)
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return fmt::format("{:016x}", hash);
}

} // namespace capsule
