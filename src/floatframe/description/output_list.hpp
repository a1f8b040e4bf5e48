#pragma once
// All outputs. One entry is the enumerator of OutputType, the word of model files and the name of
// the source file model/outputs/<name>.cpp, which ends in the output's OutputKind `<name>_output`.
// Everything else runs over this list. Messages follow its order.
#include "floatframe/core/enum_index.hpp"

// clang-format off
#define FLOATFRAME_OUTPUTS(entry) \
  entry(position)                 \
  entry(velocity)                 \
  entry(acceleration)             \
  entry(rotation)                 \
  entry(angular_velocity)         \
  entry(joint_position)           \
  entry(joint_velocity)           \
  entry(modal_amplitude)          \
  entry(force)                    \
  entry(length)                   \
  entry(rate)                     \
  entry(distance)                 \
  entry(joint_force)              \
  entry(joint_torque)             \
  entry(projection_impulse)       \
  entry(rod_force)                \
  entry(motion_force)             \
  entry(motion_power)             \
  entry(power)                    \
  entry(angular_acceleration)     \
  entry(modal_rate)               \
  entry(modal_acceleration)       \
  entry(kinetic_energy)           \
  entry(potential_energy)         \
  entry(elastic_energy)           \
  entry(stress)                   \
  entry(strain)                   \
  entry(section_force)            \
  entry(coupling_force)           \
  entry(travel)                   \
  entry(travel_rate)              \
  entry(controller)               \
  entry(quaternion)               \
  entry(distance_rate)            \
  entry(elastic_displacement)     \
  entry(elastic_rotation)         \
  entry(centre_of_mass)           \
  entry(momentum)                 \
  entry(angular_momentum)         \
  entry(state)                    \
  entry(formula)                  \
  entry(first_crossing)
// clang-format on

namespace floatframe {

#define FLOATFRAME_ENUMERATOR(name) name,
enum class OutputType { FLOATFRAME_OUTPUTS(FLOATFRAME_ENUMERATOR) };
#undef FLOATFRAME_ENUMERATOR

#define FLOATFRAME_ENUMERATOR(name) OutputType::name,
inline constexpr OutputType output_types[] = {FLOATFRAME_OUTPUTS(FLOATFRAME_ENUMERATOR)};
#undef FLOATFRAME_ENUMERATOR

#define FLOATFRAME_WORD(name) #name,
inline constexpr const char* output_words[] = {FLOATFRAME_OUTPUTS(FLOATFRAME_WORD)};
#undef FLOATFRAME_WORD

constexpr const char* output_type_name(OutputType type) noexcept {
  return output_words[index_of(type)];
}

}  // namespace floatframe
