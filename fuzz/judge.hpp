#pragma once
// What a reader may take for an input: so much time and so much memory. Time is that of the
// processor, memory the most that is held at once of what the reading itself asked for. Over it,
// the program ends with a sentence, and libFuzzer keeps the input.
#include <sanitizer/allocator_interface.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace floatframe::fuzz {

struct Allowance {
  double seconds = 1.0, seconds_per_MB = 5.0;
  double slower = 10.0;  ///< instrumented code than the product
  double bytes = 2e6, bytes_per_byte = 50.0;
};

/// Counts while it lives; the readers have one thread.
class Judge {
 public:
  Judge() {
    static const int installed =
        __sanitizer_install_malloc_and_free_hooks(&Judge::taken, &Judge::given_back);
    if (installed == 0) {
      std::fputs("the memory of the readers cannot be counted\n", stderr);
      std::abort();
    }
    held = most = 0;
    counting = true;
    begin_ = seconds();
  }
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;
  ~Judge() { counting = false; }

  /// Ends the program if the reading took more than it may.
  void judge(std::size_t size, const Allowance& allowance) const {
    counting = false;
    const double time = seconds() - begin_, n = static_cast<double>(size);
    const double most_time =
        allowance.slower * (allowance.seconds + allowance.seconds_per_MB * n / 1e6);
    const double most_bytes = allowance.bytes + allowance.bytes_per_byte * n;
    static const bool shown = std::getenv("FUZZ_SHOW") != nullptr;
    if (shown)
      std::fprintf(stderr, "%zu bytes of input: %lld bytes of memory (%.1f a byte), %.3f s\n", size,
                   most, static_cast<double>(most) / std::max(n, 1.0), time);
    if (time > most_time) {
      std::fprintf(stderr, "too slow: %.1f s for %zu bytes, allowed are %.1f s\n", time, size,
                   most_time);
      std::abort();
    }
    if (static_cast<double>(most) > most_bytes && !shown) {
      std::fprintf(stderr, "too much memory: %lld bytes for %zu bytes, allowed are %.0f\n", most,
                   size, most_bytes);
      std::abort();
    }
  }

 private:
  static double seconds() {
    std::timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  static void taken(const volatile void* /*at*/, std::size_t size) {
    if (!counting) return;
    held += static_cast<long long>(size);
    most = std::max(most, held);
  }
  static void given_back(const volatile void* at) {
    if (counting && at != nullptr)
      held -= static_cast<long long>(
          __sanitizer_get_allocated_size(const_cast<const void*>(at)));
  }

  inline static thread_local bool counting = false;
  inline static thread_local long long held = 0, most = 0;  // [byte]
  double begin_ = 0.0;
};

}  // namespace floatframe::fuzz
