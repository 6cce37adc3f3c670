// Which bending stiffness keeps a membrane from wrinkling? A capsule in the mouth gets dents, the same on every mesh;
// by bisection, the smallest stiffness that lets none of them become a wrinkle, against the capillary number, the mesh
// and the depth of the dents; and length and place of the first wrinkles of softer membranes.
#include "study.hpp"
#include "motion/dynamics.hpp"
#include "motion/motion.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <random>

using namespace capsule;

namespace {

constexpr double mouth = 0.5;           // x_g where the dents are made
constexpr double last_x_g = 2.5;        // the rear has been the softest before
constexpr double radius = 0.8;          // of Table 1's sphere
constexpr double modulus = 3;           // E_s/G of a neo-Hookean membrane
constexpr int coarsest = 40;            // nodes
constexpr int wrinkles = 3;             // dents
constexpr double depth = 1e-4;          // of the dents that are made, in radii, unless it is varied
constexpr double bracket = 1.15;        // of the bisection
constexpr double same_threshold = 1.33; // two brackets

Case entrance(double capillary_number, double stiffness, int nodes) {
  Case physics = short_entrance(nodes, mouth);
  physics.membrane.bending_ratio = stiffness;
  physics.flow.capillary_number = capillary_number;
  return physics;
}

// Normal waves, 6 to `shortest` a whole meridian, whose amplitudes are the same on every mesh.
Vector dented(const Vector &position, const Vector &zeta, int shortest, double deep) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Vector wave = Vector::Zero(zeta.size());
  for (int k = 6; k <= shortest; ++k)
    wave.array() += uniform(random) * (k * zeta.array()).cos();
  wave *= deep * radius / std::sqrt(shortest / 6.0);
  const Eigen::Index n = zeta.size();
  Vector result = position;
  result.head(n).array() -= wave.array() * zeta.array().cos();
  result.tail(n).array() += wave.array() * zeta.array().sin();
  return result;
}

struct Entrance {
  Outcome outcome;
  double first = NAN; // x_g of the first wrinkles
  double tension = 0; // the most negative meridional tension until then
  double dents = 0;   // most
};

Entrance enter(double capillary_number, double stiffness, int nodes, int shortest, double deep = depth) {
  Case physics = entrance(capillary_number, stiffness, nodes);
  Outcome way = march(physics, {}, {});
  if (way.status == Status::reached) {
    way.last.position = dented(way.last.position, make_scene(physics).membrane.basis.nodes, shortest, deep);
    physics.until.x_g = last_x_g;
    for (int k = 1; mouth + 0.05 * k < last_x_g; ++k)
      physics.output.profiles_at_x_g.push_back(mouth + 0.05 * k);
    way = march(physics, way.last, {});
  }
  Entrance entrance{std::move(way)};
  for (const SeriesRow &row : entrance.outcome.last.series) {
    entrance.dents = std::max(entrance.dents, row.dents);
    if (row.dents >= wrinkles && !(entrance.first < row.x_g))
      entrance.first = row.x_g;
  }
  for (const Profile &profile : entrance.outcome.last.profiles)
    if (!(profile.x_g >= entrance.first))
      entrance.tension = std::min(entrance.tension, profile.tension_meridional.minCoeff());
  return entrance;
}

bool is_smooth(const Entrance &entrance) {
  return entrance.outcome.status == Status::reached && entrance.dents < wrinkles;
}

// Every failure of a march must be for wrinkles that are there.
bool is_named(const Entrance &entrance) {
  const bool right = entrance.outcome.status == Status::reached ||
                     (entrance.outcome.failure == failure_kind::wrinkled && entrance.dents >= wrinkles);
  if (!right)
    fmt::print("failed as {}: {}\n", entrance.outcome.failure, entrance.outcome.message);
  return right;
}

// Length of the waves on the sphere that buckle first, and the stiffness below which a tension buckles them.
double buckle_length(double stiffness) {
  return 2 * std::numbers::pi * std::pow(stiffness * radius * radius / modulus, 0.25);
}
double buckling_stiffness(double tension) {
  return std::pow(tension * radius / 2, 2) / modulus;
}

struct Threshold {
  double stiffness = NAN; // geometric mean of the last bracket
  double tension = 0;     // of the last smooth entrance
};

Threshold threshold(double capillary_number, int nodes, double deep, bool &named) {
  double soft = 1e-7;
  double stiff = 1e-3;
  Threshold found;
  const auto smooth = [&](double stiffness) {
    const Entrance entrance = enter(capillary_number, stiffness, nodes, coarsest - 4, deep);
    named = is_named(entrance) && named;
    if (is_smooth(entrance))
      found.tension = entrance.tension;
    return is_smooth(entrance);
  };
  while (stiff / soft > bracket) {
    const double middle = std::sqrt(soft * stiff);
    (smooth(middle) ? stiff : soft) = middle;
  }
  found.stiffness = std::sqrt(soft * stiff);
  return found;
}

