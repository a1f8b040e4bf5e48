#pragma once
// Four doubles processed together: two SSE registers or one AVX register, depending on the
// build.
namespace floatframe {

using Lanes = double __attribute__((vector_size(32), aligned(8), may_alias));
inline Lanes& lanes(double* p) noexcept { return *reinterpret_cast<Lanes*>(p); }
inline const Lanes& lanes(const double* p) noexcept { return *reinterpret_cast<const Lanes*>(p); }

inline double sum(const Lanes& x) noexcept { return (x[0] + x[1]) + (x[2] + x[3]); }

}  // namespace floatframe
