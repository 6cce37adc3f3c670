#pragma once
// Tables of words: in columns for the screen, as CSV, as Markdown. All rows have the same length; the first is the header.
#include <string>
#include <vector>

namespace capsule {

using TextRow = std::vector<std::string>;
std::string text_table(const std::vector<TextRow> &rows);
std::string csv_table(const std::vector<TextRow> &rows);
std::string markdown_table(const std::vector<TextRow> &rows);

} // namespace capsule
