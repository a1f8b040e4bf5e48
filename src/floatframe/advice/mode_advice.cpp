#include "floatframe/advice/mode_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <span>

#include "floatframe/advice/mode_shares.hpp"
#include "floatframe/advice/output_differences.hpp"
#include "floatframe/body/with_modes.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/work_progress.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

/// Outputs of all amplitudes of all bodies, after those of the model.
Model watched(const Model& model) {
  Model out = model;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    for (int k = 0; k < model.bodies[i].modes(); ++k) {
      Output o;
      o.type = OutputType::modal_amplitude;
      o.body = static_cast<int>(i);
      o.component = k;
      out.outputs.push_back(o);
    }
  return out;
}

/// Floating-point operations of a step for a body with k modes: its inertia terms in every
/// iteration, and its amplitudes eliminated in every factorisation from a front with the 6
/// coordinates of the body's motion.
double flops(double k, const RunSummary& counts) {
  const double steps = static_cast<double>(std::max(1L, counts.steps));
  const double front = 6.0;
  const double inertia = 24.0 * k * k + 155.0 * k + 300.0;
  const double elimination = k * k * k / 3.0 + k * k * front + k * front * front;
  return (static_cast<double>(counts.iterations) * inertia +
          static_cast<double>(counts.factorizations) * elimination) /
         steps;
}

}  // namespace

const char* word(ModeAction action) noexcept {
  switch (action) {
    case ModeAction::keep:
      return "keep";
    case ModeAction::quasi_static:
      return "quasi-static";
    case ModeAction::drop:
      return "drop";
  }
  return "";
}

namespace {

void require_modes(const Model& model, const std::vector<std::vector<int>>& keep) {
  if (keep.size() != model.bodies.size())
    throw InputError(
        ErrorCode::wrong_count,
        fmt::format("found lists of modes for {} bodies, expected {}: one for each body",
                    keep.size(), model.bodies.size()));
  for (std::size_t i = 0; i < keep.size(); ++i)
    for (std::size_t k = 0; k < keep[i].size(); ++k)
      if (keep[i][k] < 0 || keep[i][k] >= model.bodies[i].modes() ||
          (k > 0 && keep[i][k] <= keep[i][k - 1]))
        throw InputError(ErrorCode::wrong_value,
                         fmt::format("body '{}': found mode {} to be kept, expected ascending "
                                     "indices from 0 below its {} modes",
                                     model.bodies[i].name, keep[i][k], model.bodies[i].modes()));
}

void require_valid(const AdviceOptions& o) {
  const auto share = [](const char* name, double x) {
    if (!(x >= 0.0 && std::isfinite(x)))
      throw InputError(ErrorCode::out_of_range,
                       fmt::format("{}: found {:g}, expected a number of at least 0", name, x));
  };
  share("drop_share", o.drop_share);
  share("static_ratio", o.static_ratio);
  share("tolerance", o.tolerance);
  if (o.repeat < 1)
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("repeat: found {}, expected at least 1 run", o.repeat));
}

}  // namespace

Model with_modes(const Model& model, const std::vector<std::vector<int>>& keep) {
  require_modes(built(model), keep);
  Model out = model;
  // Bodies that shared their data continue to share it.
  std::map<std::pair<const FlexibleBody*, std::vector<int>>, std::shared_ptr<const FlexibleBody>>
      known;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    Body& body = out.bodies[i];
    if (static_cast<int>(keep[i].size()) == body.modes()) continue;
    auto& data = known[{body.data.get(), keep[i]}];
    if (!data) data = std::make_shared<const FlexibleBody>(with_modes(*body.data, keep[i]));
    body.data = data;
    for (std::vector<VecX>* start : {&out.amplitudes, &out.amplitude_rates}) {
      VecX& full = (*start)[i];
      if (full.size() == 0) continue;
      full = VecX(full(keep[i]));
    }
  }
  for (Gauge& gauge : out.gauges) fill_rows(*out.bodies[gauge.body].data, gauge);
  std::vector<Output> outputs;
  for (Output o : model.outputs) {
    if (output_kind(o.type).of == OutputOf::mode) {
      const std::vector<int>& modes = keep[o.body];
      const auto it = std::find(modes.begin(), modes.end(), o.component);
      if (it == modes.end()) continue;
      o.component = static_cast<int>(it - modes.begin());
    }
    outputs.push_back(std::move(o));
  }
  out.outputs = std::move(outputs);
  return out;
}

