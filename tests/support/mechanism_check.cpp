#include "support/mechanism_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "floatframe/run/run.hpp"
#include "floatframe/start/light_motion.hpp"
#include "floatframe/start/start_up.hpp"

namespace floatframe::test {

namespace {

constexpr int usual_levels = 4;
constexpr int most_levels = 8;  ///< of runs that differ too much before to be judged
constexpr double nothing = 1e-8;
constexpr double same = 1e-6;       ///< next to a singular position, which makes much of round-off
constexpr double meaningful = 0.1;  ///< larger differences fall by chance, if they fall

struct Outcome {
  bool started = false, finished = false, known = true;
  std::string reason;
  RunResult result;
};

SimulationDescription in_coordinates(SimulationDescription o, const Mechanism& m,
                                     Coordinates coordinates) {
  o.coordinates = coordinates;
  o.inertia = coordinates == Coordinates::relative ? m.relative : m.absolute;
  return o;
}

Outcome run_once(const Model& model, SimulationDescription o, const Mechanism& m,
                 Coordinates coordinates) {
  o = in_coordinates(std::move(o), m, coordinates);
  Outcome out;
  try {
    out.result = run(model, o);
    out.started = true;
    out.finished = out.result.summary.status == "completed";
    out.reason = out.result.summary.message;
  } catch (const RunError& e) {
    out.reason = e.what();
  } catch (const InputError& e) {
    out.reason = e.what();
  } catch (const std::exception& e) {
    out.known = false;
    out.reason = e.what();
  }
  return out;
}

bool compared(OutputType type) {
  return type == OutputType::position || type == OutputType::joint_position ||
         type == OutputType::modal_amplitude;
}

/// Whether an output says where a body without any mass is.
bool without_mass(const Model& model, const Output& o) {
  const auto massless = [&](int body) {
    return body >= 0 && model.bodies[body].data->invariants.m == 0.0 &&
           model.bodies[body].data->invariants.P_u.isZero(0.0);
  };
  const auto on_massless = [&](int marker) {
    return marker >= 0 && massless(model.markers[marker].body);
  };
  return massless(o.body) || on_massless(o.marker) || on_massless(o.to) ||
         (o.joint >= 0 &&
          (massless(model.joints[o.joint].parent) || massless(model.joints[o.joint].child)));
}

enum class Bodies { all, with_mass };

double difference(const Model& model, const ResultTable& a, const ResultTable& b,
                  double until = std::numeric_limits<double>::infinity(),
                  Bodies bodies = Bodies::all) {
  double d = 0.0;
  for (std::size_t c = 0; c < model.outputs.size(); ++c) {
    const Output& o = model.outputs[c];
    if (!compared(o.type) || (bodies == Bodies::with_mass && without_mass(model, o))) continue;
    for (std::size_t r = 0; r < std::min(a.rows(), b.rows()) && a.at(r, 0) <= until; ++r)
      d = std::max(d, std::abs(a.at(r, c + 1) - b.at(r, c + 1)));
  }
  return d;
}

bool all_finite(const ResultTable& t) {
  return std::all_of(t.data.begin(), t.data.end(), [](double x) { return std::isfinite(x); });
}

double drift(const RunResult& r) {
  const EnergySummary& e = r.summary.energy;
  return std::abs(e.total_end - e.total_start);
}

/// Whether the energy errors at h, h/2, ... fall as those of a second-order method.
bool energy_falls(const std::vector<double>& drifts, double scale) {
  for (std::size_t k = 0; k < drifts.size(); ++k) {
    if (drifts[k] < 1e-7 * scale) return true;
    if (k > 0 && drifts[k - 1] > 2.5 * drifts[k]) return true;
  }
  return false;
}

/// "from t = 0.1 s on" of a sentence.
std::optional<double> beginning(const std::string& sentence) {
  constexpr std::string_view words = "from t = ";
  const std::size_t at = sentence.find(words);
  if (at == std::string::npos) return std::nullopt;
  return std::stod(sentence.substr(at + words.size()));
}

bool loses_mass(const Outcome& o) {
  return !o.finished && o.reason.find("almost without mass") != std::string::npos;
}

/// Refused because something can move without mass.
bool refused_for_mass(const Outcome& o) {
  return !o.started && o.reason.find("can move without mass") != std::string::npos;
}

/// Stopped in its first step for the same.
bool stops_at_once(const Outcome& o, double step) {
  return o.started && loses_mass(o) && o.result.summary.duration < step;
}

/// Whether what `refused` says to move without mass is found almost without mass at the start in
/// these coordinates, too: the same bodies.
bool light_at_start(const Model& model, const SimulationDescription& o, const Outcome& refused) {
  InitialisedModel start(model, o);
  const std::string note = light_motion_note(start.formulation(), start.state());
  const std::size_t end = note.find(" can move");
  return end != std::string::npos &&
         refused.reason.find(": " + note.substr(2, end - 2) + " can move") != std::string::npos;
}

/// How far a run says it may be judged: until it leaves the range of small deformations, and half
/// the way to where a body turns too far in one step or a freedom has lost its mass. Nothing if it
/// stops for another reason before it has said so.
std::optional<double> judged_until(const Outcome& o) {
  double until = o.result.summary.duration;
  bool may_stop = o.finished;
  if (loses_mass(o)) {
    may_stop = true;
    until *= 0.5;
  }
  for (const RangeWarning& w : o.result.summary.warnings) {
    const bool deforms = w.limit == RangeLimit::displacement || w.limit == RangeLimit::rotation;
    if (!deforms && w.limit != RangeLimit::turn) continue;
    if (const std::optional<double> t = beginning(w.sentence)) {
      may_stop = true;
      until = std::min(until, deforms ? *t : 0.5 * *t);
    }
  }
  return may_stop ? std::optional(until) : std::nullopt;
}

/// Both formulations with one step.
struct Level {
  Outcome relative, absolute;
};

bool falls(double before, double now) {
  const double ratio = before / now;
  return now < nothing || (now < meaningful && ratio >= 3.0 && ratio <= 5.0);
}

/// Whether the differences fall as they must until the first run says that it has left what it can
/// be judged by (at least the first ten instants, of which a step has all). What is bent too far at
/// the start, by the closing of its loops, cannot be judged at all.
bool falls_before(const Model& model, const std::vector<Level>& levels, double step) {
  double until = std::numeric_limits<double>::infinity();
  for (const Level& l : levels)
    for (const Outcome* o : {&l.relative, &l.absolute}) {
      const std::optional<double> t = judged_until(*o);
      if (!t) return false;
      until = std::min(until, *t);
    }
  if (until <= 0.0) return true;
  until = std::max(until, 10.5 * step);
  double before = 0.0;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double now =
        difference(model, levels[k].relative.result.table, levels[k].absolute.result.table, until);
    if (k > 0 && falls(before, now)) return true;
    before = now;
  }
  return false;
}

/// Whether all run at all steps, and the bodies with mass agree: where one without mass goes along
/// forces that vanish is determined by nothing.
bool only_massless_differ(const Model& model, const std::vector<Level>& levels) {
  double before = 0.0;
  bool falling = false;
  for (const Level& l : levels) {
    if (!l.relative.finished || !l.absolute.finished) return false;
    const double now = difference(model, l.relative.result.table, l.absolute.result.table,
                                  std::numeric_limits<double>::infinity(), Bodies::with_mass);
    falling = falling || now < nothing || (before > 0.0 && falls(before, now));
    before = now;
  }
  return falling;
}

/// Whether the formulations agree in the first half of what both run, at some step.
bool agree_before_stops(const Model& model, const std::vector<Level>& levels) {
  double before = 0.0;
  for (const Level& l : levels) {
    const double until =
        0.5 * std::min(l.relative.result.summary.duration, l.absolute.result.summary.duration);
    const double now = difference(model, l.relative.result.table, l.absolute.result.table, until);
    if (until > 0.0 && (now < nothing || (before > 0.0 && falls(before, now)))) return true;
    before = now;
  }
  return false;
}

/// The largest acceleration of the first ten instants.
double first_acceleration(const Model& model, const ResultTable& t) {
  double most = 0.0;
  for (std::size_t c = 0; c < model.outputs.size(); ++c)
    if (model.outputs[c].type == OutputType::acceleration)
      for (std::size_t r = 1; r < std::min<std::size_t>(t.rows(), 11); ++r)
        most = std::max(most, std::abs(t.at(r, c + 1)));
  return most;
}

/// Whether errors halve with the step while accelerations double.
bool begins_unbalanced(const Model& model, const std::vector<Level>& levels,
                       const std::vector<double>& differences) {
  const auto doubles = [&](const Outcome& before, const Outcome& now) {
    const double ratio = first_acceleration(model, now.result.table) /
                         first_acceleration(model, before.result.table);
    return ratio > 1.7 && ratio < 2.3;
  };
  for (std::size_t k = 1; k < levels.size(); ++k) {
    const double ratio = differences[k - 1] / differences[k];
    if (!(ratio > 1.8 && ratio < 2.2) || !doubles(levels[k - 1].relative, levels[k].relative) ||
        !doubles(levels[k - 1].absolute, levels[k].absolute))
      return false;
  }
  return levels.size() > 2 && differences.back() < meaningful;
}

std::string list(const std::vector<double>& values) {
  return fmt::format("{:.3g}", fmt::join(values, ", "));
}

/// Whether the equilibria that two inertia methods find differ by what rounding leaves open.
bool found_apart(const Model& model, const Mechanism& m, const Level& first) {
  if (m.description.simulation.start != Start::equilibrium || m.relative == m.absolute)
    return false;
  const double apart =
      difference(model, first.relative.result.table, first.absolute.result.table, 0.0);
  return apart > 0.1 * nothing && apart < same;
}

}  // namespace

