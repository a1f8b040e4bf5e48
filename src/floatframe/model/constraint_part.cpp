// Dispatch of the constraint parts in a step: direct calls, no pointer.
#include "floatframe/model/constraint_part.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <utility>

#include "floatframe/core/debug_only.hpp"
#include "floatframe/formulas/formula_evaluation.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/math/piecewise_build.hpp"

namespace floatframe {

PiecewisePolynomial::Value evaluate(const TimeFunction& f, double t) noexcept {
  assert(std::isfinite(t) && f.period >= 0.0);
  PiecewisePolynomial::Value v =
      f.pieces(f.period > 0.0 ? in_first_period(t, f.pieces.breaks().front(), f.period) : t);
  for (const SineTerm& sine : f.sines) {
    assert(all_finite(&sine.amplitude, 1) && sine.frequency >= 0.0);
    const double since = t - sine.start, swept = std::clamp(since, 0.0, sine.duration);
    const double w0 = omega_of(sine.frequency), rate = omega_of(sine.rate);
    const double angle = w0 * since + rate * swept * (since - 0.5 * swept) + sine.phase;
    const double w = w0 + rate * swept, s = std::sin(angle), c = std::cos(angle);
    v.f += sine.amplitude * s;
    v.df += sine.amplitude * w * c;
    v.ddf -= sine.amplitude * w * w * s;
    if (since >= 0.0 && since < sine.duration) v.ddf += sine.amplitude * rate * c;
  }
  if (f.formula) {
    const PiecewisePolynomial::Value added = formula_at(*f.formula, t);
    v.f += added.f;
    v.df += added.df;
    v.ddf += added.ddf;
  }
  return v;
}

bool changes(const TimeFunction& f, double duration) noexcept {
  constexpr int samples = 23;
  const double first = evaluate(f, 0.0).f;
  for (int k = 1; k <= samples; ++k)
    if (evaluate(f, duration * k / samples).f != first) return true;
  return false;
}

namespace {

/// Calls f with the type as a constant: comparisons and direct calls.
template <class F, std::size_t... I>
void with_part_type(ConstraintType type, std::index_sequence<I...>, F f) noexcept {
  static_cast<void>(((type == constraint_types[I] &&
                      (f(std::integral_constant<ConstraintType, constraint_types[I]>{}), true)) ||
                     ...));
}

constexpr std::make_index_sequence<std::size(constraint_types)> all_part_types;

#ifndef NDEBUG
/// NaN until a kind has filled it.
void poison_row(ConstraintRow& row) noexcept {
  for (Vec3* x : {&row.gradient.a.F, &row.gradient.a.T, &row.gradient.b.F, &row.gradient.b.T})
    poison(*x);
  for (double* x : {&row.phi, &row.quad, &row.phi_t, &row.phi_tt}) poison(*x);
}
#endif

}  // namespace

void evaluate_constraint(const ConstraintPart& part, const MarkerState& a, const MarkerState& b,
                         double t, ConstraintRow* rows) noexcept {
  assert(part.a >= 0 && part.b >= 0 && part.scale > 0.0 && rows);
  FLOATFRAME_DEBUG(for (int r = 0; r < part.rows(); ++r) poison_row(rows[r]);)
  with_part_type(part.type, all_part_types,
                 [&](auto type) { constraint_rows_of<type()>(part, a, b, t, rows); });
}

void add_constraint_curvature(const ConstraintPart& part, const MarkerState& a,
                              const MarkerState& b, const double* lambda, Mat12& K) noexcept {
  assert(part.a >= 0 && part.b >= 0 && part.scale > 0.0 && lambda);
  with_part_type(part.type, all_part_types,
                 [&](auto type) { constraint_curvature_of<type()>(part, a, b, lambda, K); });
}

}  // namespace floatframe
