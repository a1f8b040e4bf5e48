// Parts from files in a model: switching between rigid and flexible, placing, mirroring, sockets.
#include <gtest/gtest.h>

#include <filesystem>

#include "floatframe/description/inertia_choice.hpp"
#include "floatframe/formats/body_file/body_file.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

// The bracket: markers foot, knee, eye; five modes; mass about 1.5 kg.
const std::string bracket_file = FLOATFRAME_TEST_DATA "/body_files/bracket_v1.ffb";

class Parts : public testing::Test {
 protected:
  Parts() { std::filesystem::copy_file(bracket_file, folder_ / "bracket.ffb"); }

  Model model(const std::string& text, const std::vector<ParameterOverride>& overrides = {}) {
    return build_model(read_model(write(text), overrides));
  }
  std::string write(const std::string& text) {
    return folder_.write("model.yaml", "floatframe: 1\n" + text);
  }

  test::TemporaryFolder folder_;
  BodyFile bracket_ = read_body_file(bracket_file);
};

Vec3 world(const Body& body, std::size_t node) { return body.X_WB * body.data->nodes[node].p; }

TEST_F(Parts, BodyFileIsTheBody) {
  const Model m = model(
      "bodies:\n  arm: {flexible: bracket.ffb, position: [1, 2, 3], orientation: [0, 0, 0.5]}\n"
      "joints:\n  ball: {type: spherical, child: arm, child_node: eye}\n"
      "outputs: {tip: {position: {body: arm, node: foot}}}\n");
  const Body& arm = m.bodies[0];
  EXPECT_EQ(arm.modes(), 5);
  EXPECT_EQ(arm.data->K, bracket_.part.body.K);
  EXPECT_EQ(arm.data->invariants.m, bracket_.part.body.invariants.m);
  const Vec3 expected =
      Vec3(1, 2, 3) + rotation_exp(Vec3(0, 0, 0.5)) * bracket_.part.body.nodes[2].p;
  EXPECT_LT((world(arm, 2) - expected).norm(), 1e-15);
  EXPECT_EQ(m.markers[m.joints[0].frame_M].node, 2);
}

TEST_F(Parts, PositionOfAPartIsThatOfTheFileUnlessGiven) {
  const Model m = model(
      "points: {p: [0.3, 0.2, 0.25]}\n"
      "bodies: {arm: {part: bracket.ffb}}\n"
      "joints: {ball: {type: spherical, child: arm, at: p}}\n");
  EXPECT_EQ(m.bodies[0].X_WB.p, Vec3(0, 0, 0));
  EXPECT_EQ(m.bodies[0].modes(), 5);
  EXPECT_EQ(m.markers[m.joints[0].frame_M].node, 2);  // by position
}

TEST_F(Parts, OneKeySwitchesToRigid) {
  const std::string text =
      "parameters: {flex: true}\n"
      "bodies: {arm: {part: bracket.ffb, flexible: \"${flex}\"}}\n"
      "joints: {ball: {type: spherical, child: arm, child_node: eye}}\n"
      "forces: {pull: {type: force, body: arm, node: foot, direction: x, magnitude: 1}}\n"
      "outputs:\n"
      "  foot: {position: {body: arm, node: foot}}\n"
      "  bend: {modal_amplitude: arm, mode: 1, when: \"${flex}\"}\n";
  const Model soft = model(text), stiff = model(text, {{"flex", "false"}});
  EXPECT_EQ(soft.bodies[0].modes(), 5);
  EXPECT_EQ(stiff.bodies[0].modes(), 0);
  EXPECT_EQ(stiff.bodies[0].data->nodes.size(), 3u);
  EXPECT_EQ(stiff.bodies[0].data->nodes[2].name, "eye");
  const InertiaInvariants &v = soft.bodies[0].data->invariants,
                          &w = stiff.bodies[0].data->invariants;
  EXPECT_EQ(v.m, w.m);
  EXPECT_EQ(v.m_u, w.m_u);
  EXPECT_EQ(v.P_u, w.P_u);
  for (const Model* m : {&soft, &stiff}) {
    const Marker& marker = m->markers[m->joints[0].frame_M];
    EXPECT_EQ(marker.node, 2);
  }
  EXPECT_EQ(soft.outputs.size(), 4u);
  EXPECT_EQ(stiff.outputs.size(), 3u);
}

