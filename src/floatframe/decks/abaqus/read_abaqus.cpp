#include "floatframe/decks/abaqus/read_abaqus.hpp"

#include <set>

#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/abaqus/abaqus_card.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr const char* beam_parameters =
    "ELSET MATERIAL ORIENTATION SECTION OFFSET1 OFFSET2 TEMPERATURE POISSON DENSITY LUMPED ZERO";

/// A keyword that is read, and the parameters it may have, between blanks; null: any, or the
/// handler checks them itself.
struct AbaqusReader {
  const char* name;
  AbaqusHandler* read;
  const char* parameters = nullptr;
  bool may_be_in_step = false;  ///< in a step it does not change the part
};

void skip(AbaqusCard& /*card*/) {}

constexpr AbaqusReader abaqus_readers[] = {
    {"HEADING", skip, nullptr, true},
    {"NODE", read_abaqus_nodes, "NSET SYSTEM INPUT"},
    {"SYSTEM", read_abaqus_system, ""},
    {"ELEMENT", read_abaqus_elements, "TYPE ELSET INPUT"},
    {"NGEN", read_abaqus_generated_nodes, "NSET LINE SYSTEM"},
    {"NFILL", read_abaqus_filled_nodes, "NSET"},
    {"NCOPY", read_abaqus_copied_nodes},
    {"ELGEN", read_abaqus_generated_elements, "ELSET"},
    {"ELCOPY", read_abaqus_copied_elements, "ELEMENTSHIFT OLDSET SHIFTNODES NEWSET"},
    {"NSET", read_abaqus_set, "NSET GENERATE INSTANCE INTERNAL UNSORTED ELSET INPUT", true},
    {"ELSET", read_abaqus_set, "ELSET GENERATE INSTANCE INTERNAL UNSORTED INPUT", true},
    {"SURFACE", read_abaqus_surface, "NAME TYPE INTERNAL", true},
    {"PART", read_abaqus_part},
    {"END PART", read_abaqus_end, nullptr, true},
    {"ASSEMBLY", read_abaqus_assembly},
    {"END ASSEMBLY", read_abaqus_end, nullptr, true},
    {"INSTANCE", read_abaqus_instance, "NAME PART"},
    {"END INSTANCE", read_abaqus_end, nullptr, true},
    {"MATERIAL", read_abaqus_material},
    {"ELASTIC", read_abaqus_elastic, "TYPE MODULI DEPENDENCIES"},
    {"DENSITY", read_abaqus_density, "DEPENDENCIES"},
    {"INITIAL CONDITIONS", read_abaqus_initial_conditions, nullptr, true},
    {"ORIENTATION", read_abaqus_orientation, "NAME SYSTEM DEFINITION", true},
    {"SOLID SECTION", read_abaqus_solid_section, "ELSET MATERIAL ORIENTATION CONTROLS"},
    {"SHELL SECTION", read_abaqus_shell_section},
    {"SHELL GENERAL SECTION", read_abaqus_shell_section},
    {"MEMBRANE SECTION", read_abaqus_membrane_section,
     "ELSET MATERIAL ORIENTATION CONTROLS OFFSET POISSON NODALTHICKNESS STACKDIRECTION"},
    {"NODAL THICKNESS", read_abaqus_nodal_thickness, ""},
    {"BEAM SECTION", read_abaqus_beam_section, beam_parameters},
    {"BEAM GENERAL SECTION", read_abaqus_beam_section, beam_parameters},
    {"BEAM SECTION OFFSET", read_abaqus_place_in_section, nullptr, true},
    {"CENTROID", read_abaqus_place_in_section, nullptr, true},
    {"SHEAR CENTER", read_abaqus_place_in_section, nullptr, true},
    {"SURFACE SECTION", read_abaqus_surface_section, nullptr, true},
    {"MASS", read_abaqus_mass, "ELSET TYPE ALPHA COMPOSITE"},
    {"NONSTRUCTURAL MASS", read_abaqus_nonstructural_mass, "ELSET UNITS DISTRIBUTION"},
    {"ROTARY INERTIA", read_abaqus_rotary_inertia, "ELSET ORIENTATION ALPHA COMPOSITE"},
    {"RIGID BODY", read_abaqus_rigid_body, "NSET ELSET REFNODE ROTNODE TIENSET PINNSET POSITION"},
    {"COUPLING", read_abaqus_coupling, "CONSTRAINTNAME REFNODE SURFACE"},
    {"KINEMATIC COUPLING", read_abaqus_kinematic_coupling, "REFNODE"},
    {"DISTRIBUTING COUPLING", read_abaqus_distributing_coupling, "ELSET"},
    {"EQUATION", read_abaqus_equation, "INPUT"},
    {"BOUNDARY", read_abaqus_boundary, nullptr, true},
    {"TIE", read_abaqus_tie,
     "NAME ADJUST POSITIONTOLERANCE CYCLICSYMMETRY TYPE NOROTATION CONSTRAINTRATIO NOTHICKNESS"},
    {"CONTACT PAIR", read_abaqus_contact_pair, nullptr, true},
    {"CONTACT", read_abaqus_contact, nullptr, true},
    {"MPC", read_abaqus_mpc, "INPUT"},
    {"PRE-TENSION SECTION", read_abaqus_pre_tension, nullptr, true},
    {"SPRING", read_abaqus_spring, "ELSET ORIENTATION NONLINEAR"},
    {"GAP", read_abaqus_gap, nullptr, true},
    {"TRANSFORM", read_abaqus_transform, "NSET TYPE", true},
};

