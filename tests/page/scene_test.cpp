// The scene of a page: bodies as they look and where they are, joints, forces and roads.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/gauge.hpp"
#include "floatframe/page/check_page.hpp"
#include "floatframe/page/scene_json.hpp"
#include "floatframe/page/scene_mesh.hpp"
#include "floatframe/page/scene_stress.hpp"
#include "history/recorded_run.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

using Json = nlohmann::ordered_json;

/// Numbers of a view, half floats as they are.
template <class Number>
std::vector<Number> numbers_of(const PageBuffer& buffer, const Json& view, const char* type) {
  EXPECT_EQ(view["type"], type);
  std::size_t count = 1;
  for (const Json& n : view["shape"]) count *= n.get<std::size_t>();
  std::vector<Number> out(count);
  const auto offset = view["offset"].get<std::size_t>();
  EXPECT_EQ(offset % 8, 0u);
  EXPECT_LE(offset + count * sizeof(Number), buffer.bytes().size());
  std::memcpy(out.data(), buffer.bytes().data() + offset, count * sizeof(Number));
  return out;
}

/// Indices are as short as they can be.
std::vector<std::uint32_t> indices_of(const PageBuffer& buffer, const Json& view) {
  if (view["type"] == "u32") return numbers_of<std::uint32_t>(buffer, view, "u32");
  const auto shorts = numbers_of<std::uint16_t>(buffer, view, "u16");
  return {shorts.begin(), shorts.end()};
}

double from_half(std::uint16_t h) {
  const int exponent = (h >> 10) & 31, fraction = h & 1023;
  const double size =
      exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  return h & 0x8000 ? -size : size;
}

const std::string tip_output = "outputs: {t: {position: {body: beam, node: tip}}}\n";

struct Drawn {
  Model model;
  ResultTable table;
  PageBuffer buffer;
  SceneFrames frames;
  Json scene;
};

void draw(const std::string& text, Drawn& out,
          const std::function<void(SimulationDescription&)>& change = {}) {
  out.model = model_of(text);
  SimulationDescription o = out.model.simulation;
  if (change) change(o);
  const TemporaryFolder folder;
  const Recorded r = recorded_run(out.model, o, folder.file("x.ffr"));
  out.table = r.result.table;
  out.frames = scene_frames(out.model, StateHistory(r.path));
  out.scene = scene_json(out.model, out.frames, out.buffer);
}

// Halves of the stress per amplitude, and the largest over the frames, of a swept bar.
TEST(Scene, StressOfVerticesIsThatOfTheNodes) {
  Drawn d;
  draw(recorded_machine, d);
  int bodies = 0;
  const SceneFrames& frames = d.frames;
  std::size_t first = 0, columns = 0;
  for (const Body& b : d.model.bodies) columns += static_cast<std::size_t>(b.modes());
  for (std::size_t b = 0; b < d.model.bodies.size(); ++b) {
    const FlexibleBody& data = *d.model.bodies[b].data;
    const auto nm = static_cast<std::size_t>(data.modes());
    const Json& stress = d.scene["bodies"][b]["stress"];
    EXPECT_EQ(stress.is_null(), nm == 0);
    if (nm == 0) continue;
    ++bodies;
    const auto halves = numbers_of<std::uint16_t>(d.buffer, stress["modes"], "f16");
    const auto envelope = numbers_of<float>(d.buffer, stress["envelope"], "f32");
    const auto when = numbers_of<float>(d.buffer, stress["when"], "f32");
    const SceneStress expected = scene_stress(data);
    ASSERT_EQ(expected.places.size(), envelope.size());
    ASSERT_EQ(halves.size(), 6 * nm * envelope.size());
    const double factor = stress["factor"].get<double>();
    for (std::size_t v = 0; v < envelope.size(); v += 7) {
      ASSERT_GE(expected.places[v], 0);
      const Eigen::Index row = 6 * static_cast<Eigen::Index>(expected.places[v]);
      double largest = 0.0, at = 0.0;
      for (std::size_t f = 0; f < frames.time.size(); ++f) {
        Vec6 s = Vec6::Zero();
        for (std::size_t m = 0; m < nm; ++m)
          s += data.stress->modes.block<6, 1>(row, static_cast<Eigen::Index>(m)) *
               frames.amplitudes[f * columns + first + m];
        if (von_mises(s) > largest) at = frames.time[f];
        largest = std::max(largest, von_mises(s));
      }
      EXPECT_NEAR(envelope[v], largest, 1e-6 * largest);
      EXPECT_NEAR(when[v], at, 1e-6 * (1.0 + at));
      for (std::size_t m = 0; m < nm; ++m)
        for (std::size_t c = 0; c < 6; ++c)
          EXPECT_NEAR(
              factor * from_half(halves[6 * (v * nm + m) + c]),
              data.stress->modes(row + static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(m)),
              1e-3 * data.stress->modes.cwiseAbs().maxCoeff());
      // The place is of the section the vertex belongs to: not further than its size away.
      const Vec3 p(
          numbers_of<float>(d.buffer, d.scene["bodies"][b]["shape"]["vertices"], "f32")[3 * v], 0.0,
          0.0);
      EXPECT_NEAR(p(0), data.stress->places[expected.places[v]].p(0), 0.05);
    }
    first += nm;
  }
  EXPECT_GT(bodies, 0);
}

