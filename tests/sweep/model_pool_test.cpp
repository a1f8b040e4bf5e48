// What the workers of a study build again for a run, and what they share.
#include "floatframe/sweep/model_pool.hpp"

#include <gtest/gtest.h>

#include "support/valid_description.hpp"

namespace floatframe::test {
namespace {

TEST(ModelPool, BuildsOnlyWhatDiffers) {
  ModelDescription d;
  BodyDescription body;
  body.name = "frame";
  body.kind = bar_description();
  d.bodies.push_back(body);
  ModelPool pool(2);
  int built = 0;
  const auto get = [&](const std::string& model, const std::string& simulation) {
    ModelFingerprint fingerprint;
    fingerprint.model = model;
    fingerprint.simulation = simulation;
    return pool.get(fingerprint, d.simulation, [&] {
      ++built;
      return d;
    });
  };
  const auto first = get("a", "s");
  EXPECT_EQ(get("a", "s"), first);
  EXPECT_EQ(get("a", "other step")->bodies[0].data, first->bodies[0].data);
  EXPECT_EQ(built, 1);
  d.gravity = Vec3(0.0, 0.0, -1.0);
  const auto lighter = get("b", "s");
  EXPECT_EQ(built, 2);
  EXPECT_EQ(lighter->gravity.z(), -1.0);
  EXPECT_EQ(lighter->bodies[0].data, first->bodies[0].data);  // not reduced again
}

}  // namespace
}  // namespace floatframe::test
