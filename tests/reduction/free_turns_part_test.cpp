// Parts with rigid bars and straight beams between nodes of solids: reduced in every way,
// interfaces there.
#include <gtest/gtest.h>

#include "reduction/part_beam.hpp"
#include "support/error_of.hpp"
#include "support/fe_models.hpp"

namespace floatframe::test {
namespace {

/// Two far nodes of the beam that belong to neither end.
std::pair<int, int> two_nodes(const FeModel& model) {
  int a = -1, b = -1;
  const double length = model.positions.back().x();
  for (int k = 0; k < model.nodes(); ++k) {
    const double x = model.positions[static_cast<std::size_t>(k)].x();
    if (a < 0 && x > 0.2 * length) a = k;
    if (x < 0.8 * length) b = k;
  }
  return {a, b};
}

FeModel with_bar() {
  FeModel model = beam();
  const auto [a, b] = two_nodes(model);
  add_spider(model, a, {b});
  return model;
}

TEST(FreeTurnsOfParts, RigidBarsAreReducedInEveryWay) {
  FeModel equation = beam();
  const auto [a, b] = two_nodes(equation);
  const Vec3 e = (equation.positions[b] - equation.positions[a]).normalized();
  LinearEquation length;
  for (int axis = 0; axis < 3; ++axis) {
    length.terms.push_back({b, axis, e(axis)});
    length.terms.push_back({a, axis, -e(axis)});
  }
  equation.equations.push_back(length);
  for (const ModeMethod method :
       {ModeMethod::craig_bampton, ModeMethod::free_free, ModeMethod::craig_chang}) {
    PartOptions options = both_ends(8);
    options.method = method;
    const HealthReport bar = reduce_part(with_bar(), options).health;
    const HealthReport oracle = reduce_part(equation, options).health;
    const HealthReport plain = reduce_part(beam(), options).health;
    ASSERT_EQ(bar.free_frequencies.size(), oracle.free_frequencies.size());
    double stiffened = 0.0;
    for (std::size_t k = 0; k < bar.free_frequencies.size(); ++k) {
      EXPECT_NEAR(bar.free_frequencies[k].full / oracle.free_frequencies[k].full, 1.0, 1e-8) << k;
      EXPECT_NEAR(bar.free_frequencies[k].reduced / oracle.free_frequencies[k].reduced, 1.0, 1e-8)
          << k;
      stiffened =
          std::max(stiffened, bar.free_frequencies[k].full / plain.free_frequencies[k].full);
    }
    EXPECT_GT(stiffened, 1.01);
    EXPECT_LT(bar.rigid_residual, 1e-12);
    ASSERT_EQ(bar.notes.size(), 1u);
    EXPECT_TRUE(contains(bar.notes[0], "nothing resists the turn of 1 rigid or straight group"));
  }
}

/// The bar's own inertia about its axis goes with the elements; it bends between balls.
TEST(FreeTurnsOfParts, StraightBeamsAreReduced) {
  FeModel model = beam();
  const auto [a, b] = two_nodes(model);
  model.sections = {BeamSection::solid_round(0.01)};
  add_element(model, FeElementType::beam2, {a, b});
  const ReducedPart part = reduce_part(model, both_ends(8));
  EXPECT_LT(part.health.rigid_residual, 1e-12);
  ASSERT_TRUE(part.health.rigid_eigenvalues.has_value());
  EXPECT_LT(part.health.rigid_eigenvalues->cwiseAbs().maxCoeff(), 1e-6);
  const double length = (model.positions[b] - model.positions[a]).norm();
  EXPECT_NEAR(part.health.from_elements.mass,
              reduce_part(beam(), both_ends(8)).health.from_elements.mass +
                  steel.density * model.sections[0].A * length,
              1e-12);
}

TEST(FreeTurnsOfParts, AnInterfaceCannotHoldThem) {
  FeModel model = with_bar();
  const int a = model.spiders[0].reference;
  PartOptions options = both_ends(4);
  options.interfaces.push_back(interface_at("BAR", node_number(a + 1)));
  EXPECT_EQ(error_of([&] { reduce_part(model, options); }), "singular");
  options.interfaces.back().mask = 7;
  const ReducedPart part = reduce_part(model, options);
  EXPECT_EQ(part.body.nodes.back().name, "BAR");
  EXPECT_LT(part.health.rigid_residual, 1e-12);
}

/// A third node beside the line that holds the bar: nothing would resist a force there.
TEST(FreeTurnsOfParts, AForceOffTheLineCannotTurnThem) {
  FeModel model = beam();
  const auto [a, b] = two_nodes(model);
  add_spider(model, model.nodes(), {a, b});
  model.positions.push_back(model.positions[a] + Vec3(0.01, 0.3, 0.2));
  PartOptions options = both_ends(4);
  options.interfaces.push_back(interface_at("ARM", node_number(model.nodes()), 7));
  EXPECT_EQ(error_of([&] { reduce_part(model, options); }), "singular");
  options.interfaces.pop_back();
  options.markers.push_back(
      {.name = "TIP", .choice = node_number(model.nodes()), .at = {}, .residual = true});
  EXPECT_EQ(error_of([&] { reduce_part(model, options); }), "singular");
  options.markers[0].residual = false;
  EXPECT_LT(reduce_part(model, options).health.rigid_residual, 1e-12);
}

}  // namespace
}  // namespace floatframe::test
