// One libFuzzer program per reader; FUZZ_READER is its name, or FUZZ_MODELS is defined.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "judge.hpp"
#ifdef FUZZ_MODELS
#include "models.hpp"
#else
#include "readers.hpp"
#endif

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace floatframe::fuzz;
#ifdef FUZZ_MODELS
  const Reader* const reader = &model_reader;
#else
  static const Reader* const reader = [] {
    for (const Reader& r : readers) {
      if (std::string_view(r.name) == FUZZ_READER) return &r;
    }
    std::abort();
  }();
#endif
  const Judge judge;
  run(*reader, std::string_view(reinterpret_cast<const char*>(data), size));
  Allowance allowance;
  allowance.bytes = reader->bytes;
  judge.judge(size, allowance);
  return 0;
}