TEST_F(Parts, BarsSwitchToo) {
  const auto bars = [](const std::string& keys) {
    return "points: {a: [0, 0, 1], b: [0.5, 0, 1]}\n"
           "bodies:\n"
           "  arm:\n" +
           keys +
           "      material: {young: 2e11, poisson: 0.3, density: 7800}\n"
           "      bars: {one: {from: a, to: b, elements: 4, section: {round: 0.02}}}\n"
           "      clamped: [a]\n"
           "      normal_modes: 2\n"
           "joints: {pin: {type: revolute, child: arm, at: a, axis: y}}\n"
           "outputs: {tip: {position: {body: arm, node: b}}}\n";
  };
  const Model old = model(bars("    flexible:\n")), part = model(bars("    part:\n"));
  EXPECT_EQ(old.bodies[0].data->K, part.bodies[0].data->K);
  EXPECT_EQ(part.bodies[0].X_WB.p, Vec3(0, 0, 1));  // start of the first bar
  const Model rigid = model(bars("    flexible: false\n    part:\n"));
  EXPECT_EQ(rigid.bodies[0].modes(), 0);
  EXPECT_EQ(rigid.bodies[0].data->nodes.size(), 5u);
  // A massive line: m = rho A l, J = m l^2 / 3 about its end.
  const double m = 7800 * 1e-4 * M_PI * 0.5;
  EXPECT_NEAR(rigid.bodies[0].data->invariants.m, m, 1e-13);
  EXPECT_NEAR(rigid.bodies[0].data->invariants.inertia_about_origin()(1, 1), m * 0.25 / 3, 1e-13);
}

TEST_F(Parts, RigidGroupAndUseStayAsTheyWere) {
  const std::string text =
      "parameters: {use: flexible}\n"
      "bodies:\n"
      "  arm:\n"
      "    use: \"${use}\"\n"
      "    rigid: {mass: 7, centre_of_mass: [0.1, 0, 0]}\n"
      "    part: bracket.ffb\n"
      "    position: [0, 0, 0]\n";
  EXPECT_EQ(model(text).bodies[0].modes(), 5);
  const Model rigid = model(text, {{"use", "rigid"}});
  EXPECT_EQ(rigid.bodies[0].modes(), 0);
  EXPECT_EQ(rigid.bodies[0].data->invariants.m, 7.0);
}

TEST_F(Parts, AlignmentFindsThePose) {
  Pose X;
  X.p = Vec3(1.0, -2.0, 0.5);
  X.R = rotation_exp(Vec3(0.3, -1.1, 2.0));
  const auto text = [&](double error) {
    std::string points, pairs;
    for (const ModalNode& n : bracket_.part.body.nodes) {
      const Vec3 w = X * n.p + (n.name == "eye" ? error : 0.0) * X.R.col(2);
      points += (points.empty() ? "" : ", ") + n.name + "_w: [" + std::to_string(w.x()) + ", " +
                std::to_string(w.y()) + ", " + std::to_string(w.z()) + "]";
      pairs += (pairs.empty() ? "" : ", ") + n.name + ": " + n.name + "_w";
    }
    return "points: {" + points + "}\nbodies: {arm: {part: bracket.ffb, align: {" + pairs +
           "}, align_tolerance: 0.01}}\n";
  };
  const Model exact = model(text(0.0));  // six digits after the point
  EXPECT_LT((exact.bodies[0].X_WB.p - X.p).norm(), 5e-6);
  EXPECT_LT((exact.bodies[0].X_WB.R - X.R).norm(), 2e-5);
  EXPECT_LT((exact.bodies[0].X_WB.R.transpose() * exact.bodies[0].X_WB.R - Mat3::Identity()).norm(),
            1e-14);
  EXPECT_GT(exact.bodies[0].X_WB.R.determinant(), 0.0);
  // With points that do not fit the mean of the markers still meets the mean of the points, and no
  // small motion makes the sum of squares smaller.
  const Model wrong = model(text(0.01));
  const Pose& Y = wrong.bodies[0].X_WB;
  std::vector<Vec3> points;
  for (const ModalNode& n : bracket_.part.body.nodes)
    points.push_back(X * n.p + (n.name == "eye" ? 0.01 : 0.0) * X.R.col(2));
  const auto squares = [&](const Pose& pose) {
    double sum = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k)
      sum += (pose * bracket_.part.body.nodes[k].p - points[k]).squaredNorm();
    return sum;
  };
  const double best = squares(Y);
  EXPECT_GT(best, 1e-6);
  for (int k = 0; k < 6; ++k)
    for (const double step : {1e-3, -1e-3}) {
      Pose other = Y;
      if (k < 3)
        other.p[k] += step;
      else
        other.R = rotation_exp(step * Vec3::Unit(k - 3)) * other.R;
      EXPECT_GT(squares(other), best);
    }
}

