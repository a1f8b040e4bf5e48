// Geometry files: the same tetrahedron in every format, and the error of each that is not valid.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "floatframe/core/base64.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/formats/geometry/geometry_file.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

using Corners = std::array<std::array<float, 3>, 4>;
constexpr Corners corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr std::array<std::array<int, 3>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

template <class T>
void put(std::string& out, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

std::string text_stl() {
  std::string out = "solid t\n";
  for (const auto& f : faces) {
    out += " facet normal 0 0 0\n  outer loop\n";
    for (const int v : f) {
      out += "   vertex";
      for (const float x : corners[static_cast<std::size_t>(v)])
        out += " " + std::to_string(x) + "e0";
      out += "\r\n";
    }
    out += "  endloop\n endfacet\n";
  }
  return out + "endsolid t\n";
}

std::string binary_stl(const std::string& head = "solid but binary") {
  std::string out = head;
  out.resize(80, ' ');
  put(out, static_cast<std::uint32_t>(faces.size()));
  for (const auto& f : faces) {
    for (int k = 0; k < 3; ++k) put(out, 0.0f);
    for (const int v : f)
      for (const float x : corners[static_cast<std::size_t>(v)]) put(out, x);
    put(out, std::uint16_t{0});
  }
  return out;
}

const std::string obj =
    "# a tetrahedron\nmtllib none.mtl\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nv 0 0 1\nvn 0 0 1\n"
    "f 1/1/1 3//1 2\nf -4 -3 \\\n -1\nf 1 4 3 # back\nl 1 2\nf 2 3 4\n";

/// Positions, then indices of 16 bits.
std::string gltf_numbers() {
  std::string out;
  for (const auto& p : corners)
    for (const float x : p) put(out, x);
  for (const auto& f : faces)
    for (const int v : f) put(out, static_cast<std::uint16_t>(v));
  return out;
}

std::string gltf_json(const std::string& uri, const std::string& node = "") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" +
         node +
         R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)"
         R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],"bufferViews":[)"
         R"({"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],)"
         R"("buffers":[{"byteLength":72)" +
         (uri.empty() ? "" : ",\"uri\":\"" + uri + "\"") + "}]}";
}

std::string gltf(const std::string& node = "") {
  return gltf_json("data:application/octet-stream;base64," + base64(gltf_numbers()), node);
}

std::string glb() {
  std::string json = gltf_json("");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string numbers = gltf_numbers();
  std::string out = "glTF";
  put(out, std::uint32_t{2});
  put(out, static_cast<std::uint32_t>(28 + json.size() + numbers.size()));
  put(out, static_cast<std::uint32_t>(json.size()));
  put(out, std::uint32_t{0x4e4f534a});
  out += json;
  put(out, static_cast<std::uint32_t>(numbers.size()));
  put(out, std::uint32_t{0x004e4942});
  return out + numbers;
}

/// Of a closed surface with outward normals.
double volume(const TriangleGeometry& g) {
  double sum = 0.0;
  for (const auto& t : g.triangles)
    sum +=
        g.positions.col(t[0]).dot(Vec3(g.positions.col(t[1])).cross(Vec3(g.positions.col(t[2])))) /
        6.0;
  return sum;
}

