// The input u as it was the time T before, y(t) = u(t - T), before the start that of the start.
// Kept numbers are the past: a ring of instants at which steps ended and the values there, linear
// between them, which has order two. If T is shorter than the step, y lies between the end of the
// last step, t_n, and the present iterate:
//   y = u_n + (t - T - t_n) / (t - t_n) (u - u_n)                                              (1)
// The last instant replaces the one before it if that is closer than `spacing` to its predecessor,
// so that steps of half the size of the simulation and more are kept whole.
// At rest y = u. In linear systems, of changes about a state, the Pade approximation of exp(-s T),
//   sum_k c_k (-s T)^k / sum_k c_k (s T)^k,  c_k = (2n - k)! n! / ((2n)! k! (n - k)!)          (2)
// with n states, which are zero otherwise.
#include <cmath>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/element_outputs.hpp"
#include "floatframe/model/linear_block.hpp"

namespace floatframe {

namespace {

/// Of a step, and points beyond those of a time T at this spacing: the newest and its neighbours.
constexpr double delay_spacing = 0.499;
constexpr int more_points = 4;

/// The ring: the slot of the newest point, then time and value of each.
template <class Number>
class Past {
 public:
  Past(const Element& element, Number* kept) noexcept
      : points_((element.kept - 1) / 2), kept_(kept) {}

  /// Of the points from the oldest; -1: of the newest.
  Number& time(int i) const noexcept { return kept_[1 + 2 * slot(i)]; }
  Number& value(int i) const noexcept { return kept_[2 + 2 * slot(i)]; }
  int points() const noexcept { return points_; }
  /// No step has ended since the start.
  bool fresh() const noexcept { return time(0) == time(-1); }

  double at(double t) const noexcept {
    int below = 0, above = points_;
    while (above - below > 1) {
      const int middle = (below + above) / 2;
      (time(middle) <= t ? below : above) = middle;
    }
    if (above == points_ || t <= time(below)) return value(below);
    const double part = (t - time(below)) / (time(above) - time(below));
    return value(below) + part * (value(above) - value(below));
  }
  void fill(double t, double u) const noexcept {
    for (int i = 0; i < points_; ++i) time(i) = t, value(i) = u;
  }
  void add(double t, double u, double spacing) const noexcept {
    if (!(time(-1) - time(points_ - 2) < spacing)) kept_[0] = slot(0);
    time(-1) = t;
    value(-1) = u;
  }

 private:
  int slot(int i) const noexcept {
    const int at = static_cast<int>(kept_[0]) + 1 + i;
    return at < points_ ? at : at - points_;
  }
  int points_;
  Number* kept_;
};

template <class S>
void delay_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const Past<const double> past(in.element, in.kept);
  const S u = in.signal(0).f;
  const double then = in.t - in.template keys<Delay>().time, last = past.time(-1);
  if (in.model.linear && in.state_weight > 0.0) {  // changes from the present point
    const auto& pade = in.template data<LinearBlock>();
    linear_block_law(in, out);
    out.force += past.at(then) - pade.D(0) * past.value(-1);
    for (Eigen::Index i = 0; i < pade.B.size(); ++i)
      out.state_rates[i] -= pade.B(i) * past.value(-1);
    return;
  }
  const int n = in.element.states;
  for (int i = 0; i < n; ++i) {
    out.state_rates[i] = -in.state(i);
    out.state_slopes[i * n + i] = -1.0;
  }
  if (in.state_weight == 0.0)
    out.force = u;
  else if (then > last)  // (1)
    out.force = past.value(-1) + (then - last) / (in.t - last) * (u - past.value(-1));
  else
    out.force = past.at(then);
}

}  // namespace

FLOATFRAME_LAW(delay)

