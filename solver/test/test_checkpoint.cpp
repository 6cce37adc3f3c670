// Checkpoints come back exactly, and damaged ones are named.
#include "output/checkpoint.hpp"
#include "random_checkpoint.hpp"
#include "temporary_directory.hpp"
#include <algorithm>
#include <array>
#include <bit>
#include <boost/test/unit_test.hpp>
#include <cmath>
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
  BOOST_TEST(read_checkpoint(directory.path, "other").of_another_run);
  BOOST_TEST(!has_foreign_checkpoint(directory.path));
  const auto saved = read_checkpoint(directory.path, "abc").run;
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
  const auto equal = [](const std::vector<Vector> &a, const std::vector<Vector> &b) {
    return std::ranges::equal(a, b, [](const Vector &x, const Vector &y) { return x == y; });
  };
  const StepMemory &memory = read.memory;
  BOOST_REQUIRE(memory.past.size() == written.memory.past.size());
  for (std::size_t i = 0; i < memory.past.size(); ++i) {
    const StepMemory::Point &point = memory.past[i], &expected = written.memory.past[i];
    BOOST_TEST(same(point.time, expected.time));
    BOOST_TEST(
        equal({point.state, point.load, point.rate, point.rate_at_state, point.further},
              {expected.state, expected.load, expected.rate, expected.rate_at_state, expected.further}));
  }
  BOOST_TEST(memory.order == 3u);
  BOOST_TEST(memory.steps_at_order == 2u);
  BOOST_TEST(same(memory.step, written.memory.step));
  BOOST_TEST(same(memory.left_over, written.memory.left_over));
  BOOST_TEST((memory.mobility.at == written.memory.mobility.at));
  BOOST_TEST(memory.mobility.age == 7);
  BOOST_TEST((memory.load_jacobian.at == written.memory.load_jacobian.at));
  BOOST_TEST(memory.load_jacobian.age == 5);
  BOOST_TEST(same(memory.factored, written.memory.factored));
  const auto &[velocity, traction] = read.recycled;
  BOOST_TEST((velocity.inverse == written.recycled.velocity.inverse));
  BOOST_TEST(equal(velocity.positions, written.recycled.velocity.positions));
  BOOST_TEST(traction.inverse.size() == 0);
  BOOST_TEST(equal(traction.solutions, written.recycled.traction.solutions));
  BOOST_TEST(read.next_x_g == 4u);
  BOOST_TEST(read.next_time == 6u);
  BOOST_TEST(same(read.checked, written.checked));
  BOOST_REQUIRE(read.companion.size() == 1u);
  BOOST_TEST((read.companion[0].position == written.companion[0].position));
}

// A byte anywhere counts, as one digest covers them all: every seventh is tried.
BOOST_AUTO_TEST_CASE(damaged_checkpoint_is_said_to_be_one) {
  const TemporaryDirectory directory;
  const FoundCheckpoint none = read_checkpoint(directory.path, "abc");
  BOOST_TEST((!none.run && !none.of_another_run && none.damage.empty()));
  Checkpoint checkpoint = random_checkpoint();
  checkpoint.series.resize(1);
  checkpoint.profiles.clear();
  write_checkpoint(directory.path, "abc", {checkpoint, {}});
  const std::string text = content_of(directory.path / "checkpoint.json");
  constexpr std::size_t stride = 7;
  for (std::size_t k = text.find("run"); k + 3 < text.size(); k += stride) {
    std::string damaged = text;
    damaged[k] = damaged[k] == '1' ? '2' : '1';
    directory.write("checkpoint.json", damaged);
    BOOST_TEST(!read_checkpoint(directory.path, "abc").damage.empty());
  }
  directory.write("checkpoint.json", text.substr(0, 100));
  BOOST_TEST(read_checkpoint(directory.path, "abc").damage == "it is not valid JSON (byte 101)");
  directory.write("checkpoint.json", "{\"identity\":\"abc\"}");
  BOOST_TEST(read_checkpoint(directory.path, "abc").damage == "an entry is missing");
  BOOST_TEST(!has_foreign_checkpoint(directory.path));
  directory.write("checkpoint.json", "mine");
  BOOST_TEST(has_foreign_checkpoint(directory.path));
  checkpoint.position[3] = std::nan("");
  write_checkpoint(directory.path, "abc", {checkpoint, {}});
  BOOST_TEST(!read_checkpoint(directory.path, "abc").damage.empty());
}
