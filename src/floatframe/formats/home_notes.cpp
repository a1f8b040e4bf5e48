#include "floatframe/formats/home_notes.hpp"

#include <fmt/format.h>

#include <array>
#include <map>

#include "floatframe/fe/lumped_mass.hpp"

namespace floatframe {
namespace {

struct Difference {
  HomeProgram program;
  ElementType type;
  const char* text;
};

constexpr const char* own_modes = "incompatible modes of our own";
constexpr const char* own_hourglass = "hourglass stiffness of our own";
constexpr const char* own_shells = "shells of our own";
constexpr const char* own_mid_shells = "made of flat triangles here: order two in the size";
constexpr const char* expanded = "expanded to bricks there";

using T = ElementType;
using H = HomeProgram;
constexpr std::array differences{
    Difference{H::abaqus, T::hex8, "the change of volume is taken at the centre there: softer"},
    Difference{H::abaqus, T::hex8i, own_modes},
    Difference{H::abaqus, T::hex8r, own_hourglass},
    Difference{H::abaqus, T::tri3, own_shells},
    Difference{H::abaqus, T::quad4, own_shells},
    Difference{H::abaqus, T::tri6, own_mid_shells},
    Difference{H::abaqus, T::quad8, own_mid_shells},
    Difference{H::abaqus, T::beam2, "stiffness as there, rotary inertia lumped in our own way"},
    Difference{H::abaqus, T::beam3, "shear area 5/6 of the section here"},
    Difference{H::calculix, T::hex8i, "the incompatible modes have mass there"},
    Difference{H::calculix, T::hex8r, own_hourglass},
    Difference{H::calculix, T::tri3, expanded},
    Difference{H::calculix, T::quad4, expanded},
    Difference{H::calculix, T::tri6, expanded},
    Difference{H::calculix, T::quad8, expanded},
    Difference{H::calculix, T::rod2, expanded},
    Difference{H::calculix, T::beam2, expanded},
    Difference{H::calculix, T::beam3, expanded},
    Difference{H::nastran, T::hex8i, own_modes},
    Difference{H::nastran, T::hex8, "reduced shear there unless all is integrated in full"},
    Difference{H::nastran, T::tri3, own_shells},
    Difference{H::nastran, T::quad4, own_shells},
    Difference{H::nastran, T::tri6, own_mid_shells},
    Difference{H::nastran, T::quad8, own_mid_shells},
    Difference{H::nastran, T::pyramid5, "shape functions of our own"},
    Difference{H::nastran, T::pyramid13, "shape functions of our own"},
    Difference{H::abaqus, T::pyramid5, "shape functions of our own"},
    Difference{H::ansys, T::hex8, "the change of volume is taken at the centre there: softer"},
    Difference{H::ansys, T::hex8i, own_modes},
    Difference{H::ansys, T::hex8r, own_hourglass},
    Difference{H::ansys, T::tet4, "SOLID285 has pressures at its nodes there"},
    Difference{H::ansys, T::wedge6, "shape functions of our own"},
    Difference{H::ansys, T::pyramid5, "shape functions of our own"},
    Difference{H::ansys, T::pyramid13, "shape functions of our own"},
    Difference{H::ansys, T::tri3, own_shells},
    Difference{H::ansys, T::quad4, own_shells},
    Difference{H::ansys, T::tri6, own_mid_shells},
    Difference{H::ansys, T::quad8, own_mid_shells},
    Difference{H::ansys, T::beam2,
               "exact for loads at its ends here, order two in the length there"},
    Difference{H::ansys, T::beam3, "shear area 5/6 of the section here"},
};

/// Elements of a type, and how many of them are lumped.
struct Counts {
  int all = 0, lumped = 0;
};

std::string mass_sentence(const FeModel& model, const std::map<ElementType, Counts>& counts) {
  int all = 0, lumped = 0;
  bool first_order = false;
  for (const auto& [type, n] : counts) {
    all += n.all;
    lumped += n.lumped;
    first_order = first_order || !quadratic(type);
  }
  const std::string share =
      lumped == all ? "of all elements" : fmt::format("of {} of {} elements", lumped, all);
  switch (model.home) {
    case HomeProgram::abaqus:
      return lumped > 0 ? fmt::format(
                              "the mass {} is lumped at their nodes, as Abaqus does with "
                              "those of first order",
                              share)
                        : std::string("all mass is consistent");
    case HomeProgram::nastran:
      return lumped > 0 ? fmt::format(
                              "the mass {} is lumped at their nodes, as in Nastran without "
                              "PARAM COUPMASS",
                              share)
                        : std::string("all mass is consistent, as in Nastran with PARAM COUPMASS");
    case HomeProgram::calculix:
      return lumped > 0 ? fmt::format("the mass {} is lumped, in CalculiX all is consistent", share)
                        : std::string(
                              "all mass is consistent, as in CalculiX, which integrates it "
                              "with fewer points (--integration ccx)");
    case HomeProgram::abaqus_or_calculix:
      if (lumped == 0 && !first_order) return "all mass is consistent, as in CalculiX and Abaqus";
      return lumped > 0 ? fmt::format("the mass {} is lumped", share)
                        : std::string(
                              "all mass is consistent, as in CalculiX; Abaqus lumps that of "
                              "elements of first order: --dialect abaqus or --mass-form lumped");
    case HomeProgram::ansys:
      return lumped > 0
                 ? fmt::format("the mass {} is lumped at their nodes, as LUMPM,ON asks", share)
                 : std::string("all mass is consistent, as in ANSYS without LUMPM,ON");
    case HomeProgram::unknown:
      break;
  }
  return {};
}

}  // namespace

std::string home_note(const FeModel& model) {
  if (model.home == HomeProgram::unknown || model.elements.empty()) return {};
  std::map<ElementType, Counts> counts;
  for (const Element& e : model.elements) {
    Counts& n = counts[e.type];
    ++n.all;
    n.lumped += e.mass_form != MassForm::consistent;
  }
  const HomeProgram program =
      model.home == HomeProgram::abaqus_or_calculix ? HomeProgram::calculix : model.home;
  const char* const name = program == HomeProgram::abaqus     ? "Abaqus"
                           : program == HomeProgram::calculix ? "CalculiX"
                           : program == HomeProgram::ansys    ? "ANSYS"
                                                              : "Nastran";
  std::string list;
  for (const Difference& d : differences) {
    const auto found = counts.find(d.type);
    if (d.program != program || found == counts.end()) continue;
    list += fmt::format("{}{} {} ({})", list.empty() ? "" : "; ", found->second.all,
                        element_type_name(d.type), d.text);
  }
  return fmt::format("frequencies here and in {}: {}; {}", name, mass_sentence(model, counts),
                     list.empty() ? "the elements are the same"
                                  : "these differ with the size of the elements: " + list);
}

}  // namespace floatframe
