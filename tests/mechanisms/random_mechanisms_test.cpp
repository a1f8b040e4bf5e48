// Random mechanisms in both formulations: what is judged stands in support/mechanism_check.hpp.
//   FLOATFRAME_RANDOM=1000       how many, 50 by default
//   FLOATFRAME_FIRST_SEED=1      their first seed
//   FLOATFRAME_LIST=1            prints a line for each
//   FLOATFRAME_SHRINK=1          prints the smallest mechanism with each violation
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "support/mechanism_check.hpp"
#include "support/random_count.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

int number(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : otherwise;
}

TEST(RandomMechanisms, BothFormulationsAgreeToSecondOrder) {
  const int count = random_count();
  const auto first = static_cast<unsigned>(number("FLOATFRAME_FIRST_SEED", 1));
  const bool shrink = number("FLOATFRAME_SHRINK", 0) != 0, list = number("FLOATFRAME_LIST", 0) != 0;
  std::map<std::string, std::map<Verdict, int>> table;
  std::string violations;
  for (unsigned seed = first; seed < first + static_cast<unsigned>(count); ++seed) {
    const Mechanism m = random_mechanism(seed);
    const Judgement j = judge(m);
    for (const char* row : {m.family, "all"}) ++table[row][j.verdict];
    const std::string what =
        fmt::format("seed {} {} ({}): {}, first step {:.3g} s, differences {:.3g} {}", seed,
                    m.family, summary_of(m.description), word(j.verdict), j.step,
                    fmt::join(j.differences, ", "), j.reason);
    if (list) {
      fmt::print("{}\n", what);
      std::fflush(stdout);
    }
    if (!is_violation(j.verdict)) continue;
    ADD_FAILURE() << what;
    violations += fmt::format(" {}", seed);
    if (!shrink) continue;
    const Mechanism small = shrunk(m, j.verdict);
    fmt::print("{}{}\n", text_of(small.description), judge(small).reason);
  }
  for (const auto& [family, verdicts] : table)
    for (const auto& [verdict, models] : verdicts)
      fmt::print("[ figure ] {} {} {}\n", family, word(verdict), models);
  if (!violations.empty()) fmt::print("violations: seeds{}\n", violations);
  // Most of what is drawn must run, or the test would say little.
  const auto& all = table["all"];
  const auto runs = [&](Verdict v) { return all.contains(v) ? all.at(v) : 0; };
  if (count >= 50) {
    EXPECT_GT(runs(Verdict::equal) + runs(Verdict::second_order) + runs(Verdict::finer),
              7 * count / 10);
  }
}

// Every joint that is drawn seldom or never, in place of others.
TEST(RandomMechanisms, OtherJointsOfAsManyCoordinates) {
  std::map<JointType, int> ran;
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const JointType type : all_joint_types) {
      const Mechanism drawn = random_mechanism(seed), m = with_joints(drawn, type);
      const bool other = joint_velocities(type) > 1 && joint_velocities(type) < 6;
      if (!other || text_of(m.description) == text_of(drawn.description)) continue;
      const Judgement j = judge(m);
      EXPECT_FALSE(is_violation(j.verdict)) << fmt::format(
          "seed {} with {}: {} {}", seed, joint_type_name(type), word(j.verdict), j.reason);
      if (j.verdict == Verdict::equal || j.verdict == Verdict::second_order ||
          j.verdict == Verdict::finer)
        ++ran[type];
    }
  for (const auto& [type, count] : ran)
    fmt::print("[ figure ] {} {}\n", joint_type_name(type), count);
  EXPECT_GT(ran[JointType::planar], 3);
}

// Every force element that is not drawn, added to what is.
TEST(RandomMechanisms, OtherForces) {
  std::set<ElementType> drawn;
  for (unsigned seed = 1; seed <= 60; ++seed)
    for (const ElementDescription& e : random_mechanism(seed).description.forces)
      drawn.insert(e.type());
  for (const ElementType type : types_of(ElementList::forces)) {
    // Tyres of files are those of cars, too stiff for these mechanisms.
    const bool of_file = std::ranges::any_of(
        element_keys(type), [](const ElementKey& key) { return key.kind == KeyKind::file; });
    if (drawn.contains(type) || of_file) continue;
    int ran = 0;
    for (unsigned seed = 1; seed <= 25; ++seed) {
      const auto m = with_force(random_mechanism(seed), type, seed);
      if (!m) continue;
      const Judgement j = judge(*m);
      EXPECT_FALSE(is_violation(j.verdict)) << fmt::format(
          "seed {} with {}: {} {}", seed, element_type_name(type), word(j.verdict), j.reason);
      if (j.verdict == Verdict::equal || j.verdict == Verdict::second_order ||
          j.verdict == Verdict::finer)
        ++ran;
    }
    fmt::print("[ figure ] {} {}\n", element_type_name(type), ran);
    EXPECT_GT(ran, 10) << element_type_name(type);
  }
}

