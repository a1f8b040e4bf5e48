#include "floatframe/advice/model_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "floatframe/advice/output_differences.hpp"
#include "floatframe/body/second_order_on_masses.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/linear/linear_system.hpp"
#include "floatframe/run/body_energy.hpp"

namespace floatframe {
namespace {

/// Ratio between the frequencies of a body and the range below which the warning is given.
constexpr double enough_above = 1.5;

/// True if it oscillates and is no rigid motion (to round-off).
bool vibrates(const LinearMode& m, double stiffest) {
  return m.lambda.imag() > 1e-7 * std::abs(m.lambda) && std::abs(m.lambda) > 1e-7 * stiffest;
}

double stiffest_of(const std::vector<LinearMode>& modes) {
  return modes.empty() ? 0.0 : std::abs(modes.back().lambda);
}

/// Undamped frequencies of the vibrations, ascending [Hz].
std::vector<double> frequencies_of(const std::vector<LinearMode>& modes) {
  std::vector<double> f;
  for (const LinearMode& m : modes)
    if (vibrates(m, stiffest_of(modes))) f.push_back(m.frequency());
  return f;
}

/// Kinetic energy of a motion e^(lambda t) at its largest, |z| = 1.
double kinetic_energy_of(const Model& model, const LinearSystem& system, const LinearMode& mode) {
  double energy = 0.0;
  std::vector<BodyEnergy> energies;
  for (const Body& b : model.bodies)
    energies.emplace_back(b.data->invariants, second_order_on_masses(*b.data, b.stiffens()).get());
  for (const VecX& z : {VecX(mode.z.real()), VecX(mode.z.imag())}) {
    const VecX rates = system.rates_of * z;
    Eigen::Index row = 0;
    for (std::size_t i = 0; i < model.bodies.size(); ++i) {
      const Body& b = model.bodies[i];
      energy += energies[i].kinetic(rates.segment<3>(row), rates.segment<3>(row + 3),
                                    system.amplitudes[i].data(), rates.data() + row + 6);
      row += 6 + b.modes();
    }
  }
  return energy;
}

/// (1) for every amplitude and one vibration; keeps the largest value.
void estimate(const Model& model, const LinearSystem& system, const LinearMode& mode,
              std::vector<BodyOrder>& bodies) {
  const double w = std::abs(mode.lambda);
  const double T = kinetic_energy_of(model, system, mode);
  const Eigen::VectorXcd y = system.bends_of * mode.z;
  Eigen::Index at = 0;
  for (BodyOrder& b : bodies) {
    const FlexibleBody& data = *model.bodies[b.body].data;
    const InertiaInvariants& I = data.invariants;
    for (int k = 0; k < data.modes(); ++k, ++at) {
      const double mass = I.Sij[0][0](k, k) + I.Sij[1][1](k, k) + I.Sij[2][2](k, k);
      const double change =
          T > 0.0 ? std::abs(data.K(k, k) - w * w * mass) * std::norm(y[at]) / (4.0 * T) : 0.0;
      double& worst = b.estimates[k];
      worst = std::max(worst, change);
    }
  }
}

/// Amplitudes in the order of removal: estimate, entry of `bodies`, mode.
struct Going {
  double change;
  std::size_t body;
  int mode;
};

std::vector<Going> order_of_going(const std::vector<BodyOrder>& bodies) {
  std::vector<Going> all;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t k = 0; k < bodies[i].estimates.size(); ++k)
      all.push_back({bodies[i].estimates[k], i, static_cast<int>(k)});
  std::stable_sort(all.begin(), all.end(),
                   [](const Going& a, const Going& b) { return a.change < b.change; });
  return all;
}

/// Number of amplitudes removed together, those of equal estimates at once.
std::vector<std::size_t> group_ends(const std::vector<Going>& all) {
  std::vector<std::size_t> ends{0};
  for (std::size_t k = 1; k <= all.size(); ++k)
    if (k == all.size() || all[k].change > 1.01 * all[k - 1].change + 1e-15) ends.push_back(k);
  return ends;
}

std::vector<std::vector<int>> kept_without(const Model& model, const std::vector<BodyOrder>& bodies,
                                           const std::vector<Going>& all, std::size_t gone) {
  std::vector<std::vector<int>> keep(model.bodies.size());
  for (std::size_t k = gone; k < all.size(); ++k)
    keep[bodies[all[k].body].body].push_back(all[k].mode);
  for (std::vector<int>& modes : keep) std::sort(modes.begin(), modes.end());
  return keep;
}

/// Frequencies of the range without the amplitudes, and their largest change; infinite if they
/// cannot be computed.
double change_without(const Model& reduced, const std::vector<double>& full,
                      std::vector<double>& found) {
  try {
    found = frequencies_of(linear_modes(linear_system(reduced)));
  } catch (const RunError&) {  // a model that cannot be assembled without these modes
    return std::numeric_limits<double>::infinity();
  }
  if (found.size() < full.size()) return std::numeric_limits<double>::infinity();
  found.resize(full.size());
  double change = 0.0;
  for (std::size_t k = 0; k < full.size(); ++k)
    change = std::max(change, std::abs(found[k] / full[k] - 1.0));
  return change;
}

/// The runs of both models with their outputs compared.
void verify_by_run(const Model& model, const Model& reduced, ModelOrder& order) {
  SimulationDescription simulation = model.simulation;
  simulation.output_interval = 0.0;
  try {
    const RunResult full = run(model, simulation), less = run(reduced, simulation);
    SimulationDescription other = simulation;
    other.tolerance *= 10.0;
    const RunResult loose = run(model, other);
    order.ran = full.summary.status == "completed" && less.summary.status == "completed" &&
                loose.summary.status == "completed";
    if (order.ran)
      order.differences = output_differences(
          output_scales(full.table, loose.table, model.outputs.size()), full.table, less.table);
  } catch (const RunError& error) {
    order.warnings.push_back(std::string("the model does not run: ") + error.what());
  }
}

void warn_of_missing_modes(const Model& model, const ModelOrderOptions& options,
                           ModelOrder& order) {
  for (const BodyOrder& b : order.bodies) {
    if (b.own == 0.0)
      order.warnings.push_back(fmt::format(
          "body '{}' has no normal modes: whether it would need some up to {:g} Hz cannot be told",
          b.name, options.below));
    else if (b.own < enough_above * options.below)
      order.warnings.push_back(
          fmt::format("body '{}' has normal modes up to {:.4g} Hz only, expected {:g} times the "
                      "{:g} Hz of the range: more of them may be needed",
                      b.name, b.own, enough_above, options.below));
  }
  if (order.full.empty())
    order.warnings.push_back(
        fmt::format("'{}' has no vibrations below {:g} Hz", model.name, options.below));
}

}  // namespace

