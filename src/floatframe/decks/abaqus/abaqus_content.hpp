#pragma once
// What stands in an Abaqus or CalculiX deck, before names and numbers are resolved. The handlers of
// keywords fill it, `build_abaqus_model` makes the model.
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "floatframe/decks/abaqus/abaqus_dialect.hpp"
#include "floatframe/decks/abaqus/abaqus_lines.hpp"
#include "floatframe/decks/temperature_table.hpp"
#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// What an element type of the deck is to us.
struct AbaqusType {
  enum class Family {
    solid,
    shell,
    beam,
    skin,      ///< faces and edges of meshes: harmless without a section, not supported with one
    mass,      ///< MASS
    rotary,    ///< ROTARYI
    coupling,  ///< DCOUP3D: names the reference of a distributing coupling
    rod,       ///< T3D2: harmless without a section, as a skin
    membrane,  ///< M3D: the same
    spring,    ///< SPRINGA, SPRING1, SPRING2
    damper,    ///< DASHPOTA, ...: ignored
    gap        ///< GAPUNI: *GAP says what becomes of it
  };
  const char* name;
  Family family;
  int nodes;
  ElementType type = ElementType::beam2;  ///< of solids, shells and beams
  const char* remark = nullptr;           ///< how it is read if that is not the same
};

/// Shells and membranes: their sections have a thickness.
constexpr bool is_abaqus_sheet(AbaqusType::Family family) noexcept {
  return family == AbaqusType::Family::shell || family == AbaqusType::Family::membrane;
}

/// Null if the type is not known.
const AbaqusType* find_abaqus_type(std::string_view name) noexcept;
/// For messages.
std::vector<std::string> abaqus_type_names();

/// Spaces of numbers and names: that of a flat deck or the first part, the assembly, and from 2 on
/// one of each further part and instance. The first instance of a part has the part's own.
enum class AbaqusScope { part, assembly };

struct AbaqusNode {
  int id = 0;
  AbaqusScope scope = AbaqusScope::part;
  Vec3 p = Vec3::Zero();
  FeSource at;
};

struct AbaqusElement {
  int id = 0;
  AbaqusScope scope = AbaqusScope::part;
  const AbaqusType* type = nullptr;
  std::size_t first = 0;  ///< in AbaqusContent::element_nodes
  bool directed = false;  ///< of beams: a further node gives direction 1
  FeSource at;
};

/// A number, a range of numbers or a name in a set or another place that names nodes or elements.
struct AbaqusReference {
  int first = 0, last = 0, step = 1;  ///< one number: first = last
  int name = -1;                      ///< index in AbaqusContent::names; -1: numbers
  AbaqusScope scope = AbaqusScope::part;
  FeSource at;
};

struct AbaqusSet {
  std::vector<AbaqusReference> items;
  bool internal = false;  ///< made by Abaqus/CAE for itself
  FeSource at;
};

struct AbaqusSurface {
  struct Item {
    AbaqusReference where;
    int face = -1;        ///< from 0; -1 for nodes
    double weight = 1.0;  ///< of nodes
  };
  bool of_nodes = false, internal = false;
  std::vector<Item> items;
  FeSource at;
};

struct AbaqusMaterial {
  std::optional<double> young, poisson, density;
  std::optional<Mat6> elasticity;  ///< if it is not isotropic; `young` is the first constant then
  bool plane = false;              ///< TYPE=LAMINA
  FeSource at;
};

/// *ORIENTATION: points a, b and the origin c, then a rotation about one of the axes.
struct AbaqusOrientation {
  enum class Kind { rectangular, z_rectangular, cylindrical };
  Kind kind = Kind::rectangular;
  Vec3 a = Vec3::Zero(), b = Vec3::Zero(), c = Vec3::Zero();
  int axis = 0;             ///< 1, 2, 3; 0: no second line
  bool axis_given = false;  ///< else the 1 of Abaqus
  double angle = 0.0;       ///< [rad]
  AbaqusScope scope = AbaqusScope::part;
  FeSource at;

  /// They give no axes: a, b and c, of cylinders a and b.
  bool points_on_a_line() const;
  const char* wrong_points() const noexcept;
};

