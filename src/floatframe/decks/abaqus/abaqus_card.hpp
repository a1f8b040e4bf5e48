#pragma once
// A keyword line with its data lines, as its handler reads them into the content of the deck. Data
// lines that a handler does not read are skipped.
//
// Handlers of keywords of Abaqus and CalculiX decks, and their common functions. The table
// `abaqus_readers` in read_abaqus.cpp assigns them to keywords.
#include <fmt/format.h>

#include <utility>

#include "floatframe/decks/abaqus/abaqus_content.hpp"

namespace floatframe {

class AbaqusCard : public AbaqusKeyword {
 public:
  AbaqusCard(AbaqusKeyword keyword, AbaqusLines& of_deck, AbaqusContent& to_fill)
      : AbaqusKeyword(std::move(keyword)), lines(of_deck), content(to_fill) {}

  AbaqusLines& lines;
  TextSource& source = lines.source();
  AbaqusContent& content;
  std::vector<std::string_view> fields;  ///< of the last data line

  /// An error for each parameter that is not among some, between blanks.
  void allow_only(std::string_view known);
  /// The value of a required parameter ("REF NODE"); an error and empty if it is missing.
  std::string_view required(std::string_view parameter);
  /// The value of a parameter as a name: upper case without blanks.
  std::string word(std::string_view parameter) const { return abaqus_name(value(parameter)); }
  /// Is a parameter missing, or equal to one of some values (separated by blanks)? Else an error:
  /// "has the type {}, expected ISOTROPIC".
  bool is_one_of(std::string_view parameter, std::string_view values,
                 fmt::format_string<std::string> text, ErrorCode code = ErrorCode::wrong_value);
  /// The set named by a parameter, created if necessary; null without the parameter.
  AbaqusSet* set(std::map<AbaqusContent::Key, AbaqusSet>& sets, std::string_view parameter);
  /// The number, set or surface named by a parameter.
  AbaqusReference reference_of(std::string_view parameter) const {
    return content.reference(value(parameter), at);
  }
  /// The same; digits are a name too.
  AbaqusReference named(std::string_view parameter) const {
    return content.named(value(parameter), at);
  }
  /// Data lines come from the file of the parameter INPUT, if it is there.
  void take_input();

  /// The next data line, without the empty field after a comma at its end; false if there are no
  /// more.
  bool next();
  /// The same; an error if there is none.
  bool needs_line();
  /// A field of the line; empty if it is missing.
  std::string_view field(std::size_t k) const { return k < fields.size() ? fields[k] : ""; }
  /// The node, element or set named by a field.
  AbaqusReference reference(std::size_t k) const { return content.reference(field(k), here()); }
  /// A real field; an error that begins with `what` if it is none.
  double real(std::size_t k, std::string_view what);
  /// The same; an empty or missing field is `otherwise`.
  double real_or(std::size_t k, double otherwise, std::string_view what) {
    return field(k).empty() ? otherwise : real(k, what);
  }
  /// One error if it is not a positive number.
  double positive(std::size_t k, std::string_view what);
  /// Three fields from k on, 0 where they are empty or missing.
  Vec3 vector(std::size_t k, std::string_view what);
  int integer(std::string_view text, std::string_view what);
  int integer_or(std::size_t k, int otherwise, std::string_view what) {
    return field(k).empty() ? otherwise : integer(field(k), what);
  }
  /// Degrees of freedom "first, last" (1..6; `last` may be missing) of the fields from k on, as a
  /// mask; 0 and an error if they are none.
  unsigned dofs(std::size_t k, std::string_view what);
  /// An error if the line has more than `count` fields, or another line follows.
  void no_more(std::size_t count);

  /// Is there an error in the input since the keyword or the last line?
  bool misread() const noexcept { return source.errors() != errors_before_line_; }
  /// Errors so far no longer count for `wrong`.
  void start() noexcept { errors_before_ = source.errors(); }
  /// Is there an error since the parameters were checked, or the last `start`?
  bool wrong() const noexcept { return source.errors() != errors_before_; }
  FeSource here() const noexcept { return source.here(); }
  /// "deck.inp:12"
  std::string place(const FeSource& of) const { return abaqus_place(source, of); }

