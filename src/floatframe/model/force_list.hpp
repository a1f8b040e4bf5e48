#pragma once
// All kinds of force elements. One entry is the enumerator of ForceType, the word of model files
// and the name of the source file model/forces/<name>.cpp, which ends in the ForceKind
// `<name>_element`. Everything else runs over this list. Numbers and messages follow its order.
#include "floatframe/core/enum_index.hpp"

// clang-format off
#define FLOATFRAME_FORCES(entry) \
  entry(spring_damper)           \
  entry(guided_spring)           \
  entry(joint_spring)            \
  entry(tyre)                    \
  entry(bushing)                 \
  entry(force)                   \
  entry(torque)                  \
  entry(bearing)
// clang-format on

namespace floatframe {

#define FLOATFRAME_ENUMERATOR(name) name,
enum class ForceType { FLOATFRAME_FORCES(FLOATFRAME_ENUMERATOR) };
#undef FLOATFRAME_ENUMERATOR

#define FLOATFRAME_ENUMERATOR(name) ForceType::name,
inline constexpr ForceType force_types[] = {FLOATFRAME_FORCES(FLOATFRAME_ENUMERATOR)};
#undef FLOATFRAME_ENUMERATOR

#define FLOATFRAME_WORD(name) #name,
inline constexpr const char* force_words[] = {FLOATFRAME_FORCES(FLOATFRAME_WORD)};
#undef FLOATFRAME_WORD

/// "spring_damper", "tyre", ...
constexpr const char* force_type_name(ForceType type) noexcept {
  return force_words[index_of(type)];
}

}  // namespace floatframe
