// Parts that cannot be reduced: the code of each error.
#include <gtest/gtest.h>

#include <functional>

#include "floatframe/reduction/body_reference.hpp"
#include "reduction/part_beam.hpp"
#include "support/error_of.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

std::string refusal(const FeModel& model, const PartOptions& options) {
  return error_of([&] { reduce_part(model, options); });
}

/// Of the beam, with the options changed.
std::string refusal(const std::function<void(PartOptions&)>& change) {
  PartOptions options = both_ends();
  change(options);
  return refusal(beam(), options);
}

TEST(PartErrors, Codes) {
  EXPECT_EQ(refusal([](PartOptions& o) { o.interfaces.clear(); }), "incomplete");
  EXPECT_EQ(refusal([](PartOptions& o) {
              o.reference = {BodyReference::Kind::node, "C"};
            }),
            "not_found");
  EXPECT_EQ(refusal([](PartOptions& o) { o.modes = 400; }), "out_of_range");
  EXPECT_EQ(refusal([](PartOptions& o) {
              o.method = ModeMethod::free_free;
              o.effective_mass = 0.9;
            }),
            "unsupported");

  FeModel loose = beam();
  const FeModel other = brick_beam(1, 1, 1, 0.01, 0.01);
  const int first = loose.nodes();
  for (const Vec3& p : other.positions) loose.positions.push_back(p + Vec3(0, 0.5, 0));
  FeElement e = other.elements[0];
  for (std::size_t a = 0; a < 8; ++a) e.nodes[a] += first;
  loose.elements.push_back(e);
  EXPECT_EQ(refusal(loose, both_ends()), "singular");

  FeModel huge = beam();
  huge.materials[0].young = 1e308;
  for (Vec3& p : huge.positions) p *= 1e3;
  EXPECT_EQ(refusal(huge, both_ends()), "too_large");

  FeModel massless = beam();
  massless.materials[0].density = 0.0;
  EXPECT_EQ(refusal(massless, both_ends()), "singular");

  // Two bricks that share an edge only, at the middle of the part: a hinge.
  FeModel hinge = brick_beam(2, 1, 1, 0.2, 0.1);
  const int extra = hinge.nodes();
  hinge.positions.push_back(hinge.positions[5]);
  hinge.positions.push_back(hinge.positions[7]);
  for (std::size_t a = 0; a < 8; ++a) {
    int& node = hinge.elements[1].nodes[a];
    if (node == 5) node = extra;
    if (node == 7) node = extra + 1;
  }
  PartOptions one_end = both_ends(2);
  one_end.interfaces = {bore("A")};
  EXPECT_EQ(refusal(hinge, one_end), "singular");

  // Held on both sides it is a seventh motion without stiffness: the edge moves, the ends turn.
  for (const ModeMethod method :
       {ModeMethod::craig_bampton, ModeMethod::free_free, ModeMethod::craig_chang}) {
    PartOptions held = both_ends(2);
    held.method = method;
    EXPECT_EQ(refusal(hinge, held), "singular") << static_cast<int>(method);
  }
  // A node that does not move: the part is held.
  FeModel held = beam();
  held.equations.push_back({{{13, 0, 1.0}}, {}});
  EXPECT_EQ(refusal(held, both_ends()), "contradiction");

  EXPECT_EQ(refusal([](PartOptions& o) { o.interfaces.push_back(bore("A")); }), "duplicate");
  EXPECT_EQ(refusal([](PartOptions& o) {
              o.markers = {{"A", {.set = "MIDDLE"}, {}}};
            }),
            "duplicate");
}

// Cubes that share an edge (a hinge) or a corner (a ball): so few elements that the seventh motion
// is as simple as a motion of the whole.
TEST(PartErrors, MechanismsOfTwoElementsNameNodes) {
  for (const double size : {1.0, 1e-3}) {
    for (const Vec3& shift : {Vec3(1, 0, 1), Vec3(1, 1, 1)}) {
      FeModel model = brick_beam(1, 1, 1, size, size);
      const int first = model.nodes();
      FeElement other = model.elements[0];
      for (int& node : other.nodes) {
        const Vec3 p = model.positions[node] + size * shift;
        int same = -1;
        for (int k = 0; k < first; ++k)
          if ((model.positions[k] - p).norm() < 1e-9 * size) same = k;
        node = same < 0 ? model.nodes() : same;
        if (same < 0) model.positions.push_back(p);
        if (&node == &other.nodes[7]) break;
      }
      model.elements.push_back(other);
      PartOptions options;
      options.method = ModeMethod::free_free;
      options.modes = 1;
      EXPECT_EQ(refusal(model, options), "singular") << size << ' ' << shift.z();
    }
  }
}

// The reference of a coupling that holds some directions only is as loose at an interface as
// inside.
TEST(PartErrors, FreedomsThatNothingFollowsAreNamed) {
  FeModel model = beam();
  add_spider(model, model.nodes(), model.node_sets["B"]).mask = 1u;
  model.positions.emplace_back(0.6, 0.015, 0.015);
  PartOptions options = both_ends(3);
  for (const ModeMethod method : {ModeMethod::craig_bampton, ModeMethod::craig_chang}) {
    options.method = method;
    EXPECT_EQ(refusal(model, options), "singular");
  }
  options.interfaces = {bore("A")};
  EXPECT_EQ(refusal(model, options), "singular");
}

TEST(PartErrors, CombinationsWithoutMass) {
  InertiaInvariants raw = InertiaInvariants::zero(9);
  raw.m = 1.0;
  raw.P_u = Mat3::Identity();
  raw.Sij[0][0] = MatX::Identity(9, 9);
  MatX B = MatX::Identity(6, 9);
  MatX K = MatX::Identity(9, 9);
  EXPECT_EQ(elastic_modes(K, raw, B).lambda.size(), 3);
  raw.Sij[0][0](7, 8) = raw.Sij[0][0](8, 7) = 1.0;  // the same motion twice
  const ElasticModes rest = elastic_modes(K, raw, B);
  EXPECT_EQ(rest.lambda.size(), 2);
  EXPECT_EQ(rest.without_mass, 1);
  const auto error = [&] { return error_of([&] { elastic_modes(K, raw, B); }); };
  K.bottomRightCorner<2, 2>().setOnes();  // nor stiffness where they differ
  EXPECT_EQ(error(), "singular");
  B.row(5).setZero();
  EXPECT_EQ(error(), "singular");
}

}  // namespace
}  // namespace floatframe::test
