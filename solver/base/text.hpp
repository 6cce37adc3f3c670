#pragma once
// Numbers, words and characters as text. Throws nothing.
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace capsule {

// The shortest decimal text that reads back as the same double: "0.2", "15", "1e-5", "nan", "-inf".
std::string number_text(double value);

// With its error, if it is known, and the digits that this leaves: "0.1700807 +- 1.2e-07", otherwise "0.170081".
std::string number_with_error(double value, std::optional<double> error);

// The number, if the whole text is one; nothing for one that is too large.
std::optional<double> to_number(const std::string &text);

// What each group of a regular expression stands for in a text that fits it as a whole; nothing for one that does not fit.
// The library's expressions take seconds to compile, in text.cpp and nowhere else. It recurses: the text must be short.
std::vector<std::string> groups_in(const std::string &text, const std::string &pattern);

// A number in the notation of another program, as it is written here: "1e-3" for "1d-3", "0.05" for "0,05" or ".05",
// "5.0" for "5.", "-5" with a typesetter's minus. Empty if the text is no number, or may stand for two: "1,000".
std::string respelled_number(const std::string &text);
// "'0,05' in the column 'v_g' is not a number; write 0.05", where " in the column 'v_g'" says where it stands.
std::string not_a_number(const std::string &text, const std::string &where = "");

// "1 run", "4 runs".
std::string counted(std::size_t number, std::string_view what);

// Without spaces around it.
std::string trimmed(const std::string &text);

// The candidate that a mistyped word most likely means; empty if none is near. Counts inserted, deleted, replaced and
// swapped letters; near is at most a third of the word's letters, or one of two letters. A single letter means itself only.
// A candidate that the word begins counts as one letter off.
std::string nearest_word(std::string_view word, std::span<const std::string> candidates);

// UTF-8 as characters and back. Bytes that are not UTF-8 become U+FFFD, one for each broken sequence.
std::u32string decoded(std::string_view text);
std::string encoded(std::u32string_view text);
// Why bytes are not a text in UTF-8, and the first byte that is wrong; nothing if they are one.
struct EncodingError {
  std::size_t byte = 0; // counted from 0
  std::string message;
};
std::optional<EncodingError> encoding_error(std::string_view bytes);
// Not a command to the terminal, not invisible, not U+FFFD.
bool is_printable(char32_t c);
// With "\u001b" for a character that is not printable.
std::string printable(std::string_view text);

// With the sign of a negative number as people write it, "−0.5": at the beginning or behind a blank, a parenthesis or ±.
std::string with_minus_signs(std::string_view text);

// Each line ends with a line feed: not with both characters, as on Windows, nor with a carriage return, as in old files.
std::string with_line_feeds(const std::string &text);

// What follows the last dot of a key: "capillary_number" of "flow.capillary_number".
std::string_view last_component(std::string_view key);
// What stands before it: "flow".
std::string section_of(const std::string &key);

} // namespace capsule
