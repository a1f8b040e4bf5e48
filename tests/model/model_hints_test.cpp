// Hints: each kind of unusual number is said once and by name, what is right says nothing, and the
// bending stiffnesses of bars are those of their sections in the directions of space.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/model_file/model_reader.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

std::vector<std::string> hints_of(const ModelDescription& d) { return build_model(d).hints.notes; }
std::vector<std::string> hints_of_file(const std::string& name,
                                       const std::vector<ParameterOverride>& set = {}) {
  return hints_of(read_model(FLOATFRAME_TEST_DATA "/hints/" + name + ".yaml", set));
}

using Texts = std::vector<std::string>;

/// A cantilever of one bar.
std::string cantilever(const std::string& material, const std::string& section,
                       const std::string& end = "[2, 0, 0]", const std::string& more = "") {
  return "points: {l: [0, 0, 0], r: " + end +
         "}\n"
         "bodies: {beam: {flexible: {material: " +
         material + ", bars: {a: {from: l, to: r, elements: 4, section: " + section + more +
         "}}, clamped: [l], static_modes: [{point: r, dofs: [x, y, z]}], mass_model: hermite}}}\n"
         "joints: {l: {type: weld, child: beam, at: l}}\n";
}

TEST(Hints, UnitsOfMaterials) {
  EXPECT_EQ(hints_of_file("bars_in_millimetres"),
            Texts{"body 'beam': its material has a Young's modulus of 2.1e+05 Pa and a density of "
                  "7.85e-09 kg/m3, which is unusual; it may be in mm-t-s: 2.1e+11 Pa, 7850 kg/m3"});
  EXPECT_EQ(hints_of_file("density_in_g_per_cm3"),
            Texts{"body 'beam': its material has a Young's modulus of 2.1e+11 Pa and a density of "
                  "7.85 kg/m3, which is unusual; the density may be in g/cm3: 2.1e+11 Pa, 7850 "
                  "kg/m3"});
  struct Meant {
    const char *material, *units;
  };
  for (const Meant& m : {Meant{"{young: 210, poisson: 0.3, density: 7.85e-6}", "mm-kg-ms: 2.1e+11"},
                         Meant{"{young: 2.1e12, poisson: 0.3, density: 7.85}", "cm-g-s: 2.1e+11"},
                         Meant{"{young: 3e7, poisson: 0.3, density: 7.3e-4}", "in-lbf-s: 2.06"},
                         Meant{"{young: 2.1e5, poisson: 0.3, density: 7850}", "in MPa: 2.1e+11"},
                         Meant{"{young: 210, poisson: 0.3, density: 7850}", "in GPa: 2.1e+11"},
                         Meant{"{young: 70, poisson: 0.3, density: 2.7}", "GPa and g/cm3: 7e+10"},
                         Meant{"{young: 7e4, poisson: 0.3, density: 2.7}", "MPa and g/cm3: 7e+10"},
                         Meant{"{young: 1e3, poisson: 0.3, density: 1e6}", "is in Pa and kg/m3"}}) {
    const Texts hints = hints_of(description_of(cantilever(m.material, "{round: 0.05}")));
    ASSERT_EQ(hints.size(), 1u) << m.material;
    EXPECT_NE(hints[0].find(m.units), std::string::npos) << hints[0];
  }
}

TEST(Hints, NothingIsUnusualAboutWhatOneBuildsOf) {
  for (const char* material :
       {"{young: 2.1e11, poisson: 0.3, density: 7850}",
        "{young: 7e10, poisson: 0.3, density: 2700}", "{young: 1e7, poisson: 0.49, density: 1100}",
        "{young: 1.05e12, poisson: 0.1, density: 3520}",
        "{young: 1e10, poisson: 0.3, density: 500}",
        "{young: 4.1e11, poisson: 0.28, density: 19300}",
        "{young: 3e9, poisson: 0.35, density: 1200}", "{young: 2e5, poisson: 0.3, density: 30}",
        "{young: 3e11, poisson: 0.06, density: 1850}"})
    for (const char* section :
         {"{round: 0.001}", "{tube: [0.5, 0.49]}", "{rectangle: [0.002, 1.9]}",
          "{area: 1e-3, Iy: 1e-6, Iz: 2e-6, J: 1e-6}"})
      EXPECT_EQ(hints_of(description_of(cantilever(material, section))), Texts{})
          << material << section;
}

