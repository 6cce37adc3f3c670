#include <boost/test/unit_test.hpp>
#include <cblas.h>
#include <cstdlib>
#include <string>

BOOST_AUTO_TEST_SUITE(blas_kernels)

// A processor with wide vectors does not get the kernels of the oldest one, whatever the library knows of its model.
BOOST_AUTO_TEST_CASE(kernels_suit_the_processor) {
#ifdef __x86_64__
  const bool wide = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
#else
  const bool wide = false;
#endif
  const char *chosen = std::getenv("OPENBLAS_CORETYPE");
  const bool by_user = chosen != nullptr && std::string(chosen) == "Prescott";
  if (wide && !by_user)
    BOOST_TEST(openblas_get_corename() != std::string("Prescott"));
}

BOOST_AUTO_TEST_SUITE_END()
