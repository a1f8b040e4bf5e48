#include "floatframe/decks/abaqus/read_abaqus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <unordered_map>

#include "floatframe/core/suggest.hpp"
#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
#include "floatframe/decks/abaqus/abaqus_keywords.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

void skip(AbaqusLines& lines, const AbaqusKeyword&, AbaqusContent&) { lines.skip_data(); }

/// The mesh is one piece there; its preload belongs to a step.
void read_abaqus_pre_tension(AbaqusLines& lines, const AbaqusKeyword& keyword,
                             AbaqusContent& content) {
  content.note(
      lines.source().mark(keyword.at),
      fmt::format("{} is ignored: the bolt is whole and without its preload", keyword.shown));
  if (keyword.has("SURFACE") && !content.only_nodes)
    content.pre_tensions.push_back({content.named(keyword.value("SURFACE"), keyword.at)});
  lines.skip_data();
}

struct Known {
  const char* name;
  AbaqusHandler read;
};

constexpr std::array handlers{
    Known{"HEADING", skip},
    Known{"NODE", read_abaqus_nodes},
    Known{"SYSTEM", read_abaqus_system},
    Known{"ELEMENT", read_abaqus_elements},
    Known{"NGEN", read_abaqus_generated_nodes},
    Known{"NFILL", read_abaqus_filled_nodes},
    Known{"NCOPY", read_abaqus_copied_nodes},
    Known{"ELGEN", read_abaqus_generated_elements},
    Known{"ELCOPY", read_abaqus_copied_elements},
    Known{"NSET", read_abaqus_node_set},
    Known{"ELSET", read_abaqus_element_set},
    Known{"SURFACE", read_abaqus_surface},
    Known{"PART", read_abaqus_part},
    Known{"END PART", read_abaqus_end_part},
    Known{"ASSEMBLY", read_abaqus_assembly},
    Known{"END ASSEMBLY", read_abaqus_end_assembly},
    Known{"INSTANCE", read_abaqus_instance},
    Known{"END INSTANCE", read_abaqus_end_instance},
    Known{"MATERIAL", read_abaqus_material},
    Known{"ELASTIC", read_abaqus_elastic},
    Known{"DENSITY", read_abaqus_density},
    Known{"INITIAL CONDITIONS", read_abaqus_initial_conditions},
    Known{"ORIENTATION", read_abaqus_orientation},
    Known{"SOLID SECTION", read_abaqus_solid_section},
    Known{"SHELL SECTION", read_abaqus_shell_section},
    Known{"SHELL GENERAL SECTION", read_abaqus_shell_section},
    Known{"MEMBRANE SECTION", read_abaqus_membrane_section},
    Known{"NODAL THICKNESS", read_abaqus_nodal_thickness},
    Known{"BEAM SECTION", read_abaqus_beam_section},
    Known{"BEAM GENERAL SECTION", read_abaqus_beam_section},
    Known{"BEAM SECTION OFFSET", read_abaqus_beam_section_offset},
    Known{"CENTROID", read_abaqus_centroid},
    Known{"SHEAR CENTER", read_abaqus_shear_center},
    Known{"SURFACE SECTION", read_abaqus_surface_section},
    Known{"MASS", read_abaqus_mass},
    Known{"NONSTRUCTURAL MASS", read_abaqus_nonstructural_mass},
    Known{"ROTARY INERTIA", read_abaqus_rotary_inertia},
    Known{"RIGID BODY", read_abaqus_rigid_body},
    Known{"COUPLING", read_abaqus_coupling},
    Known{"KINEMATIC COUPLING", read_abaqus_kinematic_coupling},
    Known{"DISTRIBUTING COUPLING", read_abaqus_distributing_coupling},
    Known{"EQUATION", read_abaqus_equation},
    Known{"BOUNDARY", read_abaqus_boundary},
    Known{"TIE", read_abaqus_tie},
    Known{"CONTACT PAIR", read_abaqus_contact_pair},
    Known{"CONTACT", read_abaqus_general_contact},
    Known{"MPC", read_abaqus_mpc},
    Known{"PRE-TENSION SECTION", read_abaqus_pre_tension},
    Known{"SPRING", read_abaqus_spring},
    Known{"GAP", read_abaqus_gap},
    Known{"TRANSFORM", read_abaqus_transform},
};

/// A keyword that is one or two letters away from one that is read.
std::string nearly(const std::string& name) {
  if (name.size() > 40) return {};
  for (const Known& k : handlers) {
    const std::string known = abaqus_name(k.name);
    const std::size_t letters = known.size();
    if (letters >= 4 && edit_distance(name, known) <= (letters >= 8 ? 2 : 1)) return k.name;
  }
  return {};
}

AbaqusHandler handler_of(const std::string& name) {
  static const std::unordered_map<std::string, AbaqusHandler> map = [] {
    std::unordered_map<std::string, AbaqusHandler> all;
    for (const Known& k : handlers) all.emplace(abaqus_name(k.name), k.read);
    return all;
  }();
  const auto it = map.find(name);
  return it == map.end() ? nullptr : it->second;
}