  /// An error at the keyword: "*SOLID SECTION " + text.
  void error(ErrorCode code, std::string_view text) {
    source.error(code, at, "{} {}", shown, text);
  }
  template <class First, class... Rest>
  void error(ErrorCode code, fmt::format_string<First, Rest...> text, First&& first,
             Rest&&... rest) {
    error(code, fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
  }
  /// An error at the last line.
  template <class... Values>
  void error_in_line(ErrorCode code, fmt::format_string<Values...> text, Values&&... values) {
    source.error(code, here(), fmt::format(text, std::forward<Values>(values)...));
  }
  /// A note with the location of the keyword.
  template <class... Values>
  void note(fmt::format_string<Values...> text, Values&&... values) {
    content.note(source.mark(at), fmt::format(text, std::forward<Values>(values)...));
  }

 private:
  std::size_t errors_before_line_ = source.errors(), errors_before_ = source.errors();
};

/// Adds a node or an element; false and an error if its number exists already.
template <class T>
bool add_to_abaqus(AbaqusCard& card, AbaqusNumbered<T>& all, const T& thing,
                   std::string_view word) {
  const int there = all.add(thing);
  if (there >= 0)
    card.source.error(ErrorCode::duplicate, thing.at, "{} {} is there already ({})", word, thing.id,
                      card.place(all[there].at));
  return there < 0;
}

/// Reads the data lines of a keyword into the content.
using AbaqusHandler = void(AbaqusCard& card);

AbaqusHandler read_abaqus_nodes, read_abaqus_elements, read_abaqus_set, read_abaqus_surface;
AbaqusHandler read_abaqus_system, read_abaqus_transform, read_abaqus_orientation;
AbaqusHandler read_abaqus_generated_nodes, read_abaqus_filled_nodes, read_abaqus_copied_nodes;
AbaqusHandler read_abaqus_generated_elements, read_abaqus_copied_elements;
AbaqusHandler read_abaqus_part, read_abaqus_assembly, read_abaqus_instance, read_abaqus_end;
/// An error for each part, assembly and instance that has not ended; `where`: "before *STEP".
void close_abaqus_blocks(AbaqusContent& content, TextSource& source, const std::string& where);
/// At the end of the deck: removes parts without an instance.
void finish_abaqus_assembly(AbaqusContent& content, TextSource& source);
AbaqusHandler read_abaqus_material, read_abaqus_elastic, read_abaqus_density;
AbaqusHandler read_abaqus_initial_conditions;
/// At the end of the deck: constants whose temperature was unknown so far.
void finish_abaqus_constants(AbaqusLines& lines, AbaqusContent& content);
AbaqusHandler read_abaqus_solid_section, read_abaqus_shell_section, read_abaqus_membrane_section;
AbaqusHandler read_abaqus_nodal_thickness, read_abaqus_surface_section;
AbaqusHandler read_abaqus_mass, read_abaqus_rotary_inertia;
/// The common part of all sections; false if the section cannot be used.
bool begin_abaqus_section(AbaqusCard& card, AbaqusType::Family family, AbaqusSection& section);
AbaqusHandler read_abaqus_nonstructural_mass;
AbaqusHandler read_abaqus_beam_section, read_abaqus_place_in_section;
AbaqusHandler read_abaqus_rigid_body, read_abaqus_coupling;
AbaqusHandler read_abaqus_kinematic_coupling, read_abaqus_distributing_coupling;
AbaqusHandler read_abaqus_equation, read_abaqus_boundary, read_abaqus_mpc;
AbaqusHandler read_abaqus_tie, read_abaqus_contact_pair, read_abaqus_contact;
AbaqusHandler read_abaqus_gap, read_abaqus_pre_tension;
AbaqusHandler read_abaqus_spring;

}  // namespace floatframe