TEST(Hints, UnitsOfPlacesAndSections) {
  EXPECT_EQ(
      hints_of_file("section_in_millimetres"),
      Texts{"body 'beam': the section of its bar 'a' measures 60 m, more than the body, whose "
            "points are 2 m apart, which is unusual; it may be in mm: 0.06 m"});
  const Texts all = hints_of_file("millimetres");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_NE(all[0].find("it may be in mm-t-s"), std::string::npos) << all[0];
  EXPECT_EQ(all[1],
            "body 'beam': its points are up to 2000 m apart, which is unusual; they may be in mm: "
            "2 m");
  // Constants in cm2 and cm4.
  const Texts constants = hints_of(description_of(cantilever(
      "{young: 2.1e11, poisson: 0.3, density: 7850}", "{area: 10, Iy: 100, Iz: 100, J: 200}")));
  ASSERT_EQ(constants.size(), 1u);
  EXPECT_NE(constants[0].find("section of its bar 'a' measures 3.16"), std::string::npos);
}

TEST(Hints, AnglesInDegrees) {
  const Texts hints = hints_of_file("degrees");
  ASSERT_EQ(hints.size(), 6u);
  EXPECT_EQ(hints[0],
            "body 'tool': an angle of its orientation of 90 rad is 14.3 turns; angles are in "
            "radians (90 degrees are 1.571 rad)");
  EXPECT_EQ(hints[1],
            "joint 'shoulder': its position of 30 rad is 4.77 turns; angles are in radians (30 "
            "degrees are 0.5236 rad)");
  EXPECT_EQ(hints[2].substr(0, 64),
            "joint 'elbow': an entry of its motion of 45 rad is 7.16 turns; a");
  EXPECT_EQ(hints[3].substr(0, 60), "joint 'wrist': the amplitude of its motion of 20 rad is 3.18");
  EXPECT_EQ(hints[4].substr(0, 58), "force 'motor': the nearest entry of its spring of -90 rad ");
  EXPECT_EQ(hints[5].substr(0, 38), "force 'motor': its target of 45 rad is");
}

