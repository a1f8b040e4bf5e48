#pragma once

namespace floatframe {

/// Degrees of freedom of a node, as messages and mode names have them.
inline constexpr const char* node_dof_names[6] = {"ux", "uy", "uz", "rx", "ry", "rz"};
/// The same as users type them.
inline constexpr const char* node_dof_words[6] = {"x", "y", "z", "rx", "ry", "rz"};

}  // namespace floatframe
