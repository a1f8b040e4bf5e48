// What Nastran takes for granted: lumped mass unless PARAM COUPMASS is positive (masses at the
// nodes without rotary inertia, but of bars about their own axis).
#include <fmt/format.h>

#include "floatframe/decks/nastran/nastran_build.hpp"

namespace floatframe {

namespace {

/// Shells that are read as others.
void note_shells(NastranBuild& build) {
  struct Kind {
    std::string_view card;
    ElementType type;
    const char* text;
    bool bends = false;  // said of shells only
    int count = 0;
    FeSource at = {};
  };
  Kind kinds[] = {
      {"CTRIA6", ElementType::tri6, "CTRIA6 elements are four flat triangles each", true},
      {"CQUAD8", ElementType::quad8, "CQUAD8 elements are flat triangles between all their nodes",
       true},
      {"CTRIA6", ElementType::tri3, "CTRIA6 elements without mid-side nodes are read as CTRIA3"},
      {"CQUAD8", ElementType::quad4, "CQUAD8 elements without mid-side nodes are read as CQUAD4"},
      {"CTRIAR", ElementType::tri3, "CTRIAR elements are read as CTRIA3"},
      {"CQUADR", ElementType::quad4, "CQUADR elements are read as CQUAD4"}};
  const auto membrane = [&](const NastranElement& e) {
    const auto property = build.content.properties.find(e.property);
    return property != build.content.properties.end() && property->second.membrane;
  };
  for (const NastranElement& e : build.content.elements)
    for (Kind& k : kinds)
      if (e.surface && e.type == k.type && e.card == k.card && !(k.bends && membrane(e)) &&
          k.count++ == 0)
        k.at = e.at;
  for (const Kind& k : kinds)
    if (k.count > 0) build.note(k.at, fmt::format("{} {}", k.count, k.text));
}

}  // namespace

void nastran_mass_forms(NastranBuild& build) {
  if (build.content.properties.empty()) return;
  note_shells(build);
  if (build.content.coupled_mass) return;
  for (Element& e : build.model.elements) e.mass_form = MassForm::lumped_without_rotation;
}

}  // namespace floatframe
