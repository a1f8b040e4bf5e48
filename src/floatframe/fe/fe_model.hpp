#pragma once
// A finite-element model of one flexible body: nodes, materials, sections, elements, point masses,
// sets, spiders; or nodes and matrices from another program. Plain data in the body frame. SI
// units, except in the result of a file reader: it has the units of the file until `to_si`.
// In models of bars every node has six degrees of freedom (ux uy uz rx ry rz) if there is any
// beam or shell, else three; reductions of parts give each node those that it needs. `validate`
// reports every error.
#include <Eigen/SparseCore>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/element_list.hpp"
#include "floatframe/fe/mass_form.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

using SparseMatrix = Eigen::SparseMatrix<double>;
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Location of an entity in the files of a model: index in FeModel::files, line from 1.
struct FeSource {
  int file = -1;
  int line = 0;
};

/// Linear elastic: isotropic, or with an elasticity matrix in material axes.
struct Material {
  double young = 0.0;    ///< E [Pa]; with a matrix: along its axis 1, for display
  double poisson = 0.0;  ///< [-], between -1 and 0.5; with a matrix: nu_12, to be shown
  double density = 0.0;  ///< [kg/m3]
  /// Stress from strain (xx, yy, zz, xy, yz, zx; engineering shear) in the axes of the material
  /// [Pa].
  std::optional<Mat6> elasticity = {};
  /// The matrix is one of plane stress, for shells: its row and column zz are zero.
  bool plane = false;
  double shear() const noexcept { return young / (2.0 * (1.0 + poisson)); }
};

/// Axes of materials: fixed, or those of a cylinder (radial, around, along) or of a sphere (radial,
/// along the meridian, around) at each place.
struct Orientation {
  enum class Kind { rectangular, cylindrical, spherical };
  Kind kind = Kind::rectangular;
  Mat3 axes = Mat3::Identity();  ///< columns in body axes; column 3 along the cylinder
  Vec3 origin = Vec3::Zero();    ///< [m]
  Mat3 turn = Mat3::Identity();  ///< of the axes at a place, about one of themselves
  /// Columns are the material axes at a place.
  Mat3 at(const Vec3& p) const;
};

/// A material without density in the file: it is 0 in the model, and `validate` requires that the
/// user gives one.
struct MissingDensity {
  FeSource source;
  double factor = 1.0;  ///< of all masses of the file (Nastran WTMASS)
};

/// Section of a beam about its centroid, in the beam's local axes: Iy = int z^2 dA, Iz = int y^2
/// dA.
struct BeamSection {
  double A = 0.0;   ///< [m2]
  double Iy = 0.0;  ///< bending in the local xz plane [m4]
  double Iz = 0.0;  ///< bending in the local xy plane [m4]
  double J = 0.0;   ///< torsion constant [m4]

  /// Its shape, which defines its stress points; unknown if only constants are given.
  enum class Outline { unknown, round, rectangle };
  Outline outline = Outline::unknown;
  double width = 0.0, height = 0.0;  ///< along local y and z [m]; round: the diameter
  double bore = 0.0;                 ///< of a tube: inner diameter [m]

  /// Shear areas of a 2-node beam: the shear forces are Vy = G shear_y gamma_xy, Vz = G shear_z
  /// gamma_xz. 0: no shear deformation (Euler-Bernoulli).
  double shear_y = 0.0, shear_z = 0.0;  ///< [m2]
  /// Above 0: the element of linear shapes and one point with a shear stiffness reduced by
  /// 1 + slenderness L^2 A/(12 I), as Abaqus has it (0.25), in place of the exact one.
  double slenderness = 0.0;
  bool has_shear() const noexcept { return shear_y > 0.0 || shear_z > 0.0; }

  static BeamSection solid_round(double diameter);
  static BeamSection hollow_round(double outer_diameter, double inner_diameter);
  /// width along local y, height along local z. J = a b^3 (1/3 - 0.21 b/a (1 - (b/a)^4/12)), a >=
  /// b.
  static BeamSection rectangle(double width, double height);
};