TEST(Scene, GeometryOfAFileIsDrawnInThePlaceOfTheBox) {
  Drawn d;
  d.model = model_of(recorded_machine);
  FlexibleBody body = *d.model.bodies[0].data;
  ASSERT_EQ(body.modes(), 0);
  auto shape = std::make_shared<BodyShape>();
  shape->positions = Mat3X::Random(3, 4);
  shape->triangles = {{0, 1, 2}, {0, 2, 3}};
  shape->color = "#3a6ea5";
  body.shape = shape;
  d.model.bodies[0].data = std::make_shared<const FlexibleBody>(body);
  const TemporaryFolder folder;
  const Recorded r = recorded_run(d.model, d.model.simulation, folder.file("x.ffr"));
  d.scene = scene_json(d.model, scene_frames(d.model, StateHistory(r.path)), d.buffer);
  const Json& drawn = d.scene["bodies"][0]["shape"];
  EXPECT_EQ(drawn["kind"], "mesh");
  EXPECT_EQ(drawn["color"], "#3a6ea5");
  EXPECT_TRUE(drawn["nodes"].is_null());
  EXPECT_TRUE(drawn["displacements"].is_null());
  const auto vertices = numbers_of<float>(d.buffer, drawn["vertices"], "f32");
  for (Eigen::Index k = 0; k < 12; ++k)
    EXPECT_EQ(vertices[static_cast<std::size_t>(k)],
              static_cast<float>(shape->positions(k % 3, k / 3)));
  EXPECT_EQ(indices_of(d.buffer, drawn["triangles"]),
            (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_FALSE(d.scene["bodies"][1]["shape"].contains("color"));
  // The result stands alone: the surface and its colour are in it.
  const StateHistory history(r.path);
  const HistoryBody& kept = history.header().bodies[0];
  ASSERT_GE(kept.shape, 0);
  EXPECT_EQ(history.header().shapes[static_cast<std::size_t>(kept.shape)].color, "#3a6ea5");
  const std::string at = "shapes/" + std::to_string(kept.shape) + "/";
  std::set<std::string> names;
  for (const HistoryArray& a : history.header().arrays) names.insert(a.name);
  EXPECT_TRUE(names.contains(at + "surface_positions"));
  EXPECT_TRUE(names.contains(at + "surface_triangles"));
  EXPECT_FALSE(names.contains(at + "surface_modes"));
}

TEST(Scene, PointsMoveAsTheOutputs) {
  Drawn d;
  draw(std::string(recorded_machine) + tip_output, d);
  const Json& scene = d.scene;
  ASSERT_EQ(scene["bodies"].size(), 5u);
  const auto time = numbers_of<double>(d.buffer, scene["frames"]["time"], "f64");
  const auto pose = numbers_of<float>(d.buffer, scene["frames"]["pose"], "f32");
  const auto amplitudes = numbers_of<float>(d.buffer, scene["frames"]["amplitudes"], "f32");
  ASSERT_EQ(time.size(), d.table.rows());
  const auto point = std::find_if(scene["points"].begin(), scene["points"].end(),
                                  [](const Json& p) { return p["name"] == "tip"; });
  ASSERT_NE(point, scene["points"].end());
  EXPECT_EQ((*point)["body"], 2);
  const Json& modes = scene["bodies"][2]["modes"];
  EXPECT_EQ(modes["first"], 0);
  EXPECT_EQ(modes["count"], 4);
  for (std::size_t f = 0; f < time.size(); f += 25) {
    Vec3 p;
    for (std::size_t c = 0; c < 3; ++c) {
      p[static_cast<Eigen::Index>(c)] = (*point)["p"][c].get<double>();
      for (std::size_t m = 0; m < 4; ++m)
        p[static_cast<Eigen::Index>(c)] +=
            (*point)["modes"][m][c].get<double>() * amplitudes[4 * f + m];
    }
    const float* x = pose.data() + 7 * (5 * f + 2);
    const Eigen::Quaterniond turn(x[6], x[3], x[4], x[5]);
    const Vec3 world = Vec3(x[0], x[1], x[2]) + turn * p;
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(world[static_cast<Eigen::Index>(c)], d.table.at(f, 1 + c), 1e-6) << f;
  }
}

/// Of a closed surface, normals outward.
template <class Vertices, class Triangles>
double volume_within(const Vertices& vertices, const Triangles& triangles) {
  double volume = 0.0;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    Vec3 p[3];
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        p[k][static_cast<Eigen::Index>(c)] = vertices[3 * triangles[t + k] + c];
    volume += p[0].dot(p[1].cross(p[2])) / 6.0;
  }
  return volume;
}

TEST(Scene, SurfacesOfBarsBendWithTheirModes) {
  Drawn d;
  draw(std::string(recorded_machine) + tip_output, d);
  const Json& shape = d.scene["bodies"][2]["shape"];
  EXPECT_EQ(shape["kind"], "mesh");
  EXPECT_TRUE(shape["generated"]);
  const auto vertices = numbers_of<float>(d.buffer, shape["vertices"], "f32");
  const auto nodes = indices_of(d.buffer, shape["nodes"]);
  const auto halves = numbers_of<std::uint16_t>(d.buffer, shape["displacements"], "f16");
  const FlexibleBody& beam = *d.model.bodies[2].data;
  ASSERT_EQ(halves.size(), 4 * vertices.size());
  for (std::size_t v = 0; v < nodes.size(); ++v) {
    const ModalNode& node = beam.nodes[nodes[v]];
    const Vec3 r = Vec3(vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]) - node.p;
    EXPECT_NEAR(std::hypot(r.y(), r.z()), std::hypot(0.01, 0.005), 1e-7);
    for (Eigen::Index m = 0; m < 4; ++m) {
      const Vec3 u = node.X.col(m) + Vec3(node.X_theta.col(m)).cross(r);
      for (Eigen::Index c = 0; c < 3; ++c) {
        const auto at = (v * 4 + static_cast<std::size_t>(m)) * 3 + static_cast<std::size_t>(c);
        EXPECT_NEAR(from_half(halves[at]), u[c], 1e-3 * std::abs(u[c]) + 1e-6);
      }
    }
  }
  EXPECT_NEAR(volume_within(vertices, indices_of(d.buffer, shape["triangles"])), 0.6 * 0.02 * 0.01,
              1e-9);
}

