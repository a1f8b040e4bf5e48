#pragma once
// Content of the cards of Nastran bulk data, by kind and with the user's numbers, before it is a
// model.
#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "floatframe/decks/word_list.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/formats/nastran/nastran_cards.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"

namespace floatframe {

/// Numbers as ranges: a few bytes can name very many.
class NastranRanges {
 public:
  void add(int first, int last) { ranges_.emplace_back(first, last); }
  /// Sorts and joins; before any question.
  void finish();
  bool contains(int id) const { return overlaps(id, id); }
  bool overlaps(int first, int last) const;

 private:
  std::vector<std::pair<int, int>> ranges_;
};

/// Their number, and the location of the first.
struct NastranCount {
  int number = 0;
  FeSource first;
  void add(const FeSource& at) {
    if (number++ == 0) first = at;
  }
};

struct NastranGrid {
  int id = 0, cp = 0, cd = 0;    ///< while reading -1: not given, GRDSET decides
  std::optional<unsigned> held;  ///< PS
  Vec3 x = Vec3::Zero();
  FeSource at;
};

/// CORD2R, CORD2C, CORD2S: origin, a point on z, a point in the xz plane, in the system `rid`;
/// CORD1R, CORD1C, CORD1S: the same by nodes. The last letter is the kind.
struct NastranSystem : NastranEntity {
  int rid = 0;
  std::array<Vec3, 3> points{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  std::array<int, 3> nodes{};  ///< 0: the points count
};

/// A vector, or the direction to a node.
struct NastranDirection {
  Vec3 vector = Vec3::Zero();
  int node = 0;
};

/// Bars: offsets of the ends and components that these do not pass on.
struct NastranBarEnds {
  Vec3 offset[2] = {Vec3::Zero(), Vec3::Zero()};
  unsigned pins[2] = {0, 0};
  /// OFFT: axes of the orientation vector (G: of the displacements of node A, B: basic) and of the
  /// offsets (G: of the node's displacements, O: of the element).
  char axes[3] = {'G', 'G', 'G'};
  bool plain() const {
    return pins[0] == 0 && pins[1] == 0 && offset[0].isZero(0.0) && offset[1].isZero(0.0);
  }
};

/// BAROR, BEAMOR.
struct NastranBarDefault {
  int property = 0;  ///< 0: none
  NastranDirection orientation;
  char axes = 'G';
  FeSource at;
};

struct NastranElement : NastranEntity {
  FeElementType type = FeElementType::tet4;
  int property = 0;
  std::array<int, 20> nodes{};  ///< in the order of FeElementType
  int count = 0;
  bool surface = false;          ///< a triangle or quadrilateral
  bool other = false;            ///< surface with a part of its mid-side nodes: only a skin
  NastranDirection orientation;  ///< bars: in the system of the first node's cd
  double theta = 0.0;            ///< shells: of axis 1 of the material from the side 1-2 [rad]
  int material_system = -1;      ///< shells: MCID in place of the angle; -1: none
  double offset = 0.0;           ///< shells: ZOFFS
  bool own_thickness = false, relative_thickness = false;  ///< shells: Ti, TFLAG
  std::array<double, 4> corner_thickness{};                ///< negative: that of the property
  int ends = -1;  ///< bars: index of what is special about their ends
  /// Bars, while reading: BAROR decides.
  bool default_property = false, default_orientation = false;
};

struct NastranMaterial : NastranEntity {
  std::optional<double> young, shear, poisson;  ///< MAT1
  std::optional<double> density;
  std::optional<Mat6> elasticity;  ///< MAT2, MAT8, MAT9
  bool plane = false;              ///< MAT2, MAT8
};

/// Of a bar: I1 = int y^2, I2 = int z^2, I12 = int y z dA about the centroid.
struct NastranSection {
  double A = 0.0, I1 = 0.0, I2 = 0.0, I12 = 0.0, J = 0.0;
  double nonstructural = 0.0;  ///< mass over length
};
struct NastranSectionValue {
  const char* name;
  double NastranSection::*member;
};
/// Properties that may vary along a beam, in the order of PBEAM.
inline constexpr NastranSectionValue nastran_section_values[] = {
    {"A", &NastranSection::A},   {"I1", &NastranSection::I1},
    {"I2", &NastranSection::I2}, {"I12", &NastranSection::I12},
    {"J", &NastranSection::J},   {"NSM", &NastranSection::nonstructural}};

/// A place along a tapered beam.
struct NastranStation {
  double x = 0.0;  ///< of the length
  NastranSection section;
  BeamSection shape;      ///< shear areas, and of PBEAML the outline
  std::size_t field = 0;  ///< of X/XB on the card
};

struct NastranProperty : NastranEntity {
  int material = 0;
  bool full_integration = false;    ///< PSOLID: of CHEXA with 8 nodes
  int material_system = 0;          ///< PSOLID: CORDM
  double thickness = 0.0;           ///< PSHELL, PCOMP
  bool membrane = false;            ///< PSHELL without MID2, PCOMP with LAM = MEM
  int bending = 0, coupling = 0;    ///< PSHELL: MID2, MID4; 0: none
  double bending_factor = 1.0;      ///< PSHELL: 12I/T**3
  std::vector<ShellPly> plies;      ///< PCOMP, from the bottom; materials by their numbers
  std::optional<double> z0;         ///< PCOMP: of the bottom from the nodes
  bool smeared = false;             ///< PCOMP: LAM = SMEAR
  double shell_shear = 0.0;         ///< PSHELL with MID3, PCOMP
  double edge_factors[2] = {0, 0};  ///< PSHEAR: F1 and F2, rods along the edges
  int shear_material = 0;           ///< PSHELL: MID3
  BeamSection section;              ///< PBAR, PBARL, PBEAM, PBEAML: about its principal axes
  double turn = 0.0;                ///< of these from y of the element towards z [rad]
  /// PBEAM, PBEAML: of a taper, from end A to end B; empty: `section` is that of the whole beam.
  std::vector<NastranStation> stations;
  std::vector<std::string> remarks;  ///< approximations
  double nonstructural = 0.0;        ///< mass over length or area
};

/// CONM1, CMASS1, CMASS2: of displacements and rotations of a node.
struct NastranMassMatrix : NastranEntity {
  int node = 0;
  int system = 0;    ///< -1: that of the node's displacements
  int property = 0;  ///< CMASS1: the matrix is times that
  Mat6 M = Mat6::Zero();
};

/// CONM2.
struct NastranMass : NastranEntity {
  int node = 0, system = 0;
  double mass = 0.0;
  Vec3 offset = Vec3::Zero();
  Mat3 J = Mat3::Zero();
};

struct NastranSpider : NastranEntity {
  Spider::Kind kind = Spider::Kind::rigid;
  int reference = 0;
  unsigned mask = 63u;
  std::vector<int> nodes;
  std::vector<double> weights;
  std::vector<unsigned> components;  ///< RBE3: of each node; `mask` is REFC
};

/// Components of nodes; RBE1, RBAR, RTRPLT: six that define a rigid motion and those that follow.
/// RROD: two nodes, the distance of which stays.
struct NastranRigid : NastranEntity {
  struct Part {
    int node = 0;
    unsigned mask = 0;
  };
  std::vector<Part> independent, dependent;
};

/// MPC; its number is that of its set.
struct NastranEquation : NastranEntity {
  using Term = LinearEquation::Term;
  std::vector<Term> terms;  ///< nodes by their numbers; axis -1: none, of a scalar point
};

struct NastranSupport {
  int first = 0, last = 0;  ///< node, or a range in which some may be missing
  unsigned mask = 0;
  FeSource at;
  int set = 0;  ///< SPC, SPC1; 0: PS of GRID
};

/// SET (OptiStruct), SET1, SET3: numbers and ranges of nodes or elements.
struct NastranSet : NastranEntity {
  bool elements = false;
  bool strict = true;  ///< SET1 may mean other things: it is a set only if all its nodes are there
  std::vector<std::pair<int, int>> ranges;
};

/// Between two nodes or scalar points: CELAS1 to 4, CMASS1 to 4 (of scalar points), bushings.
struct NastranScalarElement : NastranEntity {
  int property = 0;
  std::optional<double> value;      ///< direct value: CELAS2, CELAS4, CMASS2, CMASS4
  std::array<int, 2> nodes{};       ///< 0: the ground; of springs the second
  std::array<int, 2> components{};  ///< CELAS: 0 to 5; -1: none, of a scalar point
};

/// CELAS1 to 4, CBUSH, CBUSH1D.
struct NastranSpring : NastranScalarElement {
  int system = -1;               ///< CID; -1: by the line of its nodes
  NastranDirection orientation;  ///< X, in the displacement system of GA, or GO
  double place = 0.5;            ///< S: on the line from GA to GB
  int offset_system = -1;        ///< OCID; -1: `place` counts
  Vec3 offset = Vec3::Zero();    ///< from GA
};

/// PELAS, PBUSH1D, PMASS.
struct NastranScalarProperty : NastranEntity {
  double value = 0.0;
};

/// PBUSH.
struct NastranBushing : NastranEntity {
  Vec6 stiffness = Vec6::Zero();
};

struct NastranContent {
  std::vector<NastranGrid> grids;
  NastranGrid grid_default;  ///< GRDSET
  std::map<int, NastranSystem> systems, node_systems;
  std::map<int, std::string> other_systems, other_materials;  ///< card, of what is not read
  std::vector<NastranElement> elements;
  std::vector<NastranBarEnds> bar_ends;
  std::map<std::string, NastranBarDefault> bar_defaults;  ///< by CBAR and CBEAM
  NastranRanges scalar_points;  ///< SPOINT, and those of elements of scalar points
  std::map<int, NastranMaterial> materials;
  std::map<int, NastranProperty> properties;
  std::vector<NastranMass> masses;
  std::vector<NastranMassMatrix> mass_matrices;
  std::vector<NastranScalarElement> scalar_masses;
  std::vector<NastranSpring> springs;
  std::map<int, NastranScalarProperty> pelas, pbush1d, pmass;
  std::map<int, NastranBushing> pbush;
  std::optional<FeSource> damping;  ///< the first GE or B of springs
  std::vector<NastranSpider> spiders;
  std::vector<NastranRigid> rigids;
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
  NastranNames names;
  std::vector<std::string> notes;
};

/// Errors are collected in the source. With `only_nodes` all but nodes, coordinate systems and
/// supports is ignored.
NastranContent read_nastran_content(TextSource& source, bool has_control, bool only_nodes);

/// Names of cards, with blanks between, and the function that reads them into the content.
struct NastranCardReader {
  std::string_view cards;
  void (*read)(NastranFields&, NastranContent&);
};
std::span<const NastranCardReader> nastran_mesh_cards();
std::span<const NastranCardReader> nastran_bar_cards();
std::span<const NastranCardReader> nastran_material_cards();
std::span<const NastranCardReader> nastran_property_cards();
std::span<const NastranCardReader> nastran_scalar_cards();
std::span<const NastranCardReader> nastran_constraint_cards();
/// Fields 5 to 7; false if they are blank.
bool read_nastran_direction(NastranFields& f, const char* node, NastranDirection& direction);
/// Defaults for bars from BAROR and BEAMOR.
void complete_nastran_bars(NastranContent&, TextSource&);
/// Material, A, J and nonstructural mass of PROD and CONROD.
void read_nastran_rod_section(NastranFields& f, std::size_t first, NastranProperty& p);
/// Stations of a beam as on the card; blanks are filled when all are read.
void read_nastran_beam_stations(NastranFields&, NastranProperty&, std::vector<NastranStation>);
void read_nastran_named_section(NastranFields&, NastranProperty&);
/// Section about its principal axes, and nonstructural mass.
void set_nastran_section(NastranProperty& property, const NastranSection& section);

/// Does a card change neither stiffness nor mass nor geometry (loads, methods, tables, ...)?
bool is_harmless_nastran_card(std::string_view name);
/// The same of a PARAM entry.
bool is_harmless_nastran_parameter(std::string_view name);
/// Alternative to a card that is not read; null if there is none.
const char* why_nastran_card_is_refused(std::string_view name);

}  // namespace floatframe
