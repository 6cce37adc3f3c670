#include "compare/expression.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <numeric>
#include <string_view>
#include <system_error>

namespace capsule {
namespace {

using Arguments = std::vector<Values>;

template <class Operation>
Values elementwise(const Arguments &arguments, Operation operation) {
  const Values &a = arguments[0], &b = arguments[1];
  if (a.size() != b.size() && a.size() != 1 && b.size() != 1)
    throw NoValue("lists of different length");
  Values result(a.empty() || b.empty() ? 0 : std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = operation(a[a.size() == 1 ? 0 : i], b[b.size() == 1 ? 0 : i]);
  return result;
}

template <class Operation>
Values each(const Arguments &arguments, Operation operation) {
  Values result = arguments[0];
  std::ranges::transform(result, result.begin(), operation);
  return result;
}

// The value that comes first in an order.
template <class Order>
Values first_of(const Arguments &arguments, Order order) {
  Values all;
  for (const Values &values : arguments)
    all.insert(all.end(), values.begin(), values.end());
  if (all.empty())
    throw NoValue("no value");
  return {*std::ranges::min_element(all, order)};
}

Values mean(const Arguments &arguments) {
  const Values &a = arguments[0];
  if (a.empty())
    throw NoValue("no value");
  return {std::accumulate(a.begin(), a.end(), 0.0) / static_cast<double>(a.size())};
}

double distance_to_segment(double x, double r, double x0, double r0, double x1, double r1) {
  const double dx = x1 - x0, dr = r1 - r0;
  const double square = dx * dx + dr * dr;
  const double along = square > 0 ? std::clamp(((x - x0) * dx + (r - r0) * dr) / square, 0.0, 1.0) : 0.0;
  return std::hypot(x - x0 - along * dx, r - r0 - along * dr);
}

Values largest_distance(const Arguments &arguments) {
  const Values &x = arguments[0], &r = arguments[1], &x0 = arguments[2], &r0 = arguments[3];
  if (x.size() != r.size() || x0.size() != r0.size() || x.empty() || x0.size() < 2)
    throw NoValue("no line");
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < x0.size(); ++k)
      nearest = std::min(nearest, distance_to_segment(x[i], r[i], x0[k - 1], r0[k - 1], x0[k], r0[k]));
    largest = std::max(largest, nearest);
  }
  return {largest};
}

struct Function {
  std::size_t least, most; // number of arguments
  Values (*apply)(const Arguments &);
};

constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

const std::map<std::string, Function> &functions() {
  static const std::map<std::string, Function> table{
      {"+", {2, 2, [](const Arguments &a) { return elementwise(a, std::plus<>()); }}},
      {"-", {2, 2, [](const Arguments &a) { return elementwise(a, std::minus<>()); }}},
      {"*", {2, 2, [](const Arguments &a) { return elementwise(a, std::multiplies<>()); }}},
      {"/", {2, 2, [](const Arguments &a) { return elementwise(a, std::divides<>()); }}},
      {"^",
       {2, 2,
        [](const Arguments &a) {
          return elementwise(a, [](double x, double y) { return std::pow(x, y); });
        }}},
      {"abs", {1, 1, [](const Arguments &a) { return each(a, [](double x) { return std::abs(x); }); }}},
      {"log", {1, 1, [](const Arguments &a) { return each(a, [](double x) { return std::log(x); }); }}},
      {"max", {1, any_number, [](const Arguments &a) { return first_of(a, std::greater<>()); }}},
      {"min", {1, any_number, [](const Arguments &a) { return first_of(a, std::less<>()); }}},
      {"mean", {1, 1, mean}},
      {"distance", {4, 4, largest_distance}},
  };
  return table;
}

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

} // namespace

// A number, a reference, or a function of other nodes.
struct Expression::Node {
  double number = 0;
  std::optional<Reference> reference;
  Values (*function)(const Arguments &) = nullptr;
  std::vector<Node> arguments;

  Values values(const Lookup &lookup) const {
    if (reference)
      return lookup(*reference);
    if (function == nullptr)
      return {number};
    Arguments inner;
    for (const Node &argument : arguments)
      inner.push_back(argument.values(lookup));
    return function(inner);
  }

  void collect(std::vector<Reference> &found) const {
    if (reference)
      found.push_back(*reference);
    for (const Node &argument : arguments)
      argument.collect(found);
  }
};

// By recursive descent: sum, product, sign, power, primary.
class Expression::Parser {
public:
  explicit Parser(std::string_view text) : text_(text) {}

  Node whole() {
    Node node = sum();
    skip_spaces();
    if (at_ < text_.size())
      fail(fmt::format("unexpected '{}'", text_[at_]));
    return node;
  }

private:
  [[noreturn]] void fail(const std::string &what) const {
    throw InputError(fmt::format("{} at character {} of '{}'", what, at_ + 1, text_));
  }

  void skip_spaces() {
    while (at_ < text_.size() && text_[at_] == ' ')
      ++at_;
  }
  bool take(char c) {
    skip_spaces();
    if (at_ == text_.size() || text_[at_] != c)
      return false;
    ++at_;
    return true;
  }
  void demand(char c) {
    if (!take(c))
      fail(fmt::format("'{}' is missing", c));
  }

