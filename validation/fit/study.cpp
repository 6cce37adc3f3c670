// Fits of synthetic images: steady states of known capsules, points along their outlines at the distance of a pixel, .01 R_t,
// with a noise of half of one, seeded. How far the fits are from the truth, how often their 90 % intervals contain it, how
// often the law is right; what a velocity adds, what a silhouette loses, and what wrong assumptions do.
#include "study.hpp"
#include "base/failure.hpp"
#include "case/case.hpp"
#include "case/key_path.hpp"
#include "fit/fit.hpp"
#include "law/generalised_hooke.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "steady/newton.hpp"
#include "steady/steady_state.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <random>

using namespace capsule;

namespace {

constexpr double pixel = 0.01;
constexpr unsigned trials = 600, trials_of_laws = 200, trials_of_noise = 100, trials_of_parts = 40;
constexpr const char *radius_key = "capsule.radius", *flow_key = "flow.capillary_number",
                     *inflation_key = "capsule.inflation";

// Three laws of equal small-strain moduli.
std::vector<MembraneLaw> three_laws() {
  return {neo_hookean, {skalak, {1}}, {generalised_hooke, {0.5}}};
}

struct Truth {
  Case input;
  SteadyState state;
  bool parachute = false; // the rear is concave
};

// A random capsule that has a steady state.
Truth random_truth(unsigned seed) {
  std::mt19937_64 random(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (;;) {
    Truth truth;
    truth.input.membrane.law = three_laws()[seed % 3];
    truth.input.membrane.bending_ratio = 1e-4;
    truth.input.capsule.radius = between(0.7, 1.05);
    truth.input.flow.capillary_number = between(0.02, 0.12);
    truth.input.capsule.inflation = between(0, 0.1);
    try {
      const SteadyState found = find_steady(truth.input, {}, {});
      truth.state = on_mesh(truth.input, 88, found);
    } catch (const NumericsFailure &) { // beyond the fold
      continue;
    }
    const Eigen::Index n = truth.state.system->nodes();
    truth.parachute =
        truth.state.unknowns.head(n).minCoeff() <
        truth.state.system->membrane().basis.even(Vector::Zero(1), 0, truth.state.unknowns.head(n))[0] - 1e-3;
    return truth;
  }
}

// Upper and lower half of the outline, the points in their order.
Contour image_of(const SteadyState &state, double noise, OutlineSeen seen, unsigned seed) {
  std::mt19937_64 random(seed + 1000);
  std::normal_distribution<double> error(0, noise);
  const Eigen::Index n = state.system->nodes();
  const MeridianBasis &basis = state.system->membrane().basis;
  const Vector zeta = Vector::LinSpaced(6001, 0, std::numbers::pi);
  const Vector x = basis.even(zeta, 0, state.unknowns.head(n));
  const Vector r = basis.odd(zeta, 0, state.unknowns.segment(n, n));
  std::vector<double> xs, rs;
  const auto add = [&](double at_x, double at_r, double side) {
    xs.push_back(at_x + error(random) + 7.3);
    rs.push_back(std::abs(side * at_r + error(random)));
  };
  Eigen::Index first = 0;
  if (seen == OutlineSeen::silhouette)
    x.minCoeff(&first);
  for (const double side : {1.0, -1.0}) {
    for (double at = pixel / 2; first > 0 && at < r[first]; at += pixel)
      add(x[first], at, side);
    double way = 0, next = pixel / 2;
    for (Eigen::Index k = first + 1; k < zeta.size(); ++k) {
      way += std::hypot(x[k] - x[k - 1], r[k] - r[k - 1]);
      if (way < next)
        continue;
      next += pixel;
      add(x[k], r[k], side);
    }
  }
  Contour contour;
  contour.file = "image";
  contour.x = Eigen::Map<const Vector>(xs.data(), std::ssize(xs));
  contour.r = Eigen::Map<const Vector>(rs.data(), std::ssize(rs));
  return contour;
}

// What the fit knows: everything but size, strength of the flow and pre-stress.
Case known(const Truth &truth, const std::vector<std::string> &unknowns,
           const std::vector<std::string> &laws) {
  Case input = truth.input;
  input.membrane.law.all_values() = three_laws()[0].all_values();
  for (const MembraneLaw &law : three_laws())
    for (std::size_t i = 0; i < law.all_values().size(); ++i)
      if (law.all_values()[i] != three_laws()[0].all_values()[i])
        input.membrane.law.all_values()[i] = law.all_values()[i];
  for (const std::string &key : unknowns)
    input = with_number(input, key, key == inflation_key ? 0.02 : 0);
  input.fit.unknowns = unknowns;
  input.fit.laws = laws;
  return input;
}

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const MembraneLaw &law : three_laws())
    names.emplace_back(law.law().name);
  return names;
}

