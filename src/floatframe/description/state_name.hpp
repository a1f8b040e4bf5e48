#pragma once
// One number of a state by names: a coordinate of a joint, the amplitude of a mode, a state of an
// element, or the rate of one. Linear systems name their states so, and programs set them.
#include <array>
#include <string>

#include "floatframe/core/enum_index.hpp"

namespace floatframe {

enum class StateKind {
  joint,       ///< coordinate `index` of a joint, in the order of its start values
  mode,        ///< mode `index` of a flexible body
  element,     ///< state `index` of an element
  body,        ///< coordinate `index` of a body frame (absolute coordinates)
  input,       ///< derivative `index` of an input of a linear model
  combination  ///< of coordinates, or a motion: it has no name
};
/// In this order.
inline constexpr std::array<const char*, 6> state_kind_names{"joint", "mode",  "element",
                                                             "body",  "input", "combination"};

struct StateName {
  StateKind kind = StateKind::joint;
  std::string name;
  int index = 0;      ///< from 0
  bool rate = false;  ///< its derivative with respect to time
  bool operator==(const StateName&) const = default;
};

inline const char* state_kind_name(StateKind kind) noexcept {
  return state_kind_names[index_of(kind)];
}

/// A number that is wanted of a state.
struct GivenState {
  StateName of;
  double value = 0.0;  ///< [m, rad; m/s, rad/s], of a rotation vector its component
};

}  // namespace floatframe
