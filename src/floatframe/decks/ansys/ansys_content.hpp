#pragma once
// Content of the commands of an ANSYS deck, by kind and with the user's numbers, before it is a
// model; elements of ANSYS by their number, and the solids and shells that result from repeated
// nodes.
#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "floatframe/decks/ansys/ansys_fields.hpp"
#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

enum class AnsysFamily {
  brick,    ///< 8 nodes, may be a wedge, a pyramid or a tetrahedron
  brick20,  ///< the same of second order
  tet,      ///< 4 or 10 nodes
  shell,    ///< 4 or 8 nodes, may be a triangle
  beam2,    ///< 2 nodes and one for the orientation
  beam3,    ///< 3 nodes and one for the orientation
  rod,      ///< 2 nodes
  mass,     ///< 1 node
  spring,   ///< 2 nodes
  matrix,   ///< 2 nodes
  rigid,    ///< MPC184
  contact,  ///< CONTA171 to 178
  target,   ///< TARGE169, 170
  ignored   ///< neither stiffness nor mass: loads, meshes
};

struct AnsysLibraryElement {
  int number = 0;
  const char* name = "";
  AnsysFamily family = AnsysFamily::brick;
  int nodes = 0;  ///< at most, without those for orientation
};

/// Null if the element is not supported.
const AnsysLibraryElement* ansys_library_element(int number) noexcept;

/// ET with its KEYOPTs.
struct AnsysType {
  int id = 0, number = 0;
  std::array<int, 19> keyopt{};  ///< by their number, from 1
  FeSource at;
};

/// An element of FeModel: which of the nodes of the ANSYS element it has, in its own order.
struct AnsysShape {
  FeElementType type = FeElementType::hex8;
  std::array<int, 20> nodes{};
  int count = 0;
};

/// The shape of an element with the given nodes (0: none). Missing mid-side nodes have 0 at their
/// place; an element without any is of first order. None if the repeated nodes do not define an
/// element.
std::optional<AnsysShape> ansys_shape(const AnsysLibraryElement& element, const AnsysType& type,
                                      std::span<const int> nodes);

struct AnsysElement {
  int id = 0, type = 0, material = 0, real = 0, section = 0, system = 0;
  std::size_t first = 0;  ///< its nodes in AnsysContent::element_nodes
  int nodes = 0;
  FeSource at;
};

/// LOCAL: turned by the angles about z, the new x, the new y [degree].
struct AnsysSystem {
  int kind = 0;  ///< 0 rectangular, 1 cylindrical, 2 spherical, 3 toroidal
  Vec3 origin = Vec3::Zero(), angles = Vec3::Zero();
  bool round = true;  ///< neither elliptical nor the like
  FeSource at;
};

struct AnsysMaterial {
  /// By label (EX, DENS, ...): temperatures with values; one without: {{0, value}}.
  using Values = std::map<std::string, std::vector<std::pair<double, double>>>;
  Values values;                    ///< of MP and MPDATA
  Values tables;                    ///< of TB: EX, PRXY, DENS
  std::vector<double> anisotropic;  ///< TB,ANEL: 21 constants
  bool compliance = false;          ///< of these
  FeSource at;

  /// Nullptr if there is none. Of both that of TB; they must be equal (`ansys_material`).
  const Values::mapped_type* find(const std::string& label) const;
};

struct AnsysReal {
  std::vector<double> values;
  FeSource at;
  double value(std::size_t k) const noexcept { return k < values.size() ? values[k] : 0.0; }
};

struct AnsysSection {
  std::string kind, shape;                ///< SHELL, BEAM, LINK, ...; RECT, ...
  std::vector<std::vector<double>> rows;  ///< SECDATA, SECBLOCK
  std::string offset;                     ///< SECOFFSET: MID, ...; empty: not given
  std::vector<double> offsets;            ///< its numbers: of USER and what follows
  std::vector<double> control;            ///< SECCONTROL
  FeSource at;
};

/// 0 if undefined.
inline double ansys_value(const std::vector<double>& row, std::size_t k) noexcept {
  return k < row.size() ? row[k] : 0.0;
}

struct AnsysTerm {
  int node = 0, axis = 0;
  double factor = 0.0;
};

/// CE
struct AnsysEquation {
  std::vector<AnsysTerm> terms;
  double constant = 0.0;
  FeSource at;
};

/// CP: a degree of freedom shared by all nodes.
struct AnsysCoupling {
  int axis = -1;
  std::vector<int> nodes;
  FeSource at;
};

/// CERIG
struct AnsysRigid {
  int master = 0, slave = 0;
  unsigned mask = 63u;
  FeSource at;
};

struct AnsysComponent {
  std::string name;
  bool elements = false;
  std::vector<int> members;  ///< numbers; a negative one ends a range
  FeSource at;
};

struct AnsysContent {
  FeModel model;  ///< with the nodes
  std::unordered_map<int, int> node_index;
  std::unordered_map<int, Vec3> node_angles;  ///< by index; of the nodal system [degree]
  std::map<int, AnsysType> types;
  std::vector<AnsysElement> elements;
  std::vector<int> element_nodes;  ///< numbers
  std::unordered_map<int, std::size_t> element_index;
  std::map<int, AnsysSystem> systems;
  std::map<int, AnsysMaterial> materials;
  std::map<int, AnsysReal> reals;
  std::map<int, AnsysSection> sections;
  std::map<int, AnsysEquation> equations;
  std::map<int, AnsysCoupling> couplings;
  std::vector<AnsysRigid> rigid;
  std::vector<AnsysComponent> components;
  std::vector<std::pair<AnsysTerm, FeSource>> supports;  ///< axis -1: all
  bool lumped = false;                                   ///< LUMPM,ON

  // While reading: what the commands before have set.
  AnsysElement current = {0, 1, 1, 1, 1, 0, 0, 0, {}};
  int nodal_system = 0;
  int branch = 0;  ///< depth of a *IF whose lines are ignored
  std::vector<double> temperatures;
  std::string table;  ///< of TB, with its material
  int table_material = 0;
  double table_temperature = 0.0;     ///< of TBTEMP
  int real_set = 0, section_set = 0;  ///< of R, SECTYPE
  int constraint = 0;                 ///< number of the last CE or CP
  int highest_element = 0;
  bool ended = false;  ///< /EOF
  std::map<std::string, FeSource> ignored;
};

/// Throws InputError at the first error of form.
AnsysContent read_ansys_content(TextSource& source);

/// "UX" 0 to "ROTZ" 5; -1 of another word.
int ansys_axis(std::string_view word) noexcept;
/// Is field 1 the mark of the commands that CDWRITE writes, "R5.0" or "UNBL"?
bool ansys_written(const AnsysFields& f);

/// A command and its reader.
struct AnsysCommand {
  const char* name;
  void (*read)(AnsysFields&, AnsysContent&);
};
// In separate sources: nodes and elements; types, constants and sections; materials; constraints.
std::span<const AnsysCommand> ansys_mesh_commands();
std::span<const AnsysCommand> ansys_property_commands();
std::span<const AnsysCommand> ansys_material_commands();
std::span<const AnsysCommand> ansys_constraint_commands();

/// The material in the units of the deck; its density is 0 if there is none.
Material ansys_material(const AnsysMaterial& m, int id, std::optional<double> temperature,
                        AnsysContent& content, TextSource& source);

}  // namespace floatframe
