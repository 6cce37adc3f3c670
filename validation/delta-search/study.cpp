// Which bending stiffness keeps the membrane of each of the paper's runs from buckling, and what does each published
// number owe to it? Every run of the cases below is repeated with stiffnesses of whole decades on two meshes.
#include "study.hpp"
#include "case/identity.hpp"
#include "compare/expectations.hpp"
#include "compare/run_values.hpp"
#include "scene/resolution.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <set>

using namespace capsule;

namespace {

const std::vector<std::string> cases{"table1-mesh",
                                     "fig03-bending",
                                     "fig07-viscosity-sphere",
                                     "fig09-size",
                                     "fig10-viscosity-ellipsoid",
                                     "fig12-law-sphere",
                                     "fig16-law-ellipsoid",
                                     "fig17-stretch",
                                     "fig19-runaway"};
const std::vector<double> decades{1e-6, 1e-5, 1e-4, 1e-3};
constexpr double accuracy = 1e-3;
constexpr double refinement = 1.5;

// A run of a case with another stiffness and mesh.
struct Trial {
  std::string of;       // the case's name and the run's
  std::string identity; // of the physics without the stiffness
  double stiffness;
  bool fine;
  std::size_t index; // of the computed run
};

// The physics alone: everything that only tells where to look or how finely is set here.
Case stripped(Case physics) {
  physics.accuracy = accuracy;
  physics.mesh = {};
  physics.time.tolerance = 0;
  physics.output = {};
  physics.title = physics.paper = "";
  physics.membrane.bending_ratio = 0;
  return physics;
}

class Search {
public:
  Search() {
    for (const std::string &name : cases)
      for (const RunInput &run : read_case("cases/" + name).runs)
        add(name, run);
  }

  void compute(const std::string &directory, unsigned jobs) { runs_ = run_all(directory, jobs, inputs_); }

  const std::vector<Trial> &trials() const { return trials_; }
  const StudyRun &result(const Trial &trial) const { return runs_.at(trial.index); }
  // Whether a row of tables/published.csv speaks of the trial's run, whatever its stiffness.
  bool is_of(const Trial &trial, const Expectation &row) const {
    return cases_.at(trial.identity).contains(row.case_name) &&
           Selector(row.run).selects(inputs_.at(trial.index).physics);
  }

private:
  void add(const std::string &case_name, const RunInput &run) {
    const Case physics = stripped(run.physics);
    const std::string of = case_name + (run.name.empty() ? "" : " " + run.name);
    const std::string identity = run_identity(physics);
    cases_[identity].insert(case_name);
    if (std::ranges::find(trials_, identity, &Trial::identity) != trials_.end())
      return;
    const bool whole = physics.flow.viscosity_ratio == 1; // the steady state is the same for all others
    for (const double stiffness : decades)
      for (const bool fine : {false, true})
        if (whole || (!fine && stiffness < 1e-3))
          trials_.push_back({of, identity, stiffness, fine, input_of(physics, stiffness, fine)});
  }

  std::size_t input_of(Case physics, double stiffness, bool fine) {
    physics.membrane.bending_ratio = stiffness;
    const int nodes = choose_resolution(physics).membrane_nodes;
    physics.mesh.membrane = fine ? static_cast<int>(refinement * nodes) : nodes;
    inputs_.push_back({fmt::format("{}", inputs_.size() + 1), physics});
    return inputs_.size() - 1;
  }

