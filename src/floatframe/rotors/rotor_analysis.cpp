#include "floatframe/rotors/rotor_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/run/range_watch.hpp"

namespace floatframe {
namespace {

constexpr std::size_t most_speeds = 2000;
/// Above it squares of speeds are out of range for the eigenvalue computation.
constexpr double most_speed = 1e9;

}  // namespace

std::vector<double> rotor_speeds(const std::string& joint, double from, double to, double step) {
  if (std::max(std::abs(from), std::abs(to)) > most_speed)
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("speeds of '{}': found {:g} to {:g} rad/s, expected at most {:g}",
                                 joint, from, to, most_speed));
  if (!(step > 0.0) || !(to > from) || !std::isfinite(from) || !std::isfinite(to) ||
      !std::isfinite(step))
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("speeds of '{}': found {:g} to {:g} in steps of {:g} rad/s, "
                                 "expected an ascending range and a positive step",
                                 joint, from, to, step));
  if ((to - from) / step > static_cast<double>(most_speeds))
    throw InputError(
        ErrorCode::too_large,
        fmt::format("speeds of '{}': more than {} speeds; take a larger step", joint, most_speeds));
  std::vector<double> speeds;
  const auto n = static_cast<std::size_t>(std::floor((to - from) / step + 1e-9));
  for (std::size_t k = 0; k <= n; ++k) speeds.push_back(from + static_cast<double>(k) * step);
  if (to - speeds.back() > 1e-9 * step) speeds.push_back(to);
  return speeds;
}

CountedStiffening stiffened_rotor(const Model& model, const std::string& joint) {
  return counted_stiffening(model, rotor_bodies(model, joint));
}

std::vector<std::string> stiffening_notes(const Model& model, const Rotor& rotor, double speed) {
  std::vector<std::string> notes;
  for (const RotorBody& r : rotor.bodies) {
    const Body& b = model.bodies[static_cast<std::size_t>(r.body)];
    if (b.modes() == 0) continue;
    if (b.data->mass_model == MassModel::six_dof)
      notes.push_back(fmt::format(
          "body '{}' has mass_model six_dof, which has no second order of its turning sections: "
          "whirl at speed is in error; mass_model: hermite with section_inertia: true has it",
          b.name));
    if (b.stiffens()) continue;
    const BodyRange range(model, r.body);
    const Vec3 w = speed * r.axis;
    const double lowest = range.lowest_frequency(), pulling = range.loading_spin(w);
    if (!(lowest > 0.0) || !(pulling > RangeLimits{}.spin * lowest)) continue;
    if (b.stiffening_given)
      notes.push_back(spin_sentence(model, range, r.body, w));
    else
      notes.push_back(fmt::format(
          "body '{}' spins at {:.4g} rad/s, {:.3g} times its lowest frequency of {:.4g} rad/s, "
          "and what that does to its stiffness is not known",
          b.name, pulling, pulling / lowest, lowest));
  }
  return notes;
}

}  // namespace floatframe
