#pragma once
// A checkpoint of random numbers of every magnitude, the same each time.
#include "observe/outcome.hpp"
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace capsule {

// All fields, also those that are added later.
using RowNumbers = std::array<double, sizeof(SeriesRow) / sizeof(double)>;
inline constexpr std::array profile_fields{&Profile::S,
                                           &Profile::x,
                                           &Profile::r,
                                           &Profile::stretch_meridional,
                                           &Profile::stretch_azimuthal,
                                           &Profile::tension_meridional,
                                           &Profile::tension_azimuthal,
                                           &Profile::moment_meridional,
                                           &Profile::moment_azimuthal,
                                           &Profile::curvature_meridional,
                                           &Profile::curvature_azimuthal,
                                           &Profile::velocity_x,
                                           &Profile::velocity_r};
static_assert(sizeof(Profile) == 2 * sizeof(double) + profile_fields.size() * sizeof(Vector));

inline Vector random_vector(Eigen::Index size, std::mt19937 &random) {
  std::normal_distribution<double> normal(0, 1);
  return Vector::NullaryExpr(size, [&] { return normal(random); });
}

inline Checkpoint random_checkpoint() {
  std::mt19937 random(20);
  std::normal_distribution<double> normal(0, 1);
  const auto number = [&] { return normal(random) * std::pow(10, 20 * normal(random)); };
  Checkpoint checkpoint;
  checkpoint.time = number();
  checkpoint.steps = 1234567;
  checkpoint.position = random_vector(6, random);
  for (int i = 0; i < 5; ++i) {
    RowNumbers row{};
    std::ranges::generate(row, number);
    checkpoint.series.push_back(std::bit_cast<SeriesRow>(row));
  }
  checkpoint.series[2].min_film = std::numeric_limits<double>::infinity();
  checkpoint.series[3].pressure_drop = -0.0;
  for (const Eigen::Index points : {7, 3}) {
    Profile profile{number(), number(), {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
    for (const auto field : profile_fields)
      profile.*field = random_vector(points, random);
    checkpoint.profiles.push_back(profile);
  }
  checkpoint.followers = {{{checkpoint.series[4], checkpoint.series[1]}, {checkpoint.profiles[1]}}, {}};
  checkpoint.memory.past = {{number(), random_vector(6, random), random_vector(6, random),
                             random_vector(6, random), random_vector(4, random)},
                            {number(), random_vector(6, random), {}, random_vector(6, random), {}, {}}};
  checkpoint.memory.order = 3;
  checkpoint.memory.steps_at_order = 2;
  checkpoint.memory.step = number();
  checkpoint.memory.left_over = number();
  checkpoint.memory.mobility = {random_vector(6, random), 7};
  checkpoint.memory.load_jacobian = {random_vector(6, random), 5};
  checkpoint.memory.factored = number();
  checkpoint.recycled.velocity.inverse = random_vector(9, random).reshaped(3, 3);
  checkpoint.recycled.velocity.positions = {random_vector(4, random)};
  checkpoint.recycled.traction.solutions = {random_vector(4, random), random_vector(2, random)};
  checkpoint.next_x_g = 4;
  checkpoint.next_time = 6;
  checkpoint.checked = number();
  checkpoint.companion.resize(1);
  checkpoint.companion[0].position = random_vector(4, random);
  return checkpoint;
}

} // namespace capsule
