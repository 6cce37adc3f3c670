#pragma once
// Files of TOML as text and as tables, or what is wrong with them. Throws nothing.
#include "case/located_text.hpp"
#include <filesystem>
#include <map>
#include <string>
#include <toml++/toml.h>
#include <variant>
#include <vector>

namespace capsule {

// The text of a regular file, each line ended by a line feed, or why it cannot be had.
std::variant<std::string, Complaint> read_text(const std::filesystem::path &file);

// The table that a text is, or what is wrong with it. What toml++ 3.3 does is not defined where it asks whether a
// character beyond ASCII is white space: outside of strings and comments, where it would be an error like the ASCII
// character in its place, and behind a backslash that joins two lines of a string.
std::variant<toml::table, LocatedError> parse_toml(std::size_t source, const std::string &text);

// Lists of numbers in a table, by their names: "a.b" in quotes, or dotted. False if there is something else in it.
bool read_intervals(const toml::table &table, const std::string &prefix,
                    std::map<std::string, std::vector<double>> &intervals);

TextPlace place_of(std::size_t source, const toml::source_position &position);

} // namespace capsule
