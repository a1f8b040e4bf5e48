// Parts with springs: blocks joined by bushings, reduced in every way, ends that are interfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "floatframe/fe/springs.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/reduction/part_health.hpp"
#include "support/error_of.hpp"
#include "support/fe_parts.hpp"

namespace floatframe::test {
namespace {

/// A row of cubes of hex8i from x on.
void add_row(FeModel& model, double x, int cubes, double size) {
  const int first = model.nodes();
  for (int i = 0; i <= cubes; ++i)
    for (int j = 0; j < 4; ++j)
      model.positions.emplace_back(x + size * i, size * (j == 1 || j == 2), size * (j / 2));
  for (int i = 0; i < cubes; ++i) {
    const int a = first + 4 * i, b = a + 4;
    add_element(model, FeElementType::hex8i, {a, b, b + 1, a + 1, a + 3, b + 3, b + 2, a + 2});
  }
}

/// Two rows whose near ends have reference nodes, a bushing between these; a node in the air on a
/// bushing of its own.
FeModel jointed() {
  FeModel model;
  model.materials = {{2.1e11, 0.3, 7800.0}};
  add_row(model, 0.0, 4, 0.05);
  add_row(model, 0.24, 4, 0.05);
  const Vec3 joint(0.22, 0.025, 0.025);
  for (const int first : {16, 20}) {
    add_spider(model, model.nodes(), {first, first + 1, first + 2, first + 3});
    model.positions.push_back(joint);
  }
  Vec6 k;
  k << 1e8, 2e8, 3e8, 1e5, 2e5, 3e5;
  const Mat3 axes = Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  add_bushing(model, 40, 41, joint, axes, k, "joint", {});
  model.positions.emplace_back(0.44, 0.1, 0.0);  // node 42: a mount
  add_bushing(model, 41, 42, joint, Mat3::Identity(), k, "mount", {});
  return model;
}

/// With a spring along y from node 0, beside the line of its nodes.
FeModel with_spring(int node, double stiffness) {
  FeModel model = jointed();
  Spring& s = model.springs.emplace_back();
  s.name = "CELAS1 9";
  s.nodes = {0, node};
  s.directions = {-Vec6::Unit(1), Vec6::Unit(1)};
  s.stiffness = stiffness;
  return model;
}

PartOptions held_at_the_end() {
  PartOptions options;
  options.interfaces = {
      interface_at("end", {.by = NodeChoice::By::plane, .set = {}, .axis = Vec3::UnitX()})};
  options.modes = 12;
  return options;
}

TEST(SpringsPart, FreeModesInEveryMethodAndFrame) {
  std::vector<double> first;
  for (const ModeMethod method :
       {ModeMethod::craig_bampton, ModeMethod::free_free, ModeMethod::craig_chang}) {
    PartOptions options = held_at_the_end();
    options.method = method;
    options.modes = 30;
    for (const auto kind : {BodyReference::Kind::mean_axis, BodyReference::Kind::buckens}) {
      options.reference.kind = kind;
      const ReducedPart part = reduce_part(jointed(), options);
      ASSERT_GT(part.health.free_frequencies.size(), 5u);
      for (std::size_t k = 0; k < 5; ++k) {
        const FrequencyPair& pair = part.health.free_frequencies[k];
        EXPECT_LT(std::abs(pair.relative_error()), 1e-4) << k;
        if (first.size() < 5) first.push_back(pair.full);
        EXPECT_NEAR(pair.full / first[k], 1.0, 1e-8);
      }
      EXPECT_LT(part.health.rigid_residual, 1e-12);
    }
  }
}

// With a soft joint the rows are rigid and the first frequency is that of the joint, which goes
// with the root of its stiffness.
TEST(SpringsPart, StiffnessOfTheJointDecides) {
  double last = 0.0;
  for (const double factor : {1e-3, 1e-1, 10.0}) {
    FeModel model = jointed();
    for (Spring& s : model.springs) s.stiffness *= factor;
    const ReducedPart part = reduce_part(model, held_at_the_end());
    const double f = part.health.free_frequencies.at(0).full;
    EXPECT_GT(f, 1.5 * last);
    if (factor == 1e-1) {
      EXPECT_NEAR(f / last, 10.0, 0.3);
    }
    last = f;
  }
}

TEST(SpringsPart, AnEndMayBeAnInterface) {
  PartOptions options = held_at_the_end();
  options.interfaces.push_back(interface_at("mount", node_number(43)));
  const ReducedPart part = reduce_part(jointed(), options);
  EXPECT_LT(part.health.interfaces.at(1).static_error, 1e-6);
  EXPECT_EQ(part.body.nodes.at(1).name, "mount");
}

TEST(SpringsPart, Errors) {
  FeModel grounded = jointed();
  Vec6 k = Vec6::Constant(1e6);
  add_bushing(grounded, 40, -1, Vec3::Zero(), Mat3::Identity(), k, "CBUSH 7", {});
  EXPECT_EQ(error_of([&] { reduce_part(grounded, held_at_the_end()); }),
            "unsupported\nunsupported\nunsupported\nunsupported\nunsupported\nunsupported");
  // Too soft to be seen beside the stiffness of the part, not beside its bending.
  EXPECT_EQ(error_of([&] { reduce_part(with_spring(40, 1e6), held_at_the_end()); }),
            "contradiction");
  // A bushing at a node without rotations turns with nothing.
  FeModel loose = jointed();
  loose.springs.resize(6);
  k << 1e8, 2e8, 3e8, 1e5, 2e5, 3e5;
  add_bushing(loose, 37, 42, loose.positions[37], Mat3::Identity(), k, "mount", {});
  PartOptions options = held_at_the_end();
  options.interfaces.push_back(interface_at("mount", node_number(43)));
  const std::string what = error_of([&] { reduce_part(loose, options); });
  EXPECT_EQ(what, "singular") << what;
  // A spring across the line of its nodes.
  const std::string text = error_of([&] { reduce_part(with_spring(36, 1e9), held_at_the_end()); });
  EXPECT_EQ(text, "contradiction") << text;
  // Without its turns the joint is a mechanism.
  FeModel hinge = jointed();
  std::erase_if(hinge.springs, [](const Spring& spring) {
    return spring.directions[0].head<3>().isZero(0.0) && spring.nodes[0] == 40;
  });
  EXPECT_NE(error_of([&] { reduce_part(hinge, held_at_the_end()); }), "no error");
}

// A spring beside the line of its nodes holds the part, also if no mode is kept that would show it.
TEST(SpringsPart, HeldWithoutModes) {
  const FeModel held = with_spring(40, 1e6);
  PartOptions options = held_at_the_end();
  options.modes = 0;
  EXPECT_EQ(error_of([&] { reduce_part(held, options); }), "contradiction");
}

/// Two bodies at one place, a bushing between them.
FeModel two_masses() {
  FeModel model;
  model.positions = {Vec3::Zero(), Vec3::Zero()};
  model.masses.resize(2);
  model.masses[0] = {.node = 0, .mass = 2.0};
  model.masses[1] = {.node = 1, .mass = 3.0};
  model.masses[0].J.diagonal() << 0.01, 0.02, 0.03;
  model.masses[1].J.diagonal() << 0.02, 0.03, 0.05;
  Vec6 k;
  k << 1e5, 2e5, 3e5, 100.0, 200.0, 300.0;
  add_bushing(model, 0, 1, Vec3::Zero(), Mat3::Identity(), k, "bushing", {});
  return model;
}

/// Nothing resists the turn about x.
FeModel loose_masses() {
  FeModel model = two_masses();
  std::erase_if(model.springs, [](const Spring& s) { return s.directions[0](3) != 0.0; });
  return model;
}

TEST(MassesOnSprings, ClosedForm) {
  const VecX k = (VecX(6) << 1e5, 2e5, 3e5, 100.0, 200.0, 300.0).finished();
  // Reduced masses and inertias.
  const VecX m = (VecX(6) << 1.2, 1.2, 1.2, 0.02 / 3.0, 0.012, 0.03 * 0.05 / 0.08).finished();
  std::vector<double> exact;
  for (int i = 0; i < 6; ++i) exact.push_back(hertz(std::sqrt(k(i) / m(i))));
  std::sort(exact.begin(), exact.end());
  for (const ModeMethod method :
       {ModeMethod::free_free, ModeMethod::craig_chang, ModeMethod::craig_bampton}) {
    PartOptions options;
    options.method = method;
    if (method != ModeMethod::free_free)
      options.interfaces = {interface_at("A", nearest_to(Vec3::Zero()))};
    const HealthReport health = reduce_part(two_masses(), options).health;
    ASSERT_EQ(health.modes, 6);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(health.free_frequencies[i].reduced / exact[i], 1.0, 1e-10) << i;
  }
  PartOptions seven;
  seven.method = ModeMethod::free_free;
  seven.modes = 7;
  EXPECT_EQ(error_of([&] { reduce_part(two_masses(), seven); }), "out_of_range");
  // A mechanism is one still: nothing resists the turn about x.
  const FeModel loose = loose_masses();
  PartOptions free;
  free.method = ModeMethod::free_free;
  EXPECT_EQ(error_of([&] { reduce_part(loose, free); }), "singular");
}

// One point turns about all axes for nothing, two about the line through them.
TEST(MassesOnSprings, WithoutInertiaAboutAnAxis) {
  const auto error = [](const FeModel& model, ModeMethod method) {
    PartOptions options;
    options.method = method;
    if (method != ModeMethod::free_free)
      options.interfaces = {interface_at("A", nearest_to(Vec3::Zero()), 7u)};
    return error_of([&] { reduce_part(model, options); });
  };
  FeModel model = two_masses();
  for (PointMass& m : model.masses) m.J.setZero();
  std::erase_if(model.springs, [](const Spring& s) { return s.directions[0].head<3>().isZero(); });
  for (const ModeMethod method : {ModeMethod::free_free, ModeMethod::craig_bampton})
    EXPECT_EQ(error(model, method), "singular");
  model.positions[1] = Vec3(0.0, 0.0, 2.0);
  std::erase_if(model.springs, [](const Spring& s) { return s.directions[0](2) == 0.0; });
  EXPECT_EQ(error(model, ModeMethod::free_free), "singular");
}

TEST(MassesOnSprings, NoUnitsAreProposed) {
  EXPECT_EQ(unit_guess(two_masses(), 2.0),
            "the part has a size of 0 m, which is unusual; check the units of the file");
}

// However few modes are kept.
TEST(MassesOnSprings, MechanismsWithoutNormalModes) {
  const FeModel loose = loose_masses();
  PartOptions options;
  options.method = ModeMethod::free_free;
  options.modes = 0;
  EXPECT_EQ(error_of([&] { reduce_part(loose, options); }), "singular");
  options.modes.reset();
  options.max_frequency = 1e-4;
  EXPECT_EQ(error_of([&] { reduce_part(loose, options); }), "singular");
}

}  // namespace
}  // namespace floatframe::test
