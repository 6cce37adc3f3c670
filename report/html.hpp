#pragma once
// Parts of a page in HTML.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace report {

// The text with the letters that mean something to HTML spelled out.
std::string escaped(std::string_view text);

// A line of Markdown: **strong** words, `code`, and subscripts and powers as they are typed in
// captions and tables, v_g and R_t^3, and powers of ten for 1e-6. Names of results, such as max_stretch, stay as they are.
std::string prose(const std::string &text);

// A caption's file without its pictures, as prose.
std::string caption(const std::filesystem::path &markdown);

// The style of a text that starts with a verdict: agrees, differs or undecided; failed if it is not as it was recorded, or
// too uncertain; empty for any other.
std::string verdict_style(std::string_view text);

// The bytes of a picture, for its address.
std::string base64(const std::string &bytes);

// A table of prose that scrolls within the page. The first row names the columns.
std::string table(const std::vector<std::vector<std::string>> &rows);
// The same of a CSV file; published values look different from computed ones, verdicts have their colours.
std::string table(const std::filesystem::path &csv);

} // namespace report
