// OpenBLAS picks its kernels by the processor's model when it is loaded. It takes a model that is newer than itself for
// the oldest of all, at a quarter of the speed of dense products: version 0.3.21 does so on processors of 2023. Then
// every program of the project begins again, once, with the kernels that the processor's instructions allow.
// OPENBLAS_CORETYPE, which names them, is not touched where the user has set it.
#include <array>
#include <cblas.h>
#include <cstdlib>
#include <cstring>
#include <unistd.h>

namespace {

// For the processor's instructions; null if the oldest kernels are right, or not known to be wrong.
const char *better_kernels() {
#ifdef __x86_64__
  if (std::strcmp(openblas_get_corename(), "Prescott") != 0)
    return nullptr;
  if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
      __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0)
    return "SkylakeX";
  if (__builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0)
    return "Haswell";
#endif
  return nullptr;
}

// Before main, which the linker's constructors allow with the arguments of the program.
[[gnu::constructor]] void choose_kernels(int /*count*/, char **arguments, char ** /*environment*/) {
  constexpr const char *variable = "OPENBLAS_CORETYPE";
  const char *kernels = std::getenv(variable) == nullptr ? better_kernels() : nullptr;
  std::array<char, 4096> program{}; // its own path: the process keeps its name
  if (kernels != nullptr && readlink("/proc/self/exe", program.data(), program.size() - 1) > 0 &&
      setenv(variable, kernels, 0) == 0)
    execv(program.data(), arguments); // where this fails, the program goes on with the slow ones
}

} // namespace
