#pragma once
// Interface of an output. A new output is one file model/outputs/<name>.cpp and one entry in
// output_list.hpp: reader, validation, mirror, units, the table of the documentation and the
// generic tests run over the list. A sample calls `output_value_of` by name, without a pointer; the
// data of an OutputKind are used at load time.
#include <span>

#include "floatframe/description/rules.hpp"
#include "floatframe/model/element_outputs.hpp"
#include "floatframe/model/system_motion.hpp"

namespace floatframe {

/// Last sample of an output: angles over several turns are continued from there.
struct FollowedOutput {
  bool started = false;
  double time = 0.0, position = 0.0, rate = 0.0;
};

/// The value at a sample: noexcept, no allocation. `last` is the memory of this output.
template <OutputType type>
double output_value_of(const SystemMotion& motion, const Output& output,
                       FollowedOutput& last) noexcept;

/// The entity that an output refers to in a model file, and the fields of `Output` for it.
enum class OutputOf {
  point,       ///< a point on a body: `marker`
  two_points,  ///< {from: place, to: place}: `marker` and `to`
  body,        ///< a body that moves: `body`
  joint,       ///< `joint`, with the number of a coordinate: `component`
  mode,        ///< a flexible body: `body`, with the number of a mode: `component`
  force,       ///< a force element: `force`
  reaction,    ///< what a joint (`joint`) or a rod (`rod`) transmits, about the point of `marker`,
               ///< in the axes of `to`; -1: about its own point, in world axes
  rod,         ///< `rod`
  motion,      ///< a joint with a prescribed motion: `element`
  coupling,    ///< `element`
  controller,  ///< `element`
  gauge        ///< a location of a flexible body with stress data: `body`, `gauge`
};

/// Components with names, of which `Output::component` is one: a column each, or only the one
/// selected by `key`.
struct OutputComponents {
  const char* key = nullptr;
  std::span<const char* const> words;
};
inline constexpr OutputComponents world_axes{"axis", rules::axes};
inline constexpr OutputComponents roll_pitch_yaw_angles{"angle", rules::angles};

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
  MotionNeeds needs_of_motion = {};
};

template <ElementQuantity quantity>
const char* unit_of_force(const Model& model, const Output& output) {
  return element_output_unit(model.elements[output.element], quantity);
}

const OutputKind& output_kind(OutputType type) noexcept;

/// What all outputs of the model need.
MotionNeeds needs_of_outputs(const Model& model) noexcept;

double output_value(const SystemMotion& motion, const Output& output,
                    FollowedOutput& last) noexcept;

#define FLOATFRAME_KIND(name) extern const OutputKind name##_output;
FLOATFRAME_OUTPUTS(FLOATFRAME_KIND)
#undef FLOATFRAME_KIND

}  // namespace floatframe
