// Constraints, cams, stops and friction in random mechanisms.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/model/joint_motion.hpp"
#include "support/random_force.hpp"
#include "support/random_mechanism.hpp"

namespace floatframe::test {

namespace {

bool is_massless(const ModelDescription& d, const std::string& name) {
  return std::ranges::any_of(d.bodies, [&](const BodyDescription& b) {
    const auto* rigid = std::get_if<RigidDescription>(&b.kind);
    return b.name == name && rigid && rigid->mass == 0.0;
  });
}

/// Coordinates of joints of bodies with mass that nothing drives, in a random order.
std::vector<CoordinateTerm> free_coordinates(const ModelDescription& d, ExampleNumbers& numbers) {
  std::vector<CoordinateTerm> left, all;
  for (const JointDescription& j : d.joints)
    for (int k = 0; k < joint_velocities(j.type) && !j.motion; ++k)
      if (!is_massless(d, j.parent.body) && !is_massless(d, j.child.body) &&
          coordinate_axis(j.type, Vec3::UnitX(), k))
        left.push_back({j.name, k});
  while (!left.empty()) {
    const auto k = static_cast<std::ptrdiff_t>(numbers(0.0, static_cast<double>(left.size())));
    all.push_back(left[static_cast<std::size_t>(k)]);
    left.erase(left.begin() + k);
  }
  return all;
}

Vec3 normal_to(const Vec3& d, ExampleNumbers& numbers) {
  const Vec3 n = d.cross(numbers.direction());
  return n.norm() > 1e-6 ? n.normalized() : numbers.direction();
}

/// A constraint of this type between two places, satisfied as drawn.
ElementKeys constraint_between(ElementType type, const AttachmentDescription& a,
                               const AttachmentDescription& b, ExampleNumbers& numbers) {
  const Vec3 d = b.point - a.point;
  const Vec3 along = d.norm() > 1e-6 ? d.normalized() : numbers.direction();
  const Vec3 across = normal_to(along, numbers);
  if (type == ElementType::in_line) return InLine{{a, b, along}};
  if (type == ElementType::in_plane) return InPlane{{a, b, across}};
  if (type == ElementType::parallel) return Parallel{{a, b, along}};
  if (type == ElementType::perpendicular) return Perpendicular{{a, b, along}, across};
  if (type == ElementType::constant_velocity)
    return ConstantVelocity{
        {a, b, along}, Vec3(along + numbers(-0.4, 0.4) * across), d.norm() > 1e-6};
  PointOnCurve curve;
  curve.a = a;
  curve.b = b;
  const double bulge = numbers(0.05, 0.3);
  if (numbers(0.0, 1.0) < 0.5) {
    curve.points.resize(5, 3);
    for (int k = 0; k < 5; ++k) {
      const double x = 0.8 * (k - 2);
      curve.points.row(k) = (d + x * across + bulge * x * x * along).transpose();
    }
    return curve;
  }
  const auto axis = [&](int k) {
    const double at = d[k], slope = across[k], curved = bulge * along[k];
    return formula(std::to_string(at) + " + " + std::to_string(slope) + " * u + " +
                   std::to_string(curved) + " * u^2");
  };
  curve.x = axis(0);
  curve.y = axis(1);
  curve.z = axis(2);
  curve.range = MatX{{-2.0, 2.0}};
  return curve;
}

void add_results(ModelDescription& d) {
  for (const OutputType quantity : {OutputType::force, OutputType::length, OutputType::rate}) {
    OutputDescription o;
    o.name = d.forces.back().name + "." + output_type_name(quantity);
    o.type = quantity;
    o.entity = d.forces.back().name;
    d.outputs.push_back(o);
  }
}

}  // namespace

std::optional<Mechanism> with_constraint(Mechanism m, ElementType type, unsigned seed) {
  ModelDescription& d = m.description;
  ExampleNumbers numbers(seed);
  std::vector<AttachmentDescription> places;
  for (const JointDescription& j : d.joints)
    for (const AttachmentDescription& at : {j.parent, j.child})
      if (!is_massless(d, at.body)) places.push_back(at);
  for (int trial = 0; trial < 20 && !places.empty(); ++trial) {
    const auto any = [&] {
      return places[static_cast<std::size_t>(
          numbers(0.0, static_cast<double>(places.size()) - 1e-9))];
    };
    const AttachmentDescription a = any(), b = any();
    if (a.body == b.body) continue;
    d.constraints = {{"constraint", constraint_between(type, a, b, numbers), {}}};
    return m;
  }
  return std::nullopt;
}

std::optional<Mechanism> with_touching_curves(Mechanism mechanism, unsigned seed) {
  Mechanism m = with_joints(std::move(mechanism), JointType::planar);
  ModelDescription& d = m.description;
  ExampleNumbers numbers(seed);
  for (const JointDescription& j : d.joints) {
    if (j.type != JointType::planar || j.motion || is_massless(d, j.parent.body) ||
        is_massless(d, j.child.body))
      continue;
    const Vec3 k = j.axis.normalized(), n = normal_to(k, numbers), t = k.cross(n);
    const double r = numbers(0.2, 0.5);
    CurveOnCurve c;
    c.a = j.parent;
    c.b = j.child;
    c.axis = k;
    const auto number = [](double x) { return fmt::format("({:.17g})", x); };
    std::optional<SharedFormula>*round[] = {&c.x, &c.y, &c.z}, *line[] = {&c.x_2, &c.y_2, &c.z_2};
    for (int i = 0; i < 3; ++i) {
      *round[i] = formula(number(r * n[i]) + " * (cos(u) - 1) + " + number(r * t[i]) + " * sin(u)");
      *line[i] = formula(number(t[i]) + " * u");
    }
    c.range = MatX{{0.0, 2.0 * std::numbers::pi}};
    c.closed = true;
    c.range_2 = MatX{{-1.0, 1.0}};
    d.constraints = {{"touch", c, {}}};
    return m;
  }
  return std::nullopt;
}

std::optional<Mechanism> with_cam(Mechanism m, unsigned seed) {
  ModelDescription& d = m.description;
  ExampleNumbers numbers(seed);
  const std::vector<CoordinateTerm> all = free_coordinates(d, numbers);
  if (all.size() < 2) return std::nullopt;
  Cam cam;
  cam.follower = all[0];
  cam.cam = all[1];
  const double lift = numbers(0.1, 0.3);
  if (seed % 3 == 0) {
    cam.formula = formula(std::to_string(lift) + " * sin(2 * x)");
  } else if (seed % 3 == 1) {
    cam.points.resize(9, 2);
    for (int k = 0; k < 9; ++k) {
      const double x = -2.0 + 0.5 * k;
      cam.points.row(k) << x, lift * std::sin(x);
    }
  } else {
    cam.phase = -1.0;
    cam.law = CamLaw::polynomial_4567;
    cam.segments = MatX{{2.0, lift}, {4.0, -lift}};
  }
  d.couplings = {{"cam", cam, {}}};
  return m;
}

std::optional<Mechanism> with_joint_element(Mechanism m, ElementType type, unsigned seed) {
  ModelDescription& d = m.description;
  ExampleNumbers numbers(seed);
  const std::vector<CoordinateTerm> all = free_coordinates(d, numbers);
  if (all.empty()) return std::nullopt;
  RandomForceEnds ends;
  ends.joint = all[0].joint;
  ElementDescription f = random_force(type, ends, numbers);
  if (auto* stop = std::get_if<JointStop>(&f.kind)) stop->coordinate = all[0].coordinate;
  if (auto* rub = std::get_if<BristleFriction>(&f.kind)) rub->coordinate = all[0].coordinate;
  f.name = all[0].joint + ".element";
  d.forces.push_back(std::move(f));
  add_results(d);
  return m;
}

}  // namespace floatframe::test
