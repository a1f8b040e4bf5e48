// Terms of first order of a SID_FEM file: displacements of second order come back.
#include <gtest/gtest.h>

#include <sstream>

#include "floatframe/fe/bar_frame.hpp"
#include "floatframe/formats/sid/sid_content.hpp"
#include "floatframe/reduction/part.hpp"
#include "floatframe/reduction/reduction.hpp"
#include "support/contains.hpp"
#include "support/fe_parts.hpp"
#include "support/iltis_parts.hpp"
#include "support/reference_json.hpp"

namespace floatframe::test {
namespace {

FlexibleBody bent_bar() {
  ReductionOptions options = a_arm_options();
  options.mass_model = MassModel::hermite;
  return reduce(build_bar_frame(a_arm_frame(5)), options);
}

FlexibleBody bricks(const BodyReference& reference) {
  FeModel model = brick_beam(4, 1, 1, 0.3, 0.03);
  for (Vec3& p : model.positions) p += Vec3(0.1, 0.2 * p.x() * p.x(), 0.05 * p.y());
  PartOptions options;
  options.interfaces = {bore("A"), bore("B")};
  options.reference = reference;
  options.modes = 2;
  return reduce_part(model, options).body;
}

std::vector<FlexibleBody> stiffened_bodies() {
  return {bent_bar(), bricks({}), bricks({BodyReference::Kind::node, "A"})};
}

double largest_of(const SecondOrder& s) {
  double size = 0.0;
  for (const auto& row : s.S2i)
    for (const MatX& m : row) size = std::max(size, m.cwiseAbs().maxCoeff());
  return size;
}

TEST(SidSecondOrder, WrittenComesBack) {
  for (const FlexibleBody& body : stiffened_bodies()) {
    const SidBody read = parse_sid(write_sid(body, ""), "body.SID_FEM");
    EXPECT_TRUE(read.notes.empty()) << read.notes.front();
    ASSERT_TRUE(read.body.second_order);
    const SecondOrder &s = *body.second_order, &t = *read.body.second_order;
    // S2i is what Oe has beside the inertia: rounded in the size of both.
    const double size = std::max(largest_of(s), body.invariants.Sij[2][2].norm());
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_LT((s.S2[j] - t.S2[j]).norm(), 1e-14 * (s.S2[j].norm() + 1e-12));
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LT((s.S2i[i][j] - t.S2i[i][j]).norm(), 1e-13 * size);
        EXPECT_LT((body.invariants.Sij[i][j] - read.body.invariants.Sij[i][j]).norm(),
                  1e-13 * size);
      }
    }
    ASSERT_EQ(s.nodes.size(), t.nodes.size());
    for (std::size_t k = 0; k < s.nodes.size(); ++k) {
      EXPECT_EQ(s.nodes[k].node, t.nodes[k].node);
      for (std::size_t j = 0; j < 3; ++j) {
        EXPECT_EQ(s.nodes[k].h[j], t.nodes[k].h[j]);
        EXPECT_EQ(s.nodes[k].theta[j], t.nodes[k].theta[j]);
      }
    }
  }
}

/// The text without the first-order terms of a block.
std::string cut(const std::string& text, const std::string& block) {
  std::istringstream in(text);
  std::string out, line;
  bool inside = false;
  while (std::getline(in, line)) {
    const std::string word = line.substr(std::min(line.size(), line.find_first_not_of(' ')));
    if (word == block) inside = true;
    if (word == "end " + block) inside = false;
    if (inside && word.starts_with("m1(")) continue;
    if (inside && word.starts_with("order")) line = "order = 0";
    out += line + '\n';
  }
  return out;
}

TEST(SidSecondOrder, WithoutGrTheSumIsExact) {
  for (const FlexibleBody& body : stiffened_bodies()) {
    const SidBody read = parse_sid(cut(write_sid(body, ""), "Gr"), "body.SID_FEM");
    ASSERT_EQ(read.notes.size(), 1u);
    EXPECT_TRUE(contains(read.notes[0], "geometric stiffening, whose sum with inertia is kept"));
    const InertiaInvariants &v = body.invariants, &w = read.body.invariants;
    const double size = std::max(largest_of(*body.second_order), v.Sij[2][2].norm());
    const auto total = [](const FlexibleBody& b, std::size_t i, std::size_t j) {
      return MatX(b.invariants.Sij[i][j] + b.invariants.Sij[j][i] + b.second_order->S2i[i][j] +
                  b.second_order->S2i[j][i]);
    };
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        EXPECT_LT((total(body, i, j) - total(read.body, i, j)).norm(), 1e-13 * size);
        EXPECT_LT((v.Sij[i][j] - v.Sij[j][i] - w.Sij[i][j] + w.Sij[j][i]).norm(), 1e-13 * size);
      }
  }
}

/// What turns with nodes is written with the rest, and comes back as one with it.
TEST(SidSecondOrder, WhatTurnsIsAddedToTheRest) {
  FlexibleBody body = bricks({});
  SecondOrder turning = *body.second_order, sum = turning;
  turning.nodes.clear();
  for (std::size_t j = 0; j < 3; ++j) {
    sum.S2[j] *= 2.0;
    for (std::size_t i = 0; i < 3; ++i) sum.S2i[i][j] *= 2.0;
  }
  body.turning = std::make_shared<const SecondOrder>(turning);
  const FlexibleBody both = parse_sid(write_sid(body, ""), "body.SID_FEM").body;
  body.second_order = nullptr;
  const FlexibleBody alone = parse_sid(write_sid(body, ""), "body.SID_FEM").body;
  const double size = std::max(largest_of(turning), body.invariants.Sij[2][2].norm());
  EXPECT_EQ(both.turning, nullptr);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_LT((both.second_order->S2i[i][j] - sum.S2i[i][j]).norm(), 1e-13 * size);
      EXPECT_LT((alone.second_order->S2i[i][j] - turning.S2i[i][j]).norm(), 1e-13 * size);
    }
}

/// A file whose Oe is of inertia alone, and nothing else is of first order, has none.
TEST(SidSecondOrder, LinearFilesHaveNone) {
  FlexibleBody body = bent_bar();
  body.second_order = nullptr;
  const std::string text = write_sid(body, "");
  EXPECT_EQ(parse_sid(text, "body.SID_FEM").body.second_order, nullptr);
  EXPECT_EQ(text.find("m1( 1, 1, 1)", text.find("           Gr\n")),
            text.find("m1( 1, 1, 1)", text.find("           Oe\n")));
}

}  // namespace
}  // namespace floatframe::test
