#pragma once
// What the names of an expression (expression.hpp) mean in a run:
//   a quantity of summary.json             pressure_drop, peak_pressure_drop
//   its estimated error                    error_estimate.pressure_drop, error_estimate.v_g@x_g=0
//   a key of the case                      capsule.radius, or radius; physical.viscosity in SI units
//   a column of series.csv at a place      x_g@time=18.7, min_film@x_g=-4..4
//   a column of profiles.csv               r, tension_meridional@x_g=1@S=0
//     of the last profile, or of that at a time or x_g; all its points, or those at a place S
// Each of these that has a unit, and each place, may stand in any unit of its kind, if the case is in physical units:
// "pressure_drop [Pa]", "min_film [um]@x_g [um]=-20..20", "physical.viscosity [mPa.s]".
// Throws FileError and, of a table that cannot be used, InputError; NoValue ("no such run", "no value", with the name that
// was probably meant) where there is nothing.
#include "base/csv.hpp"
#include "compare/expression.hpp"
#include "output/run_result.hpp"
#include <map>
#include <utility>

namespace capsule {

// Chooses runs by the values of their keys: "viscosity_ratio=0.2|1; law=skalak".
class Selector {
public:
  // Throws InputError with one line that says what is wrong.
  explicit Selector(const std::string &text);
  bool selects(const Case &physics) const;

private:
  std::vector<std::pair<std::string, std::vector<std::string>>> wanted_;
};

// The runs of several cases. Files are read when first asked for.
class RunTable {
public:
  void add(const std::string &case_name, const std::vector<RunResult> &runs);
  bool has(const std::string &case_name) const { return runs_.contains(case_name); }
  std::vector<std::string> cases() const;
  const std::vector<RunResult> &runs_of(const std::string &case_name) const;

  // The values of a reference in a row about this case and, unless the reference names its runs itself, about this run.
  Values values(const Reference &reference, const std::string &case_name, const RunResult *run) const;

  // A bound of the error of an expression: the changes that the estimated errors of its values make in it, added up.
  // None if one of the values has no estimate, or the expression has no value.
  std::optional<double> error_estimate(const Expression &expression, const std::string &case_name,
                                       const RunResult *run) const;

private:
  // series.csv and profiles.csv of a capsule.
  struct Tables {
    std::filesystem::path series, profiles;
  };

  Values values_in(const RunResult &run, const Reference &reference) const;
  std::vector<const RunResult *> selected(const Reference &reference, const std::string &case_name,
                                          const RunResult *run) const;
  const Columns &columns(const std::filesystem::path &file) const;
  // Whether there is such a file with such a column; a study leaves its summary only.
  bool has_column(const std::filesystem::path &file, const std::string &name) const;
  // Of a reference without units.
  Values dimensionless(const RunResult &run, const Reference &reference) const;
  // Names under which the run may have something; those of its end and input only where no place is asked for.
  std::vector<std::string> names(const RunResult &run, const Reference &reference,
                                 const Tables &tables) const;

  std::map<std::string, std::vector<RunResult>> runs_;
  mutable std::map<std::filesystem::path, Columns> files_; // read so far
};

// The two parts of what stands between a reference's braces, "another-case: radius=0.9": the case, if there is one, and
// the selector.
std::optional<std::string> case_of(const Reference &reference);
std::string runs_of(const Reference &reference);

} // namespace capsule
