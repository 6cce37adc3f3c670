// A flow allocates matrices of half a megabyte, and there are thousands of flows in a run: memory that is freed stays with the
// program. Otherwise the C library may give it back each time, and the system clears it again page by page. Does nothing
// where the library has no such setting.
#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace {

// Before main, in every program of the project.
[[gnu::constructor]] void keep_freed_memory() {
#if defined(M_MMAP_THRESHOLD) && defined(M_TRIM_THRESHOLD)
  constexpr int large = 1 << 28; // bytes
  mallopt(M_MMAP_THRESHOLD, large);
  mallopt(M_TRIM_THRESHOLD, large);
#endif
}

} // namespace