bool thresholds(const std::string &directory, bool &named) {
  Table table("capillary_number,nodes,depth,stiffness,tension,predicted");
  const auto add = [&](double number, int nodes, double deep) {
    const Threshold found = threshold(number, nodes, deep, named);
    table.add(fmt::format("{:g},{},{:g},{:.3e},{:.4f},{:.3e}", number, nodes, deep, found.stiffness,
                          found.tension, buckling_stiffness(found.tension)));
    fmt::print("eps = {:g}, N = {}, dents of {:g}: wrinkles below delta = {:.2e}; tension down to {:.4f}, "
               "which buckles a sphere below {:.1e}\n",
               number, nodes, deep, found.stiffness, found.tension, buckling_stiffness(found.tension));
    return found.stiffness;
  };
  double worst = 0; // change between the two finest meshes
  for (const double number : {0.02, 0.03, 0.06, 0.09, 0.14}) {
    double before = NAN;
    double change = NAN;
    for (const int nodes : {coarsest, 64, 80}) {
      const double found = add(number, nodes, depth);
      change = std::max(found, before) / std::min(found, before);
      before = found;
    }
    worst = change <= worst ? worst : change;
  }
  double before = 0;
  bool deeper = true;
  for (const double deep : {1e-6, 1e-5, 1e-3}) {
    const double found = add(0.09, 80, deep);
    deeper = deeper && found > before;
    before = found;
  }
  table.write(directory + "/thresholds.csv");
  const bool same =
      check(worst < same_threshold, fmt::format("the smallest stiffness is the same on the two finest meshes "
                                                "within a factor of {} (worst {:.2f})",
                                                same_threshold, worst));
  return check(deeper, "it is the larger, the deeper the dents") && same;
}

// The dents of a profile: places S of the least curvature of each concave stretch.
std::vector<double> dents_of(const Profile &profile) {
  std::vector<double> places;
  const Vector &curvature = profile.curvature_meridional;
  for (Eigen::Index k = 1; k + 1 < curvature.size(); ++k)
    if (curvature[k] < 0 && curvature[k] <= curvature[k - 1] && curvature[k] < curvature[k + 1])
      places.push_back(profile.S[k]);
  return places;
}

// Length of the waves that grow fastest in a membrane under tension T < 0 between two liquids, where bending alone
// resists: the largest of (-T k - delta k^3).
double fastest_length(double tension, double stiffness) {
  return 2 * std::numbers::pi * std::sqrt(3 * stiffness / -tension);
}

bool first_wrinkles(const std::string &directory, bool &named) {
  constexpr int nodes = 96;
  constexpr double spacing = std::numbers::pi * radius / nodes;
  Table table("stiffness,x_g,length,static,fastest,tension,place,dents");
  bool holds = true;
  for (const double stiffness : {1e-7, 1e-6, 1e-5}) {
    const Entrance entrance = enter(0.09, stiffness, nodes, 60);
    named = is_named(entrance) && named;
    const auto profile = std::ranges::find_if(entrance.outcome.last.profiles, [&](const Profile &one) {
      return one.x_g >= entrance.first - 1e-6 && dents_of(one).size() >= wrinkles;
    });
    fmt::print("delta = {:g}: {}\n", stiffness,
               entrance.outcome.failure.empty() ? "reached" : entrance.outcome.message);
    if (profile == entrance.outcome.last.profiles.end()) {
      holds = false;
      continue;
    }
    const std::vector<double> dents = dents_of(*profile);
    std::vector<double> gaps;
    for (std::size_t k = 1; k < dents.size(); ++k)
      gaps.push_back(dents[k] - dents[k - 1]);
    std::ranges::sort(gaps);
    const double length = gaps[gaps.size() / 2];
    const double fastest = fastest_length(entrance.tension, stiffness);
    const double place = dents[dents.size() / 2] / profile->S[profile->S.size() - 1];
    if (fastest > 3 * spacing) // the mesh carries them
      holds = holds && std::abs(length / fastest - 1) < 0.3;
    else // nothing shorter than the mesh carries
      holds = holds && length > 2 * spacing && length < 4 * spacing;
    table.add(fmt::format("{:g},{:.2f},{:.4f},{:.4f},{:.4f},{:.4f},{:.3f},{}", stiffness, profile->x_g,
                          length, buckle_length(stiffness), fastest, entrance.tension, place, dents.size()));
    fmt::print("delta = {:g}: {} dents at x_g = {:.2f}, {:.3f} apart (static {:.3f}, fastest {:.3f}, two "
               "nodes {:.3f}), at "
               "{:.2f} of the meridian; tension {:.4f}\n",
               stiffness, dents.size(), profile->x_g, length, buckle_length(stiffness), fastest, 2 * spacing,
               place, entrance.tension);
  }
  table.write(directory + "/wrinkles.csv");
  return check(holds,
               "the first wrinkles are as long as the waves that grow fastest, within 30 %, or two to four "
               "nodes where "
               "these are below three");
}

bool study(const std::string &directory, unsigned /*jobs*/) {
  make_directories(directory);
  bool named = true;
  const bool length = first_wrinkles(directory, named);
  const bool converged = thresholds(directory, named);
  check(named, "every march that fails is said to be wrinkled");
  return length && converged && named;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
