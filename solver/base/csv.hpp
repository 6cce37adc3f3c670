#pragma once
// Comma-separated values, as this program and spreadsheets write them: rows of fields, the first row names the columns.
// A field may stand in double quotes, which are doubled inside it, and then holds commas and line ends, too.
// Nothing is meant by the kind of line ends (\n, \r\n, \r), by a byte order mark of UTF-8, by blank lines, by rows of
// commas alone, and by empty fields behind the last column.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace capsule {

struct CsvRow {
  std::size_t line = 1; // on which the row begins, counted from 1
  std::vector<std::string> fields;
};

// All rows, that of the names first; none of an empty file. Throws FileError if the file cannot be read, and InputError,
// with the line and how to save the file, if it is not UTF-8, if semicolons or tabs stand between the fields, if a quote is
// not closed, or if text follows a closed one.
std::vector<CsvRow> read_csv(const std::filesystem::path &file);
// Lines that begin with this character are rows of one field, as they stand; the first of the others names the columns.
std::vector<CsvRow> read_csv(const std::filesystem::path &file, char comment);
// What is wrong with lines of a file, as InputError says it, by the number of the line.
using LineMistakes = std::multimap<std::size_t, std::string>;
std::string in_order(const LineMistakes &mistakes);
// The same, and what is wrong with quotes is told with other mistakes: it is added to these, and the lines with such quotes are
// left out.
std::vector<CsvRow> read_csv(const std::filesystem::path &file, char comment, LineMistakes &mistakes);

// The columns of a table of numbers, by name. Throws as read_csv, and InputError, with its row and column, for what is no
// number, or none that is allowed.
enum class Numbers { any, finite };
using Columns = std::map<std::string, std::vector<double>>;
Columns read_columns(const std::filesystem::path &file, Numbers allowed = Numbers::any);

// The fields of one line.
std::vector<std::string> split_csv(const std::string &line);

// What is wrong with a line of a file, as InputError says it: "table.csv:3:1: error: ...", with a line end.
std::string csv_error(const std::filesystem::path &file, std::size_t line, const std::string &message);

// A row as it is written, with a line end; fields stand in quotes where they need them.
std::string csv_row(const std::vector<std::string> &fields);

} // namespace capsule
