#pragma once
// Interface of an output. A new output is one file model/outputs/<name>.cpp and one entry in
// output_list.hpp: reader, validation, mirror, units, the table of the documentation and the
// generic tests run over the list. A sample calls `output_value_of` by name, without a pointer; the
// data of an OutputKind are used at load time, but for `value` and `dual`, which formulas call in
// steps.
#include <array>
#include <numbers>
#include <span>
#include <string>

#include "floatframe/description/rules.hpp"
#include "floatframe/model/element_outputs.hpp"
#include "floatframe/model/measure_ports.hpp"
#include "floatframe/model/system_motion.hpp"

namespace floatframe {

/// Last sample of an output: angles over several turns are continued from there.
struct FollowedOutput {
  bool started = false;
  double time = 0.0;
  std::array<double, 6> values{};     ///< what the kind needs of it; see also UndefinedSample
  std::vector<FollowedOutput> parts;  ///< of the references of a formula
};

/// The value at a sample: noexcept, no allocation. `last` is the memory of this output.
template <OutputType type>
double output_value_of(const SystemMotion& motion, const Output& output,
                       FollowedOutput& last) noexcept;

/// The entity that an output refers to in a model file, and the fields of `Output` for it.
enum class OutputOf {
  point,       ///< a point on a body: `marker`
  two_points,  ///< {from: place, to: place}: `marker` and `to`
  body,        ///< a body that moves: `body`, and by its frame `marker`
  mass,        ///< a body that moves or the model: `body`, -1; about the point of `marker`, -1: the
               ///< origin of the world
  flexible_point,  ///< a point on a body that moves: `body`, `marker`, and as `relative` the frame
                   ///< of the body
  joint,           ///< `joint`, with the number of a coordinate: `component`
  mode,            ///< a flexible body: `body`, with the number of a mode: `component`
  force,           ///< a force element: `force`
  reaction,    ///< what a joint (`joint`) or a rod (`rod`) transmits, about the point of `marker`,
               ///< in the axes of `to`; -1: about its own point, in world axes
  rod,         ///< `rod`
  motion,      ///< a joint with a prescribed motion: `element`
  coupling,    ///< `element`
  path,        ///< `element`, a constraint that keeps a point on a path or a curve through points
  controller,  ///< `element`
  state,       ///< an element, with the number of a state: `element`, `component`
  formula,     ///< `formula`
  crossing,    ///< `formula`, with the direction in which it crosses zero: `component`
  gauge        ///< a location of a flexible body with stress data: `body`, `gauge`
};

/// Components with names, of which `Output::component` is one: a column each, or only the one
/// selected by `key`.
struct OutputComponents {
  const char* key = nullptr;
  std::span<const char* const> words;
  bool one = false;  ///< the first without the key, not a column each
};
inline constexpr OutputComponents world_axes{"axis", rules::axes};
inline constexpr OutputComponents quaternion_components{"component", rules::quaternion};
inline constexpr OutputComponents crossing_directions{"direction", rules::crossing_directions,
                                                      true};
inline constexpr OutputComponents roll_pitch_yaw_angles{"angle", rules::angles};

/// How its components reflect in a mirror (description/placement.hpp); of coordinates of joints
/// their kind knows it. An `axial` one may have a scalar before its three components.
enum class Reflects { no, point, polar, axial };

/// The keys for the frame that a motion is relative to and for axes: `relative`, `axes`.
enum class OutputFrames { none, in, relative_to_and_in };

struct OutputKind {
  const char* about;  ///< its quantity: for the documentation, a phrase in Markdown
  OutputOf of;
  OutputComponents components = {};
  /// If it depends on the entity that the output refers to: all possible values, for the
  /// documentation, and a function that selects one.
  const char* unit;
  const char* (*unit_of)(const Model& model, const Output& output) = nullptr;
  /// For a force element: the required property.
  ElementQuantity needs = ElementQuantity::force;
  /// It is the result `needs` of an element that signals are made of.
  bool is_signal = false;
  /// One of the values of its element, if that has several: the key `output`.
  bool one_of_values = false;
  bool about_point = false;  ///< it is about a point, the key `about`
  bool named_unit = false;   ///< its unit is any text of the user
  MotionNeeds needs_of_motion = {};
  OutputFrames frames = OutputFrames::none;
  Reflects reflects = Reflects::no;
  /// Of measures: the value, and the same with its derivatives.
  double (*value)(const MeasurePorts<double>&) noexcept = nullptr;
  Dual (*dual)(const MeasurePorts<Dual>&) noexcept = nullptr;
};

#define FLOATFRAME_MEASURE(name) .value = name##_measure<double>, .dual = name##_measure<Dual>

/// What a measure reads of the motion at a sample.
inline MeasurePorts<double> measure_ports(const SystemMotion& motion, const Output& output,
                                          double reference = 0.0) noexcept {
  const auto [marker, to, relative, axes] = measure_markers(motion.model, output);
  const auto at = [&](int k) { return k < 0 ? nullptr : motion.markers[k]; };
  return {motion.model, output,   at(marker),    at(to),
          at(relative), at(axes), motion.origin, reference};
}

/// Of a body, or with -1 of all [kg].
double mass_of(const Model& model, int body) noexcept;

/// The value of the formula of an output at a sample; `last` is its memory, which keeps where it
/// first had none.
double sampled_formula(const SystemMotion& motion, const OutputFormula& f,
                       FollowedOutput& last) noexcept;
/// "division by zero in '(1 / x)' at t = 0.2 s", from this memory; empty: it always had a value.
std::string undefined_sample(const OutputFormula& f, const FollowedOutput& last);
/// A formula whose crossing of zero is looked for after each step.
struct Crossing {
  /// In the memory of its output.
  enum Memory : std::size_t {
    value,  ///< the last one that is not zero
    found,  ///< 1 after the crossing ...
    time    ///< ... at this time
  };
  /// From a value to the next one, in the direction of the output.
  static bool between(double before, double after, int direction) noexcept {
    if (before == 0.0 || !(after == after) || (after != 0.0 && (after > 0.0) == (before > 0.0)))
      return false;
    return direction == 0 || (direction == 1) == (before < 0.0);
  }
};

/// A measure that nothing is remembered of.
#define FLOATFRAME_MEASURED(name)                                                            \
  template <>                                                                                \
  double output_value_of<OutputType::name>(const SystemMotion& motion, const Output& output, \
                                           FollowedOutput&) noexcept {                       \
    return name##_measure(measure_ports(motion, output));                                    \
  }

template <ElementQuantity quantity>
const char* unit_of_force(const Model& model, const Output& output) {
  return element_output_unit(model.elements[output.element], quantity);
}

const OutputKind& output_kind(OutputType type) noexcept;

/// The memories of outputs before the first sample. Allocates.
std::vector<FollowedOutput> followed_outputs(std::span<const Output> outputs);

/// Units that a column may have instead of that of SI: `factor` of them make one.
struct OutputUnit {
  const char *si, *unit;
  double factor;
};
inline constexpr double degrees = 180.0 / std::numbers::pi;
inline constexpr OutputUnit output_units[] = {{"rad", "deg", degrees},
                                              {"rad/s", "deg/s", degrees},
                                              {"rad/s", "rpm", degrees / 6.0},
                                              {"rad/s2", "deg/s2", degrees},
                                              {"m", "mm", 1e3},
                                              {"N", "kN", 1e-3},
                                              {"N m", "kN m", 1e-3},
                                              {"Pa", "MPa", 1e-6}};

/// What an output, and what all outputs of the model need.
MotionNeeds needs_of(const Output& output) noexcept;
MotionNeeds needs_of_outputs(const Model& model) noexcept;

double output_value(const SystemMotion& motion, const Output& output,
                    FollowedOutput& last) noexcept;

#define FLOATFRAME_KIND(name) extern const OutputKind name##_output;
FLOATFRAME_OUTPUTS(FLOATFRAME_KIND)
#undef FLOATFRAME_KIND

}  // namespace floatframe