// One fit beside the truth: relative errors of a and G, error of the inflation, and which intervals contain it.
std::string row_of(const Truth &truth, const Case &input, const Contour &contour, FitStarts &starts) {
  const double began = cpu_seconds();
  FitResult fit;
  try {
    fit = fit_contours(input, std::span(&contour, 1), starts, {});
  } catch (const NumericsFailure &failure) {
    return fmt::format("failed,,,,,,,,,,,{:.3g}", cpu_seconds() - began);
  }
  const double once = cpu_seconds() - began;
  double errors[3] = {0, 0, 0}, bars[3] = {0, 0, 0};
  int inside[3] = {-1, -1, -1};
  const char *names[3] = {radius_key, flow_key, inflation_key};
  for (int k = 0; k < 3; ++k)
    for (const FittedValue &value : fit.values)
      if (value.name == names[k]) {
        const double true_value = number(names[k], truth.input);
        errors[k] = k == 0   ? value.value / true_value - 1
                    : k == 1 ? true_value / value.value - 1 // of G
                             : value.value - true_value;
        bars[k] = k == 2 ? value.standard_error : value.standard_error / value.value;
        inside[k] = value.low <= true_value && true_value <= value.high ? 1 : 0;
      }
  return fmt::format("{},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{},{},{},{:.4g},{:.3g}", fit.law,
                     errors[0], errors[1], errors[2], bars[0], bars[1], bars[2], inside[0], inside[1],
                     inside[2], fit.noise, once);
}

constexpr const char *row_head = "law,size_error,modulus_error,inflation_error,size_bar,modulus_bar,"
                                 "inflation_bar,size_inside,modulus_inside,"
                                 "inflation_inside,noise,cpu_seconds";

std::string truth_text(const Truth &truth, unsigned seed) {
  return fmt::format("{},{},{:.5f},{:.5f},{:.5f},{}", seed, truth.input.membrane.law.law().name,
                     truth.input.capsule.radius, truth.input.flow.capillary_number,
                     truth.input.capsule.inflation, truth.parachute ? 1 : 0);
}
constexpr const char *truth_head = "seed,true_law,radius,capillary_number,inflation,parachute";

const std::vector<std::string> three_unknowns{radius_key, flow_key, inflation_key};

// All that is tried on one capsule: rows "variant,<truth>,<fit>".
std::string trial(unsigned seed) {
  const Truth truth = random_truth(seed);
  const std::string true_law = truth.input.membrane.law.law().name;
  const double began = cpu_seconds();
  find_steady(truth.input, {}, {});
  const double steady_seconds = cpu_seconds() - began;
  std::string text;
  FitStarts starts;
  const auto follow = [&](const std::string &variant, const Case &input, const Contour &contour) {
    text += fmt::format("{},{},{},{:.3g}\n", variant, truth_text(truth, seed),
                        row_of(truth, input, contour, starts), steady_seconds);
  };
  const auto add = [&](const std::string &variant, const Case &input, const Contour &contour) {
    starts.clear();
    follow(variant, input, contour);
  };
  const Contour image = image_of(truth.state, pixel / 2, OutlineSeen::meridian, seed);
  const Case own = known(truth, three_unknowns, {true_law});
  add("law known", own, image);
  if (seed < trials_of_parts)
    follow("next image", own, image_of(truth.state, pixel / 2, OutlineSeen::meridian, seed + trials));
  if (seed < trials_of_laws)
    add("laws", known(truth, three_unknowns, law_names()), image);
  unsigned other = seed;
  for (const double noise : {0.25, 1.0, 2.0})
    if (seed < trials_of_noise)
      add(fmt::format("noise {}", noise), own,
          image_of(truth.state, noise * pixel, OutlineSeen::meridian, other += 10000));
  if (seed >= trials_of_parts)
    return text;
  Case seen = own;
  seen.fit.outline = OutlineSeen::silhouette;
  const Contour outline = image_of(truth.state, pixel / 2, OutlineSeen::silhouette, seed);
  add("silhouette", seen, outline);
  std::mt19937_64 random(seed + 5000);
  const double speed = truth.state.unknowns[2 * truth.state.system->nodes()] *
                       (1 + 0.01 * std::normal_distribution<double>()(random));
  Contour with_velocity = image;
  with_velocity.velocity = speed;
  add("velocity", own, with_velocity);
  with_velocity = outline;
  with_velocity.velocity = speed;
  add("silhouette and velocity", seen, with_velocity);
  Case no_prestress = known(truth, {radius_key, flow_key}, {true_law});
  no_prestress.capsule.inflation = 0;
  add("no pre-stress", no_prestress, image);
  Case no_bending = own;
  no_bending.membrane.bending_ratio = 1e-3;
  add("ten times the bending", no_bending, image);
  for (const std::string &law : law_names())
    if (law != true_law)
      add("as " + law, known(truth, three_unknowns, {law}), image);
  return text;
}

