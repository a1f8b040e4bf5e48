#pragma once
// From the content of an Abaqus deck to the model.
#include <fmt/format.h>

#include <functional>
#include <map>
#include <set>
#include <vector>

#include "floatframe/core/suggest.hpp"
#include "floatframe/decks/abaqus/abaqus_content.hpp"
#include "floatframe/decks/rigid_arms.hpp"
#include "floatframe/formats/fe_file.hpp"

namespace floatframe {

/// Meaning of a name in a scope: defined there, in the assembly, or in the only instance with it.
template <typename T>
struct AbaqusNamed {
  const std::pair<const AbaqusContent::Key, T>* entry = nullptr;
  bool several = false;  ///< instances have it
};
template <typename T>
AbaqusNamed<T> find_abaqus_name(const AbaqusContent& c, const std::map<AbaqusContent::Key, T>& map,
                                AbaqusScope scope, int name) {
  AbaqusNamed<T> found;
  for (const AbaqusScope s : {scope, AbaqusScope::assembly}) {
    const auto it = map.find({s, name});
    if (it != map.end()) return {&*it, false};
  }
  const auto look = [&](AbaqusScope s) {
    const auto it = map.find({s, name});
    if (it == map.end()) return;
    found.several = found.entry != nullptr;
    found.entry = &*it;
  };
  if (c.instances.empty()) look(AbaqusScope::part);
  for (const auto& [s, instance] : c.instances) {
    look(s);
    if (found.several) return {nullptr, true};
  }
  return found;
}

/// Names of sets or surfaces, for suggestions.
template <typename T>
std::vector<std::string> abaqus_names_of(const AbaqusContent& c,
                                         const std::map<AbaqusContent::Key, T>& map) {
  std::vector<std::string> names;
  for (const auto& [key, value] : map) {
    if (names.size() == most_known) break;
    names.push_back(c.names[key.second]);
  }
  return names;
}

/// The name of a set or surface in the model: with that of the instance if it is not unique.
template <typename T>
std::string abaqus_model_name(const AbaqusContent& c, const AbaqusContent::Key& key,
                              const std::map<AbaqusContent::Key, T>& map) {
  const std::string& name = c.names[key.second];
  const auto instance = c.instances.find(key.first);
  if (instance == c.instances.end()) return name;
  bool twice = map.contains({AbaqusScope::assembly, key.second});
  for (const auto& [s, other] : c.instances)
    twice = twice || (s != key.first && map.contains({s, key.second}));
  return twice ? instance->second.name + "." + name : name;
}

/// Resolves references to nodes or to elements; a missing one is an error, reported once. Sets of
/// sets can name the same nodes again and again in a few bytes: the total number of members is
/// limited in proportion to the deck.
class AbaqusResolver {
 public:
  enum class Of { nodes, elements };
  AbaqusResolver(const AbaqusContent& content, TextSource& source, Of of);

  /// Indices in the order of the deck, without duplicates.
  std::vector<int> resolve(const AbaqusReference& reference);
  /// The single node of a reference; -1 and an error that begins with `what` if it is not one node.
  int one(const AbaqusReference& reference, std::string_view what);
  /// All members of a set; `depth`: of sets that it is in.
  const std::vector<int>& members(const AbaqusContent::Key& key, int depth = 0);
  /// Counts members of a reference; throws if there are too many in all.
  void spend(std::uint64_t count, const FeSource& at);
  /// Missing numbers of GENERATE: how many, and the location of the first range.
  long gaps() const noexcept { return gaps_; }
  const FeSource& first_gap() const noexcept { return first_gap_; }

 private:
  enum class State { open, busy, done };
  struct Members {
    State state = State::open;
    std::vector<int> list;
  };
  int find_number(const AbaqusReference& reference) const;  ///< -1 if it is not there
  const AbaqusContent::Key* find_set(const AbaqusReference& reference) const;
  void append(const AbaqusReference& item, std::vector<int>& list);
  void append_range(const AbaqusReference& item, std::vector<int>& list);
  void add(int index, std::vector<int>& list);
  void missing(const AbaqusReference& reference);

  const AbaqusContent& content_;
  TextSource& source_;
  const std::map<AbaqusContent::Key, AbaqusSet>& sets_;
  const std::unordered_map<std::int64_t, int>& index_of_label_;
  std::string_view word_;                // "node", "element"
  std::vector<std::int64_t> ascending_;  // labels
  std::map<AbaqusContent::Key, Members> members_;
  std::vector<int> list_of_;  // of each node or element: the last list that contains it
  int list_ = 0;              // number of the list that is being built
  std::uint64_t most_work_ = 0, work_ = 0;
  long gaps_ = 0;
  FeSource first_gap_;
};

/// "element 7 (C3D4)"
std::string abaqus_label(const AbaqusElement& element);

/// A further entry of a list for a key, a changed copy of the one at `from`; its index, which is
/// kept in `copies`.
template <class T, class Key, class Change>
int changed_copy(std::vector<T>& list, int from, std::map<Key, int>& copies, const Key& key,
                 Change change) {
  const auto [it, fresh] = copies.try_emplace(key, static_cast<int>(list.size()));
  if (fresh) {
    list.push_back(list[from]);
    change(list.back());
  }
  return it->second;
}

/// Data used by both halves of the building.
struct AbaqusBuild {
  const AbaqusContent& content;
  TextSource& source;
  AbaqusResolver nodes, elements;
  std::vector<int> element_index;  ///< of each element of the deck: in the model, -1 if none
  FeModel model;
  RigidArms arms;      ///< of beams offset from their nodes
  DialectClues clues;  ///< from the deck, and from the use of its sections
  /// In FeModel::orientations, by name and use; in FeModel::shells, for sections whose
  /// plies have separate orientations.
  std::map<std::string, int> orientation_index;
  std::map<std::vector<long>, int> turned_sections;
  /// For sections: elements along their direction 1, the first in words.
  std::map<const AbaqusSection*, std::pair<std::string, long>> along_direction;

