#include "compare/run_values.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/key_path.hpp"
#include "case/keys.hpp"
#include "case/symbols.hpp"
#include "case/value_lists.hpp"
#include "compare/reference_units.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

namespace capsule {
namespace {

namespace fs = std::filesystem;

// Profiles are written at the places that were asked for. Places nearer to each other than this are the same.
constexpr double same_place = 1e-6;

std::vector<std::string> split(const std::string &text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);)
    parts.push_back(trimmed(part));
  return parts;
}

// A physical quantity may be given in any unit, as in the names of runs ("5uL_per_min"), or as a number in SI units.
bool has_value(const Case &physics, const Key &key, const std::string &text) {
  if (const auto *measured = std::get_if<Measured>(&key.field)) {
    std::string typed = text;
    std::ranges::replace(typed, '_', ' ');
    const auto read = read_quantity(typed, measured->dimension);
    const auto *quantity = std::get_if<Quantity>(&read);
    const auto si = quantity != nullptr ? quantity->si : to_number(text);
    return si && *si == measured->member.of(physics).si;
  }
  const auto value = value_of(key, physics);
  if (!value)
    return false;
  if (std::holds_alternative<std::string>(*value) || entries_of(*value).size() > 1)
    return plain_text(*value) == text;
  return to_number(value_text(*value)) == to_number(text);
}

std::optional<double> key_value(const std::string &name, const Case &physics) {
  const Key *key = key_named(name);
  if (const auto *measured = key != nullptr ? std::get_if<Measured>(&key->field) : nullptr) {
    const double si = measured->member.of(physics).si;
    return si > 0 ? std::optional(si) : std::nullopt; // 0: not given
  }
  return key != nullptr ? number(*key, physics) : std::nullopt;
}

// Nothing has this name; or what has it is no number.
NoValue no_value(const std::string &name, const std::vector<std::string> &known) {
  if (std::ranges::find(known, name) != known.end())
    return NoValue("no value");
  const std::string near = nearest_word(name, known);
  return NoValue(
      fmt::format("no value '{}'{}", name, near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

std::vector<std::string> names_of(const Columns &columns) {
  std::vector<std::string> names;
  for (const auto &[name, values] : columns)
    names.push_back(name);
  return names;
}

const Values &column(const Columns &columns, const std::string &name) {
  const auto found = columns.find(name);
  if (found == columns.end())
    throw no_value(name, names_of(columns));
  return found->second;
}

// y where x passes a value for the first time; linear between the rows.
double value_at(const Values &y, const Values &x, double at) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] == at)
      return y[i];
    if (i > 0 && (x[i - 1] < at) != (x[i] < at))
      return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
  }
  throw NoValue("no value");
}

// y where x lies in a place. A range is cut off at the ends of x.
Values values_at(const Values &y, const Values &x, const Place &place) {
  if (place.from == place.to)
    return {value_at(y, x, place.from)};
  const double end_of_grid = 1e-9; // rounding of the rows' places: an end must not count twice
  Values values;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i] > place.from + end_of_grid && x[i] < place.to - end_of_grid)
      values.push_back(y[i]);
  for (const double end : {place.from, place.to})
    if (const auto [low, high] = std::ranges::minmax(x); low <= end && end <= high)
      values.push_back(value_at(y, x, end));
  return values;
}

Values part(const Values &values, const std::vector<std::size_t> &rows) {
  Values result;
  for (const std::size_t row : rows)
    result.push_back(values[row]);
  return result;
}

// The rows of the profile at a time or x_g, or of the last one.
std::vector<std::size_t> profile_rows(const Columns &profiles, const std::optional<Place> &place) {
  const Values &along = column(profiles, place ? place->column : "time");
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < along.size(); ++i)
    if (std::abs(along[i] - (place ? place->from : along.back())) < same_place)
      rows.push_back(i);
  if (rows.empty())
    throw NoValue("no value");
  return rows;
}

// The estimated error of what a reference names; none if nothing is known of it.
std::optional<double> estimated_error(const RunResult &run, const std::string &name,
                                      const Reference &reference) {
  const std::string place = reference.places.empty() ? "" : '@' + reference.places[0].column;
  const auto found = run.summary->error_estimate.find(name + place);
  if (found == run.summary->error_estimate.end())
    return std::nullopt;
  return found->second * in_unit(run, name, reference.unit);
}

