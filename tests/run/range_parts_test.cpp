// Parts from files: their surface is watched too, where the markers stand still.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "floatframe/body/surface_points.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/run/run.hpp"
#include "support/coordinates.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

/// The bracket has markers foot, knee and eye, which mode 5 moves by 0, 0.02 and 0 m; a
/// point of its surface moves by 1.09 m.
class RangeOfParts : public ::testing::Test {
 protected:
  RangeOfParts() {
    std::filesystem::copy_file(FLOATFRAME_TEST_DATA "/body_files/bracket_v1.ffb",
                               folder_ / "bracket.ffb");
  }
  ModelDescription read(const std::string& rest, const std::string& part = "part: bracket.ffb") {
    return read_model(folder_.write(
        "model.yaml", "floatframe: 1\ngravity: [0, 0, 0]\nbodies: {arm: {" + part +
                          "}}\njoints: {foot: {type: weld, child: arm, child_node: foot}}\n" +
                          rest));
  }
  /// What is said about displacements; that the markers turn is said apart.
  std::string far(double amplitude, Coordinates coordinates) {
    ModelDescription d =
        read("initial: {amplitudes: {arm: [0, 0, 0, 0, " + std::to_string(amplitude) +
             "]}}\nsimulation: {step: 1e-7, duration: 1e-6}\n");
    d.simulation.coordinates = coordinates;
    for (const RangeWarning& w : run(build_model(d), d.simulation).summary.warnings)
      if (w.sentence.find("body 'arm' deforms too far") != std::string::npos) return w.sentence;
    return "";
  }

  TemporaryFolder folder_;
};

TEST_F(RangeOfParts, SurfaceBetweenMarkersThatStandStill) {
  for (const Coordinates c : both_coordinates) {
    const std::string sentence = far(0.4, c);
    EXPECT_TRUE(contains(sentence, "s the surface point at ("));
    EXPECT_TRUE(contains(sentence, " m is displaced by 0.436 m ("));
    EXPECT_EQ(far(0.04, c), "");
  }
}

// Both modes move the marker at the end most; together they may leave it where it is.
TEST(SurfacePoints, BetweenMarkersInACombinationOfModes) {
  FlexibleBody body;
  body.K = MatX::Identity(2, 2);
  Mat3X p = Mat3X::Zero(3, 31);
  MatX modes = MatX::Zero(93, 2);
  for (Eigen::Index k = 0; k <= 30; ++k) {
    const double x = static_cast<double>(k) / 30.0;
    p(0, k) = x;
    modes.row(3 * k + 2) << x * x, x * x * x;
  }
  body.nodes.push_back({"end", p.col(30), modes.bottomRows(3), Mat3X::Zero(3, 2)});
  const std::vector<ModalNode> points = surface_points(body, p, modes);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NEAR(points[0].p.x(), 2.0 / 3.0, 1e-12);  // where x^2 - x^3 is largest
  EXPECT_EQ(points[1].p.x(), 1.0);
  EXPECT_EQ(points[0].X, Mat3X(modes.middleRows<3>(60)));
}

TEST_F(RangeOfParts, FewPointsAndNoneWhenRigid) {
  const auto points = [&](const std::string& part) {
    const Model m = build_model(read("", part));
    const std::vector<ModalNode>& nodes = m.bodies[0].data->nodes;
    EXPECT_EQ(nodes[2].name, "eye");
    return std::count_if(nodes.begin(), nodes.end(), is_surface_point);
  };
  const auto some = points("part: bracket.ffb");
  EXPECT_GE(some, 1);
  EXPECT_LE(some, 5);
  EXPECT_EQ(points("part: bracket.ffb, flexible: false"), 0);
}

// A surface point has no rotations: what sits on a part sits on its markers.
TEST_F(RangeOfParts, NothingSitsOnTheSurface) {
  const Model m = build_model(read(""));
  const Vec3 p = m.bodies[0].data->nodes.back().p;
  ASSERT_TRUE(is_surface_point(m.bodies[0].data->nodes.back()));
  ModelDescription d = read("outputs: {x: {position: {body: arm, node: eye}}}\n");
  d.outputs.at(0).at.node.reset();
  d.outputs.at(0).at.point = p;
  const std::string error = error_of([&] { build_model(d); });
  EXPECT_EQ(test::without_folders(error), "model.yaml:5:11: not_found") << error;
  d.outputs.at(0).at.node = surface_point_name;
  EXPECT_NE(error_of([&] { build_model(d); }), "no error");
}

}  // namespace
}  // namespace floatframe::test
