#include "floatframe/simulation/mode_advice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "floatframe/body/with_modes.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

MatX modal_mass(const InertiaInvariants& v) { return v.Sij[0][0] + v.Sij[1][1] + v.Sij[2][2]; }

/// M_ff - M_fr M_rr^-1 M_rf: the modal mass of a body that is free to recoil.
MatX recoil_mass(const InertiaInvariants& v) {
  Eigen::Matrix<double, 6, 6> M_rr = Eigen::Matrix<double, 6, 6>::Zero();
  M_rr.topLeftCorner<3, 3>() = v.m * Mat3::Identity();
  M_rr.topRightCorner<3, 3>() = -skew(v.m_u);
  M_rr.bottomLeftCorner<3, 3>() = skew(v.m_u);
  M_rr.bottomRightCorner<3, 3>() = v.inertia_about_origin();
  MatX M_rf(6, v.modes());
  M_rf.topRows(3) = v.S;
  M_rf.row(3) = v.Si[1].row(2) - v.Si[2].row(1);  // int r_u x X dm
  M_rf.row(4) = v.Si[2].row(0) - v.Si[0].row(2);
  M_rf.row(5) = v.Si[0].row(1) - v.Si[1].row(0);
  // A thin rod has no inertia about its axis: the least solution leaves that rotation alone.
  return modal_mass(v) - M_rf.transpose() * LeastNorm(M_rr, 1e-12).solve(M_rf);
}

double frequency_of(double stiffness, double mass) {
  if (!(stiffness > 0.0)) return 0.0;
  if (!(mass > 0.0)) return std::numeric_limits<double>::infinity();
  return std::sqrt(stiffness / mass) / two_pi;
}

/// K x = omega^2 M x with a mass matrix that need not be definite: M x = (1 / omega^2) K x.
VecX frequencies(const MatX& K, const MatX& M) {
  const SymmetricEigen inverse = generalised_eigenvalues(M, K);
  VecX f = VecX::Constant(K.rows(), std::numeric_limits<double>::infinity());
  if (!inverse.found) return f;
  const double least = 1e-14 * inverse.values.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < f.size(); ++k)
    if (inverse.values[k] > least) f[k] = 1.0 / (two_pi * std::sqrt(inverse.values[k]));
  std::sort(f.begin(), f.end());
  return f;
}

/// Markers through which joints, rods and forces act on a body; outputs are no loads.
std::set<int> loaded_markers(const Model& model, int body) {
  std::set<int> markers;
  const auto add = [&](int m) {
    if (m >= 0 && model.markers[static_cast<std::size_t>(m)].body == body) markers.insert(m);
  };
  for (const Joint& j : model.joints) add(j.frame_F), add(j.frame_M);
  for (const Rod& r : model.rods) add(r.a), add(r.b);
  for (const Force& f : model.forces) add(f.a), add(f.b);
  return markers;
}

