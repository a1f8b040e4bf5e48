#pragma once
// All kinds of constraint parts. One entry is the enumerator of ConstraintType and the name of the
// file model/constraints/<name>.cpp, which ends in the ConstraintKind `<name>_constraint`
// (constraint_part.hpp). Everything else runs over this list.

// clang-format off
#define FLOATFRAME_CONSTRAINTS(entry) \
  entry(coincident)                   \
  entry(in_line)                      \
  entry(in_plane)                     \
  entry(perpendicular)                \
  entry(distance)                     \
  entry(drive_position)               \
  entry(drive_angle)                  \
  entry(coordinate_displacement)      \
  entry(coordinate_angle)             \
  entry(drive_axis_angle)             \
  entry(drive_distance)               \
  entry(constant_velocity)            \
  entry(cam_angle)                    \
  entry(cam_displacement)             \
  entry(on_curve)                     \
  entry(curve_on_curve)               \
  entry(drive_on_curve)
// clang-format on

namespace floatframe {

#define FLOATFRAME_ENUMERATOR(name) name,
enum class ConstraintType { FLOATFRAME_CONSTRAINTS(FLOATFRAME_ENUMERATOR) };
#undef FLOATFRAME_ENUMERATOR

#define FLOATFRAME_ENUMERATOR(name) ConstraintType::name,
inline constexpr ConstraintType constraint_types[] = {
    FLOATFRAME_CONSTRAINTS(FLOATFRAME_ENUMERATOR)};
#undef FLOATFRAME_ENUMERATOR

}  // namespace floatframe
