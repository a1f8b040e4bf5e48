#include "floatframe/formats/read_abaqus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>

#include "floatframe/core/suggest.hpp"
#include "floatframe/formats/abaqus_build.hpp"
#include "floatframe/formats/abaqus_content.hpp"
#include "floatframe/formats/text_fields.hpp"

namespace floatframe {
namespace {

void skip(AbaqusLines& lines, const AbaqusKeyword&, AbaqusContent&) { lines.skip_data(); }

struct Known {
  const char* name;
  AbaqusHandler read;
};

constexpr std::array handlers{
    Known{"HEADING", skip},
    Known{"NODE", read_abaqus_nodes},
    Known{"ELEMENT", read_abaqus_elements},
    Known{"NSET", read_abaqus_node_set},
    Known{"ELSET", read_abaqus_element_set},
    Known{"SURFACE", read_abaqus_surface},
    Known{"PART", read_abaqus_part},
    Known{"END PART", read_abaqus_end_part},
    Known{"ASSEMBLY", read_abaqus_assembly},
    Known{"END ASSEMBLY", read_abaqus_assembly},
    Known{"INSTANCE", read_abaqus_instance},
    Known{"END INSTANCE", read_abaqus_end_instance},
    Known{"MATERIAL", read_abaqus_material},
    Known{"ELASTIC", read_abaqus_elastic},
    Known{"DENSITY", read_abaqus_density},
    Known{"SOLID SECTION", read_abaqus_solid_section},
    Known{"SHELL SECTION", read_abaqus_shell_section},
    Known{"BEAM SECTION", read_abaqus_beam_section},
    Known{"MASS", read_abaqus_mass},
    Known{"ROTARY INERTIA", read_abaqus_rotary_inertia},
    Known{"RIGID BODY", read_abaqus_rigid_body},
    Known{"COUPLING", read_abaqus_coupling},
    Known{"KINEMATIC COUPLING", read_abaqus_kinematic_coupling},
    Known{"DISTRIBUTING COUPLING", read_abaqus_distributing_coupling},
    Known{"EQUATION", read_abaqus_equation},
    Known{"BOUNDARY", read_abaqus_boundary},
};

/// Keywords that change stiffness, mass or the mesh, with what to do instead.
struct Refused {
  const char* name;
  const char* advice;
};

constexpr const char* mesh_advice = "write the deck with all nodes and elements";
constexpr const char* spring_advice =
    "put springs, dampers and connectors into the multibody model";
constexpr const char* contact_advice = "contact has no place in a linear part";
constexpr const char* axes_advice = "write the deck in global directions";
constexpr const char* material_advice = "only isotropic linear elasticity is read";
constexpr const char* tie_advice = "join the nodes in the mesher or use *RIGID BODY or *COUPLING";

constexpr std::array refused{
    Refused{"TIE", tie_advice},
    Refused{"MPC", "use *RIGID BODY, *COUPLING or *EQUATION"},
    Refused{"EMBEDDEDELEMENT", tie_advice},
    Refused{"SHELLTOSOLIDCOUPLING", tie_advice},
    Refused{"FASTENER", tie_advice},
    Refused{"SPRING", spring_advice},
    Refused{"DASHPOT", spring_advice},
    Refused{"JOINT", spring_advice},
    Refused{"CONNECTORSECTION", spring_advice},
    Refused{"CONNECTORBEHAVIOR", spring_advice},
    Refused{"GAP", spring_advice},
    Refused{"BUSHING", spring_advice},
    Refused{"CONTACT", contact_advice},
    Refused{"CONTACTPAIR", contact_advice},
    Refused{"CLEARANCE", contact_advice},
    Refused{"PRETENSIONSECTION", contact_advice},
    Refused{"ORIENTATION", axes_advice},
    Refused{"TRANSFORM", axes_advice},
    Refused{"SYSTEM", axes_advice},
    Refused{"NORMAL", axes_advice},
    Refused{"NGEN", mesh_advice},
    Refused{"NFILL", mesh_advice},
    Refused{"NCOPY", mesh_advice},
    Refused{"NMAP", mesh_advice},
    Refused{"ELGEN", mesh_advice},
    Refused{"ELCOPY", mesh_advice},
    Refused{"SYMMETRICMODELGENERATION", mesh_advice},
    Refused{"IMPERFECTION", mesh_advice},
    Refused{"PARAMETER", "write the deck with numbers"},
    Refused{"IMPORT", mesh_advice},
    Refused{"MODELCHANGE", mesh_advice},
    Refused{"HYPERELASTIC", material_advice},
    Refused{"HYPERFOAM", material_advice},
    Refused{"USERMATERIAL", material_advice},
    Refused{"VISCOELASTIC", material_advice},
    Refused{"LAMINATE", material_advice},
    Refused{"NODALTHICKNESS", "give the thickness in *SHELL SECTION"},
    Refused{"SHELLGENERALSECTION", "use *SHELL SECTION"},
    Refused{"BEAMGENERALSECTION", "use *BEAM SECTION"},
    Refused{"MEMBRANESECTION", "use *SHELL SECTION"},
    Refused{"FRAMESECTION", "use *BEAM SECTION"},
    Refused{"COHESIVESECTION", tie_advice},
    Refused{"GASKETSECTION", tie_advice},
    Refused{"NONSTRUCTURALMASS", "use *MASS"},
    Refused{"BEAMADDEDINERTIA", "use *MASS and *ROTARY INERTIA"},
    Refused{"MASSADJUST", "use *MASS"},
    Refused{"MATRIXINPUT", "give the matrix files instead of the deck"},
    Refused{"MATRIXASSEMBLE", "give the matrix files instead of the deck"},
    Refused{"USERELEMENT", "give the matrices of the part as files"},
    Refused{"UELPROPERTY", "give the matrices of the part as files"},
    Refused{"SUBSTRUCTUREPROPERTY", "give the matrices of the part as files"},
    Refused{"CYCLICSYMMETRYMODEL", mesh_advice},
    Refused{"PINNEDREBAR", mesh_advice},
    Refused{"REBARLAYER", "use elements of their own"},
    Refused{"RELEASE", spring_advice},
    Refused{"KINEMATIC", "it belongs behind *COUPLING"},
    Refused{"DISTRIBUTING", "it belongs behind *COUPLING"},
};

/// Known to change neither stiffness nor mass of a linear part.
constexpr std::array harmless{
    "AMPLITUDE",
    "PREPRINT",
    "RESTART",
    "EXPANSION",
    "CONDUCTIVITY",
    "SPECIFICHEAT",
    "PLASTIC",
    "CYCLICHARDENING",
    "CREEP",
    "DAMPING",
    "INITIALCONDITIONS",
    "TIMEPOINTS",
    "FILTER",
    "PHYSICALCONSTANTS",
    "SURFACEINTERACTION",
    "SURFACEBEHAVIOR",
    "FRICTION",
    "SECTIONCONTROLS",
    "DEPVAR",
    "CONTACTINITIALIZATIONDATA",
    "VALUESATINFINITY",
    "TRANSVERSESHEARSTIFFNESS",
    "DAMAGEINITIATION",
    "DAMAGEEVOLUTION",
    "USERDEFINEDFIELD",
    "DISTRIBUTION",
    "DISTRIBUTIONTABLE",
};

template <typename List>
auto find_named(const List& list, const std::string& name) {
  return std::find_if(list.begin(), list.end(),
                      [&](const auto& k) { return name == abaqus_name(k.name); });
}

/// A keyword that is one or two letters away from one that is read.
std::string nearly(const std::string& name) {
  for (const Known& k : handlers) {
    const std::string known = abaqus_name(k.name);
    const std::size_t letters = known.size();
    if (letters >= 4 && edit_distance(name, known) <= (letters >= 8 ? 2 : 1)) return k.name;
  }
  return {};
}

/// *STEP to *END STEP: loads and results.
void skip_step(AbaqusLines& lines) {
  AbaqusKeyword keyword;
  while (lines.next_keyword(keyword) && keyword.name != "ENDSTEP") {
  }
}

void read_content(AbaqusLines& lines, AbaqusContent& content) {
  std::set<std::string> noted;
  const auto note = [&](const AbaqusKeyword& keyword, std::string_view text) {
    if (!noted.insert(keyword.name).second) return;
    const SourceMark m = lines.source().mark(keyword.at);
    content.notes.push_back(fmt::format("{}:{}: {} {}", m.file, m.line, keyword.shown, text));
  };
  std::string_view first;
  if (lines.next_data(first)) {
    lines.source().stop(
        lines.source().here(),
        fmt::format("the deck begins with {}, expected a keyword line (*...)", shown(first)));
  }
  AbaqusKeyword keyword;
  while (lines.next_keyword(keyword)) {
    if (const auto it = find_named(handlers, keyword.name); it != handlers.end()) {
      it->read(lines, keyword, content);
    } else if (const auto bad = find_named(refused, keyword.name); bad != refused.end()) {
      lines.fault(keyword, fmt::format("is not supported: {}", bad->advice));
      lines.skip_data();
    } else if (keyword.name == "STEP") {
      note(keyword, "and what follows up to *END STEP is passed over");
      skip_step(lines);
    } else if (std::find(harmless.begin(), harmless.end(), keyword.name) != harmless.end()) {
      note(keyword, "is passed over");
      lines.skip_data();
    } else {
      const std::string near = nearly(keyword.name);
      if (!near.empty()) {
        lines.fault(keyword, fmt::format("is not known, did you mean '*{}'?", near));
      } else {
        note(keyword, "is not known and is passed over");
      }
      lines.skip_data();
    }
  }
}

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
  AbaqusLines lines(source);
  read_content(lines, content);
  if (content.nodes.empty() && source.faults() == 0) {
    source.fault({0, 0}, "the deck has no nodes");
  }
  source.throw_if_any();
  const bool only_nodes = part == DeckPart::nodes;
  AbaqusBuild build(content, source);
  build.element_index.assign(content.elements.size(), -1);
  build.model.notes = content.notes;
  build_abaqus_nodes(build);
  if (!only_nodes) build_abaqus_elements(build, options);
  build_abaqus_sets(build, only_nodes);
  build_abaqus_constraints(build, only_nodes);
  source.throw_if_any();
  build.model.files = source.files();
  return std::move(build.model);
}

FeModel read_abaqus(const std::filesystem::path& file, const FeReadOptions& options) {
  TextSource source(file);
  return read_abaqus(source, options);
}

}  // namespace floatframe
