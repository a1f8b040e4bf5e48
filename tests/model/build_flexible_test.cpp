// Bodies of bars that are described alike are reduced once, wherever they stand; whatever decides
// the reduction makes another body.
#include "floatframe/model/build_flexible.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "floatframe/math/so3.hpp"
#include "support/valid_description.hpp"

namespace floatframe {
namespace {

using test::bar_description;
using test::make_body;

class BuildFlexible : public testing::Test {
 protected:
  std::shared_ptr<const FlexibleBody> build(const BodyDescription& body) {
    ErrorList errors;
    auto out = builder_.build(body, false, errors);
    EXPECT_NO_THROW(errors.throw_if_any());
    return out;
  }
  FlexibleBuilder builder_;
};

TEST_F(BuildFlexible, TheSameFrameElsewhereIsReducedOnce) {
  const auto first = build(make_body("frame", bar_description()));
  ASSERT_TRUE(first);
  EXPECT_EQ(build(make_body("frame", bar_description())), first);
  BodyDescription moved = make_body("frame", bar_description());
  moved.X_WT.p = Vec3(100.0, -20.0, 3.0);
  moved.X_WT.R = rotation_exp(Vec3(0.3, 0.2, 1.0));
  auto& f = std::get<FlexibleDescription>(moved.kind);
  for (auto& [name, p] : f.points) p = moved.X_WT * p;
  for (BarDescription& b : f.bars) b.reference = moved.X_WT.R * b.reference;
  // Directions of sections are compared digit by digit.
  const auto there = build(moved);
  ASSERT_TRUE(there);
  EXPECT_NEAR(there->K(0, 0), first->K(0, 0), 1e-9 * first->K(0, 0));
}

// For variants of a model: what they do not change is not reduced again.
TEST_F(BuildFlexible, ModelsShareTheBodiesOfAnotherOne) {
  ModelDescription d;
  d.bodies.push_back(make_body("frame", bar_description()));
  const Model first = build_model(d, builder_);
  d.gravity = Vec3(0.0, 0.0, -1.0);
  EXPECT_EQ(build_model(d, builder_).bodies[0].data, first.bodies[0].data);
  EXPECT_EQ(builder_.reduced(), 1u);
  std::get<FlexibleDescription>(d.bodies[0].kind).young *= 2.0;
  const Model stiffer = build_model(d, builder_);
  EXPECT_EQ(builder_.reduced(), 2u);
  EXPECT_EQ(stiffer.bodies[0].data->K, build_model(d).bodies[0].data->K);
}

TEST_F(BuildFlexible, EveryChangeOfTheDescriptionMakesAnotherBody) {
  using F = FlexibleDescription;
  const auto damp = [](F& f, DampingReference reference, double frequency) {
    f.damping = 0.01;
    f.damping.reference = reference;
    f.damping.interface_frequency = frequency;
  };
  const std::vector<std::pair<const char*, std::function<void(F&)>>> changes{
      {"young", [](F& f) { f.young *= 2.0; }},
      {"poisson", [](F& f) { f.poisson = 0.25; }},
      {"density", [](F& f) { f.density *= 2.0; }},
      {"point", [](F& f) { f.points["c"] += Vec3(1e-6, 0.0, 0.0); }},
      {"elements", [](F& f) { f.bars[1].elements = 3; }},
      {"section", [](F& f) { f.bars[1].section = Rectangle(0.01, 0.03); }},
      {"fraction", [](F& f) { f.bars[1].from_fraction = 0.25; }},
      {"reference", [](F& f) { f.bars[1].reference = Vec3(1.0, 1.0, 0.0); }},
      {"mass", [](F& f) { f.masses[0].mass = 0.2; }},
      {"no mass", [](F& f) { f.masses.clear(); }},
      {"clamped",
       [](F& f) {
         f.clamped = {{"b", 63u}}, f.interfaces = {{"a", 6u}};
       }},
      {"interfaces",
       [](F& f) {
         f.interfaces = {{"b", 7u}};
       }},
      {"order of interfaces",
       [](F& f) {
         f.interfaces = {{"b", 4u}, {"b", 2u}};
       }},
      {"normal_modes", [](F& f) { f.normal_modes = 3; }},
      {"max_frequency", [](F& f) { f.max_frequency = 1.0; }},
      {"basis", [](F& f) { f.basis = MatX::Identity(42, 3); }},
      {"other basis", [](F& f) { f.basis = 2.0 * MatX::Identity(42, 3); }},
      {"wider basis", [](F& f) { f.basis = MatX::Identity(42, 4); }},
      {"orthonormalise", [](F& f) { f.orthonormalise = true; }},
      {"mass_model", [](F& f) { f.mass_model = MassModel::hermite; }},
      {"other mass_model", [](F& f) { f.mass_model = MassModel::six_dof; }},
      {"eigen_mass", [](F& f) { f.eigen_mass = MassModel::hermite; }},
      {"section_inertia",
       [](F& f) { f.mass_model = MassModel::hermite, f.section_inertia = true; }},
      {"damping", [](F& f) { f.damping = 0.01; }},
      {"damping of modes",
       [](F& f) {
         f.damping.fractions = {0.01, 0.02};
       }},
      {"bands", [](F& f) { f.damping.bands = usual_damping_bands(); }},
      {"Rayleigh's alpha", [](F& f) { f.damping.alpha = 0.01; }},
      {"Rayleigh's beta", [](F& f) { f.damping.beta = 0.01; }},
      {"reference of damping", [&](F& f) { damp(f, DampingReference::free, 0.0); }},
      {"mounted", [&](F& f) { damp(f, DampingReference::mounted, 0.0); }},
      {"mounted at a frequency", [&](F& f) { damp(f, DampingReference::mounted, 5.0); }},
      {"one bar", [](F& f) { f.bars.pop_back(), f.masses.clear(); }},
      {"analytic",
       [](F& f) { f.bars.pop_back(), f.masses.clear(), f.analytic = AnalyticShapes{1}; }},
      {"other analytic",
       [](F& f) { f.bars.pop_back(), f.masses.clear(), f.analytic = AnalyticShapes{2}; }}};
  std::vector<std::pair<const char*, std::shared_ptr<const FlexibleBody>>> made{
      {"as it is", build(make_body("frame", bar_description()))}};
  for (const auto& [what, change] : changes) {
    FlexibleDescription f = bar_description();
    change(f);
    const auto body = build(make_body("frame", f));
    ASSERT_TRUE(body) << what;
    for (const auto& [other, known] : made) EXPECT_NE(body, known) << what << " and " << other;
    made.emplace_back(what, body);
  }
}

}  // namespace
}  // namespace floatframe
