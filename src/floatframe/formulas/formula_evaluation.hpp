#pragma once
// Evaluation of formulas. Step time: no heap, noexcept.
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>

#include "floatframe/formulas/formula.hpp"
#include "floatframe/formulas/function_words.hpp"
#include "floatframe/formulas/scalars.hpp"

namespace floatframe {

/// Why a formula has no value.
struct FormulaFault {
  enum class Kind { none, division, domain, overflow } kind = Kind::none;
  int step = -1;
  double at = 0.0;      ///< the argument
  bool beyond = false;  ///< the function goes on there if a piece is held beyond its edge
};
/// "division by zero in '(x / y)'"
std::string fault_text(const Formula& formula, const FormulaFault& fault);

/// The piece of each switch, two bits each from the lowest ones: 0 is open, 1, 2, 3 the first,
/// second and third one.
struct FormulaSwitches {
  std::int64_t held = 0;     ///< given; open ones are decided by the present values
  std::int64_t present = 0;  ///< the pieces that were evaluated
  /// The largest distance of a held switch beyond the edge of its piece, and the piece there.
  double beyond = -std::numeric_limits<double>::max();
  int crossed = -1, next = 0;
  std::uint64_t pieces = 0;  ///< differs where the path through all pieces does

  void pass(std::uint64_t piece) noexcept { pieces = 31 * pieces + piece; }

  static std::int64_t with(std::int64_t all, int k, int piece) noexcept {
    return (all & ~(std::int64_t{3} << (2 * k))) | (std::int64_t{piece} << (2 * k));
  }
  int piece_of(int k) const noexcept { return (held >> (2 * k)) & 3; }
  bool holds(int k) const noexcept { return k < Formula::most_switches && piece_of(k) != 0; }
  /// `natural`: the piece at the present values; `beyond_of(piece, next)`: beyond the nearest edge
  /// of a piece, and what is there.
  template <class Beyond>
  int decide(int k, int natural, const Beyond& beyond_of) noexcept {
    const int piece = holds(k) ? piece_of(k) : natural;
    pass(piece);
    if (k >= Formula::most_switches) return natural;
    present = with(present, k, piece);
    if (holds(k)) {
      int other = 0;
      const double distance = beyond_of(piece, other);
      if (distance > beyond) beyond = distance, crossed = k, next = other;
    }
    return piece;
  }
  /// Between two pieces, 1 where x < 0, 2 elsewhere.
  int halves(int k, double x) noexcept {
    return decide(k, x < 0.0 ? 1 : 2, [&](int piece, int& other) {
      other = 3 - piece;
      return piece == 1 ? x : -x;
    });
  }
};

/// Piecewise linear between independent normal numbers at the multiples of dt; x in units of dt.
FunctionValue noise_at(double seed, double x) noexcept;
/// The value and both slopes.
struct GridValue {
  double f, dx, dy;
};
GridValue grid_at(const GridTable& grid, double x, double y) noexcept;

template <class S, class ValueOf>
class FormulaMachine {
 public:
  FormulaMachine(const Formula& f, const ValueOf& value_of_reference, FormulaSwitches& switches,
                 FormulaFault& fault) noexcept
      : f_(f), reference_(value_of_reference), switches_(switches), fault_(fault) {}

  S run() noexcept {
    const FormulaStep* const steps = f_.steps.data();
    const int n = std::ssize(f_.steps);
    S* top = stack_.items;  // behind the last item: a local variable stays in a register
    for (int at = 0; at < n; ++at) {
      if (arithmetic(steps[at], top)) continue;
      top_ = top - stack_.items;
      at_ = at;
      step(steps[at]);
      top = stack_.items + top_;
      at = at_;
    }
    assert(top == stack_.items + 1);
    return stack_.items[0];
  }

