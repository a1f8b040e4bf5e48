#include "support/random_mechanism.hpp"

#include <cmath>
#include <numbers>

#include "floatframe/model/element_keys.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/element_outputs.hpp"
#include "support/mechanism_builder.hpp"
#include "support/random_force.hpp"

namespace floatframe::test {

namespace {

/// What is drawn from. Fixed, so that a seed stays the same mechanism when the library gets more
/// joints; those come in by `with_joints`.
constexpr JointType drawn_joints[] = {
    JointType::weld,      JointType::revolute,  JointType::prismatic, JointType::cylindrical,
    JointType::universal, JointType::spherical, JointType::free};

}  // namespace

MechanismBuilder::MechanismBuilder(unsigned seed) : random(seed) {
  d.name = "mechanism_" + std::to_string(seed);
  const double kind = random(0.0, 1.0);
  mass_models = {MassModel::isoparametric};
  if (kind < 0.6) {
    m.relative = chance(0.5) ? InertiaMethod::projection : InertiaMethod::preprocessing;
    m.absolute = chance(0.5) ? InertiaMethod::projection : InertiaMethod::preprocessing;
  } else if (kind < 0.8) {
    mass_models.push_back(MassModel::hermite);
  } else {
    mass_models.push_back(MassModel::six_dof);
    m.relative = m.absolute = InertiaMethod::projection;
  }
  if (chance(0.1))
    d.gravity.setZero();
  else
    d.gravity = random.vec3(6.0) - Vec3(0, 0, 5.0);
  SimulationDescription& s = d.simulation;
  s.duration = 0.2;
  if (chance(0.2)) s.spectral_radius = random(0.6, 1.0);
  if (chance(0.1)) s.velocity = random.vec3();
  if (chance(0.04)) s.start = Start::equilibrium;
}

JointDescription& MechanismBuilder::add_joint(JointType type, const AttachmentDescription& parent,
                                              const AttachmentDescription& child) {
  JointDescription j;
  j.name = "joint_" + std::to_string(joint_count_++);
  j.type = type;
  j.parent = parent;
  j.child = child;
  if (parent.body != ground_name && chance(0.15)) std::swap(j.parent, j.child);
  j.axis = direction();
  j.axis_2 = direction();
  while (j.axis.cross(j.axis_2).norm() < 0.5) j.axis_2 = direction();
  j.cut = chance(0.08);
  d.joints.push_back(std::move(j));
  return d.joints.back();
}

void MechanismBuilder::start_values(JointDescription& j, double position, double velocity) {
  if (j.motion) return;
  const int n = joint_velocities(j.type);
  if (chance(0.5))
    for (int k = 0; k < n; ++k) j.position.push_back(random(-position, position));
  if (chance(0.6))
    for (int k = 0; k < n; ++k) j.velocity.push_back(random(-velocity, velocity));
}

void MechanismBuilder::add_branch(int parent) {
  const AttachmentDescription place = somewhere(parent);
  const int body = add_body(place.point);
  const double kind = random(0.0, 1.0);
  if (kind < 0.04) return;  // no joint at all: a free one is made by itself
  const JointType type = kind < 0.12 ? JointType::weld : drawn_joints[1 + pick(6)];
  JointDescription& j = add_joint(type, place, at(body, place.point));
  if ((type == JointType::revolute || type == JointType::prismatic) && chance(0.12))
    j.motion = motion();
  start_values(j, 0.5, 2.0);
}

bool MechanismBuilder::close_somewhere() {
  const int a = pick(bodies()), b = pick(bodies() + 1) - 1;
  if (a == b) return false;
  const AttachmentDescription on_b = somewhere(b), on_a = somewhere(a);
  if (chance(0.4)) {
    if ((on_a.point - on_b.point).norm() < 0.05) return false;
    d.rods.push_back({"rod_" + std::to_string(d.rods.size()), Rod{on_a, on_b, {}, {}}, {}});
    return true;
  }
  if (is_flexible(a) && is_flexible(b)) return false;
  const Vec3 point = is_flexible(a) ? on_a.point : on_b.point;
  const JointType type = drawn_joints[pick(6)];
  JointDescription& j = add_joint(type, at(b, point), at(a, point));
  j.cut = chance(0.3);
  if ((type == JointType::revolute || type == JointType::prismatic) && chance(0.05))
    j.motion = motion();
  return true;
}

/// Links in a plane between the ground and itself, all hinges along one normal.
void MechanismBuilder::planar_loop() {
  const Vec3 n = direction();
  Vec3 e, f;
  orthonormal_complement(n, e, f);
  const Vec3 origin = random.vec3(0.4);
  const auto point = [&](double x, double y) { return Vec3(origin + x * e + y * f); };
  const double angle = random(0.9, 2.2), crank = random(0.25, 0.4);
  const Vec3 tip = point(crank * std::cos(angle), crank * std::sin(angle));
  const Vec3 slider = point(random(0.8, 1.1), random(-0.1, 0.1));
  const int kind = pick(5);
  std::vector<Vec3> pins{point(0, 0), tip};
  if (kind == 4) {  // five bars
    pins.push_back(point(0.45, 0.6));
    pins.push_back(point(0.8, 0.4));
  } else if (kind == 3) {  // parallel cranks: a third one is added below
    pins.push_back(tip + 0.7 * e);
    pins.push_back(point(0.7, 0));
  } else if (kind != 2) {
    pins.push_back(point(random(0.6, 0.9), random(0.4, 0.6)));
  }
  if (kind != 3) pins.push_back(slider);
  // With a ball in one place and a sliding hinge in another no constraint is redundant.
  const bool minimal = chance(0.4);
  int previous = -1;
  std::vector<int> links;
  for (std::size_t k = 0; k + 1 < pins.size(); ++k) {
    // Of three parallel cranks none may bend: their modes do not shorten them, so the equal
    // distances of their ends would hold the deflections in the second order only.
    const int link = kind == 3 && !chance(0.1) ? add_rigid(0.5 * (pins[k] + pins[k + 1]))
                                               : add_link(pins[k], pins[k + 1]);
    links.push_back(link);
    const JointType type = minimal && k == 1 ? JointType::spherical : JointType::revolute;
    JointDescription& j = add_joint(type, at(previous, pins[k]), at(link, pins[k]));
    j.axis = n;
    if (k == 0 && chance(0.25)) {
      j.motion = motion();
    } else if (k == 0) {
      start_values(j, 0.15, 1.5);
      if (!j.position.empty()) j.position[0] *= 0.5;
    }
    previous = link;
  }
  int frame = -1;
  if (kind == 2) {  // slider on the ground, along a direction in the plane
    frame = add_rigid(pins.back());
    JointDescription& slide =
        add_joint(JointType::prismatic, at(-1, pins.back()), at(frame, pins.back()));
    slide.axis = e + random(-0.2, 0.2) * f;
  }
  JointDescription& last = add_joint(minimal ? JointType::cylindrical : JointType::revolute,
                                     at(frame, pins.back()), at(previous, pins.back()));
  last.axis = n;
  if (chance(0.15) && last.type == JointType::revolute) start_values(last, 0.1, 0.5);
  if (kind == 3 && !is_flexible(links[1])) {  // hinges of the third crank on the ground and coupler
    const Vec3 foot = point(0.35, 0.0), head = tip + 0.35 * e;
    const int third = add_rigid(0.5 * (foot + head));
    add_joint(JointType::revolute, at(-1, foot), at(third, foot)).axis = n;
    add_joint(JointType::revolute, at(links[1], head), at(third, head)).axis = n;
  }
}

/// One closed chain whose joints have six coordinates more than it has freedoms.
void MechanismBuilder::spatial_loop() {
  const int wanted = 7 + pick(3);
  std::vector<JointType> types;
  int sum = 0;
  while (sum < wanted || types.size() < 3) {
    const JointType type = drawn_joints[1 + pick(5)];
    types.push_back(type);
    sum += joint_velocities(type);
    if (sum > 9) {
      types.clear();
      sum = 0;
    }
  }
  std::vector<Vec3> pins;
  const auto count = types.size();
  for (std::size_t k = 0; k < count; ++k) {
    const double t = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
    pins.emplace_back(Vec3(0.7 * std::cos(t), 0.7 * std::sin(t), 0.0) + random.vec3(0.25));
  }
  int previous = -1;
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const int link = add_link(pins[k], pins[k + 1]);
    JointDescription& j = add_joint(types[k], at(previous, pins[k]), at(link, pins[k]));
    if (k == 0 && joint_velocities(j.type) == 1 && chance(0.25))
      j.motion = motion();
    else if (k == 0)
      start_values(j, 0.1, 1.0);
    previous = link;
  }
  add_joint(types.back(), at(-1, pins.back()), at(previous, pins.back()));
}

