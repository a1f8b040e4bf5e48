// The sentence about a step that failed.
#include <fmt/format.h>

#include <cmath>

#include "floatframe/loops/redundancy.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/lift_checks.hpp"
#include "floatframe/start/light_motion.hpp"
#include "floatframe/start/positive_mass.hpp"
#include "floatframe/stepping/stepper.hpp"
#include "floatframe/tangents/overflow.hpp"

namespace floatframe {
namespace {

/// `lost_mass` of the first body with a message.
std::string lost_masses(const SystemMotion& motion) {
  for (std::size_t i = 0; i < motion.bodies.size(); ++i)
    if (std::string text = lost_mass(motion.model.bodies[i], motion.bodies[i].y); !text.empty())
      return text;
  return {};
}

/// Of the first cam that comes to an end of its lift.
std::string lost_lift_text(const Formulation& f) {
  for (std::size_t k = 0; k < f.model().elements.size(); ++k)
    if (std::string why = lift_complaint(f.ports(k), true); !why.empty()) return why;
  return {};
}

}  // namespace

std::string Stepper::failure() {
  if (has_thrown()) return thrown_sentence(f_, state_.t);
  if (std::string why = undefined_formula(); !why.empty()) return why;
  std::string text = step_failure();  // first: refers to the failed iteration
  if (std::string numbers = overflow(); !numbers.empty()) text = std::move(numbers);
  kinematics_at(f_, state_);
  if (const std::string lift = lost_lift_text(f_); !lift.empty()) return text + "; " + lift;
  const std::string lost = lost_masses(f_.motion());
  return text + (lost.empty() ? light_motion_note(f_, state_) : "; " + lost);
}

/// If a formula has no value: at the failed iteration, or at the instant of a sample.
std::string Stepper::undefined_formula() {
  const int k = largest_force();
  if (undefined_)
    kinematics_at(f_, state_);
  else if (last_.element < 0 && (k < 0 || !std::isnan(f_.effort(k).force)))
    return {};
  const std::string why = undefined_formula_text(f_);
  if (why.empty()) return {};
  const std::string substeps =
      undefined_ ? "" : fmt::format(" after substeps down to {:.3g} s", smallest());
  return fmt::format("step failed at t = {:.6g} s{}: {}", state_.t, substeps, why);
}

std::string Stepper::crowded_edges() const {
  constexpr double few = 0.01;  // of all steps
  const long passed = counters_.edges_passed;
  if (!locator_ || !(static_cast<double>(passed) > few * static_cast<double>(counters_.steps)))
    return {};
  const int k = locator_->crowded();
  const std::string where =
      k < 0 ? ""
            : fmt::format(": {} from t = {:.4g} s on", element_name(model().elements[k]),
                          locator_->crowded_at());
  return fmt::format(
      "{} of {} steps had too many edges to locate and were finished without locate_edges{}; where "
      "friction sticks at a jump of its law, give it the width of sign(x, w), or take the friction "
      "of a joint or bristle_friction",
      passed, counters_.steps, where);
}

std::string Stepper::undefined_outputs() const {
  std::string first;
  int others = 0;
  const auto look = [&](const Output& output, const FollowedOutput& memory) {
    if (!output.formula) return;
    const std::string why = undefined_sample(*output.formula, memory);
    if (why.empty()) return;
    if (first.empty())
      first = fmt::format("output '{}' has no value: {}", output.name, why);
    else
      ++others;
  };
  for (std::size_t k = 0; k < model().outputs.size(); ++k) look(model().outputs[k], outputs_[k]);
  if (until_) look(*model().until, outputs_.back());
  return others == 0 ? first : fmt::format("{} (and {} more)", first, others);
}

/// From the results of the last iteration.
std::string Stepper::step_failure() {
  if (std::string text = unreachable_tolerance(); !text.empty()) return text;
  const char* what =
      last_.status == AttemptStatus::singular_tangent ? "the tangent matrix is singular at "
      : last_.status == AttemptStatus::not_finite     ? "the state is no longer finite; look at "
      : last_.status == AttemptStatus::states_not_solved
          ? "the equations of its states have no solution; look at "
          : "no convergence; look at ";
  // An excessive force is a more useful hint than the coordinate it acts on.
  const int force = largest_force();
  const bool unknown = force >= 0 && std::isnan(f_.effort(force).force);
  const std::string who = unknown              ? "force '" + model().elements[force].name + "'"
                          : last_.element >= 0 ? element_name(model().elements[last_.element])
                          : last_.constraint >= 0
                              ? f_.constraint_set().owner_of_row(last_.constraint)
                          : last_.coordinate >= 0 ? f_.coordinate_owner(last_.coordinate)
                                                  : "the constraints";
  std::string text =
      fmt::format("step failed at t = {:.6g} s after substeps down to {:.3g} s: {}{}", state_.t,
                  smallest(), what, who);
  if (force >= 0)
    text += fmt::format(" (largest force: '{}', {:.3g} N)", model().elements[force].name,
                        f_.effort(force).force);
  return text + singular_position();
}

/// The rest of the sentence if nearly dependent constraints prevent the step.
std::string Stepper::singular_position() {
  constexpr int most = 1000;  // coordinates; dense linear algebra
  if (last_.status != AttemptStatus::not_converged || f_.constraints() == 0 ||
      f_.velocities() > most || !nearly_dependent(f_.constraint_jacobian()))
    return {};
  return fmt::format(
      "; constraints nearly depend on each other there: next to a singular position where the "
      "mechanism may branch a smaller step or a tolerance above {:g} may pass",
      step_options_.tolerance);
}

int Stepper::largest_force() const noexcept {
  double worst = 0.0;
  int force = -1;
  for (std::size_t k = 0; k < model().elements.size(); ++k) {
    const double x = std::abs(f_.effort(k).force);
    if (std::isnan(x)) return k;
    if (x > worst) {
      worst = x;
      force = k;
    }
  }
  return force;
}

/// If numbers of the model are too large to compute with.
std::string Stepper::overflow() {
  std::string text;
  if (!(asked_ < largest_beside_one))
    text = fmt::format("the step of {:g} s is too long", asked_);
  else
    text = overflow_text(f_, state_, state_.t + least_, largest_beside_one);
  if (text.empty()) return text;
  return fmt::format("step failed at t = {:.6g} s after substeps down to {:.3g} s: {}", state_.t,
                     smallest(), overflow_sentence(text, state_.t, largest_beside_one));
}

/// If a tolerance needs more digits than double precision has.
std::string Stepper::unreachable_tolerance() const {
  if (last_.status != AttemptStatus::not_converged) return {};
  const bool newton = last_.constraint < 0;
  const double tolerance = newton ? step_options_.tolerance : step_options_.position_tolerance;
  const double size = 1.0 + state_.q.lpNorm<Eigen::Infinity>();
  const double least = 1e-15 * size;
  if (!(tolerance < least)) return {};
  return fmt::format(
      "step failed at t = {:.6g} s after substeps down to {:.3g} s: the {} of {:g} is below the "
      "rounding of double precision, about {:.1g} with coordinates up to {:.3g}; expected more",
      state_.t, smallest(), newton ? "tolerance" : "position_tolerance", tolerance, least,
      size - 1.0);
}

double Stepper::smallest() const noexcept { return std::min(least_, asked_); }

}  // namespace floatframe
