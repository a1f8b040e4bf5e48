#pragma once
// Interface of an element type. A new type is one file fe/elements/<name>.cpp with its kernel
// and one entry in element_list.hpp; assembly, surfaces, checks of shapes, invariants and the
// generic tests run over the list.
#include <span>
#include <string>
#include <vector>

#include "floatframe/fe/elasticity.hpp"
#include "floatframe/fe/element_shape.hpp"
#include "floatframe/fe/fe_system.hpp"
#include "floatframe/fe/layup.hpp"
#include "floatframe/fe/shell_layers.hpp"

namespace floatframe {

/// The data of one element, gathered.
struct ElementInput {
  std::array<Vec3, 20> p;  ///< node positions
  Material material;
  BeamSection section;
  ShellSection shell;
  Vec3 reference = Vec3::UnitZ();
  Integration integration = Integration::exact;
  MassForm mass_form = MassForm::consistent;
  std::optional<Orientation> orientation = {};  ///< solids: axes of the material; none: the body's
  std::optional<ShellLayers> layers = {};       ///< shells other than of one isotropic material
  std::vector<LayupPly> plies = {};             ///< solids that have them
  unsigned own_drilling = 0;  ///< shells, bit k: at node k independent rotation about the normal
  const Orientation* axes() const noexcept { return orientation ? &*orientation : nullptr; }
};

/// A point where the stress of a load acts on second-order strains, 1/2 grad u^T grad u; its part
/// of the stress stiffness is sum_i (grad u_i)^T stress (grad u_i) (fe/stress_stiffness.hpp).
struct StressedPoint {
  /// 6 x dofs: stress (xx, yy, zz, xy, yz, zx) in body axes from the displacements, times the
  /// volume of the point [N m]; of a shell the membrane stress, of a beam its axial stress.
  MatX stress;
  MatX gradient;  ///< 9 x dofs: du_i/dx_j in row 3 i + j
  /// Torque on the twist of second order of a beam bent in two planes, not stress on strain.
  bool twist = false;
};

/// A section of an element that moves as a rigid body, for masses that differ between directions:
/// the element is the sum of its stations.
struct MassStation {
  VecX shares;  ///< weights of the nodes: its position is sum shares(k) p_k
  double mass = 0.0;
  /// Second moments of mass about its centre along the columns of `axes` (body axes) [kg m2].
  Mat3 axes = Mat3::Identity();
  Vec3 moments = Vec3::Zero();
  MatX u, theta;  ///< 3 x dofs, body axes
};

/// The ply of a solid at a node.
struct NodalPly {
  int ply = 0;
  Mat6 D = Mat6::Zero();  ///< elasticity there, in body axes [Pa]
};

/// Kind of section of an element: a beam's (rods too), a shell's (panels and membranes too), or
/// none.
enum class ElementFamily { beam, shell, solid, rod, panel, membrane };

struct ElementKernel {
  ElementFamily family;
  int nodes;
  int dofs_per_node;  ///< 6: ux uy uz rx ry rz; 3: ux uy uz
  /// Error in the geometry or section, as the end of a sentence; empty if there is none.
  std::string (*error)(const ElementInput&);
  /// Stiffness in body axes.
  void (*stiffness)(const ElementInput&, MatX&);
  /// Consistent mass in body axes.
  void (*mass)(const ElementInput&, bool section_inertia, MatX&);
  /// int N^T N dm of the linear shape functions.
  void (*scalar_mass)(const ElementInput&, MatX&);
  /// Stations that add to `mass` with section inertia, exactly; null: the mass of translations is
  /// the same in all directions.
  void (*mass_stations)(const ElementInput&, std::vector<MassStation>&) = nullptr;
  /// Strains (xx, yy, zz, xy, yz, zx; engineering shear) at the nodes, 6 rows per node, from the
  /// displacements of the nodes: evaluated at the optimal points and extrapolated to the nodes.
  /// Null for beams, shells and membranes.
  void (*nodal_strains)(const ElementInput&, MatX&) = nullptr;
  void (*stressed_points)(const ElementInput&, std::vector<StressedPoint>&) = nullptr;
  /// Shells, membranes: stresses (xx, yy, zz, xy, yz, zx) in body axes at the nodes, 12 rows per
  /// node: on the side of the normal (top), then on the other (bottom), from the displacements of
  /// the nodes.
  void (*layer_stresses)(const ElementInput&, MatX&) = nullptr;
  /// For solids that may have plies; else null.
  NodalPly (*nodal_ply)(const ElementInput&, int node) = nullptr;
  ElementShape shape = {};
};

const ElementKernel& element_kernel(FeElementType type) noexcept;

inline ElementFamily family_of(FeElementType type) noexcept { return element_kernel(type).family; }
inline bool is_beam(FeElementType type) noexcept { return family_of(type) == ElementFamily::beam; }
inline bool is_rod(FeElementType type) noexcept { return family_of(type) == ElementFamily::rod; }
inline bool is_shell(FeElementType type) noexcept {
  return family_of(type) == ElementFamily::shell;
}
inline bool is_panel(FeElementType type) noexcept {
  return family_of(type) == ElementFamily::panel;
}
inline bool is_membrane(FeElementType type) noexcept {
  return family_of(type) == ElementFamily::membrane;
}
/// The section is in FeModel::shells.
inline bool has_shell_section(FeElementType type) noexcept {
  return is_shell(type) || is_panel(type) || is_membrane(type);
}
/// For a shell or membrane.
ShellLayers layers_of(const ElementInput& in);

ElementInput gather(const FeModel& model, const FeElement& element,
                    Integration integration = Integration::exact);

/// Local axes of a beam: columns x (from node 1 to node 2), y (in the plane of x and the
/// reference), z.
Mat3 beam_axes(const ElementInput& input);

/// Stress (xx, yy, zz, xy, yz, zx) of a unit stress along the unit vector t.
inline Vec6 axial_stress(const Vec3& t) {
  Vec6 stress;
  stress << t.cwiseAbs2(), t(0) * t(1), t(1) * t(2), t(2) * t(0);
  return stress;
}
/// Scalar mass of a line of two nodes with this mass.
inline void line_mass(double mass, MatX& out) {
  out.resize(2, 2);
  out << mass / 3.0, mass / 6.0, mass / 6.0, mass / 3.0;
}
/// M_s (x) I_3 of the translations of nodes with d degrees of freedom each.
void expand_scalar_mass(const MatX& scalar, int d, MatX& out);
/// `mass` of an element whose mass is the same in all directions.
template <void (*scalar_mass)(const ElementInput&, MatX&)>
void mass_of_translations(const ElementInput& in, bool, MatX& out) {
  MatX scalar;
  scalar_mass(in, scalar);
  expand_scalar_mass(scalar, 3, out);
}
/// Elasticity matrix of a solid at a place, in body axes.
Mat6 elasticity_at(const ElementInput& in, const Vec3& p);

#define FLOATFRAME_KERNEL(name) extern const ElementKernel name##_kernel;
FLOATFRAME_FE_ELEMENTS(FLOATFRAME_KERNEL)
#undef FLOATFRAME_KERNEL

}  // namespace floatframe