void MechanismBuilder::add_outputs() {
  const auto add = [&](OutputType type, const AttachmentDescription& at, const std::string& entity,
                       int component) {
    OutputDescription o;
    o.name = "column_" + std::to_string(d.outputs.size());
    o.type = type;
    o.at = at;
    o.entity = entity;
    o.component = component;
    d.outputs.push_back(std::move(o));
  };
  for (int i = 0; i < bodies(); ++i) {
    const std::size_t k = i;
    std::vector<AttachmentDescription> points;
    for (const auto& [node, p] : nodes_[k]) {
      points.push_back(at(i, d.bodies[k].X_WB * p));
      points.back().node = node;
    }
    if (points.empty())
      for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0.3, 0, 0), Vec3(0, 0.3, 0)})
        points.push_back(at(i, d.bodies[k].X_WB * p));
    for (const AttachmentDescription& p : points)
      for (int c = 0; c < 3; ++c) add(OutputType::position, p, "", c);
    add(OutputType::acceleration, points.front(), "", i % 3);
    add(OutputType::angular_velocity, at(i, Vec3::Zero()), "", i % 3);
  }
  // Rotation vectors of balls jump at half a turn: the points above say as much.
  for (const JointDescription& j : d.joints)
    if (j.type != JointType::spherical && j.type != JointType::free)
      for (int c = 0; c < joint_velocities(j.type); ++c)
        add(OutputType::joint_position, {}, j.name, c);
  for (const ElementDescription& f : d.forces) {
    add(OutputType::force, {}, f.name, 0);
    if (!element_has(f.type(), ElementQuantity::length)) continue;
    for (const OutputType type : {OutputType::length, OutputType::rate}) add(type, {}, f.name, 0);
  }
}