struct AbaqusSection {
  AbaqusType::Family family = AbaqusType::Family::solid;
  std::string shown;  ///< for messages: "*SOLID SECTION"
  AbaqusReference elements;
  std::string material;
  std::string orientation;  ///< name; empty: none
  double thickness = 0.0;
  bool nodal_thickness = false;  ///< of sheets: that of *NODAL THICKNESS
  double offset = 0.0;           ///< of shells: of the nodes from the middle, in thicknesses
  struct Ply {
    double thickness = 0.0;
    std::string material;
    double angle = 0.0;       ///< [rad]
    std::string orientation;  ///< in place of the angle; empty: none
  };
  std::vector<Ply> plies;  ///< of *SHELL SECTION, COMPOSITE from the bottom
  bool symmetric = false;  ///< `plies` are the lower half
  BeamSection beam;
  std::string shape;  ///< of beams: "CIRC"
  double round =
      0.0;  ///< of CIRC with one number: that number, whose meaning depends on the dialect
  bool calculix_form = false;  ///< fewer or more numbers than Abaqus takes
  Vec3 n1 = -Vec3::UnitZ();
  Eigen::Vector2d arm = {0.0, 0.0};   ///< of beams: the centroid from the node, in directions 1, 2
  bool calculix_offset = false;       ///< OFFSET1, OFFSET2
  std::optional<FeSource> offset_at;  ///< of *BEAM SECTION OFFSET, which Abaqus has
  Eigen::Vector2d shear_center = {0.0, 0.0};  ///< of beams of given constants, from the node
  double mass = 0.0;                          ///< of *MASS
  Mat3 J = Mat3::Zero();
  FeSource at;
};

/// *INITIAL CONDITIONS, TYPE=TEMPERATURE
struct AbaqusInitialTemperature {
  AbaqusReference nodes;
  double value = 0.0;
  bool gradient = false;  ///< of shells and beams: it differs across the section
};

/// *NODAL THICKNESS
struct AbaqusThickness {
  AbaqusReference nodes;
  double value = 0.0;
  FeSource at;
};

struct AbaqusSpider {
  Spider::Kind kind = Spider::Kind::rigid;
  std::string name;
  AbaqusReference reference;
  std::optional<AbaqusReference> rotation;  ///< ROT NODE
  std::vector<AbaqusReference> nodes, elements;
  std::vector<double> weights;             ///< one an entry of `nodes`; empty: 1
  std::optional<AbaqusReference> surface;  ///< its name
  unsigned mask = 63u;
  bool reference_by_element = false;  ///< `reference` is the element set of a DCOUP3D
  FeSource at;
};

struct AbaqusEquation {
  struct Term {
    AbaqusReference nodes;
    int axis = 0;
    double factor = 0.0;
  };
  std::vector<Term> terms;
  FeSource at;
};

struct AbaqusSupport {
  AbaqusReference nodes;
  unsigned mask = 0;
  FeSource at;
};

/// *SPRING
struct AbaqusSpring {
  AbaqusReference elements;
  std::vector<std::vector<double>> lines;  ///< data, without blank lines
  std::string orientation;                 ///< name; empty: none
  bool nonlinear = false;
  FeSource at;
};

/// *TIE, or a contact pair that is joined.
struct AbaqusTie {
  AbaqusReference slave, master;  ///< names of surfaces
  double distance = 0.0;          ///< 0: in proportion to the faces
  bool adjust = true, rotations = true, contact = false;
  FeSource at;
};

/// Turned directions of degrees of freedom.
struct AbaqusTransform {
  AbaqusReference nodes;
  AbaqusScope scope = AbaqusScope::part;  ///< in which its points are
  bool cylindrical = false;
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
  FeSource at;
};

/// Where an instance is: x = R (p + t - a) + a.
struct AbaqusPlacement {
  Vec3 t = Vec3::Zero(), a = Vec3::Zero();
  Mat3 R = Mat3::Identity();
  Vec3 at(const Vec3& p) const { return R * (p + t - a) + a; }
};

/// *SYSTEM: axes in which coordinates of nodes are given.
struct AbaqusCoordinates {
  Mat3 axes = Mat3::Identity();  ///< columns in the axes of the part
  Vec3 origin = Vec3::Zero();
};

/// *NONSTRUCTURAL MASS
struct AbaqusNonstructuralMass {
  enum class Units { total, volume, area, length };
  AbaqusReference elements;
  Units units = Units::total;
  bool by_volume = false;  ///< of a total: in proportion to the volume, not the mass
  double value = 0.0;
  FeSource at;
};

/// *PRE-TENSION SECTION of a surface, which must be there.
struct AbaqusPreTension {
  AbaqusReference surface;
};

