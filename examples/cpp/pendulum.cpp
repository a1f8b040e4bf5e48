// A pendulum without a model file: a rod of 1 m on a hinge, described, built and stepped by the
// program. Its period is compared with that of the physical pendulum,
//   T = 2 pi sqrt(J / (m g c)) (1 + a^2/16 + 11 a^4/3072 + ...),   a: amplitude,
// whose first factor, the period of small swings, is also that of the linear system about hanging.
#include <cmath>
#include <cstdio>
#include <floatframe/floatframe.hpp>
#include <numbers>

namespace ff = floatframe;

namespace {

constexpr double length = 1.0, mass = 2.0, amplitude = 0.2;  // [m], [kg], [rad]

ff::ModelDescription pendulum() {
  ff::ModelDescription d;
  d.name = "pendulum";

  ff::RigidDescription rod;
  rod.mass = mass;
  rod.p_BC = {0.0, 0.0, -length / 2};
  rod.J_C = ff::Vec3(1.0, 1.0, 0.0).asDiagonal() * (mass * length * length / 12);
  ff::BodyDescription body;
  body.name = "rod";
  body.kind = rod;
  d.bodies.push_back(body);

  ff::JointDescription hinge;
  hinge.name = "hinge";
  hinge.type = ff::JointType::revolute;
  hinge.child.body = "rod";  // the parent is the ground, the point the origin
  hinge.axis = ff::Vec3::UnitY();
  hinge.position = {amplitude};
  d.joints.push_back(hinge);

  ff::OutputDescription angle;
  angle.name = "angle";
  angle.type = ff::OutputType::joint_position;
  angle.entity = "hinge";
  d.outputs.push_back(angle);
  return d;
}

}  // namespace

int main() try {
  const ff::Model model = ff::build_model(pendulum());
  ff::Simulation sim(model, {.step = 1e-3});

  // Time between two passages of the lowest point in the same direction.
  double first = 0.0, last = 0.0;
  int passages = 0;
  for (double before = sim.output("angle"); passages < 3; before = sim.output("angle")) {
    if (const ff::StepReport r = sim.step(); !r) {
      std::fprintf(stderr, "%s\n", sim.failure().c_str());
      return 1;
    }
    const double now = sim.output("angle");
    if (before < 0.0 || now >= 0.0) continue;
    last = sim.time() - 1e-3 * now / (now - before);
    if (passages++ == 0) first = last;
  }
  const double period = (last - first) / 2;
  const double a2 = amplitude * amplitude;
  const double expected = 2 * std::numbers::pi * std::sqrt(2 * length / (3 * 9.81)) *
                          (1 + a2 / 16 + 11 * a2 * a2 / 3072);
  std::printf("period %.5f s, expected %.5f s\n", period, expected);

  const ff::Linearization l = ff::linearize(model, {.start = ff::Start::equilibrium});
  std::printf("small swings of %s: %.5f s\n", l.coordinates.front().c_str(),
              2 * std::numbers::pi * std::sqrt(l.M(0, 0) / l.K(0, 0)));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
