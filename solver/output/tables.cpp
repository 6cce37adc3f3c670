#include "output/tables.hpp"
#include "base/csv.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/key_path.hpp"
#include "case/keys.hpp"
#include "case/physical.hpp"
#include "observe/outcome.hpp"
#include "observe/quantities.hpp"
#include "observe/unit_of.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <optional>

namespace capsule {
namespace {

struct Column {
  std::string head;
  double SeriesRow::*value;
  double scale = 1;
};

std::string csv_of(const std::vector<Column> &columns, const std::vector<SeriesRow> &series) {
  std::vector<std::string> fields;
  std::ranges::transform(columns, std::back_inserter(fields), &Column::head);
  std::string text = csv_row(fields);
  for (const SeriesRow &row : series) {
    std::ranges::transform(columns, fields.begin(), [&](const Column &column) {
      return number_text(row.*column.value * column.scale);
    });
    text += csv_row(fields);
  }
  return text;
}

std::vector<ReportedQuantity> reported_on_branch(const Outcome &outcome) {
  std::vector<ReportedQuantity> quantities = branch_quantities();
  std::erase_if(quantities, [&](const ReportedQuantity &quantity) {
    return !is_reported(quantity, outcome.branch.empty() ? SeriesRow{} : outcome.branch.front().row);
  });
  return quantities;
}

// A row of names and one for each point of a branch: the key, the quantities, and the growth rate. `first`, if it is not empty,
// stands before each.
class BranchTable {
public:
  explicit BranchTable(const Outcome &outcome) : quantities_(reported_on_branch(outcome)) {}

