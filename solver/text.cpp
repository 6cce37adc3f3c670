#include "text.hpp"
#include <algorithm>
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
    const bool abbreviated = word.size() >= 3 && candidate.starts_with(word);
    if (const std::size_t distance = abbreviated ? 1 : edit_distance(word, candidate); distance < smallest) {
      smallest = distance;
      best = candidate;
    }
  }
  return best;
}

std::string_view last_component(std::string_view key) {
  return key.substr(key.rfind('.') + 1);
}

} // namespace capsule
