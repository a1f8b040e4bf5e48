#pragma once
// Options shared by analyses of rotors.
#include <optional>
#include <string>

#include "floatframe/math/types.hpp"

namespace floatframe {

struct SpeedRange {
  std::string joint;
  double from = 0.0, to = 0.0, step = 0.0;  ///< [rad/s]
};

/// "motor=0:1200:40". Throws InputError with the name of the option.
SpeedRange speed_range(const std::string& option, const std::string& text);

/// "x", "y", "z"; none: "".
inline std::optional<Vec3> axis_named(const std::string& name) {
  return name.empty() ? std::nullopt : std::optional<Vec3>(Vec3::Unit(name[0] - 'x'));
}

inline constexpr const char* axis_help =
    "Axis of a rotor on a free joint; default: the one about which it is symmetric, or that of its "
    "bearings";

}  // namespace floatframe
