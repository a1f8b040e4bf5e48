#include "floatframe/bench/law_model.hpp"

namespace floatframe {

ModelDescription law_model(bool by_formula) {
  constexpr int count = 20;
  const ForceFunction law = [](double x, double v, double) -> ForceLawValue {
    return {100.0 * x + 400.0 * x * x * x + 0.5 * v, 100.0 + 1200.0 * x * x, 0.5};
  };
  const ForceFunction same = ForceFunction::of(formula("100 * x + 400 * x^3 + 0.5 * v"));
  ModelDescription d;
  d.name = by_formula ? "masses on formulas" : "masses on laws";
  d.simulation.step = 1e-3;
  d.simulation.duration = 0.2;
  for (int k = 0; k < count; ++k) {
    const std::string number = std::to_string(k + 1);
    BodyDescription b;
    b.name = "mass_" + number;
    b.X_WB.p = b.X_WT.p = Vec3(0.0, k, 0.0);
    b.kind = RigidDescription{1.0, Vec3::Zero(), 0.02 * Mat3::Identity()};
    JointDescription j;
    j.name = "rail_" + number;
    j.type = JointType::prismatic;
    j.axis = Vec3::UnitX();
    j.axis_2 = Vec3::UnitY();
    j.child.body = b.name;
    j.parent.point = j.child.point = b.X_WB.p;
    j.position = {0.1 * (k + 1) / count};
    ForceLaw f;
    f.joint = j.name;
    f.law = by_formula ? same : law;
    d.forces.push_back({"law_" + number, f, {}});
    d.bodies.push_back(std::move(b));
    d.joints.push_back(std::move(j));
  }
  return d;
}

}  // namespace floatframe
