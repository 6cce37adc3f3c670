#pragma once
// A short name for a content: equal contents have equal ones, others differ but for an accident. No protection against
// intent. Throws nothing.
#include <string>
#include <string_view>

namespace capsule {

// 16 hexadecimal digits: FNV-1a of 64 bits.
std::string digest(std::string_view content);

} // namespace capsule
