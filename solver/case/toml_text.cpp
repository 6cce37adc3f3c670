#include "case/toml_text.hpp"
#include "base/text.hpp"
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>
#include <vector>

namespace capsule {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

bool is_ascii(char32_t c) {
  return c < 0x80;
}

// The first character beyond ASCII that begins a line joined to the one before by a backslash; also in a literal
// string, where a backslash joins nothing.
std::size_t find_joined(const std::u32string &text) {
  constexpr const char32_t *white = U" \t\v\f\r\n";
  for (std::size_t at = text.find(U'\\'); at != std::u32string::npos; at = text.find(U'\\', at + 1)) {
    const std::size_t next = text.find_first_not_of(white, at + 1);
    if (next != std::u32string::npos && !is_ascii(text[next]) && text.find(U'\n', at) < next)
      return next;
  }
  return std::u32string::npos;
}

TextPlace place_at(std::size_t source, std::u32string_view text, std::size_t at) {
  const std::u32string_view before = text.substr(0, at);
  const auto lines = static_cast<std::size_t>(std::ranges::count(before, U'\n'));
  return {source, lines + 1, before.size() - (before.rfind(U'\n') + 1) + 1};
}

// What stands in a number's place around a character of a line.
struct Word {
  std::size_t begin, end;
};
Word word_around(std::u32string_view line, std::size_t at, std::u32string_view ends) {
  const std::size_t before = line.substr(0, at).find_last_of(ends), behind = line.find_first_of(ends, at);
  return {before == std::u32string_view::npos ? 0 : before + 1, std::min(behind, line.size())};
}

// A number in another program's notation at a place where toml++ cannot go on, and its first character.
struct ForeignNumber {
  std::size_t begin;
  std::string typed;
};
std::optional<ForeignNumber> foreign_number(std::u32string_view line, std::size_t at) {
  constexpr std::u32string_view ends = U" \t=[]{}#\"'";
  if (at > 0 && (at >= line.size() || ends.find(line[at]) != std::u32string_view::npos))
    --at; // toml++ has read to the word's end
  const Word with_commas = word_around(line, at, ends);
  const Word item = word_around(line, at, std::u32string(ends) + U",");
  const std::size_t opened = line.substr(0, with_commas.begin).find_last_of(U"=[");
  const bool in_list = opened == std::u32string_view::npos || line[opened] == U'[';
  for (const Word &word : {with_commas, item}) {
    const std::u32string_view whole = line.substr(word.begin, word.end - word.begin);
    // In a list a comma parts two items; but none of them begins with a zero before another digit.
    const std::size_t comma = whole.find(U',');
    if (in_list && comma != std::u32string_view::npos && whole.substr(comma + 1, 1) != U"0")
      continue;
    const std::size_t before = line.substr(0, word.begin).find_last_not_of(U" \t");
    const bool begins_here =
        before == std::u32string_view::npos || U"=[,"sv.find(line[before]) != std::u32string_view::npos;
    const std::string typed = encoded(whole), meant = respelled_number(typed);
    if (begins_here && !meant.empty() && meant != typed)
      return ForeignNumber{word.begin, typed};
  }
  return std::nullopt;
}

// How to write the value around a place where toml++ cannot go on: typesetter's quotes, or a word without quotes; empty if
// it is neither.
std::string quoting_hint(std::u32string_view line, std::size_t at) {
  constexpr std::u32string_view curly = U"\u201c\u201d\u201e\u2018\u2019\u00ab\u00bb";
  if (line.find_first_of(curly) != std::u32string_view::npos)
    return "quotes are straight: \"skalak\"";
  const Word word = word_around(line, std::min(at, line.size()), U" \t=[]{},#");
  const std::string typed = encoded(line.substr(word.begin, word.end - word.begin));
  const std::size_t before = line.substr(0, word.begin).find_last_not_of(U" \t");
  const bool is_value =
      before != std::u32string_view::npos && U"=[,"sv.find(line[before]) != std::u32string_view::npos;
  const auto is_of_words = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; };
  if (!is_value || typed.empty() || std::isalpha(static_cast<unsigned char>(typed[0])) == 0 ||
      !std::ranges::all_of(typed, is_of_words))
    return "";
  for (const char *truth : {"true", "false"})
    if (std::ranges::equal(typed, std::string_view(truth), {},
                           [](unsigned char c) { return std::tolower(c); }))
      return fmt::format("write {}", truth);
  return fmt::format("a word stands in quotes: \"{}\"", typed);
}