  std::string head(const std::string &along, const std::string &first = "") const {
    std::vector<std::string> fields = begin(first, along);
    std::ranges::transform(quantities_, std::back_inserter(fields), &ReportedQuantity::name);
    fields.emplace_back("growth_rate");
    return csv_row(fields);
  }
  std::string row(const BranchRow &point, const std::string &first = "") const {
    std::vector<std::string> fields = begin(first, number_text(point.parameter));
    for (const ReportedQuantity &quantity : quantities_)
      fields.push_back(number_text(point.row.*quantity.value));
    fields.push_back(number_text(point.growth_rate));
    return csv_row(fields);
  }

private:
  static std::vector<std::string> begin(const std::string &first, const std::string &second) {
    return first.empty() ? std::vector{second} : std::vector{first, second};
  }
  std::vector<ReportedQuantity> quantities_;
};

// How a quantity stands in a table in SI units: with its unit, or as a stretch; nothing of others.
std::optional<Column> physical_column(const ReportedQuantity &quantity, const Scales &scales) {
  if (has_scale(quantity.unit, scales))
    return Column{name_with_unit(quantity.name, *quantity.unit), quantity.value,
                  scales.*quantity.unit->scale};
  const bool is_stretch = !quantity.unit && std::string_view(quantity.name).ends_with("_stretch");
  return is_stretch ? std::optional(Column{quantity.name, quantity.value}) : std::nullopt;
}

} // namespace

std::string series_csv(const std::vector<SeriesRow> &series) {
  std::vector<Column> columns;
  for (const ReportedQuantity &quantity : reported_quantities())
    if (is_reported(quantity, series.empty() ? SeriesRow{} : series.front()))
      columns.push_back({quantity.name, quantity.value});
  return csv_of(columns, series);
}

bool in_physical_units(const Case &physics, const Outcome &outcome) {
  return has_physical(physics) && outcome.along.empty();
}

std::string physical_series_csv(const Case &physics, const std::vector<SeriesRow> &series) {
  const Scales scales = physical_scales(physics);
  std::vector<Column> columns;
  for (const ReportedQuantity &quantity : reported_quantities()) {
    const auto column = physical_column(quantity, scales);
    if (column && is_reported(quantity, series.empty() ? SeriesRow{} : series.front()))
      columns.push_back(*column);
  }
  return csv_of(columns, series);
}

std::string branch_csv(const Outcome &outcome) {
  const BranchTable table(outcome);
  std::string text = table.head(outcome.along);
  for (const BranchRow &point : outcome.branch)
    text += table.row(point);
  return text;
}

std::string fold_curve_csv(const Outcome &outcome) {
  const BranchTable table(outcome);
  std::string text = table.head(outcome.along, outcome.fold_along);
  for (const auto &[second, fold] : outcome.fold_curve)
    text += table.row(fold, number_text(second));
  return text;
}

std::vector<std::pair<std::string, double>> physical_values(const Case &physics, const std::string &along,
                                                            const BranchRow &point) {
  const Scales scales = scales_by_capillary_number(with_number(physics, along, point.parameter));
  std::vector<std::pair<std::string, double>> values;
  const auto add = [&](const std::string &name, const std::optional<PhysicalUnit> &unit, double value) {
    values.emplace_back(name_with_unit(name, *unit), value * scales.*unit->scale);
  };
  for (const Physical &physical : physical_of(physics, along, point.parameter))
    values.emplace_back(fmt::format("{} [{}]", physical.key, unit_text(physical.dimension)), physical.si);
  for (const ReportedQuantity &quantity : branch_quantities())
    if (const auto column = physical_column(quantity, scales); column && is_reported(quantity, point.row))
      values.emplace_back(column->head, point.row.*column->value * column->scale);
  add("growth_rate", unit_of("growth_rate"), point.growth_rate);
  return values;
}

std::string physical_branch_csv(const Case &physics, const Outcome &outcome) {
  std::string text;
  for (const BranchRow &point : outcome.branch) {
    std::vector<std::string> names{outcome.along}, fields{number_text(point.parameter)};
    for (const auto &[name, value] : physical_values(physics, outcome.along, point)) {
      names.push_back(name);
      fields.push_back(number_text(value));
    }
    text += (text.empty() ? csv_row(names) : "") + csv_row(fields);
  }
  return text;
}

std::string profiles_csv(const std::vector<Profile> &profiles) {
  std::vector<std::string> fields{"time", "x_g"};
  std::ranges::transform(profile_quantities(), std::back_inserter(fields), &ProfileQuantity::name);
  std::string text = csv_row(fields);
  for (const Profile &profile : profiles)
    for (Eigen::Index i = 0; i < profile.x.size(); ++i) {
      fields = {number_text(profile.time), number_text(profile.x_g)};
      for (const ProfileQuantity &quantity : profile_quantities())
        fields.push_back(number_text((profile.*quantity.values)[i]));
      text += csv_row(fields);
    }
  return text;
}

Profile read_last_profile(const std::filesystem::path &directory) {
  const std::filesystem::path file = directory / "profiles.csv";
  const Columns columns = read_columns(file, Numbers::finite);
  const auto values_of = [&](const char *name) -> const std::vector<double> & {
    const auto found = columns.find(name);
    if (found == columns.end())
      throw InputError(csv_error(file, 1, fmt::format("there is no column '{}'", name)));
    return found->second;
  };
  const std::vector<double> &time = values_of("time"), &x_g = values_of("x_g");
  if (time.empty())
    throw InputError(csv_error(file, 1, "no profile in it"));
  std::size_t first = time.size(); // row of the last profile
  while (first > 0 && time[first - 1] == time.back() && x_g[first - 1] == x_g.back())
    --first;
  Profile profile;
  profile.time = time.back();
  profile.x_g = x_g.back();
  for (const ProfileQuantity &quantity : profile_quantities()) {
    const std::vector<double> &values = values_of(quantity.name);
    profile.*quantity.values =
        Eigen::Map<const Vector>(values.data() + first, static_cast<Eigen::Index>(values.size() - first));
  }
  for (Eigen::Index i = 1; i < profile.S.size(); ++i)
    if (profile.S[i] <= profile.S[i - 1])
      throw InputError(csv_error(file, read_csv(file)[first + static_cast<std::size_t>(i) + 1].line,
                                 "the column 'S' does not grow from the row before"));
  return profile;
}

} // namespace capsule
