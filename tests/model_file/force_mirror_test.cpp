// The mirror image of every force element: in the mirrored model it does the mirrored thing.
#include <gtest/gtest.h>

#include "floatframe/formulation/relative.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model_file/mirror.hpp"
#include "support/element_motion.hpp"
#include "support/random_force.hpp"

namespace floatframe::test {
namespace {

/// Two bodies that fly about, one on a hinge, and an element of the type.
ModelDescription flying(ElementType type, unsigned seed) {
  ExampleNumbers numbers(seed);
  ModelDescription d;
  for (const char* name : {"one", "two", "hinged"}) {
    BodyDescription b;
    b.name = name;
    RigidDescription r;
    r.mass = 1.0;
    r.J_C.diagonal() << 0.1, 0.2, 0.25;
    b.kind = r;
    b.X_WB = b.X_WT = {numbers.vector(), numbers.rotation()};
    d.bodies.push_back(b);
    JointDescription j;
    const bool hinge = d.bodies.size() == 3;
    j.name = std::string("of_") + name;
    j.type = hinge ? JointType::revolute : JointType::free;
    j.parent.point = j.child.point = b.X_WB.p;
    j.child.body = name;
    j.axis = numbers.direction();
    for (int k = 0; k < (hinge ? 1 : 6); ++k) {
      j.position.push_back(numbers(-0.4, 0.4));
      j.velocity.push_back(numbers(-1.0, 1.0));
    }
    d.joints.push_back(j);
  }
  RoadDescription road;
  road.name = "slope";
  road.pieces = PiecewisePolynomial::polynomial({1.0, 0.1});  // above the bodies
  d.roads.push_back(road);
  RandomForceEnds ends;
  ends.a.body = "one";
  ends.a.point = numbers.vector();
  ends.b.body = "two";
  ends.b.point = numbers.vector();
  ends.joint = "of_hinged";
  ends.road = "slope";
  ends.length = 1.0;
  d.forces.push_back(random_force(type, ends, numbers));
  return d;
}

Efforts state_of(const ModelDescription& d) {
  const Model model = build_model(d);
  RelativeFormulation f(model, InertiaMethod::preprocessing);
  VecX q, v;
  f.start(model, 0.0, q, v);
  f.positions(0.0, q);
  f.velocities(v);
  f.forces();
  return f.effort(0);
}

ModelDescription image_of(ModelDescription d, const Placement& x) {
  for (BodyDescription& b : d.bodies) place(b, x);
  for (JointDescription& j : d.joints) place(j, x);
  for (ElementDescription& f : d.forces) place(f, x);
  return d;
}

TEST(Mirror, ImageOfEveryForceDoesTheMirroredThing) {
  for (const ElementType type : types_of(ElementList::forces)) {
    bool acts = false;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const ModelDescription d = flying(type, seed);
      // A road is a profile over x.
      const auto keys = element_keys(type);
      const bool on_road = std::any_of(keys.begin(), keys.end(), [](const ElementKey& key) {
        return key.kind == KeyKind::road;
      });
      const Placement y = reflection(1, 0.3), x = on_road ? y : reflection(0, -0.2);
      for (const Placement& p : {y, x, y * x}) {
        const Efforts a = state_of(d), b = state_of(image_of(d, p));
        const double size = 1e-12 * (1.0 + stacked(a).norm());
        for (std::size_t i = 0; i < a.markers(); ++i) {
          EXPECT_LT((b.wrench[i].F - p.polar(a.wrench[i].F)).norm(), size)
              << element_type_name(type);
          EXPECT_LT((b.wrench[i].T - p.axial(a.wrench[i].T)).norm(), size)
              << element_type_name(type);
        }
        EXPECT_NEAR(b.energy, a.energy, 1e-12 * (1.0 + std::abs(a.energy)));
        acts = acts || stacked(a).norm() > 1e-3;
      }
    }
    EXPECT_TRUE(acts) << element_type_name(type);
  }
}

}  // namespace
}  // namespace floatframe::test
