#include "fit/contour.hpp"
#include "base/atomic_file.hpp"
#include "base/csv.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/case.hpp"
#include "case/physical.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <variant>

namespace capsule {
namespace {

namespace fs = std::filesystem;

constexpr Eigen::Index fewest_points = 12;

// Reads one file and says where it is wrong.
struct Reader {
  const fs::path &file;
  const Case &input;
  Contour contour = {};
  double unit = 1; // of x and r, in R_t

  [[noreturn]] void refuse(std::size_t line, const std::string &message, const std::string &hint = "") const {
    throw InputError(csv_error(file, line, message) + (hint.empty() ? "" : hint + "\n"));
  }

  // The length that one unit in the head of a column is, in R_t.
  double length_of(const std::string &name, std::size_t line) const {
    const double radius = input.physical.tube_radius.si;
    if (name.empty())
      return 1;
    if (radius == 0)
      refuse(line, fmt::format("the unit '{}' needs physical.tube_radius in the case", name),
             "columns 'x,r' without a unit are in radii of the tube");
    if (name == "px" || name == "pixel") {
      if (input.fit.pixel.si == 0)
        refuse(line, "points in pixels need fit.pixel in the case", "as fit.pixel = \"0.4 um\"");
      return input.fit.pixel.si / radius;
    }
    const auto read = read_quantity("1 " + name, dimension::length);
    if (const auto *none = std::get_if<NoQuantity>(&read))
      refuse(line, fmt::format("the unit '{}' of a column: {}", name, none->why),
             fmt::format("{}, or px with fit.pixel", examples_text(dimension::length)));
    return std::get<Quantity>(read).si / radius;
  }

  // "name [unit]" as both.
  static std::pair<std::string, std::string> parted(const std::string &head) {
    const std::size_t open = head.find('[');
    if (open == std::string::npos || !head.ends_with(']'))
      return {trimmed(head), ""};
    return {trimmed(head.substr(0, open)), trimmed(head.substr(open + 1, head.size() - open - 2))};
  }

  // A number alone, or with its unit where the case is in physical units.
  double value_of(const CsvRow &row, const std::string &name, const std::string &text,
                  const Dimension &dimension) const {
    double value = 0;
    const auto number = to_number(text);
    if (!has_physical(input)) {
      if (!number)
        refuse(row.line, fmt::format("{}: {}", name, not_a_number(text)),
               "a value with its unit needs [physical] in the case");
      value = *number;
    } else {
      if (number)
        refuse(row.line, fmt::format("{} = {} has no unit", name, text), examples_text(dimension));
      const auto read = read_quantity(text, dimension);
      if (const auto *none = std::get_if<NoQuantity>(&read))
        refuse(row.line, fmt::format("{}: {}", name, none->why), examples_text(dimension));
      value = std::get<Quantity>(read).si;
    }
    if (!(value > 0) || !std::isfinite(value))
      refuse(row.line, fmt::format("{} must be a number above 0", name));
    return value;
  }

  // "# name = value"; any other comment means nothing.
  void take_comment(const CsvRow &row) {
    const std::string text = trimmed(trimmed(row.fields[0]).substr(1));
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      return;
    const std::string name = trimmed(text.substr(0, equals)), value = trimmed(text.substr(equals + 1));
    if (name == "velocity")
      contour.velocity = value_of(row, name, value, dimension::velocity);
    else if (name == "flow_rate")
      contour.flow_rate = value_of(row, name, value, dimension::flow_rate);
    else if (name == "rear_pole_x") {
      const auto number = to_number(value);
      if (!number || !std::isfinite(*number))
        refuse(row.line, fmt::format("{}: {}", name, not_a_number(value)), "it has the unit of the points");
      contour.rear_pole_x = *number;
    }
  }

