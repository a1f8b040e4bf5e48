#pragma once
// Counts heap allocations of this process: malloc, calloc, realloc, aligned_alloc, posix_memalign
// and hence operator new. Under the address sanitizer nothing is counted and
// `allocations_counted()` says so.
#include <cstddef>

namespace floatframe::test {

bool allocations_counted() noexcept;
/// Allocations of the calling thread since its start.
std::size_t allocation_count() noexcept;

/// Allocations since construction.
class AllocationScope {
 public:
  AllocationScope() noexcept : start_(allocation_count()) {}
  std::size_t count() const noexcept { return allocation_count() - start_; }

 private:
  std::size_t start_;
};

}  // namespace floatframe::test