std::string geometry_error(const std::string& bytes, const std::string& name,
                           const GeometryLoader& loader = {}) {
  const std::string text = test::error_of([&] { parse_geometry(bytes, name, loader); });
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  return text;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(Geometry, EveryFormatGivesTheSameTetrahedron) {
  for (const auto& [bytes, name] : {std::pair{text_stl(), "t.stl"},
                                    {binary_stl(), "t.STL"},
                                    {obj, "t.obj"},
                                    {gltf(), "t.gltf"},
                                    {glb(), "t.glb"}}) {
    const TriangleGeometry g = parse_geometry(bytes, name);
    EXPECT_EQ(g.positions.cols(), 4) << name;
    EXPECT_EQ(g.triangles.size(), 4u) << name;
    EXPECT_NEAR(volume(g), 1.0 / 6.0, 1e-12) << name;
  }
}

TEST(Geometry, FacesOfManyCornersAreFans) {
  const TriangleGeometry g =
      parse_geometry("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n", "plate.obj");
  ASSERT_EQ(g.triangles.size(), 2u);
  EXPECT_EQ(g.triangles[1], (std::array<int, 3>{0, 2, 3}));
}

TEST(Geometry, NodesOfGltfMoveTheirMeshes) {
  const TriangleGeometry g =
      parse_geometry(gltf(R"(,"rotation":[0,0,0.70710678,0.70710678],"scale":[2,-1,1],)"
                          R"("translation":[0,0,5])"),
                     "t.gltf");
  EXPECT_NEAR(volume(g), 2.0 / 6.0, 1e-6) << "a mirror turns the triangles";
  EXPECT_NEAR(g.positions.row(0).maxCoeff(), 1.0, 1e-6);
  EXPECT_NEAR(g.positions.row(1).maxCoeff(), 2.0, 1e-6);
  EXPECT_NEAR(g.positions.row(2).minCoeff(), 5.0, 1e-6);
}

TEST(Geometry, BuffersInOtherFilesAreReadAndNamed) {
  const TemporaryFolder folder;
  folder.write("a shape.bin", gltf_numbers());
  folder.write("t.gltf", gltf_json("a%20shape.bin"));
  const TriangleGeometry g = read_geometry(folder.file("t.gltf"));
  EXPECT_EQ(g.triangles.size(), 4u);
  ASSERT_EQ(g.others.size(), 1u);
  EXPECT_EQ(g.others[0].filename(), "a shape.bin");
}

TEST(Geometry, Errors) {
  const auto says = [](const std::string& bytes, const std::string& name,
                       const std::string& expected) {
    EXPECT_EQ(geometry_error(bytes, name), expected);
  };
  says("", "t.stl", "t.stl: missing");
  says("x", "t.step", "t.step: wrong_file");
  says("solid a\nendsolid a\n", "t.stl", "t.stl: missing");
  says(replaced(text_stl(), "endsolid t\n", ""), "t.stl", "t.stl:29: damaged");
  says(replaced(text_stl(), "1.000000e0", "nan"), "t.stl", "t.stl:5: not_a_number");
  says("solid t\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n", "t.stl",
       "t.stl:5: wrong_count");
  says("solid t\nversion 2\n", "t.stl", "t.stl:2: wrong_value");
  const std::string binary = binary_stl("made");
  says(binary.substr(0, 200), "t.stl", "t.stl: damaged");
  std::string damaged = binary;
  damaged.replace(84 + 12, 4, "\xff\xff\xff\x7f");
  says(damaged, "t.stl", "t.stl: not_finite");
  says("v 0 0\n", "t.obj", "t.obj:1: not_a_number");
  says("v 0 0 0\nf 1 2 3\n", "t.obj", "t.obj:2: not_found");
  says("v 0 0 0\nf 1 1\n", "t.obj", "t.obj:2: wrong_count");
  says("v 0 0 0\nf 1 x 1\n", "t.obj", "t.obj:2: not_a_number");
  says(glb().substr(0, 300), "t.glb", "t.glb: damaged");
  says("{}", "t.gltf", "t.gltf: wrong_file");
  says(replaced(gltf(), "\"count\":12", "\"count\":15"), "t.gltf", "t.gltf: damaged");
  says(replaced(gltf(), "\"mesh\":0", "\"mesh\":0,\"children\":[0]"), "t.gltf",
       "t.gltf: duplicate");
  says(replaced(gltf(), "\"scene\":0", "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]"),
       "t.gltf", "t.gltf: unsupported");
  const std::string other = geometry_error(gltf_json("other.bin"), "t.gltf");
  EXPECT_EQ(other, "t.gltf: unsupported");
  for (const char* uri :
       {"/etc/passwd", "../other.bin", "%2e%2e/other.bin", "a/../../b.bin", "file:///etc/passwd"}) {
    const std::string outside =
        geometry_error(gltf_json(uri), "t.gltf", [](const std::string& name) {
          ADD_FAILURE() << "asked for " << name;
          return std::string();
        });
    EXPECT_EQ(outside, "t.gltf: unsupported") << uri;
  }
  EXPECT_EQ(geometry_error(gltf().substr(0, 100), "t.gltf"), "t.gltf: wrong_file");
}

TEST(Geometry, TooManyTrianglesAreRefused) {
  std::string bytes = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (std::size_t k = 0; k <= limits::geometry_triangles; ++k) bytes += "f 1 2 3\n";
  EXPECT_EQ(geometry_error(bytes, "t.obj"), "t.obj: too_large");
}

/// Changed and cut files give triangles of points that are there, or an error.
TEST(Geometry, DamagedFilesAreReadOrRefused) {
  std::mt19937 random(7);
  int read = 0, refused = 0;
  for (const auto& [bytes, name] : {std::pair{text_stl(), "t.stl"},
                                    {binary_stl("b"), "b.stl"},
                                    {obj, "t.obj"},
                                    {gltf(), "t.gltf"},
                                    {glb(), "t.glb"}}) {
    for (int k = 0; k < 3000; ++k) {
      std::string changed = bytes;
      for (unsigned n = 1 + random() % 3; n > 0; --n) {
        const std::size_t at = random() % changed.size();
        switch (random() % 4) {
          case 0:
            changed[at] = static_cast<char>(random());
            break;
          case 1:
            changed.erase(at, 1 + random() % 4);
            break;
          case 2:
            changed.insert(at, 1, "0123456789-{}[],\"\n"[random() % 18]);
            break;
          default:
            changed[at] = static_cast<char>('0' + random() % 10);
        }
        if (changed.empty()) changed = "x";
      }
      try {
        const TriangleGeometry g = parse_geometry(changed, name);
        ++read;
        EXPECT_TRUE(g.positions.allFinite());
        for (const auto& t : g.triangles)
          for (const int v : t) EXPECT_TRUE(v >= 0 && v < g.positions.cols());
      } catch (const InputError& error) {
        ++refused;
        EXPECT_EQ(error.errors().size(), 1u);
      }
    }
  }
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace floatframe::test