struct AbaqusContent;
/// Constants of a material for which the deck says a temperature later, or not at all.
struct AbaqusPendingConstants {
  using Use = void (*)(AbaqusLines&, const AbaqusKeyword&, AbaqusMaterial&,
                       const std::vector<double>&);
  AbaqusKeyword keyword;
  std::string material;
  std::vector<TemperatureRow> rows;
  Use use = nullptr;
};

/// How much of each kind has been read: nodes, elements and the lists of things.
using AbaqusSizes = std::array<std::size_t, 13>;

struct AbaqusPart {
  AbaqusScope scope = AbaqusScope::part;
  AbaqusSizes begin{}, end{};  ///< its own
  bool used = false;           ///< by an instance
  bool grown = false;          ///< by a mesh inside its first instance
  FeSource at;
};

struct AbaqusInstance {
  std::string name, part;
  AbaqusPlacement place;
  AbaqusSizes begin{};  ///< where a mesh inside of it would begin
};

/// *PART, *ASSEMBLY or *INSTANCE that has not ended.
struct AbaqusOpenBlock {
  std::string keyword;  ///< "PART"
  std::string name;
  FeSource at;
};

struct AbaqusContent {
  using Key = std::pair<AbaqusScope, int>;  ///< scope, index in `names`

  std::vector<AbaqusNode> nodes;
  std::unordered_map<std::int64_t, int> node_of_label, element_of_label;  ///< by `label`
  std::vector<AbaqusElement> elements;
  std::vector<int> element_nodes;
  std::vector<std::string> names;
  std::unordered_map<std::string, int> name_of_text;
  std::map<Key, AbaqusSet> node_sets, element_sets;
  std::map<Key, AbaqusSurface> surfaces;
  std::map<std::string, AbaqusMaterial> materials;
  std::vector<std::string> material_order;
  std::map<std::pair<AbaqusScope, std::string>, AbaqusOrientation> orientations;
  std::vector<AbaqusSection> sections, masses;
  std::vector<AbaqusSpider> spiders;
  std::vector<AbaqusEquation> equations;
  std::vector<AbaqusSupport> supports;
  std::vector<AbaqusTie> ties;
  std::vector<AbaqusSpring> springs;
  std::vector<AbaqusTransform> transforms;
  std::vector<AbaqusThickness> thicknesses;
  std::vector<AbaqusNonstructuralMass> nonstructural;
  std::vector<AbaqusPreTension> pre_tensions;
  std::vector<AbaqusInitialTemperature> initial_temperatures;
  std::vector<AbaqusPendingConstants> pending;
  std::vector<std::string> notes;
  void note(const SourceMark& mark, const std::string& text);
  DeckContact contact = DeckContact::refuse;  ///< as the user says
  double contact_distance = 0.0;
  DeckDialect dialect = DeckDialect::by_content;  ///< as the user says
  std::optional<double> temperature;              ///< as the user says
  DialectClues clues;
  /// Only nodes, sets and spiders are wanted: matrices hold what the rest would change.
  bool only_nodes = false;

  // Where reading is.
  AbaqusScope scope = AbaqusScope::part;
  std::map<std::string, AbaqusPart> parts;  ///< empty in flat decks
  std::string part;                         ///< the last one
  std::map<AbaqusScope, AbaqusInstance> instances;
  std::map<std::string, AbaqusScope> scope_of_instance;
  std::optional<AbaqusCoordinates> system;
  std::vector<AbaqusOpenBlock> open;
  int scopes = 2;        ///< how many there are
  std::string material;  ///< the last *MATERIAL

  static std::int64_t label(AbaqusScope scope, int id) noexcept {
    return static_cast<std::int64_t>(scope) << 32 | static_cast<std::int64_t>(id);
  }
  int intern(std::string name);
  /// Of the scope: that of its instance, or as it stands.
  const AbaqusPlacement& placement(AbaqusScope scope) const;
  /// "BOLT-2." if there are several instances and the scope is one of them, else empty.
  std::string prefix(AbaqusScope scope) const;
  /// The orientation as seen from a scope; null if there is none.
  const AbaqusOrientation* orientation(AbaqusScope scope, const std::string& name) const;
  /// A number, a name, or either with the instance before it: "PART-1-1.12".
  AbaqusReference reference(std::string_view field, const FeSource& at);
  /// A name, also with the instance before it.
  AbaqusReference named(std::string_view field, const FeSource& at);
  /// "node 12" or "node set 'BALL'" with `what` = "node".
  std::string text(const AbaqusReference& reference, std::string_view what) const;
};

}  // namespace floatframe