Values profile_values(const Columns &profiles, const Reference &reference) {
  std::optional<Place> along, on_meridian;
  for (const Place &place : reference.places)
    (place.column == "time" || place.column == "x_g" ? along : on_meridian) = place;
  const std::vector<std::size_t> rows = profile_rows(profiles, along);
  const Values values = part(column(profiles, reference.name), rows);
  return on_meridian ? values_at(values, part(column(profiles, on_meridian->column), rows), *on_meridian)
                     : values;
}

std::string unknown_key(const std::string &name) {
  const std::string near = nearest_key(name);
  return fmt::format("unknown key '{}'{}", name,
                     near.empty() ? "" : fmt::format("; did you mean '{}'?", near));
}

} // namespace

Selector::Selector(const std::string &text) {
  if (trimmed(text).empty())
    return;
  for (const std::string &part : split(text, ';')) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos)
      throw InputError(fmt::format("the run '{}' is not of the form key=value", text));
    const std::string key = trimmed(part.substr(0, equals));
    if (key_named(key) == nullptr)
      throw InputError(unknown_key(key));
    wanted_.emplace_back(key, split(part.substr(equals + 1), '|'));
  }
}

bool Selector::selects(const Case &physics) const {
  return std::ranges::all_of(wanted_, [&](const auto &wanted) {
    const Key &key = *key_named(wanted.first);
    return std::ranges::any_of(wanted.second,
                               [&](const std::string &text) { return has_value(physics, key, text); });
  });
}

std::optional<std::string> case_of(const Reference &reference) {
  const std::size_t colon = reference.runs ? reference.runs->find(':') : std::string::npos;
  return colon == std::string::npos ? std::nullopt : std::optional(trimmed(reference.runs->substr(0, colon)));
}

std::string runs_of(const Reference &reference) {
  const std::string &text = reference.runs.value();
  const std::size_t colon = text.find(':');
  return colon == std::string::npos ? text : text.substr(colon + 1);
}

void RunTable::add(const std::string &case_name, const std::vector<RunResult> &runs) {
  runs_[case_name] = runs;
}

std::vector<std::string> RunTable::cases() const {
  std::vector<std::string> names;
  for (const auto &[name, runs] : runs_)
    names.push_back(name);
  return names;
}

const std::vector<RunResult> &RunTable::runs_of(const std::string &case_name) const {
  static const std::vector<RunResult> none;
  const auto found = runs_.find(case_name);
  return found == runs_.end() ? none : found->second;
}

std::vector<const RunResult *> RunTable::selected(const Reference &reference, const std::string &case_name,
                                                  const RunResult *run) const {
  std::vector<const RunResult *> found;
  if (!reference.runs) {
    if (run != nullptr)
      found.push_back(run);
  } else {
    const Selector selector(capsule::runs_of(reference));
    for (const RunResult &candidate : runs_of(case_of(reference).value_or(case_name)))
      if (selector.selects(candidate.input.physics))
        found.push_back(&candidate);
  }
  if (found.empty())
    throw NoValue("no such run");
  return found;
}

const Columns &RunTable::columns(const fs::path &file) const {
  const auto known = files_.find(file);
  return known != files_.end() ? known->second : files_.emplace(file, read_columns(file)).first->second;
}

bool RunTable::has_column(const fs::path &file, const std::string &name) const {
  std::error_code ignored;
  return fs::exists(file, ignored) && columns(file).contains(name);
}

std::vector<std::string> RunTable::names(const RunResult &run, const Reference &reference,
                                         const Tables &tables) const {
  std::vector<std::string> all;
  for (const fs::path &file : {tables.series, tables.profiles})
    if (std::error_code ignored; fs::exists(file, ignored))
      std::ranges::move(names_of(columns(file)), std::back_inserter(all));
  if (!reference.places.empty())
    return all;
  for (const auto &[name, value] : run.summary->quantities)
    all.push_back(name);
  for (const Key &key : keys())
    for (const std::string_view name : {std::string_view(key.name), short_name(key)})
      all.emplace_back(name);
  return all;
}