struct FeElement {
  FeElementType type = FeElementType::beam2;
  std::array<int, 20> nodes{};  ///< only the first ones are used, depending on the type
  int material = 0;
  int section = 0;  ///< beams, rods: in FeModel::sections; shells: in FeModel::shells
  MassForm mass_form = MassForm::consistent;
  Vec3 reference = Vec3::UnitZ();  ///< beams: local y is in the plane of the axis and this vector
  /// In FeModel::orientations; -1: solids have the body's axes, shells the first axis of their
  /// material along the side 1-2. A shell uses the first axis of an orientation, projected.
  int orientation = -1;
  double angle = 0.0;  ///< shells: rotates that axis about the normal [rad]
  int layup = -1;      ///< solids: their plies, in FeModel::layups; -1: one material
  /// Shells, bit k: the rotation about the normal at node k is independent of that of the node.
  unsigned own_drilling = 0;
  std::string name;  ///< for messages; empty: by its number
  int id = 0;        ///< the number in the user's file; 0: none
  FeSource source;
};

/// A layer of a shell or a solid.
struct ShellPly {
  int material = 0;
  double thickness = 0.0;  ///< [m]
  double angle = 0.0;      ///< of its axis 1 from that of the element, about the normal [rad]
};

/// Through the thickness of a shell: one material, or plies.
struct ShellSection {
  double thickness = 0.0;  ///< [m], of all plies
  /// Transverse shear force over a width = G shear gamma, 5/6 of the thickness of a homogeneous
  /// shell; 0: no shear deformation (thin). Of plies G is their mean.
  /// For a shear panel: the thickness that carries shear, 0: all.
  double shear = 0.0;                ///< [m]
  double offset = 0.0;               ///< of its middle from the nodes, along the normal [m]
  double mass = 0.0;                 ///< in addition to the materials, at the middle [kg/m2]
  std::vector<ShellPly> plies = {};  ///< from the bottom; empty: one, of the element's material
  bool smeared = false;              ///< plies in no order: no coupling, D = A t^2/12
  /// Without plies: the material of bending (-1: the element's), bending stiffness over that of the
  /// thickness, and Q_c of the coupling of bending and membrane [Pa] (Nastran: MID2, 12I/T^3,
  /// MID4).
  int bending = -1;
  double bending_factor = 1.0;
  Mat3 coupling = Mat3::Zero();
};

/// Plies of solids, across their third natural direction. The thicknesses are shares of that of the
/// element.
struct Layup {
  std::vector<ShellPly> plies;  ///< from the face of the first nodes
};

/// A linear spring. Its force is stiffness times elongation, the elongation
///   e = d_1 . q_1 + d_2 . q_2
/// of displacements and rotations q = (u, theta) of its nodes. A bushing is several springs.
struct Spring {
  std::array<int, 2> nodes{-1, -1};                            ///< the second -1: the ground
  std::array<Vec6, 2> directions{Vec6::Zero(), Vec6::Zero()};  ///< d_1, d_2; of u [-]
  double stiffness = 0.0;  ///< [N/m]; if the directions are of rotations alone [N m/rad]
  std::string name;        ///< for messages
  FeSource source;
};

struct PointMass {
  int node = 0;
  double mass = 0.0;      ///< [kg]
  Mat3 J = Mat3::Zero();  ///< inertia about the node, body axes [kg m2]; needs nodes with rotations
  FeSource source{};
  std::string name{};  ///< for messages: "CONM2 7"; may be empty
};

/// Several nodes that move with a reference node, which gets six degrees of freedom.
struct Spider {
  enum class Kind {
    rigid,  ///< RBE2: u_i = u_r + theta_r x (x_i - x_r), in the directions of `mask`
    mean    ///< RBE3: the reference moves as the weighted least-squares rigid motion of the nodes
  };
  Kind kind = Kind::rigid;
  std::string name;             ///< for messages
  int reference = -1;           ///< node index
  std::vector<int> nodes;       ///< node indices
  std::vector<double> weights;  ///< mean: one per node; empty: all 1
  /// Bit 0..5 = ux..rz. Rigid: dofs of the nodes that follow (bits 3..5 are ignored for nodes
  /// without rotations). Mean: of collinear nodes, without the rotations with a component about
  /// their line: the spider does not determine it (`free_turns`).
  unsigned mask = 63u;
  /// CalculiX: node whose displacements 1..3 represent the rotations of the reference in decks and
  /// exported matrices; else -1. It has no degrees of freedom in the model.
  int rotation_node = -1;
  FeSource source;
};

/// Linear equation sum_k factor_k u(node_k, axis_k) = 0; the first term's dof depends on the
/// others, unless it already depends on another equation: then another term's dof is dependent.
struct LinearEquation {
  struct Term {
    int node = -1, axis = 0;
    double factor = 0.0;
  };
  std::vector<Term> terms;
  FeSource source;
  /// Solved for its first term even if its factor is small: a rotation that follows displacements,
  /// whose factors are of another unit.
  bool for_first = false;
};

