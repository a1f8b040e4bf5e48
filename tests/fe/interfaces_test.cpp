// Choosing nodes, making interfaces of them, and what is said when that cannot be.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/interface_selection.hpp"
#include "support/error_of.hpp"
#include "support/fe_parts.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

/// A tube of bricks: inner radius 10 mm, outer 20 mm, 40 mm long along z, 16 x 4 x 2 elements.
/// Nodes by (angle a, layer l, ring r); numbers in the file begin at 101.
FeModel tube() {
  FeModel model;
  model.materials = {{2.1e11, 0.3, 7850}};
  for (int l = 0; l <= 4; ++l) {
    for (int r = 0; r <= 2; ++r) {
      for (int a = 0; a < 16; ++a) {
        const double angle = 2.0 * std::numbers::pi * a / 16, radius = 0.01 + 0.005 * r;
        model.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.01 * l);
        model.node_ids.push_back(101 + model.nodes() - 1);
      }
    }
  }
  const auto node = [](int a, int r, int l) { return a % 16 + 16 * (r + 3 * l); };
  for (int l = 0; l < 4; ++l) {
    for (int r = 0; r < 2; ++r) {
      for (int a = 0; a < 16; ++a) {
        FeElement e;
        e.type = FeElementType::hex8;
        e.id = static_cast<int>(model.elements.size()) + 1;
        for (int k = 0; k < 2; ++k) {
          const std::size_t at = 4 * k;
          e.nodes[at] = node(a, r, l + k);
          e.nodes[at + 1] = node(a, r + 1, l + k);
          e.nodes[at + 2] = node(a + 1, r + 1, l + k);
          e.nodes[at + 3] = node(a + 1, r, l + k);
        }
        model.elements.push_back(e);
      }
    }
  }
  model.positions.emplace_back(0.0, 0.0, 0.0);  // belongs to nothing
  model.node_ids.push_back(999);
  model.node_sets["BORE_TOP"] = {207, 192, 200, 192};
  model.node_sets["PAIR"] = {0, 8};
  model.node_sets["LINE"] = {0, 48, 96, 144};
  model.node_sets["LONE"] = {240};
  model.node_sets["EMPTY"] = {};
  model.element_sets["FIRST"] = {0};
  model.surfaces["END"] = {{0, 0}, {1, 0}};
  return model;
}

NodeChoice by_set(const std::string& name) { return {.set = name}; }

NodeChoice shape(NodeChoice::By by, const Vec3& point, const Vec3& axis = Vec3::UnitZ(),
                 double radius = 0.0, double length = 0.0, double tolerance = 0.0) {
  NodeChoice c;
  c.by = by;
  c.point = point;
  c.axis = axis;
  c.radius = radius;
  c.length = length;
  c.tolerance = tolerance;
  return c;
}

TEST(NodeChoices, EveryWay) {
  const FeModel model = tube();
  EXPECT_NO_THROW(validate(model));
  EXPECT_EQ(choose_nodes(model, by_set("BORE_TOP")), (std::vector<int>{207, 192, 200}));
  EXPECT_EQ(choose_nodes(model, by_set("bore_top")), (std::vector<int>{207, 192, 200}));
  EXPECT_EQ(choose_nodes(model, by_set("FIRST")), (std::vector<int>{0, 1, 16, 17, 48, 49, 64, 65}));
  EXPECT_EQ(choose_nodes(model, by_set("END")), (std::vector<int>{0, 1, 2, 16, 17, 18}));
  NodeChoice number = node_number(105);
  EXPECT_EQ(choose_nodes(model, number), std::vector<int>{4});
  using By = NodeChoice::By;
  // The nearest node belongs to the part, however near a loose one is.
  EXPECT_EQ(choose_nodes(model, shape(By::nearest, Vec3(0.001, 0.0, 0.0))), std::vector<int>{0});
  // The bore: all its nodes, or those in the middle; its rim by the plane of the end.
  EXPECT_EQ(choose_nodes(model, shape(By::cylinder, Vec3(0, 0, 5.0), Vec3(0, 0, -2), 0.01)).size(),
            80u);
  EXPECT_EQ(
      choose_nodes(model, shape(By::cylinder, Vec3(0, 0, 0.02), Vec3(0, 0, 1), 0.01, 0.021)).size(),
      48u);
  EXPECT_EQ(choose_nodes(model, shape(By::plane, Vec3(7, 7, 0.04), Vec3(0, 0, 3))).size(), 48u);
  EXPECT_EQ(
      choose_nodes(model, shape(By::sphere, Vec3(0, 0, 0.02), Vec3::Zero(), std::hypot(0.02, 0.02)))
          .size(),
      32u);
  EXPECT_EQ(
      choose_nodes(model, shape(By::plane, Vec3(0, 0, 0.04), Vec3(0, 0, 1), 0, 0, 0.0101)).size(),
      96u);
}

std::string refusal(FeModel model, const InterfaceDescription& d) {
  return error_of([&] { add_interface(model, d); });
}

InterfaceDescription interface(const NodeChoice& choice, Spider::Kind kind = Spider::Kind::rigid) {
  InterfaceDescription d;
  d.name = "BUSH";
  d.choice = choice;
  d.kind = kind;
  return d;
}

