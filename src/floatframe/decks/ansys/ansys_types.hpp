#pragma once
// Elements of ANSYS by their number, what they are here, and the solids and shells that their
// repeated nodes make of them.
#include <array>
#include <optional>
#include <span>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

enum class AnsysFamily {
  brick,       ///< 8 nodes, may be a wedge, a pyramid or a tetrahedron
  brick20,     ///< the same of second order
  tet,         ///< 4 or 10 nodes
  shell,       ///< 4 or 8 nodes, may be a triangle
  beam2,       ///< 2 nodes and one for the orientation
  beam3,       ///< 3 nodes and one for the orientation
  rod,         ///< 2 nodes
  mass,        ///< 1 node
  spring,      ///< 2 nodes
  matrix,      ///< 2 nodes
  rigid,       ///< MPC184
  contact,     ///< CONTA171 to 178
  target,      ///< TARGE169, 170
  passed_over  ///< neither stiffness nor mass: loads, meshes
};

struct AnsysLibraryElement {
  int number = 0;
  const char* name = "";
  AnsysFamily family = AnsysFamily::brick;
  int nodes = 0;  ///< at most, without those for orientation
};

/// Null if the element is none that is read.
const AnsysLibraryElement* ansys_library_element(int number) noexcept;

/// ET with its KEYOPTs.
struct AnsysType {
  int id = 0, number = 0;
  std::array<int, 19> keyopt{};  ///< by their number, from 1
  FeSource at;
};

/// An element of FeModel: which of the nodes of the ANSYS element it has, in its own order.
struct AnsysShape {
  ElementType type = ElementType::hex8;
  std::array<int, 20> nodes{};
  int count = 0;
};

/// The shape of an element with the given nodes (0: none). Mid-side nodes that are not there have
/// 0 at their place; an element without any is of first order. None if the nodes repeat in a way
/// that makes no element.
std::optional<AnsysShape> ansys_shape(const AnsysLibraryElement& element, const AnsysType& type,
                                      std::span<const int> nodes);

}  // namespace floatframe
