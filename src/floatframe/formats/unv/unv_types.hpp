#pragma once
// Finite elements of universal files by their descriptor number, and the order of their nodes.
#include <array>
#include <optional>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// What becomes of an element.
enum class UnvUse {
  mesh,    ///< a solid, or a skin or edge that makes node sets
  rigid,   ///< its nodes move as one rigid body
  left,    ///< neither stiffness nor mass: passed over
  refused  ///< has values in tables of the format that are not read
};

struct UnvType {
  int number = 0;
  const char* name = "";
  int nodes = 0;
  bool beam = false;                 ///< a record of orientation and end sections comes first
  std::optional<ElementType> solid;  ///< the solid element that it is, if there is one
  std::array<int, 20> order{};       ///< of solids and shells: node k is node order[k] of the file
  UnvUse use = UnvUse::mesh;
  std::optional<ElementType> shell = {};  ///< that it is if a thickness is given to it
};

/// Null if the number is not known.
const UnvType* unv_type(int number) noexcept;

}  // namespace floatframe
