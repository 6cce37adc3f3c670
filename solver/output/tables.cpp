#include "output/tables.hpp"
#include "base/atomic_file.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/physical.hpp"
#include "observe/columns.hpp"
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>

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
  errno = 0;
  std::ifstream stream(file);
  std::string header, line;
  if (!std::getline(stream, header))
    fail_at("cannot read", file, errno != 0 ? errno : ENODATA);
  if (header != profiles_header())
    throw FileError(fmt::format("cannot use '{}': its columns are not those of a profile", file.string()));
  constexpr std::size_t columns = 2 + profile_columns.size();
  std::vector<std::array<double, columns>> rows;
  while (std::getline(stream, line)) {
    std::array<double, columns> row{};
    const char *next = line.c_str();
    for (double &value : row) {
      char *end = nullptr;
      value = std::strtod(next, &end);
      if (end == next)
        throw FileError(fmt::format("cannot use '{}': '{}' is no row of a profile", file.string(), line));
      next = *end == ',' ? end + 1 : end;
    }
    if (!rows.empty() && (rows.back()[0] != row[0] || rows.back()[1] != row[1])) // of an earlier profile
      rows.clear();
    rows.push_back(row);
  }
  if (rows.empty())
    throw FileError(fmt::format("cannot use '{}': no profile in it", file.string()));
  Profile profile;
  profile.time = rows.back()[0];
  profile.x_g = rows.back()[1];
  for (std::size_t k = 0; k < profile_columns.size(); ++k) {
    Vector &values = profile.*profile_columns.at(k).values;
    values.resize(std::ssize(rows));
    for (std::size_t i = 0; i < rows.size(); ++i)
      values[static_cast<Eigen::Index>(i)] = rows[i].at(k + 2);
  }
  return profile;
}

} // namespace capsule
