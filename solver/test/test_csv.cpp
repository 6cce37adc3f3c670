// Comma-separated values as programs and spreadsheets write them: what means nothing, what is refused and where, what is
// written reads back.
#include "base/csv.hpp"
#include "base/failure.hpp"
#include "temporary_directory.hpp"
#include <boost/test/unit_test.hpp>

using namespace capsule;

namespace {

using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(const std::string &text) {
  const TemporaryDirectory directory;
  Rows rows;
  for (const CsvRow &row : read_csv(directory.write("t.csv", text)))
    rows.push_back(row.fields);
  return rows;
}

// What is said of a file, without its directory.
template <class Reader>
std::string said_of(const std::string &text, const Reader &read) {
  const TemporaryDirectory directory;
  const auto file = directory.write("t.csv", text);
  try {
    read(file);
  } catch (const InputError &error) {
    const std::string message = error.what();
    return message.starts_with(directory.path.string()) ? message.substr(directory.path.string().size() + 1)
                                                        : message;
  }
  return "no error";
}
std::string refusal(const std::string &text) {
  return said_of(text, [](const auto &file) { read_csv(file); });
}
std::string refusal_of_numbers(const std::string &text) {
  return said_of(text, [](const auto &file) { read_columns(file); });
}

std::string utf16(const std::string &ascii, bool low_byte_first) {
  std::string text = low_byte_first ? "\xff\xfe" : "\xfe\xff";
  for (const char c : ascii)
    text += low_byte_first ? std::string{c, '\0'} : std::string{'\0', c};
  return text;
}

const std::string advice = "save it as CSV in UTF-8 with commas between the fields\n";

} // namespace

BOOST_AUTO_TEST_CASE(what_means_nothing) {
  const Rows table{{"id", "value"}, {"a", "1"}, {"b", ""}};
  for (const char *text :
       {"id,value\na,1\nb,\n", "id,value\na,1\nb,", "id,value\r\na,1\r\nb,\r\n", "id,value\ra,1\rb,\r",
        "\xef\xbb\xbfid,value\na,1\nb,\n", "\"id\",\"value\"\n\"a\",\"1\"\n\"b\",\"\"\n",
        "\n\nid,value\n\na,1\n \nb,\n\n\r\n", "id,value\n,\na,1\nb,\n,\n,,,,\n",
        "id,value,,\na,1,,\nb,,,\n,,,\n",
        "\xef\xbb\xbf\"id\",\"value\",\r\n,,\r\n\"a\",1,\r\nb,\"\",\r\n\r\n"})
    BOOST_TEST((rows_of(text) == table), text);
  for (const char *text : {"", "\n", ",,\n\"\",\n", "\xef\xbb\xbf\r\n"})
    BOOST_TEST(rows_of(text).empty(), text);
}

BOOST_AUTO_TEST_CASE(quotes) {
  BOOST_TEST((rows_of("a,b\n\"x, y\",\"say \"\"it\"\"\"\n") == Rows{{"a", "b"}, {"x, y", "say \"it\""}}));
  BOOST_TEST((rows_of("a,b\n\"two\r\nlines\", \"c\"\n") == Rows{{"a", "b"}, {"two\nlines", "c"}}));
  BOOST_TEST((rows_of("a,b\n5\" wide,6\"\n") == Rows{{"a", "b"}, {"5\" wide", "6\""}})); // inches
  BOOST_TEST((split_csv("a,\"b,c\",") == std::vector<std::string>{"a", "b,c", ""}));
  BOOST_TEST((split_csv("") == std::vector<std::string>{""}));
}

