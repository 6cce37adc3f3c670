// Tables of words in their three forms, and as files.
#include "base/atomic_file.hpp"
#include "base/failure.hpp"
#include "compare/text_table.hpp"
#include "temporary_directory.hpp"
#include <boost/test/unit_test.hpp>

using namespace capsule;

namespace {

const std::string longer(41, 'x');
const std::vector<TextRow> rows{{"id", "where", "verdict"}, {"a", "T, U", "agrees"}, {longer, "", "\"b|c\""}};

} // namespace

// A long entry moves the rest of its own row alone.
BOOST_AUTO_TEST_CASE(in_columns) {
  BOOST_TEST(text_table(rows) == "id  where  verdict\na   T, U   agrees\n" + longer + "         \"b|c\"\n");
}

BOOST_AUTO_TEST_CASE(as_csv) {
  BOOST_TEST(csv_table(rows) == "id,where,verdict\na,\"T, U\",agrees\n" + longer + ",,\"\"\"b|c\"\"\"\n");
}

BOOST_AUTO_TEST_CASE(as_markdown) {
  BOOST_TEST(markdown_table(rows) ==
             "| id | where | verdict |\n| --- | --- | --- |\n| a | T, U | agrees |\n| " + longer +
                 " |  | \"b\\|c\" |\n");
}

// Of negative numbers, in Markdown: not of words with hyphens, nor of ranges and powers.
BOOST_AUTO_TEST_CASE(minus_signs) {
  BOOST_TEST(markdown_table({{"-1"}, {"-0.5 %"}, {"(-2)"}, {"x-1, 1e-6, a=-4..-2, - 3, -b"}}) ==
             "| −1 |\n| --- |\n| −0.5 % |\n| (−2) |\n| x-1, 1e-6, a=-4..-2, - 3, -b |\n");
}

// One of other columns is the user's; one whose columns are called otherwise is an earlier version's.
BOOST_AUTO_TEST_CASE(a_table_takes_the_place_of_one_like_it) {
  const TemporaryDirectory directory;
  const auto file = directory.write("table.csv", "id,published\n");
  write_table(file, "id,expected\n");
  BOOST_TEST(read_file(file) == "id,expected\n");
  for (const char *other : {"id\n", "name,expected\n", "id,expected,distance\n"})
    BOOST_CHECK_THROW(write_table(file, other), InputError);
}
