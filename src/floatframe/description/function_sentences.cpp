// Sentences about laws and functions of time.
#include "floatframe/core/number_rule.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/math/piecewise_build.hpp"

namespace floatframe::sentences {

std::optional<std::pair<std::size_t, std::string>> jump(const PiecewisePolynomial& f) {
  const JumpReport r = largest_jump(f);
  if (r.continuous()) return std::nullopt;
  const double x = f.breaks()[r.at];
  return std::make_pair(r.at, "the law jumps from " + number_text(f.piece_value(r.at, x).f) +
                                  " to " + number_text(f.piece_value(r.at + 1, x).f) + " at " +
                                  number_text(x) +
                                  ", expected pieces that meet within 1e-6 of the range of the "
                                  "law");
}

Complaint period(const TimeFunction& f, bool may_jump) {
  const std::vector<double>& b = f.pieces.breaks();
  if (b.empty()) return "found a period without a table or steps that repeat";
  const double width = b.back() - b.front();
  if (width > f.period && !fills_period(b.front(), b.back(), f.period))
    return "found " + number_text(f.period) + ", expected at least the " + number_text(width) +
           " s from the first time to the last one";
  if (may_jump) return std::nullopt;
  const JumpReport jump = largest_jump(
      repeated(f.pieces, f.period, b.front(), b.front() + 1.5 * f.period, 3 * b.size()));
  if (jump.continuous()) return std::nullopt;
  return "found the last value " + number_text(f.pieces(b.back()).f) + " and the first value " +
         number_text(f.pieces(b.front()).f) + ", expected equal ones: a motion cannot jump";
}

}  // namespace floatframe::sentences
