// The order of the checks, and checks that belong to no entity.
#include "floatframe/model/validate_model.hpp"

#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"

namespace floatframe {

void validate(const ModelDescription& d, ErrorList& errors) {
  const std::size_t before = errors.size();
  const Origin none;
  const validation::Entity model{errors, none, ""};
  if (const auto complaint = sentences::model_name(d.name))
    model.error(ErrorCode::wrong_value, "name", "found '" + d.name + "', " + *complaint);
  model.vector("gravity", d.gravity, "m/s2");
  model.number("snap.angle", d.snap.angle, rules::snap_angle);
  model.number("snap.distance", d.snap.distance, rules::snap_distance);
  const validation::Names names{
      NameIndex(d.bodies),      NameIndex(d.joints),    NameIndex(d.forces),
      NameIndex(d.roads),       NameIndex(d.inputs),    NameIndex(d.rods),
      NameIndex(d.constraints), NameIndex(d.couplings), NameIndex(d.controllers)};
  validation::bodies(d, errors);
  validation::joints(d, names, errors);
  validation::roads(d, errors);
  validation::inputs(d, errors);
  validation::vehicle(d, names, errors);
  validation::elements(d, names, errors);
  validation::amplitudes(d, names, errors);
  validation::outputs(d, names, errors);
  validation::motions(d, errors);
  validate(d.simulation, errors);
  if (errors.size() == before) validation::vehicle_roles(d, errors);
}

}  // namespace floatframe
