#include "support/mechanism_check.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "floatframe/model/constraint_part.hpp"
#include "floatframe/simulation/simulation.hpp"

namespace floatframe::test {

namespace {

constexpr int most_levels = 4;
constexpr double nothing = 1e-8;

struct Outcome {
  bool started = false, finished = false, known = true;
  std::string reason;
  RunResult result;
};

Outcome run_once(const Model& model, SimulationDescription o, const Mechanism& m,
                 Coordinates coordinates) {
  o.coordinates = coordinates;
  o.inertia = coordinates == Coordinates::relative ? m.relative : m.absolute;
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

bool compared(OutputKind kind) {
  return kind == OutputKind::position || kind == OutputKind::joint_position ||
         kind == OutputKind::modal_amplitude;
}

double difference(const Model& model, const ResultTable& a, const ResultTable& b) {
  double d = 0.0;
  for (std::size_t r = 0; r < a.rows(); ++r)
    for (std::size_t c = 0; c < model.outputs.size(); ++c)
      if (compared(model.outputs[c].kind))
        d = std::max(d, std::abs(a.at(r, c + 1) - b.at(r, c + 1)));
  return d;
}

bool all_finite(const ResultTable& t) {
  return std::all_of(t.data.begin(), t.data.end(), [](double x) { return std::isfinite(x); });
}

/// Number of the kinks of f (jumps of its value or slope) below x.
int kinks_below(const PiecewisePolynomial& f, double x) {
  int count = 0;
  for (std::size_t k = 0; k < f.breaks().size() && f.breaks()[k] <= x; ++k) {
    const double at = f.breaks()[k];
    const PiecewisePolynomial::Value l = f.piece_value(k, at), r = f.piece_value(k + 1, at);
    if (std::abs(l.f - r.f) > 1e-9 * (1.0 + std::abs(l.f)) ||
        std::abs(l.df - r.df) > 1e-9 * (1.0 + std::abs(l.df)))
      ++count;
  }
  return count;
}

int kinks_in_time(const TimeFunction& f, double end) {
  return kinks_below(f.pieces, end) - kinks_below(f.pieces, 0.0);
}

/// Whether a run passed from one smooth piece of a law to another. Forces come last in a row, with
/// force, length and rate each.
bool passes_kinks(const Model& model, const ResultTable& t) {
  const std::size_t first = 1 + model.outputs.size() - 3 * model.forces.size();
  for (std::size_t k = 0; k < model.forces.size(); ++k) {
    const Force& f = model.forces[k];
    const double end = model.simulation.duration;
    if (kinks_in_time(f.magnitude, end) || kinks_in_time(f.target.function, end) ||
        kinks_in_time(f.target_rate.function, end))
      return true;
    const auto side = [&](std::size_t row) {
      const double time = t.at(row, 0), force = t.at(row, first + 3 * k);
      double length = t.at(row, first + 3 * k + 1), rate = t.at(row, first + 3 * k + 2);
      if (f.type == ForceType::tyre) return force > 0.0 ? 1 : 0;
      if (f.targeted) {
        const auto input = [&](const Signal& s) {
          return s.input < 0 ? 0.0 : model.inputs[static_cast<std::size_t>(s.input)].initial;
        };
        const PiecewisePolynomial::Value target = evaluate(f.target.function, time);
        length -= target.f + input(f.target);
        rate -= f.derived_rate ? target.df
                               : evaluate(f.target_rate.function, time).f + input(f.target_rate);
      }
      return kinks_below(f.spring, length) + 100 * kinks_below(f.damper, rate);
    };
    for (std::size_t r = 1; r < t.rows(); ++r)
      if (side(r) != side(0)) return true;
    if (f.type == ForceType::tyre && side(0) == 1) {
      // The centre of a wheel stays within its speed times the time; edges of a road are kinks.
      const Road& road = model.roads[static_cast<std::size_t>(f.road)];
      if (kinks_below(road.pieces, 1e9) > 0) return true;
    }
  }
  return false;
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

/// Whether some rigid body lacks mass, or inertia about an axis.
bool lacks_mass(const ModelDescription& description) {
  for (const BodyDescription& body : description.bodies)
    if (const auto* rigid = std::get_if<RigidDescription>(&body.kind)) {
      const Eigen::SelfAdjointEigenSolver<Mat3> inertia(rigid->J_C);
      const Vec3 moments = inertia.eigenvalues();
      if (rigid->mass == 0.0 || !(moments.minCoeff() > 1e-12 * (1.0 + moments.maxCoeff())))
        return true;
    }
  return false;
}

std::string list(const std::vector<double>& values) {
  return fmt::format("{:.3g}", fmt::join(values, ", "));
}

}  // namespace

const char* word(Verdict v) {
  static const char* const words[] = {
      "equal",         "second order", "second order at a finer step",
      "kinked",        "refused",      "stopped",
      "loosened",      "split",        "no reason",
      "not finite",    "wrong order",  "energy",
      "not repeatable"};
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
  const double steps = std::ceil(o.duration / std::min(1e-3, 0.1 / std::max(rate, 1e-3)) - 1e-9);
  j.step = o.step = o.output_interval = o.duration / steps;
  std::vector<double> relative_drift, absolute_drift;
  double scale = 0.0;
  bool stopped = true;
  std::string stops;
  for (int level = 0; level < most_levels; ++level, o.step *= 0.5) {
    // An error of the increment is an error of the velocity times half the step.
    o.tolerance = std::max(1e-8 * o.step, 3e-13);
    Outcome r = run_once(model, o, mechanism, Coordinates::relative);
    Outcome a = run_once(model, o, mechanism, Coordinates::absolute);
    if (!r.known || !a.known) return verdict(Verdict::no_reason, r.reason + " / " + a.reason);
    if (!r.started || !a.started) {
      if (r.started || a.started)
        return verdict(Verdict::split,
                       (r.started ? "absolute: " : "relative: ") + r.reason + a.reason);
      return verdict(r.reason.empty() || a.reason.empty() ? Verdict::no_reason : Verdict::refused,
                     r.reason + (r.reason == a.reason ? "" : " / " + a.reason));
    }
    if (!all_finite(r.result.table) || !all_finite(a.result.table))
      return verdict(Verdict::not_finite);
    if (!r.finished || !a.finished) {
      if (r.finished != a.finished) stopped = false;
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
    const double ratio = n < 2 ? 0.0 : j.differences[n - 2] / now;
    const bool falls = now < nothing || (ratio >= 3.0 && ratio <= 5.0);
    // Energy is judged on two steps at least.
    const bool judged = !j.conservative || (level > 0 && energy_falls(relative_drift, scale) &&
                                            energy_falls(absolute_drift, scale));
    if (falls && judged)
      return verdict(now < nothing ? Verdict::equal
                     : level == 1  ? Verdict::second_order
                                   : Verdict::finer);
  }
  if (stopped) return verdict(stops.empty() ? Verdict::no_reason : Verdict::stopped, stops);
  if (!std::isfinite(j.differences.back()))
    return verdict(lacks_mass(mechanism.description) &&
                           stops.find("tangent matrix is singular") != std::string::npos
                       ? Verdict::loosened
                       : Verdict::split,
                   stops);
  const std::string figures = fmt::format(
      "differences {}, energy errors {} (relative) {} (absolute) of {:.3g}{}", list(j.differences),
      list(relative_drift), list(absolute_drift), scale, stops.empty() ? "" : "; " + stops);
  const double first = j.differences.front(), last = j.differences.back();
  const bool falls = first > std::pow(2.0, most_levels - 1) * last;
  if (j.kinked && falls) return verdict(Verdict::kinked, figures);
  bool ordered = false;
  for (std::size_t k = 0; k < j.differences.size(); ++k) {
    const double ratio = k == 0 ? 0.0 : j.differences[k - 1] / j.differences[k];
    ordered = ordered || j.differences[k] < nothing || (ratio >= 3.0 && ratio <= 5.0);
  }
  return verdict(ordered ? Verdict::energy : Verdict::wrong_order, figures);
}

}  // namespace floatframe::test