const char* word(Verdict v) {
  static const char* const words[] = {"equal",       "second order", "second order at a finer step",
                                      "kinked",      "refused",      "stopped",
                                      "weightless",  "unbalanced",   "out of range",
                                      "split",       "no reason",    "not finite",
                                      "wrong order", "energy",       "not repeatable"};
  return words[static_cast<int>(v)];
}

Judgement judge(const Mechanism& mechanism) {
  Judgement j;
  const auto verdict = [&](Verdict v, const std::string& reason = "") {
    j.verdict = v;
    if (!reason.empty()) j.reason = reason;
    return j;
  };
  j.conservative = is_conservative(mechanism.description);
  Model model;
  try {
    model = build_model(mechanism.description);
  } catch (const InputError& e) {
    return verdict(e.what()[0] == 0 ? Verdict::no_reason : Verdict::refused, e.what());
  } catch (const std::exception& e) {
    return verdict(Verdict::no_reason, e.what());
  }
  SimulationDescription o = model.simulation;
  o.position_tolerance = 1e-10;
  o.velocity_tolerance = 1e-9;
  const double rate = std::min(fastest_rate(model, mechanism.relative), 2.0 * most_rate);
  const double steps = steps_on_kinks(
      model, std::ceil(o.duration / std::min(1e-3, 0.1 / std::max(rate, 1e-3)) - 1e-9));
  j.step = o.step = o.output_interval = o.duration / steps;
  std::vector<double> relative_drift, absolute_drift;
  double scale = 0.0;
  bool stopped = true;
  // Each stop is next to a singular position, and wherever one stops both do.
  bool at_singular_position = true, alike = true;
  std::string stops;
  std::vector<Level> levels;
  const auto cannot_be_judged = [&] {
    return std::isfinite(j.differences.back()) && j.differences.back() > meaningful &&
           !falls_before(model, levels, j.step) && !only_massless_differ(model, levels);
  };
  for (int level = 0; level < most_levels; ++level, o.step *= 0.5) {
    if (level >= usual_levels && !cannot_be_judged()) break;
    // An error of the increment is an error of the velocity times half the step.
    o.tolerance = std::max(1e-8 * o.step, 3e-13);
    Outcome r = run_once(model, o, mechanism, Coordinates::relative);
    Outcome a = run_once(model, o, mechanism, Coordinates::absolute);
    if (!r.known || !a.known) return verdict(Verdict::no_reason, r.reason + " / " + a.reason);
    if (!r.started || !a.started) {
      const auto light = [&](const Outcome& refused, const Outcome& other, Coordinates c) {
        return refused_for_mass(refused) && other.started &&
               (stops_at_once(other, o.step) ||
                light_at_start(model, in_coordinates(o, mechanism, c), refused));
      };
      if (light(r, a, Coordinates::absolute) || light(a, r, Coordinates::relative))
        return verdict(Verdict::refused, r.reason + " / " + a.reason);
      if (r.started || a.started)
        return verdict(Verdict::split,
                       (r.started ? "absolute: " : "relative: ") + r.reason + a.reason);
      return verdict(r.reason.empty() || a.reason.empty() ? Verdict::no_reason : Verdict::refused,
                     r.reason + (r.reason == a.reason ? "" : " / " + a.reason));
    }
    if (!all_finite(r.result.table) || !all_finite(a.result.table))
      return verdict(Verdict::not_finite);
    levels.push_back({r, a});
    if (level == 0 && found_apart(model, mechanism, levels[0])) {
      Mechanism alike_found = mechanism;
      alike_found.absolute = mechanism.relative;
      return judge(alike_found);
    }
    if (!r.finished || !a.finished) {
      if (r.finished != a.finished) stopped = alike = false;
      for (const Outcome* run : {&r, &a})
        if (!run->finished && run->reason.find("singular position") == std::string::npos)
          at_singular_position = false;
      stops = (r.finished ? "" : "relative: " + r.reason) +
              (a.finished ? "" : " absolute: " + a.reason);
      j.differences.push_back(std::numeric_limits<double>::infinity());
      continue;
    }
    stopped = false;
    if (level == 0) {
      const Outcome again = run_once(model, o, mechanism, Coordinates::relative);
      const std::vector<double>&x = r.result.table.data, &y = again.result.table.data;
      if (x.size() != y.size() || std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) != 0)
        return verdict(Verdict::not_repeatable);
    }
    j.kinked = j.kinked || passes_kinks(model, r.result.table);
    relative_drift.push_back(drift(r.result));
    absolute_drift.push_back(drift(a.result));
    const EnergySummary& e = r.result.summary.energy;
    scale = 1e-3 + std::abs(e.kinetic_end) + std::abs(e.kinetic_start) +
            std::abs(e.potential_end - e.potential_start) + std::abs(e.elastic_end);
    j.differences.push_back(difference(model, r.result.table, a.result.table));
    const std::size_t n = j.differences.size();
    const double now = j.differences.back();
    const bool small = now < nothing || (n > 1 && falls(j.differences[n - 2], now));
    // Energy is judged on two steps at least.
    const bool judged = !j.conservative || (level > 0 && energy_falls(relative_drift, scale) &&
                                            energy_falls(absolute_drift, scale));
    if (small && judged)
      return verdict(now < nothing ? Verdict::equal
                     : level == 1  ? Verdict::second_order
                                   : Verdict::finer);
  }
  if (stopped) return verdict(stops.empty() ? Verdict::no_reason : Verdict::stopped, stops);
  const std::string figures = fmt::format(
      "differences {}, energy errors {} (relative) {} (absolute) of {:.3g}{}", list(j.differences),
      list(relative_drift), list(absolute_drift), scale, stops.empty() ? "" : "; " + stops);
  const double first = j.differences.front(), last = j.differences.back();
  if (j.kinked && last < meaningful && first > std::pow(2.0, usual_levels - 1) * last)
    return verdict(Verdict::kinked, figures);
  if (falls_before(model, levels, j.step)) {
    const bool weightless = std::any_of(levels.begin(), levels.end(), [](const Level& l) {
      return loses_mass(l.relative) || loses_mass(l.absolute);
    });
    return verdict(weightless ? Verdict::weightless : Verdict::out_of_range, figures);
  }
  if (only_massless_differ(model, levels)) return verdict(Verdict::weightless, figures);
  if (begins_unbalanced(model, levels, j.differences)) return verdict(Verdict::unbalanced, figures);
  if (!std::isfinite(last)) {
    // One may pass where the other does not, if they agree where both do.
    const auto apart = [](double d) { return std::isfinite(d) && d > same; };
    const auto agrees = [](double d) { return d <= same; };
    const bool agree = std::none_of(j.differences.begin(), j.differences.end(), apart) &&
                       (std::any_of(j.differences.begin(), j.differences.end(), agrees) ||
                        agree_before_stops(model, levels));
    return verdict(at_singular_position && (alike || agree) ? Verdict::stopped : Verdict::split,
                   stops);
  }
  bool ordered = false;
  for (std::size_t k = 0; k < j.differences.size(); ++k)
    ordered = ordered || j.differences[k] < nothing ||
              (k > 0 && falls(j.differences[k - 1], j.differences[k]));
  return verdict(ordered ? Verdict::energy : Verdict::wrong_order, figures);
}

}  // namespace floatframe::test
