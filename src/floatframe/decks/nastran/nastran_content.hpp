#pragma once
// What the cards of Nastran bulk data say, by kind and with the user's numbers, before it is a
// model.
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "floatframe/decks/nastran/nastran_scalar_points.hpp"
#include "floatframe/decks/nastran/nastran_springs.hpp"
#include "floatframe/formats/nastran/nastran_cards.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"

namespace floatframe {

struct NastranGrid {
  int id = 0, cp = 0, cd = 0;    ///< while reading -1: not given, GRDSET decides
  std::optional<unsigned> held;  ///< PS
  Vec3 x = Vec3::Zero();
  FeSource at;
};

/// CORD2R, CORD2C, CORD2S: origin, a point on z, a point in the xz plane, in the system `rid`.
struct NastranSystem {
  char kind = 'R';
  int rid = 0;
  Vec3 a = Vec3::Zero(), b = Vec3::Zero(), c = Vec3::Zero();
  FeSource at;
};

/// CORD1R, CORD1C, CORD1S: the same by nodes.
struct NastranNodeSystem {
  char kind = 'R';
  int a = 0, b = 0, c = 0;
  FeSource at;
};

/// Bars: offsets of the ends and components that these do not pass on.
struct NastranBarEnds {
  Vec3 offset[2] = {Vec3::Zero(), Vec3::Zero()};
  unsigned pins[2] = {0, 0};
  /// OFFT: axes of the orientation vector (G: of the displacements of node A, B: basic) and of the
  /// offsets (G: of the node's displacements, O: of the element).
  char axes[3] = {'G', 'G', 'G'};
};

/// BAROR, BEAMOR.
struct NastranBarDefault {
  int property = 0;  ///< 0: none
  Vec3 orientation = Vec3::Zero();
  int orientation_node = 0;
  char axes = 'G';
  FeSource at;
};

struct NastranElement {
  ElementType type = ElementType::tet4;
  const char* card = "";
  int id = 0, property = 0;
  std::array<int, 20> nodes{};  ///< in the order of ElementType
  int count = 0;
  bool surface = false;             ///< a triangle or quadrilateral
  bool other = false;               ///< surface with a part of its mid-side nodes: only a skin
  Vec3 orientation = Vec3::Zero();  ///< bars: in the system of the first node's cd
  int orientation_node = 0;         ///< bars: or a node
  double theta = 0.0;               ///< shells: of axis 1 of the material from the side 1-2 [rad]
  int material_system = -1;         ///< shells: MCID in place of the angle; -1: none
  double offset = 0.0;              ///< shells: ZOFFS
  bool own_thickness = false, relative_thickness = false;  ///< shells: Ti, TFLAG
  std::array<double, 4> corner_thickness{};                ///< negative: that of the property
  int ends = -1;  ///< bars: index of what is special about their ends
  /// Bars, while reading: BAROR decides.
  bool default_property = false, default_orientation = false;
  FeSource at;
};

struct NastranMaterial {
  const char* card = "MAT1";
  std::optional<double> young, shear, poisson;  ///< MAT1
  std::optional<double> density;
  std::optional<Mat6> elasticity;  ///< MAT2, MAT8, MAT9
  bool plane = false;              ///< MAT2, MAT8
  FeSource at;
};

struct NastranPly {
  int material = 0;
  double thickness = 0.0, angle = 0.0;  ///< [rad]
};

/// Of a bar: I1 = int y^2, I2 = int z^2, I12 = int y z dA about the centroid.
struct NastranSection {
  double A = 0.0, I1 = 0.0, I2 = 0.0, I12 = 0.0, J = 0.0;
};

/// A place along a tapered beam.
struct NastranStation {
  double x = 0.0;  ///< of the length
  NastranSection section;
  double nonstructural = 0.0;
  BeamSection shape;      ///< shear areas, and of PBEAML the outline
  std::size_t field = 0;  ///< of X/XB on the card
};

struct NastranProperty {
  const char* card = "";
  int material = 0;
  bool full_integration = false;    ///< PSOLID: of CHEXA with 8 nodes
  int material_system = 0;          ///< PSOLID: CORDM
  double thickness = 0.0;           ///< PSHELL, PCOMP
  bool membrane = false;            ///< PSHELL without MID2, PCOMP with LAM = MEM
  int bending = 0, coupling = 0;    ///< PSHELL: MID2, MID4; 0: none
  double bending_factor = 1.0;      ///< PSHELL: 12I/T**3
  std::vector<NastranPly> plies;    ///< PCOMP, from the bottom
  std::optional<double> z0;         ///< PCOMP: of the bottom from the nodes
  bool smeared = false;             ///< PCOMP: LAM = SMEAR
  double shell_shear = 0.0;         ///< PSHELL with MID3, PCOMP
  double edge_factors[2] = {0, 0};  ///< PSHEAR: F1 and F2, rods along the edges
  int shear_material = 0;           ///< PSHELL: MID3
  BeamSection section;              ///< PBAR, PBARL, PBEAM, PBEAML: about its principal axes
  double turn = 0.0;                ///< of these from y of the element towards z [rad]
  /// PBEAM, PBEAML: of a taper, from end A to end B; empty: `section` is that of the whole beam.
  std::vector<NastranStation> stations;
  std::vector<std::string> remarks;  ///< what is approximated
  double nonstructural = 0.0;        ///< mass over length or area
  FeSource at;
};

/// CONM1, CMASS1, CMASS2: of displacements and rotations of a node.
struct NastranMassMatrix {
  const char* card = "";
  int id = 0, node = 0;
  int system = 0;    ///< -1: that of the node's displacements
  int property = 0;  ///< CMASS1: the matrix is times that
  Mat6 M = Mat6::Zero();
  FeSource at;
};

struct NastranMass {
  const char* card = "CONM2";
  int id = 0, node = 0, system = 0;
  double mass = 0.0;
  Vec3 offset = Vec3::Zero();
  Mat3 J = Mat3::Zero();
  FeSource at;
};

struct NastranSpider {
  const char* card = "";
  Spider::Kind kind = Spider::Kind::rigid;
  int id = 0, reference = 0;
  unsigned mask = 63u;
  std::vector<int> nodes;
  std::vector<double> weights;
  std::vector<unsigned> components;  ///< RBE3: of each node; `mask` is REFC
  FeSource at;
};

/// Components of nodes; RBE1, RBAR, RTRPLT: six that define a rigid motion and those that follow.
struct NastranRigid {
  struct Part {
    int node = 0;
    unsigned mask = 0;
  };
  const char* card = "";
  int id = 0;
  std::vector<Part> independent, dependent;
  FeSource at;
};

/// RROD: the distance of two nodes stays.
struct NastranRigidRod {
  int id = 0, a = 0, b = 0;
  FeSource at;
};

struct NastranEquation {
  int set = 0;
  struct Term {
    int node = 0, component = 0;  ///< -1: none, of a scalar point
    double factor = 0.0;
  };
  std::vector<Term> terms;
  FeSource at;
};

struct NastranSupport {
  int first = 0, last = 0;  ///< node, or a range in which some may be missing
  unsigned mask = 0;
  FeSource at;
  int set = 0;  ///< SPC, SPC1; 0: PS of GRID
};

/// SET (OptiStruct), SET1, SET3: numbers and ranges of nodes or elements.
struct NastranSet {
  int id = 0;
  bool elements = false;
  bool strict = true;  ///< SET1 may mean other things: it is a set only if all its nodes are there
  std::vector<std::pair<int, int>> ranges;
  FeSource at;
};

struct NastranContent {
  std::vector<NastranGrid> grids;
  NastranGrid grid_default;  ///< GRDSET
  std::map<int, NastranSystem> systems;
  std::map<int, NastranNodeSystem> node_systems;
  std::map<int, std::string> other_systems, other_materials;  ///< card, of what is not read
  std::vector<NastranElement> elements;
  std::vector<NastranBarEnds> bar_ends;
  std::map<std::string, NastranBarDefault> bar_defaults;  ///< by CBAR and CBEAM
  NastranRanges scalar_points;  ///< SPOINT, and those of elements of scalar points
  std::map<int, NastranMaterial> materials;
  std::map<int, NastranProperty> properties;
  std::vector<NastranMass> masses;
  std::vector<NastranMassMatrix> mass_matrices;
  std::map<int, std::pair<double, FeSource>> pmass;
  std::vector<NastranScalarMass> scalar_masses;
  NastranSprings springs;
  std::vector<NastranSpider> spiders;
  std::vector<NastranRigid> rigids;
  std::vector<NastranRigidRod> rigid_rods;
  std::vector<NastranEquation> equations;
  std::vector<NastranSupport> supports;
  std::vector<NastranSet> sets;
  std::map<int, std::vector<int>> added_mpc_sets;  ///< MPCADD
  std::map<int, std::vector<int>> added_spc_sets;
  NastranControl control;
  NastranWholeNumbers whole_numbers;
  double mass_factor = 1.0;       ///< PARAM,WTMASS times PARAM,CM1
  double stiffness_factor = 1.0;  ///< PARAM,CK1
  bool coupled_mass = false;      ///< PARAM,COUPMASS
  std::map<int, std::string> property_names, material_names, set_names;
  std::vector<std::string> notes;
};

/// Errors are collected in the source. With `only_nodes` all but nodes, coordinate systems and
/// supports is ignored.
NastranContent read_nastran_content(TextSource& source, bool has_control, bool only_nodes);

/// What a PARAM entry does to the part.
enum class NastranParameter {
  unknown,
  harmless,
  mass_factor,       ///< WTMASS, CM1
  stiffness_factor,  ///< CK1
  coupled_mass       ///< COUPMASS
};
NastranParameter nastran_parameter(const std::string& name);

class NastranFields;
/// Reads a card into the content.
using NastranCardReader = void (*)(NastranFields&, NastranContent&);
// nastran_mesh_cards.cpp
void read_nastran_grid(NastranFields&, NastranContent&);
void read_nastran_grid_default(NastranFields&, NastranContent&);
void read_nastran_system(NastranFields&, NastranContent&);
void read_nastran_node_system(NastranFields&, NastranContent&);
void read_nastran_solid(NastranFields&, NastranContent&);
void read_nastran_surface(NastranFields&, NastranContent&);
void read_nastran_panel(NastranFields&, NastranContent&);
void read_nastran_material(NastranFields&, NastranContent&);
void read_nastran_mass(NastranFields&, NastranContent&);
// nastran_masses.cpp
void read_nastran_mass_matrix(NastranFields&, NastranContent&);  ///< CONM1
void read_nastran_scalar_mass(NastranFields&, NastranContent&);  ///< CMASS1, CMASS2
void read_nastran_pmass(NastranFields&, NastranContent&);
// nastran_materials.cpp
/// MAT2, MAT8, MAT9
void read_nastran_anisotropic(NastranFields&, NastranContent&);
/// What is wrong with the constants of a MAT2 that is the material of a shell.
std::string nastran_plane_error(const NastranMaterial& m);
// nastran_laminates.cpp
void read_nastran_pshell(NastranFields&, NastranProperty&);
void read_nastran_pcomp(NastranFields&, NastranProperty&);  ///< and PCOMPG
// nastran_bar_cards.cpp
void read_nastran_bar(NastranFields&, NastranContent&);
void read_nastran_bar_default(NastranFields&, NastranContent&);
/// What bars leave to BAROR and BEAMOR.
void complete_nastran_bars(NastranContent&, TextSource&);
// nastran_constraint_cards.cpp
void read_nastran_rbe2(NastranFields&, NastranContent&);
void read_nastran_rbe3(NastranFields&, NastranContent&);
void read_nastran_rbar(NastranFields&, NastranContent&);  ///< and RBAR1
void read_nastran_rbe1(NastranFields&, NastranContent&);
void read_nastran_rtrplt(NastranFields&, NastranContent&);
void read_nastran_rrod(NastranFields&, NastranContent&);
void read_nastran_mpc(NastranFields&, NastranContent&);
void read_nastran_mpc_add(NastranFields&, NastranContent&);
void read_nastran_spc_add(NastranFields& f, NastranContent& c);
void read_nastran_spc(NastranFields&, NastranContent&);
void read_nastran_spc1(NastranFields&, NastranContent&);
/// Says that a number is in the file twice.
void nastran_twice(NastranFields& card, const FeSource& first);
// nastran_home.cpp
/// Shear areas of a named section by its dimensions.
void nastran_shear_of_shape(std::string_view type, const double* d, BeamSection& section) noexcept;
// nastran_springs.cpp
void read_nastran_rod_property(NastranFields&, NastranProperty&);  ///< PROD, PTUBE
// nastran_sections.cpp
void read_nastran_named_section(NastranFields&, NastranProperty&);
void set_nastran_section(NastranProperty& property, const NastranSection& section);
/// A property of elements (PSOLID, PROD, ...); false if the card is none that is read.
bool read_nastran_property(NastranFields& card, NastranProperty& property);

/// Does a card change neither stiffness nor mass nor geometry (loads, methods, tables, ...)?
bool is_harmless_nastran_card(const std::string& name);

/// Cards that say what touches what.
bool is_nastran_contact_card(const std::string& name);

/// What to do about a card that is not read; null if there is nothing special about it.
const char* why_nastran_card_is_refused(const std::string& name);

}  // namespace floatframe