/// One column for each unit load.
MatX unit_loads(const Model& model, int index) {
  const Body& body = model.bodies[static_cast<std::size_t>(index)];
  std::vector<VecX> columns;
  for (const int m : loaded_markers(model, index)) {
    const Marker& marker = model.markers[static_cast<std::size_t>(m)];
    if (marker.node < 0) continue;
    const ModalNode& node = body.data->nodes[static_cast<std::size_t>(marker.node)];
    const Mat3X X = node.X - skew(marker.X_NM.p) * node.X_theta;
    for (int i = 0; i < 3; ++i) columns.emplace_back(X.row(i).transpose());
    if (!marker.rotates) continue;
    for (int i = 0; i < 3; ++i) columns.emplace_back(node.X_theta.row(i).transpose() / body.length);
  }
  MatX loads(body.modes(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k)
    loads.col(static_cast<Eigen::Index>(k)) = columns[k];
  return loads;
}

/// The share of each amplitude in the strain energy of the states in the columns of `y`.
VecX shares(const MatX& K, const MatX& K_inverse, const MatX& y) {
  const double all = (K * y).cwiseProduct(y).sum();
  VecX share = VecX::Zero(K.rows());
  for (Eigen::Index k = 0; k < K.rows(); ++k)
    if (all > 0.0 && K_inverse(k, k) > 0.0)
      share[k] = y.row(k).squaredNorm() / (K_inverse(k, k) * all);
  return share;
}

/// Outputs of all amplitudes of all bodies, after those of the model.
Model watched(const Model& model) {
  Model out = model;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    for (int k = 0; k < model.bodies[i].modes(); ++k) {
      Output o;
      o.kind = OutputKind::modal_amplitude;
      o.body = static_cast<int>(i);
      o.component = k;
      out.outputs.push_back(o);
    }
  return out;
}

BodyAdvice body_advice(const Model& model, int index, const MatX& y, const VecX& times, double h) {
  const Body& body = model.bodies[static_cast<std::size_t>(index)];
  const FlexibleBody& data = *body.data;
  const MatX M = modal_mass(data.invariants), M_free = recoil_mass(data.invariants);
  const MatX K_inverse = LeastNorm(data.K).pseudo_inverse();
  const VecX static_shares = shares(data.K, K_inverse, K_inverse * unit_loads(model, index));
  const VecX dynamic_shares = shares(data.K, K_inverse, y);
  BodyAdvice advice;
  advice.body = index;
  advice.name = body.name;
  advice.free_frequencies = frequencies(data.K, M_free);
  for (int k = 0; k < body.modes(); ++k) {
    ModeAdvice m;
    m.mode = k;
    const auto n = static_cast<std::size_t>(k);
    m.name = n < data.mode_names.size() ? data.mode_names[n] : "mode " + std::to_string(k + 1);
    m.frequency = frequency_of(data.K(k, k), M(k, k));
    m.free_frequency = frequency_of(data.K(k, k), std::max(M_free(k, k), 1e-12 * M(k, k)));
    m.step_phase = two_pi * m.free_frequency * h;
    m.static_share = static_shares[k];
    m.dynamic_share = dynamic_shares[k];
    const auto series = y.row(k);
    const Eigen::Index count = series.size();
    if (count > 0) {
      m.rms = std::sqrt(series.squaredNorm() / static_cast<double>(count));
      m.peak = series.cwiseAbs().maxCoeff();
      const double mean = series.mean();
      double kinetic = 0.0, strain = 0.0;
      for (Eigen::Index t = 1; t < count; ++t) {
        const double dt = times[t] - times[t - 1];
        if (!(dt > 0.0)) continue;
        const double rate = (series[t] - series[t - 1]) / dt;
        const double middle = 0.5 * (series[t] + series[t - 1]) - mean;
        kinetic += M(k, k) * rate * rate * dt;
        strain += data.K(k, k) * middle * middle * dt;
      }
      m.kinetic_ratio = strain > 0.0 ? kinetic / strain : 0.0;
    }
    advice.modes.push_back(std::move(m));
  }
  return advice;
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

/// Range of each output of the full model and what the solver's tolerance makes of it.
std::vector<OutputDifference> scales(const ResultTable& full, const ResultTable& other,
                                     std::size_t outputs) {
  std::vector<OutputDifference> out;
  for (std::size_t c = 1; c <= outputs; ++c) {
    OutputDifference d;
    d.name = full.columns[c].name;
    d.unit = full.columns[c].unit;
    double low = 0.0, high = 0.0;
    for (std::size_t r = 0; r < full.rows(); ++r) {
      const double x = full.at(r, c);
      low = r == 0 ? x : std::min(low, x);
      high = r == 0 ? x : std::max(high, x);
      if (r < other.rows()) d.noise = std::max(d.noise, std::abs(x - other.at(r, c)));
    }
    d.range = high - low;
    out.push_back(std::move(d));
  }
  return out;
}

std::vector<OutputDifference> compare(const std::vector<OutputDifference>& scale,
                                      const ResultTable& full, const ResultTable& reduced) {
  std::vector<OutputDifference> out;
  for (std::size_t c = 1; c < reduced.columns.size(); ++c) {
    std::size_t f = 0;
    while (f < scale.size() && scale[f].name != reduced.columns[c].name) ++f;
    if (f == scale.size()) continue;
    OutputDifference d = scale[f];
    double largest_range = 0.0;
    for (const OutputDifference& other : scale)
      if (other.unit == d.unit) largest_range = std::max(largest_range, other.range);
    const std::size_t rows = std::min(full.rows(), reduced.rows());
    double high[2] = {0, 0}, low[2] = {0, 0};
    for (std::size_t r = 0; r < rows; ++r) {
      const double x[2] = {full.at(r, f + 1), reduced.at(r, c)};
      for (int i = 0; i < 2; ++i) {
        high[i] = r == 0 ? x[i] : std::max(high[i], x[i]);
        low[i] = r == 0 ? x[i] : std::min(low[i], x[i]);
      }
      d.largest = std::max(d.largest, std::abs(x[0] - x[1]));
      d.rms += (x[0] - x[1]) * (x[0] - x[1]) / static_cast<double>(rows);
    }
    d.rms = std::sqrt(d.rms);
    d.peaks = std::max(std::abs(high[0] - high[1]), std::abs(low[0] - low[1]));
    const double judged = std::max(d.rms, d.peaks);
    const bool still = d.range <= 1e-3 * largest_range && d.largest <= 10.0 * d.noise;
    const double range = std::max(d.range, 1e-6 * largest_range);
    if (full.rows() != reduced.rows())
      d.relative = std::numeric_limits<double>::infinity();
    else if (judged > 0.0 && !still)
      d.relative = range > 0.0 ? judged / range : std::numeric_limits<double>::infinity();
    out.push_back(std::move(d));
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const auto& a, const auto& b) { return a.relative > b.relative; });
  return out;
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
    if (o.kind == OutputKind::modal_amplitude) {
      const std::vector<int>& modes = keep[static_cast<std::size_t>(o.body)];
      const auto it = std::find(modes.begin(), modes.end(), o.component);
      if (it == modes.end()) continue;
      o.component = static_cast<int>(it - modes.begin());
    }
    outputs.push_back(std::move(o));
  }
  out.outputs = std::move(outputs);
  return out;
}

