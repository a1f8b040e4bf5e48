// What evaluation takes for granted, of formulas and roads that come from bytes.
#include <algorithm>

#include "floatframe/packed/pass_formula.hpp"

namespace floatframe {
namespace {

/// Numbers that a step takes from the stack.
int operands_of(FormulaOp op) {
  using Op = FormulaOp;
  switch (op) {
    case Op::number:
    case Op::reference:
    case Op::jump:
      return 0;
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::divide:
    case Op::power:
    case Op::atan2:
    case Op::min:
    case Op::max:
    case Op::smooth_sign:
    case Op::grid:
    case Op::less:
    case Op::less_equal:
    case Op::equal:
      return 2;
    case Op::clip:
      return 3;
    case Op::chirp:
      return 4;
    case Op::smoothstep:
      return 5;
    default:
      return 1;
  }
}

bool within(int k, std::size_t count) { return k >= 0 && std::size_t(k) < count; }

/// The place that a step names exists.
bool has_its_index(const Formula& f, const FormulaStep& s) {
  using Op = FormulaOp;
  switch (s.op) {
    case Op::reference:
      return within(s.index, f.references.size());
    case Op::curve:
      return within(s.index, f.curves.size()) && f.curves[s.index];
    case Op::grid:
      return within(s.index, f.grids.size()) && f.grids[s.index];
    case Op::min:
    case Op::max:
    case Op::abs:
    case Op::sign:
    case Op::clip:
    case Op::less:
    case Op::less_equal:
      return within(s.index, f.switches);
    case Op::unary:
    case Op::stairs:
      return s.function != nullptr;
    case Op::small_power:
      return s.number >= 2.0 && s.number <= Formula::small_exponent;
    default:
      return true;
  }
}

/// The depth of the stack is the same on every way to a step, and one at the end.
bool stack_fits(const Formula& f) {
  const int n = std::ssize(f.steps);
  std::vector<int> depth(f.steps.size() + 1, -1);
  const auto arrive = [&](int at, int d) {
    if (depth[at] < 0) depth[at] = d;
    return depth[at] == d;
  };
  depth[0] = 0;
  for (int at = 0; at < n; ++at) {
    const FormulaStep& s = f.steps[at];
    const int taken = operands_of(s.op);
    if (depth[at] < taken || !has_its_index(f, s)) return false;
    const bool jumps = s.op == FormulaOp::jump, may_jump = s.op == FormulaOp::jump_unless;
    const int after = depth[at] - taken + (jumps || may_jump ? 0 : 1);
    if (after > Formula::deepest_stack) return false;
    if (jumps || may_jump)
      if (s.index <= at || s.index > n || !arrive(s.index, after)) return false;
    if (!jumps && !arrive(at + 1, after)) return false;
  }
  return depth[n] == 1;
}

}  // namespace

const char* formula_damage(const Formula& f) {
  if (f.steps.empty() || f.sources.size() != f.steps.size()) return "a formula without steps";
  if (f.switches < 0 || f.switches > std::ssize(f.steps)) return "a formula with wrong switches";
  for (const FormulaReference& r : f.references)
    if ((r.function == "delay") != (r.delayed != nullptr) || !(r.delay >= 0.0))
      return "a delay of nothing";
  for (const FormulaKink& k : f.kinks) {
    if (k.held < -1 || k.held >= f.switches) return "a formula with wrong kinks";
    for (const int r : k.references)
      if (!within(r, f.references.size())) return "a formula with wrong kinks";
  }
  return stack_fits(f) ? nullptr : "a formula that has no value";
}

const char* crg_damage(const CrgRoad& c) {
  const std::size_t cells = c.singles.empty() ? c.doubles.size() : c.singles.size();
  const std::size_t rows = c.v.empty() ? 0 : cells / c.v.size();
  const auto one_or_all = [&](const std::vector<double>& x) {
    return x.size() <= 1 || x.size() == rows;
  };
  const bool good = c.v.size() > 1 && rows > 1 && rows * c.v.size() == cells &&
                    (c.singles.empty() || c.doubles.empty()) && one_or_all(c.line_heights) &&
                    one_or_all(c.banking) && c.line.numbers().steps + 1 == rows &&
                    std::ranges::is_sorted(c.v, std::less_equal<>());
  return good ? nullptr : "a measured road without a grid";
}

}  // namespace floatframe