// What toml++ says of a text whose characters beyond ASCII it was given as question marks.
LocatedError syntax_error(std::size_t source, const toml::parse_error &error, const std::u32string &text) {
  LocatedError told{place_of(source, error.source().begin), std::string(error.description()), ""};
  const std::vector<std::u32string> lines = split_lines(text);
  if (told.place.line > lines.size())
    return told;
  const std::u32string_view line = lines[told.place.line - 1];
  const std::size_t at = told.place.column - 1;
  if (const auto number = foreign_number(line, at))
    return {{source, told.place.line, number->begin + 1}, not_a_number(number->typed), ""};
  told.hint = quoting_hint(line, at);
  if (at >= line.size())
    return told;
  if (line[at] == U':' && told.message.find("expected '='") != std::string::npos)
    told.hint = "'=' stands between a key and its value: radius = 0.9";
  if (const std::size_t mark = told.message.rfind("'?'"); mark != std::string::npos)
    told.message.replace(mark + 1, 1, encoded(line.substr(at, 1)));
  const std::u32string_view before = line.substr(0, line.find_last_not_of(U' ', at == 0 ? 0 : at - 1) + 1);
  const bool behind_number = !before.empty() && before.back() >= U'0' && before.back() <= U'9';
  const bool letter = (line[at] >= U'a' && line[at] <= U'z') || (line[at] >= U'A' && line[at] <= U'Z');
  if (behind_number && (letter || !is_ascii(line[at])))
    told.hint = "a number with its unit stands in quotes: \"5 um\"";
  else if (behind_number)
    told.hint = number_notation;
  return told;
}

// For a case.toml that is missing: the only other case of its directory.
std::string instead_of(const fs::path &file) {
  std::vector<std::string> others;
  std::error_code ec;
  for (fs::directory_iterator entry(file.parent_path(), ec), end; !ec && entry != end; entry.increment(ec))
    if (entry->path().extension() == ".toml")
      others.push_back(entry->path().string());
  return others.size() == 1 ? fmt::format("did you mean '{}'?", others[0])
                            : "a case directory holds a case.toml";
}

} // namespace

std::variant<std::string, Complaint> read_text(const fs::path &file) {
  std::error_code ec;
  const fs::file_status status = fs::status(file, ec);
  if (status.type() == fs::file_type::not_found)
    return Complaint{"no such file", file.filename() == "case.toml" ? instead_of(file) : ""};
  if (status.type() == fs::file_type::directory)
    return Complaint{"is a directory, not a file", ""};
  if (ec)
    return Complaint{"cannot be read: " + ec.message(), ""};
  if (status.type() != fs::file_type::regular)
    return Complaint{"is not a regular file", ""};
  constexpr std::uintmax_t most_bytes = 1000000;
  if (fs::file_size(file, ec) > most_bytes && !ec)
    return Complaint{"is larger than any case file", ""};
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream && stream.peek() != std::ifstream::traits_type::eof())
    text << stream.rdbuf();
  if (!stream.is_open() || stream.bad())
    return Complaint{std::string("cannot be read: ") + std::strerror(errno), ""};
  return with_line_feeds(text.str());
}

std::variant<toml::table, LocatedError> parse_toml(std::size_t source, const std::string &text) {
  if (const auto error = encoding_error(text)) {
    const std::u32string before = characters_of(std::string_view(text).substr(0, error->byte));
    return LocatedError{place_at(source, before, before.size()), error->message, ""};
  }
  const std::u32string characters = characters_of(text);
  if (const std::size_t joined = find_joined(characters); joined != std::u32string::npos)
    return LocatedError{place_at(source, characters, joined),
                        "a joined line must begin with an ASCII character", ""};
  try {
    std::string ascii;
    for (const char32_t c : characters)
      ascii += is_ascii(c) ? static_cast<char>(c) : '?';
    const toml::table well_formed = toml::parse(std::string_view(ascii)); // or it throws
    return toml::parse(std::string_view(text));
  } catch (const toml::parse_error &error) {
    return syntax_error(source, error, characters);
  }
}

TextPlace place_of(std::size_t source, const toml::source_position &position) {
  return {source, std::max<std::size_t>(1, position.line), std::max<std::size_t>(1, position.column)};
}

bool read_intervals(const toml::table &table, const std::string &prefix,
                    std::map<std::string, std::vector<double>> &intervals) {
  for (auto &&[key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (const toml::table *inner = node.as_table()) {
      if (!read_intervals(*inner, name + ".", intervals))
        return false;
      continue;
    }
    const toml::array *array = node.as_array();
    if (array == nullptr)
      return false;
    for (const toml::node &entry : *array) {
      if (!entry.is_number())
        return false;
      intervals[name].push_back(entry.value<double>().value());
    }
  }
  return true;
}

} // namespace capsule
