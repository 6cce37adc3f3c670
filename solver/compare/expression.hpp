#pragma once
// The expressions of tables/published.csv: arithmetic on the values of runs.
//   numbers, + - * / ^, parentheses
//   abs(a), log(a)
//   max(a, ...), min(a, ...) largest and smallest of all values
//   mean(a)                  of a list
//   distance(x, r, x0, r0)   largest distance of the points (x, r) from the line through the points (x0, r0)
//   name                     a value of the run with which the row is compared
//   name{runs}               of other runs: "law=skalak; viscosity_ratio=0.2|1|5", "another-case: radius=0.9",
//                            "another-case:"
//   name@column=a            where a column passes a for the first time; linear between the rows
//   name@column=a..b         all values from a to b, ends included
//   name@x_g=1@S=0           in the profile at x_g = 1, where S = 0
//   name [unit]              in a unit, as in name#2 [Pa]{runs}@x_g [um]=-5..5
// Every value is a list, most often of one number. An operation takes lists of equal length, or one number and a list.
// The caller says what a name means (run_values.hpp).
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace capsule {

struct Place {
  std::string column;
  std::string unit; // empty: none
  double from = 0;
  double to = 0; // equal to `from`: one place
};
struct Reference {
  std::string name;
  std::string unit;                // empty: none
  std::optional<std::string> runs; // what stands between the braces
  std::vector<Place> places;
};

using Values = std::vector<double>;
using Lookup = std::function<Values(const Reference &)>;

// There is nothing to compute with. The text is short: "no such run", "no value".
struct NoValue : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Expression {
public:
  // Throws InputError with one line that says what is wrong.
  explicit Expression(const std::string &text);

  // Its one number. Throws NoValue if there is none, or several.
  double value(const Lookup &lookup) const;
  // In the order in which they are looked up.
  std::vector<Reference> references() const;

private:
  struct Node;
  class Parser;
  std::shared_ptr<const Node> root_;
};

} // namespace capsule
