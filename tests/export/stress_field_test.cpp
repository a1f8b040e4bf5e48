// Stress at the points of a picture: the formula with independent numbers, and a turning rod.
#include "floatframe/export/stress_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "floatframe/history/recorded_motion.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/gauge.hpp"
#include "history/recorded_run.hpp"

namespace floatframe::test {
namespace {

Mat3 tensor_of(const Vec6& s) {
  Mat3 S;
  S << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return S;
}

TEST(StressOfAPoint, TurnsWithTheBody) {
  const Vec6 pull = (Vec6() << 7.0, 0, 0, 0, 0, 0).finished();
  EXPECT_DOUBLE_EQ(von_mises(pull), 7.0);
  const Vec6 shear = (Vec6() << 0, 0, 0, 0, 2.0, 0).finished();
  EXPECT_DOUBLE_EQ(von_mises(shear), 2.0 * std::sqrt(3.0));
  const Vec6 pressure = (Vec6() << 5.0, 5.0, 5.0, 0, 0, 0).finished();
  EXPECT_DOUBLE_EQ(von_mises(pressure), 0.0);
  const Vec6 s = (Vec6() << 1.0, -2.0, 0.5, 3.0, -1.5, 0.7).finished();
  const Mat3 R = rotation_exp(Vec3(0.3, -1.2, 2.0));
  const Vec6 t = turned_stress(R, s);
  EXPECT_LT((tensor_of(t) - R * tensor_of(s) * R.transpose()).norm(), 1e-14);
  EXPECT_NEAR(von_mises(t), von_mises(s), 1e-13);
  const Mat3 deviator = tensor_of(s) - tensor_of(s).trace() / 3.0 * Mat3::Identity();
  EXPECT_NEAR(von_mises(s), std::sqrt(1.5) * deviator.norm(), 1e-13);
}

/// Two sides of a shell at the same point, a place elsewhere, and points without any.
TEST(StressField, ShowsTheWorstPlaceOfAPoint) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  const auto fill = [&](MatX& M) {
    for (double& x : M.reshaped()) x = normal(generator);
  };
  BodyPicture picture;
  picture.points = Mat3X::Zero(3, 4);
  FlexibleBody body;
  auto stress = std::make_shared<BodyStress>();
  for (const int point : {1, 1, 3}) {
    StressPlace place;
    place.point = point;
    place.doubtful = point == 3;
    stress->places.push_back(place);
  }
  stress->modes.resize(18, 2);
  stress->loads.resize(18, 14);
  fill(stress->modes);
  fill(stress->loads);
  body.stress = stress;
  StressField field(picture, body);
  ASSERT_TRUE(field.known());
  bool top = false, bottom = false;
  for (int k = 0; k < 40; ++k) {
    const VecX y = VecX::Random(2), c = VecX::Random(14);
    const VecX all = field.at(y, c);
    EXPECT_LT((all - stress->modes * y - stress->loads * c).norm(), 1e-12);
    StressField::Shown shown;
    EXPECT_FALSE(field.shown(0, shown));
    EXPECT_FALSE(field.shown(2, shown));
    ASSERT_TRUE(field.shown(1, shown));
    EXPECT_FALSE(shown.place->doubtful);
    const double a = von_mises(all.segment<6>(0)), b = von_mises(all.segment<6>(6));
    EXPECT_EQ(shown.von_mises, std::max(a, b));
    EXPECT_EQ(shown.stress, Vec6(all.segment<6>(a > b ? 0 : 6)));
    (a > b ? top : bottom) = true;
    ASSERT_TRUE(field.shown(3, shown));
    EXPECT_TRUE(shown.place->doubtful);
    EXPECT_EQ(shown.stress, Vec6(all.segment<6>(12)));
  }
  EXPECT_TRUE(top && bottom);
  EXPECT_FALSE(StressField(picture, FlexibleBody{}).known());
  // Section forces alone are no stress.
  body.stress = std::make_shared<BodyStress>();
  EXPECT_FALSE(StressField(picture, body).known());
}

/// A rod that turns at w about its end, without modes along it: rho w^2 (L^2 - x^2) / 2 at every
/// corner of the swept sections.
TEST(StressField, OfATurningRodIsItsClosedForm) {
  for (const Coordinates coordinates : {Coordinates::relative, Coordinates::absolute}) {
    const TemporaryFolder folder;
    const Model model = model_of(R"(
gravity: [0, 0, 0]
points: {p: [1, 2, 3], tip: [1.6, 2, 3]}
bodies:
  rod:
    flexible:
      material: {young: 7e10, poisson: 0.3, density: 2700}
      bars: {one: {from: p, to: tip, elements: 6, section: {rectangle: [0.02, 0.01]}}}
      clamped: [p]
      static_modes: [{point: tip, dofs: [y, z]}]
joints:
  drive: {type: revolute, child: rod, at: p, axis: z, motion: {polynomial: [0.3, 20]}}
simulation: {step: 1.0e-3, duration: 0.05}
)");
    SimulationDescription o = model.simulation;
    o.coordinates = coordinates;
    recorded_run(model, o, folder.file("states.ffr"));
    const StateHistory history(folder.file("states.ffr"));
    RecordedMotion motion(history, model, o);
    const BodyPicture picture = body_picture(model, 0);
    StressField field(picture, *model.bodies[0].data);
    ASSERT_TRUE(field.known());
    for (const std::size_t k : {std::size_t{0}, motion.instants() - 1}) {
      const SystemMotion& view = motion.at(k);
      field.at(body_motion(view, 0).y, stress_loads(view, 0));
      std::map<int, std::vector<double>> of_node;
      for (Eigen::Index v = 0; v < picture.surface_points(); ++v) {
        StressField::Shown shown;
        ASSERT_TRUE(field.shown(v, shown));
        of_node[picture.nodes[static_cast<std::size_t>(v)]].push_back(shown.stress[0]);
      }
      ASSERT_EQ(of_node.size(), 7u);
      const std::vector<ModalNode>& nodes = model.bodies[0].data->nodes;
      for (const auto& [node, found] : of_node) {
        const double x = (nodes[static_cast<std::size_t>(node)].p - nodes[0].p).norm();
        const double expected = 0.5 * 2700 * 400 * (0.36 - x * x);
        double mean = 0.0;  // steps in absolute coordinates bend the rod by some um
        for (const double s : found) mean += s / static_cast<double>(found.size());
        EXPECT_NEAR(mean, expected, 1e-6 * 194400);
        if (coordinates == Coordinates::absolute) continue;
        for (const double s : found) EXPECT_NEAR(s, expected, 1e-6 * 194400);
      }
    }
  }
}

}  // namespace
}  // namespace floatframe::test
