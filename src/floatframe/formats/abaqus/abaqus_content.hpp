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

#include "floatframe/fe/fe_model.hpp"
#include "floatframe/formats/abaqus/abaqus_dialect.hpp"
#include "floatframe/formats/abaqus/abaqus_lines.hpp"
#include "floatframe/formats/temperature_table.hpp"

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
    spring,    ///< SPRINGA, SPRING1, SPRING2
    damper,    ///< DASHPOTA, ...: passed over
    gap        ///< GAPUNI: *GAP says what becomes of it
  };
  const char* name;
  Family family;
  int nodes;
  ElementType type = ElementType::beam2;  ///< of solids, shells and beams
  const char* remark = nullptr;           ///< how it is read if that is not the same
};

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
  int axis = 0;        ///< 1, 2, 3; 0: no second line
  double angle = 0.0;  ///< [rad]
  AbaqusScope scope = AbaqusScope::part;
  FeSource at;
};

struct AbaqusSection {
  AbaqusType::Family family = AbaqusType::Family::solid;
  std::string shown;  ///< for messages: "*SOLID SECTION"
  AbaqusReference elements;
  std::string material;
  std::string orientation;  ///< name; empty: none
  double thickness = 0.0;
  bool nodal_thickness = false;  ///< of shells: that of *NODAL THICKNESS
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
  double mass = 0.0;  ///< of *MASS
  Mat3 J = Mat3::Zero();
  FeSource at;
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

/// How much of each kind has been read: nodes, elements and the lists of things.
using AbaqusSizes = std::array<std::size_t, 11>;

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

/// A keyword's handler: reads its data lines into the content.
using AbaqusHandler = void (*)(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);

// abaqus_mesh.cpp
void read_abaqus_nodes(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_elements(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_node_set(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_element_set(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_surface(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_coordinates.cpp
void read_abaqus_system(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_generate.cpp
void read_abaqus_generated_nodes(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_filled_nodes(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_copied_nodes(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_generated_elements(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_copied_elements(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_assembly.cpp
void read_abaqus_part(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_end_part(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_assembly(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_instance(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_end_instance(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
/// At the end of the deck: parts without an instance go.
void finish_abaqus_assembly(AbaqusContent& content, TextSource& source);
// abaqus_instances.cpp
AbaqusSizes abaqus_sizes(const AbaqusContent& content);
/// What a part has once more, for an instance of it. Throws if instances make too much.
void copy_abaqus_part(AbaqusContent& content, const AbaqusPart& part, AbaqusScope to,
                      TextSource& source);
void remove_abaqus_scopes(AbaqusContent& content, const std::set<AbaqusScope>& scopes);
// abaqus_properties.cpp
void read_abaqus_material(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_elastic(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_density(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_solid_section(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_surface_section(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_mass(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_rotary_inertia(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
/// What all sections have; false if the section cannot be used.
bool begin_abaqus_section(AbaqusLines& lines, const AbaqusKeyword& keyword, AbaqusContent& content,
                          AbaqusType::Family family, AbaqusSection& section);
/// The value; one error at the last line if it is no positive number.
double positive_real(AbaqusLines& lines, std::string_view field, std::string_view what);
// abaqus_shell_section.cpp
void read_abaqus_shell_section(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_nodal_thickness.cpp
void read_abaqus_nodal_thickness(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_anisotropic.cpp
void read_abaqus_orientation(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
/// Is it a type of *ELASTIC that is read but not isotropic?
bool is_abaqus_anisotropic(std::string_view type);
void read_abaqus_anisotropic(AbaqusLines& lines, const AbaqusKeyword& keyword,
                             AbaqusContent& content, AbaqusMaterial* material);
/// Of a table the values at the temperature that the user says, with a note; empty and an error if
/// that is not known.
std::vector<double> abaqus_at_temperature(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                          AbaqusContent& content,
                                          const std::vector<TemperatureRow>& rows);
// abaqus_beam_section.cpp
void read_abaqus_beam_section(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_constraints.cpp
void read_abaqus_rigid_body(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_coupling(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_kinematic_coupling(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_distributing_coupling(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_equation(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_boundary(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_mpc.cpp
void read_abaqus_mpc(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_ties.cpp
void read_abaqus_tie(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_contact_pair(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_general_contact(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_springs.cpp
void read_abaqus_spring(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
void read_abaqus_gap(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);
// abaqus_transforms.cpp
void read_abaqus_transform(AbaqusLines&, const AbaqusKeyword&, AbaqusContent&);

/// Degrees of freedom "first, last" (1..6; `last` may be missing) of the fields from `index` on, as
/// a mask; 0 and an error if they are none.
unsigned abaqus_dofs(AbaqusLines& lines, const std::vector<std::string_view>& fields,
                     std::size_t index, std::string_view what);

}  // namespace floatframe
