// Formulas of motions do not jump while the model runs.
#include "floatframe/description/sentences.hpp"
#include "floatframe/formulas/formula_corners.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/validate_model.hpp"

namespace floatframe::validation {

void motions(const ModelDescription& d, ErrorList& errors) {
  const auto look = [&](const Entity& entity, const std::string& key, const TimeFunction& f) {
    if (!f.formula || !f.formula->is_of_time()) return;
    const auto jump =
        formula_corners(*f.formula, 0.0, d.simulation.duration, d.simulation.step).jump;
    if (jump)
      entity.error(ErrorCode::contradiction, key, sentences::formula_jumps(jump->size, jump->at));
  };
  for (const JointDescription& j : d.joints) {
    const Entity entity{errors, j.origin, "joints." + j.name};
    if (j.motion) look(entity, "motion", *j.motion);
    for (const CoordinateMotion& m : j.motions)
      if (m.coordinate >= 0 && m.coordinate < joint_velocities(j.type))
        look(entity, "motion." + joint_coordinate_key(j.type, m.coordinate), m.motion);
  }
  for (const ElementList list :
       {ElementList::rods, ElementList::constraints, ElementList::couplings})
    for (const ElementDescription& e : d.elements(list))
      for (const ElementKey& key : element_keys(e.type()))
        if (const auto value = key.kind == KeyKind::motion ? key_value(e, key) : std::nullopt)
          look({errors, e.origin, std::string(element_list_name(list)) + "." + e.name}, key.name,
               std::get<TimeFunction>(*value));
}

}  // namespace floatframe::validation
