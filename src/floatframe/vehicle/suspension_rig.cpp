#include "floatframe/vehicle/suspension_rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>

#include "floatframe/loops/run_error.hpp"
#include "floatframe/model/validate_model.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "floatframe/vehicle/circle_figures.hpp"
#include "floatframe/vehicle/vehicle_parts.hpp"
#include "floatframe/vehicle/vehicle_setup.hpp"

namespace floatframe {
namespace {

struct RiggedWheel {
  const VehicleWheel* wheel;
  std::string name;  ///< "front.left"
  bool left;
};

std::vector<RiggedWheel> rigged_wheels(const VehicleDescription& v) {
  std::vector<RiggedWheel> out;
  for (const VehicleAxle& a : v.axles) {
    out.push_back({&a.left, a.name + ".left", true});
    out.push_back({&a.right, a.name + ".right", false});
  }
  return out;
}

AttachmentDescription rig_place(const std::string& body, const Vec3& point) {
  AttachmentDescription out;
  out.body = body;
  out.point = point;
  return out;
}

/// The chassis is welded to the ground where it is drawn.
void hold_chassis(ModelDescription& d) {
  const std::string& chassis = d.vehicle->chassis;
  std::erase_if(d.joints, [&](const JointDescription& j) {
    return (j.parent.body == ground_name && j.child.body == chassis) ||
           (j.child.body == ground_name && j.parent.body == chassis);
  });
  JointDescription weld = joint_of_type("vehicle.rig.chassis", "weld");
  weld.parent = rig_place(ground_name, vehicle_body(d, chassis).X_WB.p);
  weld.child = rig_place(chassis, vehicle_body(d, chassis).X_WB.p);
  d.joints.push_back(std::move(weld));
}

/// A plane below the wheel centre that a prismatic joint holds at the height `travel`.
void hold_wheel(ModelDescription& d, const RiggedWheel& w, double travel) {
  const Vec3 centre = design_centre(vehicle_body(d, w.wheel->wheel));
  const std::string name = "vehicle.rig." + w.name;
  BodyDescription plate;
  plate.name = name;
  plate.X_WB.p = centre;
  plate.X_WT = plate.X_WB;
  plate.kind = RigidDescription{};
  d.bodies.push_back(std::move(plate));
  JointDescription lift = joint_of_type(name, "prismatic");
  lift.parent = rig_place(ground_name, centre);
  lift.child = rig_place(name, centre);
  lift.axis = Vec3::UnitZ();
  lift.motion = TimeFunction{.pieces = PiecewisePolynomial::polynomial({travel})};
  d.joints.push_back(std::move(lift));
  InPlane plane;
  plane.a = rig_place(name, centre);
  plane.b = rig_place(w.wheel->wheel, centre);
  plane.axis = Vec3::UnitZ();
  d.constraints.push_back({name, plane, {}});
  if (JointDescription* spin = spin_joint(d, *w.wheel)) {
    spin->velocity.clear();
    spin->motion = TimeFunction{.pieces = PiecewisePolynomial::polynomial({0.0})};
  }
  std::erase_if(d.forces, [&](const ElementDescription& e) { return e.name == w.wheel->tyre; });
}

/// Nine outputs of a wheel: its centre, a point 1 m to the left on its axis, the plane's force.
void measure_wheel(ModelDescription& d, const RiggedWheel& w) {
  const Vec3 centre = design_centre(vehicle_body(d, w.wheel->wheel));
  const std::string name = "vehicle.rig." + w.name;
  const auto add = [&](const char* what, const Vec3& point) {
    for (int k = 0; k < 3; ++k) {
      OutputDescription o = output_of_type(name + "." + what + "xyz"[k], "position");
      o.component = k;
      o.at = rig_place(w.wheel->wheel, point);
      d.outputs.push_back(std::move(o));
    }
  };
  add("centre_", centre);
  add("axis_", centre + Vec3::UnitY());
  for (int k = 0; k < 3; ++k) {
    OutputDescription o = output_of_type(name + ".force_" + "xyz"[k], "joint_force");
    o.component = k;
    o.entity = name;
    o.constraint = true;
    d.outputs.push_back(std::move(o));
  }
}

struct RiggedPoint {
  std::vector<double> travel;  ///< of each wheel [m]
  std::optional<double> input;
  std::optional<RigLoad> load;
  double sense = 1.0;  ///< of the load
};

/// At the contact point of the design configuration, on the wheel.
void load_wheel(ModelDescription& d, const RiggedWheel& w, RigLoad load, double sense) {
  const Vec3 centre = design_centre(vehicle_body(d, w.wheel->wheel));
  AppliedLoad push;
  push.at = rig_place(w.wheel->wheel, {centre.x(), centre.y(), 0.0});
  push.direction = load == RigLoad::lateral   ? Vec3(Vec3::UnitY())
                   : load == RigLoad::braking ? Vec3(-Vec3::UnitX())
                                              : Vec3(Vec3::UnitZ());
  const double size = load == RigLoad::aligning ? 100.0 : 1000.0;
  push.magnitude =
      SignalDescription(TimeFunction{.pieces = PiecewisePolynomial::polynomial({sense * size})});
  ElementDescription element;
  element.name = "vehicle.rig." + w.name + ".load";
  if (load == RigLoad::aligning)
    element.kind = AppliedTorque{push};
  else
    element.kind = AppliedForce{push};
  d.forces.push_back(std::move(element));
}

ModelDescription rigged(const ModelDescription& description, const RiggedPoint& point) {
  ModelDescription d = description;
  d.outputs.clear();
  d.simulation.until = nullptr;
  d.simulation.start = Start::equilibrium;
  d.simulation.state = nullptr;
  d.simulation.offset.clear();
  d.simulation.velocity = Vec3::Zero();
  hold_chassis(d);
  const std::vector<RiggedWheel> wheels = rigged_wheels(*description.vehicle);
  for (std::size_t k = 0; k < wheels.size(); ++k) {
    hold_wheel(d, wheels[k], point.travel[k]);
    measure_wheel(d, wheels[k]);
    if (point.load) load_wheel(d, wheels[k], *point.load, point.sense);
  }
  if (point.input)
    std::ranges::find(d.inputs, d.vehicle->steering->input, &InputDescription::name)->initial =
        *point.input;
  d.vehicle.reset();  // its tyres are gone
  return d;
}

RigWheel wheel_of(const double* y, bool left, const Vec3& centre, Vec3& lowest) {
  const Eigen::Map<const Vec3> c(y), far(y + 3), force(y + 6);
  const Vec3 n = (far - c).normalized();
  const double outwards = left ? -1.0 : 1.0;
  RigWheel out;
  out.height = c.z() - centre.z();
  out.x = c.x() - centre.x();
  out.y = c.y() - centre.y();
  out.steer = std::atan2(-n.x(), n.y());
  out.toe = outwards * out.steer;
  out.camber = outwards * std::asin(n.z());
  out.force = force.z();
  const Vec3 up = Vec3::UnitZ() - n.z() * n;
  lowest = c - centre.z() / up.norm() * up;
  return out;
}

const char* load_word(RigLoad load) {
  return load == RigLoad::lateral   ? "a lateral force"
         : load == RigLoad::braking ? "a brake force"
                                    : "an aligning moment";
}

/// Throws RunError with the travel and the cause.
std::unique_ptr<Simulation> start_on_rig(const ModelDescription& description,
                                         const RiggedPoint& point) {
  try {
    return std::make_unique<Simulation>(build_model(rigged(description, point)));
  } catch (const RunError& e) {
    throw RunError(
        e.code(),
        fmt::format(
            "the suspension has no equilibrium on the rig at a travel of {:.5g} "
            "mm on the left, {:.5g} mm on the right{}{}: {}",
            1e3 * point.travel[0], 1e3 * point.travel[1],
            point.input ? fmt::format(" and {:.5g} as steering", *point.input) : std::string(),
            point.load ? fmt::format(" under {}", load_word(*point.load)) : std::string(),
            e.what()));
  }
}

RigPoint measured_point(const ModelDescription& description, const RiggedPoint& point) {
  const std::unique_ptr<Simulation> simulation = start_on_rig(description, point);
  const std::vector<RiggedWheel> wheels = rigged_wheels(*description.vehicle);
  RigPoint out;
  out.travel = point.travel[0];
  out.input = point.input.value_or(0.0);
  for (std::size_t k = 0; k < wheels.size(); k += 2) {
    RigAxle axle;
    Vec3 left, right;
    const auto wheel = [&](std::size_t i, Vec3& lowest) {
      return wheel_of(simulation->outputs().data() + 9 * i, wheels[i].left,
                      design_centre(vehicle_body(description, wheels[i].wheel->wheel)), lowest);
    };
    axle.left = wheel(k, left);
    axle.right = wheel(k + 1, right);
    axle.track = left.y() - right.y();
    out.axles.push_back(axle);
  }
  return out;
}

/// The wheel rates are slopes over the heights of each wheel.
void find_rates(std::vector<RigPoint>& points) {
  for (std::size_t axle = 0; axle < points.front().axles.size(); ++axle)
    for (RigWheel RigAxle::*side : {&RigAxle::left, &RigAxle::right}) {
      std::vector<double> height, force;
      for (const RigPoint& p : points) {
        height.push_back((p.axles[axle].*side).height);
        force.push_back((p.axles[axle].*side).force);
      }
      const std::vector<double> rate = slopes(height, force);
      for (std::size_t k = 0; k < points.size(); ++k) (points[k].axles[axle].*side).rate = rate[k];
    }
}

/// The bodies that are one with another by welds.
std::set<std::string> welded_to(const ModelDescription& d, const std::string& body) {
  std::set<std::string> out{body};
  const auto weld = joint_of_type({}, "weld").type;
  for (std::size_t before = 0; before != out.size();) {
    before = out.size();
    for (const JointDescription& j : d.joints) {
      if (j.type != weld) continue;
      if (out.contains(j.parent.body)) out.insert(j.child.body);
      if (out.contains(j.child.body)) out.insert(j.parent.body);
    }
  }
  return out;
}

void require_suspension(const ModelDescription& d) {
  const std::set<std::string> chassis = welded_to(d, d.vehicle->chassis);
  for (const RiggedWheel& w : rigged_wheels(*d.vehicle))
    if (chassis.contains(w.wheel->wheel))
      throw vehicle_error(d, ErrorCode::wrong_value, "vehicle.axles." + w.name,
                          "found the wheel '" + w.wheel->wheel +
                              "' welded to the chassis, expected one on a suspension for k-and-c");
}

void require_rig_vehicle(const ModelDescription& d) {
  if (!d.vehicle)
    throw InputError(ErrorCode::missing, SourceMark{.file = d.simulation.origin.mark.file},
                     "k-and-c: found no section 'vehicle', expected one with the roles of bodies, "
                     "tyres and inputs");
  ErrorList errors;
  validate(d, errors);
  errors.throw_if_any();
  require_suspension(d);
}

}  // namespace

bool stands_still(const std::vector<RigPoint>& points, std::size_t axle) {
  double most = 0.0;
  for (const RigPoint& p : points)
    for (RigWheel RigAxle::*side : {&RigAxle::left, &RigAxle::right}) {
      const RigWheel &here = p.axles[axle].*side, &first = points.front().axles[axle].*side;
      for (double RigWheel::*value :
           {&RigWheel::x, &RigWheel::y, &RigWheel::steer, &RigWheel::camber})
        most = std::max(most, std::abs(here.*value - first.*value));
    }
  return most < 1e-9;
}

std::vector<RigPoint> suspension_sweep(const ModelDescription& description, RigSweep sweep,
                                       const RigOptions& options) {
  require_rig_vehicle(description);
  const VehicleDescription& v = *description.vehicle;
  if (sweep == RigSweep::steer && !v.steering)
    throw InputError(ErrorCode::missing, v.origin.mark,
                     "vehicle: found no 'steering', expected it for a steer sweep");
  std::vector<RigPoint> out;
  for (int k = 0; k < options.points; ++k) {
    const double part = options.points > 1 ? 2.0 * k / (options.points - 1) - 1.0 : 0.0;
    RiggedPoint point;
    for (std::size_t i = 0; i < 2 * v.axles.size(); ++i) {
      const bool against = sweep == RigSweep::roll && i % 2 == 1;
      const double travel = sweep == RigSweep::steer ? 0.0 : part * options.travel;
      point.travel.push_back(against ? -travel : travel);
    }
    if (sweep == RigSweep::steer) point.input = part * options.angle * v.steering->ratio;
    out.push_back(measured_point(description, point));
  }
  if (sweep != RigSweep::steer) find_rates(out);
  return out;
}

namespace {

RigWheel half_difference(const RigWheel& a, const RigWheel& b) {
  RigWheel out;
  for (double RigWheel::*value : {&RigWheel::height, &RigWheel::x, &RigWheel::y, &RigWheel::steer,
                                  &RigWheel::toe, &RigWheel::camber, &RigWheel::force})
    out.*value = 0.5 * (a.*value - b.*value);
  return out;
}

}  // namespace

std::vector<RigCompliance> suspension_compliance(const ModelDescription& description) {
  require_rig_vehicle(description);
  std::vector<RigCompliance> out;
  for (const RigLoad load : {RigLoad::lateral, RigLoad::braking, RigLoad::aligning}) {
    RiggedPoint point;
    point.travel.assign(2 * description.vehicle->axles.size(), 0.0);
    point.load = load;
    const RigPoint there = measured_point(description, point);
    point.sense = -1.0;
    const RigPoint back = measured_point(description, point);
    RigCompliance change{.load = load, .axles = {}};
    for (std::size_t k = 0; k < there.axles.size(); ++k) {
      const RigAxle &a = there.axles[k], &b = back.axles[k];
      change.axles.push_back({.left = half_difference(a.left, b.left),
                              .right = half_difference(a.right, b.right),
                              .track = 0.5 * (a.track - b.track)});
    }
    out.push_back(std::move(change));
  }
  return out;
}

RigFigures suspension_figures(const ModelDescription& description, const RigOptions& options) {
  RigFigures out;
  out.travel = suspension_sweep(description, RigSweep::travel, options);
  out.roll = suspension_sweep(description, RigSweep::roll, options);
  if (description.vehicle->steering)
    out.steer = suspension_sweep(description, RigSweep::steer, options);
  out.compliance = suspension_compliance(description);
  for (const VehicleAxle& a : description.vehicle->axles) out.axles.push_back(a.name);
  if (description.vehicle->steering)
    out.input_unit = std::ranges::find(description.inputs, description.vehicle->steering->input,
                                       &InputDescription::name)
                         ->unit;
  return out;
}

}  // namespace floatframe
