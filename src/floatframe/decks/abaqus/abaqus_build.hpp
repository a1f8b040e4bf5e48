#pragma once
// From the content of an Abaqus deck to the model.
#include <fmt/format.h>

#include <functional>

#include "floatframe/decks/abaqus/abaqus_resolve.hpp"
#include "floatframe/decks/rigid_arms.hpp"
#include "floatframe/formats/fe_file.hpp"

namespace floatframe {

/// "element 7 (C3D4)"
std::string abaqus_label(const AbaqusElement& element);

/// A further entry of a list for a key, like the one at `from` but for a change; its index, which
/// `copies` keeps.
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

/// What both halves of the building use.
struct AbaqusBuild {
  const AbaqusContent& content;
  TextSource& source;
  AbaqusResolver nodes, elements;
  std::vector<int> element_index;  ///< of each element of the deck: in the model, -1 if it has none
  FeModel model;
  RigidArms arms;      ///< of beams beside their nodes
  DialectClues clues;  ///< of the deck, and of what its sections are used for
  /// In FeModel::orientations, of names and what uses them; in FeModel::shells, of sections whose
  /// plies have orientations of their own.
  std::map<std::string, int> orientation_index;
  std::map<std::vector<long>, int> turned_sections;
  /// Of sections: elements along their direction 1, the first in words.
  std::map<const AbaqusSection*, std::pair<std::string, long>> along_direction;

  AbaqusBuild(const AbaqusContent& c, TextSource& s)
      : content(c),
        source(s),
        nodes(c, s, AbaqusResolver::Of::nodes),
        elements(c, s, AbaqusResolver::Of::elements),
        clues(c.clues) {}
  /// Index of the node k of an element; -1 and an error if it is not there.
  int node_of(const AbaqusElement& element, int k);
  /// Nodes of elements of the deck, each once.
  std::vector<int> nodes_of_elements(const std::vector<int>& list) const;
  template <class... Values>
  void note(const FeSource& at, fmt::format_string<Values...> text, Values&&... values) {
    model.notes.push_back(place(at) + ": " + fmt::format(text, std::forward<Values>(values)...));
  }
  /// An error of a section or an element, which stands before the text.
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
  /// Whose deck it is: as the user says, else as the clues show; by_content: nothing shows it.
  DeckDialect dialect() const;
};

/// What the elements of a section have in the model.
struct AbaqusProperties {
  Element like;              ///< material, section, reference and orientation
  bool directional = false;  ///< shells: not isotropic in the plane
};

/// Elements that have no section: masses, springs, ...
bool is_abaqus_point(AbaqusType::Family family) noexcept;
/// Of each element of the deck the index of the section whose set names it; -1: none.
std::vector<int> sections_of_elements(AbaqusBuild& build,
                                      const std::vector<AbaqusSection>& sections);
/// Notes elements with a section that CalculiX does not take for them: a clue whose deck it is.
void look_at_abaqus_beams(AbaqusBuild& build, const std::vector<int>& section_of);
/// Of each section; its material and its shape get into the model.
std::vector<AbaqusProperties> abaqus_properties(AbaqusBuild& build);
/// Index of an orientation in the model, which gets it; -1 and an error if there is none.
int abaqus_orientation(AbaqusBuild& build, const std::string& name, const AbaqusSection& section);
/// `material`: index of one by its name.
ShellSection abaqus_shell_section(AbaqusBuild& build, const AbaqusSection& section,
                                  const std::function<int(const std::string&)>& material);
/// An error if thickness, offset or mass over area are too large.
void check_abaqus_sheet(AbaqusBuild& build, const AbaqusSection& section, const ShellSection& shell,
                        int material);
/// Axes of the material of an element whose nodes are known.
void orient_abaqus_element(AbaqusBuild& build, const AbaqusSection& section,
                           const AbaqusProperties& p, Element& e);
/// Direction 1 of a beam towards the further node of its element, if it has one; its ends at the
/// centroid of its section, as nodes of their own.
void move_abaqus_beam(AbaqusBuild& build, const AbaqusSection& section, const AbaqusElement& deck,
                      Element& e);
/// An error for each section with elements along its direction 1.
void report_abaqus_directions(AbaqusBuild& build);

/// Sections of shells with the thickness of their nodes.
class AbaqusNodalThickness {
 public:
  explicit AbaqusNodalThickness(AbaqusBuild& build);
  /// The element gets a section of its thickness.
  void apply(const AbaqusSection& section, Element& e);
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
/// Of a 2-node beam: its shear area over the area of the section.
double abaqus_shear_factor(std::string_view shape) noexcept;
/// Mass and shear of the elements as the program of the deck has them.
void as_in_home_program(AbaqusBuild& build);
void note_mass_of_unclear_dialect(AbaqusBuild& build);
/// Once all elements have their sections.
void build_abaqus_nonstructural_mass(AbaqusBuild& build);
void build_abaqus_springs(AbaqusBuild& build);
void build_abaqus_ties(AbaqusBuild& build);
/// Of the nodes that *TRANSFORM turns: columns are the axes of their degrees of freedom.
std::map<int, Mat3> abaqus_node_axes(AbaqusBuild& build);
/// The surface of a name and its name in the model; null and an error if there is none.
const AbaqusSurface* find_abaqus_surface(AbaqusBuild& build, const AbaqusReference& reference,
                                         std::string& shown_name);
/// Of a surface of nodes.
std::vector<int> abaqus_surface_nodes(AbaqusBuild& build, const AbaqusSurface& surface);
void build_abaqus_constraints(AbaqusBuild& build, bool only_nodes);

}  // namespace floatframe