namespace {

Mechanism draw(unsigned seed) {
  MechanismBuilder b(seed);
  const double family = b.random(0.0, 1.0);
  if (family < 0.4 || family > 0.85) {
    b.m.family = family < 0.4 ? "tree" : "closed";
    const int count = 1 + b.pick(b.chance(0.3) ? 8 : 5);
    for (int k = 0; k < count; ++k)
      b.add_branch(b.bodies() == 0 || b.chance(0.2) ? -1 : b.pick(b.bodies()));
    if (family > 0.85)
      for (int k = 1 + b.pick(2), tries = 0; k > 0 && tries < 20; ++tries)
        if (b.close_somewhere()) --k;
  } else if (family < 0.62) {
    b.m.family = "planar";
    b.planar_loop();
  } else {
    b.m.family = "spatial";
    b.spatial_loop();
  }
  if (b.m.family[0] == 'p' || b.m.family[0] == 's')
    for (int k = b.pick(3); k > 0; --k) b.add_branch(b.pick(b.bodies()));
  for (int k = b.pick(5); k > 0; --k) b.add_force();
  for (int i = 0; i < b.bodies(); ++i) {
    const BodyDescription& body = b.d.bodies[i];
    const auto* given = std::get_if<FlexibleBody>(&body.kind);
    if (!given || body.rigid || !b.chance(0.4)) continue;
    b.d.amplitudes[body.name] = b.random.vector(given->modes(), 0.03);
    if (b.chance(0.5)) b.d.amplitude_rates[body.name] = b.random.vector(given->modes(), 0.3);
  }
  if (b.chance(0.3)) b.add_maxwell();  // last: earlier draws are those of mechanisms without it
  b.add_outputs();
  return std::move(b.m);
}

}  // namespace

