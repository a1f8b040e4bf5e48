// Axes and points with few digits: loops that move as the exact ones do, and loops that stay
// locked.
#include "floatframe/model/snap.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "floatframe/math/so3.hpp"
#include "floatframe/start/check.hpp"
#include "floatframe/start/statics.hpp"
#include "support/completed_run.hpp"
#include "support/contains.hpp"
#include "support/model_text.hpp"
#include "support/random_count.hpp"

namespace floatframe::test {
namespace {

std::string triple(const Vec3& v) {
  return fmt::format("[{:.17g},{:.17g},{:.17g}]", v[0], v[1], v[2]);
}

std::string body_text(const std::string& name, const Vec3& centre) {
  return fmt::format(
      "  {}: {{rigid: {{mass: 1, centre_of_mass: {}, inertia: [0.01,0.012,0.011]}}}}\n", name,
      triple(centre));
}

std::string joint_text(const std::string& name, const char* type, const std::string& parent,
                       const std::string& child, const Vec3& at, const Vec3& axis,
                       const char* more = "") {
  return fmt::format("  {}: {{type: {}, parent: {}, child: {}, at: {}, axis: {}{}}}\n", name, type,
                     parent, child, triple(at), triple(axis), more);
}

/// A four-bar linkage or a slider-crank in a random plane, its joints shifted along the normal.
struct PlanarLinkage {
  explicit PlanarLinkage(int seed) : random(static_cast<unsigned>(seed)) {
    const Vec3 turn(between(-2.0, 2.0), between(-2.0, 2.0), between(-2.0, 2.0));
    R = rotation_exp(turn);
    slides = seed % 2 == 1;
    do {
      const double b = between(0.1, 0.2), angle = between(-3.0, 3.0);
      p[0] = Vec3::Zero();
      p[1] = b * Vec3(std::cos(angle), std::sin(angle), 0.0);
      p[3] = Vec3(between(0.8, 1.0), between(-0.1, 0.1), 0.0);
      p[2] = slides ? p[3] : Vec3(p[3] + Vec3(between(-0.3, 0.3), between(0.5, 0.7), 0.0));
    } while (!turns());
    for (Vec3& x : p) x[2] = between(-0.2, 0.2);
    if (slides) p[2][2] = p[3][2];
    for (std::size_t k = 0; k < 4; ++k) {
      normal[k] = R.col(2) * between(0.3, 1.0);
      p[k] = R * p[k];
    }
    slide = R.col(0) * between(0.3, 1.0);
  }

  /// The crank can turn (Grashof).
  bool turns() const {
    const double a = p[1].norm(), b = (p[2] - p[1]).norm(), c = (p[3] - p[2]).norm();
    if (slides) return b - std::abs(p[3][1]) > 1.2 * a;
    const double d = p[3].norm(), longest = std::max({b, c, d});
    return a + longest < 0.9 * (b + c + d - longest);
  }

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }

  /// Axes with so many digits; 0: all of them.
  std::string text(int digits, const char* motion) const {
    const auto axis = [&](const Vec3& v) {
      const double unit = std::pow(10.0, digits);
      return digits == 0 ? v : Vec3((v * unit).array().round() / unit);
    };
    return fmt::format(
        "gravity: [1,2,-9.81]\npoints: {{B: {}, C: {}}}\nbodies:\n{}{}{}joints:\n{}{}{}{}"
        "outputs: {{b: {{position: {{body: bc, at: {}}}}}, c: {{position: {{body: "
        "bc, at: {}}}}}}}\nsimulation: {{step: 0.02, duration: 1}}\n",
        triple(p[1]), triple(p[2]), body_text("ab", 0.5 * (p[0] + p[1])),
        body_text("bc", 0.5 * (p[1] + p[2])), body_text("cd", 0.5 * (p[2] + p[3])),
        joint_text("A", "revolute", "ground", "ab", p[0], axis(normal[0]), motion),
        joint_text("B", "revolute", "ab", "bc", p[1], axis(normal[1])),
        joint_text("C", "revolute", "bc", "cd", p[2], axis(normal[2])),
        slides ? joint_text("D", "prismatic", "ground", "cd", p[3], axis(slide))
               : joint_text("D", "revolute", "ground", "cd", p[3], axis(normal[3])),
        triple(p[1]), triple(p[2]));
  }