namespace {

/// Largest of the two shares.
double share(const ModeAdvice& m) { return std::max(m.static_share, m.dynamic_share); }

/// Amplitudes of a run with the outputs of `watched`, body by body.
void judge_bodies(const Model& model, const ResultTable& table, double step,
                  ModeAdviceReport& report) {
  const auto rows = static_cast<Eigen::Index>(table.rows());
  VecX times(rows);
  for (Eigen::Index r = 0; r < rows; ++r) times[r] = table.at(r, 0);
  std::size_t column = 1 + model.outputs.size();
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const int modes = model.bodies[i].modes();
    if (modes == 0) continue;
    MatX y(modes, rows);
    for (int k = 0; k < modes; ++k, ++column)
      for (Eigen::Index r = 0; r < rows; ++r) y(k, r) = table.at(r, column);
    report.bodies.push_back(body_advice(model, static_cast<int>(i), y, times, step));
    report.modes += modes;
  }
}

/// Modes that may be removed, those with the smallest shares first.
std::vector<ModeAdvice*> candidates_of(ModeAdviceReport& report, double drop_share) {
  std::vector<ModeAdvice*> candidates;
  for (BodyAdvice& body : report.bodies)
    for (ModeAdvice& m : body.modes)
      if (share(m) < drop_share) candidates.push_back(&m);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto* a, const auto* b) { return share(*a) < share(*b); });
  return candidates;
}

/// Number of candidates that may be removed together. Modes of equal shares go together: removing
/// the left one of a vehicle and keeping the right one would make it asymmetric.
std::vector<std::size_t> counts_of(const std::vector<ModeAdvice*>& candidates) {
  std::vector<std::size_t> counts{0};
  for (std::size_t k = 1; k <= candidates.size(); ++k)
    if (k == candidates.size() || share(*candidates[k]) > 1.01 * share(*candidates[k - 1]))
      counts.push_back(k);
  return counts;
}

Model without(const Model& model, const ModeAdviceReport& report,
              std::span<ModeAdvice* const> dropped) {
  const std::set<const ModeAdvice*> gone(dropped.begin(), dropped.end());
  std::vector<std::vector<int>> keep(model.bodies.size());
  for (const BodyAdvice& body : report.bodies)
    for (const ModeAdvice& m : body.modes)
      if (!gone.contains(&m)) keep[body.body].push_back(m.mode);
  return with_modes(model, keep);
}

/// A model with fewer modes whose outputs do not change.
struct Reduced {
  Model model;
  std::size_t dropped = 0;  ///< of the candidates, from the first
  std::vector<RangeWarning> warnings;
};

/// A run that tells its progress.
RunResult told_run(const Model& model, const SimulationDescription& simulation, const char* work) {
  RunOptions options;
  options.progress = [work](double done) { tell_progress(work, done); };
  return run(model, simulation, options);
}

/// The largest number of candidates that can be removed without changing the outputs, by bisection.
Reduced drop_most(const Model& model, const SimulationDescription& simulation,
                  const ResultTable& table, const std::vector<ModeAdvice*>& candidates,
                  double tolerance, ModeAdviceReport& report) {
  std::vector<OutputDifference> scale;
  if (!candidates.empty()) {
    SimulationDescription other = simulation;
    other.tolerance = 10.0 * simulation.tolerance;
    const ResultTable other_table = told_run(model, other, "run with a larger tolerance").table;
    scale = output_scales(table, other_table, model.outputs.size());
  }
  const std::vector<std::size_t> counts = counts_of(candidates);
  std::size_t good = 0, bad = counts.size();
  Reduced out{model, 0, {}};
  while (bad - good > 1) {
    // All of them first: this is the most frequent result.
    const std::size_t at = bad == counts.size() ? bad - 1 : (good + bad) / 2;
    const Model trial = without(model, report, std::span(candidates).first(counts[at]));
    ++report.trials;
    bool passed = false;
    std::vector<OutputDifference> differences;
    std::vector<RangeWarning> warnings;
    try {
      const RunResult result = told_run(trial, simulation, "run with fewer modes");
      differences = output_differences(scale, table, result.table);
      passed = result.summary.status == "completed";
      warnings = result.summary.warnings;
      for (const OutputDifference& d : differences) passed = passed && d.relative <= tolerance;
    } catch (const RunError&) {  // a model that cannot be assembled or moved without these modes
    }
    if (passed) {
      good = at;
      report.differences = std::move(differences);
      out.model = trial;
      out.warnings = std::move(warnings);
    } else {
      bad = at;
      report.refused_by = differences.empty() ? "" : differences.front().name;
      report.refused_difference = differences.empty() ? 0.0 : differences.front().relative;
    }
  }
  out.dropped = counts[good];
  return out;
}