  AbaqusBuild(const AbaqusContent& c, TextSource& s)
      : content(c),
        source(s),
        nodes(c, s, AbaqusResolver::Of::nodes),
        elements(c, s, AbaqusResolver::Of::elements),
        clues(c.clues) {}
  /// Index of the node k of an element; -1 and an error if it is missing.
  int node_of(const AbaqusElement& element, int k);
  /// Nodes of elements of the deck, without duplicates.
  std::vector<int> nodes_of_elements(const std::vector<int>& list) const;
  template <class... Values>
  void note(const FeSource& at, fmt::format_string<Values...> text, Values&&... values) {
    model.notes.push_back(place(at) + ": " + fmt::format(text, std::forward<Values>(values)...));
  }
  /// An error of a section or an element, whose name is put before the text.
  template <class... Values>
  void error(const AbaqusSection& section, ErrorCode code, fmt::format_string<Values...> text,
             Values&&... values) {
    source.error(code, section.where.at,
                 section.shown + fmt::format(text, std::forward<Values>(values)...));
  }
  template <class... Values>
  void error(const AbaqusElement& e, ErrorCode code, fmt::format_string<Values...> text,
             Values&&... values) {
    source.error(code, e.at, abaqus_label(e) + fmt::format(text, std::forward<Values>(values)...));
  }
  /// "deck.inp:12"
  std::string place(const FeSource& at) const { return abaqus_place(source, at); }
  /// Program of the deck: from the user, else from the clues; by_content: undetermined.
  DeckDialect dialect() const;
};

/// Elements of a section in the model.
struct AbaqusProperties {
  FeElement like;            ///< material, section, reference and orientation
  bool directional = false;  ///< shells: not isotropic in the plane
};

/// Elements without a section: masses, springs, ...
bool is_abaqus_point(AbaqusType::Family family) noexcept;
/// For each element of the deck the index of the section whose set contains it; -1: none.
std::vector<int> sections_of_elements(AbaqusBuild& build,
                                      const std::vector<AbaqusSection>& sections);
/// Notes elements with a section that CalculiX does not allow for them: evidence of the program.
void look_at_abaqus_beams(AbaqusBuild& build, const std::vector<int>& section_of);
/// For each section; its material and its shape are added to the model.
std::vector<AbaqusProperties> abaqus_properties(AbaqusBuild& build);
/// Index of an orientation in the model, where it is added; -1 and an error if there is none.
int abaqus_orientation(AbaqusBuild& build, const std::string& name, const AbaqusSection& section);
/// `material`: index of one by its name.
ShellSection abaqus_shell_section(AbaqusBuild& build, const AbaqusSection& section,
                                  const std::function<int(const std::string&)>& material);
/// An error if thickness, offset or mass over area are too large.
void check_abaqus_sheet(AbaqusBuild& build, const AbaqusSection& section, const ShellSection& shell,
                        int material);
/// Axes of the material of an element whose nodes are known.
void orient_abaqus_element(AbaqusBuild& build, const AbaqusSection& section,
                           const AbaqusProperties& p, FeElement& e);
/// Direction 1 of a beam towards the additional node of its element, if any; its ends at the
/// centroid of its section, as separate nodes.
void move_abaqus_beam(AbaqusBuild& build, const AbaqusSection& section, const AbaqusElement& deck,
                      FeElement& e);
/// An error for each section with elements along its direction 1.
void report_abaqus_directions(AbaqusBuild& build);

/// Sections of shells with the thickness of their nodes.
class AbaqusNodalThickness {
 public:
  explicit AbaqusNodalThickness(AbaqusBuild& build);
  /// Gives the element a section of its thickness.
  void apply(const AbaqusSection& section, FeElement& e);
  void notes();

 private:
  AbaqusBuild& b_;
  std::vector<double> at_node_;
  std::map<std::pair<int, double>, int> sections_;  // of a section and a thickness
  std::set<int> given_;                             // sections with one
  bool used_ = false;
  long uneven_ = 0, missing_ = 0;
  double unevenness_ = 0.0;
  FeSource first_uneven_;
};
void build_abaqus_nodes(AbaqusBuild& build);
void build_abaqus_elements(AbaqusBuild& build);
/// With `only_nodes` element sets become node sets.
void build_abaqus_sets(AbaqusBuild& build, bool only_nodes);
/// For a 2-node beam: its shear area over the area of the section.
double abaqus_shear_factor(std::string_view shape) noexcept;
/// Mass and shear of the elements as in the program of the deck.
void as_in_home_program(AbaqusBuild& build);
void note_mass_of_unclear_dialect(AbaqusBuild& build);
/// After all elements have their sections.
void build_abaqus_nonstructural_mass(AbaqusBuild& build);
void build_abaqus_springs(AbaqusBuild& build);
void build_abaqus_ties(AbaqusBuild& build);
/// For nodes rotated by *TRANSFORM: columns are the axes of their degrees of freedom.
std::map<int, Mat3> abaqus_node_axes(AbaqusBuild& build);
/// The surface of a name and its name in the model; null and an error if there is none.
const AbaqusSurface* find_abaqus_surface(AbaqusBuild& build, const AbaqusReference& reference,
                                         std::string& shown_name);
/// For a surface of nodes.
std::vector<int> abaqus_surface_nodes(AbaqusBuild& build, const AbaqusSurface& surface);
void build_abaqus_constraints(AbaqusBuild& build, bool only_nodes);

}  // namespace floatframe