 private:
  /// The steps that most formulas are made of; false: another one.
  [[gnu::always_inline]] bool arithmetic(const FormulaStep& s, S*& top) const noexcept {
    using Op = FormulaOp;
    const auto put = [&](const FunctionValue& g) { top[-1] = composed(g, top[-1]); };
    switch (s.op) {
      case Op::number:
        std::construct_at(top++, s.number);
        return true;
      case Op::reference:
        std::construct_at(top++, reference_(s.index));
        return true;
      case Op::add:
        --top;
        top[-1] = top[-1] + *top;
        return true;
      case Op::subtract:
        --top;
        top[-1] = top[-1] - *top;
        return true;
      case Op::multiply:
        --top;
        top[-1] = top[-1] * *top;
        return true;
      case Op::add_number:
        put({value_of(top[-1]) + s.number, 1.0, 0.0});
        return true;
      case Op::multiply_number:
        put({value_of(top[-1]) * s.number, s.number, 0.0});
        return true;
      case Op::small_power: {
        const double x = value_of(top[-1]), m = s.number;
        double p = 1.0;  // x^(m - 2)
        for (int k = 2; k < m; ++k) p *= x;
        put({p * x * x, m * p * x, m * (m - 1.0) * p});
        return true;
      }
      default:
        return false;
    }
  }
  /// Operand k of the n that the step takes.
  S& operand(int n, int k) noexcept { return stack_.items[top_ - n + k]; }
  double number(int n, int k) noexcept { return value_of(operand(n, k)); }
  void leave(int n, const S& x) noexcept {
    operand(n, 0) = x;
    top_ -= n - 1;
  }
  void fail(FormulaFault::Kind kind, double argument) noexcept {
    if (fault_.kind == FormulaFault::Kind::none) fault_ = {kind, at_, argument};
  }
  /// Of a function that goes on beyond its end if a piece is held there.
  void fail_beyond(double argument) noexcept {
    if (fault_.kind == FormulaFault::Kind::none)
      fault_ = {FormulaFault::Kind::domain, at_, argument, true};
  }
  void take(int n, const FunctionValue& g) noexcept { leave(n, composed(g, operand(n, 0))); }
  /// Where it has no slope or curvature, that is taken as zero, as by `sqrt` of dual numbers.
  void take_root(const FunctionValue& g) noexcept {
    const bool slope = std::isfinite(g.df), bend = slope && std::isfinite(g.ddf);
    take(1, {g.f, slope ? g.df : 0.0, bend ? g.ddf : 0.0});
  }

  void step(const FormulaStep& s) noexcept {
    using Op = FormulaOp;
    switch (s.op) {
      case Op::divide:
        if (number(2, 1) == 0.0) fail(FormulaFault::Kind::division, 0.0);
        return leave(2, operand(2, 0) / operand(2, 1));
      case Op::negative:
        return leave(1, -operand(1, 0));
      case Op::not_:
        return leave(1, 1.0 - number(1, 0));
      case Op::equal:
        return leave(2, number(2, 0) == number(2, 1) ? 1.0 : 0.0);
      case Op::jump:
        at_ = s.index - 1;
        return;
      case Op::jump_unless:
        if (number(1, 0) == 0.0) at_ = s.index - 1;
        --top_;
        return;
      case Op::less:
      case Op::less_equal:
      case Op::min:
      case Op::max:
      case Op::abs:
      case Op::sign:
      case Op::clip:
        return switched(s);
      default:
        return function(s);
    }
  }

  void switched(const FormulaStep& s) noexcept {
    using Op = FormulaOp;
    switch (s.op) {
      case Op::less:
        return leave(2, switches_.halves(s.index, number(2, 0) - number(2, 1)) == 1 ? 1.0 : 0.0);
      case Op::less_equal:
        return leave(2, switches_.halves(s.index, number(2, 1) - number(2, 0)) == 2 ? 1.0 : 0.0);
      case Op::min:
      case Op::max: {
        const bool first = switches_.halves(s.index, number(2, 0) - number(2, 1)) == 1;
        return leave(2, operand(2, first == (s.op == Op::min) ? 0 : 1));
      }
      case Op::abs:
        if (switches_.halves(s.index, number(1, 0)) == 1) leave(1, -operand(1, 0));
        return;
      case Op::sign: {
        const double x = number(1, 0);
        const bool below = switches_.halves(s.index, x) == 1;
        return leave(1, below ? -1.0 : x == 0.0 && !switches_.holds(s.index) ? 0.0 : 1.0);
      }
      default:
        return clip(s.index);
    }
  }
  /// The piece 1 below, 2 between, 3 above the limits.
  void clip(int k) noexcept {
    const double x = number(3, 0), low = number(3, 1), high = number(3, 2);
    const int natural = x < low ? 1 : x > high ? 3 : 2;
    const int piece = switches_.decide(k, natural, [&](int held, int& other) {
      other = 2;
      if (held == 1) return x - low;
      if (held == 3) return high - x;
      other = low - x > x - high ? 1 : 3;
      return std::max(low - x, x - high);
    });
    leave(3, operand(3, piece == 1 ? 1 : piece == 2 ? 0 : 2));
  }