Mechanism random_mechanism(unsigned seed) {
  constexpr unsigned attempts = 50;
  for (unsigned attempt = 0;; ++attempt) {
    Mechanism m = draw(seed + 1000000 * attempt);
    m.description.name = "mechanism_" + std::to_string(seed);
    try {
      if (!(fastest_rate(build_model(m.description), m.relative) >= most_rate)) return m;
    } catch (const InputError&) {
      return m;  // to be refused
    }
    if (attempt == attempts) return m;
  }
}

Mechanism with_joints(Mechanism m, JointType type) {
  for (JointDescription& j : m.description.joints)
    if (joint_velocities(j.type) == joint_velocities(type) && !j.motion) j.type = type;
  return m;
}

namespace {

bool is_road(const ElementKey& key) { return key.kind == KeyKind::road; }

}  // namespace

std::optional<Mechanism> with_force(Mechanism m, ElementType type, unsigned seed) {
  ModelDescription& d = m.description;
  ExampleNumbers numbers(seed);
  std::vector<AttachmentDescription> places;
  for (const JointDescription& j : d.joints)
    for (const AttachmentDescription& at : {j.parent, j.child}) places.push_back(at);
  RandomForceEnds ends;
  ends.stiffness = 30.0;
  ends.damping = 0.3;
  for (const JointDescription& j : d.joints)
    if (joint_has_one_coordinate(j.type) && !j.motion) ends.joint = j.name;
  for (int trial = 0; trial < 20 && !places.empty(); ++trial) {
    const auto any = [&] { return places[numbers(0.0, static_cast<double>(places.size()))]; };
    ends.a = any();
    ends.b = any();
    if (ends.a.body == ends.b.body) continue;
    if (std::ranges::any_of(element_keys(type), is_road)) {  // that a wheel there touches
      RoadDescription road;
      road.name = ends.road = "below";
      road.pieces = PiecewisePolynomial::polynomial({ends.b.point.z() - 0.3});
      d.roads.push_back(std::move(road));
    }
    d.forces.push_back(random_force(type, ends, numbers));
    for (const OutputType quantity : {OutputType::force, OutputType::length, OutputType::rate}) {
      OutputDescription o;
      if (quantity != OutputType::force && !element_kind(type).measured) continue;
      o.name = d.forces.back().name + "." + output_type_name(quantity);
      o.type = quantity;
      o.entity = d.forces.back().name;
      d.outputs.push_back(o);
    }
    return m;
  }
  return std::nullopt;
}

namespace {

/// A coupling by name of these coordinates, one of those that fit.
std::optional<ElementKeys> named_coupling(const ModelDescription& d,
                                          const std::vector<CoordinateTerm>& all,
                                          ExampleNumbers& numbers) {
  std::vector<CoordinateTerm> turning, sliding;
  std::vector<Vec3> axes;
  for (const CoordinateTerm& term : all) {
    const auto j = std::ranges::find(d.joints, term.joint, &JointDescription::name);
    const bool turns = coordinate_axis(j->type, Vec3::UnitX(), term.coordinate)->turns;
    (turns ? turning : sliding).push_back(term);
    if (turns) axes.push_back(j->axis.normalized());
  }
  const auto between = [&](std::size_t k) {
    return std::atan2(axes[0].cross(axes[k]).norm(), std::abs(axes[0].dot(axes[k])));
  };
  std::vector<ElementKeys> fit;
  const double ratio = numbers(0.5, 2.0);
  if (all.size() >= 2)
    fit.push_back(Mimic{all[0], all[1], numbers(-2.0, -0.5), numbers(-0.1, 0.1)});
  if (turning.size() >= 2)
    fit.push_back(BevelGear{turning[0], turning[1], ratio, {}, numbers(0.0, 1.0) < 0.5});
  if (turning.size() >= 2 && between(1) < 0.01) {
    fit.push_back(Gear{.driver = turning[0], .driven = turning[1], .ratio = ratio});
    fit.push_back(
        BeltDrive{.driver = turning[0], .driven = turning[1], .radii = MatX{{0.1, 0.1 * ratio}}});
  }
  if (turning.size() >= 3 && between(1) < 1.0 && between(2) < 1.0)
    fit.push_back(DifferentialGear{turning[0], turning[1], turning[2]});
  if (!turning.empty() && !sliding.empty()) {
    fit.push_back(RackAndPinion{turning[0], sliding[0], ratio, numbers(0.0, 1.0) < 0.5});
    fit.push_back(ScrewDrive{{}, turning[0], sliding[0], 3.0 * ratio});
  }
  if (fit.empty()) return std::nullopt;
  return fit[static_cast<std::size_t>(numbers(0.0, static_cast<double>(fit.size()) - 1e-9))];
}

}  // namespace