Values RunTable::values_in(const RunResult &run, const Reference &reference) const {
  Reference without_units{reference.name, {}, {}, {}};
  for (const Place &place : reference.places) {
    const double factor = in_unit(run, place.column, place.unit);
    without_units.places.push_back({place.column, {}, place.from / factor, place.to / factor});
  }
  Values values = dimensionless(run, without_units);
  const double factor = in_unit(run, reference.name, reference.unit);
  for (double &value : values)
    value *= factor;
  return values;
}

// "x_g#2" is x_g of the second capsule, whose tables are series-2.csv and profiles-2.csv; of the leading one they have no
// number.
Values RunTable::dimensionless(const RunResult &run, const Reference &reference) const {
  if (reference.name.starts_with(of_errors))
    if (const auto error = estimated_error(run, reference.name.substr(of_errors.size()), reference))
      return {*error};
  const std::size_t mark = reference.name.find('#');
  const std::string quantity = reference.name.substr(0, mark);
  const std::string number = mark == std::string::npos ? "" : reference.name.substr(mark + 1);
  const std::size_t capsules = 1 + run.input.physics.followers.size();
  if (!number.empty() && std::stoul(number) > capsules)
    throw NoValue(fmt::format("the run has {}", counted(capsules, "capsule")));
  const auto table = [&](const char *name) {
    return run.directory / fmt::format("{}{}.csv", name, number.empty() ? "" : "-" + number);
  };
  const Tables tables{table("series"), table("profiles")};
  if (reference.places.empty()) {
    const auto found = run.summary->quantities.find(reference.name);
    if (found != run.summary->quantities.end())
      return {found->second};
    if (const auto value = key_value(reference.name, run.input.physics))
      return {*value};
  } else if (has_column(tables.series, quantity)) {
    if (reference.places.size() > 1)
      throw NoValue("no value");
    const Columns &series = columns(tables.series);
    // Places are the leading capsule's, whose rows are of the same times.
    return values_at(column(series, quantity),
                     column(columns(run.directory / "series.csv"), reference.places[0].column),
                     reference.places[0]);
  }
  if (!has_column(tables.profiles, quantity))
    throw no_value(quantity, names(run, reference, tables));
  return profile_values(columns(tables.profiles), {quantity, {}, {}, reference.places});
}

Values RunTable::values(const Reference &reference, const std::string &case_name,
                        const RunResult *run) const {
  Values values;
  for (const RunResult *one : selected(reference, case_name, run)) {
    const Values more = values_in(*one, reference);
    values.insert(values.end(), more.begin(), more.end());
  }
  return values;
}

std::optional<double> RunTable::error_estimate(const Expression &expression, const std::string &case_name,
                                               const RunResult *run) const {
  // The values of one reference in one run, off by their error.
  struct Off {
    std::size_t reference; // its index, in the order of evaluation
    const RunResult *run;
    double error;
  };
  const std::vector<Reference> references = expression.references();
  std::vector<Off> all;
  try {
    for (std::size_t i = 0; i < references.size(); ++i)
      for (const RunResult *one : selected(references[i], case_name, run)) {
        const Reference &reference = references[i];
        if (const auto error = estimated_error(*one, reference.name, reference))
          all.push_back({i, one, *error});
        else if (!reference.places.empty() || !key_value(reference.name, one->input.physics))
          return std::nullopt;
      }
    const auto value_with = [&](const Off *off) {
      std::size_t count = 0;
      return expression.value([&](const Reference &reference) {
        const std::size_t here = count++;
        Values values;
        for (const RunResult *one : selected(reference, case_name, run))
          for (const double value : values_in(*one, reference))
            values.push_back(off != nullptr && off->reference == here && off->run == one ? value + off->error
                                                                                         : value);
        return values;
      });
    };
    const double value = value_with(nullptr);
    double sum = 0;
    for (const Off &off : all)
      sum += std::abs(value_with(&off) - value);
    return sum;
  } catch (const NoValue &) {
    return std::nullopt;
  }
}

} // namespace capsule