// A shaft that turns, a winch, a saturated motor: many turns are meant there.
TEST(Hints, TurnsThatAreMeant) {
  EXPECT_EQ(hints_of(description_of(R"(
points: {o: [0, 0, 0], e: [1, 0, 0]}
bodies:
  a: {rigid: {mass: 1, centre_of_mass: o, inertia: [1, 1, 1]}, orientation: [0, 0, -6.2832]}
  b: {rigid: {mass: 1, centre_of_mass: o, inertia: [1, 1, 1]}}
  c: {rigid: {mass: 1, centre_of_mass: o, inertia: [1, 1, 1]}}
  d: {rigid: {mass: 1, centre_of_mass: e, inertia: [1, 1, 1]}}
joints:
  a: {type: revolute, child: a, at: o, axis: z, motion: {polynomial: [0, 30, 5]}}
  b: {type: revolute, child: b, at: o, axis: z,
      motion: {table: [[0, 0], [1, 12.5], [2, 31.4], [3, 62.8]]}}
  c: {type: revolute, child: c, at: o, axis: z, position: 6.2, velocity: 300}
  d: {type: prismatic, child: d, at: e, axis: z, position: 30}
forces:
  motor:
    type: joint_spring
    joint: c
    spring: {table: [[-10, -5], [-0.08, -5], [0.08, 5], [10, 5]]}
    damper: 1
    target: {polynomial: [0, 30]}
)")),
            Texts{});
  const auto motion = [](const std::string& table) {
    return hints_of(description_of(
        "points: {o: [0, 0, 0]}\nbodies: {a: {rigid: {mass: 1, centre_of_mass: o, inertia: [1, 1, "
        "1]}}}\njoints: {a: {type: revolute, child: a, at: o, axis: z, motion: {table: " +
        table + "}}}\n"));
  };
  // A motor that runs up or turns evenly, in whole numbers; a quarter turn after the other is not.
  EXPECT_EQ(motion("[[0, 0], [1, 50], [2, 150], [10, 950]]"), Texts{});
  EXPECT_EQ(motion("[[0, 0], [1, 10], [2, 20], [3, 30]]"), Texts{});
  EXPECT_EQ(motion("[[0, 0], [1, 90], [2, 180]]").size(), 1u);
}

TEST(Hints, InertiaThatWasForgotten) {
  EXPECT_EQ(hints_of_file("no_inertia"),
            Texts{"body 'm': it has no inertia: the key 'inertia' is missing, and the body can "
                  "turn; inertia: [Ixx, Iyy, Izz] [kg m2], zeros for a point mass"});
  const auto bodies = [](const std::string& rigid, const std::string& joint) {
    return hints_of(description_of(
        "points: {o: [0, 0, 0], e: [1, 0, 0]}\nbodies: {m: {rigid: " + rigid +
        "}, n: {rigid: " + rigid + "}}\njoints: {j: {type: " + joint +
        ", child: m, at: o}, k: {type: " + joint + ", parent: m, child: n, at: e}}\n"));
  };
  const Texts both = bodies("{mass: 1, centre_of_mass: e}", "spherical");
  ASSERT_EQ(both.size(), 1u);
  EXPECT_EQ(both[0].substr(0, 36), "body 'm' (and 1 more): it has no ine");
  // Without mass, with zeros that are written, where nothing turns.
  EXPECT_EQ(bodies("{mass: 0, centre_of_mass: e}", "spherical"), Texts{});
  EXPECT_EQ(bodies("{mass: 1, centre_of_mass: e, inertia: [0, 0, 0]}", "spherical"), Texts{});
  EXPECT_EQ(bodies("{mass: 1, centre_of_mass: e}", "weld"), Texts{});
  // A mass on a disc.
  const auto on_disc = [](const char* inertia) {
    return hints_of(
        description_of(std::string("points: {o: [0, 0, 0], e: [1, 0, 0]}\nbodies:\n"
                                   "  disc: {rigid: {mass: 1, centre_of_mass: o, inertia: ") +
                       inertia +
                       "}}\n  mass: {rigid: {mass: 0.1, centre_of_mass: e}}\njoints:\n"
                       "  spin: {type: revolute, child: disc, at: o, axis: z}\n"
                       "  weld: {type: weld, parent: disc, child: mass, at: e}\n"));
  };
  EXPECT_EQ(on_disc("[1, 1, 2]"), Texts{});
  EXPECT_EQ(on_disc("[0, 0, 0]").size(), 1u);
}

TEST(Hints, ClampsThatNothingHolds) {
  EXPECT_EQ(
      hints_of_file("section_on_edge"),
      Texts{"body 'beam': it is clamped at 'r' (y, z), where no joint, rod or force acts: the "
            "modes are those of a body that is held there, and nothing holds it"});
  // Held by a rod: bars_in_millimetres has nothing to say of it. A body that floats is clamped
  // somewhere.
  const std::string text =
      cantilever("{young: 2.1e11, poisson: 0.3, density: 7850}", "{round: 0.05}");
  const std::string bodies = text.substr(0, text.find("joints:"));
  EXPECT_EQ(hints_of(description_of(bodies)), Texts{});
  EXPECT_EQ(
      hints_of(description_of(bodies + "joints: {l: {type: weld, child: beam, at: r}}\n")).size(),
      1u);
}

TEST(Bending, StiffnessesWithTheirDirections) {
  // Width 0.05 along local y: without a reference upright.
  const Model edge = build_model(read_model(FLOATFRAME_TEST_DATA "/hints/section_on_edge.yaml"));
  ASSERT_EQ(edge.hints.bending.size(), 1u);
  const BarBending& b = edge.hints.bending[0];
  EXPECT_EQ(b.bars, (Texts{"a", "b"}));
  EXPECT_FALSE(b.alike());
  const double E = 2.1e11;
  EXPECT_NEAR(b.stiffness[0], E * 0.02 * std::pow(0.05, 3) / 12.0, 1e-9 * b.stiffness[0]);
  EXPECT_NEAR(b.stiffness[1], E * 0.05 * std::pow(0.02, 3) / 12.0, 1e-9 * b.stiffness[0]);
  EXPECT_LT((b.direction[0] - Vec3::UnitZ()).norm() + (b.direction[1] - Vec3::UnitY()).norm(),
            1e-12);
  const Model round =
      model_of(cantilever("{young: 2.1e11, poisson: 0.3, density: 7850}", "{tube: [0.05, 0.04]}"));
  ASSERT_EQ(round.hints.bending.size(), 1u);
  EXPECT_TRUE(round.hints.bending[0].alike());
}

// The deflections of cantilevers in any direction under loads along both axes are those that the
// table promises, F L^3 / (3 E I), also of a bar that is turned and of its mirror image.
TEST(Bending, DirectionsAreThoseOfTheModes) {
  for (const char* end : {"[2, 0, 0]", "[0.6, -1.2, 0.9]", "[0, 0, 1.5]"}) {
    const Model model =
        model_of(cantilever("{young: 2.1e11, poisson: 0.3, density: 7850}",
                            "{rectangle: [0.02, 0.05]}", end, ", reference: [0.3, 0.8, -0.2]"));
    const FlexibleBody& body = *model.bodies[0].data;
    const BarBending& b = model.hints.bending.at(0);
    const ModalNode& tip = body.nodes.back();
    const double L = (body.nodes.back().p - body.nodes.front().p).norm();
    const MatX compliance = tip.X * body.K.inverse() * tip.X.transpose();
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec3 d = model.bodies[0].X_WB.R.transpose() * b.direction[k];
      EXPECT_NEAR(d.dot(compliance * d), L * L * L / (3.0 * b.stiffness[k]),
                  1e-8 * L * L * L / b.stiffness[k])
          << end << k;
    }
  }
}

}  // namespace
}  // namespace floatframe::test
