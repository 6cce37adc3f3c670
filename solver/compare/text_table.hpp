#pragma once
// Tables of words: in columns for the screen, as CSV, as Markdown. All rows have the same length; the first is the header.
#include <filesystem>
#include <string>
#include <vector>

namespace capsule {

using TextRow = std::vector<std::string>;
std::string text_table(const std::vector<TextRow> &rows);
std::string csv_table(const std::vector<TextRow> &rows);
std::string markdown_table(const std::vector<TextRow> &rows);
// Throws InputError if there is a file by this name that does not begin with the same line: it is no earlier such table.
void write_table(const std::filesystem::path &file, const std::string &text);

} // namespace capsule
