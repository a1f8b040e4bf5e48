// The solid arm of the Iltis at its hardest moment: stress from its modes against a direct solution
// of its finite elements with the interfaces where they are and the inertia loads of that instant.
#include <cstdlib>

#include "floatframe/formulation/relative.hpp"
#include "floatframe/model/gauge.hpp"
#include "floatframe/model/system_motion.hpp"
#include "floatframe/stepping/stepper.hpp"
#include "support/coordinates.hpp"
#include "support/fe_parts.hpp"
#include "support/iltis.hpp"
#include "support/stressed_part.hpp"

namespace floatframe::test {
namespace {

/// As in examples/iltis_solid/front_suspension.yaml.
StressedPart front_arm() {
  FeModel model = read_fe_file(FLOATFRAME_EXAMPLES "/iltis_solid/front_arm.msh.gz");
  to_si(model, *find_unit_system("mm-t-s"));
  model.materials = {{.young = 2e11, .poisson = 0.3, .density = 7850.0}};
  for (FeElement& e : model.elements) e.material = 0;
  PartOptions options;
  options.interfaces = {bore("HINGE", Vec3::Zero()), bore("BALL", Vec3(0, 0.313, -0.073)),
                        bore("SHOCK", Vec3(0.075, 0.241, -0.061))};
  options.interfaces[1].mask = options.interfaces[2].mask = 7u;
  options.reference = {BodyReference::Kind::node, "HINGE"};
  options.modes = 4;
  return {std::move(model), options};
}

/// What decides the stress of a body at an instant.
struct Instant {
  double time = 0.0, largest = 0.0;
  Vec3 w = Vec3::Zero();
  BodyLoadCoefficients c = BodyLoadCoefficients::Zero();
  VecX y, v, a;
};

Instant hardest_moment(const Model& model, int body, const BodyStress& stress) {
  const SimulationDescription options = with(model.simulation, Coordinates::relative);
  Stepper steps(model, options, {.duration = 8.0});
  std::vector<double> row(model.outputs.size() + 1);
  Instant found;
  for (int k = 0; steps.state().t < 7.9995; ++k) {
    if (!steps.advance()) {
      ADD_FAILURE() << "the run fails at " << steps.state().t;
      break;
    }
    if (k % 10 != 0) continue;
    steps.sample(row.data());
    const SystemMotion& motion = steps.formulation().motion({.accelerations = true});
    const BodyKinematics& b = motion.body(body);
    Instant now;
    now.time = steps.state().t;
    now.w = b.R_WB.transpose() * b.w_WB;
    now.c = body_load_coefficients(motion, body);
    now.y = b.y;
    now.v = b.yd;
    now.a = b.ydd;
    const VecX s = stress.modes * now.y;
    for (std::size_t p = 0; p < stress.places.size(); ++p)
      if (!stress.places[p].doubtful)
        now.largest =
            std::max(now.largest, von_mises(s.segment<6>(6 * static_cast<Eigen::Index>(p))));
    if (now.largest > found.largest) found = now;
  }
  return found;
}

/// All loads of the instant, those of Coriolis among them.
VecX loads_of(const StressedPart& part, const Instant& now) {
  VecX c(body_load_cases + now.a.size());
  c << now.c, -now.a;
  VecX f = part.F * c;
  const VecX u = part.X * now.v;
  VecX coriolis = VecX::Zero(u.size());
  for (int node = 0; node < part.model.nodes(); ++node) {
    const int row = part.system.first[node];
    if (row < 0) continue;
    coriolis.segment<3>(row) = 2.0 * now.w.cross(Vec3(u.segment<3>(row)));
  }
  f -= part.system.M * coriolis;
  return f;
}

TEST(SolidArmStress, AtItsHardestMoment) {
  ::setenv("FLOATFRAME_CACHE", "off", 1);
  const StressedPart arm = front_arm();
  ModelDescription d = read_model(FLOATFRAME_EXAMPLES "/iltis_solid/iltis_solid.yaml", {});
  int body = -1;
  for (std::size_t k = 0; k < d.bodies.size(); ++k)
    if (d.bodies[k].name == "front_left.arm") {
      d.bodies[k].kind = arm.reduced.body;
      body = static_cast<int>(k);
    }
  ASSERT_GE(body, 0);
  const Model model = build_model(d);
  const BodyStress& stress = arm.stress();
  const Instant now = hardest_moment(model, body, stress);

  VecX place = VecX::Zero(arm.system.size());
  const std::vector<int> held = arm.rows_of({0, 1, 2});
  for (const int row : held) place(row) = arm.X.row(row).dot(now.y);
  const VecX direct = arm.stress_of(arm.solve(loads_of(arm, now), held, place));
  VecX c(body_load_cases + now.a.size());
  c << now.c, -now.a;
  const VecX modes = stress.modes * now.y, all = modes + stress.loads * c;
  double largest = 0.0, by_modes = 0.0, with_loads = 0.0;
  for (std::size_t k = 0; k < stress.places.size(); ++k) {
    if (stress.places[k].doubtful) continue;
    const Eigen::Index row = 6 * static_cast<Eigen::Index>(k);
    const double exact = von_mises(direct.segment<6>(row));
    largest = std::max(largest, exact);
    by_modes = std::max(by_modes, std::abs(von_mises(modes.segment<6>(row)) - exact));
    with_loads = std::max(with_loads, std::abs(von_mises(all.segment<6>(row)) - exact));
  }
  figure("hardest moment of the solid arm [s]", now.time);
  figure("largest von Mises stress there, direct [MPa]", 1e-6 * largest);
  figure("error of the modes alone, of the largest", by_modes / largest);
  figure("error with the loads of the body, of the largest", with_loads / largest);
  EXPECT_LT(with_loads, 0.03 * largest);
  EXPECT_LT(with_loads, by_modes);
}

}  // namespace
}  // namespace floatframe::test