constexpr const char *laws_header = "capillary_number,inflation_known,aic_difference";

// The evidence for the true one of two laws at a flow, a = 0.9, inflation 3 %, with the inflation known or not.
std::string evidence(double flow, bool prestress_known) {
  Truth truth;
  truth.input.membrane.law = neo_hookean;
  truth.input.membrane.bending_ratio = 1e-4;
  truth.input.capsule.radius = 0.9;
  truth.input.flow.capillary_number = flow;
  truth.input.capsule.inflation = 0.03;
  truth.state = on_mesh(truth.input, 88, find_steady(truth.input, {}, {}));
  Case input = known(truth, prestress_known ? std::vector<std::string>{radius_key, flow_key} : three_unknowns,
                     {"neo-hookean", "skalak"});
  if (prestress_known)
    input.capsule.inflation = 0.03;
  const Contour image = image_of(truth.state, pixel / 2, OutlineSeen::meridian, 77);
  input.fit.noise = pixel / 2;
  FitStarts starts;
  const FitResult fit = fit_contours(input, std::span(&image, 1), starts, {});
  double difference = 0;
  for (const Candidate &candidate : fit.candidates)
    difference += (candidate.law == "skalak" ? 1 : -1) * candidate.aic;
  return fmt::format("{},{},{}\n", flow, prestress_known ? 1 : 0, difference);
}

struct Row {
  std::string variant, true_law, law;
  double flow, size, modulus, inflation, modulus_bar, seconds, steady_seconds;
  unsigned seed;
  int parachute, inside[3];
};

std::string trials_header() {
  return fmt::format("variant,{},{},steady_seconds", truth_head, row_head);
}

std::vector<Row> rows_of(const std::string &text) {
  const Rows table(trials_header(), text);
  std::vector<Row> rows;
  for (std::size_t k = 0; k < table.size(); ++k) {
    const auto value = [&](const char *column) { return table.value(k, column); };
    const auto whole = [&](const char *column) { return std::stoi(table.text(k, column)); };
    Row row{table.text(k, "variant"),
            table.text(k, "true_law"),
            table.text(k, "law"),
            value("capillary_number"),
            1,
            1,
            1,
            1,
            0,
            0,
            static_cast<unsigned>(whole("seed")),
            whole("parachute"),
            {0, 0, 0}};
    if (row.law != "failed") {
      row.size = value("size_error");
      row.modulus = value("modulus_error");
      row.inflation = value("inflation_error");
      row.modulus_bar = value("modulus_bar");
      row.seconds = value("cpu_seconds");
      row.steady_seconds = value("steady_seconds");
      const char *const inside[] = {"size_inside", "modulus_inside", "inflation_inside"};
      std::ranges::transform(inside, row.inside, whole);
    }
    rows.push_back(row);
  }
  return rows;
}