  void take_points(const std::vector<CsvRow> &rows) {
    if (rows.empty())
      refuse(1, "no points in it", "a contour begins with the names of its columns, as 'x [um],r [um]'");
    std::map<std::string, std::size_t> columns;
    std::string x_unit, r_unit;
    for (std::size_t k = 0; k < rows[0].fields.size(); ++k) {
      const auto [name, its_unit] = parted(rows[0].fields[k]);
      columns[name] = k;
      if (name == "x")
        x_unit = its_unit;
      else if (name == "r")
        r_unit = its_unit;
    }
    if (!columns.contains("x") || !columns.contains("r"))
      refuse(rows[0].line, fmt::format("there is no column '{}'", columns.contains("x") ? "r" : "x"),
             "a contour has columns x, along the axis, and r, from the axis, as 'x [um],r [um]'");
    if (x_unit != r_unit)
      refuse(rows[0].line, fmt::format("x is in '{}', r in '{}'", x_unit, r_unit), "give both one unit");
    unit = length_of(x_unit, rows[0].line);
    const auto points = std::ssize(rows) - 1;
    if (points < fewest_points)
      refuse(rows[0].line,
             fmt::format("{} {} too few for a contour", counted(static_cast<std::size_t>(points), "point"),
                         points == 1 ? "is" : "are"),
             fmt::format("at least {} are needed, and some hundred are usual", fewest_points));
    contour.x.resize(points);
    contour.r.resize(points);
    for (Eigen::Index i = 0; i < points; ++i) {
      const CsvRow &row = rows[static_cast<std::size_t>(i) + 1];
      contour.x[i] = coordinate(row, "x", columns["x"]);
      const double r = coordinate(row, "r", columns["r"]);
      contour.r[i] = std::abs(r);
      contour.lower.push_back(r < 0);
      if (contour.r[i] >= 1)
        refuse(row.line, fmt::format("the point lies outside the tube: r = {:.4g} R_t", contour.r[i]),
               x_unit.empty()
                   ? "r counts from the axis, in radii of the tube unless the head says the unit, as "
                     "'x [um],r [um]'"
                   : "r counts from the axis; are the columns x and r in this order?");
    }
  }

  double coordinate(const CsvRow &row, const char *name, std::size_t column) const {
    const std::string text = column < row.fields.size() ? trimmed(row.fields[column]) : "";
    const auto number = to_number(text);
    if (!number)
      refuse(row.line, not_a_number(text, fmt::format(" in the column '{}'", name)));
    if (!std::isfinite(*number))
      refuse(row.line, fmt::format("'{}' in the column '{}' is not finite", text, name));
    return *number * unit;
  }

  // Both ends must come to the axis, and the body must have a size.
  void check_shape(std::size_t line) const {
    const double widest = contour.r.maxCoeff(), rear = contour.x.minCoeff(), front = contour.x.maxCoeff();
    if (!(front - rear > 0.1 * widest) || widest < 1e-3)
      refuse(line,
             fmt::format("no capsule: the points are {:.3g} R_t long and {:.3g} R_t from the axis at most",
                         front - rear, widest));
    const double middle = (front + rear) / 2;
    bool in_front = false, behind = false;
    for (Eigen::Index i = 0; i < contour.x.size(); ++i)
      if (contour.r[i] < 0.3 * widest)
        (contour.x[i] > middle ? in_front : behind) = true;
    if (!in_front || !behind)
      refuse(
          line, fmt::format("no capsule: no point near the axis {}", in_front ? "behind" : "in front"),
          "x runs along the axis with the flow and r counts from the axis; are the columns x and r in this "
          "order?");
  }
};

} // namespace

Contour read_contour(const fs::path &file, const Case &input) {
  Reader reader{file, input};
  std::vector<CsvRow> rows = read_csv(file, '#');
  std::vector<CsvRow> points;
  for (const CsvRow &row : rows)
    if (trimmed(row.fields[0]).starts_with('#'))
      reader.take_comment(row);
    else
      points.push_back(row);
  reader.take_points(points);
  reader.check_shape(points[0].line);
  if (reader.contour.rear_pole_x)
    *reader.contour.rear_pole_x *= reader.unit;
  reader.contour.file = file;
  return reader.contour;
}

ContourSize size_of(const Contour &contour) {
  const double widest = contour.r.maxCoeff(), front = contour.x.maxCoeff();
  double rear = front; // on the axis
  for (Eigen::Index i = 0; i < contour.x.size(); ++i)
    if (contour.r[i] < 0.3 * widest)
      rear = std::min(rear, contour.x[i]);
  const double inside = (front + rear) / 2;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(contour.x.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {},
                    [&](Eigen::Index i) { return std::atan2(contour.r[i], inside - contour.x[i]); });
  double cubes = 0; // of the volume over pi
  for (std::size_t k = 1; k < order.size(); ++k) {
    const double r0 = contour.r[order[k - 1]], r1 = contour.r[order[k]];
    cubes += (contour.x[order[k]] - contour.x[order[k - 1]]) * (r0 * r0 + r0 * r1 + r1 * r1) / 3;
  }
  return {std::cbrt(0.75 * std::abs(cubes)), front};
}

} // namespace capsule