/// A support in the user's file. Not applied: a hint for the interfaces of the part.
struct Support {
  int node = -1;
  unsigned mask = 0;  ///< bit 0..5 = ux..rz
  FeSource source;
};

/// A face of an element, counted from 0 in the order of the file format (S1, S2, ... for Abaqus).
struct ElementFace {
  int element = -1, face = 0;
};

/// One degree of freedom: node index, axis 0..5 = ux uy uz rx ry rz.
struct Dof {
  int node = -1, axis = 0;
};

/// Stiffness and mass from another program, in place of elements.
struct FeMatrices {
  SparseMatrix K, M;      ///< symmetric, both halves stored
  std::vector<Dof> dofs;  ///< of each row
  SparseMatrix C = {};    ///< viscous damping; 0 x 0: none given
  /// Nodes, ascending, that are not points: their row rx is the amplitude of a mode, at rest in a
  /// rigid motion.
  std::vector<int> scalars = {};
  bool is_scalar(int node) const;
};

struct FeModel {
  std::vector<Vec3> positions;  ///< [m]
  std::vector<std::string>
      node_names;  ///< same length as positions, or empty; empty string: no name
  std::vector<Material> materials;
  std::vector<BeamSection> sections;
  std::vector<ShellSection> shells;
  std::vector<Layup> layups;
  std::vector<Orientation> orientations;
  std::vector<FeElement> elements;
  std::vector<PointMass> masses;
  std::vector<Spring> springs;

  // Additional data of imported models. Sets keep the order of the file; names as in the file
  // (Abaqus: upper case).
  std::vector<int> node_ids;           ///< the user's numbers; empty: index + 1
  std::vector<FeSource> node_sources;  ///< same length as positions, or empty
  /// Nodes that are not defined in the file but generated by its reader: ends of bars offset from
  /// their nodes or with hinges, locations of masses, middles of edges. Ascending.
  std::vector<int> generated_nodes;
  std::vector<std::string> material_names;
  std::map<int, MissingDensity> without_density;  ///< by the index of the material
  std::map<std::string, std::vector<int>> node_sets;
  std::map<std::string, std::vector<int>> element_sets;
  std::map<std::string, std::vector<ElementFace>> surfaces;
  std::vector<Spider> spiders;
  std::vector<LinearEquation> equations;
  std::vector<Support> supports;
  std::optional<FeMatrices> matrices;  ///< if there, `elements` is empty
  std::map<int, Mat3> axes_of_rows;    ///< nodes whose matrix rows have other axes: u = R u_row
  std::string units;                   ///< units before `to_si`; empty: unknown
  std::vector<std::string> files;      ///< paths as the user would write them
  std::vector<std::string> notes;      ///< one sentence each, with file:line: ignored items

  int nodes() const noexcept { return static_cast<int>(positions.size()); }
  int places() const noexcept;  ///< nodes that are points
  bool has_beams() const noexcept;
  int dofs_per_node() const noexcept { return has_beams() ? 6 : 3; }
  /// Index of a named node, -1 if there is none.
  int find_node(const std::string& name) const noexcept;
  /// The node's name, or "node 12" (its number in the file if there is one).
  std::string node_label(int node) const;
  /// The element's name, or "element 3 (beam2)".
  std::string element_label(int element) const;
  /// The spring's name, or "spring 3".
  std::string spring_label(int spring) const;
  /// For errors; empty if the model was not read from a file.
  SourceMark mark(const FeSource& source) const;
};

/// Throws InputError with the errors, at most 20 of a kind: indices out of range, non-physical
/// materials, sections and masses, degenerate or inverted elements, spiders, equations
/// and matrices that are inconsistent.
void validate(const FeModel& model);

/// Stiffness, (dofs_per_node n)^2.
SparseMatrix assemble_stiffness(const FeModel& model);
/// Mass, (dofs_per_node n)^2. With `section_inertia` beams have rotary and torsional
/// inertia of the section.
SparseMatrix assemble_mass(const FeModel& model, bool section_inertia, int dofs_per_node);
/// Scalar mass matrix of linear (isoparametric) elements, n x n.                          (65)
SparseRows assemble_scalar_mass(const FeModel& model);

}  // namespace floatframe
