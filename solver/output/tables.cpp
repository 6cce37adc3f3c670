#include "output/tables.hpp"
#include "base/csv.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/physical.hpp"
#include "observe/columns.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace capsule {
namespace {

std::string profiles_header() {
  std::string text = "time,x_g";
  for (const ProfileColumn &column : profile_columns)
    text += fmt::format(",{}", column.name);
  return text;
}

struct ScaledColumn {
  std::string head;
  double SeriesRow::*value;
  double scale;
};

std::string scaled_csv(const std::vector<ScaledColumn> &columns, const std::vector<SeriesRow> &series) {
  std::string text;
  for (const ScaledColumn &column : columns)
    text += fmt::format("{}{}", text.empty() ? "" : ",", column.head);
  for (const SeriesRow &row : series) {
    char separator = '\n';
    for (const ScaledColumn &column : columns) {
      text += separator + number_text(row.*column.value * column.scale);
      separator = ',';
    }
  }
  return text + "\n";
}

} // namespace

std::string series_csv(const std::vector<SeriesRow> &series) {
  std::vector<ScaledColumn> columns;
  for (const SeriesColumn &column : series_columns)
    columns.push_back({column.name, column.value, 1});
  return scaled_csv(columns, series);
}

bool in_physical_units(const Case &physics, const Outcome &outcome) {
  return has_physical(physics) && outcome.along.empty();
}

std::string physical_series_csv(const Case &physics, const std::vector<SeriesRow> &series) {
  const Scales scales = physical_scales(physics);
  std::vector<ScaledColumn> columns;
  for (const PhysicalColumn &column : physical_columns)
    if (const auto *const source =
            std::ranges::find(series_columns, std::string_view(column.name), &SeriesColumn::name);
        source != series_columns.end())
      columns.push_back(
          {fmt::format("{} [{}]", column.name, unit_text(column.of)), source->value, scales.*column.scale});
  return scaled_csv(columns, series);
}

std::string branch_csv(const Outcome &outcome) {
  std::string text = outcome.along;
  for (const SeriesColumn &column : branch_columns)
    text += fmt::format(",{}", column.name);
  text += ",growth_rate\n";
  for (const BranchRow &point : outcome.branch) {
    text += number_text(point.parameter);
    for (const SeriesColumn &column : branch_columns)
      text += ',' + number_text(point.row.*column.value);
    text += fmt::format(",{}\n", number_text(point.growth_rate));
  }
  return text;
}

std::string profiles_csv(const std::vector<Profile> &profiles) {
  std::string text = profiles_header();
  for (const Profile &profile : profiles)
    for (Eigen::Index i = 0; i < profile.x.size(); ++i) {
      text += fmt::format("\n{},{}", number_text(profile.time), number_text(profile.x_g));
      for (const ProfileColumn &column : profile_columns)
        text += ',' + number_text((profile.*column.values)[i]);
    }
  return text + "\n";
}

Profile read_last_profile(const std::filesystem::path &directory) {
  const std::filesystem::path file = directory / "profiles.csv";
  const Columns columns = read_columns(file);
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
  for (const ProfileColumn &column : profile_columns) {
    const std::vector<double> &values = values_of(column.name);
    profile.*column.values =
        Eigen::Map<const Vector>(values.data() + first, static_cast<Eigen::Index>(values.size() - first));
  }
  return profile;
}

} // namespace capsule