  void function(const FormulaStep& s) noexcept {
    using Op = FormulaOp;
    switch (s.op) {
      case Op::unary: {
        const double x = number(1, 0);
        if (s.function->defined(x)) return take_root(s.function->at(x));
        if (s.function->end == nullptr) {
          fail(FormulaFault::Kind::domain, x);
          return take_root(s.function->at(x));
        }
        fail_beyond(x);
        return take_root(s.function->beyond(x));
      }
      case Op::stairs: {
        const double y = s.function->at(number(1, 0)).f;
        switches_.pass(std::bit_cast<std::uint64_t>(y));
        return leave(1, y);
      }
      case Op::power_of_number: {
        const double x = number(1, 0), n = s.number;
        if (x < 0.0 && n > 0.0 && n != std::floor(n)) return odd_power(x, n);
        if ((x < 0.0 && n != std::floor(n)) || (x == 0.0 && n < 0.0))
          fail(FormulaFault::Kind::domain, x);
        const double slope = n == 0.0 ? 0.0 : n * std::pow(x, n - 1.0);
        const double bend = n * (n - 1.0) == 0.0 ? 0.0 : n * (n - 1.0) * std::pow(x, n - 2.0);
        return take_root({std::pow(x, n), slope, bend});
      }
      case Op::power:  // a^b = exp(b log a)
        return power();
      case Op::atan2: {  // the arc tangent of y/x or of -x/y, and a constant
        const double y = number(2, 0), x = number(2, 1);
        if (x == 0.0 && y == 0.0) return leave(2, 0.0);
        const bool steep = std::abs(y) > std::abs(x);
        const S ratio = steep ? -operand(2, 1) / operand(2, 0) : operand(2, 0) / operand(2, 1);
        const double r = value_of(ratio), d = 1.0 / (1.0 + r * r);
        return leave(2, composed({std::atan2(y, x), d, -2.0 * r * d * d}, ratio));
      }
      case Op::smooth_sign: {
        const S x = operand(2, 0) / operand(2, 1);
        if (number(2, 1) == 0.0) fail(FormulaFault::Kind::division, 0.0);
        const double t = std::tanh(value_of(x)), c = std::cosh(value_of(x)), d = 1.0 / (c * c);
        return leave(2, composed({t, d, -2.0 * t * d}, x));
      }
      case Op::smoothstep: {
        if (number(5, 1) == number(5, 3)) fail(FormulaFault::Kind::division, 0.0);
        const S along = (operand(5, 0) - operand(5, 1)) / (operand(5, 3) - operand(5, 1));
        const S rise = operand(5, 4) - operand(5, 2);
        return leave(5,
                     operand(5, 2) +
                         rise * composed(smoothstep(value_of(along), 0.0, 0.0, 1.0, 1.0), along));
      }
      case Op::chirp:
        return chirp();
      case Op::noise:  // its argument, x / dt, follows from the time
        return take(1, noise_at(s.number, number(1, 0)));
      case Op::curve: {
        const PiecewisePolynomial::Value v = (*f_.curves[s.index])(number(1, 0));
        return take(1, {v.f, v.df, v.ddf});
      }
      case Op::grid: {
        const GridValue g = grid_at(*f_.grids[s.index], number(2, 0), number(2, 1));
        return leave(2,
                     composed({g.f, g.dx}, operand(2, 0)) + composed({0.0, g.dy}, operand(2, 1)));
      }
      default:
        assert(false);
    }
  }
  /// |x|^n with the sign of x: what x^n of a held piece is beyond its edge.
  void odd_power(double x, double n) noexcept {
    fail_beyond(x);
    const double size = -x, p = std::pow(size, n - 1.0);
    take_root({-size * p, n * p, -n * (n - 1.0) * p / size});
  }
  void power() noexcept {
    const double x = number(2, 0), b = number(2, 1);
    if (x == 0.0 && b > 0.0) return leave(2, composed({0.0, b == 1.0 ? 1.0 : 0.0}, operand(2, 0)));
    const double sign = x < 0.0 ? -1.0 : 1.0;
    if (x < 0.0 && b > 0.0)
      fail_beyond(x);
    else if (!(x > 0.0))
      fail(FormulaFault::Kind::domain, x);
    const S exponent =
        operand(2, 1) * composed({std::log(sign * x), 1.0 / x, -1.0 / (x * x)}, operand(2, 0));
    const double e = sign * std::exp(value_of(exponent));
    leave(2, composed({e, e, e}, exponent));
  }
  /// sin(2 pi (f0 x + (f1 - f0) x^2 / (2 T))) for x in [0, T], then sin of the frequency f1 (x, f0,
  /// f1, T).
  void chirp() noexcept {
    const double x = number(4, 0), f0 = number(4, 1), f1 = number(4, 2), T = number(4, 3);
    if (T == 0.0) fail(FormulaFault::Kind::division, 0.0);
    const double within = std::min(std::max(x, 0.0), T), rate = (f1 - f0) / T;
    const double frequency = f0 + rate * within, turn = 2.0 * std::numbers::pi;
    const double phase =
        turn * (f0 * within + 0.5 * rate * within * within + frequency * (x - within));
    const double w = turn * frequency, s = std::sin(phase), c = std::cos(phase);
    take(4, {s, w * c, -w * w * s + (x == within ? turn * rate * c : 0.0)});
  }