  std::map<std::string, std::set<std::string>> cases_; // that have a run of this identity
  std::vector<Trial> trials_;
  std::vector<RunInput> inputs_;
  std::vector<StudyRun> runs_;
};

std::string status_of(const StudyRun &run) {
  return run.summary.failure.empty() || run.summary.status == run.summary.failure ? run.summary.status
                                                                                  : run.summary.failure;
}

double end_of(const StudyRun &run, const std::string &quantity) {
  const auto found = run.summary.quantities.find(quantity);
  return found == run.summary.quantities.end() ? NAN : found->second;
}

double largest(const StudyRun &run, const std::string &column) {
  return std::ranges::max(run.history.at(column));
}

// Whether no buckle, resolved or not, has come on the way: a parachute has one dent at its rear, the rim of an
// ellipsoid another.
bool is_smooth(const StudyRun &run) {
  return (run.summary.status == word_of(Status::reached) ||
          run.summary.status == word_of(Status::unbounded)) &&
         largest(run, "dents") < 3;
}
bool passes(const StudyRun &run) {
  return run.summary.status == word_of(Status::reached) || run.summary.status == word_of(Status::unbounded);
}

void write_search(const Search &search, const std::string &directory) {
  Table table("run,bending_ratio,nodes,status,dents,roughness,pressure_drop,error,v_g,peak_pressure_drop,"
              "front_stretch,max_stretch,min_film");
  for (const Trial &trial : search.trials()) {
    const StudyRun &run = search.result(trial);
    const auto error = run.summary.error_estimate.find("pressure_drop");
    std::string name = trial.of;
    std::ranges::replace(name, ',', ';');
    table.add(
        fmt::format("{},{:g},{},{},{:g},{:.2f},{:.4f},{},{:.5f},{:.3f},{:.4f},{:.4f},{:.4f}", name,
                    trial.stiffness, trial.fine ? "fine" : "coarse", status_of(run), largest(run, "dents"),
                    largest(run, "roughness"), end_of(run, "pressure_drop"),
                    error == run.summary.error_estimate.end() ? "" : fmt::format("{:.1g}", error->second),
                    end_of(run, "v_g"), end_of(run, "peak_pressure_drop"), end_of(run, "front_stretch"),
                    end_of(run, "max_stretch"), end_of(run, "min_film")));
  }
  table.write(directory + "/search.csv");
}

// The smallest decade from which on a property holds on both meshes; 0 if it never does.
template <class Property>
double smallest(const Search &search, const std::string &of, Property property) {
  double found = 0;
  for (const double stiffness : decades) {
    const bool holds = std::ranges::all_of(search.trials(), [&](const Trial &trial) {
      return trial.of != of || trial.stiffness != stiffness || property(search.result(trial));
    });
    found = !holds ? 0 : found == 0 ? stiffness : found;
  }
  return found;
}

void write_smallest(const Search &search, const std::string &directory) {
  Table table("run,passes from,smooth from");
  std::string before;
  for (const Trial &trial : search.trials())
    if (trial.of != before) {
      before = trial.of;
      std::string name = trial.of;
      std::ranges::replace(name, ',', ';');
      table.add(fmt::format("{},{:g},{:g}", name, smallest(search, trial.of, passes),
                            smallest(search, trial.of, is_smooth)));
    }
  table.write(directory + "/smallest.csv");
}

// Each published number that a run's summary has, at every stiffness with which the membrane passes.
void write_sensitivity(const Search &search, const std::string &directory) {
  Table table(fmt::format("id,quantity,published,{:g}", fmt::join(decades, ",")));
  for (const Expectation &row : read_expectations("tables/published.csv")) {
    const bool of_the_paper = row.kind == "number" || row.claim.empty();
    if (!of_the_paper || row.form != Expectation::Form::value)
      continue;
    std::vector<std::string> cells(3 + decades.size());
    cells[0] = row.id;
    cells[1] = row.quantity;
    cells[2] = row.published;
    bool any = false;
    for (const Trial &trial : search.trials()) {
      const double value = end_of(search.result(trial), row.quantity);
      if (trial.fine || !passes(search.result(trial)) || !search.is_of(trial, row) || !std::isfinite(value))
        continue;
      const auto column = std::ranges::find(decades, trial.stiffness) - decades.begin();
      cells[3 + static_cast<std::size_t>(column)] = fmt::format("{:.6g}", value);
      any = true;
    }
    if (any)
      table.add(fmt::format("{}", fmt::join(cells, ",")));
  }
  table.write(directory + "/sensitivity.csv");
}

bool study(const std::string &directory, unsigned jobs) {
  Search search;
  search.compute(directory, jobs);
  write_search(search, directory);
  write_smallest(search, directory);
  write_sensitivity(search, directory);
  return check(smallest(search, "fig03-bending bending_ratio=0", passes) == 1e-5,
               "1e-5 is the smallest decade with which Figure 3's membrane passes");
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
