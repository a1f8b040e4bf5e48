#pragma once
// Address space for the buffers of BLAS. OpenBLAS, which MUMPS is linked with, reserves 128 MB for
// each of its threads at the first call, and retries forever if the process may not have it
// (`ulimit -v`). Therefore the available space is checked before it is loaded.
#include <cstddef>

namespace floatframe {

/// Of each thread [byte].
inline constexpr std::size_t blas_buffer_size = std::size_t{128} << 20;

/// Before BLAS is loaded. True if the process may reserve enough for all threads; if there is only
/// enough for one thread, sets the environment variable OPENBLAS_NUM_THREADS.
bool reserve_blas_room();

/// Immediately after dlopen has loaded it, as `handle` or as a dependency: makes it allocate the
/// buffer of the calling thread, which it keeps.
void warm_blas(void* handle);

}  // namespace floatframe
