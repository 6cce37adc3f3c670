#pragma once
// What a fit leaves on disk, each file whole or not at all (atomic_file.hpp):
//   fit.json       values, standard errors, 90 % intervals, correlations, candidates, warnings
//   fit.csv        the same values, a row for each fit
//   profiles.csv   the fitted shape of each contour, as that of a run; `time` counts the contours
//   points.csv     the points of the contours beside it, with their distances
//   population.csv, histogram.csv   of many fits: how their values are spread
// Every function throws FileError.
#include "fit/fit.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace capsule {

// A fit, or why there is none.
struct FitOutcome {
  FitResult result;
  std::string failure;
  double cpu_seconds = 0;
};

// Throws FileError, too, if one of these files is there and not of a fit.
void write_fit(const std::filesystem::path &directory, const std::string &identity,
               std::span<const Contour> contours, const FitOutcome &outcome);

// What fit.json says of a fit; none if there is none, or one of another identity.
struct FitRow {
  std::string name; // of the contour
  std::string law, failure;
  std::vector<FittedValue> values;
  double residual = 0, noise = 0;
  std::size_t warnings = 0;
};
std::optional<FitRow> read_fit(const std::filesystem::path &directory, const std::string &identity);

// fit.csv, and for several fits population.csv and histogram.csv.
void write_fit_tables(const std::filesystem::path &directory, const std::vector<FitRow> &rows);

} // namespace capsule
