// Time per ring of every kernel and instruction set that runs here, for a row of the paper's size and for one
// panel.
#include "integrals/ring_kernel.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

using namespace capsule;

namespace {

// A half circle of rings and two rows of results; the target moves a little from call to call.
struct Row {
  std::vector<double> x, r, normal_x, normal_r, results;
  explicit Row(int count) : results(8 * static_cast<std::size_t>(count)) {
    for (int k = 0; k < count; ++k) {
      const double zeta = 3.14 * (k + 0.5) / count;
      normal_x.push_back(-std::cos(zeta));
      normal_r.push_back(std::sin(zeta));
      x.push_back(0.8 * normal_x.back());
      r.push_back(0.8 * normal_r.back());
    }
  }
  Rings rings() const {
    return {static_cast<int>(x.size()), x.data(), r.data(), normal_x.data(), normal_r.data()};
  }
  KernelRow out(std::size_t part) {
    const std::size_t n = x.size();
    double *first = results.data() + 4 * part * n;
    return {first, first + n, first + 2 * n, first + 3 * n};
  }
};

using Call = std::function<void(double x0, double r0, Row &row)>;

void add(const std::string &name, const Call &call) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [call](benchmark::State &state) {
                                 Row row(static_cast<int>(state.range(0)));
                                 double x0 = 0;
                                 for ([[maybe_unused]] auto _ : state) {
                                   call(x0, 0.5, row);
                                   x0 += 1e-9;
                                   benchmark::ClobberMemory();
                                 }
                                 state.counters["time_per_ring"] =
                                     benchmark::Counter(static_cast<double>(state.range(0)),
                                                        benchmark::Counter::kIsIterationInvariantRate |
                                                            benchmark::Counter::kInvert);
                               })
      ->Arg(960)
      ->Arg(12);
}

} // namespace

int main(int argc, char **argv) {
  for (const RingKernels &kernels : available_ring_kernels()) {
    add("stokeslet/" + kernels.instructions, [kernels](double x0, double r0, Row &row) {
      kernels.stokeslet.plain(x0, r0, row.rings(), row.out(0));
    });
    add("stresslet/" + kernels.instructions, [kernels](double x0, double r0, Row &row) {
      kernels.stresslet.plain(x0, r0, row.rings(), row.out(0));
    });
    add("both/" + kernels.instructions, [kernels](double x0, double r0, Row &row) {
      kernels.stokeslet.plain(x0, r0, row.rings(), row.out(0));
      kernels.stresslet.plain(x0, r0, row.rings(), row.out(1));
    });
    add("stokeslet_split/" + kernels.instructions, [kernels](double x0, double r0, Row &row) {
      kernels.stokeslet.split(r0, row.rings(), separations(x0, r0, row.rings()), row.out(0), row.out(1));
    });
    add("stresslet_split/" + kernels.instructions, [kernels](double x0, double r0, Row &row) {
      kernels.stresslet.split(r0, row.rings(), separations(x0, r0, row.rings()), row.out(0), row.out(1));
    });
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
