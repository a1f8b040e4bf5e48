#pragma once
// Numbers below 2.2e-308 ("denormals") cost a hundred times more to add and multiply on most
// processors: a decaying mode that reaches them would slow down steps for no benefit. While a
// `FlushDenormals` exists, the calling thread treats such operands and results as zero (x86-64: DAZ
// and FTZ; AArch64: FZ; no effect elsewhere). The mode belongs to the thread and is restored at the
// end.
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