ModelOrder model_order(const Model& model, const ModelOrderOptions& options) {
  if (!(options.below > 0.0) || !std::isfinite(options.below))
    throw InputError(
        ErrorCode::out_of_range,
        fmt::format("below: found {:g}, expected a frequency above 0 [Hz]", options.below));
  if (!(options.tolerance >= 0.0) || !(options.tolerance <= 1.0))
    throw InputError(
        ErrorCode::out_of_range,
        fmt::format("tolerance: found {:g}, expected a number from 0 to 1", options.tolerance));
  ModelOrder order;
  const LinearSystem system = linear_system(model);
  const std::vector<LinearMode> modes = linear_modes(system);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const FlexibleBody& data = *model.bodies[i].data;
    if (data.modes() == 0) continue;
    BodyOrder b;
    b.body = static_cast<int>(i);
    b.name = model.bodies[i].name;
    b.estimates.assign(static_cast<std::size_t>(data.modes()), 0.0);
    if (data.fixed_interface_frequencies.size() > 0)
      b.own = data.fixed_interface_frequencies.maxCoeff();
    order.modes += data.modes();
    order.bodies.push_back(std::move(b));
  }
  for (const LinearMode& m : modes) {
    if (!vibrates(m, stiffest_of(modes)) || m.frequency() > options.below) continue;
    order.full.push_back(m.frequency());
    estimate(model, system, m, order.bodies);
  }
  const std::vector<Going> all = order_of_going(order.bodies);
  const std::vector<std::size_t> ends = group_ends(all);
  std::size_t good = 0, bad = ends.size();
  order.reduced = order.full;
  Model best = model;
  while (bad - good > 1) {
    const std::size_t at = (good + bad) / 2;
    Model trial = with_modes(model, kept_without(model, order.bodies, all, ends[at]));
    ++order.trials;
    std::vector<double> found;
    const double change = change_without(trial, order.full, found);
    if (change <= options.tolerance) {
      good = at;
      order.reduced = std::move(found);
      order.change = change;
      best = std::move(trial);
    } else {
      bad = at;
    }
  }
  const auto keep = kept_without(model, order.bodies, all, ends[good]);
  for (BodyOrder& b : order.bodies) {
    b.needed = keep[b.body];
    order.needed += static_cast<int>(b.needed.size());
  }
  warn_of_missing_modes(model, options, order);
  if (order.needed < order.modes) verify_by_run(model, best, order);
  return order;
}

}  // namespace floatframe
