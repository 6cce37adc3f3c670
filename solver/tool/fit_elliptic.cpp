// Prints elliptic_coefficients.hpp: minimax approximations of the complete elliptic integrals B, C, D.
//     F(m1) = P(m1) + W(m1) Q(m1) on 0 < m1 <= 1, least largest relative error of the whole sum
// W = -ln(m1); for C it lacks the first two terms of its series at m1 = 1, without which P and W Q would be
// large and cancel there. The exchange algorithm of Remez applies as it stands: 1, x, x ln x, x^2, x^2 ln x
// ... is a Chebyshev system.
// The limits m1 -> 0 are imposed: P(0), Q(0), and Q'(0) = -1/4 for B. So the relative error vanishes there,
// and the strong singularities of the kernels' logarithmic parts cancel on paper.
// Also the polynomial of the natural logarithm, ln((1 + s)/(1 - s)) = s P(s^2) for s^2 <= 0.04. Takes a
// minute.
#include <boost/multiprecision/cpp_dec_float.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_dec_float<120>, boost::multiprecision::et_off>;
using Reals = std::vector<Real>;

Real pi() {
  return 4 * atan(Real(1));
}

struct Integrals {
  Real b;
  Real c;
  Real d;
};

// Arithmetic-geometric mean; the digits lost in the differences are far below the 120 carried.
Integrals elliptic_integrals(const Real &m1) {
  if (m1 == 1) {
    return {pi() / 4, pi() / 16, pi() / 4};
  }
  const Real m = 1 - m1;
  Real a = 1;
  Real g = sqrt(m1);
  Real sum = m / 2;
  Real power = 1;
  for (int i = 0; i < 12; ++i) {
    const Real difference = (a - g) / 2;
    const Real mean = (a + g) / 2;
    g = sqrt(a * g);
    a = mean;
    sum += power * difference * difference;
    power *= 2;
  }
  const Real k = pi() / (2 * a);
  const Real e = k * (1 - sum);
  const Real b = (e - m1 * k) / m;
  const Real d = (k - e) / m;
  return {b, (d - b) / m, d};
}

using Function = std::function<Real(const Real &)>;

// A power of P, or of Q if `weighted`.
struct Term {
  int power;
  bool weighted;
};

struct Problem {
  Real end; // of the range of x, which starts at 0
  Function function;
  Function weight;
  std::vector<std::pair<Term, Real>> imposed;
  std::vector<Term> free;

  Real value(const Term &term, const Real &x) const {
    const Real monomial = pow(x, term.power);
    return term.weighted ? Real(weight(x) * monomial) : monomial;
  }

  Real remainder(const Real &x) const {
    Real rest = function(x);
    for (const auto &[term, coefficient] : imposed) {
      rest -= coefficient * value(term, x);
    }
    return rest;
  }
};

Reals solve(std::vector<Reals> matrix, Reals right) {
  const std::size_t n = right.size();
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < n; ++row) {
      if (abs(matrix[row][column]) > abs(matrix[pivot][column])) {
        pivot = row;
      }
    }
    std::swap(matrix[column], matrix[pivot]);
    std::swap(right[column], right[pivot]);
    for (std::size_t row = column + 1; row < n; ++row) {
      const Real factor = matrix[row][column] / matrix[column][column];
      for (std::size_t j = column; j < n; ++j) {
        matrix[row][j] -= factor * matrix[column][j];
      }
      right[row] -= factor * right[column];
    }
  }
  for (std::size_t row = n; row-- > 0;) {
    for (std::size_t j = row + 1; j < n; ++j) {
      right[row] -= matrix[row][j] * right[j];
    }
    right[row] /= matrix[row][row];
  }
  return right;
}

// What a point of the grid costs to know, kept from one exchange to the next.
struct Sample {
  Real x;
  Real function;
  Real remainder;
  Reals terms;
};

struct Fit {
  Reals coefficients;
  Real error;
};

Real relative_error(const Sample &sample, const Reals &coefficients) {
  Real rest = sample.remainder;
  for (std::size_t i = 0; i < sample.terms.size(); ++i) {
    rest -= coefficients[i] * sample.terms[i];
  }
  return rest / sample.function;
}

// The largest error of each run of equal signs.
std::vector<std::size_t> alternating_extrema(const std::vector<Real> &errors) {
  std::vector<std::size_t> extrema{0};
  for (std::size_t i = 1; i < errors.size(); ++i) {
    if ((errors[i] > 0) != (errors[extrema.back()] > 0)) {
      extrema.push_back(i);
    } else if (abs(errors[i]) > abs(errors[extrema.back()])) {
      extrema.back() = i;
    }
  }
  return extrema;
}

