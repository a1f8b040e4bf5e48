#pragma once
// Interface of a force element. A new one is one file model/forces/<name>.cpp and one entry in
// force_list.hpp: reader, validation, mirror, outputs, energies, statics, both formulations, the
// table of the documentation and the generic tests run over the list.
//
// An element acts on markers a and b (or on b alone) and never accesses a coordinate. Step time
// calls force_of by name, without a pointer: noexcept, no allocation. The pointers of a ForceKind
// are used at load time only.
#include <array>
#include <span>

#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/example_numbers.hpp"
#include "floatframe/model/force_build.hpp"
#include "floatframe/model/force_evaluation.hpp"
#include "floatframe/model/force_outputs.hpp"
#include "floatframe/model/placement.hpp"

namespace floatframe {

/// One element and the data it may use; a is b if the element has no marker a.
struct ForceInput {
  const Model& model;
  const Force& force;
  const MarkerState &a, &b;
  const Vec3& origin;                 ///< reference point of the markers' positions
  double t;                           ///< [s]
  double reference_angle;             ///< selects the turn of a joint angle [rad]
  std::span<const double> inputs;     ///< values of model.inputs
  std::int64_t branch = free_branch;  ///< the held branch

  double input(int index) const noexcept { return index < 0 ? 0.0 : inputs[index]; }
  /// Of a load.
  double magnitude() const noexcept { return evaluate(force.magnitude, t).f + input(force.input); }
  /// A load of this magnitude: along an axis of the world or one that follows the body of b.
  Vec3 load(double magnitude) const noexcept {
    return magnitude * (force.follows ? Vec3(b.R * force.axis) : force.axis);
  }
  /// Force of the actuator; zero for elements without one.
  double actuator() const noexcept { return force.driven ? magnitude() : 0.0; }
};

/// A test regime of the element: contact or none, on a slope, following, ...
struct ForceRegime {
  const char* name;
  /// Terms of the symmetric part of the tangent at rest that the rows of ForceState omit; empty if
  /// none.
  const char* rows_leave_out = "";
  /// At rest the wrench is minus the gradient of the energy, and motion only dissipates energy.
  bool conservative = true;
  bool acts = true;     ///< some wrench in at least some of the examples
  bool regular = true;  ///< the wrench has a derivative here. False where it has none (the ends of
                        ///< a spring coincide, a wheel flat on the road): there the tests check
                        ///< only that the tangent is finite
};

struct ForceExample {
  Model model;  ///< holds the roads
  Force force;
  MarkerState a, b;
  Vec3 origin = Vec3::Zero();
  double t = 0.0, reference_angle = 0.0;
  std::vector<double> inputs;
};

/// Fills `out`, which is zero on entry. The step calls it by name, without a pointer.
template <ForceType type>
void force_of(const ForceInput& in, ForceState& out) noexcept;
/// The exact derivative of the same element in the same state; `out` is zero on entry. It is
/// defined next to the law that it is derived from. Steps use the rows of ForceState instead: the
/// tests compare the rows with it, and it with finite differences.
template <ForceType type>
void force_tangent_of(const ForceInput& in, ForceTangent& out) noexcept;

/// The markers between which an element acts.
enum class ForceMarkers {
  two,       ///< on a and b, which it is built with, alike: action and reaction
  of_joint,  ///< the same, on those of a joint
  one        ///< on b alone
};

struct ForceKind {
  const char* about;  ///< its function: for the documentation, a phrase in Markdown
  std::span<const ForceKey> keys;
  ForceMarkers markers = ForceMarkers::two;
  EnergyCategory energy = EnergyCategory::springs;
  /// The units of its results.
  ForceAxis axis = ForceAxis::along;
  /// It has a length and a rate.
  bool measured = true;
  /// An empty description struct of this type. None: ForceValues.
  ForceDescription::Values (*blank)() = nullptr;
  /// The natural value of a law given as a number: that of the design configuration.
  double (*free_value)(const ForceView& values, const ForceKey& key) = nullptr;
  /// Checks of the values in combination.
  void (*validate)(const ForceCheck& check) = nullptr;
  /// Fills `build.force`; false after an error.
  bool (*build)(ForceBuild& build);
  /// Changes of the mirrored element besides mirrored points and directions.
  void (*mirror)(ForceDescription& force, const Placement& x) = nullptr;
  /// For types that may measure a rotation vector, limited to half a turn: true if it does.
  bool (*ends_at_half_turn)(const Force& force) noexcept = nullptr;
  bool along_line = false;  ///< acts along the line between its ends: undefined if they coincide
  /// For laws with branches. Called between steps.
  ForceSide (*side)(const ForceInput& in) noexcept = nullptr;
  std::span<const ForceRegime> regimes;
  /// A random element and motion in one of the regimes, away from the kinks of its laws.
  ForceExample (*example)(std::size_t regime, ExampleNumbers&);
};

const ForceKind& force_kind(ForceType type) noexcept;

#define FLOATFRAME_KIND(name) extern const ForceKind name##_element;
FLOATFRAME_FORCES(FLOATFRAME_KIND)
#undef FLOATFRAME_KIND

/// Stops of an element with a length.
inline constexpr ForceKey bump_stop_key = {.name = "bump_stop",
                                           .kind = ForceKeyKind::bump_stop,
                                           .about = "below a length",
                                           .of = "spring"};
inline constexpr ForceKey rebound_stop_key = {.name = "rebound_stop",
                                              .kind = ForceKeyKind::rebound_stop,
                                              .about = "above a length",
                                              .of = "spring"};

/// For an element of two frames with the axes e₁, e₂, e₃: `axis` is e₃.
inline constexpr ForceKey axis_2_key = {
    .name = "axis_2",
    .kind = ForceKeyKind::direction,
    .about = "the first axis, e₁, without its part along `axis`; e₂ = e₃ x e₁",
    .vector = {1.0, 0.0, 0.0}};
/// Its design axes.
Mat3 element_axes(const ForceView& values);
/// Its points are on two bodies, its axes differ, and it has a law.
void validate_framed(const ForceCheck& check);
/// The keys of an applied load: a force along, or a torque about the direction.
constexpr std::array<ForceKey, 4> load_keys(ForceAxis axis) {
  using L = AppliedLoadDescription;
  return {{{.name = "body",
            .kind = ForceKeyKind::own_place,
            .about = "where it acts",
            .required = true,
            .member = described_by<&L::at>},
           {.name = "direction",
            .kind = ForceKeyKind::vector,
            .about = "used as given, not normalised",
            .required = true,
            .vector = {1.0, 0.0, 0.0},
            .axial = axis == ForceAxis::about,
            .member = described_by<&L::direction>},
           {.name = "magnitude",
            .kind = ForceKeyKind::load,
            .about = "times the direction",
            .required = true,
            .axis = axis,
            .member = described_by<&L::magnitude>},
           {.name = "follows",
            .kind = ForceKeyKind::flag,
            .about = "the direction turns with the body",
            .member = described_by<&L::follows>}}};
}

/// A law at x on the held branch: the segment of the spring and that of the damper.
struct SpringBranch {
  std::int64_t held;
  static constexpr std::int64_t most = std::int64_t{1} << 31;  ///< stretches of a law
  static std::int64_t of(std::size_t spring, std::size_t damper) noexcept {
    return static_cast<std::int64_t>(spring) * most + static_cast<std::int64_t>(damper);
  }
  std::size_t spring() const noexcept { return static_cast<std::size_t>(held / most); }
  std::size_t damper() const noexcept { return static_cast<std::size_t>(held % most); }
};
inline PiecewisePolynomial::Value spring_of(const ForceInput& in, double x) noexcept {
  if (in.branch == free_branch) return in.force.spring(x);
  return in.force.spring.stretch_value(SpringBranch{in.branch}.spring(), x);
}
inline PiecewisePolynomial::Value damper_of(const ForceInput& in, double rate) noexcept {
  if (in.branch == free_branch) return in.force.damper(rate);
  return in.force.damper.stretch_value(SpringBranch{in.branch}.damper(), rate);
}
/// The side of an element with a spring and a damper, at their arguments.
ForceSide spring_side(const ForceInput& in, double x, double rate) noexcept;

/// Distance of x beyond the nearer edge of segment k, and the segment beyond that edge.
struct StretchSide {
  double beyond;
  std::size_t next;
};
StretchSide stretch_side(const PiecewisePolynomial& f, std::size_t k, double x) noexcept;

/// Gives the element an actuator or a load driven by a function of time and an input.
void add_example_drive(ForceExample& example, ExampleNumbers& numbers);
/// An applied load.
ForceExample example_load(ForceType type, bool follows, ExampleNumbers& numbers);
/// Smooth and curved laws for the examples: spring of a length in [0, 4] m, damper of a rate.
PiecewisePolynomial example_spring(ExampleNumbers& numbers);
PiecewisePolynomial example_damper(ExampleNumbers& numbers);

}  // namespace floatframe
