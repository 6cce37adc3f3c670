// Reasons to stop a march, each on a row that gives it, and their order.
#include "base/failure.hpp"
#include "motion/stops.hpp"
#include <boost/test/unit_test.hpp>
#include <set>

using namespace capsule;

namespace {

SeriesRow sound_row() {
  SeriesRow row;
  row.min_film = 0.1;
  row.max_stretch = 1.5;
  row.dents = 1;
  row.roughness = 0.1;
  row.volume_change = 1e-6;
  return row;
}

// The kind of the failure, or nothing.
std::string stopped_by(const SeriesRow &row, double roughness_limit = wrinkle_roughness,
                       bool crossing = false, bool bursts = false) {
  try {
    throw_if_stopped(
        {.row = row, .crosses_itself = crossing, .roughness_limit = roughness_limit, .bursts = bursts});
    return "";
  } catch (const NumericsFailure &failure) {
    BOOST_TEST(failure.what() != std::string());
    BOOST_TEST(failure.advice != "");
    return failure.kind;
  }
}

} // namespace

BOOST_AUTO_TEST_SUITE(stops_of_a_march)

// "A smaller accuracy" may be read either way.
BOOST_AUTO_TEST_CASE(advice_has_one_meaning) {
  for (const Stop &stop : stops())
    for (const char *unclear : {"smaller accuracy", "larger accuracy", "higher accuracy", "lower accuracy"})
      BOOST_TEST(std::string(stop.advice).find(unclear) == std::string::npos, stop.kind);
}

BOOST_AUTO_TEST_CASE(each_reason_stops_and_nothing_else) {
  SeriesRow row = sound_row();
  BOOST_TEST(stopped_by(row) == "");
  BOOST_TEST(stopped_by(row, wrinkle_roughness, true) == "self-contact");
  row.min_film = -1e-12;
  BOOST_TEST(stopped_by(row) == "touching");
  for (const double change : {-0.02, 0.02}) {
    row = sound_row();
    row.volume_change = change;
    BOOST_TEST(stopped_by(row) == "volume");
  }
  row = sound_row();
  BOOST_TEST(stopped_by(row, wrinkle_roughness, false, true) == "burst");
  row.max_stretch = 4.01;
  BOOST_TEST(stopped_by(row) == "unbounded");
}

BOOST_AUTO_TEST_CASE(a_law_that_softens_stops_a_march) {
  const SeriesRow row = sound_row();
  const auto stops_at = [&](double stiffness) {
    try {
      throw_if_stopped({.row = row, .softest = SoftestPoint{stiffness, 0.6, 0.9}});
      return std::string();
    } catch (const NumericsFailure &failure) {
      return failure.kind;
    }
  };
  BOOST_TEST(stops_at(1e-9) == "");
  BOOST_TEST(stops_at(-1e-9) == "softening");
}

// Three dents, and rough: neither alone. What counts as rough is the march's, and the companion has no limit.
BOOST_AUTO_TEST_CASE(wrinkles_are_dents_that_the_mesh_does_not_resolve) {
  SeriesRow row = sound_row();
  row.roughness = 0.3;
  BOOST_TEST(stopped_by(row, 0.2) == "");
  row.dents = 3;
  BOOST_TEST(stopped_by(row, 0.2) == "wrinkled");
  BOOST_TEST(stopped_by(row, 0.4) == "");
  BOOST_TEST(stopped_by(row, Instant{.row = row}.roughness_limit) == "");
  BOOST_TEST(wrinkle_roughness_on_chosen_nodes(1e-3) < wrinkle_roughness_on_chosen_nodes(1e-2));
  BOOST_TEST(wrinkle_roughness_on_chosen_nodes(0.5) == wrinkle_roughness);
}

// Where several reasons meet, the one that explains the others is told: a membrane beyond the wall before a crossing,
// a crossing before the volume that it spoils, wrinkles before a stretch that they feign.
BOOST_AUTO_TEST_CASE(the_first_reason_is_told) {
  SeriesRow row = sound_row();
  row.max_stretch = 5;
  row.dents = 5;
  row.roughness = 0.9;
  BOOST_TEST(stopped_by(row) == "wrinkled");
  BOOST_TEST(stopped_by(row, wrinkle_roughness, false, true) == "wrinkled");
  row.volume_change = 0.1;
  BOOST_TEST(stopped_by(row) == "volume");
  BOOST_TEST(stopped_by(row, wrinkle_roughness, true) == "self-contact");
  row.min_film = 0;
  BOOST_TEST(stopped_by(row, wrinkle_roughness, true) == "touching");
}

BOOST_AUTO_TEST_CASE(kinds_are_different_words) {
  std::set<std::string> kinds;
  for (const Stop &stop : stops())
    kinds.insert(stop.kind);
  BOOST_TEST(kinds.size() == stops().size());
}

BOOST_AUTO_TEST_CASE(what_a_membrane_bears) {
  const LargestStrain strain{.area_stretch = 1.5, .area_stretch_S = 0, .tension = 0.8, .tension_S = 0};
  const auto beyond = [&](std::optional<double> area_stretch, std::optional<double> tension) {
    UntilSpec limits;
    limits.area_stretch = area_stretch;
    limits.tension = tension;
    return beyond_bearing(limits, strain);
  };
  BOOST_TEST(beyond({}, {}) < 0);
  BOOST_TEST(beyond(1.6, 0.9) < 0);
  BOOST_TEST(beyond(1.5, {}) == 0);
  BOOST_TEST(beyond(1.6, 0.7) > 0);
  BOOST_TEST(beyond(1.4, 0.9) > 0);
}

BOOST_AUTO_TEST_SUITE_END()
