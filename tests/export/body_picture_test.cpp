// What is drawn: closed surfaces with outward faces, and a wheel, a box or named points beside it.
#include "floatframe/export/body_picture.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/export/export_selection.hpp"
#include "history/recorded_run.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

using Origin = BodyPicture::Origin;

double enclosed_volume(const BodyPicture& picture) {
  double volume = 0.0;
  for (const auto& t : picture.triangles) {
    const Vec3 a = picture.points.col(t[0]), b = picture.points.col(t[1]),
               c = picture.points.col(t[2]);
    volume += a.dot(b.cross(c)) / 6.0;
  }
  return volume;
}

TEST(BodyPicture, OfABodyWithoutShapeIsABoxOfItsInertia) {
  const Model m = model_of(
      "bodies: {a: {rigid: {mass: 12, centre_of_mass: [1, 2, 3], inertia: [13, 10, 5]}}}\n");
  const BodyPicture picture = body_picture(m, 0);
  ASSERT_EQ(picture.points.cols(), 8);
  EXPECT_EQ(picture.origins[0], Origin::box);
  EXPECT_TRUE(picture.names.empty());
  // m (b^2 + c^2) / 12 and so on: edges 1, 2, 3.
  EXPECT_NEAR(enclosed_volume(picture), 6.0, 1e-12);
}

TEST(BodyPicture, BarsAreSweptAndNamedNodesFollow) {
  const Model m = model_of(recorded_machine);
  const BodyPicture picture = body_picture(m, 2);
  EXPECT_EQ(picture.names, (std::vector<std::string>{"p", "tip"}));
  EXPECT_EQ(picture.points.cols(), picture.surface_points() + 2);
  EXPECT_EQ(picture.origins[0], Origin::bars);
  EXPECT_EQ(picture.origins.back(), Origin::node);
  EXPECT_NEAR(enclosed_volume(picture), 0.6 * 0.02 * 0.01, 1e-15);
  EXPECT_EQ(picture.modes.rows(), 3 * picture.points.cols());
  EXPECT_TRUE(same_picture(picture, body_picture(m, 2)));
  EXPECT_FALSE(same_picture(picture, body_picture(m, 1)));
}

TEST(BodyPicture, AWheelIsItsTyre) {
  const Model m = model_of(R"(
roads: {flat: {bumps: []}}
bodies: {wheel: {rigid: {mass: 1, centre_of_mass: [0, 0, 0.5], inertia: [1, 1, 1]}}}
joints: {free: {type: free, child: wheel, at: [0, 0, 0.5]}}
forces:
  tyre: {type: tyre, body: wheel, at: [0, 0, 0.5], axis: y, radius: 0.5,
         road: flat, stiffness: 1e5, damping: 1e3}
)");
  const BodyPicture picture = body_picture(m, 0);
  EXPECT_EQ(picture.origins[0], Origin::wheel);
  const double n = 48.0;
  EXPECT_NEAR(enclosed_volume(picture), 0.5 * n * std::sin(2.0 * M_PI / n) * 0.25 * 0.2, 1e-12);
  for (Eigen::Index k = 0; k < picture.points.cols(); ++k)
    EXPECT_NEAR(std::abs(picture.points(1, k)), 0.1, 1e-15);
}

TEST(ExportSelection, TakesInstantsInARangeAndEveryNth) {
  const TemporaryFolder folder;
  const Model model = model_of(recorded_machine);
  recorded_run(model, model.simulation, folder.file("states.ffr"));
  const StateHistory history(folder.file("states.ffr"));  // 0 to 0.3 s every 2 ms
  EXPECT_EQ(selected_instants(history, {}).size(), 151u);
  EXPECT_EQ(selected_instants(history, {.from = 0.1, .to = 0.11, .bodies = {}}),
            (std::vector<std::size_t>{50, 51, 52, 53, 54, 55}));
  EXPECT_EQ(selected_instants(history, {.from = 0.1, .to = 0.11, .every = 3, .bodies = {}}),
            (std::vector<std::size_t>{50, 53}));
  EXPECT_EQ(selected_instants(history, {.from = 0.2999, .bodies = {}}),
            (std::vector<std::size_t>{150}));
  const auto error = [&](const ExportSelection& s) {
    return error_of([&] { selected_instants(history, s); });
  };
  EXPECT_EQ(error({.from = 2.0, .bodies = {}}), history.name() + ": missing");
  EXPECT_EQ(error({.to = -1.0, .bodies = {}}), history.name() + ": missing");
  EXPECT_EQ(error({.from = 0.0001, .to = 0.0002, .bodies = {}}), history.name() + ": missing");
}

TEST(ExportSelection, TakesBodiesThatWereRecorded) {
  const TemporaryFolder folder;
  const Model model = model_of(recorded_machine);
  SimulationDescription o = model.simulation;
  o.record.bodies = {"beam", "crank"};
  recorded_run(model, o, folder.file("states.ffr"));
  const StateHistory history(folder.file("states.ffr"));
  EXPECT_EQ(selected_bodies(history, model, {.bodies = {}}), (std::vector<int>{0, 2}));
  EXPECT_EQ(selected_bodies(history, model, {.bodies = {"beam", "beam"}}), (std::vector<int>{2}));
  EXPECT_EQ(error_of([&] { selected_bodies(history, model, {.bodies = {"baem"}}); }), "not_found");
  EXPECT_EQ(error_of([&] { selected_bodies(history, model, {.bodies = {"stone"}}); }),
            history.name() + ": missing");
}

}  // namespace
}  // namespace floatframe::test
