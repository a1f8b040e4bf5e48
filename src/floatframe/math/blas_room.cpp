#include "floatframe/math/blas_room.hpp"

#include <dlfcn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace floatframe {
namespace {

/// The libraries, their memory and the stacks of two threads.
constexpr std::size_t beside_buffers = std::size_t{96} << 20;
constexpr std::size_t thread_stack = std::size_t{8} << 20;

bool can_take(std::size_t bytes) {
  void* const place =
      ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (place == MAP_FAILED) return false;
  ::munmap(place, bytes);
  return true;
}

std::size_t room_for(long threads) {
  return static_cast<std::size_t>(threads) * (blas_buffer_size + thread_stack) + beside_buffers;
}

/// The number of threads that OpenBLAS starts.
long blas_threads() {
  long threads = std::max(1L, ::sysconf(_SC_NPROCESSORS_ONLN));
  for (const char* name : {"OPENBLAS_NUM_THREADS", "GOTO_NUM_THREADS", "OMP_NUM_THREADS"})
    if (const char* const given = std::getenv(name))
      if (const long asked = std::strtol(given, nullptr, 10); asked > 0)
        return std::min(threads, asked);
  return threads;
}

}  // namespace

bool reserve_blas_room() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return true;
  if (can_take(room_for(blas_threads()))) return true;
  if (!can_take(room_for(1))) return false;
  ::setenv("OPENBLAS_NUM_THREADS", "1", 1);
  return true;
}

void warm_blas(void* handle) {
  // C = A B of one number: Fortran passes everything by reference.
  using Gemm = void (*)(const char*, const char*, const int*, const int*, const int*, const double*,
                        const double*, const int*, const double*, const int*, const double*,
                        double*, const int*);
  const auto gemm = reinterpret_cast<Gemm>(::dlsym(handle, "dgemm_"));
  if (gemm == nullptr) return;
  constexpr int n = 16;
  const double one = 1.0, zero = 0.0;
  double A[n * n] = {}, B[n * n] = {}, C[n * n] = {};
  gemm("N", "N", &n, &n, &n, &one, A, &n, B, &n, &zero, C, &n);
}

}  // namespace floatframe
