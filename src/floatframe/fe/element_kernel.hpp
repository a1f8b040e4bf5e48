#pragma once
// What an element type must supply. A new type is one file with these functions and one entry in
// the list of element_kernels.cpp; assembly, invariants and the generic tests run over the list.
#include <span>
#include <string>

#include "floatframe/fe/fe_system.hpp"

namespace floatframe {

/// One element's data, gathered.
struct ElementInput {
  std::array<Vec3, 20> p;  ///< node positions
  Material material;
  BeamSection section;
  ShellSection shell;
  Vec3 reference = Vec3::UnitZ();
  Integration integration = Integration::exact;
};

struct ElementKernel {
  ElementType type;
  const char* name;
  int nodes;
  int dofs_per_node;  ///< 6: ux uy uz rx ry rz; 3: ux uy uz
  /// What is wrong with the geometry or section, as the end of a sentence; empty if nothing is.
  std::string (*fault)(const ElementInput&);
  /// Stiffness in body axes.
  void (*stiffness)(const ElementInput&, MatX&);
  /// Consistent mass in body axes.
  void (*mass)(const ElementInput&, bool section_inertia, MatX&);
  /// int N^T N dm of the linear shape functions.
  void (*scalar_mass)(const ElementInput&, MatX&);
  /// Strains (xx, yy, zz, xy, yz, zx; engineering shear) at the nodes, 6 rows a node, from the
  /// displacements of the nodes: taken at the points where they are best and carried to the nodes.
  /// Null for beams and shells.
  void (*nodal_strains)(const ElementInput&, MatX&) = nullptr;
};

constexpr bool is_beam(ElementType t) { return t == ElementType::beam2 || t == ElementType::beam3; }
constexpr bool is_shell(ElementType t) { return t == ElementType::tri3 || t == ElementType::quad4; }

std::span<const ElementKernel> element_kernels();
const ElementKernel& element_kernel(ElementType type);
ElementInput gather(const FeModel& model, const Element& element,
                    Integration integration = Integration::exact);

/// Local axes of a beam: columns x (from node 1 to node 2), y (in the plane of x and the
/// reference), z.
Mat3 beam_axes(const ElementInput& input);

/// Isotropic elasticity matrix for the strains (xx, yy, zz, xy, yz, zx) with engineering shear.
Mat6 elasticity_matrix(const Material& material);

extern const ElementKernel beam2_kernel;
extern const ElementKernel beam3_kernel;
extern const ElementKernel tri3_kernel;
extern const ElementKernel quad4_kernel;
extern const ElementKernel tet4_kernel;
extern const ElementKernel tet10_kernel;
extern const ElementKernel hex8_kernel;
extern const ElementKernel hex8i_kernel;
extern const ElementKernel hex8r_kernel;
extern const ElementKernel hex20_kernel;
extern const ElementKernel hex20r_kernel;
extern const ElementKernel wedge6_kernel;
extern const ElementKernel wedge15_kernel;

}  // namespace floatframe