Fit remez(const Problem &problem) {
  const std::size_t unknowns = problem.free.size();
  const int grid = 6000;
  std::vector<Sample> samples;
  for (int i = 1; i <= grid; ++i) {
    const Real u = (1 - cos(pi() * i / grid)) / 2;
    const Real x = problem.end * u * u * u;
    Sample sample{x, problem.function(x), problem.remainder(x), {}};
    for (const Term &term : problem.free) {
      sample.terms.push_back(problem.value(term, x));
    }
    samples.push_back(std::move(sample));
  }
  std::vector<std::size_t> reference;
  for (std::size_t i = 0; i <= unknowns; ++i) {
    reference.push_back((samples.size() - 1) * (2 * i + 1) / (2 * unknowns + 1));
  }
  reference.back() = samples.size() - 1;
  Fit best;
  for (int exchange = 0; exchange < 30; ++exchange) {
    std::vector<Reals> matrix;
    Reals right;
    for (std::size_t i = 0; i <= unknowns; ++i) {
      const Sample &sample = samples[reference[i]];
      Reals row = sample.terms;
      row.push_back(i % 2 == 0 ? sample.function : Real(-sample.function));
      matrix.push_back(std::move(row));
      right.push_back(sample.remainder);
    }
    Reals solution = solve(std::move(matrix), std::move(right));
    const Real level = abs(solution.back());
    solution.pop_back();
    std::vector<Real> errors;
    Real largest = 0;
    for (const Sample &sample : samples) {
      errors.push_back(relative_error(sample, solution));
      largest = std::max(largest, Real(abs(errors.back())));
    }
    best = {solution, largest};
    if (largest < level * Real(1.0001)) {
      break;
    }
    std::vector<std::size_t> extrema = alternating_extrema(errors);
    while (extrema.size() > unknowns + 1) {
      const bool drop_first = abs(errors[extrema.front()]) < abs(errors[extrema.back()]);
      extrema.erase(drop_first ? extrema.begin() : extrema.end() - 1);
    }
    if (extrema.size() <= unknowns) {
      throw std::runtime_error("the error does not alternate often enough");
    }
    reference = std::move(extrema);
  }
  return best;
}

void print_array(const std::string &name, const Reals &values) {
  std::printf("inline constexpr std::array<double, %zu> %s{\n", values.size(), name.c_str());
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::printf("    %.17g%s\n", static_cast<double>(values[i]), i + 1 < values.size() ? "," : "};");
  }
}

struct Polynomials {
  Reals p;
  Reals q;
  Real error;
};

// The imposed coefficients are the first ones of each polynomial.
Polynomials fit(const Real &end, const Function &function, const Function &weight, Reals p, int p_degree,
                Reals q, int q_degree) {
  Problem problem{end, function, weight, {}, {}};
  for (const bool weighted : {false, true}) {
    const Reals &imposed = weighted ? q : p;
    for (int i = 0; i <= (weighted ? q_degree : p_degree); ++i) {
      if (i < static_cast<int>(imposed.size())) {
        problem.imposed.emplace_back(Term{i, weighted}, imposed[i]);
      } else {
        problem.free.push_back({i, weighted});
      }
    }
  }
  const Fit best = remez(problem);
  for (std::size_t i = 0; i < problem.free.size(); ++i) {
    (problem.free[i].weighted ? q : p).push_back(best.coefficients[i]);
  }
  return {std::move(p), std::move(q), best.error};
}

void print_integral(const std::string &name, const Polynomials &polynomials) {
  std::printf("\n// %s: relative error %.1e before rounding.\n", name.c_str(),
              static_cast<double>(polynomials.error));
  print_array(name + "_smooth", polynomials.p);
  print_array(name + "_logarithmic", polynomials.q);
}

void print_header() {
  const Real ln4 = 2 * log(Real(2));
  const Real half = Real(1) / 2;
  const Function logarithm = [](const Real &x) { return Real(-log(x)); };
  const Function late_logarithm = [&](const Real &x) {
    return Real(-log(x) - (1 - x) - half * (1 - x) * (1 - x));
  };
  const Function b = [](const Real &m1) { return elliptic_integrals(m1).b; };
  const Function c = [](const Real &m1) { return elliptic_integrals(m1).c; };
  const Function d = [](const Real &m1) { return elliptic_integrals(m1).d; };
  std::puts("#pragma once\n"
            "// Coefficients of elliptic.hpp, rising powers. Written by tool/fit_elliptic.cpp.\n"
            "// clang-format off\n"
            "#include <array>\n\n"
            "namespace capsule::elliptic_coefficients {");
  print_integral("b", fit(1, b, logarithm, {Real(1)}, 10, {Real(0), -half / 2}, 11));
  print_integral("c", fit(1, c, late_logarithm, {ln4 - 2 + 3 * half * half}, 12, {half}, 10));
  print_integral("d", fit(1, d, logarithm, {ln4 - 1}, 10, {half}, 10));

  const Function area_tangent = [](const Real &z) { return Real(2 * atanh(sqrt(z)) / sqrt(z)); };
  const Polynomials natural_logarithm = fit(Real(1) / 25, area_tangent, logarithm, {Real(2)}, 7, {}, -1);
  std::printf("\n// ln((1 + s)/(1 - s))/s in powers of s^2: relative error %.1e before rounding.\n",
              static_cast<double>(natural_logarithm.error));
  print_array("natural_logarithm", natural_logarithm.p);
  std::puts("\n} // namespace capsule::elliptic_coefficients");
}

} // namespace

int main() {
  try {
    print_header();
  } catch (const std::exception &error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