  Node call(const std::string &name, std::vector<Node> arguments) const {
    const auto found = functions().find(name);
    if (found == functions().end())
      fail(fmt::format("unknown function '{}'", name));
    if (arguments.size() < found->second.least || arguments.size() > found->second.most)
      fail(fmt::format("wrong number of arguments of '{}'", name));
    Node node;
    node.function = found->second.apply;
    node.arguments = std::move(arguments);
    return node;
  }

  Node sum() {
    Node left = product();
    for (;;)
      if (take('+'))
        left = call("+", {left, product()});
      else if (take('-'))
        left = call("-", {left, product()});
      else
        return left;
  }

  Node product() {
    Node left = sign();
    for (;;)
      if (take('*'))
        left = call("*", {left, sign()});
      else if (take('/'))
        left = call("/", {left, sign()});
      else
        return left;
  }

  Node sign() {
    if (take('-'))
      return call("-", {Node{}, sign()});
    Node base = primary();
    return take('^') ? call("^", {base, sign()}) : base;
  }

  Node primary() {
    skip_spaces();
    if (take('(')) {
      Node node = sum();
      demand(')');
      return node;
    }
    if (at_ < text_.size() && is_letter(text_[at_]))
      return named();
    Node node;
    node.number = number();
    return node;
  }

  Node named() {
    std::string name = word();
    if (take('#')) // of which capsule
      name += fmt::format("#{}", capsule_number());
    if (take('(')) {
      std::vector<Node> arguments{sum()};
      while (take(','))
        arguments.push_back(sum());
      demand(')');
      return call(name, std::move(arguments));
    }
    Node node;
    node.reference = Reference{name, unit(), std::nullopt, {}};
    if (take('{'))
      node.reference->runs = up_to('}');
    while (take('@'))
      node.reference->places.push_back(place());
    return node;
  }

  Place place() {
    Place place;
    place.column = word();
    place.unit = unit();
    demand('=');
    place.from = place.to = signed_number();
    if (text_.substr(at_).starts_with("..")) {
      at_ += 2;
      place.to = signed_number();
      if (!(place.to > place.from))
        fail("the second end is not beyond the first");
    }
    return place;
  }

  // What stands before a closing bracket.
  std::string up_to(char bracket) {
    const std::size_t end = text_.find(bracket, at_);
    if (end == std::string_view::npos)
      fail(fmt::format("'{}' is missing", bracket));
    std::string inside(text_.substr(at_, end - at_));
    at_ = end + 1;
    return inside;
  }

  std::string unit() {
    if (!take('['))
      return "";
    std::string unit = trimmed(up_to(']'));
    if (unit.empty())
      fail("a unit is missing");
    return unit;
  }

  std::string word() {
    skip_spaces();
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (is_letter(text_[at_]) || (at_ > begin && (is_digit(text_[at_]) || text_[at_] == '.'))))
      ++at_;
    if (at_ == begin)
      fail("a name is missing");
    return std::string(text_.substr(begin, at_ - begin));
  }

  std::size_t capsule_number() {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), number);
    if (error != std::errc{} || number < 2)
      fail("behind '#' the number of a capsule behind the leading one, 2 or more, is missing");
    at_ = static_cast<std::size_t>(end - text_.data());
    return number;
  }

  double signed_number() { return take('-') ? -number() : number(); }

  // 12, 0.5, 1e-5; stops before the two dots of a range.
  double number() {
    skip_spaces();
    const std::size_t begin = at_;
    const auto digits = [&] {
      while (at_ < text_.size() && is_digit(text_[at_]))
        ++at_;
    };
    digits();
    if (at_ < text_.size() && text_[at_] == '.' && !text_.substr(at_).starts_with("..")) {
      ++at_;
      digits();
    }
    const std::string_view rest = text_.substr(at_);
    if (at_ > begin && (rest.starts_with('e') || rest.starts_with('E'))) {
      const std::size_t sign_length = rest.size() > 1 && (rest[1] == '-' || rest[1] == '+') ? 1 : 0;
      if (rest.size() > 1 + sign_length && is_digit(rest[1 + sign_length])) {
        at_ += 1 + sign_length;
        digits();
      }
    }
    if (at_ == begin)
      fail("a number or a name is missing");
    const std::string token(text_.substr(begin, at_ - begin));
    const auto value = to_number(token);
    if (!value) {
      at_ = begin;
      fail(fmt::format("'{}' is not a number", token));
    }
    return *value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

Expression::Expression(const std::string &text) : root_(std::make_shared<const Node>(Parser(text).whole())) {}

double Expression::value(const Lookup &lookup) const {
  const Values values = root_->values(lookup);
  if (values.size() != 1)
    throw NoValue(values.empty() ? "no value" : "several values");
  return values[0];
}

std::vector<Reference> Expression::references() const {
  std::vector<Reference> found;
  root_->collect(found);
  return found;
}

} // namespace capsule