TEST_F(Parts, MirroredInASubsystem) {
  folder_.write(
      "half.yaml",
      "floatframe: 1\n"
      "parameters: {flex: true}\n"
      "bodies:\n"
      "  arm: {part: bracket.ffb, flexible: \"${flex}\", position: [1, 0.4, 0], orientation: "
      "[0.1, 0.2, 0.3]}\n"
      "joints: {ball: {type: spherical, child: arm, child_node: eye}}\n");
  for (const std::string flex : {"true", "false"}) {
    const Model m = model(
        "subsystems:\n"
        "  left: {file: half.yaml, parameters: {flex: " +
        flex +
        "}}\n"
        "  right: {file: half.yaml, parameters: {flex: " +
        flex + "}, mirror: [{normal: y}]}\n");
    const Body &left = m.bodies[0], &right = m.bodies[1];
    const Vec3 mirror(1, -1, 1);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT((world(right, k) - mirror.cwiseProduct(world(left, k))).norm(), 1e-15);
    const Vec3 left_centre = left.X_WB * left.data->invariants.centre_of_mass();
    const Vec3 right_centre = right.X_WB * right.data->invariants.centre_of_mass();
    EXPECT_LT((right_centre - mirror.cwiseProduct(left_centre)).norm(), 1e-15);
    EXPECT_EQ(right.data->K, left.data->K);
    EXPECT_EQ(right.modes(), flex == "true" ? 5 : 0);
  }
}

TEST_F(Parts, ProjectionNeedsItsData) {
  const std::string text = "bodies: {arm: {part: bracket.ffb}}\n";
  ASSERT_TRUE(model(text).bodies[0].data->projection);
  EXPECT_EQ(model(text).bodies[0].data->projection->nodes(), 5);
  BodyFile without = bracket_;
  without.part.body.projection = nullptr;
  write_body_file(folder_ / "bracket.ffb", without);
  const ModelDescription d = read_model(write(text));
  EXPECT_NO_THROW(check_inertia_method(d, InertiaMethod::preprocessing));
  EXPECT_EQ(
      folder_.without(test::error_of([&] { check_inertia_method(d, InertiaMethod::projection); })),
      "model.yaml:2:22: unsupported");
}

TEST_F(Parts, WarningsOfItsReportAreReported) {
  const std::string file = write("bodies: {arm: {part: bracket.ffb}}\n");
  std::vector<std::string> lines;
  read_model(file, {}, nullptr, {[&](const std::string& line) { lines.push_back(line); }});
  EXPECT_EQ(lines, (std::vector<std::string>{"bodies.arm: the health report of '" +
                                             folder_.file("bracket.ffb") +
                                             "' has 1 warning (floatframe info shows it)"}));
}

TEST_F(Parts, StandardInputDataIsAPartToo) {
  std::filesystem::copy_file(FLOATFRAME_TEST_DATA "/fe/classical.SID_FEM", folder_ / "a.SID_FEM");
  const std::string text =
      "parameters: {flex: true}\nbodies: {arm: {part: a.SID_FEM, flexible: \"${flex}\"}}\n";
  EXPECT_GT(model(text).bodies[0].modes(), 0);
  EXPECT_FALSE(model(text).bodies[0].data->nodes.empty());
  const Model rigid = model(text, {{"flex", "false"}});
  EXPECT_EQ(rigid.bodies[0].modes(), 0);
  EXPECT_EQ(rigid.bodies[0].data->invariants.m, model(text).bodies[0].data->invariants.m);
}

}  // namespace
}  // namespace floatframe
