#include "floatframe/vehicle/vehicle_setup.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "floatframe/model/validate_model.hpp"
#include "floatframe/vehicle/flat_road.hpp"
#include "floatframe/vehicle/vehicle_parts.hpp"

namespace floatframe {
namespace {

/// One input cannot do two things.
void require_own_inputs(const VehicleDescription& v, ErrorList& errors) {
  const std::pair<const char*, const std::optional<VehicleInput>*> roles[] = {
      {"steering", &v.steering}, {"drive", &v.drive}, {"brake", &v.brake}};
  for (const auto& [key, input] : roles)
    for (const auto& [other, first] : roles) {
      if (first == input) break;
      if (!*input || !*first || (*input)->input != (*first)->input) continue;
      const std::string path = std::string("vehicle.") + key;
      errors.add({(*input)->origin.mark, ErrorCode::duplicate,
                  path + ": found the input '" + (*input)->input + "', which is that of vehicle." +
                      other + " already, expected another",
                  1, path});
    }
}

void require_roles(const ModelDescription& d, const std::string& manoeuvre,
                   const VehicleNeeds& needs) {
  if (!d.vehicle)
    throw InputError(ErrorCode::missing, SourceMark{.file = d.simulation.origin.mark.file},
                     manoeuvre +
                         ": found no section 'vehicle', expected one with the roles of "
                         "bodies, tyres and inputs");
  const VehicleDescription& v = *d.vehicle;
  ErrorList errors;
  const auto lacks = [&](const std::string& what) {
    errors.add({v.origin.mark, ErrorCode::missing,
                "vehicle: found no '" + what + "', expected it for " + manoeuvre, 1, "vehicle"});
  };
  if (needs.steering && !v.steering) lacks("steering");
  if (needs.drive && !v.drive) lacks("drive");
  if (needs.brake && !v.brake) lacks("brake");
  if (needs.width && v.width == 0.0) lacks("width");
  require_own_inputs(v, errors);
  if (v.axles.size() < 2)
    errors.add({v.origin.of("axles"), ErrorCode::wrong_count,
                "vehicle.axles: found one axle, expected two or more for " + manoeuvre, 1,
                "vehicle.axles"});
  if (d.simulation.start == Start::state)
    errors.add({d.simulation.origin.of("start"), ErrorCode::exclusive,
                "simulation.start: found a state, expected given or equilibrium for " + manoeuvre,
                1, "simulation.start"});
  errors.throw_if_any();
  validate(d, errors);
  errors.throw_if_any();
}

void add_measured(ModelDescription& d, const Vec3& driver) {
  const auto add = [&](int which, const char* type, int component, bool point) {
    OutputDescription o = output_of_type(measured_names[which], type);
    o.component = component;
    o.at.body = d.vehicle->chassis;
    if (point) o.at.point = driver;
    d.outputs.push_back(std::move(o));
  };
  for (int k = 0; k < 3; ++k) {
    add(int(Measured::x) + k, "position", k, true);
    add(int(Measured::vx) + k, "velocity", k, true);
    add(int(Measured::ax) + k, "acceleration", k, true);
    add(int(Measured::roll) + k, "rotation", k, false);
  }
  add(int(Measured::yaw_rate), "angular_velocity", 2, false);
}

void add_load(ModelDescription& d, const std::string& wheel, const std::string& tyre) {
  OutputDescription o = output_of_type("vehicle." + wheel + ".load", "force");
  o.entity = tyre;
  d.outputs.push_back(std::move(o));
}

/// A wheel rolls at v/R; about an axis that points to the right the other way round.
void spin_up(ModelDescription& d, const VehicleWheel& wheel, double rate) {
  JointDescription* joint = spin_joint(d, wheel);
  if (joint == nullptr) return;
  const double along = joint->axis.y() * (spins_as_parent(d, *joint, wheel) ? -1.0 : 1.0);
  joint->velocity = {rate * (along < 0.0 ? -1.0 : 1.0)};
}

}  // namespace

Vec3 design_centre(const BodyDescription& body) {
  const auto* rigid = std::get_if<RigidDescription>(&body.kind);
  return body.X_WB.p + (rigid ? Vec3(body.X_WB.R * rigid->p_BC) : Vec3(Vec3::Zero()));
}

VehicleSetup vehicle_setup(ModelDescription description, const std::string& manoeuvre,
                           const VehicleNeeds& needs, double speed) {
  require_roles(description, manoeuvre, needs);
  require_flat_roads(description, manoeuvre, needs.patches);
  VehicleSetup out{.description = std::move(description), .axles = {}};
  ModelDescription& d = out.description;
  const VehicleDescription& v = *d.vehicle;
  const Vec3 driver = v.driver.value_or(vehicle_body(d, v.chassis).X_WB.p);
  const auto centre = [&](const VehicleWheel& w) {
    return design_centre(vehicle_body(d, w.wheel));
  };
  const auto axle_x = [&](const VehicleAxle& a) {
    return 0.5 * (centre(a.left).x() + centre(a.right).x());
  };
  out.axles = {.front = axle_x(v.axles.front()) - driver.x(),
               .rear = driver.x() - axle_x(v.axles.back())};
  if (!(out.axles.wheelbase() > 0.0))
    throw InputError(ErrorCode::geometry, v.origin.of("axles"),
                     "vehicle.axles: found the first axle behind the last one, expected them from "
                     "the front, at the largest x, to the rear");
  for (const VehicleAxle& a : v.axles)
    out.wheel_radius += 0.5 * (centre(a.left).z() + centre(a.right).z());
  out.wheel_radius /= double(v.axles.size());
  if (!(out.wheel_radius > 0.0))
    throw InputError(ErrorCode::geometry, v.origin.of("axles"),
                     "vehicle.axles: found wheel centres that are not above z = 0, expected the "
                     "road there");
  d.simulation.velocity = {speed, 0.0, 0.0};
  d.simulation.input = InputUse::ramp;  // from one step to the next: order two
  for (const VehicleAxle& a : v.axles)
    for (const VehicleWheel* w : {&a.left, &a.right}) spin_up(d, *w, speed / out.wheel_radius);
  add_measured(d, driver);
  for (const VehicleAxle& a : v.axles) {
    add_load(d, a.name + ".left", a.left.tyre);
    add_load(d, a.name + ".right", a.right.tyre);
  }
  return out;
}

}  // namespace floatframe
