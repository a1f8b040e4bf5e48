#pragma once
// A value x between two limits, each of which may be absent, as a law with branches.
#include <limits>
#include <optional>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/element_kind.hpp"

namespace floatframe {

struct Limits {
  /// Branches.
  static constexpr std::int64_t between = 0, below = 1, above = 2;
  std::optional<double> lower, upper;

  std::int64_t branch(std::int64_t held, double x) const noexcept {
    if (held != free_branch) return held;
    if (lower && x < *lower) return below;
    return upper && x > *upper ? above : between;
  }
  /// x on a branch.
  template <class S>
  S clip(std::int64_t on, const S& x) const noexcept {
    return on == between ? x : S(on == below ? *lower : *upper);
  }
  /// How far x is below and above.
  double under(double x) const noexcept { return lower ? *lower - x : -endless; }
  double over(double x) const noexcept { return upper ? x - *upper : -endless; }

  BranchSide side(std::int64_t held, double x) const noexcept {
    const std::int64_t now = branch(held, x);
    if (held == free_branch) return {-1.0, now};
    if (now == below) return {-under(x), between};
    if (now == above) return {-over(x), between};
    return under(x) > over(x) ? BranchSide{under(x), below} : BranchSide{over(x), above};
  }

 private:
  static constexpr double endless = std::numeric_limits<double>::max();
};

/// The keys `lower` and `upper`.
constexpr ElementKey lower_key(KeyMember member) {
  return {.name = "lower",
          .kind = KeyKind::number,
          .about = "least value",
          .fallback = no_number,
          .member = member};
}
constexpr ElementKey upper_key(KeyMember member) {
  return {.name = "upper",
          .kind = KeyKind::number,
          .about = "largest value",
          .fallback = no_number,
          .member = member};
}

/// `lower` is less than `upper`.
inline void validate_limits(const ElementCheck& check) {
  if (!check.good("lower") || !check.good("upper")) return;
  const double lower = check.number("lower"), upper = check.number("upper");
  if (!(lower < upper))
    check.error(ErrorCode::out_of_range, "lower", sentences::controller_limits(lower, upper));
}

}  // namespace floatframe