/// Judges mechanisms with something added; returns how many of those that begin are compared to the
/// end, in percent: what is added may leave nothing free, or a mechanism be refused without it.
template <class With>
int compared(const char* what, const With& with) {
  int ran = 0, began = 0;
  const auto count = static_cast<unsigned>(random_count());
  const auto first = static_cast<unsigned>(number("FLOATFRAME_FIRST_SEED", 1));
  for (unsigned seed = first; seed < first + count; ++seed) {
    const auto m = with(random_mechanism(seed), seed);
    if (!m) continue;
    const Judgement j = judge(*m);
    if (number("FLOATFRAME_LIST", 0) != 0)
      fmt::print("seed {} with a {}: {} {}\n", seed, what, word(j.verdict), j.reason);
    EXPECT_FALSE(is_violation(j.verdict))
        << fmt::format("seed {} with a {}: {} {}", seed, what, word(j.verdict), j.reason);
    began += j.verdict != Verdict::refused;
    ran += j.verdict == Verdict::equal || j.verdict == Verdict::second_order ||
           j.verdict == Verdict::finer;
  }
  fmt::print("[ figure ] with a {}: {} of {} that begin are compared\n", what, ran, began);
  return began > 0 ? 100 * ran / began : 100;
}

TEST(RandomMechanisms, Couplings) { EXPECT_GT(compared("coupling", with_coupling), 50); }

// One type after the other, but curves that touch, which need bodies that stay in a plane.
TEST(RandomMechanisms, Constraints) {
  std::vector<ElementType> types = types_of(ElementList::constraints);
  std::erase(types, ElementType::curve_on_curve);
  EXPECT_GT(compared("constraint",
                     [&](const Mechanism& m, unsigned seed) {
                       return with_constraint(m, types[seed % types.size()], seed);
                     }),
            40);
}

TEST(RandomMechanisms, TouchingCurves) {
  EXPECT_GT(compared("pair of curves", with_touching_curves), 40);
}

TEST(RandomMechanisms, Cams) { EXPECT_GT(compared("cam", with_cam), 40); }

TEST(RandomMechanisms, StopsAndFriction) {
  EXPECT_GT(compared("stop or friction",
                     [](const Mechanism& m, unsigned seed) {
                       return with_joint_element(
                           m,
                           seed % 2 == 0 ? ElementType::joint_stop : ElementType::bristle_friction,
                           seed);
                     }),
            50);
}

/// Each thing that can be added to a mechanism, one after the other.
std::optional<Mechanism> with_something(unsigned seed) {
  const Mechanism m = random_mechanism(seed);
  const std::vector<ElementType> held = types_of(ElementList::constraints),
                                 forces = types_of(ElementList::forces);
  switch (seed % 6) {
    case 0:
      return with_coupling(m, seed);
    case 1:
      return with_constraint(m, held[seed / 6 % (held.size() - 1)], seed);
    case 2:
      return with_cam(m, seed);
    case 3:
      return with_joint_element(
          m, seed / 6 % 2 == 0 ? ElementType::joint_stop : ElementType::bristle_friction, seed);
    case 4:
      return with_touching_curves(m, seed);
    default:
      return with_force(m, forces[seed / 6 % forces.size()], seed);
  }
}

// Saved, read again and continued they give the same bits.
TEST(RandomMechanisms, GoOnToTheBit) {
  int continued = 0;
  const int seeds = std::min(3 * random_count(), 600);
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto m = with_something(seed);
    if (!m) continue;
    try {
      const Model model = build_model(m->description);
      for (const Coordinates c : {Coordinates::relative, Coordinates::absolute}) {
        SimulationOptions o{.step = 1e-3, .coordinates = c};
        o.inertia = c == Coordinates::relative ? m->relative : m->absolute;
        Simulation whole(model, o), later(model, o);
        bool runs = true;
        for (int k = 0; k < 10 && runs; ++k) runs = static_cast<bool>(whole.step());
        if (!runs) continue;
        later.restore(SimulationState::from_bytes(whole.save().to_bytes()));
        for (int k = 0; k < 10 && runs; ++k) runs = whole.step() && later.step();
        if (!runs) continue;
        ++continued;
        const std::span<const double> x = whole.outputs(), y = later.outputs();
        EXPECT_EQ(std::memcmp(x.data(), y.data(), x.size_bytes()), 0)
            << "seed " << seed << ": " << summary_of(m->description);
      }
    } catch (const InputError&) {  // refused
    } catch (const RunError&) {
    }
  }
  std::printf("[ figure ] continued runs %d\n", continued);
  EXPECT_GT(3 * continued, seeds);
}

