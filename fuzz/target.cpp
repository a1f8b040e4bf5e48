// One libFuzzer program per reader; FUZZ_READER is its name. With FUZZ_MODELS it is one of those
// that need what a model is made of.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "judge.hpp"
#ifdef FUZZ_MODELS
#include "packed.hpp"
#else
#include "readers.hpp"
#endif

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace floatframe::fuzz;
#ifdef FUZZ_MODELS
  constexpr auto& list = model_readers;
#else
  constexpr auto& list = readers;
#endif
  static const Reader* const reader = [] {
    for (const Reader& r : list) {
      if (std::string_view(r.name) == FUZZ_READER) return &r;
    }
    std::abort();
  }();
  const Judge judge;
  run(*reader, std::string_view(reinterpret_cast<const char*>(data), size));
  Allowance allowance;
  allowance.bytes = reader->bytes;
  judge.judge(size, allowance);
  return 0;
}
