#include "base/heap.hpp"
#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace capsule {

void keep_freed_memory() {
#if defined(M_MMAP_THRESHOLD) && defined(M_TRIM_THRESHOLD)
  constexpr int large = 1 << 28; // bytes
  mallopt(M_MMAP_THRESHOLD, large);
  mallopt(M_TRIM_THRESHOLD, large);
#endif
}

} // namespace capsule
