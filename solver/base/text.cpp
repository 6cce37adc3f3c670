#include "base/text.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <vector>

namespace capsule {
namespace {

// Damerau-Levenshtein distance (adjacent letters may be swapped once).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] =
          std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

// The character that a text begins with, and the number of its bytes.
std::pair<char32_t, std::size_t> first_character(std::string_view text) {
  constexpr std::pair<char32_t, std::size_t> none = {0xfffd, 1};
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead < 0x80 ? 1 : lead < 0xc0 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
  if (length == 0 || lead >= 0xf8 || text.size() < length)
    return none;
  char32_t character = length == 1 ? lead : lead & (0x7fu >> length);
  for (const char c : text.substr(1, length - 1)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80 || byte >= 0xc0)
      return none;
    character = character << 6 | (byte & 0x3fu);
  }
  // Not longer than needed, no half of a pair of UTF-16, and not beyond the last one.
  constexpr std::array<char32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
  const bool half = character >= 0xd800 && character < 0xe000;
  return character < least.at(length) || half || character > 0x10ffff ? none : std::pair(character, length);
}

} // namespace

std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  // fmt pads the exponent to two digits: 1e-05, 1e+22.
  const std::size_t e = text.find('e');
  if (e != std::string::npos) {
    const bool negative = text[e + 1] == '-';
    const std::size_t digits = text.find_first_not_of("+-0", e + 1);
    text = text.substr(0, e + 1) + (negative ? "-" : "") + text.substr(digits);
  }
  return text;
}

std::optional<double> to_number(const std::string &text) {
  std::size_t used = 0;
  try {
    const double value = std::stod(text, &used);
    return used == text.size() ? std::optional(value) : std::nullopt;
  } catch (const std::exception &) {
    return std::nullopt;
  }
}

std::string counted(std::size_t number, std::string_view what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

std::string trimmed(const std::string &text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::string nearest_word(std::string_view word, std::span<const std::string> candidates) {
  std::string best;
  std::size_t smallest = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string &candidate : candidates) {
    if (word.size() >= candidate.size() + smallest)
      continue;
    const bool abbreviated = word.size() >= 3 && candidate.starts_with(word) && candidate != word;
    if (const std::size_t distance = abbreviated ? 1 : edit_distance(word, candidate); distance < smallest) {
      smallest = distance;
      best = candidate;
    }
  }
  return best;
}

std::u32string decoded(std::string_view text) {
  std::u32string characters;
  while (!text.empty()) {
    const auto [character, bytes] = first_character(text);
    characters += character;
    text.remove_prefix(bytes);
  }
  return characters;
}

std::string encoded(std::u32string_view text) {
  std::string bytes;
  for (const char32_t c : text) {
    const unsigned more = c < 0x80 ? 0 : c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
    constexpr std::array<char32_t, 4> leads = {0, 0xc0, 0xe0, 0xf0};
    bytes += static_cast<char>(leads.at(more) | c >> (6 * more));
    for (unsigned i = more; i-- > 0;)
      bytes += static_cast<char>(0x80 | (c >> (6 * i) & 0x3f));
  }
  return bytes;
}

bool is_printable(char32_t c) {
  // Controls; marks and spaces of no width, and what turns the direction of writing; tags.
  constexpr std::array<std::pair<char32_t, char32_t>, 9> hidden = {{{0, 0x1f},
                                                                    {0x7f, 0x9f},
                                                                    {0xad, 0xad},
                                                                    {0x200b, 0x200f},
                                                                    {0x2028, 0x202e},
                                                                    {0x2060, 0x206f},
                                                                    {0xfeff, 0xfeff},
                                                                    {0xfff9, 0xfffd},
                                                                    {0xe0000, 0xe0fff}}};
  return std::ranges::none_of(hidden,
                              [c](const auto &range) { return range.first <= c && c <= range.second; });
}

std::string_view last_component(std::string_view key) {
  return key.substr(key.rfind('.') + 1);
}

std::string section_of(const std::string &key) {
  const std::size_t dot = key.rfind('.');
  return dot == std::string::npos ? "" : key.substr(0, dot);
}

} // namespace capsule
