// Which formulas of actuators are parts of the laws of their elements (local_formula.hpp).
#include <algorithm>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/local_formula.hpp"
#include "floatframe/model/model_builder.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

/// The output that a reference to an element or joint is, of those that a local formula may read:
/// of a measure its kind and entity, else what the reference says.
std::optional<std::pair<std::string, std::string>> ModelBuilder::measured_by(
    const FormulaReference& r) const {
  if (!r.function.empty()) {
    const bool first = r.detail.empty() || r.detail == "1";
    return first ? std::optional(std::pair(r.function, r.name)) : std::nullopt;
  }
  for (const OutputDescription& o : d.measures)
    if (o.name == r.name && o.component <= 0)
      return std::pair(std::string(output_words[index_of(o.type)]), o.entity);
  return std::nullopt;
}

SharedFormula ModelBuilder::as_local(const ElementDescription& e, const ElementKey& key,
                                     const Formula& f) const {
  const bool mirrored = !Placement{f.mirror.P.asDiagonal(), f.mirror.t}.identity();
  if (!element_kind(e.type()).local_actuator || key.kind != KeyKind::load || mirrored)
    return nullptr;
  bool edges = false;  // of laws, whose branches leave no room for those of the formula
  std::string joint;
  const ElementView view(e);
  for (const ElementKey& k : element_keys(e.type())) {
    if (k.kind == KeyKind::joint) joint = view.text(k.name);
    if (k.kind == KeyKind::spring || k.kind == KeyKind::damper)
      edges = edges || !view.law(k.name).edges().empty();
  }
  if (edges && f.switches > 0) return nullptr;
  Formula local = f;
  for (FormulaReference& r : local.references) {
    if (r.is_time() || (r.function.empty() && input_names.find(r.name))) continue;
    const auto measured = measured_by(r);
    if (!measured || r.delayed) return nullptr;
    const auto& [word, entity] = *measured;
    const bool of_joint = !joint.empty() && entity == joint, of_element = entity == e.name;
    const bool both = joint_names.find(entity) && std::ranges::any_of(d.forces, [&](const auto& x) {
                        return x.name == measured->second;
                      });
    if (of_joint && (word == "angle" || word == "joint_position"))
      r = {own_measure, "", ""};
    else if (of_joint && (word == "joint_velocity" || (word == "rate" && !both)))
      r = {own_rate, "", ""};
    else if (of_element && word == "length" && r.detail.empty())
      r = {own_measure, "", ""};
    else if (of_element && word == "rate" && !both && r.detail.empty())
      r = {own_rate, "", ""};
    else
      return nullptr;
  }
  return std::make_shared<const Formula>(std::move(local));
}

}  // namespace floatframe