  const Formula& f_;
  const ValueOf& reference_;
  FormulaSwitches& switches_;
  FormulaFault& fault_;
  /// Items are constructed as they are pushed.
  union Stack {
    Stack() noexcept {}
    ~Stack() {}
    S items[Formula::deepest_stack];
  } stack_;
  int top_ = 0, at_ = 0;
};

/// The value with `value_of_reference(i)` of each reference; with a fault it is not a number. A
/// trial step that holds a piece beyond its edge, to find the edge, may leave the range of a root
/// or power of that piece: there the function goes on.
template <class S, class ValueOf>
S evaluate_formula(const Formula& f, const ValueOf& value_of_reference, FormulaSwitches& switches,
                   FormulaFault& fault) noexcept {
  const S y = FormulaMachine<S, ValueOf>(f, value_of_reference, switches, fault).run();
  if (fault.beyond && switches.beyond > 0.0 && std::isfinite(value_of(y))) fault = {};
  if (fault.kind == FormulaFault::Kind::none && !std::isfinite(value_of(y)))
    fault.kind = FormulaFault::Kind::overflow, fault.step = std::ssize(f.steps) - 1;
  return fault.kind == FormulaFault::Kind::none ? y : S(std::numeric_limits<double>::quiet_NaN());
}

/// Of a formula of time alone; and why it has no value there.
PiecewisePolynomial::Value formula_at(const Formula& f, double t) noexcept;
/// The same number as long as it is on the same pieces: comparisons, clip, min, max, abs, sign,
/// floor, ceil, round.
std::uint64_t pieces_at(const Formula& f, double t) noexcept;
/// The first instant in (from, to] at which it is on other pieces than at `from`, some roundings
/// later; infinite if there is none. Leaving them and coming back within half of the way is not
/// seen.
double piece_change(const Formula& f, double from, double to) noexcept;
std::string fault_at(const Formula& f, double t);

}  // namespace floatframe