/// A keyword at a distance of one or two letters from one that is read.
std::string nearly(const std::string& name) {
  if (name.size() > 40) return {};
  for (const AbaqusReader& r : abaqus_readers) {
    const std::string known = abaqus_name(r.name);
    const std::size_t letters = known.size();
    if (letters >= 4 && edit_distance(name, known) <= (letters >= 8 ? 2 : 1)) return r.name;
  }
  return {};
}

/// Null if the keyword is not read.
const AbaqusReader* reader_of(const std::string& name) {
  static const auto map = [] {
    std::unordered_map<std::string, const AbaqusReader*> all;
    for (const AbaqusReader& r : abaqus_readers) all.emplace(abaqus_name(r.name), &r);
    return all;
  }();
  const auto it = map.find(name);
  return it == map.end() ? nullptr : it->second;
}

/// Does a keyword of a step change the part from there on? Loads, procedures and output requests
/// do not. Removed elements change the part; removed contact pairs and equations do
/// not.
bool changes_part(const AbaqusKeyword& keyword) {
  if (keyword.name == "MODELCHANGE")
    return abaqus_name(keyword.value("TYPE")) != "CONTACTPAIR" && !keyword.has("ACTIVATE");
  const AbaqusReader* const reader = reader_of(keyword.name);
  return (reader != nullptr
              ? !reader->may_be_in_step
              : has_word("CHANGESOLIDSECTION MATRIXINPUT MATRIXASSEMBLE", keyword.name)) &&
         !keyword.has("REMOVE") && !keyword.has("REMOVEALL");
}

/// The keywords of a deck in order.
class DeckReader {
 public:
  DeckReader(AbaqusLines& lines, AbaqusContent& content) : lines_(lines), content_(content) {}

  void read() {
    std::string_view first;
    if (lines_.next_data(first))
      lines_.source().stop(ErrorCode::wrong_value, lines_.source().here(),
                           "the deck begins with {}, expected a keyword line (*...)", shown(first));
    AbaqusKeyword keyword;
    while (lines_.next_keyword(keyword)) {
      content_.clues.look_at(keyword);
      AbaqusCard card(keyword, lines_, content_);
      one(card);
    }
  }

 private:
  void one(AbaqusCard& card) {
    if (const AbaqusReader* const reader = reader_of(card.name)) {
      if (reader->parameters != nullptr) card.allow_only(reader->parameters);
      reader->read(card);
    } else if (card.name == "STEP") {
      close_abaqus_blocks(content_, card.source, "before *STEP");
      note(card, "and what follows up to *END STEP is ignored");
      step(card);
    } else if (is_harmless_in_abaqus(card.name)) {
      note(card, "is ignored");
    } else if (const char* const advice = advice_for_abaqus(card.name)) {
      error(ErrorCode::unsupported, card, fmt::format("is not supported: {}", advice));
    } else {
      unknown(card);
    }
  }

