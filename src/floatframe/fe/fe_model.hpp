#pragma once
// A finite-element model of one flexible body: nodes, materials, beam sections, elements and point
// masses. Plain data in the body frame, SI units. Six degrees of freedom a node (ux uy uz rx ry rz)
// if there is any beam, else three (ux uy uz). `validate` names every fault; the assembly functions
// give the sparse matrices.
#include <Eigen/SparseCore>
#include <array>
#include <string>
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

using SparseMatrix = Eigen::SparseMatrix<double>;
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Linear elastic, isotropic.
struct Material {
  double young = 0.0;    ///< E [Pa]
  double poisson = 0.0;  ///< [-], between -1 and 0.5
  double density = 0.0;  ///< [kg/m3]
  double shear() const noexcept { return young / (2.0 * (1.0 + poisson)); }
};

/// Section of a beam about its centroid, in the beam's local axes: Iy = int z^2 dA, Iz = int y^2
/// dA.
struct BeamSection {
  double A = 0.0;   ///< [m2]
  double Iy = 0.0;  ///< bending in the local xz plane [m4]
  double Iz = 0.0;  ///< bending in the local xy plane [m4]
  double J = 0.0;   ///< torsion constant [m4]

  static BeamSection solid_round(double diameter);
  static BeamSection hollow_round(double outer_diameter, double inner_diameter);
  /// width along local y, height along local z. J = a b^3 (1/3 - 0.21 b/a (1 - (b/a)^4/12)), a >=
  /// b.
  static BeamSection rectangle(double width, double height);
};

enum class ElementType { beam2, tet4, hex8 };

struct Element {
  ElementType type = ElementType::beam2;
  std::array<int, 8> nodes{};  ///< only the first ones are used, as the type needs
  int material = 0;
  int section = 0;                 ///< beams only
  Vec3 reference = Vec3::UnitZ();  ///< beams: local y lies in the plane of the axis and this vector
  std::string name;                ///< for messages; empty: by its number
};

struct PointMass {
  int node = 0;
  double mass = 0.0;      ///< [kg]
  Mat3 J = Mat3::Zero();  ///< inertia about the node, body axes [kg m2]; needs nodes with rotations
};

struct FeModel {
  std::vector<Vec3> positions;          ///< [m]
  std::vector<std::string> node_names;  ///< same length as positions; empty string: no name
  std::vector<Material> materials;
  std::vector<BeamSection> sections;
  std::vector<Element> elements;
  std::vector<PointMass> masses;

  int nodes() const noexcept { return static_cast<int>(positions.size()); }
  bool has_beams() const noexcept;
  int dofs_per_node() const noexcept { return has_beams() ? 6 : 3; }
  /// Index of a named node, -1 if there is none.
  int find_node(const std::string& name) const noexcept;
  /// The node's name, or "node 12".
  std::string node_label(int node) const;
  /// The element's name, or "element 3 (beam2)".
  std::string element_label(int element) const;
};

/// Throws InputError with every fault: indices out of range, non-physical materials, sections and
/// masses, degenerate or inverted elements.
void validate(const FeModel& model);

/// Stiffness, (dofs_per_node n)^2.
SparseMatrix assemble_stiffness(const FeModel& model);
/// Consistent mass, (dofs_per_node n)^2. With `section_inertia` beams have rotary and torsional
/// inertia of the section.
SparseMatrix assemble_mass(const FeModel& model, bool section_inertia, int dofs_per_node);
/// Scalar mass matrix of linear (isoparametric) elements, n x n.                          (65)
SparseRows assemble_scalar_mass(const FeModel& model);

}  // namespace floatframe