double quantile(std::vector<double> values, double part) {
  std::ranges::sort(values);
  return values.empty() ? 0 : values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

struct Spread {
  double median, p95, bias; // of the absolute value; the median itself
};
Spread spread_of(const std::vector<Row> &rows, double Row::*value) {
  std::vector<double> sizes, signed_values;
  for (const Row &row : rows) {
    sizes.push_back(std::abs(row.*value));
    signed_values.push_back(row.*value);
  }
  return {quantile(sizes, 0.5), quantile(sizes, 0.95), quantile(signed_values, 0.5)};
}

// Of how many the interval of the k-th value contains the truth.
double share_inside(const std::vector<Row> &rows, int k) {
  const auto inside = std::ranges::count_if(rows, [&](const Row &row) { return row.inside[k] == 1; });
  return static_cast<double>(inside) / static_cast<double>(rows.size());
}

double times_of_steady(const std::vector<Row> &rows) {
  std::vector<double> ratios;
  for (const Row &row : rows)
    ratios.push_back(row.seconds / row.steady_seconds);
  return quantile(ratios, 0.5);
}

// Errors and shares of each variant; standard errors of G by what is seen; and the numbers of the README.
void write_tables(const std::string &directory, const std::vector<Row> &rows, const auto &of) {
  Table table("variant,fits,size_median,size_95,size_bias,size_inside,modulus_median,modulus_95,modulus_bias,"
              "modulus_inside,inflation_median,inflation_95,inflation_bias,inflation_inside");
  std::vector<std::string> variants;
  for (const Row &row : rows)
    if (std::ranges::find(variants, row.variant) == variants.end())
      variants.push_back(row.variant);
  for (const std::string &variant : variants) {
    const std::vector<Row> here = of(variant, [](const Row &) { return true; });
    std::string line = fmt::format("{},{}", variant, here.size());
    int k = 0;
    for (const auto value : {&Row::size, &Row::modulus, &Row::inflation}) {
      const Spread spread = spread_of(here, value);
      line += fmt::format(",{:.3g},{:.3g},{:.3g},{:.4g}", spread.median, spread.p95, spread.bias,
                          share_inside(here, k++));
    }
    table.add(line);
  }
  table.write(directory + "/summary.csv");

  Table views("view,parachute,fits,modulus_bar");
  for (const int parachute : {1, 0})
    for (const char *view : {"law known", "velocity", "silhouette", "silhouette and velocity"}) {
      const auto here =
          of(view, [&](const Row &row) { return row.seed < trials_of_parts && row.parachute == parachute; });
      views.add(fmt::format("{},{},{},{:.4g}", view, parachute, here.size(),
                            spread_of(here, &Row::modulus_bar).median));
    }
  views.write(directory + "/views.csv");
}

// The smallest capillary number from which on the evidence is 20 to 1, of the rows of evidence().
double told_apart_from(const std::string &text, bool prestress_known) {
  double from = 1;
  const Rows rows(laws_header, text);
  for (std::size_t k = 0; k < rows.size(); ++k)
    if ((rows.text(k, "inflation_known") == "1") == prestress_known)
      from = rows.value(k, "aic_difference") < 2 * std::log(20.0)
                 ? 1
                 : std::min(from, rows.value(k, "capillary_number"));
  return from;
}

bool study(const std::string &directory, unsigned jobs) {
  std::vector<TextTask> tasks;
  for (unsigned seed = 0; seed < trials; ++seed)
    tasks.push_back({fmt::format("trial-{}", seed), [seed] { return trial(seed); }});
  for (int k = 2; k <= 10; ++k)
    for (const bool prestress_known : {false, true})
      tasks.push_back({fmt::format("evidence-{:.2f}-{}", 0.01 * k, prestress_known),
                       [k, prestress_known] { return evidence(0.01 * k, prestress_known); }});
  const std::vector<std::string> texts = make_all(directory, jobs, tasks);
  std::string all, laws_apart;
  for (std::size_t i = 0; i < texts.size(); ++i)
    (i < trials ? all : laws_apart) += texts[i];
  write_atomically(directory + "/trials.csv", trials_header() + "\n" + all);
  write_atomically(directory + "/laws.csv", fmt::format("{}\n{}", laws_header, laws_apart));

  const std::vector<Row> rows = rows_of(all);
  const auto of = [&](const std::string &variant, auto &&wanted) {
    std::vector<Row> found;
    for (const Row &row : rows)
      if (row.variant == variant && wanted(row))
        found.push_back(row);
    return found;
  };
  const auto any = [](const Row &) { return true; };
  write_tables(directory, rows, of);

  const std::vector<Row> own = of("law known", any);
  const std::vector<Row> parachutes = of("law known", [](const Row &row) { return row.parachute == 1; });
  const std::vector<Row> strong = of("laws", [](const Row &row) { return row.flow >= 0.06; });
  const auto right = std::ranges::count_if(strong, [](const Row &row) { return row.law == row.true_law; });
  const Spread size = spread_of(own, &Row::size), modulus = spread_of(own, &Row::modulus),
               of_parachutes = spread_of(parachutes, &Row::modulus),
               inflation = spread_of(own, &Row::inflation);
  const double share_right = static_cast<double>(right) / static_cast<double>(strong.size());
  const double inside[3] = {share_inside(own, 0), share_inside(own, 1), share_inside(own, 2)};
  const auto bias = [&](const std::string &variant) {
    return spread_of(of(variant, any), &Row::modulus).bias;
  };
  write_atomically(
      directory + "/summary.json",
      fmt::format("{{\"status\": \"reached\", \"failure\": null, \"message\": null,\n"
                  " \"size_error\": {},\n \"size_error_95\": {},\n \"modulus_error\": {},\n"
                  " \"modulus_error_95\": {},\n \"parachute_modulus_error\": {},\n"
                  " \"parachute_modulus_error_95\": {},\n \"inflation_error\": {},\n"
                  " \"inflation_error_95\": {},\n \"law_right\": {},\n \"size_inside\": {},\n"
                  " \"modulus_inside\": {},\n \"inflation_inside\": {},\n \"bias_without_prestress\": {},\n"
                  " \"bias_of_bending\": {},\n \"bias_as_neo_hookean\": {},\n \"bias_as_skalak\": {},\n"
                  " \"bias_as_hooke\": {},\n \"told_apart_from\": {},\n \"told_apart_from_with_inflation\": "
                  "{},\n \"error_estimate\": {{}}}}\n",
                  size.median, size.p95, modulus.median, modulus.p95, of_parachutes.median, of_parachutes.p95,
                  inflation.median, inflation.p95, share_right, inside[0], inside[1], inside[2],
                  bias("no pre-stress"), bias("ten times the bending"), bias("as neo-hookean"),
                  bias("as skalak"), bias("as generalised-hooke"), told_apart_from(laws_apart, false),
                  told_apart_from(laws_apart, true)));

  bool holds = true;
  const auto claim = [&](bool good, const std::string &text) { holds = check(good, text) && holds; };
  claim(size.median <= 1e-3,
        fmt::format("median error of the size {:.3g} %, of {} capsules; Quesada et al. .2 %",
                    100 * size.median, own.size()));
  claim(of_parachutes.median <= 1e-2,
        fmt::format("median error of G {:.3g} % of {} parachutes, 95 % below {:.3g} %; Quesada et al. 2.7 %",
                    100 * of_parachutes.median, parachutes.size(), 100 * of_parachutes.p95));
  claim(inflation.median <= 5e-3, fmt::format("median error of the inflation {:.3g}, 95 % below {:.3g}",
                                              inflation.median, inflation.p95));
  claim(share_right >= 0.95,
        fmt::format("the law is right in {} of {} capsules with eps >= .06", right, strong.size()));
  const char *names[3] = {"size", "G", "inflation"};
  for (int k = 0; k < 3; ++k)
    claim(inside[k] >= 0.85 && inside[k] <= 0.95,
          fmt::format("the 90 % interval of {} contains the truth in {:.1f} %", names[k], 100 * inside[k]));
  const double once = times_of_steady(own), next = times_of_steady(of("next image", any));
  claim(
      once <= 10,
      fmt::format("a fit from nothing costs {:.3g} times a steady state found from nothing (median)", once));
  claim(next <= 3, fmt::format("the fit of a next image costs {:.3g} times that (median)", next));
  return holds;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
