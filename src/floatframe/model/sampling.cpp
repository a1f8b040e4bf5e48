#include "floatframe/model/sampling.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/sampling_keys.hpp"

namespace floatframe {

namespace {

/// Multiples are those to this fraction of a period.
constexpr double multiple_width = 1e-9;
constexpr int most_waiting = 1000;

bool is_multiple(double of, double x, double width) noexcept {
  const double n = x / of;
  return std::abs(n - std::round(n)) <= width * std::max(1.0, std::abs(n));
}
/// At which it computes a value, and begins to act with one.
SampleTicks samples_of(const SampleClock& c) noexcept { return {c.first, c.period}; }
SampleTicks acting_of(const SampleClock& c) noexcept { return {c.first + c.delay, c.period}; }

}  // namespace

double SampleTicks::after(double t) const noexcept {
  if (t < first) return first;
  const double k = std::floor((t - first) / period);
  double at = first + k * period;  // rounding may leave it on either side of t
  for (int n = 1; !(at > t); ++n) at = first + (k + n) * period;
  return at;
}

std::vector<SampleTicks> ticks_of(const Model& model) {
  std::vector<SampleTicks> out;
  const auto add = [&](const SampleTicks& x) {
    for (const SampleTicks& o : out)
      if (o.period == x.period &&
          (o.first == x.first ||
           (o.first < x.first && is_multiple(x.period, x.first - o.first, multiple_width))))
        return;
    out.push_back(x);
  };
  for (const Element& e : model.elements)
    if (e.clock.ticks()) add(samples_of(e.clock));
  for (const Element& e : model.elements)
    if (e.clock.waiting > 0) add(acting_of(e.clock));
  return out;
}

void take_clock(Element& element, const Sampling& s, int own) {
  element.clock = {};
  if (!s.period) return;
  const double T = *s.period, delay = s.delay.value_or(0.0);
  const bool whole = is_multiple(T, delay, multiple_width);
  const int waiting = whole ? std::round(delay / T) : std::ceil(delay / T);
  element.clock = {s.offset.value_or(0.0), T, whole ? waiting * T : delay, waiting};
  element.kept = (1 + waiting) * (1 + element.further()) + own;
}

void begin_to_act(const Ports& in, double width, double* kept) noexcept {
  const SampleClock& c = in.element.clock;
  const int values = 1 + in.element.further();
  if (c.waiting > 0 && acting_of(c).at(in.t, width)) std::copy_n(kept + values, values, kept);
}

bool is_sampled_at(const Element& element, double t, double width) noexcept {
  return samples_of(element.clock).at(t, width);
}

void take_sample(const Ports& in, double* kept) noexcept {
  const int values = 1 + in.element.further();
  double* last = kept + in.element.clock.waiting * values;
  if (last != kept) std::copy(kept + 2 * values, last + values, kept + values);
  element_kind(in.element.type).sample(in, own_numbers(in.element, kept), last);
}

std::string held_samples_note(const Model& model) {
  std::vector<std::string> names;
  for (const Element& e : model.elements)
    if (e.clock.ticks()) names.push_back(e.name);
  return names.empty() ? "" : sentences::held_samples(names);
}

void require_samples_of_steps(const Model& model, double step) {
  for (const Element& e : model.elements)
    if (e.clock.ticks() && e.clock.period < shortest_part * step)
      throw InputError(
          ErrorCode::out_of_range, e.clock.mark,
          sentences::step_over_samples(element_name(e), e.clock.period, step, shortest_part));
}

void require_ticks_at_steps(const Model& model, double begin, double step) {
  constexpr double rounding = 1e-12;
  for (const Element& e : model.elements) {
    if (!e.clock.ticks()) continue;
    const auto require = [&](const char* key, double value, double from) {
      if (!is_multiple(step, value - from, rounding))
        throw InputError(ErrorCode::out_of_range,
                         element_name(e) + ": " + sentences::sample_off_step(key, value, step));
    };
    require("period", e.clock.period, 0.0);
    require("offset", e.clock.first, begin);
    require("delay", e.clock.delay, 0.0);
  }
}

void validate_sampling(const ElementCheck& check) {
  for (const char* key : {"offset", "delay"})
    if (!check.given("period") && !check.wrong.contains("period") && check.given(key) &&
        !check.wrong.contains(key))
      check.error(ErrorCode::incomplete, key, sentences::unused_without("'period'"));
  if (check.good("period") && check.good("delay") &&
      check.number("delay") > most_waiting * check.number("period"))
    check.error(ErrorCode::too_large, "delay",
                sentences::long_delay(check.number("delay"), check.number("period"), most_waiting));
}

}  // namespace floatframe
