// *NODAL THICKNESS: of the shells and membranes whose section has the parameter NODAL THICKNESS, as
// in Abaqus and CalculiX; the thickness of their sections does not count then. Each has the mean of
// its corners.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {

void read_abaqus_nodal_thickness(AbaqusCard& card) {
  if (!card.needs_line()) return;
  do {
    AbaqusNodalValue t{{card.reference(0)}};
    if (card.fields.size() < 2) {
      card.error_in_line(ErrorCode::missing, "*NODAL THICKNESS of {} has no thickness",
                         card.content.text(t.where, "node"));
      continue;
    }
    t.value = card.positive(1, "thickness at nodes");
    card.content.thicknesses.push_back(t);
  } while (card.next());
}

AbaqusNodalThickness::AbaqusNodalThickness(AbaqusBuild& build) : b_(build) {
  const AbaqusContent& c = build.content;
  if (c.thicknesses.empty()) return;
  at_node_.assign(c.nodes.size(), 0.0);
  // Given twice, the later one counts.
  for (const AbaqusNodalValue& t : c.thicknesses)
    for (const int node : build.nodes.resolve(t.where)) at_node_[node] = t.value;
}

void AbaqusNodalThickness::apply(const AbaqusSection& section, Element& e) {
  if (!section.nodal_thickness) return;
  used_ = true;
  const int nodes = element_kernel(e.type).nodes;
  const int corners = nodes % 3 == 0 ? 3 : 4;
  double sum = 0.0, least = HUGE_VAL, most = 0.0;
  for (int k = 0; k < nodes; ++k) {
    const double t = at_node_.empty() ? 0.0 : at_node_[e.nodes[k]];
    if (!(t > 0.0) && k < corners) return missing(section, e, e.nodes[k]);
    if (!(t > 0.0)) continue;
    if (k < corners) sum += t;
    least = std::min(least, t);
    most = std::max(most, t);
  }
  double mean = sum / corners;
  if (most - least > 1e-6 * mean) {
    if (uneven_++ == 0) first_uneven_ = e.source;
    unevenness_ = std::max(unevenness_, (most - least) / mean);
  } else if (std::isfinite(mean)) {
    mean = most;
  }
  std::vector<ShellSection>& shells = b_.model.shells;
  const bool first = given_.insert(e.section).second;
  const auto [it, fresh] =
      sections_.try_emplace({e.section, mean}, static_cast<int>(shells.size()));
  if (fresh && first) it->second = e.section;  // it has no thickness of its own
  if (fresh && !first) shells.push_back(shells[e.section]);
  if (fresh) {
    ShellSection& shell = shells[it->second];
    shell.thickness = mean;
    shell.shear = 5.0 / 6.0 * mean;
    shell.offset = -section.offset * mean;
    check_abaqus_sheet(b_, section, shell, e.material);
  }
  e.section = it->second;
}

void AbaqusNodalThickness::missing(const AbaqusSection& section, const Element& e, int node) {
  if (missing_++ > 0) return;
  b_.error(section, ErrorCode::missing,
           " has NODAL THICKNESS, but node {} of element {} has none (*NODAL THICKNESS)",
           b_.model.node_ids[node], e.id);
}

void AbaqusNodalThickness::notes() {
  const AbaqusContent& c = b_.content;
  if (!used_ && !c.thicknesses.empty())
    b_.note(c.thicknesses.front().where.at,
            "*NODAL THICKNESS has no effect, as in Abaqus and CalculiX: no section has the "
            "parameter NODAL THICKNESS");
  if (uneven_ > 0)
    b_.note(first_uneven_,
            "{} shells have nodes of different thickness, by {:.1f} % "
            "at most: each has the mean of its corners",
            uneven_, 100.0 * unevenness_);
}

}  // namespace floatframe
