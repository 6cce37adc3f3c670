#pragma once
// Throws nothing.

namespace capsule {

// A flow allocates matrices of half a megabyte, and there are thousands of flows in a run: memory that is freed stays with the
// program. Otherwise the C library may give it back each time, and the system clears it again page by page. Does nothing
// where the library has no such setting.
void keep_freed_memory();

} // namespace capsule
