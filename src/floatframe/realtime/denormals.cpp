#include "floatframe/realtime/denormals.hpp"

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace floatframe {
namespace {

#if defined(__x86_64__)
constexpr std::uint64_t flush_bits = 0x8040;  // FTZ, DAZ
std::uint64_t control() noexcept { return _mm_getcsr(); }
void set_control(std::uint64_t bits) noexcept { _mm_setcsr(static_cast<unsigned>(bits)); }
#elif defined(__aarch64__)
constexpr std::uint64_t flush_bits = std::uint64_t{1} << 24;  // FZ
std::uint64_t control() noexcept {
  std::uint64_t bits = 0;
  asm volatile("mrs %0, fpcr" : "=r"(bits));
  return bits;
}
void set_control(std::uint64_t bits) noexcept { asm volatile("msr fpcr, %0" : : "r"(bits)); }
#else
constexpr std::uint64_t flush_bits = 0;
std::uint64_t control() noexcept { return 0; }
void set_control(std::uint64_t) noexcept {}
#endif

}  // namespace

FlushDenormals::FlushDenormals() noexcept : before_(control()) {
  set_control(before_ | flush_bits);
}

FlushDenormals::~FlushDenormals() { set_control(before_); }

}  // namespace floatframe