namespace {

/// (2) with the states of a rational function in s T.
LinearBlock pade_of(int n, double T) {
  VecX c = VecX::Ones(n + 1);  // c_k / c_n, of ascending powers
  for (int k = n; k > 0; --k) c[k - 1] = c[k] * k * (2 * n - k + 1) / (n - k + 1);
  const double w = std::pow(c[0], 1.0 / n), sign = n % 2 == 0 ? 1.0 : -1.0;
  LinearBlock out{MatX::Zero(n, n), MatX(n, 1), MatX::Zero(1, n), MatX{{sign}}, {}};
  for (int i = 0; i < n; ++i) {  // of s^(n-1-i), as in transfer_function.cpp with the mean pole w/T
    const double a = c[n - 1 - i], power = std::pow(w, i);
    out.A(i, 0) = -a / power / T;
    if (i + 1 < n) out.A(i, i + 1) = w / T;
    out.B(i) = (((n - 1 - i) % 2 == 0 ? 1.0 : -1.0) - sign) * a / power / T;
  }
  out.C(0) = 1.0;
  return out;
}

double spacing_of(const Delay& keys, const Element& element) noexcept {
  return keys.time / ((element.kept - 1) / 2 - more_points);
}

constexpr ElementKey delay_keys[] = {
    input_key(described_by<&Delay::input>),
    {.name = "time",
     .kind = KeyKind::number,
     .about = "T: the value is that of the input this time before",
     .required = true,
     .rule = positive_number("s"),
     .member = described_by<&Delay::time>},
    {.name = "pade",
     .kind = KeyKind::number,
     .about = "order of the Padé approximation that linear systems have instead",
     .rule = {"a whole number from 1 to 10", "", 1.0, 10.0},
     .fallback = 2.0,
     .member = described_by<&Delay::pade>}};

void delay_validate(const ElementCheck& check) {
  const double order = check.good("pade") ? check.number("pade") : 1.0;
  if (order != std::floor(order))
    check.error(ErrorCode::out_of_range, "pade", sentences::not_whole(order));
}

/// Its kept numbers, for steps of this size.
double kept_numbers(const Delay& keys, double step) {
  return 1.0 + 2.0 * (std::ceil(keys.time / (delay_spacing * step)) + more_points);
}

void delay_states(Element& element) {
  const auto& keys = *std::get_if<Delay>(element.keys.get());
  take_linear_block(element, pade_of(std::lround(keys.pade), keys.time), BlockStart::zero);
  element.kept = std::lround(kept_numbers(keys, 0.25 * keys.time));
  element.remembers = true;
}

bool delay_build(ElementBuild& b) {
  const double count = kept_numbers(b.keys<Delay>(), b.step());
  constexpr double most = 1e6;
  if (!(count <= most)) {
    b.error(ErrorCode::too_large,
            sentences::long_delay(b.keys<Delay>().time, b.step(), count, most));
    return false;
  }
  b.element.kept = std::lround(count);
  return true;
}

void delay_start(const Ports& in, double* states) noexcept {
  Past(in.element, states + in.element.states).fill(in.t, in.signal(0).f);
}

void delay_settle(const Ports& in, double* states) noexcept {
  const Past past(in.element, states + in.element.states);
  if (past.fresh()) past.fill(in.t, in.signal(0).f);
}

void delay_after_step(const Ports& in, double* states) noexcept {
  Past(in.element, states + in.element.states)
      .add(in.t, in.signal(0).f, spacing_of(in.keys<Delay>(), in.element));
}

std::string delay_linear_note(const Element& element) {
  const auto& keys = *std::get_if<Delay>(element.keys.get());
  return element_name(element) + " delays by " + number_text(keys.time) +
         " s: the linear system has a Pade approximation of order " + number_text(keys.pade) +
         " instead";
}

constexpr ElementRegime delay_regimes[] = {
    {.name = "longer_than_the_step", .conservative = false, .acts = false},
    {.name = "shorter_than_the_step", .conservative = false, .acts = false},
    {.name = "linear", .conservative = false, .acts = false},
    {.name = "rest", .conservative = false, .acts = false}};

ElementExample delay_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  Delay f;
  f.input = x.linked_signal(numbers);
  f.time = regime == 1 ? 0.01 : 0.1;
  f.pade = 3.0;
  x = block_example(std::move(x), std::move(f), numbers);
  x.t = 1.02;
  std::fill(x.states.begin() + x.element.states, x.states.end(), 0.0);
  const Past past(x.element, x.states.data() + x.element.states);
  for (int i = 0; i < past.points(); ++i) {
    past.time(i) = 1.0 - 0.02 * (past.points() - 1 - i);
    past.value(i) = numbers(-2.0, 2.0);
  }
  x.model.linear = regime == 2;
  if (regime == 3) x.state_weight = 0.0;
  return x;
}

}  // namespace

constinit const ElementKind delay_element = [] {
  auto kind = block_kind<Delay>("its input as it was some time before", delay_keys);
  kind.validate = delay_validate;
  kind.build = delay_build;
  kind.states = delay_states;
  kind.start = delay_start;
  kind.settle = delay_settle;
  kind.after_step = delay_after_step;
  kind.dual = delay_law<Dual>;
  kind.linear_note = delay_linear_note;
  kind.regimes = delay_regimes;
  return kind;
}();

constinit const ExampleMaker delay_examples = delay_example;

}  // namespace floatframe
