// Roads with width in model files: the height above x and y, errors, notes, the hash.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "floatframe/description/random_tracks.hpp"
#include "floatframe/model/model_hash.hpp"
#include "floatframe/model/model_hints.hpp"
#include "floatframe/model/road.hpp"
#include "floatframe/roads/crg_file.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

const std::string measured = std::string(FLOATFRAME_TEST_DATA) + "/roads/banked_sloped.crg";

std::string with_road(const std::string& keys) {
  return "bodies:\n  box: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, "
         "1]}}\nroads:\n  r: {" +
         keys + "}\n";
}

Road road_of(const std::string& keys) { return model_of(with_road(keys)).roads.at(0); }

TEST(RoadSurfaceKeys, HeightsAreAdded) {
  const Road road = road_of("profile: [[0, 0], [10, 1]], height: '0.2*x*y + 3'");
  const SurfacePoint p = surface_at(road, 2.0, 0.5);
  EXPECT_NEAR(p.z, 0.2 + 0.2 + 3.0, 1e-15);
  EXPECT_NEAR(p.zx, 0.1 + 0.1, 1e-15);
  EXPECT_NEAR(p.zy, 0.4, 1e-15);
  EXPECT_NEAR(p.zxy, 0.2, 1e-15);
  EXPECT_EQ(p.friction, 1.0);
  EXPECT_EQ(road.surface->patches.size(), 0u);
}

TEST(RoadSurfaceKeys, ProfilesAloneAreAsBefore) {
  const Road road = road_of("profile: [[0, 0], [10, 1]], spectrum: {class: C, length: 30}");
  EXPECT_EQ(road.surface, nullptr);
  for (const double x : {-1.0, 2.3, 17.9}) {
    const RoadPoint p = road_at(road, x);
    const SurfacePoint s = surface_at(road, x, 7.0);
    EXPECT_EQ(s.z, p.z);
    EXPECT_EQ(s.zx, p.slope);
    EXPECT_EQ(s.zxx, p.curvature);
    EXPECT_EQ(s.zy, 0.0);
  }
}

TEST(RoadSurfaceKeys, Grid) {
  const std::string numbers = "x: [0, 1, 3], y: [-1, 1], z: [[0, 1], [2, 3], [4, 9]]";
  const Road road = road_of("grid: {" + numbers + ", interpolation: linear}");
  EXPECT_NEAR(surface_at(road, 2.0, 0.0).z, 4.5, 1e-15);
  TemporaryFolder folder;
  const std::string file = (folder.path() / "grid.csv").string();
  for (const char* corner : {"x/y", "0"}) {
    std::ofstream(file) << corner << ",-1,1\n0,0,1\n1,2,3\n3,4,9\n";
    const Road same = road_of("grid: {file: '" + file + "'}");
    const Road smooth = road_of("grid: {" + numbers + "}");
    EXPECT_EQ(surface_at(same, 1.7, 0.3).z, surface_at(smooth, 1.7, 0.3).z);
    EXPECT_EQ(surface_at(same, 1.7, 0.3).zxy, surface_at(smooth, 1.7, 0.3).zxy);
  }
}

TEST(RoadSurfaceKeys, OpenCrg) {
  const CrgRoad crg = read_crg(std::filesystem::path(measured));
  const Road plain = road_of("crg: '" + measured + "'");
  EXPECT_EQ(surface_at(plain, 5.0, 1.7).z, crg_surface(crg, 5.0, 1.7).z);
  const Road other = road_of("crg: {file: '" + measured +
                             "', begin: origin, border_u: zero, interpolation: cubic}");
  EXPECT_EQ(surface_at(other, -5.0, 0.3).z, 0.0);
  EXPECT_EQ(other.surface->crg->interpolation, CrgInterpolation::cubic);
}

