#include "floatframe/simulation/rotor_stiffening.hpp"

#include <fmt/format.h>

#include <cmath>

#include "floatframe/simulation/range_watch.hpp"

namespace floatframe {

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
    const double lowest = range.lowest_frequency(), pulling = range.pulling_spin(w);
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
