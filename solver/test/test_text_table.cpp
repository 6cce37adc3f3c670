// Tables of words in their three forms.
#include "compare/text_table.hpp"
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
