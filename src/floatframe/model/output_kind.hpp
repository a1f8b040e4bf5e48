#pragma once
// What an output must supply. A new output is one file model/outputs/<name>.cpp and one entry in
// output_list.hpp: reader, validation, mirror, units, the table of the documentation and the
// generic tests run over the list. A sample calls `output_value_of` by name, without a pointer; the
// facts of an OutputKind serve load time.
#include <span>

#include "floatframe/model/force_outputs.hpp"
#include "floatframe/model/output_view.hpp"
#include "floatframe/model/rules.hpp"

namespace floatframe {

/// The value at a sample: noexcept, no allocation. `last` is the output's own memory.
template <OutputType type>
double output_value_of(const OutputView& view, const Output& output, FollowedOutput& last) noexcept;

/// What an output refers to in a model file, and the fields of `Output` that hold it.
enum class OutputOf {
  point,       ///< a place on a body: `marker`
  two_points,  ///< {from: place, to: place}: `marker` and `to`
  body,        ///< a body that moves: `body`
  joint,       ///< `joint`, with the number of a coordinate: `component`
  mode,        ///< a flexible body: `body`, with the number of a mode: `component`
  force,       ///< a force element: `force`
  reaction,    ///< what a joint (`joint`) or a rod (`rod`) transmits, about the point of `marker`,
               ///< in the axes of `to`; -1: about its own point, in world axes
  rod,         ///< `rod`
  motion,      ///< a joint with a prescribed motion: `joint`
  gauge        ///< a place of a flexible body where stress is known: `body`, `gauge`
};

/// What must be computed for a sample beside the motion.
enum class OutputTerms {
  forces,    ///< of the force elements
  inertia,   ///< mass matrices of the bodies, too
  reactions  ///< accelerations and reactions that satisfy the equations of motion, too
};

/// Components with names, of which `Output::component` is one: a column each, or the one that `key`
/// picks.
struct OutputComponents {
  const char* key = nullptr;
  std::span<const char* const> words;
};
inline constexpr OutputComponents world_axes{"axis", rules::axes};
inline constexpr OutputComponents roll_pitch_yaw_angles{"angle", rules::angles};

struct OutputKind {
  const char* about;  ///< what it measures: the documentation, a phrase in Markdown
  OutputOf of;
  OutputComponents components = {};
  /// Where it depends on what the output refers to: all it may be, for the documentation, and a
  /// function that picks it.
  const char* unit;
  const char* (*unit_of)(const Model& model, const Output& output) = nullptr;
  /// Of a force element: what it must have.
  ForceQuantity needs = ForceQuantity::force;
  OutputTerms terms = OutputTerms::forces;
};

template <ForceQuantity quantity>
const char* unit_of_force(const Model& model, const Output& output) {
  return force_output_unit(model.forces[output.force], quantity);
}

const OutputKind& output_kind(OutputType type) noexcept;

/// The most that any output of the model asks for.
OutputTerms output_terms(const Model& model) noexcept;

double output_value(const OutputView& view, const Output& output, FollowedOutput& last) noexcept;

#define FLOATFRAME_KIND(name) extern const OutputKind name##_output;
FLOATFRAME_OUTPUTS(FLOATFRAME_KIND)
#undef FLOATFRAME_KIND

}  // namespace floatframe