  /// *STEP to *END STEP: loads and results.
  void step(const AbaqusCard& begin) {
    AbaqusKeyword keyword;
    while (lines_.next_keyword(keyword) && keyword.name != "ENDSTEP") {
      content_.clues.look_at(keyword);
      if (content_.only_nodes || !changes_part(keyword)) continue;
      AbaqusCard card(keyword, lines_, content_);
      error(ErrorCode::contradiction, card,
            fmt::format("is inside the *STEP of line {}, but the part must be complete before the "
                        "first step",
                        begin.at.line));
    }
  }

  /// Each keyword only once: there may be millions of them.
  void error(ErrorCode code, AbaqusCard& card, const std::string& text) {
    if (errors_.insert(card.name).second) card.error(code, text);
  }

  void note(AbaqusCard& card, std::string_view text) {
    if (noted_.insert(card.name).second) card.note("{} {}", card.shown, text);
  }

  void unknown(AbaqusCard& card) {
    if (errors_.contains(card.name) || noted_.contains(card.name)) return;
    if (content_.only_nodes && noted_.size() >= most_notes) return;
    const std::string near = nearly(card.name);
    if (!near.empty())
      error(ErrorCode::unknown_key, card, fmt::format("is not known, did you mean '*{}'?", near));
    else if (content_.only_nodes)
      note(card, "is not known and is ignored");
    else
      error(ErrorCode::unknown_key, card,
            "is not known and may change stiffness, mass or constraints: take it out of the deck "
            "if it does not");
  }

  static constexpr std::size_t most_notes = 500;  // the harmless ones are fewer
  AbaqusLines& lines_;
  AbaqusContent& content_;
  std::set<std::string> noted_, errors_;
};

}  // namespace

bool looks_like_abaqus(std::string_view beginning) {
  // The first line that is no comment is a keyword.
  while (!beginning.empty()) {
    const std::string_view line = trimmed(next_line(beginning));
    if (line.empty() || line.starts_with("**")) continue;
    return line.size() > 1 && line[0] == '*' &&
           ((line[1] >= 'A' && line[1] <= 'Z') || (line[1] >= 'a' && line[1] <= 'z') ||
            line[1] == ' ');
  }
  return false;
}

FeModel read_abaqus(TextSource& source, const FeReadOptions& options, DeckPart part) {
  AbaqusContent content;
  content.options = options;
  content.only_nodes = part == DeckPart::nodes;
  AbaqusLines lines(source);
  DeckReader(lines, content).read();
  finish_abaqus_assembly(content, source);
  finish_abaqus_constants(lines, content);
  if (content.nodes.size() == 0 && source.errors() == 0)
    source.error(ErrorCode::missing, {0, 0}, "the deck has no nodes");
  source.throw_if_any();
  const bool only_nodes = content.only_nodes;
  content.clues.settle();
  AbaqusBuild build(content, source);
  build.element_index.assign(content.elements.size(), -1);
  build.model.notes = content.notes;
  build_abaqus_nodes(build);
  if (!only_nodes) build_abaqus_elements(build);
  if (!only_nodes) as_in_home_program(build);
  if (!only_nodes) build_abaqus_nonstructural_mass(build);
  build_abaqus_sets(build, only_nodes);
  build_abaqus_constraints(build, only_nodes);
  if (!only_nodes && source.errors() == 0) build_abaqus_springs(build);
  source.throw_if_any();
  if (!only_nodes && options.mass_form == MassChoice::by_format)
    note_mass_of_unclear_dialect(build);
  build.model.files = source.files();
  return std::move(build.model);
}

FeModel read_abaqus(const std::filesystem::path& file, const FeReadOptions& options) {
  TextSource source(file);
  return read_abaqus(source, options);
}

}  // namespace floatframe