  std::mt19937 random;
  Mat3 R;
  bool slides = false;
  std::array<Vec3, 4> p, normal;
  Vec3 slide;
};

TEST(Snap, PlanarLinkagesWithFewDigits) {
  constexpr std::array<int, 5> digits = {3, 4, 5, 6, 8};
  std::array<double, 5> worst{};
  const int count = random_count();
  for (int seed = 0; seed < count; ++seed) {
    const PlanarLinkage linkage(seed);
    const std::size_t d = static_cast<std::size_t>(seed / 2) % 5;
    const char* motion = ", motion: {polynomial: [0,2]}";
    const Model exact = model_of(linkage.text(0, motion));
    const Model rounded = model_of(linkage.text(digits[d], motion));
    EXPECT_TRUE(exact.hints.notes.empty()) << exact.hints.notes.front();
    EXPECT_TRUE(rounded.hints.locked.empty()) << seed;
    const RunResult a = completed_run(exact), b = completed_run(rounded);
    ASSERT_EQ(a.table.data.size(), b.table.data.size());
    for (std::size_t k = 0; k < a.table.data.size(); ++k)
      worst[d] = std::max(worst[d], std::abs(a.table.data[k] - b.table.data[k]));
  }
  for (std::size_t d = 0; d < 5; ++d) {
    std::printf("[ figure ] %d digits: largest difference of a point [m] %.2g\n", digits[d],
                worst[d]);
    EXPECT_LT(worst[d], 5.0 * std::pow(10.0, -digits[d]));
  }
}

TEST(Snap, ForcesInEquilibriumAreThoseOfTheLoads) {
  for (int seed = 0; seed < 20; ++seed) {
    const PlanarLinkage linkage(seed);
    const StaticsResult s = statics(model_of(linkage.text(4, ", motion: {polynomial: [0.1]}")));
    for (const StaticsJoint& j : s.joints) EXPECT_LT(j.force.norm(), 1000.0) << seed << j.name;
  }
}

TEST(Snap, APinOneDegreeOutLocks) {
  for (int seed = 0; seed < 20; ++seed) {
    PlanarLinkage linkage(seed);
    const std::size_t pin = static_cast<std::size_t>(seed / 2) % 3;
    const Vec3 about = linkage.R * Vec3(std::cos(seed), std::sin(seed), 0.0);
    linkage.normal[pin] = rotation_exp(about * (3.14159265358979 / 180.0)) * linkage.normal[pin];
    const Model model = model_of(linkage.text(0, ", motion: {polynomial: [0,0,2]}"));
    ASSERT_EQ(model.hints.locked.size(), 1U) << seed;
    const LockedLoops& locked = model.hints.locked[0];
    EXPECT_TRUE(locked.driven);
    const std::string name(1, "ABC"[pin]);
    EXPECT_TRUE(
        contains(locked.sentence, "0 degrees of freedom: joint '" + name + "' is 1 degree out"));
    EXPECT_THROW(run(model), RunError);
    EXPECT_FALSE(statics(model).notes.empty());
  }
}

/// Frames of all joints in the drawn configuration: unchanged to the last bit?
bool untouched(const std::string& text) {
  const Model with = model_of(text), without = model_of(text + "snap: false\n");
  if (!with.hints.locked.empty() || with.markers.size() != without.markers.size()) return false;
  for (std::size_t k = 0; k < with.markers.size(); ++k)
    if (with.markers[k].X_NM.R != without.markers[k].X_NM.R ||
        with.markers[k].X_NM.p != without.markers[k].X_NM.p)
      return false;
  return true;
}

TEST(Snap, ExactAxesAndNearlySingularPositionsStay) {
  const auto parallelogram = [](double angle) {
    const Vec3 A(0, 0, 0), D(1, 0, 0), u(std::cos(angle), 0, std::sin(angle));
    const Vec3 B = A + 0.5 * u, C = D + 0.5 * u, y(0, 1, 0);
    return "bodies:\n" + body_text("ab", 0.5 * (A + B)) + body_text("bc", 0.5 * (B + C)) +
           body_text("cd", 0.5 * (C + D)) + "joints:\n" +
           joint_text("A", "revolute", "ground", "ab", A, y) +
           joint_text("B", "revolute", "ab", "bc", B, y) +
           joint_text("C", "revolute", "bc", "cd", C, y) +
           joint_text("D", "revolute", "ground", "cd", D, y);
  };
  for (const double angle : {1.0, 1e-3, 1e-6, 0.0}) EXPECT_TRUE(untouched(parallelogram(angle)));
  const auto slider_crank = [](double angle) {
    const Vec3 A(0, 0, 0), B(0.2 * std::cos(angle), 0, 0.2 * std::sin(angle)), y(0, 1, 0);
    const Vec3 C(B[0] + std::sqrt(0.36 - B[2] * B[2]), 0, 0);
    return "bodies:\n" + body_text("ab", 0.5 * (A + B)) + body_text("bc", 0.5 * (B + C)) +
           body_text("c", C) + "joints:\n" + joint_text("A", "revolute", "ground", "ab", A, y) +
           joint_text("B", "revolute", "ab", "bc", B, y) +
           joint_text("C", "revolute", "bc", "c", C, y) +
           joint_text("D", "prismatic", "ground", "c", C, Vec3(1, 0, 0));
  };
  for (const double angle : {1.0, 1e-4, 0.0}) EXPECT_TRUE(untouched(slider_crank(angle)));
}

/// Number of degrees of freedom with and without.
std::array<int, 2> freedoms(const std::string& text) {
  return {check(model_of(text)).degrees_of_freedom,
          check(model_of(text + "snap: false\n")).degrees_of_freedom};
}

TEST(Snap, ADoorWithTwoHinges) {
  const std::string door =
      "bodies:\n" + body_text("door", {0.5, 0, 1}) + "joints:\n" +
      joint_text("low", "revolute", "ground", "door", {0, 0, 0.2}, {0, 1e-4, 1}) +
      joint_text("high", "revolute", "ground", "door", {2e-4, -1e-4, 1.8}, {0, 0, 1});
  EXPECT_EQ(freedoms(door), (std::array<int, 2>{1, 0}));
  const std::string ball = "bodies:\n" + body_text("door", {0.5, 0, 1}) + "joints:\n" +
                           joint_text("low", "revolute", "ground", "door", {0, 0, 0.2}, {0, 0, 1}) +
                           "  high: {type: spherical, child: door, at: [2e-4,0,1.8]}\n";
  EXPECT_EQ(freedoms(ball), (std::array<int, 2>{1, 0}));
}

TEST(Snap, TwoCranksCoupledByParallelRods) {
  const Vec3 across(1, 0, 0), high(0, 0.2, 0.3), low(0.15, -0.1, -0.3);
  const auto rod = [&](const char* name, const Vec3& p) {
    return fmt::format("  {}: {{from: {{body: a, at: {}}}, to: {{body: b, at: {}}}}}\n", name,
                       triple(p), triple(p + across));
  };
  const std::string cranks = "bodies:\n" + body_text("a", Vec3::Zero()) + body_text("b", across) +
                             "joints:\n" +
                             joint_text("A", "revolute", "ground", "a", Vec3::Zero(), {0, 0, 1},
                                        ", motion: {polynomial: [0, 1]}") +
                             joint_text("B", "revolute", "ground", "b", across, {0, 1e-3, 1}) +
                             "rods:\n" + rod("high", high) + rod("low", low);
  const Model model = model_of(cranks);
  EXPECT_EQ(model.hints.notes.size(), 1U);
  EXPECT_TRUE(model.hints.locked.empty());
  // The motion drives the exact axis, and is at its end after one second.
  const RunResult r = completed_run(model_of(
      cranks + "outputs: {b: {joint_position: B}}\nsimulation: {step: 0.01, duration: 1}\n"));
  EXPECT_NEAR(r.table.data.back(), 1.0, 1e-9);
  EXPECT_FALSE(model_of(cranks + "snap: false\n").hints.locked.empty());
}

TEST(Snap, ARodOfAnotherLengthThanDrawnHidesNothing) {
  const std::string door =
      "bodies:\n" + body_text("door", {0.5, 0, 1}) + body_text("arm", {2, 0, 1}) + "joints:\n" +
      joint_text("low", "revolute", "ground", "door", {0, 0, 0.2}, {0, 1e-4, 1}) +
      joint_text("high", "revolute", "ground", "door", {2e-4, -1e-4, 1.8}, {0, 0, 1}) +
      joint_text("arm", "revolute", "ground", "arm", {2, 0, 1}, {0, 0, 1}) +
      "rods: {r: {from: {body: door, at: [1, 0, 1]}, to: {body: arm, at: [1.8, 0.3, 1]}";
  for (const char* length : {"}}\n", ", length: 0.85}}\n", ", length: 0.9}}\n"})
    EXPECT_EQ(freedoms(door + length), (std::array<int, 2>{1, 0})) << length;
}

TEST(Snap, ASphericalLinkage) {
  const Vec3 a(1, 0, 0), b = Vec3(1, 0.3, 0.2).normalized(), c = Vec3(0.6, 1, 0.5).normalized(),
                         d = Vec3(0, 1, 0.1).normalized();
  const Vec3 off(1e-4, -2e-4, 1e-4);
  const std::string text = "bodies:\n" + body_text("ab", a) + body_text("bc", b) +
                           body_text("cd", c) + "joints:\n" +
                           joint_text("A", "revolute", "ground", "ab", a, a) +
                           joint_text("B", "revolute", "ab", "bc", b + off, b) +
                           joint_text("C", "revolute", "bc", "cd", c, c) +
                           joint_text("D", "revolute", "ground", "cd", d - off, d);
  EXPECT_EQ(freedoms(text), (std::array<int, 2>{1, 0}));
}

TEST(Snap, AWedgeOfThreeSlides) {
  const Vec3 p(0.1, 0.2, 0.3);
  const std::string text = "bodies:\n" + body_text("a", {0, 0, 0}) + body_text("b", {0, 0, 1}) +
                           "joints:\n" +
                           joint_text("A", "prismatic", "ground", "a", {0, 0, 0}, {1, 0, 0}) +
                           joint_text("B", "prismatic", "a", "b", p, {1, 1e-3, 0.5}) +
                           joint_text("C", "prismatic", "ground", "b", {0, 0, 1}, {1e-3, 0, 1});
  EXPECT_EQ(freedoms(text), (std::array<int, 2>{1, 0}));
}

TEST(Snap, AFlexibleBodyTakesTheMisfit) {
  PlanarLinkage linkage(2);
  std::string text = linkage.text(4, "");
  const std::string part =
      "  bc: {flexible: {material: {young: 2e11, poisson: 0.3, density: 7800}, bars: {b: {from: B, "
      "to: C, elements: 4, section: {round: 0.02}}}, clamped: [B], static_modes: [{point: C, dofs: "
      "all}], normal_modes: 0, mass_model: hermite, section_inertia: true}}\n";
  const std::size_t from = text.find("  bc:"), to = text.find("  cd:");
  text.replace(from, to - from, part);
  text.erase(text.find("outputs:"), text.find("simulation:") - text.find("outputs:"));
  EXPECT_TRUE(untouched(text));
}

}  // namespace
}  // namespace floatframe::test
