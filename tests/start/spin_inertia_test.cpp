// Bars and points without inertia about an axis that nothing holds: one sentence in all
// formulations.
#include <gtest/gtest.h>

#include <utility>

#include "floatframe/start/check.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/start/light_motion.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// A flexible bar from g to e.
std::string bar_model(const std::string& points, const std::string& more) {
  return "points: {" + points + "}" + R"(
bodies:
  bar:
    position: g
    flexible:
      material: {young: 2e11, poisson: 0.3, density: 7800}
      bars: {bar: {from: g, to: e, elements: 4, section: {round: 0.02}}}
      clamped: [g]
      static_modes: [{point: e, dofs: [y, z]}]
)" + more;
}

// Round-off of such a bar passed for mass in one of the formulations.
const std::string spinning_bars[] = {
    bar_model("g: [0.138, 0.605, -0.874], e: [0.441, 1.277, -0.983], w: [0.17, 0.803, -1.266]",
              R"(  weight: {position: w, rigid: {mass: 8.5, inertia: [1, 1, 1]}}
joints:
  top: {type: spherical, child: bar, at: g}
  low: {type: spherical, parent: bar, child: weight, at: e}
)"),
    R"(
points: {g: [-0.369, 0.114, 0.07], e: [-1.06, -0.445, 0.014], w: [-1.427, -0.397, -0.247]}
parameters: {m: 0.6562036026942476, x: -0.691, y: -0.559, z: -0.056}
bodies:
  bar:
    position: g
    rigid:
      mass: ${m}
      centre_of_mass: [-0.7145, -0.1655, 0.042]
      inertia: ["${m/12*(y*y+z*z)}", "${m/12*(x*x+z*z)}", "${m/12*(x*x+y*y)}", "${-m/12*x*y}",
          "${-m/12*x*z}", "${-m/12*y*z}"]
  weight: {position: w, rigid: {mass: 5.4, inertia: [1, 1, 1]}}
joints:
  top: {type: spherical, child: bar, at: g}
  low: {type: spherical, parent: bar, child: weight, at: e}
  pin: {type: revolute, child: weight, at: w, axis: [0.872, 0.142, -0.434]}
)",
    bar_model("g: [0.485, 0.091, 0.424], e: [0.32, -0.647, -0.386]",
              "joints: {top: {type: spherical, child: bar, at: g}}\n")};

/// The same of runs in all formulations and of a check.
std::string sentence_about_the_bar(const Model& model) {
  const std::string first = message_of([&] { check(model); });
  expect_in(first, "the mass matrix is singular where nothing holds it: body 'bar' can move");
  for (const Combination& c : combinations)
    EXPECT_EQ(message_of([&] { run_of(model, c); }), first) << c.name();
  return first;
}

TEST(SpinningBars, GetTheSameSentenceInAllFormulations) {
  for (const std::string& text : spinning_bars) {
    const Model model = model_of(text + "simulation: {step: 0.001, duration: 0.05}\n");
    expect_in(sentence_about_the_bar(model), "a straight bar has no inertia about its own axis");
  }
}

// A round bar that is bent can still turn about itself while its bend stays where it is: the modes
// undo what the frame does, and the stiffness is the same all around. With a frame off the bar this
// is a motion of all coordinates, along which elastic forces change and the direction turns.
TEST(SpinningBars, GetItWhenTheyAreBent) {
  for (const char* bend : {"[0.001, 0.002]", "[0.02, -0.01]"})
    for (const char* motion : {"", ", velocity: [1, 0, 0, 0, 0, 2]"}) {
      const Model model = model_of(std::string(R"(
gravity: [0, 0, 0]
points: {a: [1, 0, 0], b: [2, 0, 0]}
bodies:
  bar:
    position: [1.3, 0.2, 0.1]
    flexible:
      material: {young: 2e11, poisson: 0.3, density: 7800}
      bars: {bar: {from: a, to: b, elements: 4, section: {round: 0.02}}}
      clamped: [a]
      static_modes: [{point: b, dofs: [y, z]}]
joints: {f: {type: free, child: bar, position: [0.1, 0.2, 0.3, 0, 0, 0.5])") +
                                   motion + "}}\ninitial: {amplitudes: {bar: " + bend +
                                   "}}\nsimulation: {step: 0.001, duration: 0.05}\n");
      sentence_about_the_bar(model);
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

// What a run says that stops where a freedom has almost no mass: how little that is depends on the
// bodies alone, not on the coordinates.
TEST(LightMotions, AreTheSameInBothFormulations) {
  const auto notes = [](const char* tilt) {
    const Model model = model_of(std::string(R"(
bodies: {bar: {position: [0, 0, 0], rigid: {mass: 1, centre_of_mass: [0, 0, 0],
    inertia: [0, 0.1, 0.1]}}}
joints: {a: {type: universal, child: bar, at: [0, 0, 0], axis: [1, 0, )") +
                                 tilt + "], axis_2: [0, 1, 0]}}\n");
    RelativeFormulation relative(model, InertiaMethod::preprocessing);
    const State r = relative_start(relative, Start::given);
    AbsoluteFormulation absolute(model, InertiaMethod::preprocessing);
    State a;
    a.t = r.t;
    absolute.start_from(relative, r.q, r.v, a.q, a.v);
    return std::pair(light_motion_note(relative, r), light_motion_note(absolute, a));
  };
  // A turn about the first axis has the square of the tilt of the inertia across.
  const auto [light, also_light] = notes("0.001");
  expect_in(light, "body 'bar' can move there almost without mass");
  EXPECT_EQ(also_light, light);
  const auto [heavy, also_heavy] = notes("0.02");
  EXPECT_EQ(heavy, "");
  EXPECT_EQ(also_heavy, "");
}

TEST(SpinningBars, ABitOfInertiaIsEnough) {
  // 1 mm thick and 1 m long: 1e-6 of the inertia across.
  const Model model = model_of(R"(
bodies:
  bar: {position: [0, 0, 0], orientation: [0.3, 0.2, 0.5], rigid: {mass: 1,
      centre_of_mass: [0, 0, 0], inertia: [1e-7, 0.1, 0.1]}}
joints: {a: {type: spherical, child: bar, at: [0, 0, 0]}}
simulation: {step: 0.001, duration: 0.02}
)");
  for (const Combination& c : combinations)
    EXPECT_EQ(run_of(model, c).summary.status, "completed") << c.name();
}

}  // namespace
}  // namespace floatframe::test