/// The keywords of a deck in turn.
class DeckReader {
 public:
  DeckReader(AbaqusLines& lines, AbaqusContent& content) : lines_(lines), content_(content) {}

  void read() {
    std::string_view first;
    if (lines_.next_data(first)) {
      lines_.source().stop(ErrorCode::wrong_value, lines_.source().here(),
                           "the deck begins with {}, expected a keyword line (*...)", shown(first));
    }
    AbaqusKeyword keyword;
    while (lines_.next_keyword(keyword)) one(keyword);
  }

 private:
  void one(const AbaqusKeyword& keyword) {
    content_.clues.look_at(keyword);
    if (const AbaqusHandler handler = handler_of(keyword.name); handler != nullptr) {
      return handler(lines_, keyword, content_);
    }
    if (keyword.name == "STEP") {
      close_abaqus_blocks(content_, lines_.source(), "before *STEP");
      note(keyword, "and what follows up to *END STEP is ignored");
      return step(keyword);
    }
    using Use = AbaqusKeywordRule::Use;
    const AbaqusKeywordRule rule = abaqus_keyword_rule(keyword.name);
    if (rule.use == Use::harmless) {
      note(keyword, "is ignored");
    } else if (rule.use == Use::refused) {
      error(ErrorCode::unsupported, keyword, fmt::format("is not supported: {}", rule.advice));
    } else {
      unknown(keyword);
    }
    lines_.skip_data();
  }

  /// *STEP to *END STEP: loads and results.
  void step(const AbaqusKeyword& begin) {
    AbaqusKeyword keyword;
    while (lines_.next_keyword(keyword) && keyword.name != "ENDSTEP") {
      content_.clues.look_at(keyword);
      // Elements that go change the part; contact pairs and equations that go do not.
      const bool removes = keyword.name == "MODELCHANGE" &&
                           abaqus_name(keyword.value("TYPE")) != "CONTACTPAIR" &&
                           !keyword.has("ACTIVATE");
      const bool changes =
          changes_part_in_step(keyword.name) && !keyword.has("REMOVE") && !keyword.has("REMOVEALL");
      if (content_.only_nodes || (!removes && !changes)) continue;
      error(
          ErrorCode::contradiction, keyword,
          fmt::format(
              "is inside the *STEP of line {}, but the part must be complete before the first step",
              begin.at.line));
    }
  }

  /// Each keyword once: there may be millions of them.
  void error(ErrorCode code, const AbaqusKeyword& keyword, const std::string& text) {
    if (errors_.insert(keyword.name).second) lines_.error(code, keyword, text);
  }

  void unknown(const AbaqusKeyword& keyword) {
    if (errors_.contains(keyword.name) || noted_.contains(keyword.name)) return;
    if (content_.only_nodes && noted_.size() >= most_notes) return;
    const std::string near = nearly(keyword.name);
    if (!near.empty()) {
      error(ErrorCode::unknown_key, keyword,
            fmt::format("is not known, did you mean '*{}'?", near));
    } else if (content_.only_nodes) {
      note(keyword, "is not known and is ignored");
    } else {
      error(ErrorCode::unknown_key, keyword,
            "is not known and may change stiffness, mass or constraints: take it out of the deck "
            "if it does not");
    }
  }

  void note(const AbaqusKeyword& keyword, std::string_view text) {
    if (!noted_.insert(keyword.name).second) return;
    const SourceMark m = lines_.source().mark(keyword.at);
    content_.notes.push_back(fmt::format("{}:{}: {} {}", m.file, m.line, keyword.shown, text));
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
    const std::size_t end = beginning.find('\n');
    const std::string_view line = trimmed(beginning.substr(0, end));
    beginning.remove_prefix(end == std::string_view::npos ? beginning.size() : end + 1);
    if (line.empty() || line.starts_with("**")) continue;
    return line.size() > 1 && line[0] == '*' &&
           ((line[1] >= 'A' && line[1] <= 'Z') || (line[1] >= 'a' && line[1] <= 'z') ||
            line[1] == ' ');
  }
  return false;
}

FeModel read_abaqus(TextSource& source, const FeReadOptions& options, DeckPart part) {
  AbaqusContent content;
  content.dialect = options.dialect;
  content.only_nodes = part == DeckPart::nodes;
  content.temperature = options.temperature;
  content.contact = options.contact;
  content.contact_distance = options.contact_distance;
  AbaqusLines lines(source);
  DeckReader(lines, content).read();
  finish_abaqus_assembly(content, source);
  finish_abaqus_constants(lines, content);
  if (content.nodes.empty() && source.errors() == 0) {
    source.error(ErrorCode::missing, {0, 0}, "the deck has no nodes");
  }
  source.throw_if_any();
  const bool only_nodes = content.only_nodes;
  content.clues.settle();
  AbaqusBuild build(content, source);
  build.element_index.assign(content.elements.size(), -1);
  build.model.notes = content.notes;
  build_abaqus_nodes(build);
  if (!only_nodes) build_abaqus_elements(build, options);
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