TEST(RandomMechanisms, Controllers) { EXPECT_GT(compared("controller", with_controller), 70); }

// The motion of a hinge is a table with points at 0.02, 0.08 and 0.14 s. With 238 steps they lie at
// other places of their steps after each halving.
TEST(RandomMechanisms, PointsOfTablesLieBetweenSteps) {
  const Mechanism m = random_mechanism(18);
  EXPECT_EQ(steps_on_kinks(build_model(m.description), 238.0), 240.0);
  const Judgement judged = judge(m);
  EXPECT_STREQ(word(judged.verdict), "second order");
  for (std::size_t k = 0; k < judged.differences.size(); ++k)
    std::printf("[ figure ] seed 18, steps %g: difference of the formulations [m] %.3g\n",
                std::ldexp(240.0, static_cast<int>(k)), judged.differences[k]);
}

// Mode 4 of a bar on a ball has neither mass nor, next to the penalty, stiffness to speak of.
// Pivots that were round-off kicked its velocity, in some runs, by what rounding decides.
TEST(RandomMechanisms, RoundingDecidesNothingAboutAMasslessMode) {
  Mechanism m = random_mechanism(181);
  SimulationDescription o = m.description.simulation;
  o.step = o.duration / 967.0;
  o.tolerance = 1e-8 * o.step;
  o.position_tolerance = 1e-10;
  o.velocity_tolerance = 1e-9;
  o.coordinates = Coordinates::absolute;
  o.inertia = m.absolute;
  o.output_interval = o.duration;
  std::vector<double> first;
  double largest = 0.0;
  for (int k = 0; k < 6; ++k) {
    m.description.joints[0].velocity[0] *= 1.0 + 1e-14;
    const Model model = build_model(m.description);
    const RunResult r = run(model, o);
    ASSERT_EQ(r.summary.status, "completed") << r.summary.message;
    const std::size_t end = r.table.rows() - 1;
    std::size_t position = 0;
    for (std::size_t c = 0; c < model.outputs.size(); ++c) {
      if (model.outputs[c].type != OutputType::position) continue;
      const double x = r.table.at(end, c + 1);
      if (k == 0)
        first.push_back(x);
      else
        largest = std::max(largest, std::abs(x - first[position++]));
    }
  }
  std::printf("[ figure ] seed 181, 967 steps, absolute: largest change of a point [m] %.2g\n",
              largest);
  EXPECT_LT(largest, 1e-7);
}

// The slider of seed 466 sinks 20 m into a soft stop, a hundred steps of the search. The body that
// hangs on a ball below is then in balance at each angle about the vertical: rounding, which two
// inertia methods do differently, chooses it, and nothing else.
TEST(RandomMechanisms, RoundingChoosesAmongEquilibria) {
  const auto m = with_joint_element(random_mechanism(466), ElementType::joint_stop, 466);
  const Judgement judged = judge(*m);
  EXPECT_STREQ(word(judged.verdict), "second order") << judged.reason;
  const Model model = build_model(m->description);
  RelativeFormulation one(model, InertiaMethod::preprocessing),
      other(model, InertiaMethod::projection);
  const State s = relative_start(one, Start::equilibrium),
              z = relative_start(other, Start::equilibrium);
  EXPECT_NEAR(s.q[0], z.q[0], 1e-11);
  kinematics_at(one, 0.0, s.q, s.v);
  kinematics_at(other, 0.0, z.q, z.v);
  const Mat3 turn =
      one.motion().bodies[2].R_WB * other.motion().bodies[2].R_WB.transpose() - Mat3::Identity();
  const Vec3 angle(turn(2, 1), turn(0, 2), turn(1, 0));
  std::printf("[ figure ] seed 466, turned about the vertical by [rad] %.2g, about others %.2g\n",
              angle.norm(), angle.cross(model.gravity.normalized()).norm());
  EXPECT_LT(angle.norm(), 1e-6);
  EXPECT_LT(angle.cross(model.gravity.normalized()).norm(), 1e-10);
}

// The loop of seed 263 bends a bar between two balls by 4e-6 m: all that its spin has of inertia.
// Relative coordinates call that nothing, absolute ones begin.
TEST(RandomMechanisms, ABarThatIsHardlyBentSpinsWithoutMass) {
  const Judgement judged = judge(*with_cam(random_mechanism(263), 263));
  EXPECT_STREQ(word(judged.verdict), "refused") << judged.reason;
  EXPECT_NE(judged.reason.find("body 'body_2' can move without mass"), std::string::npos);
}

TEST(RandomMechanisms, TheSameSeedGivesTheSameMechanism) {
  for (unsigned seed = 1; seed <= 20; ++seed)
    EXPECT_EQ(text_of(random_mechanism(seed).description),
              text_of(random_mechanism(seed).description));
}

}  // namespace
}  // namespace floatframe::test
