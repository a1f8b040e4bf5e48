#pragma once
// Room for the buffers of BLAS. OpenBLAS, which MUMPS is linked with, takes 128 MB of addresses for
// each of its threads at the first call, and where the process has none (`ulimit -v`) it asks again
// without end. So the room is looked for before it is loaded.
#include <cstddef>

namespace floatframe {

/// Of each thread [byte].
inline constexpr std::size_t blas_buffer_size = std::size_t{128} << 20;

/// Before BLAS is loaded. True if the process may take as many addresses as its threads will; where
/// there is only room for one thread the environment says so to it (OPENBLAS_NUM_THREADS).
bool reserve_blas_room();

/// Right after it was loaded by dlopen, as `handle` or something that it needs: makes it take its
/// buffer of the calling thread, which it keeps.
void warm_blas(void* handle);

}  // namespace floatframe
