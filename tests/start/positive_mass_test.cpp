// The mass matrix of a rotor part is positive for small deformations only, in a frame that follows
// a node for much smaller ones than in mean axes: a run that fails there says so.
#include "floatframe/start/positive_mass.hpp"

#include <gtest/gtest.h>

#include "floatframe/model_file/load_model.hpp"
#include "floatframe/run/run.hpp"
#include "support/whirl_rotors.hpp"

namespace floatframe::test {
namespace {

Model rotor(const TemporaryFolder& folder, bool node_frame, const char* coordinates) {
  RotorOptions o;
  o.kind = RotorKind::cbar, o.node_frame = node_frame, o.coordinates = coordinates;
  o.across = 0.5, o.modes = 16, o.step = 2e-5, o.duration = 0.004;
  return load_model(write_rotor(folder, lalanne_ferraris(true), o));
}

/// Amplitudes that move end B across the shaft by `u`, as little of each mode as possible.
VecX bent(const FlexibleBody& body, double u) {
  const ModalNode* end = nullptr;
  for (const ModalNode& n : body.nodes)
    if (n.name == "B") end = &n;
  const VecX row = end->X.row(1).transpose();
  return row * (u / row.squaredNorm());
}

TEST(PositiveMass, FallsWithTheSquareOfTheBendInAFrameOfANode) {
  const TemporaryFolder folder;
  const Model node = rotor(folder, true, "relative");
  const Body& body = node.bodies.front();
  EXPECT_DOUBLE_EQ(mass_margin(body, VecX::Zero(body.modes())), 1.0);
  const double one = 1.0 - mass_margin(body, bent(*body.data, 1e-4)),
               two = 1.0 - mass_margin(body, bent(*body.data, 2e-4));
  std::printf("[ figure ] mass_margin_node %.3g %.3g\n", one, two);
  EXPECT_GT(one, 0.0);
  EXPECT_NEAR(two / one, 4.0, 0.4);
  EXPECT_TRUE(lost_mass(body, bent(*body.data, 1e-4)).empty());

  const TemporaryFolder other;
  const Model mean = rotor(other, false, "relative");
  const Body& free = mean.bodies.front();
  EXPECT_GT(mass_margin(free, bent(*free.data, 0.02)), 0.5);
}

TEST(PositiveMass, ARunThatFailsForItNamesIt) {
  for (const char* coordinates : {"relative", "absolute"}) {
    const TemporaryFolder folder;
    const Model model = rotor(folder, true, coordinates);
    const RunResult r = run(model);
    EXPECT_NE(r.summary.message.find("the mass matrix of body 'shaft' is hardly positive at this "
                                     "deformation"),
              std::string::npos)
        << coordinates << ": " << r.summary.message;
  }
}

}  // namespace
}  // namespace floatframe::test