TEST(Scene, RoundBarsAreClosedToo) {
  const Model m = model_of(R"(
points: {p: [0, 0, 0], q: [1, 1, 0]}
bodies:
  b:
    flexible:
      material: {young: 7e10, poisson: 0.3, density: 2700}
      bars: {one: {from: p, to: q, elements: 3, section: {round: 0.1}}}
      clamped: [p]
      normal_modes: 2
)");
  const SceneMesh mesh = scene_mesh(*m.bodies[0].data);
  // A prism on twelve corners.
  EXPECT_NEAR(volume_within(mesh.vertices, mesh.triangles),
              std::sqrt(2.0) * 0.5 * 12 * 0.05 * 0.05 * std::sin(M_PI / 6.0), 1e-7);
}

TEST(Scene, JointsForcesAndRodsNameTheirPoints) {
  Drawn d;
  draw(std::string(recorded_machine) + "outputs: {c: {force: coil}}\n", d);
  const Json& scene = d.scene;
  ASSERT_EQ(scene["joints"].size(), 5u) << "those the user wrote";
  const Json& hinge = scene["joints"][2];
  EXPECT_EQ(hinge["name"], "hinge");
  EXPECT_EQ(hinge["type"], "revolute");
  EXPECT_EQ(hinge["axis"], (Json{0.0, 1.0, 0.0}));
  EXPECT_TRUE(scene["joints"][4]["axis"].is_null());
  EXPECT_EQ(scene["points"][hinge["a"].get<std::size_t>()]["body"], -1);
  EXPECT_EQ(scene["points"][hinge["b"].get<std::size_t>()]["body"], 2);
  const Json& coil = scene["forces"][0];
  EXPECT_EQ(coil["type"], "joint_spring");
  EXPECT_TRUE(coil["wrench"].is_null()) << "its efforts were not asked for";
  const Json& load = scene["forces"][1];
  EXPECT_EQ(load["axis"], (Json{1.0, 0.0, 0.0}));
  EXPECT_EQ(load["follows"], false);
  EXPECT_EQ(scene["points"][load["a"].get<std::size_t>()]["body"], 1);
  EXPECT_EQ(load["b"], -1);
  ASSERT_EQ(scene["rods"].size(), 1u);
  EXPECT_EQ(scene["points"][scene["rods"][0]["b"].get<std::size_t>()]["body"], 1);
  EXPECT_EQ(scene["up"], (Json{0.0, 0.0, 1.0}));
  for (const char* kind : {"joints", "forces", "rods"})
    for (const Json& entity : scene[kind])
      for (const char* end : {"a", "b"}) {
        EXPECT_LT(entity[end].get<int>(), static_cast<int>(scene["points"].size()));
      }
}

