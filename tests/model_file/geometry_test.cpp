// The key `geometry` of a body: what it looks like, in the body's frame; errors with their place.
#include <gtest/gtest.h>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/core/content_hash.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

const std::string plate = "v 0 0 0\nv 1000 0 0\nv 0 1000 0\nv 0 0 1000\nf 1 3 2\nf 1 2 4\n";

class BodyGeometry : public testing::Test {
 protected:
  BodyGeometry() { folder_.write("parts/plate.obj", plate); }

  std::string model(const std::string& geometry, const std::string& name = "m.yaml") {
    return folder_.write(name,
                         "floatframe: 1\nbodies:\n  a:\n    rigid: {mass: 2, centre_of_mass: [1, "
                         "2, 3], inertia: [1, 1, 1]}\n    geometry: " +
                             geometry + "\n");
  }
  std::shared_ptr<const BodyShape> shape_of(const ModelDescription& d) {
    return std::get<RigidDescription>(d.bodies.at(0).kind).shape;
  }
  std::string errors(const std::string& geometry) {
    return folder_.without(test::error_of([&] { read_model(model(geometry)); }));
  }

  test::TemporaryFolder folder_;
};

TEST_F(BodyGeometry, IsScaledAndPlacedInTheBody) {
  ModelFingerprint used;
  const ModelDescription d =
      read_model(model("{file: parts/plate.obj, scale: 0.001, position: [0, 0, 1], orientation: "
                       "{yaw: 1.5707963267948966}, color: \"#3a6ea5\"}"),
                 {}, &used);
  const auto shape = shape_of(d);
  ASSERT_TRUE(shape);
  EXPECT_EQ(shape->color, "#3a6ea5");
  EXPECT_EQ(shape->triangles.size(), 2u);
  ASSERT_EQ(shape->positions.cols(), 4);
  // The corner at x = 1000 mm of the file.
  double nearest = 1.0;
  for (Eigen::Index k = 0; k < 4; ++k)
    nearest = std::min(nearest, (shape->positions.col(k) - Vec3(0, 1, 1)).norm());
  EXPECT_LT(nearest, 1e-12);
  EXPECT_EQ(used.files.at(folder_.file("parts/plate.obj")), content_hash(plate));
}

TEST_F(BodyGeometry, ChangesNothingThatMoves) {
  const Model with = load_model(model("{file: parts/plate.obj}"));
  const Model without = load_model(
      folder_.write("without.yaml",
                    "floatframe: 1\nbodies:\n  a:\n    rigid: {mass: 2, centre_of_mass: [1, 2, "
                    "3], inertia: [1, 1, 1]}\n"));
  EXPECT_EQ(with.bodies[0].length, without.bodies[0].length);
  EXPECT_EQ(with.bodies[0].X_WB.p, without.bodies[0].X_WB.p);
  EXPECT_EQ(with.bodies[0].data->invariants.P_u, without.bodies[0].data->invariants.P_u);
  EXPECT_FALSE(without.bodies[0].data->shape);
}

TEST_F(BodyGeometry, IsMirroredWithItsBody) {
  model("{file: parts/plate.obj, scale: 0.001}", "part.yaml");
  const ModelDescription d = read_model(
      folder_.write("car.yaml",
                    "floatframe: 1\nsubsystems:\n  left: {file: part.yaml}\n  right: {file: "
                    "part.yaml, mirror: [{normal: y}]}\n"));
  ASSERT_EQ(d.bodies.size(), 2u);
  const auto left = std::get<RigidDescription>(d.bodies[0].kind).shape;
  const auto right = std::get<RigidDescription>(d.bodies[1].kind).shape;
  EXPECT_EQ(right->positions.row(1), -left->positions.row(1));
  EXPECT_EQ(right->positions.row(0), left->positions.row(0));
  const auto normal = [](const BodyShape& s) {
    const auto& t = s.triangles[1];
    const Vec3 a = s.positions.col(t[0]), b = s.positions.col(t[1]), c = s.positions.col(t[2]);
    return Vec3((b - a).cross(c - a).normalized());
  };
  EXPECT_EQ(normal(*left), -Vec3::UnitY());
  EXPECT_EQ(normal(*right), Vec3::UnitY()) << "normals stay outward";
}

