// Forces of random mechanisms: every kind, every law, every function of time.
#include <cmath>

#include "floatframe/math/piecewise_build.hpp"
#include "support/mechanism_builder.hpp"

namespace floatframe::test {

namespace {

std::vector<TablePoint> points_around(Random& random, double x0, double width, double slope) {
  std::vector<TablePoint> points;
  for (int k = -3; k <= 3; ++k)
    points.push_back(
        {x0 + width * (k + random(-0.2, 0.2)), slope * width * (k + random(0.0, 0.4))});
  return points;
}

}  // namespace

PiecewisePolynomial MechanismBuilder::spring_law(double k, double free) {
  const PiecewisePolynomial line = PiecewisePolynomial::linear(k, free + random(-0.05, 0.05));
  switch (pick(6)) {
    case 0:
      return PiecewisePolynomial({}, {{free, {random(-2.0, 2.0), k, 0.5 * k, 2.0 * k}}});
    case 1:
      return line + ramp_below(free - random(0.02, 0.15), 3.0 * k);
    case 2:
      return line + ramp_above(free + random(0.02, 0.15), 3.0 * k);
    case 3:
      return table_function(points_around(random, free, 0.15, k), Interpolation::linear,
                            Beyond::tangent);
    case 4:
      return table_function(points_around(random, free, 0.15, k), Interpolation::cubic,
                            Beyond::tangent);
    default:
      return line;
  }
}

PiecewisePolynomial MechanismBuilder::damper_law(double c) {
  switch (pick(6)) {
    case 0:
      return PiecewisePolynomial::polynomial({0.0, c, 0.0, 0.1 * c});
    case 1:  // softer when it shortens
      return PiecewisePolynomial({0.0}, {{0.0, {0.0, 0.5 * c}}, {0.0, {0.0, c}}});
    case 2:
      return table_function(points_around(random, 0.0, 1.0, c), Interpolation::cubic,
                            Beyond::tangent);
    case 3:
      return PiecewisePolynomial::linear(c, 0.0);
    default:
      return {};
  }
}

TimeFunction MechanismBuilder::time_function(double scale) {
  TimeFunction f;
  const auto table = [&](Interpolation interpolation) {
    std::vector<TablePoint> points;
    for (int k = 0; k < 6; ++k) points.push_back({0.05 * k - 0.03, scale * random()});
    return table_function(points, interpolation, Beyond::hold);
  };
  switch (pick(6)) {
    case 0:
      f.pieces = PiecewisePolynomial::polynomial({scale * random(), scale * random(), scale});
      break;
    case 1:
      f.pieces = table(Interpolation::linear);
      break;
    case 2:
      f.pieces = table(Interpolation::cubic);
      break;
    case 3: {
      const double at = random(0.02, 0.18), slope = 5.0 * scale * random();
      f.pieces = PiecewisePolynomial({at}, {{at, {scale, slope}}, {at, {scale, -slope}}});
      break;
    }
    case 4:
      f.pieces = PiecewisePolynomial::polynomial({scale * random()});
      break;
    default:
      break;
  }
  if (chance(0.4))
    f.sines = {{.amplitude = scale, .frequency = random(0.5, 4.0), .phase = random(-3.0, 3.0)}};
  return f;
}

/// Of a joint: no jumps in its rate.
TimeFunction MechanismBuilder::motion() {
  TimeFunction f;
  switch (pick(3)) {
    case 0:
      f.pieces = PiecewisePolynomial::polynomial(
          {random(-0.1, 0.1), random(), 2.0 * random(), 5.0 * random()});
      break;
    case 1: {
      std::vector<TablePoint> points;
      for (int k = 0; k < 6; ++k) points.push_back({0.06 * k - 0.04, 0.08 * k + random(0.0, 0.05)});
      f.pieces = table_function(points, Interpolation::cubic, Beyond::hold);
      break;
    }
    default:
      f.sines = {{.amplitude = random(0.05, 0.15),
                  .frequency = random(0.5, 2.0),
                  .phase = random(-1.0, 1.0)}};
  }
  return f;
}

SignalDescription MechanismBuilder::signal(double scale) {
  SignalDescription s;
  static_cast<TimeFunction&>(s) = time_function(scale);
  if (chance(0.2)) {
    InputDescription input;
    input.name = "input_" + std::to_string(d.inputs.size());
    input.initial = scale * random();
    s.input = input.name;
    d.inputs.push_back(std::move(input));
  }
  return s;
}

/// Just touching its own road at the start.
void MechanismBuilder::add_tyre(ElementDescription& f) {
  Tyre t;
  const int body = pick(bodies());
  t.centre = somewhere(body);
  const Vec3 c = t.centre.point;
  t.radius = random(0.2, 0.4);
  t.stiffness = 800.0 * std::max(0.1, mass(body));
  t.damping = chance(0.4) ? 0.0 : random(2.0, 10.0);
  t.law = chance(0.5) ? TyreLaw::vertical : TyreLaw::radial;
  t.axis = Vec3::UnitY() + random.vec3(0.2);
  RoadDescription road;
  road.name = "road_" + std::to_string(d.roads.size());
  t.road = road.name;
  const double height = c.z() - t.radius + random(-0.01, 0.03);
  const int kind = pick(3);
  if (kind == 0) {
    road.pieces = PiecewisePolynomial::polynomial({height});
  } else if (kind == 1) {
    const double slope = random(-0.2, 0.2);
    road.pieces = PiecewisePolynomial({}, {{c.x(), {height, slope}}});
  } else {
    road.pieces = profile_function({{c.x() - 1.0, height - 0.02},
                                    {c.x() - random(0.1, 0.4), height},
                                    {c.x() + random(0.02, 0.4), height + random(-0.02, 0.02)},
                                    {c.x() + 1.0, height + 0.05}});
  }
  if (chance(0.5)) road.bumps.push_back({c.x() - random(0.0, 0.3), 0.8, random(0.01, 0.05)});
  d.roads.push_back(std::move(road));
  f.kind = t;
}

/// An element with states.
void MechanismBuilder::add_maxwell() {
  const int a = pick(bodies() + 1) - 1, b = pick(bodies());
  Maxwell m;
  m.a = somewhere(a);
  m.b = somewhere(b);
  if (a == b || (m.b.point - m.a.point).norm() < 0.1) return;
  const double share = std::max(0.2, std::min(mass(a), mass(b)));
  m.branches.resize(1 + pick(2), 2);
  for (Eigen::Index i = 0; i < m.branches.rows(); ++i)
    m.branches.row(i) << share * std::pow(random(3.0, 15.0), 2), share * random(0.5, 9.0);
  ElementDescription f;
  f.name = "creep";
  f.kind = m;
  d.forces.push_back(std::move(f));
}

void MechanismBuilder::add_force() {
  ElementDescription f;
  f.name = "force_" + std::to_string(d.forces.size());
  const int a = pick(bodies() + 1) - 1, b = pick(bodies());
  const double share = std::max(0.2, std::min(mass(a), mass(b)));
  const double stiffness = share * std::pow(random(3.0, 15.0), 2),
               damping = share * random(0.5, 3.0);
  const AttachmentDescription on_a = somewhere(a), on_b = somewhere(b);
  const double length = (on_b.point - on_a.point).norm();
  switch (pick(6)) {
    case 0:
    case 1: {
      if (a == b || length < 0.1) return;
      SpringDamper s;
      s.a = on_a;
      s.b = on_b;
      s.spring = spring_law(stiffness, length);
      s.damper = damper_law(damping);
      if (chance(0.25)) s.actuator = signal(3.0);
      f.kind = s;
      break;
    }
    case 2: {
      if (a == b) return;
      GuidedSpring g;
      g.reference = on_a;
      g.tip = on_b;
      g.axis = direction();
      g.spring = spring_law(stiffness, g.axis.dot(on_a.point - on_b.point));
      g.damper = damper_law(damping);
      if (chance(0.25)) g.actuator = signal(3.0);
      f.kind = g;
      break;
    }
    case 3: {
      JointSpring s;
      for (const JointDescription& j : d.joints)
        if ((j.type == JointType::revolute || j.type == JointType::prismatic) &&
            (s.joint.empty() || chance(0.3)))
          s.joint = j.name;
      if (s.joint.empty()) return;
      s.spring = spring_law(random(5.0, 20.0), 0.0);
      s.damper = damper_law(random(0.05, 0.3));
      if (chance(0.25)) s.actuator = signal(1.0);
      if (chance(0.3)) s.target = signal(0.2);
      if (chance(0.15)) s.target_rate = signal(0.5);
      f.kind = s;
      break;
    }
    case 4:
      add_tyre(f);
      break;
    default: {
      AppliedLoad load;
      load.at = on_b;
      load.direction = direction();
      const bool torque = chance(0.4);
      load.magnitude = signal(torque ? 0.3 : 3.0 * share);
      load.follows = chance(0.5);
      torque ? f.kind = AppliedTorque{load} : f.kind = AppliedForce{load};
    }
  }
  d.forces.push_back(std::move(f));
}

}  // namespace floatframe::test