BOOST_AUTO_TEST_CASE(rows_know_their_lines) {
  const TemporaryDirectory directory;
  std::vector<std::size_t> lines;
  for (const CsvRow &row : read_csv(directory.write("t.csv", "a,b\r\n\r\n\"1\r\n2\",3\r\n,,\r\n4,5\r\n")))
    lines.push_back(row.line);
  BOOST_TEST(lines == (std::vector<std::size_t>{1, 3, 6}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(what_is_written_reads_back) {
  const Rows table{{"name", "text"}, {"plain", "1e-5"},       {"comma", "a,b"},
                   {"quote", "\""},  {"lines", "one\ntwo\n"}, {"\xc2\xb5", " spaces "}};
  std::string text;
  for (const std::vector<std::string> &row : table)
    text += csv_row(row);
  BOOST_TEST((rows_of(text) == table));
  BOOST_TEST(csv_row({"", "a", "b,c", ""}) == ",a,\"b,c\",\n");
}

BOOST_AUTO_TEST_CASE(what_is_refused) {
  for (const bool low_byte_first : {true, false})
    BOOST_TEST(refusal(utf16("id,value\n", low_byte_first)) ==
               "t.csv:1:1: error: the text is in UTF-16; save it in UTF-8\n" + advice);
  BOOST_TEST(refusal("id,value\na,5 \xb5m\n") == "t.csv:2:1: error: not UTF-8: byte 0xb5\n" + advice);
  for (const auto &half : {std::string("i\0d\0\n\0", 6), std::string("\0i\0d\0\n", 6)})
    BOOST_TEST(refusal(half) ==
               "t.csv:1:1: error: the text seems to be in UTF-16; save it in UTF-8\n" + advice);
  for (const auto &quarter : {std::string("i\0\0\0d\0\0\0", 8), std::string("\0\0\0i\0\0\0d", 8)})
    BOOST_TEST(refusal(quarter) ==
               "t.csv:1:1: error: the text seems to be in UTF-32; save it in UTF-8\n" + advice);
  for (const auto &marked : {std::string("\xff\xfe\0\0i\0\0\0", 8), std::string("\0\0\xfe\xff\0\0\0i", 8)})
    BOOST_TEST(refusal(marked) == "t.csv:1:1: error: the text is in UTF-32; save it in UTF-8\n" + advice);
  BOOST_TEST(refusal(std::string("id\n\0", 4)) == "t.csv:2:1: error: not a text file: byte 0\n" + advice);
  for (const char *text :
       {"id;value\na;1\n", "\"id\";\"value\"\n\"a\";\"1,5\"\n", "id\tvalue\n", "sep=;\nid;value\n"})
    BOOST_TEST(refusal(text) == "t.csv:1:1: error: semicolons or tabs stand between the fields\n" + advice);
  BOOST_TEST(refusal("id,value\na,\"1\nb,2\n") == "t.csv:2:1: error: this quote is not closed\n" + advice);
  BOOST_TEST(refusal("id,value\na,\"1\nb,\"2\"\n") ==
             "t.csv:2:1: error: text stands behind the end of this quote\n" + advice);
  BOOST_TEST(refusal("id,value\na,\"1\" \nb,\t\"2\"\t\n") == "no error");
  BOOST_TEST(refusal("id,value\na,1;2\n") == "no error");
  const TemporaryDirectory directory;
  for (const auto &file : {directory.path / "none.csv", directory.path})
    BOOST_TEST(failure_of([&] { read_csv(file); }).find("cannot read '" + file.string() + "': ") == 0u);
}

BOOST_AUTO_TEST_CASE(columns_of_numbers) {
  const TemporaryDirectory directory;
  const Columns columns =
      read_columns(directory.write("t.csv", "time, \"v g\"\r\n0,-4e-3\r\n\r\n\"0.1\", 5e-324\r\n,\r\n"));
  BOOST_REQUIRE(columns.size() == 2u);
  BOOST_TEST(columns.at("time") == (std::vector{0, 0.1}), boost::test_tools::per_element());
  BOOST_TEST(columns.at("v g") == (std::vector{-4e-3, 5e-324}), boost::test_tools::per_element());
  BOOST_TEST(read_columns(directory.write("t.csv", "")).empty());
  BOOST_TEST(read_columns(directory.write("t.csv", "time\n")).at("time").empty());
  BOOST_TEST(refusal_of_numbers("a,b\n1,2\n\n3\n") == "t.csv:4:1: error: 1 field instead of 2\n");
  BOOST_TEST(refusal_of_numbers("a,b\n1,2,3\n") == "t.csv:2:1: error: 3 fields instead of 2\n");
  BOOST_TEST(refusal_of_numbers("a,b\n1,2 um\n") ==
             "t.csv:2:1: error: '2 um' in the column 'b' is not a number\n");
  BOOST_TEST(refusal_of_numbers("a,b\n1,1.0D-02\n") ==
             "t.csv:2:1: error: '1.0D-02' in the column 'b' is not a number; write 1.0e-02\n");
  BOOST_TEST(refusal_of_numbers("a,b\n1,\n") == "t.csv:2:1: error: '' in the column 'b' is not a number\n");
  const auto file = directory.write("inf.csv", "a,b\n1,2\n3, -inf\n");
  BOOST_TEST(read_columns(file).at("b")[1] == -std::numeric_limits<double>::infinity());
  BOOST_TEST(said_of("a,b\n\n3, -inf\n", [](const auto &table) { read_columns(table, Numbers::finite); }) ==
             "t.csv:3:1: error: '-inf' in the column 'b' is not finite\n");
  BOOST_TEST(refusal_of_numbers("a,a\n1,2\n") == "t.csv:1:1: error: there are two columns 'a'\n");
  BOOST_TEST(refusal_of_numbers("a\n\x1b[2J\n") ==
             "t.csv:2:1: error: '\\u001b[2J' in the column 'a' is not a number\n");
}