std::optional<Mechanism> with_coupling(Mechanism m, unsigned seed) {
  ModelDescription& d = m.description;
  ExampleNumbers numbers(seed);
  const auto without_mass = [&](const std::string& name) {
    return std::any_of(d.bodies.begin(), d.bodies.end(), [&](const BodyDescription& b) {
      const auto* rigid = std::get_if<RigidDescription>(&b.kind);
      return b.name == name && rigid && rigid->mass == 0.0;
    });
  };
  std::vector<CoordinateTerm> left, all;
  for (const JointDescription& j : d.joints)
    for (int k = 0; k < joint_velocities(j.type) && !j.motion; ++k)
      if (!without_mass(j.parent.body) && !without_mass(j.child.body) &&
          coordinate_axis(j.type, Vec3::UnitX(), k))
        left.push_back({j.name, k});
  while (!left.empty()) {  // in a random order
    const auto k = static_cast<std::ptrdiff_t>(numbers(0.0, static_cast<double>(left.size())));
    all.push_back(left[static_cast<std::size_t>(k)]);
    left.erase(left.begin() + k);
  }
  if (all.size() < 2) return std::nullopt;
  if (seed % 3 != 0) {
    d.couplings = {{"coupling", *named_coupling(d, all, numbers), {}}};
    return m;
  }
  Coupling coupling;
  coupling.terms.assign(all.begin(), all.begin() + std::min<std::ptrdiff_t>(3, std::ssize(all)));
  for (CoordinateTerm& term : coupling.terms)
    term.factor = numbers(0.5, 2.0) * (numbers(0.0, 1.0) < 0.5 ? -1.0 : 1.0);
  d.couplings = {{"coupling", coupling, {}}};
  return m;
}

std::optional<Mechanism> with_controller(Mechanism m, unsigned seed) {
  const auto measured = with_force(std::move(m), ElementType::maxwell, seed);
  if (!measured) return std::nullopt;
  auto pulled = with_force(*measured, ElementType::spring_damper, seed + 1000);
  if (!pulled) return std::nullopt;
  ModelDescription& d = pulled->description;
  ExampleNumbers numbers(seed);
  const std::string length = d.forces[d.forces.size() - 2].name;
  Pid pid;
  pid.measured.source = SignalSource::length;
  pid.measured.element = length;
  pid.target.emplace().pieces = PiecewisePolynomial::polynomial({numbers(0.2, 1.0)});
  pid.proportional = numbers(5.0, 15.0);
  pid.integral = numbers(10.0, 30.0);
  pid.derivative = numbers(0.1, 0.3);
  pid.filter = 0.05;
  d.controllers = {{"controller", pid, {}}};
  SignalDescription& actuator = std::get<SpringDamper>(d.forces.back().kind).actuator.emplace();
  if (seed % 2 == 0) {
    actuator.formula = formula("controller(controller) - 0.5 * velocity('" + d.bodies.front().name +
                               "', x) * tanh(length('" + length + "'))");
    return pulled;
  }
  actuator.source = SignalSource::controller;
  actuator.element = "controller";
  return pulled;
}

}  // namespace floatframe::test
