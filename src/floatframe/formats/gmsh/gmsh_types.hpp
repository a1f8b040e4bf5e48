#pragma once
// Element types of Gmsh by their number in the file, and the order of their nodes.
#include <array>
#include <optional>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

struct GmshType {
  int number = 0;
  const char* name = "";
  int dimension = 0;
  int nodes = 0;
  std::optional<ElementType> element;  ///< the solid or shell that it is, if there is one
  std::array<int, 20> order{};  ///< of these: node k of the element is node order[k] of the file
};

/// Of a triangle or quadrilateral of any order.
int surface_corners(const GmshType& type) noexcept;

/// Null if the number is unknown.
const GmshType* gmsh_type(int number) noexcept;

}  // namespace floatframe
