#include "case/located_text.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace capsule {
namespace {

// The line, and a caret below the place: one column for each character, whatever the file holds.
std::string excerpt(const std::u32string &line, const TextPlace &place) {
  constexpr std::size_t longest = 160;
  const std::size_t column = std::min(place.column - 1, line.size());
  const std::size_t begin = column < longest ? 0 : column - longest / 2;
  std::u32string shown = line.substr(begin, longest), margin = line.substr(begin, column - begin);
  for (char32_t &c : shown)
    c = c == U'\t' || is_printable(c) ? c : U'?';
  for (char32_t &c : margin)
    c = c == U'\t' ? U'\t' : U' ';
  return fmt::format("{:5} | {}\n      | {}^\n", place.line, encoded(shown), encoded(margin));
}

std::string error_text(const LocatedError &error, const LocatedText::Source &source) {
  const TextPlace &place = error.place;
  std::string text =
      fmt::format("{}:{}:{}: error: {}\n", source.label, place.line, place.column, printable(error.message));
  if (place.line <= source.lines.size())
    text += excerpt(source.lines[place.line - 1], place);
  if (!error.hint.empty())
    text += printable(error.hint) + "\n";
  return text;
}

} // namespace

std::u32string characters_of(std::string_view text) {
  const std::u32string characters = decoded(text);
  return characters.substr(characters.starts_with(U'\ufeff') ? 1 : 0);
}

std::vector<std::u32string> split_lines(const std::u32string &text) {
  std::vector<std::u32string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(U'\n', begin), text.size());
    const bool carriage_return = end > begin && text[end - 1] == U'\r';
    lines.push_back(text.substr(begin, end - begin - (carriage_return ? 1 : 0)));
    begin = end + 1;
  }
  return lines;
}

std::size_t LocatedText::add_source(const std::string &label, const std::string &text) {
  sources.push_back({label, split_lines(characters_of(text))});
  return sources.size() - 1;
}

std::string LocatedText::text_at(const TextPlace &place) const {
  const std::vector<std::u32string> &lines = sources[place.source].lines;
  if (place.line > lines.size() || place.column > lines[place.line - 1].size())
    return {};
  return encoded(std::u32string_view(lines[place.line - 1]).substr(place.column - 1));
}

void LocatedText::complain(const LocatedError &error) {
  const auto same = [&](const LocatedError &e) {
    return e.place == error.place && e.message == error.message;
  };
  if (std::ranges::none_of(errors, same))
    errors.push_back(error);
}

void LocatedText::throw_if_any() {
  if (errors.empty())
    return;
  std::ranges::stable_sort(errors, {}, &LocatedError::place);
  std::string text;
  for (const LocatedError &error : errors)
    text += error_text(error, sources.at(error.place.source));
  throw InputError(text);
}

} // namespace capsule