TEST(Scene, BodiesThatWereNotRecordedAreMarked) {
  Drawn d;
  draw(std::string(recorded_machine) + tip_output, d,
       [](SimulationDescription& o) { o.record.bodies = {"beam"}; });
  for (const Json& body : d.scene["bodies"])
    EXPECT_EQ(body.contains("recorded"), body["name"] != "beam") << body["name"];
}

TEST(Scene, FarFromTheOriginPositionsAreRelative) {
  Drawn d;
  draw(R"(
bodies: {a: {rigid: {mass: 1, centre_of_mass: [12345.25, 0, 7], inertia: [1, 1, 1]}}}
roads: {r: {profile: [[0, 6], [1, 6]]}}
forces: {t: {type: tyre, body: a, at: [12345.25, 0, 7], radius: 1.2, stiffness: 1000, road: r}}
simulation: {step: 0.001, duration: 0.01}
)",
       d);
  EXPECT_EQ(d.scene["origin"], (Json{12000.0, 0.0, 0.0}));
  const auto pose = numbers_of<float>(d.buffer, d.scene["frames"]["pose"], "f32");
  EXPECT_NEAR(pose[0], 345.25, 1e-4);
  const Json& road = d.scene["roads"][0];
  const auto profile = numbers_of<float>(d.buffer, road["profile"], "f32");
  EXPECT_NEAR(profile[0], 345.25 - 7.2, 1e-3);
  EXPECT_NEAR(profile[1], 6.0, 1e-6);
  EXPECT_EQ(d.scene["forces"][0]["radius"], 1.2);
  EXPECT_TRUE(d.scene["bodies"][0]["shape"].is_null()) << "its tyre is drawn";
}

TEST(Scene, AStateIsOneFrame) {
  const Model m = model_of(recorded_machine);
  SystemState s;
  s.time = 2.0;
  for (const Body& b : m.bodies) {
    SystemState::Body body;
    body.name = b.name;
    body.position = Vec3(1, 2, 3);
    body.amplitudes = VecX::Constant(b.modes(), 0.5);
    s.bodies.push_back(body);
  }
  const SceneFrames f = scene_frames(m, s);
  EXPECT_EQ(f.time, (std::vector<double>{2.0}));
  EXPECT_EQ(f.amplitudes, (std::vector<double>(4, 0.5)));
  EXPECT_EQ(std::vector<double>(f.pose(0, 4), f.pose(0, 4) + 7),
            (std::vector<double>{1, 2, 3, 0, 0, 0, 1}));
}

TEST(Scene, StatesOfAnotherModelAreRefused) {
  const TemporaryFolder folder;
  const Model model = model_of(recorded_machine);
  recorded_run(model, model.simulation, folder.file("x.ffr"));
  const Model other =
      model_of("bodies: {a: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}\n");
  EXPECT_NE(error_of([&] { scene_frames(other, StateHistory(folder.file("x.ffr"))); }), "no error");
}

}  // namespace
}  // namespace floatframe::test
