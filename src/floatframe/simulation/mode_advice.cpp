#include "floatframe/simulation/mode_advice.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "floatframe/body/with_modes.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/simulation/mode_shares.hpp"
#include "floatframe/simulation/output_differences.hpp"

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

Model with_modes(const Model& model, const std::vector<std::vector<int>>& keep) {
  Model out = model;
  // Bodies that shared their data share it afterwards.
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
      VecX some(static_cast<Eigen::Index>(keep[i].size()));
      for (std::size_t k = 0; k < keep[i].size(); ++k)
        some[static_cast<Eigen::Index>(k)] = full[keep[i][k]];
      full = some;
    }
  }
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

ModeAdviceReport advise(const Model& model, const SimulationDescription& given,
                        const AdviceOptions& options) {
  // What a mode does to the outputs must not drown in what the Newton tolerance does to them (a
  // tyre that meets an edge a moment later): runs that are compared have a tolerance of their own.
  SimulationDescription simulation = given;
  simulation.output_interval = 0.0;
  simulation.tolerance = std::min(given.tolerance, std::max(1e-3 * given.tolerance, 1e-12));
  ModeAdviceReport report;
  RunResult full = run(watched(model), simulation);
  if (full.summary.status != "completed") {  // closer than round-off allows
    simulation.tolerance = given.tolerance;
    full = run(watched(model), simulation);
  }
  if (full.summary.status != "completed")
    throw RunError("the model does not run to its end: " + full.summary.message);
  report.tolerance = simulation.tolerance;

  // Amplitudes of the run, body by body.
  const ResultTable& table = full.table;
  const auto rows = static_cast<Eigen::Index>(table.rows());
  VecX times(rows);
  for (Eigen::Index r = 0; r < rows; ++r) times[r] = table.at(static_cast<std::size_t>(r), 0);
  std::size_t column = 1 + model.outputs.size();
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const int modes = model.bodies[i].modes();
    if (modes == 0) continue;
    MatX y(modes, rows);
    for (int k = 0; k < modes; ++k, ++column)
      for (Eigen::Index r = 0; r < rows; ++r)
        y(k, r) = table.at(static_cast<std::size_t>(r), column);
    report.bodies.push_back(body_advice(model, static_cast<int>(i), y, times, simulation.step));
    report.modes += modes;
  }

  // Candidates, those with the smallest shares first.
  std::vector<ModeAdvice*> candidates;
  for (BodyAdvice& body : report.bodies)
    for (ModeAdvice& m : body.modes)
      if (m.static_share < options.drop_share && m.dynamic_share < options.drop_share)
        candidates.push_back(&m);
  std::stable_sort(candidates.begin(), candidates.end(), [](const auto* a, const auto* b) {
    return std::max(a->static_share, a->dynamic_share) <
           std::max(b->static_share, b->dynamic_share);
  });
  report.candidates = static_cast<int>(candidates.size());

  std::vector<OutputDifference> scale;
  if (!candidates.empty()) {
    SimulationDescription other = simulation;
    other.tolerance = 10.0 * simulation.tolerance;
    const ResultTable other_table = run(model, other).table;
    scale = output_scales(table, other_table, model.outputs.size());
  }

  // The largest number of candidates whose loss the outputs do not show, by halving.
  const auto without = [&](std::size_t count) {
    const std::set<const ModeAdvice*> gone(candidates.begin(),
                                           candidates.begin() + static_cast<std::ptrdiff_t>(count));
    std::vector<std::vector<int>> keep(model.bodies.size());
    for (const BodyAdvice& body : report.bodies)
      for (const ModeAdvice& m : body.modes)
        if (!gone.contains(&m)) keep[body.body].push_back(m.mode);
    return with_modes(model, keep);
  };
  // Modes of equal shares go together: to drop one on the left of a vehicle and keep that on the
  // right would make it lean.
  std::vector<std::size_t> steps{0};
  for (std::size_t k = 1; k <= candidates.size(); ++k) {
    const auto share = [&](std::size_t i) {
      return std::max(candidates[i]->static_share, candidates[i]->dynamic_share);
    };
    if (k == candidates.size() || share(k) > 1.01 * share(k - 1)) steps.push_back(k);
  }
  std::size_t good = 0, bad = steps.size();
  Model reduced = model;
  std::vector<RangeWarning> reduced_warnings;
  while (bad - good > 1) {
    // All of them first: most often that is the answer.
    const std::size_t at = bad == steps.size() ? bad - 1 : (good + bad) / 2;
    const std::size_t count = steps[at];
    const Model trial = without(count);
    ++report.trials;
    bool passed = false;
    std::vector<OutputDifference> differences;
    std::vector<RangeWarning> warnings;
    try {
      const RunResult result = run(trial, simulation);
      differences = output_differences(scale, table, result.table);
      passed = result.summary.status == "completed";
      warnings = result.summary.warnings;
      for (const OutputDifference& d : differences)
        passed = passed && d.relative <= options.tolerance;
    } catch (const RunError&) {  // a model that cannot be assembled or moved without these modes
    }
    if (passed) {
      good = at;
      report.differences = std::move(differences);
      reduced = trial;
      reduced_warnings = std::move(warnings);
    } else {
      bad = at;
      report.refused_by = differences.empty() ? "" : differences.front().name;
      report.refused_difference = differences.empty() ? 0.0 : differences.front().relative;
    }
  }
  const std::size_t dropped = steps[good];
  report.dropped = static_cast<int>(dropped);
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
      const bool follows = m.dynamic_share > 0.0 && m.kinetic_ratio < options.static_ratio;
      if (not_resolved || follows) {
        m.action = ModeAction::quasi_static;
        ++report.quasi_static;
      }
    }
    kept_modes.push_back(kept);
  }

  // Cost with the tolerance given, alternating so that a change of the machine's load meets both.
  RunOptions quiet;
  quiet.record = false;
  for (int k = 0; k < std::max(1, options.repeat); ++k) {
    const RunSummary a = run(model, given, quiet).summary;
    if (k == 0 || a.cpu < report.full.cpu) report.full = a;
    if (report.dropped == 0) continue;
    const RunSummary b = run(reduced, given, quiet).summary;
    if (k == 0 || b.cpu < report.reduced.cpu) report.reduced = b;
  }
  if (report.dropped == 0) report.reduced = report.full;
  report.full.warnings = full.summary.warnings;
  report.reduced.warnings = reduced_warnings;
  for (std::size_t k = 0; k < report.bodies.size(); ++k) {
    report.flops_full += flops(static_cast<double>(report.bodies[k].modes.size()), report.full);
    report.flops_reduced += flops(kept_modes[k], report.full);
  }
  return report;
}

}  // namespace floatframe
