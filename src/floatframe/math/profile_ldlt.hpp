#pragma once
// L D L^T of a mostly zero front: as partial_ldlt.hpp, but each column ends at its `end`, plus the
// border, the rows after the eliminated ones. Fronts of long chains of loops with consecutive
// coordinates cost their number times the square of the column height.
#include <cassert>
#include <vector>

#include "floatframe/math/partial_ldlt.hpp"

namespace floatframe {

/// For each eliminated column the end of its rows: a multiple of four, not decreasing. Empty: the
/// front is full.
using FrontProfile = std::vector<int>;

/// Calls one(i) for the rows below j in its group of four, lane(i) for the groups below.
template <class One, class Lane>
inline void below(int j, int end, int ne, int ld, const One& one, const Lane& lane) noexcept {
  assert(0 <= j && j < ld && ld % 4 == 0 && end % 4 == 0);
  const int rest = (j & ~3) + 4, border = ne & ~3;
  for (int i = j + 1; i < rest; ++i) one(i);
  for (int i = rest; i < std::min(end, border); i += 4) lane(i);
  for (int i = std::max({rest, std::min(end, border), border}); i < ld; i += 4) lane(i);
}

/// Zeros where a column may become nonzero.
inline void profile_clear(double* f, int n, int ne, const FrontProfile& profile) noexcept {
  assert(0 <= ne && ne <= n && std::ssize(profile) >= ne);
  const int ld = front_stride(n);
  for (int j = 0; j < n; ++j) {
    double* c = f + static_cast<std::ptrdiff_t>(j) * ld;
    lanes(c + (j & ~3)) = Lanes{};
    below(
        j, j < ne ? profile[j] : ld, ne, ld, [](int) {}, [&](int i) { lanes(c + i) = Lanes{}; });
  }
}

inline int profile_ldlt(double* f, int n, int ne, double* original,
                        const FrontProfile& profile) noexcept {
  assert(0 <= ne && ne <= n && std::ssize(profile) >= ne);
  assert(std::is_sorted(profile.begin(), profile.end()));
  const std::ptrdiff_t ld = front_stride(n);
  for (int j = 0; j < ne; ++j) original[j] = f[j * ld + j];
  for (int j = 0; j < ne; ++j) {
    double* c = f + j * ld;
    const double pivot = c[j];
    if (!(std::abs(pivot) > pivot_tolerance * std::abs(original[j])) || !std::isfinite(pivot))
      return j;
    const double inverse = 1.0 / pivot;
    const int end = profile[j];
    const auto update = [&](int k) {
      const double x = c[k] * inverse;
      if (x == 0.0) return;
      double* a = f + k * ld;
      lanes(a + (k & ~3)) -= x * lanes(c + (k & ~3));
      below(
          k, end, ne, ld, [](int) {}, [&](int i) { lanes(a + i) -= x * lanes(c + i); });
    };
    below(j, end, ne, ld, update, [&](int i) {
      for (int k = i; k < std::min(i + 4, n); ++k) update(k);
    });
    below(
        j, end, ne, ld, [&](int i) { c[i] *= inverse; }, [&](int i) { lanes(c + i) *= inverse; });
    c[j] = inverse;
  }
  return -1;
}

inline void profile_forward(const double* f, int n, int ne, double* b,
                            const FrontProfile& profile) noexcept {
  assert(0 <= ne && ne <= n && std::ssize(profile) >= ne);
  const std::ptrdiff_t ld = front_stride(n);
  for (int j = 0; j < ne; ++j) {
    const double* c = f + j * ld;
    const double x = b[j];
    below(
        j, profile[j], ne, ld, [&](int i) { b[i] -= x * c[i]; },
        [&](int i) { lanes(b + i) -= x * lanes(c + i); });
    b[j] = x * c[j];
  }
}

inline void profile_backward(const double* f, int n, int ne, double* b,
                             const FrontProfile& profile) noexcept {
  assert(0 <= ne && ne <= n && std::ssize(profile) >= ne);
  const std::ptrdiff_t ld = front_stride(n);
  for (int j = ne; j-- > 0;) {
    const double* c = f + j * ld;
    Lanes products = {};
    double product = 0.0;
    below(
        j, profile[j], ne, ld, [&](int i) { product += c[i] * b[i]; },
        [&](int i) { products += lanes(c + i) * lanes(b + i); });
    b[j] -= product + sum(products);
  }
}

}  // namespace floatframe
