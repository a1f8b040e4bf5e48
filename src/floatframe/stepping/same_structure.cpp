#include "floatframe/stepping/same_structure.hpp"

#include <fmt/format.h>

namespace floatframe {
namespace {

bool same_entity(const Body& a, const Body& b) {
  return a.modes() == b.modes() && a.stiffens() == b.stiffens();
}
bool same_entity(const Joint& a, const Joint& b) {
  return a.type == b.type && a.parent == b.parent && a.child == b.child && a.motion == b.motion &&
         a.motions == b.motions && a.cut == b.cut && a.automatic == b.automatic &&
         a.frame_F == b.frame_F && a.frame_M == b.frame_M;
}
bool same_signals(const Element& a, const Element& b) {
  if (a.signals.size() != b.signals.size()) return false;
  for (std::size_t k = 0; k < a.signals.size(); ++k) {
    const Signal &x = a.signals[k], &y = b.signals[k];
    if (x.input != y.input || x.link != y.link || x.given != y.given ||
        (x.local == nullptr) != (y.local == nullptr))
      return false;
  }
  return true;
}
bool same_entity(const Element& a, const Element& b) {
  return a.type == b.type && a.markers == b.markers && a.laws.size() == b.laws.size() &&
         same_signals(a, b) && a.coordinates.size() == b.coordinates.size() &&
         a.operands.size() == b.operands.size() && a.values == b.values && a.road == b.road &&
         a.states == b.states && a.kept == b.kept && a.acts == b.acts && a.holds == b.holds &&
         a.reads == b.reads && a.rotational == b.rotational;
}
bool same_entity(const Input&, const Input&) { return true; }
bool same_entity(const Road&, const Road&) { return true; }
bool same_entity(const Output& a, const Output& b) {
  return a.type == b.type && a.unit == b.unit && (a.formula == nullptr) == (b.formula == nullptr) &&
         (!a.formula || a.formula->operands.size() == b.formula->operands.size());
}

template <class Entity>
std::string difference(const char* word, const std::vector<Entity>& present,
                       const std::vector<Entity>& changed) {
  if (present.size() != changed.size())
    return fmt::format("has {} of the kind '{}', expected {}", changed.size(), word,
                       present.size());
  for (std::size_t k = 0; k < present.size(); ++k) {
    if (present[k].name != changed[k].name)
      return fmt::format("has the {} '{}', expected '{}'", word, changed[k].name, present[k].name);
    if (!same_entity(present[k], changed[k]))
      return fmt::format("has another kind of {} '{}', expected one with other numbers only", word,
                         changed[k].name);
  }
  return {};
}

bool same_markers(const Model& a, const Model& b) {
  if (a.markers.size() != b.markers.size()) return false;
  for (std::size_t k = 0; k < a.markers.size(); ++k)
    if (a.markers[k].body != b.markers[k].body || a.markers[k].node != b.markers[k].node)
      return false;
  return true;
}

}  // namespace

std::string structure_complaint(const Model& present, const Model& changed) {
  for (std::string text : {difference("body", present.bodies, changed.bodies),
                           difference("joint", present.joints, changed.joints),
                           difference("element", present.elements, changed.elements),
                           difference("road", present.roads, changed.roads),
                           difference("input", present.inputs, changed.inputs),
                           difference("output", present.outputs, changed.outputs),
                           difference("measure", present.measures, changed.measures)})
    if (!text.empty()) return text;
  if (!same_markers(present, changed) || present.links.size() != changed.links.size() ||
      present.gauges.size() != changed.gauges.size() ||
      present.until.has_value() != changed.until.has_value())
    return "connects its bodies and elements in another way, expected other numbers only";
  return {};
}

std::string option_complaint(const SimulationDescription& present,
                             const SimulationDescription& changed) {
  struct Option {
    const char* name;
    bool same;
  };
  const SimulationDescription &a = present, &b = changed;
  for (const Option& x : std::initializer_list<Option>{
           {"coordinates", a.coordinates == b.coordinates},
           {"inertia", a.inertia == b.inertia},
           {"step", a.step == b.step},
           {"spectral_radius", a.spectral_radius == b.spectral_radius},
           {"tolerance", a.tolerance == b.tolerance},
           {"max_iterations", a.max_iterations == b.max_iterations},
           {"min_step", a.min_step == b.min_step},
           {"penalty", a.penalty == b.penalty},
           {"position_tolerance", a.position_tolerance == b.position_tolerance},
           {"velocity_tolerance", a.velocity_tolerance == b.velocity_tolerance},
           {"locate_edges", a.locate_edges == b.locate_edges},
           {"input", a.input == b.input}})
    if (!x.same)
      return fmt::format("has another option '{}', expected the same: it holds for a whole run",
                         x.name);
  return {};
}

}  // namespace floatframe
