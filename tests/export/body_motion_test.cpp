// Nodes of exported bodies move as the markers of the solver do, and as their morph targets say.
#include "floatframe/export/body_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/export/morph_targets.hpp"
#include "floatframe/history/recorded_motion.hpp"
#include "history/recorded_run.hpp"

namespace floatframe::test {
namespace {

/// A soft beam of steel rope swings and spins: its shortening is visible. A bent one has modes that
/// turn its nodes about all axes.
const std::string soft_machine = R"(
points: {p: [0, 0, 0], corner: [0.5, 0, 0], tip: [0.5, 0.4, 0.1]}
bodies:
  hub: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [0.01, 0.01, 0.01]}}
  beam:
    flexible:
      material: {young: 6e9, poisson: 0.3, density: 1500}
      bars:
        one: {from: p, to: corner, elements: 3, section: {rectangle: [0.02, 0.01]}}
        two: {from: corner, to: tip, elements: 3, section: {round: 0.012}}
      clamped: [p]
      static_modes: [{point: tip, dofs: [x, y, z]}]
      normal_modes: 3
      damping: 0.02
    geometric_stiffening: STIFFENS
joints:
  drive: {type: revolute, child: hub, at: p, axis: z, motion: {polynomial: [0, 9]}}
  hinge: {type: revolute, parent: hub, child: beam, at: p, axis: y, position: 0.2}
forces:
  load: {type: torque, body: beam, node: tip, direction: [0, 1, 0], follows: true, magnitude: 0.3}
outputs:
  corner: {position: {body: beam, node: corner}}
  tip: {position: {body: beam, node: tip}}
simulation: {step: 2.0e-3, duration: 0.4, spectral_radius: 0.8}
)";

Model soft_model(bool stiffens) {
  std::string text = soft_machine;
  const std::string word = "STIFFENS";
  text.replace(text.find(word), word.size(), stiffens ? "true" : "false");
  return model_of(text);
}

class ExportedNodes : public ::testing::TestWithParam<std::tuple<Coordinates, bool>> {};

TEST_P(ExportedNodes, MoveAsMarkersDo) {
  const auto [coordinates, stiffens] = GetParam();
  const TemporaryFolder folder;
  const Model model = soft_model(stiffens);
  SimulationDescription o = model.simulation;
  o.coordinates = coordinates;
  ASSERT_EQ(recorded_run(model, o, folder.file("states.ffr")).result.summary.status, "completed");
  const StateHistory history(folder.file("states.ffr"));
  RecordedMotion motion(history, model, o);
  double bent = 0.0, turned = 0.0;
  for (std::size_t k = 0; k < motion.instants(); k += 40) {
    const SystemMotion& view = motion.at(k);
    for (int marker = 0; marker < static_cast<int>(model.markers.size()); ++marker) {
      const Marker& m = model.markers[marker];
      if (m.node < 0 || !m.X_NM.p.isZero(0.0)) continue;
      const Body& body = model.bodies[m.body];
      const BodyInstant of_body = body_motion(view, m.body);
      const NodeMotion found = node_motion(body, m.node, of_body);
      EXPECT_LT((found.p - view.place(marker)).norm(), 1e-13);
      EXPECT_LT((found.v - view.marker(marker).v).norm(), 1e-12);
      if (m.rotates) {
        turned = std::max(turned, (found.R - of_body.R).norm());
        EXPECT_LT((found.R * m.X_NM.R - view.marker(marker).R).norm(), 1e-13);
        EXPECT_LT((found.w - view.marker(marker).w).norm(), 1e-11);
      }
      EXPECT_LT(
          (of_body.p + of_body.R * body.data->nodes[m.node].p + found.deformation - found.p).norm(),
          1e-14);
      const Vec3 linear = of_body.R * (body.data->nodes[m.node].X * of_body.y);
      bent = std::max(bent, (linear - found.deformation).norm());
    }
  }
  EXPECT_EQ(bent > 1e-5, stiffens) << bent;
  EXPECT_GT(turned, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(All, ExportedNodes,
                         ::testing::Combine(::testing::Values(Coordinates::relative,
                                                              Coordinates::absolute),
                                            ::testing::Bool()));

TEST(MorphTargets, AddUpToTheDeformation) {
  for (const bool stiffens : {false, true}) {
    const Model model = soft_model(stiffens);
    const Body& body = model.bodies[1];
    const BodyPicture picture = body_picture(model, 1);
    ASSERT_EQ(picture.names, (std::vector<std::string>{"p", "corner", "tip"}));
    const int nm = body.modes();
    BodyInstant m;
    std::vector<double> amplitudes;
    std::vector<VecX> instants;
    for (int k = 0; k < 5; ++k) {
      VecX y(nm);
      for (int a = 0; a < nm; ++a) y[a] = 0.01 * std::sin(1.0 + 3.0 * k + 0.7 * a * a);
      instants.push_back(y);
      amplitudes.insert(amplitudes.end(), y.data(), y.data() + nm);
    }
    const std::vector<MorphTarget> targets = morph_targets(picture, *body.data, {&amplitudes});
    PictureMotion moved;
    for (const VecX& y : instants) {
      m.y = y;
      m.yd = VecX::Zero(nm);
      move_picture(picture, m, moved);
      VecX sum = VecX::Zero(3 * picture.points.cols());
      for (const MorphTarget& t : targets) {
        EXPECT_GE(t.weight(y.data()), 0.0);
        EXPECT_LE(t.weight(y.data()), 1.0 + 1e-15);
        sum += t.weight(y.data()) * t.field;
      }
      const Eigen::Map<const VecX> u(moved.u.data(), moved.u.size());
      EXPECT_GT(u.norm(), 1e-3);
      EXPECT_LT((sum - u).cwiseAbs().maxCoeff(), 1e-7);
    }
    // A mode that does not move is none.
    std::vector<double> one(amplitudes.size(), 0.0);
    one[0] = 0.02;
    const std::vector<MorphTarget> single = morph_targets(picture, *body.data, {&one});
    ASSERT_EQ(single.size(), stiffens ? 2u : 1u);
    EXPECT_EQ(single[0].weight(one.data()), 1.0);
    EXPECT_EQ(single[0].name, body.data->mode_names.empty() ? "mode 1" : body.data->mode_names[0]);
  }
}

TEST(ContinuedQuaternion, DoesNotJump) {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  for (int k = 0; k < 200; ++k) {
    const Mat3 R = Eigen::AngleAxisd(0.1 * k, Vec3(1, 2, -1).normalized()).toRotationMatrix();
    const Eigen::Quaterniond next = continued_quaternion(R, q);
    EXPECT_GT(next.dot(q), 0.99);
    EXPECT_LT((next.toRotationMatrix() - R).norm(), 1e-13);
    q = next;
  }
  EXPECT_LT(
      q.angularDistance(Eigen::Quaterniond(Eigen::AngleAxisd(19.9, Vec3(1, 2, -1).normalized()))),
      1e-12);
}

}  // namespace
}  // namespace floatframe::test
