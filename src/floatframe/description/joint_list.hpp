#pragma once
// All joints. One entry is the enumerator of JointType, the word of model files and the name of the
// source file model/joints/<name>.cpp, which ends in the joint's JointKind `<name>_joint`.
// Everything else runs over this list. Numbers and messages follow its order.
#include "floatframe/core/enum_index.hpp"

// clang-format off
#define FLOATFRAME_JOINTS(entry) \
  entry(weld)                    \
  entry(revolute)                \
  entry(prismatic)               \
  entry(cylindrical)             \
  entry(universal)               \
  entry(spherical)               \
  entry(planar)                  \
  entry(free)
// clang-format on

namespace floatframe {

#define FLOATFRAME_ENUMERATOR(name) name,
enum class JointType { FLOATFRAME_JOINTS(FLOATFRAME_ENUMERATOR) };
#undef FLOATFRAME_ENUMERATOR

#define FLOATFRAME_ENUMERATOR(name) JointType::name,
inline constexpr JointType joint_types[] = {FLOATFRAME_JOINTS(FLOATFRAME_ENUMERATOR)};
#undef FLOATFRAME_ENUMERATOR

#define FLOATFRAME_WORD(name) #name,
inline constexpr const char* joint_words[] = {FLOATFRAME_JOINTS(FLOATFRAME_WORD)};
#undef FLOATFRAME_WORD

constexpr const char* joint_type_name(JointType type) noexcept {
  return joint_words[index_of(type)];
}

}  // namespace floatframe