TEST(Interfaces, ReferencePoints) {
  using By = NodeChoice::By;
  FeModel model = tube();
  // On the axis of the bore, in the middle of its nodes; in the centre of a sphere; the centre of
  // the bounding box in a plane; or where the user says.
  InterfaceDescription d = interface(shape(By::cylinder, Vec3(0, 0, 5.0), Vec3(0, 0, -2), 0.01));
  int node = add_interface(model, d);
  EXPECT_EQ(node, 241);
  EXPECT_EQ(model.node_names[241], "BUSH");
  EXPECT_EQ(model.node_ids[241], 1000);
  EXPECT_LT((model.positions[241] - Vec3(0, 0, 0.02)).norm(), 1e-12);
  ASSERT_EQ(model.spiders.size(), 1u);
  EXPECT_EQ(model.spiders[0].nodes.size(), 80u);
  EXPECT_EQ(model.spiders[0].reference, 241);
  const FeSystem system = assemble(model);
  EXPECT_EQ(system.size(), 3 * 160 + 6);

  model = tube();
  const Vec3 centre(0, 0, 0.02);
  node = add_interface(model,
                       interface(shape(By::sphere, centre, Vec3::Zero(), std::hypot(0.02, 0.02))));
  EXPECT_EQ(model.positions[node], centre);
  model = tube();
  node = add_interface(model,
                       interface(shape(By::plane, Vec3(7, 7, 0.0401), Vec3(0, 0, 1), 0, 0, 1e-3)));
  EXPECT_LT((model.positions[node] - Vec3(0, 0, 0.0401)).norm(), 1e-12);
  model = tube();
  d = interface(by_set("BORE_TOP"), Spider::Kind::mean);
  d.at = Vec3(0.1, 0.2, 0.3);
  node = add_interface(model, d);
  EXPECT_EQ(model.positions[node], Vec3(0.1, 0.2, 0.3));
  // Again with the same nodes: the same reference, under a second name.
  d.name = "OTHER";
  EXPECT_EQ(add_interface(model, d), node);
  EXPECT_EQ(model.spiders.size(), 1u);
  EXPECT_EQ(model.node_names[node], "OTHER");
  d.name = "THIRD";
  d.at = Vec3(0.1, 0.2, 0.31);
  EXPECT_EQ(refusal(model, d), "dependent");
}

TEST(Interfaces, OneNode) {
  FeModel model = tube();
  NodeChoice number = node_number(105);
  InterfaceDescription d = interface(number);
  EXPECT_EQ(refusal(model, d), "wrong_value");
  FeModel rods = tube();
  rods.sections = {BeamSection::solid_round(0.01)};
  add_element(rods, FeElementType::rod2, {0, 240});
  NodeChoice end = number;
  end.number = 999;
  EXPECT_EQ(refusal(rods, interface(end)), "wrong_value");
  d.mask = 7;
  EXPECT_EQ(add_interface(model, d), 4);
  EXPECT_TRUE(model.spiders.empty());
  EXPECT_EQ(model.node_names[4], "BUSH");
  // The end of a beam has six degrees of freedom of its own.
  model.sections = {BeamSection::solid_round(0.01)};
  add_element(model, FeElementType::beam2, {0, 240}).reference = Vec3::UnitY();
  number.number = 999;
  d = interface(number);
  d.name = "END";
  EXPECT_EQ(add_interface(model, d), 240);
}

TEST(Interfaces, Refusals) {
  using By = NodeChoice::By;
  const FeModel model = tube();
  EXPECT_EQ(refusal(model, interface(by_set("BORE_TOB"))), "not_found");
  EXPECT_EQ(refusal(model, interface(by_set("XYZ"))), "not_found");
  EXPECT_EQ(refusal(model, interface(by_set("EMPTY"))), "missing");
  EXPECT_EQ(refusal(model, interface(by_set("LONE"))), "missing");
  EXPECT_EQ(refusal(model, interface(by_set("PAIR"))), "wrong_count");
  EXPECT_EQ(refusal(model, interface(by_set("LINE"))), "singular");
  NodeChoice number = node_number(5);
  EXPECT_EQ(refusal(model, interface(number)), "not_found");
  EXPECT_EQ(refusal(model, interface(shape(By::cylinder, Vec3(0, 0, 0), Vec3::UnitZ(), 0.0102))),
            "not_found");
  EXPECT_EQ(refusal(model, interface(shape(By::plane, Vec3(0, 0, 0.045), Vec3::UnitZ()))),
            "not_found");
  EXPECT_EQ(refusal(model, interface(shape(By::sphere, Vec3(0, 0, 0), Vec3::Zero(), 1.0))),
            "not_found");
  EXPECT_EQ(refusal(model, interface(shape(By::sphere, Vec3(0, 0, 0), Vec3::Zero(), -1.0))),
            "out_of_range");
  EXPECT_EQ(refusal(model, interface(shape(By::plane, Vec3(0, 0, 0), Vec3::Zero()))), "geometry");
  InterfaceDescription none = interface(by_set("BORE_TOP"));
  none.mask = 0;
  EXPECT_EQ(refusal(model, none), "missing");

  FeModel taken = tube();
  add_interface(taken, interface(by_set("BORE_TOP")));
  EXPECT_EQ(refusal(taken, interface(by_set("END"))), "duplicate");
  InterfaceDescription second =
      interface(shape(By::cylinder, Vec3(0, 0, 0.0), Vec3::UnitZ(), 0.01));
  second.name = "SECOND";
  EXPECT_EQ(refusal(taken, second), "dependent");
  number.number = 293;
  second.choice = number;
  second.mask = 7;
  EXPECT_EQ(refusal(taken, second), "dependent");
  FeModel bare = tube();
  bare.node_sets.clear();
  bare.element_sets.clear();
  bare.surfaces.clear();
  EXPECT_EQ(refusal(bare, interface(by_set("X"))), "not_found");
}

}  // namespace
}  // namespace floatframe::test