/// The recommendation for each mode; the number of modes kept for each body.
std::vector<double> decide(const std::vector<ModeAdvice*>& candidates, std::size_t dropped,
                           double static_ratio, ModeAdviceReport& report) {
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    candidates[k]->action = k < dropped ? ModeAction::drop : ModeAction::keep;
    candidates[k]->retained = k >= dropped;
  }
  std::vector<double> kept_modes;
  for (BodyAdvice& body : report.bodies) {
    double kept = 0.0;
    for (ModeAdvice& m : body.modes) {
      if (m.action == ModeAction::drop) continue;
      kept += 1.0;
      const bool not_resolved = m.step_phase > std::numbers::pi;
      const bool follows = m.dynamic_share > 0.0 && m.kinetic_ratio < static_ratio;
      if (not_resolved || follows) {
        m.action = ModeAction::quasi_static;
        ++report.quasi_static;
      }
    }
    kept_modes.push_back(kept);
  }
  return kept_modes;
}

/// Cost with the given tolerance, alternating so that a varying load of the machine affects both.
void measure(const Model& model, const Model& reduced, const SimulationDescription& given,
             int repeat, ModeAdviceReport& report) {
  RunOptions quiet;
  quiet.record = false;
  for (int k = 0; k < std::max(1, repeat); ++k) {
    const RunSummary a = run(model, given, quiet).summary;
    if (k == 0 || a.cpu < report.full.cpu) report.full = a;
    if (report.dropped == 0) continue;
    const RunSummary b = run(reduced, given, quiet).summary;
    if (k == 0 || b.cpu < report.reduced.cpu) report.reduced = b;
  }
  if (report.dropped == 0) report.reduced = report.full;
}

}  // namespace

ModeAdviceReport advise(const Model& model, const SimulationDescription& given,
                        const AdviceOptions& options) {
  require_valid(options);
  built(model);
  // The effect of a mode on the outputs must exceed that of the Newton tolerance (a tyre that meets
  // an edge slightly later): compared runs use a separate, smaller tolerance.
  SimulationDescription simulation = given;
  simulation.output_interval = 0.0;
  simulation.tolerance = std::min(given.tolerance, std::max(1e-3 * given.tolerance, 1e-12));
  ModeAdviceReport report;
  RunResult full = told_run(watched(model), simulation, "run");
  if (full.summary.status != "completed") {  // below round-off
    simulation.tolerance = given.tolerance;
    full = told_run(watched(model), simulation, "run");
  }
  if (full.summary.status != "completed")
    throw RunError(ErrorCode::step_failed,
                   "the model does not run to its end: " + full.summary.message);
  report.tolerance = simulation.tolerance;

  judge_bodies(model, full.table, simulation.step, report);
  const std::vector<ModeAdvice*> candidates = candidates_of(report, options.drop_share);
  report.candidates = static_cast<int>(candidates.size());
  const Reduced reduced =
      drop_most(model, simulation, full.table, candidates, options.tolerance, report);
  report.dropped = static_cast<int>(reduced.dropped);
  const std::vector<double> kept_modes =
      decide(candidates, reduced.dropped, options.static_ratio, report);
  measure(model, reduced.model, given, options.repeat, report);
  report.full.warnings = full.summary.warnings;
  report.reduced.warnings = reduced.warnings;
  for (std::size_t k = 0; k < report.bodies.size(); ++k) {
    report.flops_full += flops(static_cast<double>(report.bodies[k].modes.size()), report.full);
    report.flops_reduced += flops(kept_modes[k], report.full);
  }
  return report;
}

}  // namespace floatframe
