// Numbers, owners and forces of the rows that both formulations share.
#include "floatframe/formulation/constraint_set.hpp"

#include <gtest/gtest.h>

#include "floatframe/formulation/absolute.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

Model two_bodies_in_a_loop() {
  RandomSystem s(3);
  s.add_body("a", 2);
  s.add_body("b", 0);
  s.add_joint("first", JointType::revolute, ground_name, 0, "a", 0);
  s.add_joint("second", JointType::spherical, "a", 1, "b", 0);
  s.add_joint("loop", JointType::cylindrical, ground_name, 0, "b", 1).cut = true;
  return build_model(s.d);
}

TEST(ConstraintSet, RowsAreContiguousWithOwners) {
  const Model model = two_bodies_in_a_loop();
  const std::vector<int> joints{2, 1};
  ConstraintSet set(model, joints);
  for (const int first : {0, 7}) {
    set.number_rows(first);
    int row = first;
    for (std::size_t k = 0; k < set.parts().size(); ++k) {
      EXPECT_EQ(set.offset(k), row);
      for (int r = 0; r < set.parts()[k].rows(); ++r, ++row) {
        EXPECT_EQ(set.part_of_row(row), k);
        EXPECT_EQ(set.owner_of_row(row),
                  k + 1 < set.parts().size() ? "joint 'loop'" : "joint 'second'");
      }
    }
    EXPECT_EQ(row, first + 4 + 3);  // two of cylindrical in_line, two perpendicular; coincident
    EXPECT_EQ(set.count(), row);
    EXPECT_EQ(set.values().size(), row);
    for (int i = 0; i < first; ++i) EXPECT_EQ(set.owner_of_row(i), "the constraints");
  }
}

TEST(ConstraintSet, TreeJointsHaveNoRowsAndBodiesComeFirst) {
  const Model model = two_bodies_in_a_loop();
  const RelativeFormulation relative(model, InertiaMethod::preprocessing);
  const AbsoluteFormulation absolute(model, InertiaMethod::preprocessing);
  EXPECT_EQ(relative.constraints(), 4);
  EXPECT_EQ(relative.constraint_set().owner_of_row(0), "joint 'loop'");
  int own = 0;
  for (const AbsoluteBody& b : absolute.kinematics().bodies()) own += b.rows();
  EXPECT_EQ(absolute.constraint_set().offset(0), own);
  EXPECT_EQ(absolute.constraints(), own + 5 + 3 + 4);
  EXPECT_EQ(absolute.constraint_set().owner_of_row(own), "joint 'first'");
}

TEST(ConstraintSet, WeightsAreMultipliersAndPenaltyForces) {
  const Model model = two_bodies_in_a_loop();
  const std::vector<int> joints{2};
  ConstraintSet set(model, joints);
  set.number_rows(1);
  set.values() = VecX::LinSpaced(5, 1.0, 5.0);
  const VecX lambda = VecX::Constant(5, 10.0);
  set.set_multipliers(lambda, 2.0);
  EXPECT_EQ(set.multipliers(), lambda);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(set.weights()[i], 10.0 + 2.0 * (i + 1));
}

}  // namespace
}  // namespace floatframe::test
