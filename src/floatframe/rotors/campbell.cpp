#include "floatframe/rotors/campbell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/rotors/campbell_lines.hpp"
#include "floatframe/rotors/rotor_analysis.hpp"
#include "floatframe/rotors/rotor_symmetry.hpp"

namespace floatframe {
namespace {

void check_options(const CampbellOptions& o) {
  if (o.axis && (!o.axis->allFinite() || !(o.axis->stableNorm() > 0.0)))
    throw InputError(ErrorCode::geometry,
                     fmt::format("the axis of '{}' is ({:g}, {:g}, {:g}), expected a direction",
                                 o.joint, o.axis->x(), o.axis->y(), o.axis->z()));
  if (o.modes < 1)
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("found {} modes to follow, expected at least 1", o.modes));
  for (const double order : o.orders)
    if (!(order > 0.0) || !std::isfinite(order))
      throw InputError(ErrorCode::out_of_range,
                       fmt::format("found the order {:g}, expected a positive number", order));
}

}  // namespace

double CampbellPoint::damping() const noexcept {
  const double size = std::abs(lambda);
  return size > 0.0 ? -lambda.real() / size : 0.0;
}

CampbellDiagram campbell(const Model& model, const CampbellOptions& o) {
  CampbellDiagram d;
  check_options(o);
  d.speeds = rotor_speeds(o.joint, o.from, o.to, o.step);
  const CountedStiffening counted = stiffened_rotor(built(model), o.joint);
  d.stiffened = counted.bodies;
  d.stiffening = counted.sentence;
  TurningModel turning(counted.model, o.joint, o.axis);
  d.dependence_on_angle = turning.dependence_on_angle(d.speeds.back());
  require_symmetry(turning.model(), turning.rotor(), d.dependence_on_angle);
  if (d.dependence_on_angle > 1e-5)
    d.notes.push_back(fmt::format(
        "the rotor is not quite symmetric: eigenvalues change by up to {:.2g} % with its angle",
        100.0 * d.dependence_on_angle));
  if (turning.eccentricity() > 1e-9 * turning.rotor().length)
    d.notes.push_back(
        fmt::format("the centre of mass of the rotor is {:.3g} m from its axis: unbalance is no "
                    "part of the steady state",
                    turning.eccentricity()));
  ModeFollower follower(turning, 64 + 4 * static_cast<int>(d.speeds.size()));
  const TurningModes& first = follower.at(d.speeds.front());
  for (std::size_t k = 0; k < first.size(); ++k)
    if (is_rigid(first, k))
      ++d.rigid;
    else if (first[k].lambda.imag() == 0.0)
      ++d.overdamped;
  const FollowedLines lines = follow_lines(follower, o.modes, d);
  for (const std::string& note : turning.notes()) d.notes.push_back(note);
  const double fastest = std::max(std::abs(d.speeds.front()), std::abs(d.speeds.back()));
  for (std::string& note : stiffening_notes(turning.model(), turning.rotor(), fastest))
    d.notes.push_back(std::move(note));
  find_crossings(follower, o.orders, lines, d);
  d.extra_speeds = follower.extra_speeds();
  return d;
}

}  // namespace floatframe
