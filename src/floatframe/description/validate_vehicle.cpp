// The section `vehicle`.
#include <set>

#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/description/validate.hpp"

namespace floatframe::validation {

namespace {

void vehicle_wheel(const VehicleWheel& w, const std::string& side, const Names& names,
                   std::set<std::string>& tyres, const Entity& axle) {
  axle.reference(side + ".wheel", "body", w.wheel, names.bodies);
  if (axle.reference(side + ".tyre", "force", w.tyre, names.forces) && !tyres.insert(w.tyre).second)
    axle.error(ErrorCode::duplicate, side + ".tyre", sentences::tyre_of_two_wheels(w.tyre));
  if (!w.spin.empty()) axle.reference(side + ".spin", "joint", w.spin, names.joints);
}

void vehicle_input(const std::optional<VehicleInput>& i, const char* key, const Names& names,
                   ErrorList& errors) {
  if (!i) return;
  const Entity entity{errors, i->origin, std::string("vehicle.") + key};
  entity.reference("input", "input", i->input, names.inputs);
  if (entity.number("ratio", i->ratio, any_number("")) && i->ratio == 0.0)
    entity.error(ErrorCode::out_of_range, "ratio", sentences::ratio_of_zero());
}

}  // namespace

void vehicle(const ModelDescription& d, const Names& names, ErrorList& errors) {
  if (!d.vehicle) return;
  const VehicleDescription& v = *d.vehicle;
  const Entity entity{errors, v.origin, "vehicle"};
  entity.reference("chassis", "body", v.chassis, names.bodies);
  if (v.driver) entity.vector("driver", *v.driver, "m");
  if (v.axles.empty()) entity.error(ErrorCode::missing, "axles", sentences::no_axle());
  std::set<std::string> taken, tyres;
  for (const VehicleAxle& a : v.axles) {
    const Entity axle{errors, a.origin, "vehicle.axles." + a.name};
    name("vehicle.axles", a.name, taken, axle);
    vehicle_wheel(a.left, "left", names, tyres, axle);
    vehicle_wheel(a.right, "right", names, tyres, axle);
  }
  vehicle_input(v.steering, "steering", names, errors);
  vehicle_input(v.drive, "drive", names, errors);
  vehicle_input(v.brake, "brake", names, errors);
  entity.number("width", v.width, non_negative_number("m"));
  entity.number("front", v.front, non_negative_number("m"));
  entity.number("rear", v.rear, non_negative_number("m"));
}

}  // namespace floatframe::validation
