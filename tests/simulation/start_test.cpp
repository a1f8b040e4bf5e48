// The state a run starts from where that is delicate: nothing left to move, singular mass matrices,
// start values that do not fit, numbers that overflow.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/io/model_reader.hpp"
#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/runner.hpp"
#include "simulation/figures.hpp"

namespace floatframe::test {
namespace {

Model model_of(const std::string& text) {
  const std::string path =
      ::testing::TempDir() + "start_test_" + std::to_string(getpid()) + ".yaml";
  std::ofstream(path) << "floatframe: 1\n" << text;
  return build_model(read_model(path));
}

RunResult run_of(const Model& model, const Combination& c) {
  const SimulationDescription& s = model.simulation;
  return run(model, with(s, c, s.step, s.duration));
}

template <class Function>
std::string message_of(Function&& f) {
  try {
    f();
  } catch (const std::exception& e) {
    std::printf("[ message ] %s\n", e.what());
    return e.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

void expect_in(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

/// Start accelerations in the absolute formulation.
struct AbsoluteStart {
  explicit AbsoluteStart(const Model& model) : f(model, model.simulation.inertia) {
    RelativeFormulation tree(model, model.simulation.inertia);
    const State start = relative_start(tree, Start::given);
    f.start_from(tree, start.q, start.v, state.q, state.v);
    start_accelerations(f, state, default_penalty_mass(model));
  }
  /// Force and torque of the joint's constraints on its child, about the child's marker.
  Vec6 reaction(int joint) const {
    Vec6 sum = Vec6::Zero();
    for (std::size_t k = 0; k < f.parts().size(); ++k) {
      const ConstraintPart& p = f.parts()[k];
      ConstraintRow rows[3];
      evaluate_constraint(p, f.marker(p.a), f.marker(p.b), 0.0, rows);
      if (p.owner.kind != ConstraintOwner::Kind::joint || p.owner.index != joint) continue;
      for (int r = 0; r < p.rows(); ++r) {
        const double lambda = state.lambda[f.part_offset(k) + r];
        sum.head<3>() -= lambda * rows[r].gradient.Fb;
        sum.tail<3>() -= lambda * rows[r].gradient.Tb;
      }
    }
    return sum;
  }
  AbsoluteFormulation f;
  State state;
};

// ------------------------------------------------------------------------------- nothing is free

TEST(NothingFree, PointMassOnADrivenHinge) {
  const Model model = model_of(R"(
bodies: {ball: {position: [1, 0, 0], rigid: {mass: 2}}}
joints:
  arm: {type: revolute, child: ball, at: [0, 0, 0], axis: y, motion: {polynomial: [0.3, 2, 1.5]}}
outputs:
  x: {position: ball, axis: x}
  a: {acceleration: ball}
simulation: {step: 0.001, duration: 0.2}
)");
  for (const Combination& c : combinations) {
    const RunResult r = run_of(model, c);
    ASSERT_EQ(r.summary.status, "completed") << c.name();
    for (const std::size_t row : {std::size_t{0}, r.table.rows() - 1}) {
      const double t = r.table.at(row, 0), angle = 0.3 + 2 * t + 1.5 * t * t, w = 2 + 3 * t;
      const double s = std::sin(angle), k = std::cos(angle);
      EXPECT_NEAR(r.table.at(row, column(r.table, "x")), k, 1e-8) << c.name();
      EXPECT_NEAR(r.table.at(row, column(r.table, "a.x")), -s * 3.0 - k * w * w, 1e-5) << c.name();
      EXPECT_NEAR(r.table.at(row, column(r.table, "a.z")), -k * 3.0 + s * w * w, 1e-5) << c.name();
    }
  }
  // m (a - g) at the start, and the moment of it about the hinge: 2 kg x 1 m x 3 rad/s2 and weight.
  const AbsoluteStart start(model);
  const double s = std::sin(0.3), k = std::cos(0.3);
  const Vec6 reaction = start.reaction(0);
  EXPECT_NEAR(reaction[0], 2.0 * (-s * 3.0 - k * 4.0), 1e-9);
  EXPECT_NEAR(reaction[1], 0.0, 1e-9);
  EXPECT_NEAR(reaction[2], 2.0 * (-k * 3.0 + s * 4.0 + 9.81), 1e-9);
  EXPECT_NEAR(reaction[4], 2.0 * 3.0 - 2.0 * 9.81 * k, 1e-9);
}

TEST(NothingFree, DrivenParallelCranksWithoutSpinInertia) {
  const Model model = model_of(R"(
bodies:
  crank: {position: [0, 0, 0], rigid: {mass: 1, centre_of_mass: [0, 0, 0.1], inertia: [0, .001, .001]}}
  coupler: {position: [0, 0, 0.2], rigid: {mass: 1, centre_of_mass: [0.25, 0, 0.2], inertia: [0, .001, .001]}}
  rocker: {position: [0.5, 0, 0], rigid: {mass: 1, centre_of_mass: [0.5, 0, 0.1], inertia: [0, .001, .001]}}
joints:
  a: {type: revolute, child: crank, at: [0, 0, 0], axis: y, motion: {polynomial: [0, 2, 1]}}
  b: {type: revolute, parent: crank, child: coupler, at: [0, 0, 0.2], axis: y}
  c: {type: revolute, parent: coupler, child: rocker, at: [0.5, 0, 0.2], axis: y}
  d: {type: revolute, child: rocker, at: [0.5, 0, 0], axis: y}
outputs: {a: {acceleration: coupler}}
simulation: {step: 0.001, duration: 0.1}
)");
  for (const Combination& c : combinations) {
    const RunResult r = run_of(model, c);
    ASSERT_EQ(r.summary.status, "completed") << c.name();
    const std::size_t last = r.table.rows() - 1;
    for (const std::size_t row : {std::size_t{0}, last}) {
      const double t = r.table.at(row, 0), angle = 2 * t + t * t, w = 2 + 2 * t;
      const double s = 0.2 * std::sin(angle), k = 0.2 * std::cos(angle);
      EXPECT_NEAR(r.table.at(row, column(r.table, "a.x")), k * 2.0 - s * w * w, 1e-5) << c.name();
      EXPECT_NEAR(r.table.at(row, column(r.table, "a.z")), -s * 2.0 - k * w * w, 1e-5) << c.name();
    }
  }
}

TEST(NothingFree, AccelerationsOfManyMillions) {
  const Model model = model_of(R"(
bodies:
  lever: {rigid: {mass: 2, centre_of_mass: [0.3, 0, 0], inertia: [0.001, 0.06, 0.06]}}
joints:
  hinge: {type: revolute, child: lever, at: [0, 0, 0], axis: y, motion: {polynomial: [0, 0, 1e7]}}
outputs: {end: {acceleration: {body: lever, at: [0.6, 0, 0]}}, angle: {joint_position: hinge}}
simulation: {step: 1e-5, duration: 1e-3}
)");
  for (const Combination& c : combinations) {
    const RunResult r = run_of(model, c);
    ASSERT_EQ(r.summary.status, "completed") << c.name() << r.summary.message;
    EXPECT_NEAR(r.table.at(0, column(r.table, "end.z")), -0.6 * 2e7, 1.0) << c.name();
    EXPECT_NEAR(r.table.at(r.table.rows() - 1, column(r.table, "angle")), 10.0, 1e-6) << c.name();
  }
  const AbsoluteStart start(model);
  const Vec6 reaction = start.reaction(0);
  EXPECT_NEAR(reaction[2], 2.0 * (9.81 - 0.3 * 2e7), 1e-3);
  EXPECT_NEAR(reaction[4], (0.06 + 2.0 * 0.09) * 2e7 - 2.0 * 9.81 * 0.3, 1e-2);
}

TEST(NothingFree, EverythingWelded) {
  const Model model = model_of(R"(
bodies:
  stone: {position: [1, 0, 0], rigid: {mass: 2}}
  hat: {position: [1, 0, 1], rigid: {mass: 3}}
joints:
  foot: {type: weld, child: stone, at: [0, 0, 0]}
  glue: {type: weld, parent: stone, child: hat, at: [1, 0, 1]}
outputs: {z: {position: hat, axis: z}}
simulation: {step: 0.01, duration: 0.1}
)");
  for (const Combination& c : combinations) {
    const RunResult r = run_of(model, c);
    ASSERT_EQ(r.summary.status, "completed") << c.name() << r.summary.message;
    EXPECT_NEAR(r.table.at(r.table.rows() - 1, 1), 1.0, 1e-12) << c.name();
    SimulationDescription s = with(model.simulation, c, 0.01, 0.1);
    s.start = Start::equilibrium;
    EXPECT_EQ(run(model, s).summary.status, "completed") << c.name();
  }
  EXPECT_EQ(count(model).degrees_of_freedom, 0);
  const StaticsResult statics_result = statics(model);
  EXPECT_NEAR(statics_result.joints[0].force.z(), 5.0 * 9.81, 1e-9);
  EXPECT_NEAR(statics_result.joints[1].force.z(), 3.0 * 9.81, 1e-9);
  EXPECT_NEAR(AbsoluteStart(model).reaction(0)[2], 5.0 * 9.81, 1e-9);
}

// ------------------------------------------------------------------ bars without inertia of spin

// Round-off of such a bar passed for mass in one of the formulations.
const char* const spinning_bars[] = {
    R"(
points: {g: [0.138, 0.605, -0.874], e: [0.441, 1.277, -0.983], w: [0.17, 0.803, -1.266]}
bodies:
  bar:
    position: g
    flexible:
      material: {young: 2e11, poisson: 0.3, density: 7800}
      bars: {bar: {from: g, to: e, elements: 4, section: {round: 0.02}}}
      clamped: [g]
      static_modes: [{point: e, dofs: [y, z]}]
  weight: {position: w, rigid: {mass: 8.5, inertia: [1, 1, 1]}}
joints:
  top: {type: spherical, child: bar, at: g}
  low: {type: spherical, parent: bar, child: weight, at: e}
)",
    R"(
points: {g: [-0.369, 0.114, 0.07], e: [-1.06, -0.445, 0.014], w: [-1.427, -0.397, -0.247]}
parameters: {m: 0.6562036026942476, x: -0.691, y: -0.559, z: -0.056}
bodies:
  bar:
    position: g
    rigid:
      mass: ${m}
      centre_of_mass: [-0.7145, -0.1655, 0.042]
      inertia: ["${m/12*(y*y+z*z)}", "${m/12*(x*x+z*z)}", "${m/12*(x*x+y*y)}", "${-m/12*x*y}", "${-m/12*x*z}", "${-m/12*y*z}"]
  weight: {position: w, rigid: {mass: 5.4, inertia: [1, 1, 1]}}
joints:
  top: {type: spherical, child: bar, at: g}
  low: {type: spherical, parent: bar, child: weight, at: e}
  pin: {type: revolute, child: weight, at: w, axis: [0.872, 0.142, -0.434]}
)",
    R"(
points: {g: [0.485, 0.091, 0.424], e: [0.32, -0.647, -0.386]}
bodies:
  bar:
    position: g
    flexible:
      material: {young: 2e11, poisson: 0.3, density: 7800}
      bars: {bar: {from: g, to: e, elements: 4, section: {round: 0.02}}}
      clamped: [g]
      static_modes: [{point: e, dofs: [y, z]}]
joints: {top: {type: spherical, child: bar, at: g}}
)"};

TEST(SpinningBars, GetTheSameSentenceInAllFormulations) {
  for (const char* text : spinning_bars) {
    const Model model = model_of(std::string(text) + "simulation: {step: 0.001, duration: 0.05}\n");
    std::string first;
    for (const Combination& c : combinations) {
      const std::string m = message_of([&] { run_of(model, c); });
      expect_in(m, "the mass matrix is singular where nothing holds it: body 'bar' can move");
      expect_in(m, "a straight bar has no inertia about its own axis");
      if (first.empty()) first = m;
      EXPECT_EQ(m, first) << c.name();
    }
    EXPECT_EQ(message_of([&] { count(model); }), first);
  }
}

TEST(SpinningBars, TwoOfThemAreBothNamed) {
  const Model model = model_of(R"(
points: {o: [0, 0, 0], e: [0.6, 0.3, 0.2], q: [1.1, -0.1, 0.2]}
bodies:
  first: {position: o, rigid: {mass: 1, centre_of_mass: [0.3, 0, 0], inertia: [0, 0.1, 0.1]}}
  second: {position: q, rigid: {mass: 1, centre_of_mass: [1.1, 0.2, 0.2], inertia: [0.1, 0, 0.1]}}
joints:
  a: {type: spherical, child: first, at: o}
  b: {type: spherical, child: second, at: q}
)");
  for (const Combination& c : combinations)
    expect_in(message_of([&] { run_of(model, c); }), "bodies 'first' and 'second' can move");
}

// Gravity has a moment about the frame of a point mass that lies elsewhere, which looks like a
// stiffness of each single rotation; but the mass can turn freely about itself.
TEST(PointMasses, TurnFreelyWhateverTheGravity) {
  for (const char* centre : {"[0.05, -0.15, 0.24]", "[-0.05, 0.15, -0.24]", "[0, 0, -0.1]"})
    for (const Combination& c : combinations) {
      const Model model = model_of(std::string(R"(
gravity: [-1.8, 4.75, -8.09]
bodies: {p: {position: [0, 0, 0], rigid: {mass: 1.57, centre_of_mass: )") +
                                   centre + R"(}}}
simulation: {step: 1e-3, duration: 0.01}
)");
      expect_in(message_of([&] { run_of(model, c); }),
                "the mass matrix is singular where nothing holds it: body 'p' can move");
    }
}

TEST(SpinningBars, ABitOfInertiaIsEnough) {
  // 1 mm thick and 1 m long: 1e-6 of the inertia across.
  const Model model = model_of(R"(
bodies:
  bar: {position: [0, 0, 0], orientation: [0.3, 0.2, 0.5], rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1e-7, 0.1, 0.1]}}
joints: {a: {type: spherical, child: bar, at: [0, 0, 0]}}
simulation: {step: 0.001, duration: 0.02}
)");
  for (const Combination& c : combinations)
    EXPECT_EQ(run_of(model, c).summary.status, "completed") << c.name();
}

// --------------------------------------------------------------------------------- start values

/// A four-bar linkage of unequal links; `extra` are keys of the joints at the ground.
std::string four_bar(const std::string& crank, const std::string& rocker,
                     const std::string& cut = "c") {
  const auto mark = [&](const char* joint) { return cut == joint ? ", cut: true" : ""; };
  return std::string(R"(
bodies:
  crank: {position: [0, 0, 0], rigid: {mass: 1, centre_of_mass: [0, 0, 0.1], inertia: [.001, .001, .001]}}
  coupler: {position: [0, 0, 0.2], rigid: {mass: 1, centre_of_mass: [0.25, 0, 0.3], inertia: [.001, .001, .001]}}
  rocker: {position: [0.5, 0, 0], rigid: {mass: 1, centre_of_mass: [0.5, 0, 0.2], inertia: [.001, .001, .001]}}
joints:
  a: {type: revolute, child: crank, at: [0, 0, 0], axis: y)") +
         crank + mark("a") + R"(}
  b: {type: revolute, parent: crank, child: coupler, at: [0, 0, 0.2], axis: y)" +
         mark("b") + R"(}
  c: {type: revolute, parent: coupler, child: rocker, at: [0.5, 0, 0.4], axis: y)" +
         mark("c") + R"(}
  d: {type: revolute, child: rocker, at: [0.5, 0, 0], axis: y)" +
         rocker + mark("d") + R"(}
outputs:
  a: {joint_position: a}
  d: {joint_position: d}
  a.rate: {joint_velocity: a}
  d.rate: {joint_velocity: d}
simulation: {step: 0.001, duration: 0.01}
)";
}

TEST(StartValues, GivenOnesThatDoNotFitAreReported) {
  const Model model =
      model_of(four_bar(", position: 0.3, velocity: 1", ", position: 0.3, velocity: 1"));
  for (const Combination& c : combinations) {
    const RunResult r = run_of(model, c);
    const StartReport& start = r.summary.start;
    ASSERT_EQ(start.changes.size(), 4u) << c.name();
    EXPECT_EQ(start.changes[0].owner, "joint 'a'");
    EXPECT_EQ(start.changes[0].quantity, "angle");
    EXPECT_EQ(start.changes[0].unit, "rad");
    EXPECT_EQ(start.changes[3].owner, "joint 'd'");
    EXPECT_TRUE(start.changes[3].rate);
    EXPECT_EQ(start.changes[3].unit, "rad/s");
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(start.changes[k].given, k < 2 ? 0.3 : 1.0);
      // What the outputs show at the start.
      EXPECT_NEAR(start.changes[k].used, r.table.at(0, k + 1), 1e-9) << c.name() << k;
    }
    ASSERT_GE(start.notes.size(), 4u);
    expect_in(start.notes[0],
              "joint 'a': closing the loops changed the angle from the 0.3 rad given to ");
    expect_in(start.notes[3],
              "joint 'd': closing the loops changed the rate of the angle from the 1 rad/s");
  }
  EXPECT_EQ(count(model).start.changes.size(), 4u);
}

TEST(StartValues, OnesThatFitAreNot) {
  const Model model = model_of(four_bar(", position: 0.3, velocity: 1", ""));
  const RunResult r = run_of(model, combinations[0]);
  EXPECT_TRUE(r.summary.start.changes.empty());
  EXPECT_NEAR(r.table.at(0, 1), 0.3, 1e-12);
  EXPECT_NEAR(r.table.at(0, 3), 1.0, 1e-12);
}

TEST(StartValues, CountWhereverTheLoopIsCut) {
  // The value of a joint that happens to be cut was forgotten.
  for (const char* cut : {"a", "b", "c", "d"}) {
    const Model model = model_of(four_bar(", position: 0.3, velocity: 1", "", cut));
    for (const Combination& c : combinations) {
      const RunResult r = run_of(model, c);
      EXPECT_TRUE(r.summary.start.changes.empty()) << cut << c.name();
      EXPECT_NEAR(r.table.at(0, 1), 0.3, 1e-9) << cut << c.name();
      EXPECT_NEAR(r.table.at(0, 3), 1.0, 1e-9) << cut << c.name();
    }
  }
}

TEST(StartValues, KeptOnesDoNotMove) {
  for (const char* cut : {"a", "c", "d"}) {
    const Model model = model_of(
        four_bar(", position: 0.3, velocity: 1, keep: true", ", position: 0.3, velocity: 1", cut));
    const RunResult r = run_of(model, combinations[0]);
    EXPECT_NEAR(r.table.at(0, 1), 0.3, 1e-9) << cut;
    EXPECT_NEAR(r.table.at(0, 3), 1.0, 1e-9) << cut;
    ASSERT_EQ(r.summary.start.changes.size(), 2u) << cut;
    EXPECT_EQ(r.summary.start.changes[0].owner, "joint 'd'");
    EXPECT_TRUE(r.summary.start.changes[1].rate);
  }
}

TEST(StartValues, KeptOnesThatCannotBeHeldAreNamed) {
  for (const char* cut : {"a", "c"}) {
    const Model positions =
        model_of(four_bar(", position: 0.3, keep: true", ", position: 0.3, keep: true", cut));
    expect_in(message_of([&] { run_of(positions, combinations[0]); }),
              "cannot be assembled while joints 'a' and 'd' keep their start values (keep: true)");
    const Model rates =
        model_of(four_bar(", velocity: 1, keep: true", ", velocity: 1, keep: true", cut));
    expect_in(message_of([&] { run_of(rates, combinations[0]); }),
              "the start velocities do not fit while joints 'a' and 'd' keep their start values");
  }
}

// ------------------------------------------------------------------------- what a sentence blames

TEST(Overflow, IsNotCalledASingularMatrix) {
  const char* const text = R"(
bodies: {b: {position: [0, 0, 0], rigid: {mass: MASS, centre_of_mass: [0.5, 0.1, 0.2], inertia: [MASS, MASS, MASS]}}}
joints: {h: {type: revolute, child: b, at: [0, 0, 0], axis: y}}
)";
  const auto with_mass = [&](const std::string& mass) {
    std::string t = text;
    for (std::size_t at = t.find("MASS"); at != std::string::npos; at = t.find("MASS"))
      t.replace(at, 4, mass);
    return t;
  };
  for (const std::string& t : {with_mass("1e308"), with_mass("1") + "gravity: [0, 0, -1e300]\n"}) {
    const Model model = model_of(t);
    for (const Combination& c : combinations)
      expect_in(message_of([&] { run_of(model, c); }), "the numbers of the model overflow: ");
    expect_in(message_of([&] { statics(model); }), "the numbers of the model overflow: ");
    expect_in(message_of([&] { count(model); }), "the numbers of the model overflow: ");
  }
}

TEST(Overflow, LongAxesAreAxes) {
  for (const char* axis : {"[1e300, 1e300, 0]", "[1e-300, 1e-300, 0]"}) {
    const std::string head =
        "bodies: {b: {position: [0, 0, 0], rigid: {mass: 1, centre_of_mass: "
        "[0.5, 0.1, 0.2], inertia: [1, 1, 1]}}}\n";
    const auto angle = [&](const std::string& direction) {
      const Model model = model_of(
          head + "joints: {h: {type: revolute, child: b, at: [0, 0, 0], axis: " + direction +
          "}}\n" + "outputs: {h: {joint_position: h}}\nsimulation: {step: 0.01, duration: 0.5}\n");
      const RunResult r = run_of(model, combinations[0]);
      return r.table.at(r.table.rows() - 1, 1);
    };
    EXPECT_NEAR(angle(axis), angle("[1, 1, 0]"), 1e-12);
  }
}

TEST(Tolerances, BelowRoundingAreBlamedThemselves) {
  const Model model = model_of(R"(
bodies: {b: {position: [0, 0, 0], rigid: {mass: 1, centre_of_mass: [0.5, 0.1, 0.2], inertia: [1, 1, 1]}}}
joints: {h: {type: revolute, child: b, at: [0, 0, 0], axis: y}}
)");
  RelativeFormulation f(model, model.simulation.inertia);
  StepOptions options = step_options(model, model.simulation);
  options.tolerance = 1e-300;
  Runner<RelativeFormulation> runner(f, options, 1e-6);
  runner.state() = relative_start(f, Start::given);
  start_accelerations(f, runner.state(), options.penalty_mass);
  bool good = true;
  for (int k = 0; k < 200 && good; ++k) good = runner.advance(1e-3);
  ASSERT_FALSE(good);
  expect_in(runner.failure(), "the tolerance of 1e-300 is below the rounding of double precision");
  expect_in(message_of([] {
              model_of(
                  "bodies: {b: {rigid: {mass: 1, centre_of_mass: [0, 0, 0]}}}\n"
                  "simulation: {tolerance: 1e-300}\n");
            }),
            "simulation.tolerance: found 1e-300, expected a number of at least 1e-15");
}

}  // namespace
}  // namespace floatframe::test
