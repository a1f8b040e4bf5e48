// One libFuzzer program a reader; FUZZ_READER is its name.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace floatframe::fuzz;
  static const Reader* const reader = [] {
    for (const Reader& r : readers) {
      if (std::string_view(r.name) == FUZZ_READER) return &r;
    }
    std::abort();
  }();
  run(*reader, std::string_view(reinterpret_cast<const char*>(data), size));
  return 0;
}