TEST_F(BodyGeometry, SolidsAndFilesAreOneShape) {
  const auto shape = shape_of(read_model(model(R"(
      - {box: [0.4, 0.2, 0.1], position: [0, 0, 1], color: "#3a6ea5"}
      - {cylinder: {radius: 0.1, length: 0.6}, axis: y}
      - {sphere: {radius: 0.05}, position: [2, 0, 0]}
      - {file: parts/plate.obj, scale: 0.001, color: "#c7a777"}
      - {cone: {radius: 0.1, length: 0.3, top: 0.02}, orientation: [1.5707963267948966, 0, 0]}
      - {capsule: {radius: 0.1, length: "${2 * 0.1}"}, axis: -x})")));
  ASSERT_TRUE(shape);
  ASSERT_EQ(shape->paints.size(), 4u);
  EXPECT_EQ(shape->color, "#3a6ea5");
  EXPECT_EQ(shape->paints[0].color, "#3a6ea5");
  EXPECT_EQ(shape->paints[1].first, 12) << "triangles of the box";
  EXPECT_EQ(shape->paints[1].color, "");
  EXPECT_EQ(shape->paints[2].color, "#c7a777");
  EXPECT_EQ(shape->paints[3].first, shape->paints[2].first + 2);
  const auto reach = [&](int paint, int axis, bool high) {
    const std::size_t end =
        paint + 1 < 4 ? shape->paints[paint + 1].first : int(shape->triangles.size());
    double most = -1e9;
    for (std::size_t t = shape->paints[paint].first; t < end; ++t)
      for (const int v : shape->triangles[t])
        most = std::max(most, (high ? 1.0 : -1.0) * shape->positions(axis, v));
    return most;
  };
  EXPECT_NEAR(reach(0, 0, true), 0.2, 1e-15);
  EXPECT_NEAR(reach(0, 2, false), -0.95, 1e-15) << "about its position";
  EXPECT_NEAR(reach(1, 1, true), 0.3, 1e-15) << "the cylinder lies along y";
  EXPECT_NEAR(reach(1, 0, true), 2.05, 1e-15) << "the sphere";
  EXPECT_NEAR(reach(2, 0, true), 1.0, 1e-15) << "the file";
  EXPECT_NEAR(reach(3, 0, true), 0.2, 1e-15) << "the capsule lies along x";
  EXPECT_NEAR(reach(3, 1, true), 0.15, 1e-15) << "the cone is turned about x";
}

TEST_F(BodyGeometry, ErrorsOfSolidsHaveAPlace) {
  EXPECT_EQ(errors("{box: [1, 2]}"), "m.yaml:5:21: bodies.a.geometry.box: wrong_value");
  EXPECT_EQ(errors("{box: [1, 2, 0]}"), "m.yaml:5:28: bodies.a.geometry.box[3]: out_of_range");
  EXPECT_EQ(errors("{box: [1, 2, 3], axis: x}"),
            "m.yaml:5:32: bodies.a.geometry.axis: unknown_key");
  EXPECT_EQ(errors("{cylinder: {radius: 1}}"), "m.yaml:5:16: bodies.a.geometry.cylinder: missing");
  EXPECT_EQ(errors("{sphere: {radius: 1, length: 2}}"),
            "m.yaml:5:36: bodies.a.geometry.sphere.length: unknown_key");
  EXPECT_EQ(errors("{sphere: {radius: -1}, scale: 2}"),
            "m.yaml:5:33: bodies.a.geometry.sphere.radius: out_of_range\nm.yaml:5:38: "
            "bodies.a.geometry.scale: unknown_key");
  EXPECT_EQ(errors("{sphere: {radius: 1e7}}"), "m.yaml:5:15: bodies.a.geometry: out_of_range");
  EXPECT_EQ(errors("{sphere: {radius: 1}, box: [1, 1, 1]}"),
            "m.yaml:5:24: bodies.a.geometry.sphere: exclusive");
  EXPECT_EQ(errors("{cone: {radius: 1, length: 1}, axis: x, orientation: [0, 0, 0]}"),
            "m.yaml:5:52: bodies.a.geometry.axis: exclusive");
  EXPECT_EQ(errors("[]"), "m.yaml:5:15: bodies.a.geometry: wrong_count");
  EXPECT_EQ(errors("[{box: [1, 1, 1]}, {color: \"#000000\"}]"),
            "m.yaml:5:34: bodies.a.geometry[2]: missing");
  EXPECT_EQ(errors("[{box: [1, 1, 1]}, 3]"), "m.yaml:5:34: bodies.a.geometry[2]: wrong_value");
}

TEST_F(BodyGeometry, ErrorsHaveAPlace) {
  EXPECT_EQ(errors("plate.obj"), "m.yaml:5:15: bodies.a.geometry: wrong_value");
  EXPECT_EQ(errors("{scale: 2}"), "m.yaml:5:5: bodies.a.geometry: missing");
  EXPECT_EQ(errors("{file: none.stl}"), "m.yaml:5:22: bodies.a.geometry.file: unreadable");
  EXPECT_EQ(errors("{file: parts}"), "m.yaml:5:22: bodies.a.geometry.file: wrong_file");
  EXPECT_EQ(errors("{file: parts/plate.obj, scale: 0, color: red}"),
            "m.yaml:5:46: bodies.a.geometry.scale: out_of_range\nm.yaml:5:56: "
            "bodies.a.geometry.color: wrong_value");
  EXPECT_EQ(errors("{file: parts/plate.obj, scal: 0.001}"),
            "m.yaml:5:39: bodies.a.geometry.scal: unknown_key");
  EXPECT_EQ(errors("{file: parts/plate.obj, scale: 1e6}"),
            "m.yaml:5:22: bodies.a.geometry.file: out_of_range");
  folder_.write("bad.obj", "v 0 0 0\nv 1 nan 0\n");
  EXPECT_EQ(errors("{file: bad.obj}"), "bad.obj:2: not_a_number");
  folder_.write("cut.stl", std::string(90, 'x'));
  EXPECT_EQ(errors("{file: cut.stl}"), "m.yaml:5:22: bodies.a.geometry.file: damaged");
}

}  // namespace
}  // namespace floatframe
