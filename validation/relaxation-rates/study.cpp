// Do the growth rates of the solver know lambda, the membrane's viscosity, its pre-stress and its bending stiffness? Small
// motions of a sphere at rest in an unbounded liquid against their exact rates, which need two unknowns for each wave P_l;
// and how the rates come to those of a membrane of constant area as Skalak's C grows.
#include "study.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "steady/growth_rates.hpp"
#include "steady/mesh_change.hpp"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

using namespace capsule;

namespace {

constexpr int nodes = 40, last_wave = 6;
constexpr double allowed = 1e-6; // of a rate, relative

// Moduli of small strains about an isotropic stretch, in G: T_s + T_phi gains 2 K (e_s + e_phi), T_s - T_phi gains
// 2 G (e_s - e_phi).
struct Moduli {
  double area, shear, tension, poisson_ratio;
};
Moduli of_neo_hookean(double stretch) {
  const double s = std::pow(stretch, -6);
  return {3 * s, 1, 1 - s, 0.5};
}
Moduli of_skalak(double stretch, double c) {
  const double s = stretch * stretch;
  return {s + c * s * (3 * s * s - 1), 2 * s - 1, s - 1 + c * s * (s * s - 1), c / (1 + c)};
}

using Pair = Eigen::Vector2d; // the factors of P_l e_r and of grad P_l

// Load of a membrane of radius 1 that is displaced by (u, w).
Pair elastic_load(int l, const Moduli &moduli, double bending, const Pair &displacement) {
  const double q = l * (l + 1), u = displacement[0], w = displacement[1];
  const double stretched = moduli.area * (2 * u - q * w);
  const double bent = bending * (q - 1 + moduli.poisson_ratio) * (u - w);
  return {-2 * stretched - moduli.tension * (q - 2) * u - q * bent,
          stretched - moduli.shear * (q - 2) * w + bent};
}

// Traction on the outer side of the sphere, by the outer liquid, whose velocity there is (u, w): Lamb's solutions that
// decay, f = a r^-l + b r^(-l-2) in the radial direction, viscosity 1.
Pair outer_traction(int l, const Pair &velocity) {
  const double q = l * (l + 1), u = velocity[0], w = velocity[1];
  const double a = (l * u + q * w) / 2, b = u - a;
  return {-(4 * l - 2) * a / (l + 1) - 2 * (l * a + (l + 2) * b),
          l * ((l - 2) * a + (l + 2) * b) / q - w + u};
}

// The same inside: f = a r^(l+1) + b r^(l-1).
Pair inner_traction(int l, const Pair &velocity) {
  const double q = l * (l + 1), u = velocity[0], w = velocity[1];
  const double a = (q * w - (l + 1) * u) / 2, b = u - a;
  return {-(4 * l + 6) * a / l + 2 * ((l + 1) * a + (l - 1) * b),
          ((l + 1) * (l + 3) * a + (l - 1) * (l + 1) * b) / q - w + u};
}

struct Sphere {
  double viscosity_ratio = 1;
  SurfaceViscosity viscosity = {};
  double bending = 0;
  Moduli moduli;
};

// Slow and fast decay of the wave P_l, in G/(mu a).
Pair exact_rates(int l, const Sphere &sphere) {
  const Moduli viscous{sphere.viscosity.dilatational, sphere.viscosity.shear, 0, 0};
  Eigen::Matrix2d resistance, stiffness;
  for (int k = 0; k < 2; ++k) {
    const Pair unit = Pair::Unit(k);
    resistance.col(k) = outer_traction(l, unit) - sphere.viscosity_ratio * inner_traction(l, unit) +
                        elastic_load(l, viscous, 0, unit);
    stiffness.col(k) = elastic_load(l, sphere.moduli, sphere.bending, unit);
  }
  const Eigen::Vector2cd rates = Eigen::Matrix2d(resistance.inverse() * stiffness).eigenvalues();
  return {std::min(rates[0].real(), rates[1].real()), std::max(rates[0].real(), rates[1].real())};
}

// All that the solver finds.
Eigen::ArrayXd computed_rates(const MembraneLaw &law, const Sphere &sphere, double inflation) {
  Case physics;
  physics.pore.shape = PoreShape::none;
  physics.capsule.radius = 1;
  physics.capsule.inflation = inflation;
  physics.membrane.law = law;
  physics.membrane.bending_ratio = sphere.bending;
  physics.membrane.viscosity = sphere.viscosity;
  physics.flow.capillary_number = 1;
  physics.flow.viscosity_ratio = sphere.viscosity_ratio;
  physics.accuracy = 1e-7;
  const auto system = system_on_mesh(physics, spectral_basis(nodes).nodes);
  return -all_growth_rates(*system, system->initial()).real().array();
}

double nearest(const Eigen::ArrayXd &rates, double rate) {
  Eigen::Index at = 0;
  (rates - rate).abs().minCoeff(&at);
  return rates[at];
}

const std::vector<double> ratios{0.2, 0.5, 1, 2, 5, 10};

std::string rows_of(const std::string &law, double inflation, double bending) {
  std::string text;
  for (const double ratio : ratios)
    for (const SurfaceViscosity viscosity :
         {SurfaceViscosity{0, 0}, SurfaceViscosity{1, 0}, SurfaceViscosity{10, 0}, SurfaceViscosity{1, 2}}) {
      const Moduli moduli =
          law == "neo-hookean" ? of_neo_hookean(1 + inflation) : of_skalak(1 + inflation, 1);
      const Sphere sphere{ratio, viscosity, bending, moduli};
      const Eigen::ArrayXd rates =
          computed_rates(law == "neo-hookean" ? neo_hookean : MembraneLaw{skalak, {1}}, sphere, inflation);
      for (int l = 2; l <= last_wave; ++l) {
        const Pair exact = exact_rates(l, sphere);
        text += fmt::format("{},{},{},{},{},{},{}", law, inflation, bending, ratio, viscosity.shear,
                            viscosity.dilatational, l);
        for (const double rate : exact) {
          const double found = nearest(rates, rate);
          text += fmt::format(",{:.9g},{:.9g},{:.2g}", rate, found, std::abs(found / rate - 1));
        }
        text += "\n";
      }
    }
  return text;
}

// 1/rate of P_2 and P_3 over its limit for constant area, less one.
std::string limit_of(double c) {
  std::string text;
  for (const double ratio : {0.2, 1.0, 5.0})
    for (const double shear : {0.0, 10.0}) {
      const Sphere sphere{ratio, {shear, 0}, 0, of_skalak(1, c)};
      const Eigen::ArrayXd rates = computed_rates({skalak, {c}}, sphere, 0);
      const double limits[] = {2 + 23 * ratio / 16 + shear, 2.125 + 1.9 * ratio + shear};
      for (int l = 2; l <= 3; ++l) {
        const double exact = exact_rates(l, sphere)[0];
        text += fmt::format("{},{},{},{},{:.9g},{:.6g}\n", c, ratio, shear, l, limits[l - 2],
                            1 / (nearest(rates, exact) * limits[l - 2]) - 1);
      }
    }
  return text;
}

bool study(const std::string &directory, unsigned jobs) {
  std::vector<TextTask> tasks;
  for (const std::string law : {"neo-hookean", "skalak"})
    for (const double inflation : {0.0, 0.05})
      for (const double bending : {0.0, 1e-2})
        tasks.push_back({fmt::format("{}-{}-{}", law, inflation, bending),
                         [law, inflation, bending] { return rows_of(law, inflation, bending); }});
  const std::size_t of_rates = tasks.size();
  for (const double c : {1.0, 10.0, 100.0, 1e3, 1e4})
    tasks.push_back({fmt::format("limit-{}", c), [c] { return limit_of(c); }});
  const std::vector<std::string> texts = make_all(directory, jobs, tasks);
  std::string rates, limits;
  for (std::size_t i = 0; i < texts.size(); ++i)
    (i < of_rates ? rates : limits) += texts[i];
  const std::string rates_header =
      "law,inflation,bending_ratio,viscosity_ratio,shear_viscosity,dilatational_viscosity,wave,"
      "slow,slow_computed,slow_error,fast,fast_computed,fast_error";
  const std::string limits_header = "dilatation,viscosity_ratio,shear_viscosity,wave,limit,excess";
  write_atomically(directory + "/rates.csv", rates_header + "\n" + rates);
  write_atomically(directory + "/limits.csv", limits_header + "\n" + limits);

  double worst = 0;
  std::size_t compared = 0;
  const Rows compared_rates(rates_header, rates);
  for (std::size_t row = 0; row < compared_rates.size(); ++row)
    for (const char *column : {"slow_error", "fast_error"}) {
      worst = std::max(worst, compared_rates.value(row, column));
      ++compared;
    }
  bool holds =
      check(worst < allowed,
            fmt::format("{} rates of spheres at rest are the exact ones within {:.1e}", compared, worst));
  double least = 10, most = 10; // how much the excess falls when C grows from 1e3 to 1e4
  const Rows rows(limits_header, limits);
  const auto is_same_motion = [&](std::size_t one, std::size_t other) {
    return std::ranges::all_of(
        std::array{"viscosity_ratio", "shear_viscosity", "wave"},
        [&](const char *column) { return rows.text(one, column) == rows.text(other, column); });
  };
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (rows.value(i, "dilatation") == 1e3 && rows.value(k, "dilatation") == 1e4 && is_same_motion(i, k)) {
        const double falls = rows.value(i, "excess") / rows.value(k, "excess");
        least = std::min(least, falls);
        most = std::max(most, falls);
      }
  holds =
      check(least > 9.7 && most < 10.3,
            fmt::format(
                "rates come to those of a membrane of constant area as 1/C: from C = 1e3 to 1e4 {:.2f} to "
                "{:.2f} times nearer",
                least, most)) &&
      holds;
  return holds;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
