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
  left,    ///< neither stiffness nor mass: ignored
  refused  ///< has values in tables of the format that are not read
};

struct UnvType {
  int number = 0;
  const char* name = "";
  int nodes = 0;
  bool beam = false;  ///< a record of orientation and end sections comes first
  /// A solid, or the shell that it is if a thickness is given to it.
  std::optional<ElementType> element;
  std::array<int, 20> order{};  ///< of these: node k is node order[k] of the file
  UnvUse use = UnvUse::mesh;

  bool solid() const noexcept;
  bool shell() const noexcept { return element && !solid(); }
};

/// Null if the number is not known.
const UnvType* unv_type(int number) noexcept;

}  // namespace floatframe
