#include "floatframe/model_file/time_terms.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#include "floatframe/description/rules.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/math/piecewise_build.hpp"

namespace floatframe {

double read_period(YamlSection& section, double width) {
  const double period = section.number("period", rules::period, 0.0);
  const auto all = section.get("periodic");
  if (!all) return period;
  if (section.has("period")) all->error(ErrorCode::exclusive, "expected either periodic or period");
  return all->boolean().value_or(false) ? width : period;
}

PiecewisePolynomial read_steps(const YamlValue& value, YamlSection& section, double& period) {
  const char* what = "a list of steps [t, value]";
  std::vector<TablePoint> points;
  const std::vector<YamlValue> items = value.list(what);
  if (value.is_list() && items.empty()) value.unexpected(what);
  bool good = !items.empty();
  for (const YamlValue& item : items) {
    const auto p = item.numbers(2, 2, any_number(""), "a step [t, value]");
    good = good && p;
    if (!p) continue;
    if (!points.empty() && (*p)[0] <= points.back().x) {
      item.error(ErrorCode::wrong_value, "found t = " + number_text((*p)[0]) + " after " +
                                             number_text(points.back().x) +
                                             ", expected ascending times [s]");
      good = false;
    }
    points.push_back({(*p)[0], (*p)[1]});
  }
  period = section.number("period", rules::period, 0.0);
  return good ? step_function(points) : PiecewisePolynomial();
}

bool read_sines(YamlSection& section, const char* unit, std::vector<SineTerm>& sines) {
  bool found = false;
  for (const bool chirp : {false, true}) {
    const auto value = section.get(chirp ? "chirp" : "sine");
    if (!value) continue;
    found = true;
    for (const YamlValue& v : value->is_list() ? value->list() : std::vector<YamlValue>{*value}) {
      auto s = v.section(chirp ? "a map with amplitude, from, to, duration, phase, start"
                               : "a map with amplitude, frequency, phase");
      if (!s) continue;
      SineTerm& sine = sines.emplace_back();
      sine.amplitude = s->required_number("amplitude", any_number(unit), 0.0);
      sine.phase = s->number("phase", any_number("rad"), 0.0);
      if (chirp) {
        sine.frequency = s->required_number("from", rules::chirp_frequency, 0.0);
        const double to = s->required_number("to", rules::chirp_frequency, sine.frequency);
        sine.duration = s->required_number("duration", rules::chirp_duration, 1.0);
        sine.rate = (to - sine.frequency) / sine.duration;
        sine.start = s->number("start", any_number("s"), 0.0);
      } else {
        sine.frequency = s->required_number("frequency", rules::sine_frequency, 1.0);
      }
      s->finish();
    }
  }
  return found;
}

TimeFunction integral_of(const TimeFunction& f, double start) {
  const auto& [pieces, sines, period, formula] = f;
  assert(period == 0.0 && !formula);
  TimeFunction out;
  for (const SineTerm& s : sines) {
    assert(s.rate == 0.0);
    out.sines.push_back({.amplitude = s.amplitude / omega_of(s.frequency),
                         .frequency = s.frequency,
                         .phase = s.phase - 0.5 * std::numbers::pi});
    start -= out.sines.back().amplitude * std::sin(out.sines.back().phase);
  }
  out.pieces = integral(pieces, 0.0, start);
  return out;
}

}  // namespace floatframe
