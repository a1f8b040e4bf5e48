#include "support/allocation_counter.hpp"

#include <cerrno>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define FLOATFRAME_COUNT_ALLOCATIONS 0
#else
#define FLOATFRAME_COUNT_ALLOCATIONS 1
#endif

namespace {
// Initial-exec storage: reaching it never allocates.
__attribute__((tls_model("initial-exec"))) thread_local std::size_t allocations = 0;
}  // namespace

#if FLOATFRAME_COUNT_ALLOCATIONS
// glibc keeps its allocator under these names, so the public ones can be replaced in the
// executable.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++allocations;
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) noexcept {
  ++allocations;
  void* p = __libc_memalign(alignment, size);
  if (p == nullptr) return ENOMEM;
  *out = p;
  return 0;
}
}
#endif

namespace floatframe::test {

bool allocations_counted() noexcept { return FLOATFRAME_COUNT_ALLOCATIONS != 0; }
std::size_t allocation_count() noexcept { return allocations; }

}  // namespace floatframe::test
