#pragma once
// What a kind of force must supply. A new kind is one file force_*.cpp with the functions force_of
// and force_tangent_of and a ForceKind, and one entry in the list of force_kinds.cpp; evaluation,
// outputs and the generic tests run over the list. The two functions belong to the step: noexcept,
// no allocation.
#include <span>

#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/example_numbers.hpp"
#include "floatframe/model/force_evaluation.hpp"

namespace floatframe {

/// One element and what it may look at; a is b where the element has no marker a.
struct ForceInput {
  const Model& model;
  const Force& force;
  const MarkerState &a, &b;
  const Vec3& origin;              ///< the markers' positions are measured from here
  double t;                        ///< [s]
  double reference_angle;          ///< picks the turn of a joint angle [rad]
  std::span<const double> inputs;  ///< values of model.inputs

  double input(int index) const noexcept { return index < 0 ? 0.0 : inputs[index]; }
  /// Of a load.
  double magnitude() const noexcept { return evaluate(force.magnitude, t).f + input(force.input); }
  /// Force of the actuator; zero for elements without one.
  double actuator() const noexcept { return force.driven ? magnitude() : 0.0; }
};

/// A way in which the element can be found: contact or none, on a slope, following, ...
struct ForceRegime {
  const char* name;
  /// What the rows of ForceState leave out of the symmetric part of the tangent at rest; empty if
  /// nothing.
  const char* rows_leave_out = "";
  /// At rest the wrench is minus the gradient of the energy, and moving only takes energy out.
  bool conservative = true;
  bool acts = true;     ///< some wrench in at least some of the examples
  bool regular = true;  ///< has a tangent here; at a singular place it only has to stay finite
};

struct ForceExample {
  Model model;  ///< holds the roads
  Force force;
  MarkerState a, b;
  Vec3 origin = Vec3::Zero();
  double t = 0.0, reference_angle = 0.0;
  std::vector<double> inputs;
};

/// Fills `out`, which comes with zeros. The step calls these by name, without a pointer.
template <ForceType type>
void force_of(const ForceInput& in, ForceState& out) noexcept;
template <ForceType type>
void force_tangent_of(const ForceInput& in, ForceTangent& out) noexcept;

struct ForceKind {
  ForceType type;
  const char* name;
  bool between_markers;  ///< acts on a and b, and on both alike; otherwise on b alone
  void (*evaluate)(const ForceInput&, ForceState& out) noexcept;
  void (*tangent)(const ForceInput&, ForceTangent& out) noexcept;
  std::span<const ForceRegime> regimes;
  /// A random element and motion in one of the regimes, away from the breaks of its laws.
  ForceExample (*example)(std::size_t regime, ExampleNumbers&);
};

/// In the order of ForceType.
std::span<const ForceKind* const> force_kinds() noexcept;

extern const ForceKind spring_damper_kind;
extern const ForceKind guided_spring_kind;
extern const ForceKind joint_spring_kind;
extern const ForceKind tyre_kind;
extern const ForceKind applied_force_kind;
extern const ForceKind applied_torque_kind;

/// Gives the element an actuator or a load driven by a function of time and an input.
void add_example_drive(ForceExample& example, ExampleNumbers& numbers);
/// Smooth and curved laws for the examples: spring of a length in [0, 4] m, damper of a rate.
PiecewisePolynomial example_spring(ExampleNumbers& numbers);
PiecewisePolynomial example_damper(ExampleNumbers& numbers);

}  // namespace floatframe
