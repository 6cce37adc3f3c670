#include "base/text.hpp"
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <regex>
#include <utf8.h>
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

std::string number_with_error(double value, std::optional<double> error) {
  constexpr double fewest = 6, most = 12; // digits
  if (!error)
    return fmt::format("{:.{}g}", value, static_cast<int>(fewest));
  const double digits = 1 + std::ceil(std::log10(std::abs(value) / *error));
  return fmt::format("{:.{}g} +- {:.2g}", value,
                     static_cast<int>(digits > fewest ? std::min(digits, most) : fewest), *error);
}

std::optional<double> to_number(const std::string &text) {
  char *end = nullptr;
  errno = 0;
  const double value = std::strtod(text.c_str(), &end);
  const bool whole = !text.empty() && end == text.c_str() + text.size();
  const bool too_large = errno == ERANGE && std::isinf(value);
  return whole && !too_large ? std::optional(value) : std::nullopt;
}

std::vector<std::string> groups_in(const std::string &text, const std::string &pattern) {
  thread_local std::map<std::string, std::regex> compiled;
  const auto known = compiled.find(pattern);
  const std::regex &expression =
      known != compiled.end() ? known->second : compiled.emplace(pattern, pattern).first->second;
  std::smatch found;
  if (!std::regex_match(text, found, expression))
    return {};
  return {std::next(found.begin()), found.end()};
}

std::string respelled_number(const std::string &text) {
  constexpr std::size_t longest = 40;
  constexpr std::string_view minus = "\u2212";
  const std::string ascii = text.starts_with(minus) ? fmt::format("-{}", text.substr(minus.size())) : text;
  if (ascii.size() > longest)
    return "";
  const std::vector<std::string> part =
      groups_in(ascii, "([+-]?)(0*)([0-9]*)(?:([.,])([0-9]*))?(?:[eEdD]([+-]?[0-9]+))?");
  if (part.empty())
    return "";
  const std::string &sign = part[0], &zeros = part[1], &whole = part[2], &point = part[3],
                    &fraction = part[4], &exponent = part[5];
  if (zeros.empty() && whole.empty() && fraction.empty())
    return "";
  const bool thousands = point == "," && fraction.size() == 3 && zeros.empty() && !whole.empty();
  if (thousands)
    return "";
  return fmt::format("{}{}{}{}", sign == "-" ? "-" : "", whole.empty() ? "0" : whole,
                     point.empty() ? "" : "." + (fraction.empty() ? "0" : fraction),
                     exponent.empty() ? "" : "e" + exponent);
}

std::string not_a_number(const std::string &text, const std::string &where) {
  const std::string meant = respelled_number(text);
  return fmt::format("'{}'{} is not a number{}", text, where, meant.empty() ? "" : "; write " + meant);
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
  std::size_t smallest = word.size() < 2 ? 1 : std::max<std::size_t>(1, word.size() / 3) + 1;
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
  return utf8::utf8to32(utf8::replace_invalid(text));
}

std::string encoded(std::u32string_view text) {
  return utf8::utf32to8(text);
}

std::optional<EncodingError> encoding_error(std::string_view bytes) {
  using namespace std::string_view_literals;
  const auto encoded_in = [](const char *encoding) {
    return EncodingError{0, fmt::format("the text {}; save it in UTF-8", encoding)};
  };
  // By its byte order mark; "\xff\xfe" begins both.
  if (bytes.starts_with("\xff\xfe\0\0"sv) || bytes.starts_with("\0\0\xfe\xff"sv))
    return encoded_in("is in UTF-32");
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
    return encoded_in("is in UTF-16");
  // By the zeros with which letters are filled up.
  std::string zeros;
  for (const char byte : bytes.substr(0, 4))
    zeros += byte == '\0' ? '0' : 'x';
  if (zeros == "x000" || zeros == "000x")
    return encoded_in("seems to be in UTF-32");
  if (zeros == "x0x0" || zeros == "0x0x")
    return encoded_in("seems to be in UTF-16");
  if (const std::size_t zero = bytes.find('\0'); zero != std::string_view::npos)
    return EncodingError{zero, "not a text file: byte 0"};
  if (const std::size_t wrong = utf8::find_invalid(bytes); wrong != std::string_view::npos)
    return EncodingError{wrong,
                         fmt::format("not UTF-8: byte 0x{:02x}", static_cast<unsigned char>(bytes[wrong]))};
  return std::nullopt;
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

std::string printable(std::string_view text) {
  std::string shown;
  for (const char32_t c : decoded(text))
    shown += is_printable(c) ? encoded({&c, 1}) : fmt::format("\\u{:04x}", static_cast<std::uint32_t>(c));
  return shown;
}

std::string with_minus_signs(std::string_view text) {
  constexpr std::string_view plus_or_minus = "±", minus = "−";
  std::string signed_text;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view before = text.substr(0, i);
    const bool begins =
        before.empty() || before.ends_with(' ') || before.ends_with('(') || before.ends_with(plus_or_minus);
    const bool is_number = i + 1 < text.size() && text[i + 1] >= '0' && text[i + 1] <= '9';
    if (text[i] == '-' && begins && is_number)
      signed_text += minus;
    else
      signed_text += text[i];
  }
  return signed_text;
}

std::string with_line_feeds(const std::string &text) {
  std::string lines;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] != '\r')
      lines += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n')
      lines += '\n';
  return lines;
}

std::string_view last_component(std::string_view key) {
  return key.substr(key.rfind('.') + 1);
}

std::string section_of(const std::string &key) {
  const std::size_t dot = key.rfind('.');
  return dot == std::string::npos ? "" : key.substr(0, dot);
}

} // namespace capsule
