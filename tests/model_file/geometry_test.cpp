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
