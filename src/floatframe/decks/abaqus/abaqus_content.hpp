#pragma once
// What stands in an Abaqus or CalculiX deck, before names and numbers are resolved. The handlers of
// keywords fill it, `build_abaqus_model` makes the model.
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "floatframe/decks/abaqus/abaqus_lines.hpp"
#include "floatframe/decks/temperature_table.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/fe/surface_ties.hpp"
#include "floatframe/formats/fe_file.hpp"

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
  std::string name;
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
const AbaqusType* find_abaqus_type(std::string_view name);
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

/// Scope and number in one.
inline std::int64_t scoped_number(AbaqusScope scope, int id) noexcept {
  return static_cast<std::int64_t>(scope) << 32 | static_cast<std::int64_t>(id);
}

/// Nodes or elements in the order of the deck, found by their scope and number.
template <class T>
class AbaqusNumbered {
 public:
  /// Index by `scoped_number`.
  const std::unordered_map<std::int64_t, int>& index() const noexcept { return index_; }
  /// -1 if there is none.
  int find(AbaqusScope scope, int id) const {
    const auto it = index_.find(scoped_number(scope, id));
    return it == index_.end() ? -1 : it->second;
  }
  /// Adds it and returns -1, or the index of the one that has its number already.
  int add(const T& thing) {
    const auto [it, fresh] =
        index_.emplace(scoped_number(thing.scope, thing.id), static_cast<int>(list_.size()));
    if (!fresh) return it->second;
    list_.push_back(thing);
    return -1;
  }
  template <class Condition>
  void remove_if(Condition condition) {
    const std::vector<T> all = std::exchange(list_, {});
    index_.clear();
    for (const T& thing : all)
      if (!condition(thing)) add(thing);
  }
  std::size_t size() const noexcept { return list_.size(); }
  const T& operator[](std::size_t k) const { return list_[k]; }
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }

 private:
  std::vector<T> list_;
  std::unordered_map<std::int64_t, int> index_;
};

struct AbaqusSet {
  std::vector<AbaqusReference> items;
  bool internal = false;  ///< made by Abaqus/CAE for itself
  FeSource at;
};

/// What the deck says of nodes, elements or a surface, where it names them: `where.at`.
struct AbaqusThing {
  AbaqusReference where;
};

struct AbaqusSurface {
  struct Item : AbaqusThing {
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

struct AbaqusSection : AbaqusThing {
  AbaqusType::Family family = AbaqusType::Family::solid;
  std::string shown;  ///< for messages: "*SOLID SECTION"
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
  std::string shape;           ///< of beams: "CIRC"
  double round = 0.0;          ///< of CIRC with one number: it depends on the dialect what it is
  bool calculix_form = false;  ///< fewer or more numbers than Abaqus takes
  Vec3 n1 = -Vec3::UnitZ();
  Eigen::Vector2d arm = {0.0, 0.0};   ///< of beams: the centroid from the node, in directions 1, 2
  bool calculix_offset = false;       ///< OFFSET1, OFFSET2
  std::optional<FeSource> offset_at;  ///< of *BEAM SECTION OFFSET, which Abaqus has
  Eigen::Vector2d shear_center = {0.0, 0.0};  ///< of beams of given constants, from the node
  double mass = 0.0;                          ///< of *MASS
  Mat3 J = Mat3::Zero();
};

/// *INITIAL CONDITIONS, TYPE=TEMPERATURE and *NODAL THICKNESS
struct AbaqusNodalValue : AbaqusThing {
  double value = 0.0;
  bool gradient = false;  ///< of temperatures: it differs across the section of shells and beams
};

/// `where` is its reference.
struct AbaqusSpider : AbaqusThing {
  Spider in_model;                          ///< with its kind, name and mask
  std::optional<AbaqusReference> rotation;  ///< ROT NODE
  std::vector<AbaqusReference> nodes, elements;
  std::vector<double> weights;             ///< one an entry of `nodes`; empty: 1
  std::optional<AbaqusReference> surface;  ///< its name
  bool reference_by_element = false;       ///< `where` is the element set of a DCOUP3D
};

struct AbaqusEquation {
  struct Term : AbaqusThing {
    int axis = 0;
    double factor = 0.0;
  };
  std::vector<Term> terms;
  FeSource at;
};

struct AbaqusSupport : AbaqusThing {
  unsigned mask = 0;
};

/// *SPRING
struct AbaqusSpring : AbaqusThing {
  std::vector<std::vector<double>> lines;  ///< data, without blank lines
  std::string orientation;                 ///< name; empty: none
  bool nonlinear = false;
};

/// *TIE, or a contact pair that is joined; `where` is its slave surface.
struct AbaqusTie : AbaqusThing {
  AbaqusReference master;
  SurfaceTie in_model;  ///< how they are tied
  bool contact = false;
};

/// Turned directions of degrees of freedom.
struct AbaqusTransform : AbaqusThing {
  AbaqusScope scope = AbaqusScope::part;  ///< in which its points are
  bool cylindrical = false;
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
};

/// Where an instance is: x = R (p + t - a) + a.
struct AbaqusPlacement {
  Vec3 t = Vec3::Zero(), a = Vec3::Zero();
  Mat3 R = Mat3::Identity();
  Vec3 at(const Vec3& p) const { return R * (p + t - a) + a; }
};

/// *NONSTRUCTURAL MASS
struct AbaqusNonstructuralMass : AbaqusThing {
  enum class Units { total, volume, area, length };
  Units units = Units::total;
  bool by_volume = false;  ///< of a total: in proportion to the volume, not the mass
  double value = 0.0;
};

class AbaqusCard;
/// Constants of a material for which the deck says a temperature later, or not at all.
struct AbaqusPendingConstants {
  using Use = void (*)(AbaqusCard&, AbaqusMaterial&, const std::vector<double>&);
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
  bool is_meshed() const noexcept { return end[0] > begin[0] || end[1] > begin[1]; }
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

  AbaqusNumbered<AbaqusNode> nodes;
  AbaqusNumbered<AbaqusElement> elements;
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
  std::vector<AbaqusNodalValue> thicknesses, initial_temperatures;
  std::vector<AbaqusNonstructuralMass> nonstructural;
  std::vector<AbaqusThing> pre_tensions;  ///< *PRE-TENSION SECTION of surfaces
  std::vector<AbaqusPendingConstants> pending;
  std::vector<std::string> notes;
  void note(const SourceMark& mark, const std::string& text);
  FeReadOptions options;  ///< of the temperature also what the deck says
  DialectClues clues;
  /// Only nodes, sets and spiders are wanted: matrices hold what the rest would change.
  bool only_nodes = false;

  // Where reading is.
  AbaqusScope scope = AbaqusScope::part;
  std::map<std::string, AbaqusPart> parts;  ///< empty in flat decks
  std::string part;                         ///< the last one
  std::map<AbaqusScope, AbaqusInstance> instances;
  std::map<std::string, AbaqusScope> scope_of_instance;
  std::optional<Orientation> system;  ///< *SYSTEM: of the coordinates of nodes, in the part
  std::vector<AbaqusOpenBlock> open;
  int scopes = 2;        ///< how many there are
  std::string material;  ///< the last *MATERIAL

  int intern(std::string name);
  /// Index of a node of an element (k from 0); -1 if it is not there.
  int node_of(const AbaqusElement& element, std::size_t k) const {
    return nodes.find(element.scope, element_nodes[element.first + k]);
  }
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

/// "deck.inp:12"
std::string abaqus_place(const TextSource& source, const FeSource& at);

}  // namespace floatframe
