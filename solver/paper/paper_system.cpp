#include "paper/paper_system.hpp"
#include "base/failure.hpp"
#include "integrals/ring_kernel.hpp"
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace capsule {
namespace {

using Eigen::Index;

constexpr int gauss_points = 5;
constexpr int logarithm_points = 12;

// ---- Boundaries ----

ElementSamples sample_elements(const MeridianSpline &curve, const ShapeTable &shapes, const Vector &weights) {
  const MeridianSamples at = sample_meridian(curve, shapes);
  const Vector speed = (at.x_slope.array().square() + at.r_slope.array().square()).sqrt();
  ElementSamples samples;
  samples.x = at.x;
  samples.r = at.r;
  samples.normal_x = -at.r_slope.cwiseQuotient(speed);
  samples.normal_r = at.x_slope.cwiseQuotient(speed);
  samples.area = at.r.cwiseProduct(speed).cwiseProduct(weights.replicate(at.x.size() / weights.size(), 1));
  return samples;
}

ElementCurve make_curve(const Vector &x, const Vector &r, const MeridianSpline &spline,
                        const ElementRules &rules) {
  return {x, r, sample_elements(spline, rules.at_gauss, rules.gauss.weights),
          sample_elements(spline, rules.at_first, rules.logarithm.weights),
          sample_elements(spline, rules.at_last, rules.logarithm.weights)};
}

ElementRules make_rules() {
  ElementRules rules;
  rules.gauss = unit_gauss_rule(gauss_points);
  rules.logarithm = logarithmic_rule(logarithm_points);
  rules.at_gauss = tabulate_shapes(rules.gauss.nodes);
  rules.at_first = tabulate_shapes(rules.logarithm.nodes);
  rules.at_last = tabulate_shapes(Vector::Ones(logarithm_points) - rules.logarithm.nodes);
  return rules;
}

// Nodes at equal steps of the integral of 1/h from the lip, 1/h = 1/largest + 1/(smallest + growth a) at
// distance a.
struct Grading {
  double smallest, growth, largest;
  double count(double a) const { return a / largest + std::log1p(growth * a / smallest) / growth; }
  double distance(double share, double length) const { // where count is `share` of that of the whole length
    const double wanted = share * count(length);
    const auto [low, high] = boost::math::tools::bisect([&](double a) { return count(a) - wanted; }, 0.0,
                                                        length, boost::math::tools::eps_tolerance<double>());
    return (low + high) / 2;
  }
};

// Arc length of the wall's nodes, from the entrance to the exit end, with a node on the lip. The sizes are
// those of 120 elements; other numbers scale them.
Vector wall_partition(const Pore &pore, int elements) {
  const Grading outside{0.03, 0.15, 1e3}, tube{0.03, 0.15, 0.22};
  const double length_outside = pore.entrance_arc - pore.exit_x;
  const double share =
      outside.count(length_outside) / (outside.count(length_outside) + tube.count(pore.exit_x));
  const int count_outside = static_cast<int>(std::lround(share * elements)),
            count_tube = elements - count_outside;
  Vector arc(elements + 1);
  for (int j = 0; j <= elements; ++j) {
    const int from_lip = j - count_outside;
    arc(j) =
        from_lip < 0
            ? pore.exit_x + outside.distance(-static_cast<double>(from_lip) / count_outside, length_outside)
            : pore.exit_x - tube.distance(static_cast<double>(from_lip) / count_tube, pore.exit_x);
  }
  arc(0) = pore.entrance_arc;
  arc(count_outside) = pore.exit_x;
  arc(elements) = 0;
  return arc;
}

// Nodal values and the slopes of the cubic polynomials through the four nodes next to the ends.
Vector with_lagrange_slopes(const Vector &nodal) {
  const Eigen::Vector4d slope = Eigen::Vector4d(-11, 18, -9, 2) / 6;
  Vector data(nodal.size() + 2);
  data << nodal, slope.dot(nodal.head<4>()), -slope.dot(nodal.tail<4>().reverse());
  return data;
}

ElementCurve make_wall(const Pore &pore, int elements, const ElementRules &rules) {
  const Vector arc = wall_partition(pore, elements);
  Vector x(elements + 1), r(elements + 1);
  for (Index j = 0; j <= elements; ++j) {
    const WallPoint p = wall_point(pore, arc(j));
    x(j) = p.x;
    r(j) = p.r;
  }
  const Matrix coefficients = spline_coefficients(elements, 1);
  const MeridianSpline spline{coefficients * with_lagrange_slopes(x), coefficients * with_lagrange_slopes(r)};
  return make_curve(x, r, spline, rules);
}

// From the wall to the axis, so that the normal points downstream.
ElementCurve make_exit(double exit_x, int elements, const ElementRules &rules) {
  const Vector x = Vector::Constant(elements + 1, exit_x);
  const Vector r = Vector::LinSpaced(elements + 1, 1, 0);
  const Matrix coefficients = spline_coefficients(elements, 1);
  const MeridianSpline spline{coefficients * with_lagrange_slopes(x), coefficients * with_lagrange_slopes(r)};
  ElementCurve exit = make_curve(x, r, spline, rules);
  // The plane is plane to the last digit: its stresslet vanishes in the plane itself.
  for (ElementSamples *samples : {&exit.gauss, &exit.first, &exit.last}) {
    samples->x.setConstant(exit_x);
    samples->normal_x.setOnes();
    samples->normal_r.setZero();
  }
  return exit;
}

// ---- Integrals over elements ----

// What the sources of a curve do to one target: kernels (columns xx, xr, rx, rr) with area and rule weights.
using KernelTable = Eigen::Matrix<double, Eigen::Dynamic, 4>;
struct TargetKernels {
  KernelTable gauss;         // all elements
  Index node = -1;           // of the curve, which the target is; -1: none
  KernelTable before, after; // logarithmic rule on the elements that end and begin at this node
};

KernelRow row_of(KernelTable &table, Index first = 0) {
  const auto column = [&](Index c) { return table.data() + c * table.rows() + first; };
  return {column(0), column(1), column(2), column(3)};
}

// One element that begins or ends at the target. With t the distance to the target in the parameter, the
// kernel is
//   smooth - ln(m1/t^2) logarithmic  +  2 ln(1/t) logarithmic,
// Gauss's rule for the first two terms, the logarithmic rule for the third.
void split_element(const RingKernel &kernel, double x0, double r0, const ElementCurve &curve, Index element,
                   bool at_first, const UnitRule &rule, KernelTable &gauss, KernelTable &logarithm) {
  KernelTable smooth(logarithm_points, 4), logarithmic(logarithm_points, 4);
  const auto evaluate = [&](const Rings &rings) {
    kernel.split(r0, rings, separations(x0, r0, rings), row_of(smooth), row_of(logarithmic));
  };
  const ElementSamples &graded = at_first ? curve.first : curve.last;
  evaluate(rings_of(graded, element * logarithm_points, logarithm_points));
  logarithm =
      2 * graded.area.segment(element * logarithm_points, logarithm_points).asDiagonal() * logarithmic;

  evaluate(rings_of(curve.gauss, element * gauss_points, gauss_points));
  for (Index k = 0; k < gauss_points; ++k) {
    const Index q = element * gauss_points + k;
    const double t = at_first ? rule.nodes(k) : 1 - rule.nodes(k);
    const double dx = curve.gauss.x(q) - x0, dr = curve.gauss.r(q) - r0, sum = curve.gauss.r(q) + r0;
    const double m1 = (dx * dx + dr * dr) / (dx * dx + sum * sum);
    gauss.row(q) = curve.gauss.area(q) * (smooth.row(k) - std::log(m1 / (t * t)) * logarithmic.row(k));
  }
}

// `node`: the target's node on the curve, or -1. On the axis the kernels have no logarithm.
void target_kernels(const RingKernel &kernel, double x0, double r0, const ElementCurve &curve, Index node,
                    const UnitRule &rule, TargetKernels &out) {
  const Index points = curve.gauss.x.size(), elements = points / gauss_points;
  out.gauss.resize(points, 4);
  kernel.plain(x0, r0, rings_of(curve.gauss, 0, points), row_of(out.gauss));
  out.gauss.array().colwise() *= curve.gauss.area.array();
  out.node = r0 > 0 ? node : -1;
  if (out.node > 0)
    split_element(kernel, x0, r0, curve, out.node - 1, false, rule, out.gauss, out.before);
  if (out.node >= 0 && out.node < elements)
    split_element(kernel, x0, r0, curve, out.node, true, rule, out.gauss, out.after);
}

// Integrals of the kernels against the B-splines: (N + 3) x 4.
void against_shapes(const TargetKernels &kernels, const ElementRules &rules, KernelTable &out) {
  const Index elements = kernels.gauss.rows() / gauss_points;
  out.setZero(elements + 3, 4);
  const Eigen::Matrix<double, 4, gauss_points> shapes = rules.at_gauss.value;
  for (Index c = 0; c < 4; ++c) {
    double *sum = out.data() + c * out.rows();
    const double *kernel = kernels.gauss.data() + c * kernels.gauss.rows();
    // A window of four sums slides along the elements, so that each is written once.
    double w0 = 0, w1 = 0, w2 = 0, w3 = 0;
    for (Index e = 0; e < elements; ++e, kernel += gauss_points) {
      for (Index k = 0; k < gauss_points; ++k) {
        w0 += shapes(0, k) * kernel[k];
        w1 += shapes(1, k) * kernel[k];
        w2 += shapes(2, k) * kernel[k];
        w3 += shapes(3, k) * kernel[k];
      }
      sum[e] = w0;
      w0 = w1;
      w1 = w2;
      w2 = w3;
      w3 = 0;
    }
    sum[elements] = w0;
    sum[elements + 1] = w1;
    sum[elements + 2] = w2;
  }
  if (kernels.node > 0)
    out.middleRows<4>(kernels.node - 1).noalias() += rules.at_last.value * kernels.before;
  if (kernels.node >= 0 && kernels.node < elements)
    out.middleRows<4>(kernels.node).noalias() += rules.at_first.value * kernels.after;
}

Eigen::Vector2d against_values(const KernelTable &kernels, const LoadSamples &density, Index first) {
  const auto x = density.x.segment(first, kernels.rows()), r = density.r.segment(first, kernels.rows());
  return {kernels.col(0).dot(x) + kernels.col(1).dot(r), kernels.col(2).dot(x) + kernels.col(3).dot(r)};
}

Eigen::Vector2d against_density(const TargetKernels &kernels, const Density &density) {
  const Index elements = kernels.gauss.rows() / gauss_points;
  Eigen::Vector2d sum = against_values(kernels.gauss, density.gauss, 0);
  if (kernels.node > 0)
    sum += against_values(kernels.before, density.last, (kernels.node - 1) * logarithm_points);
  if (kernels.node >= 0 && kernels.node < elements)
    sum += against_values(kernels.after, density.first, kernels.node * logarithm_points);
  return sum;
}

// ---- Unknowns: the B-spline coefficients that the end conditions leave free ----

enum class Ends {
  even,   // eqs. 21, 25: first derivatives vanish; coefficients 1 ... N+1 are free
  odd,    // eqs. 22, 26, and the value at the poles is zero; 2 ... N
  wall_x, // eqs. 27, 28: first derivative zero at the entrance, value -4 at the exit; 1 ... N+1
  wall_r  // second derivatives vanish; 1 ... N+1
};
constexpr double wall_shear = -4; // f_x of Poiseuille flow

// Folds the coefficients that are not free into the others: c has N + 3 entries, integrals against the
// B-splines. Returns what the fixed value at the end contributes.
template <typename Column>
double fold(Ends ends, Column &&c) {
  const Index n = c.size() - 3;
  switch (ends) {
  case Ends::even:
    c(2) += c(0);
    c(n) += c(n + 2);
    return 0;
  case Ends::odd:
    c(2) -= c(0);
    c(n) -= c(n + 2);
    return 0;
  case Ends::wall_x:
    c(2) += c(0);
    c(n) -= c(n + 2);
    c(n + 1) -= 4 * c(n + 2);
    return 6 * wall_shear * c(n + 2);
  case Ends::wall_r:
    c(1) += 2 * c(0);
    c(2) -= c(0);
    c(n) -= c(n + 2);
    c(n + 1) += 2 * c(n + 2);
    return 0;
  }
  return 0;
}

// One equation of the system: its coefficients, contiguous, and its right side.
struct Equation {
  double *coefficients;
  double *right_side;
};

Eigen::Map<Vector> part(const Equation &equation, Index first, Index count) {
  return {equation.coefficients + first, count};
}

// Velocity at the target by the traction and pressure on wall and exit, over 8 pi, taken to the left side.
// `first` is the place of the wall's unknowns. Component 0: axial, 1: radial.
struct FixedContribution {
  KernelTable wall;           // against B-splines
  Eigen::Vector2d pressure;   // coefficient of P
  Eigen::Vector2d right_side; // from f_r = -4 r and the Poiseuille velocity on the exit
};

void write_fixed(FixedContribution &from, Index component, Index first, const Equation &equation) {
  const Index n = from.wall.rows() - 3;
  auto along_x = from.wall.col(2 * component), along_r = from.wall.col(2 * component + 1);
  *equation.right_side += from.right_side(component) + stokeslet_factor * fold(Ends::wall_x, along_x);
  fold(Ends::wall_r, along_r);
  part(equation, first, n + 1) = -stokeslet_factor * along_x.segment(1, n + 1);
  part(equation, first + n + 1, n + 1) = -stokeslet_factor * along_r.segment(1, n + 1);
  equation.coefficients[first + 2 * n + 2] = from.pressure(component);
}

// Work space of an assembly.
struct Scratch {
  TargetKernels kernels;
  FixedContribution fixed;
  KernelTable shapes;
};

Density density_on(const ElementCurve &curve, LoadSamples (*field)(const ElementSamples &)) {
  return {field(curve.gauss), field(curve.first), field(curve.last)};
}
LoadSamples unit_axial(const ElementSamples &at) {
  return {Vector::Ones(at.x.size()), Vector::Zero(at.x.size())};
}
LoadSamples exit_shear(const ElementSamples &at) {
  return {Vector::Zero(at.x.size()), wall_shear * at.r};
}
LoadSamples poiseuille(const ElementSamples &at) {
  return {2 * (1 - at.r.array().square()).matrix(), Vector::Zero(at.x.size())};
}

void fixed_contribution(const PaperSystem &system, double x0, double r0, Index wall_node, Index exit_node,
                        Scratch &scratch) {
  const UnitRule &rule = system.rules.gauss;
  target_kernels(ring_stokeslet, x0, r0, system.wall, wall_node, rule, scratch.kernels);
  against_shapes(scratch.kernels, system.rules, scratch.fixed.wall);
  target_kernels(ring_stokeslet, x0, r0, system.exit, exit_node, rule, scratch.kernels);
  scratch.fixed.pressure = stokeslet_factor * against_density(scratch.kernels, system.exit_unit);
  scratch.fixed.right_side = stokeslet_factor * against_density(scratch.kernels, system.exit_shear);
  if (x0 != system.exit.x(0)) { // in the plane of the exit its stresslet vanishes
    target_kernels(ring_stresslet, x0, r0, system.exit, exit_node, rule, scratch.kernels);
    scratch.fixed.right_side += against_density(scratch.kernels, system.exit_velocity);
  }
}

// The equation's terms in the membrane's velocity: beta v - (lambda - 1) double layer. `node` of the
// membrane: -1 for targets elsewhere, where the first term is zero.
void write_membrane(const PaperSystem &system, const ElementCurve &membrane, double x0, double r0, Index node,
                    Scratch &scratch, const Equation *equations[2]) {
  const Index n = system.membrane_elements;
  if (system.viscosity_ratio != 1) {
    target_kernels(ring_stresslet, x0, r0, membrane, node, system.rules.gauss, scratch.kernels);
    against_shapes(scratch.kernels, system.rules, scratch.shapes);
    scratch.shapes *= 1 - system.viscosity_ratio;
  } else {
    scratch.shapes.setZero(n + 3, 4);
  }
  if (node >= 0) {
    const double beta = 0.5 * (1 + system.viscosity_ratio);
    const Eigen::Vector3d at_node = Eigen::Vector3d(1, 4, 1) / 6;
    scratch.shapes.col(0).segment<3>(node) += beta * at_node;
    scratch.shapes.col(3).segment<3>(node) += beta * at_node;
  }
  for (Index component = 0; component < 2; ++component) {
    if (equations[component] == nullptr)
      continue;
    auto along_x = scratch.shapes.col(2 * component), along_r = scratch.shapes.col(2 * component + 1);
    fold(Ends::even, along_x);
    fold(Ends::odd, along_r);
    part(*equations[component], 0, n + 1) = along_x.segment(1, n + 1);
    part(*equations[component], n + 1, n - 1) = along_r.segment(2, n - 1);
  }
}

// Adds the single layer of the membrane's load to the right sides.
void add_load(const PaperSystem &system, const ElementCurve &membrane, const Density &load, double x0,
              double r0, Index node, Scratch &scratch, const Equation *equations[2]) {
  target_kernels(ring_stokeslet, x0, r0, membrane, node, system.rules.gauss, scratch.kernels);
  const Eigen::Vector2d velocity =
      stokeslet_factor / system.capillary_number * against_density(scratch.kernels, load);
  for (Index component = 0; component < 2; ++component)
    if (equations[component] != nullptr)
      *equations[component]->right_side += velocity(component);
}

Index fixed_unknowns(const PaperSystem &system) {
  return 2 * (system.wall_elements + 1) + 1;
}
Index membrane_unknowns(const PaperSystem &system) {
  return 2 * Index{system.membrane_elements};
}

void solve_empty_pore(PaperSystem &system) {
  const Index n = system.wall_elements, size = fixed_unknowns(system);
  system.fixed_block.setZero(size, size);
  system.fixed_right_side.setZero(size);
  Scratch scratch;
  const auto equation = [&](Index i) {
    return Equation{system.fixed_block.col(i).data(), system.fixed_right_side.data() + i};
  };
  for (Index j = 0; j <= n; ++j) {
    fixed_contribution(system, system.wall.x(j), system.wall.r(j), j, j == n ? 0 : -1, scratch);
    write_fixed(scratch.fixed, 0, 0, equation(j));
    write_fixed(scratch.fixed, 1, 0, equation(n + 1 + j));
  }
  fixed_contribution(system, system.exit.x(0), 0, -1, -1, scratch);
  write_fixed(scratch.fixed, 0, 0, equation(size - 1));
  system.fixed_right_side(size - 1) -= 1; // beta v = 1/2 * 2 of Poiseuille's flow on the axis
  const Vector solution =
      lu_solve(Matrix(system.fixed_block.transpose()).partialPivLu(), system.fixed_right_side);
  system.empty_pressure = solution(size - 1);
}

// Nodal values of the membrane's velocity from its free coefficients.
Vector nodal_velocity(const Vector &solution, Index n) {
  Vector x(n + 3), r = Vector::Zero(n + 3);
  x.segment(1, n + 1) = solution.head(n + 1);
  x(0) = x(2);
  x(n + 2) = x(n);
  r.segment(2, n - 1) = solution.segment(n + 1, n - 1);
  r(0) = -r(2);
  r(n + 2) = -r(n);
  const auto at_nodes = [n](const Vector &c) -> Vector {
    return (c.head(n + 1) + 4 * c.segment(1, n + 1) + c.tail(n + 1)) / 6;
  };
  Vector velocity(2 * n + 2);
  velocity << at_nodes(x), at_nodes(r);
  return velocity;
}

} // namespace

PaperSystem make_paper_system(const Pore &pore, const CapsuleSpec &capsule, const MembraneSpec &material,
                              const FlowSpec &flow, const MeshSpec &mesh) {
  if (flow.type != FlowType::pore || pore.shape != PoreShape::hyperbolic)
    throw InputError("numerics = \"paper\" computes the flow through a hyperbolic pore only");
  PaperSystem system;
  system.capillary_number = flow.capillary_number;
  system.viscosity_ratio = flow.viscosity_ratio;
  const auto given_or = [](int elements, int standard) { return elements > 0 ? elements : standard; };
  system.membrane_elements = given_or(mesh.membrane, 60);
  system.wall_elements = given_or(mesh.wall, 120);
  system.exit_elements = given_or(mesh.exit, 30);
  system.rules = make_rules();
  system.load = make_paper_load(capsule, material, system.membrane_elements);
  system.wall = make_wall(pore, system.wall_elements, system.rules);
  system.exit = make_exit(pore.exit_x, system.exit_elements, system.rules);
  system.exit_unit = density_on(system.exit, unit_axial);
  system.exit_shear = density_on(system.exit, exit_shear);
  system.exit_velocity = density_on(system.exit, poiseuille);
  solve_empty_pore(system);
  return system;
}

FlowState PaperSystem::flow(const Vector &position) const {
  const Index n = membrane_elements, from_fixed = membrane_unknowns(*this), fixed = fixed_unknowns(*this);
  const Index size = from_fixed + fixed;
  const MeridianSpline meridian = spline_through(load, position);
  const ElementCurve membrane = make_curve(position.head(n + 1), position.tail(n + 1), meridian, rules);
  const MomentSplines moments = moment_splines(load, meridian);
  const Density density{load_samples(load, meridian, moments, rules.at_gauss),
                        load_samples(load, meridian, moments, rules.at_first),
                        load_samples(load, meridian, moments, rules.at_last)};

  // Column: equation, row: unknown.
  Matrix block = Matrix::Zero(size, size);
  Vector right_side = Vector::Zero(size);
  block.bottomRightCorner(fixed, fixed) = fixed_block;
  right_side.tail(fixed) = fixed_right_side;
  Scratch scratch;
  const auto equation = [&](Index i) { return Equation{block.col(i).data(), right_side.data() + i}; };
  const auto add_membrane = [&](double x0, double r0, Index node, const Equation &axial,
                                const Equation *radial) {
    const Equation *equations[2] = {&axial, radial};
    write_membrane(*this, membrane, x0, r0, node, scratch, equations);
    add_load(*this, membrane, density, x0, r0, node, scratch, equations);
  };
  for (Index i = 0; i <= n; ++i) {
    const bool pole = i == 0 || i == n; // where the radial equation is 0 = 0
    const double x0 = membrane.x(i), r0 = pole ? 0 : membrane.r(i);
    const Equation axial = equation(i), radial = equation(pole ? i : n + i);
    fixed_contribution(*this, x0, r0, -1, -1, scratch);
    write_fixed(scratch.fixed, 0, from_fixed, axial);
    if (!pole)
      write_fixed(scratch.fixed, 1, from_fixed, radial);
    add_membrane(x0, r0, i, axial, pole ? nullptr : &radial);
  }
  for (Index j = 0; j <= wall_elements; ++j) {
    const Equation axial = equation(from_fixed + j), radial = equation(from_fixed + wall_elements + 1 + j);
    add_membrane(wall.x(j), wall.r(j), -1, axial, &radial);
  }
  add_membrane(exit.x(0), 0, -1, equation(size - 1), nullptr);

  const Eigen::PartialPivLU<Eigen::Ref<Matrix>> factors(block);
  const Vector solution = factors.transpose().solve(right_side);
  if (!solution.allFinite())
    throw NumericsFailure(failure_kind::not_a_number, "the system of eq. 29 has no finite solution",
                          "use a smaller step");
  return {nodal_velocity(solution, n), empty_pressure - solution(size - 1)};
}

} // namespace capsule