ModeAdviceReport advise_modes(const Model& model, const SimulationDescription& given,
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
    scale = scales(table, other_table, model.outputs.size());
  }

  // The largest number of candidates whose loss the outputs do not show, by halving.
  const auto without = [&](std::size_t count) {
    const std::set<const ModeAdvice*> gone(candidates.begin(),
                                           candidates.begin() + static_cast<std::ptrdiff_t>(count));
    std::vector<std::vector<int>> keep(model.bodies.size());
    for (const BodyAdvice& body : report.bodies)
      for (const ModeAdvice& m : body.modes)
        if (!gone.contains(&m)) keep[static_cast<std::size_t>(body.body)].push_back(m.mode);
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
  while (bad - good > 1) {
    // All of them first: most often that is the answer.
    const std::size_t at = bad == steps.size() ? bad - 1 : (good + bad) / 2;
    const std::size_t count = steps[at];
    const Model trial = without(count);
    ++report.trials;
    bool passed = false;
    std::vector<OutputDifference> differences;
    try {
      const RunResult result = run(trial, simulation);
      differences = compare(scale, table, result.table);
      passed = result.summary.status == "completed";
      for (const OutputDifference& d : differences)
        passed = passed && d.relative <= options.tolerance;
    } catch (const RunError&) {  // a model that cannot be assembled or moved without these modes
    }
    if (passed) {
      good = at;
      report.differences = std::move(differences);
      reduced = trial;
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
  for (std::size_t k = 0; k < report.bodies.size(); ++k) {
    report.flops_full += flops(static_cast<double>(report.bodies[k].modes.size()), report.full);
    report.flops_reduced += flops(kept_modes[k], report.full);
  }
  return report;
}

}  // namespace floatframe