TEST(RoadSurfaceKeys, Tracks) {
  const Road road = road_of(
      "tracks: {class: B, length: 60, width: 1.4, centre: 0.2, seed: 4, coherence: exponential, "
      "decay: 2}");
  TrackSpectrum t;
  t.road = {road_classes::roughness(1), 0.0, 60.0, 4};
  t.width = 1.4;
  t.centre = 0.2;
  t.coherence = TrackCoherence::exponential;
  t.decay = 2.0;
  EXPECT_EQ(surface_at(road, 30.0, 0.4).z, tracks_height(random_tracks(t), 30.0, 0.4).z);
}

TEST(RoadSurfaceKeys, Friction) {
  const Road road = road_of(
      "friction: 0.9, patches: [{x: [0, 5], y: [-1, 1], friction: 0.2}, {x: [4, 8], y: [0, 1], "
      "friction: 0.4}]");
  EXPECT_EQ(surface_at(road, 1.0, 0.0).friction, 0.2);
  EXPECT_EQ(surface_at(road, 4.5, 0.5).friction, 0.4);
  EXPECT_EQ(surface_at(road, 9.0, 0.5).friction, 0.9);
}

TEST(RoadSurfaceKeys, Errors) {
  const std::pair<std::string, std::string> wrong[] = {
      {"height: 'x + t'", "roads.r.height: not_found"},
      {"grid: {x: [0, 1], y: [0, 1], z: [[0, 1]]}", "roads.r.grid.z: wrong_count"},
      {"grid: {x: [0, 0], y: [0, 1], z: [[0, 1], [0, 1]]}", "roads.r.grid: wrong_value"},
      {"grid: {x: [0, 1], y: [0, 1]}", "roads.r.grid: missing"},
      {"crg: nowhere.crg", "roads.r.crg: unreadable"},
      {"crg: {file: nowhere.crg, border_u: soft}", "roads.r.crg.border_u: wrong_value"},
      {"tracks: {class: C, length: 50}", "roads.r.tracks: missing"},
      {"tracks: {class: C, length: 50, width: 1, decay: 2}", "roads.r.tracks.decay: incomplete"},
      {"tracks: {class: C, length: 50, width: 1, coherence: exponential}",
       "roads.r.tracks: missing"},
      {"friction: -1", "roads.r.friction: out_of_range"},
      {"patches: [{x: [2, 1], y: [0, 1], friction: 1}]", "roads.r.patches[1].x: wrong_value"}};
  for (const auto& [keys, expected] : wrong) {
    const std::string found = error_of([&] { model_of(with_road(keys)); });
    EXPECT_TRUE(contains(found, expected)) << keys << ": " << found;
  }
  const std::string tyre =
      "forces:\n  w: {type: tyre, body: box, radius: 0.3, stiffness: 1e5, road: r}\n";
  EXPECT_EQ(error_of([&] { model_of(with_road("friction: 0.5") + tyre); }), "no error");
  EXPECT_TRUE(contains(error_of([&] { model_of(with_road("height: 'x*y'") + tyre); }),
                       "forces.w.road: unsupported"));
}

TEST(RoadSurfaceKeys, NotesAndHash) {
  const std::string name = "crg: '" + measured + "'";
  EXPECT_NE(model_hash(model_of(with_road(name))), model_hash(model_of(with_road("friction: 1"))));
  EXPECT_NE(model_hash(model_of(with_road("friction: 1"))),
            model_hash(model_of(with_road("friction: 0.9"))));
  EXPECT_EQ(model_hash(model_of(with_road("height: 'x*y'"))),
            model_hash(model_of(with_road("height: 'x*y'"))));
  TemporaryFolder folder;
  const std::string file = (folder.path() / "scaled.crg").string();
  std::ifstream in(measured);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  text.insert(text.find("$KD_Def"), "$ROAD_CRG_MODS\nSCALE_Z_GRID = 2\n$\n");
  std::ofstream(file) << text;
  const ModelDescription d = description_of(with_road("crg: '" + file + "'"));
  const std::vector<std::string> notes = model_hints(d, build_model(d)).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(contains(notes[0], "SCALE_Z_GRID"));
}

}  // namespace
}  // namespace floatframe::test
