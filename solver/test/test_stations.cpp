// Where rows are due.
#include "motion/stations.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

using namespace capsule;

BOOST_AUTO_TEST_SUITE(stations_of_a_march)

BOOST_AUTO_TEST_CASE(multiples_of_the_spacing_and_the_end) {
  const std::vector<Station> list = stations(-0.12, 0.05, 0.13, {});
  BOOST_REQUIRE(list.size() == 6u); // -0.1, -0.05, 0, 0.05, 0.1, 0.13
  for (std::size_t k = 0; k + 1 < list.size(); ++k) {
    BOOST_TEST(std::abs(list[k].value - (-0.1 + 0.05 * static_cast<double>(k))) < 1e-15);
    BOOST_TEST((list[k].regular && !list[k].profile && !list[k].end));
  }
  BOOST_TEST(list.back().value == 0.13);
  BOOST_TEST((list.back().regular && list.back().profile && list.back().end));
}

// A profile near to a row that is due anyway takes its place, with the value that was asked for to the last digit.
BOOST_AUTO_TEST_CASE(a_profile_and_a_row_at_one_place_are_one) {
  const double asked = 0.1 + 1e-9;
  const std::vector<Station> list = stations(0, 0.05, 0.2, {0.07, asked, 0.3, -1});
  BOOST_REQUIRE(list.size() == 5u); // 0.05, 0.07, 0.1, 0.15, 0.2
  BOOST_TEST((list[1].value == 0.07 && list[1].profile && !list[1].regular));
  BOOST_TEST((list[2].value == asked && list[2].profile && list[2].regular));
}

BOOST_AUTO_TEST_CASE(without_an_end_only_profiles_are_due) {
  const std::vector<Station> list = stations(0, 0.05, {}, {3, 1, -2});
  BOOST_REQUIRE(list.size() == 2u);
  BOOST_TEST((list[0].value == 1 && list[1].value == 3));
  BOOST_TEST((list[0].profile && !list[0].regular && !list[0].end));
}

BOOST_AUTO_TEST_CASE(profiles_at_multiples_of_a_distance) {
  const std::vector<Station> list = stations(-0.12, 0.05, 0.21, {0.03}, 0.1);
  std::vector<double> profiles;
  for (const Station &station : list)
    if (station.profile)
      profiles.push_back(station.value);
  BOOST_REQUIRE(profiles.size() == 6u);
  const std::vector<double> wanted{-0.1, 0, 0.03, 0.1, 0.2, 0.21};
  for (std::size_t k = 0; k < 6; ++k)
    BOOST_TEST(std::abs(profiles[k] - wanted[k]) < 1e-15);
  BOOST_TEST(list.size() == stations(-0.12, 0.05, 0.21, {0.03}).size());
}

// An interrupted march meets the rest of the same list.
BOOST_AUTO_TEST_CASE(from_a_later_place_the_rest_is_due) {
  const std::vector<double> profiles{-3.31, -2, 0.2500000001, 1.7};
  const std::vector<Station> whole = stations(-4, 0.05, 2.03, profiles);
  for (const double place : {-3.94, -2.0, -0.01, 0.2500000001, 1.99}) {
    const std::vector<Station> rest = stations(place, 0.05, 2.03, profiles);
    std::size_t k = whole.size() - rest.size();
    BOOST_TEST(whole[k].value > place);
    BOOST_TEST(whole[k - 1].value <= place);
    for (const Station &station : rest) {
      BOOST_TEST(station.value == whole[k].value);
      BOOST_TEST((station.profile == whole[k].profile && station.end == whole[k].end));
      ++k;
    }
  }
}

// That of exp(t) - 2. Where it is not between them the function is not asked.
BOOST_AUTO_TEST_CASE(a_crossing_is_the_root_between_two_times) {
  std::vector<double> asked;
  const auto ahead = [&](double time) {
    asked.push_back(time);
    return std::exp(time) - 2;
  };
  BOOST_TEST(std::abs(crossing_time(ahead, {0, -1}, {1, std::exp(1.0) - 2}) - std::log(2.0)) < 1e-12);
  BOOST_TEST(asked.size() < 10u);
  asked.clear();
  BOOST_TEST(crossing_time(ahead, {0.8, std::exp(0.8) - 2}, {1, std::exp(1.0) - 2}) == 0.8); // it lies before
  BOOST_TEST(std::isinf(crossing_time(ahead, {0, -1}, {0.5, std::exp(0.5) - 2})));           // it lies behind
  BOOST_TEST(asked.empty());
}

BOOST_AUTO_TEST_SUITE_END()
