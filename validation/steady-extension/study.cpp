// Spheres in an unbounded uniaxial extension: deformation against capillary number for both laws, its slope from the
// theory of small deformations, and where steady states end.
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "steady/branch.hpp"
#include "steady/mesh_change.hpp"
#include "steady/steady_state.hpp"
#include "steady_folds.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

using namespace capsule;

namespace {

constexpr const char *flow_key = "flow.capillary_number";
constexpr double weakest = 0.02, strongest = 2; // capillary numbers
constexpr double stiff = 1e-2, soft = 1e-3;     // bending ratios
constexpr int coarse = 112, fine = 144;         // nodes
constexpr double allowed_slope = 1e-6;          // relative, from the theory
constexpr double allowed = 1e-6; // fold on two meshes, in the capillary number; growth rate there

struct Sphere {
  MembraneLaw law;
  double bending_ratio;
  std::string name() const {
    return law.is(skalak) ? fmt::format("skalak C={}", law.values()[0]) : law.law().name;
  }
};
const std::vector<Sphere> spheres{
    {neo_hookean, stiff}, {{skalak, {0}}, stiff}, {{skalak, {1}}, stiff}, {{skalak, {10}}, stiff}};

Case case_of(const Sphere &sphere, double capillary_number) {
  Case physics;
  physics.accuracy = 1e-6;
  physics.pore.shape = PoreShape::none;
  physics.capsule.radius = 1;
  physics.membrane.law = sphere.law;
  physics.membrane.bending_ratio = sphere.bending_ratio;
  physics.flow.type = FlowType::extension;
  physics.flow.capillary_number = capillary_number;
  return physics;
}

// dD/dCa at Ca = 0. A weak extension pulls at a sphere at rest with 5 mu e (P2 n + (1/2) dP2/dtheta t), and the
// membrane's displacement a P2 n + b dP2/dtheta t makes the energies
//   4 pi (E_s/(2 (1 - nu^2))) [(1 + nu) (2/5) (a - 3 b)^2 + (1 - nu) (12/5) b^2]   and
//   4 pi (delta/2) (6 + (6/5) nu) (a - b)^2 :
// two linear equations for a and b, and D = (3/4) a.
double theory(const Sphere &sphere) {
  const bool rubber = sphere.law.is(neo_hookean);
  const double c = rubber ? 0 : sphere.law.values()[0];
  const double nu = rubber ? 0.5 : c / (1 + c);
  const double modulus = rubber ? 3 : 2 * (1 + 2 * c) / (1 + c);
  const double area = 0.8 * modulus / (2 * (1 - nu)), shear = 2.4 * modulus / (1 + nu);
  const double bending = sphere.bending_ratio * (6 + 1.2 * nu);
  Eigen::Matrix2d stiffness{{area + bending, -3 * area - bending},
                            {-3 * area - bending, 9 * area + shear + bending}};
  return 0.75 * stiffness.inverse().row(0).dot(Eigen::RowVector2d(1, 3));
}

// D/Ca on its way to Ca = 0.
double measured_slope(const Sphere &sphere) {
  constexpr double step = 2e-4;
  const auto ratio = [&](double capillary_number) {
    const Outcome outcome = steady(case_of(sphere, capillary_number), {}, {});
    if (outcome.status != Status::steady)
      throw std::runtime_error(outcome.message);
    return outcome.last.series.at(0).deformation / capillary_number;
  };
  return (8 * ratio(step) - 6 * ratio(2 * step) + ratio(4 * step)) / 3;
}

std::string slope_row(const Sphere &sphere) {
  Sphere thin = sphere;
  thin.bending_ratio = 0;
  return fmt::format("{},{},{:.9f},{:.9f},{:.9f}", sphere.name(), sphere.bending_ratio,
                     measured_slope(sphere), theory(sphere), theory(thin));
}

// Rows, one a point; the last column says that the row is a fold, or else how the branch ended.
std::string branch_rows(const Sphere &sphere) {
  const Outcome outcome = follow_branch(case_of(sphere, weakest), {flow_key, strongest}, {});
  std::string rows;
  const auto add = [&](const BranchRow &point, const std::string &end) {
    rows +=
        fmt::format("{},{:.9f},{:.9f},{:.6f},{:.6f},{:.3e},{}\n", sphere.name(), point.parameter,
                    point.row.deformation, point.row.length, point.row.max_stretch, point.growth_rate, end);
  };
  for (const BranchRow &point : outcome.branch)
    add(point, &point == &outcome.branch.back() ? outcome.status == Status::reached     ? "reached"
                                                  : outcome.status == Status::unbounded ? "unbounded"
                                                                                        : outcome.failure
                                                : "");
  for (const BranchRow &fold : outcome.folds)
    add(fold, "fold");
  return rows;
}

// The fold of a neo-Hookean sphere on a mesh.
SteadyPoint fold_on(int nodes, double bending_ratio) {
  constexpr double near = 0.4;
  const Case physics = case_of({neo_hookean, bending_ratio}, near);
  const FoldSearch search =
      find_fold(physics, on_mesh(physics, nodes, find_steady(physics, {}, {})), flow_key, strongest, 0.1);
  if (!search.fold)
    throw std::runtime_error(fmt::format("no fold with delta = {}: {}", bending_ratio, search.end));
  return search.fold->point;
}

std::string fold_row(double bending_ratio) {
  const SteadyPoint first = fold_on(coarse, bending_ratio);
  const SteadyPoint second = fold_on(fine, bending_ratio);
  return fmt::format("{},{:.9f},{:.9f},{:.2e},{:.2e},{:.6f},{:.6f}", bending_ratio, second.value, first.value,
                     second.growth_rate, first.growth_rate, second.row.deformation, second.row.max_stretch);
}

bool study(const std::string &directory, unsigned jobs) {
  std::vector<TextTask> tasks;
  for (const Sphere &sphere : spheres)
    tasks.push_back({"branch " + sphere.name(), [=] { return branch_rows(sphere); }});
  for (const double bending_ratio : {stiff, soft})
    tasks.push_back({fmt::format("fold {}", bending_ratio), [=] { return fold_row(bending_ratio); }});
  for (const Sphere &sphere : spheres)
    tasks.push_back({"slope " + sphere.name(), [=] { return slope_row(sphere); }});
  const std::vector<std::string> texts = make_all(directory, jobs, tasks);
  auto text = texts.begin();

  const std::string branch_header = "sphere,capillary_number,deformation,length,max_stretch,growth_rate,end";
  std::string branches = branch_header + "\n";
  bool skalak_goes_on = true;
  double skalak_growth = -HUGE_VAL;
  for (const Sphere &sphere : spheres) {
    const Rows branch(branch_header, *text);
    branches += *text++;
    for (std::size_t k = 0; k < branch.size(); ++k) {
      const std::string &end = branch.text(k, "end");
      if (!end.empty())
        fmt::print("{}: {} at Ca = {}, D = {}, stretch {}\n", sphere.name(), end,
                   branch.text(k, "capillary_number"), branch.text(k, "deformation"),
                   branch.text(k, "max_stretch"));
      if (sphere.law.is(skalak)) {
        skalak_goes_on = skalak_goes_on && (end.empty() || end == "reached");
        skalak_growth = std::max(skalak_growth, branch.value(k, "growth_rate"));
      }
    }
  }
  write_atomically(directory + "/branches.csv", branches);

  const std::string fold_header =
      "bending_ratio,capillary_number,coarse,growth_rate,coarse_growth_rate,deformation,max_stretch";
  Table folds(fold_header);
  double apart = 0, growth = 0;
  for (int k = 0; k < 2; ++k) {
    folds.add(*text);
    const Rows fold(fold_header, *text++);
    apart = std::max(apart, std::abs(fold.value(0, "capillary_number") - fold.value(0, "coarse")));
    growth = std::max(
        {growth, std::abs(fold.value(0, "growth_rate")), std::abs(fold.value(0, "coarse_growth_rate"))});
    fmt::print("neo-hookean, delta = {}: no steady state beyond Ca = {}, D = {}, stretch {} there\n",
               fold.text(0, "bending_ratio"), fold.text(0, "capillary_number"), fold.text(0, "deformation"),
               fold.text(0, "max_stretch"));
  }
  folds.write(directory + "/folds.csv");

  const std::string slope_header = "sphere,bending_ratio,slope,theory,thin";
  Table slopes(slope_header);
  double slope_error = 0;
  for (const Sphere &sphere : spheres) {
    slopes.add(*text);
    const Rows slope(slope_header, *text++);
    slope_error = std::max(slope_error, std::abs(slope.value(0, "slope") / slope.value(0, "theory") - 1));
    fmt::print("{}: D/Ca = {}, theory {} ({} without bending)\n", sphere.name(), slope.text(0, "slope"),
               slope.text(0, "theory"), slope.text(0, "thin"));
  }
  slopes.write(directory + "/slopes.csv");

  const bool holds[] = {
      check(slope_error <= allowed_slope,
            fmt::format("slopes of D at Ca = 0 within {:.1e} of the theory", slope_error)),
      check(apart <= allowed, fmt::format("folds on {} and {} nodes are {:.1e} apart", coarse, fine, apart)),
      check(growth <= allowed, fmt::format("largest growth rate there {:.1e}", growth)),
      check(skalak_goes_on, fmt::format("no fold of Skalak's law, C = 0, 1, 10, up to Ca = {}", strongest)),
      check(skalak_growth < 0, fmt::format("all stable, largest growth rate {:.2e}", skalak_growth))};
  return std::ranges::all_of(holds, [](bool each) { return each; });
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
