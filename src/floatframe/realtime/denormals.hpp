#pragma once
// Numbers below 2.2e-308 ("denormals") cost a hundred times more to add and multiply on most
// processors: a decaying mode that reaches them would stall steps for no gain. While a
// `FlushDenormals` lives, the calling thread takes such operands as zero and returns zero instead
// of such results (x86-64: DAZ and FTZ; AArch64: FZ; elsewhere nothing happens). The mode belongs
// to the thread and is put back at the end.
#include <cstdint>

namespace floatframe {

class FlushDenormals {
 public:
  FlushDenormals() noexcept;
  ~FlushDenormals();
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  std::uint64_t before_ = 0;
};

}  // namespace floatframe
