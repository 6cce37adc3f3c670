// Checkpoints come back exactly, and damaged ones are named.
#include "output/checkpoint.hpp"
#include "random_checkpoint.hpp"
#include "temporary_directory.hpp"
#include <array>
#include <bit>
#include <boost/test/unit_test.hpp>
#include <cstdint>

using namespace capsule;

namespace {

// The same bits, also of infinities and signed zeros.
bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

} // namespace

BOOST_AUTO_TEST_CASE(checkpoint_comes_back_bit_by_bit) {
  const TemporaryDirectory directory;
  const Checkpoint written = random_checkpoint();
  write_checkpoint(directory.path, "abc", {written, {"2002-01-01T00:00:00Z", 0.1, 0.3}});
  BOOST_TEST(!read_checkpoint(directory.path, "other"));
  const auto saved = read_checkpoint(directory.path, "abc");
  BOOST_REQUIRE(saved);
  BOOST_TEST(saved->effort.started == "2002-01-01T00:00:00Z");
  BOOST_TEST(saved->effort.cpu_seconds == 0.1);
  BOOST_TEST(saved->effort.wall_seconds == 0.3);
  const Checkpoint &read = saved->checkpoint;
  BOOST_TEST(same(read.time, written.time));
  BOOST_TEST(read.steps == written.steps);
  BOOST_TEST((read.position.array() == written.position.array()).all());
  BOOST_REQUIRE(read.series.size() == written.series.size());
  for (std::size_t i = 0; i < read.series.size(); ++i) {
    const auto bits = [](const SeriesRow &row) {
      return std::bit_cast<std::array<std::uint64_t, RowNumbers{}.size()>>(row);
    };
    BOOST_TEST((bits(read.series[i]) == bits(written.series[i])));
  }
  BOOST_REQUIRE(read.profiles.size() == written.profiles.size());
  for (std::size_t i = 0; i < read.profiles.size(); ++i) {
    BOOST_TEST(same(read.profiles[i].x_g, written.profiles[i].x_g));
    BOOST_TEST(same(read.profiles[i].time, written.profiles[i].time));
    for (const auto field : profile_fields)
      BOOST_TEST(((read.profiles[i].*field).array() == (written.profiles[i].*field).array()).all());
  }
}

BOOST_AUTO_TEST_CASE(damaged_checkpoint_is_named) {
  const TemporaryDirectory directory;
  BOOST_TEST(!read_checkpoint(directory.path, "abc"));
  const auto file = directory.write("checkpoint.json", "{\"identity\": \"abc\", \"time\": ");
  BOOST_TEST(failure_of([&] { read_checkpoint(directory.path, "abc"); }).find(file.string()) !=
             std::string::npos);
  directory.write("checkpoint.json", "{\"identity\": \"abc\"}");
  BOOST_TEST(failure_of([&] { read_checkpoint(directory.path, "abc"); }).find("--fresh") !=
             std::string::npos);
}
