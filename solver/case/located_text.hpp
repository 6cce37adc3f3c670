#pragma once
// Texts that were read, and what is wrong at places in them, told like a compiler:
//   case.toml:14:1: error: unknown key 'flow.capilary_number'
//      14 | capilary_number = 0.09
//         | ^
//   did you mean 'capillary_number'?
// Lines and columns are counted from 1, columns in characters.
#include <compare>
#include <string>
#include <string_view>
#include <vector>

namespace capsule {

// What is wrong with a value or a text, and what may have been meant.
struct Complaint {
  std::string message;
  std::string hint;
};

// How numbers are written, for whoever has written one in another way.
constexpr const char *number_notation = "a number is written as 0.05, 1000 or 1e-3";

struct TextPlace {
  std::size_t source = 0; // which of the texts
  std::size_t line = 1;
  std::size_t column = 1;
  auto
  operator<=>(const TextPlace &) const = default; // NOLINT(modernize-use-nullptr): the check misreads this
};

struct LocatedError {
  TextPlace place;
  std::string message, hint;
};

// The characters of a text without the byte order mark that is allowed in front, and lines of them.
std::u32string characters_of(std::string_view text);
std::vector<std::u32string> split_lines(const std::u32string &text);

// Gathers the errors of all texts.
struct LocatedText {
  struct Source {
    std::string label; // how messages name it: a file, or "--set"
    std::vector<std::u32string> lines;
  };
  std::vector<Source> sources;
  std::vector<LocatedError> errors;

  std::size_t add_source(const std::string &label, const std::string &text);
  // The rest of the line.
  std::string text_at(const TextPlace &place) const;
  // Keeps each error once, even if several runs of a sweep repeat it.
  void complain(const LocatedError &error);
  // Throws InputError with all errors in the order of their places, if there are any.
  void throw_if_any();
};

} // namespace capsule
