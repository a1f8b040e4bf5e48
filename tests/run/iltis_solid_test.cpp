// The Iltis with solid front arms against the one with bars: masses, equilibrium, the drive over
// ramp and plateau; flexible, rigid, both formulations.
#include <cstdlib>

#include "floatframe/body/with_modes.hpp"
#include "support/completed_run.hpp"
#include "support/iltis.hpp"

namespace floatframe::test {
namespace {

/// Nothing is kept beside the example.
ModelDescription solid(const std::vector<ParameterOverride>& overrides = {}) {
  ::setenv("FLOATFRAME_CACHE", "off", 1);
  return read_model(FLOATFRAME_EXAMPLES "/iltis_solid/iltis_solid.yaml", overrides);
}

/// The reduction is made once for all tests.
const Model& solid_model() {
  static const Model model = build_model(solid());
  return model;
}

double total_mass(const Model& model) {
  double mass = 0.0;
  for (const Body& b : model.bodies) mass += b.data->invariants.m;
  return mass;
}

double tyre_load(const StaticsResult& s) {
  double load = 0.0;
  for (const char* corner : {"front_left", "front_right", "rear_left", "rear_right"})
    load += force_of(s, std::string(corner) + ".tyre").force;
  return load;
}

TEST(IltisSolid, MassAndEquilibriumFollowTheMassOfTheArms) {
  const Model bars = build_model(iltis());
  const Model& model = solid_model();
  // 6.492 kg of forged steel instead of 6 kg of bars, twice.
  const double more = total_mass(model) - total_mass(bars);
  figure("mass of the vehicle, solid - bars [kg]", more);
  EXPECT_NEAR(more, 2 * (6.492 - 6.0), 2e-3);
  const StaticsResult a = statics(bars), b = statics(model);
  figure("tyre loads, solid - bars [N]", tyre_load(b) - tyre_load(a));
  EXPECT_NEAR(tyre_load(b) - tyre_load(a), 9.81 * more, 1e-4);
  const double shock =
      force_of(b, "front_left.shock").length - force_of(a, "front_left.shock").length;
  figure("front shock absorber, solid - bars [m]", shock);
  EXPECT_LT(std::abs(shock), 2e-4);
}

TEST(IltisSolid, DrivesLikeTheBarModel) {
  const Model bars = build_model(iltis());
  ModelDescription rigid_arms = solid();
  for (BodyDescription& b : rigid_arms.bodies) {
    if (b.name.ends_with("arm") && b.name.starts_with("front"))
      b.kind = with_modes(std::get<FlexibleBody>(b.kind), {});
  }
  const Model rigid = build_model(rigid_arms);
  for (const Coordinates coordinates : both_coordinates) {
    SimulationDescription s = solid_model().simulation;
    s.coordinates = coordinates;
    const RunResult reference = run(bars, s);
    for (const Model* model : {&solid_model(), &rigid}) {
      const RunResult r = completed_run(*model, s);
      EXPECT_EQ(r.summary.substeps, 0);
      EXPECT_LT(r.summary.max_position_violation, 1e-9);
      EXPECT_LT(r.summary.max_velocity_violation, 1e-8);
      // Up to the stairs the heavier arm shows and nothing else; after them small differences grow.
      for (const char* name : {"chassis.z", "front_left.wheel.z", "rear_left.wheel.z"}) {
        const double d = difference(reference.table, r.table, name, 3.5);
        figure(std::string(name) + ", solid - bars to 3.5 s [m]", d);
        EXPECT_LT(d, 1e-3) << name;
      }
      EXPECT_NEAR(maximum(r.table, "chassis.z").value, 2.59, 0.05);
      EXPECT_NEAR(minimum(r.table, "chassis.z").value, 0.48, 0.1);
    }
  }
}

}  // namespace
}  // namespace floatframe::test
