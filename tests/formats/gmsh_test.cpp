// Gmsh meshes: the same mesh from every version, ASCII and binary of both byte orders; order of
// nodes; physical groups; invalid files with code and place of their errors.
#include <gtest/gtest.h>

#include <cstring>

#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/gmsh/read_gmsh.hpp"
#include "floatframe/formats/text/text_source.hpp"
#include "formats/mesh_checks.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

std::string data(const std::string& name) {
  return std::string(FLOATFRAME_TEST_DATA) + "/fe/" + name;
}

TEST(Gmsh, ArmFromEveryVersion) {
  const FeModel ascii = read_fe_file(data("aarm_coarse.msh.gz"));
  EXPECT_EQ(ascii.nodes(), 5687);
  EXPECT_EQ(ascii.elements.size(), 2785u);
  for (const FeElement& e : ascii.elements) ASSERT_EQ(e.type, FeElementType::tet10);
  EXPECT_EQ(ascii.node_ids[1000], 1001);
  EXPECT_LT((ascii.positions[5] - Vec3(130.8405194677116, 20.07485989988453, 9)).norm(), 1e-14);
  // Sizes of the sets as in the deck that was written from the same mesh.
  const std::map<std::string, std::size_t> sizes = {
      {"BUSH_F", 130}, {"BUSH_R", 130}, {"BALL", 130}, {"DAMP_F", 78}, {"DAMP_R", 82}};
  EXPECT_EQ(ascii.node_sets.size(), sizes.size());
  for (const auto& [name, size] : sizes) EXPECT_EQ(ascii.node_sets.at(name).size(), size) << name;
  EXPECT_EQ(ascii.element_sets.at("BODY").size(), 2785u);
  expect_midside_nodes_near_edges(ascii);
  EXPECT_NEAR(corner_volume(ascii), 701290.98, 0.01 * 701290.98);  // CAD; straight edges here

  // The deck that was made of this mesh, and the one that Gmsh writes itself.
  for (const char* name : {"aarm_coarse_mesh.inp.gz", "aarm_coarse_raw.inp.gz"}) {
    SCOPED_TRACE(name);
    expect_same_mesh(ascii, read_fe_file(data(name)), 1e-9);
  }
  for (const char* name : {"aarm_coarse_bin.msh.gz", "aarm_coarse_v22.msh.gz"}) {
    SCOPED_TRACE(name);
    const FeModel other = read_fe_file(data(name));
    expect_same_mesh(ascii, other, 1e-12);
    EXPECT_EQ(ascii.element_sets, other.element_sets);
    ASSERT_EQ(other.node_sets.size(), sizes.size());
    for (const auto& [set, nodes] : ascii.node_sets) {
      EXPECT_EQ(as_set(nodes), as_set(other.node_sets.at(set))) << set;
    }
  }
}

TEST(Gmsh, BricksAndWedgesOfSecondOrder) {
  const FeModel ascii = read_gmsh(data("bricks.msh"), {});
  EXPECT_EQ(ascii.nodes(), 97);
  EXPECT_EQ(ascii.elements.size(), 12u);
  EXPECT_EQ(ascii.element_sets.at("BRICKS").size(), 4u);
  EXPECT_EQ(ascii.element_sets.at("WEDGES").size(), 8u);
  EXPECT_EQ(ascii.elements[0].type, FeElementType::hex20);
  EXPECT_EQ(ascii.elements[11].type, FeElementType::wedge15);
  expect_midside_nodes_near_edges(ascii);
  EXPECT_NEAR(corner_volume(ascii), 1.0, 1e-12);
  const std::vector<int>& end = ascii.node_sets.at("END");
  EXPECT_EQ(end.size(), 13u);
  for (const int node : end) EXPECT_EQ(ascii.positions[node].x(), 0.0);
  EXPECT_EQ(ascii.node_sets.at("EDGE").size(), 5u);
  EXPECT_EQ(ascii.node_sets.at("CORNER"), std::vector<int>{0});
  EXPECT_EQ(ascii.elements[0].source.line, 328);

  for (const char* name :
       {"bricks_bin.msh.gz", "bricks_big.msh.gz", "bricks_v22.msh.gz", "bricks_v22_bin.msh.gz"}) {
    SCOPED_TRACE(name);
    const FeModel other = read_gmsh(data(name), {});
    expect_same_mesh(ascii, other, 1e-14);
    EXPECT_EQ(ascii.element_sets, other.element_sets);
    for (const auto& [set, nodes] : ascii.node_sets) {
      EXPECT_EQ(as_set(nodes), as_set(other.node_sets.at(set))) << set;
    }
  }
}

TEST(Gmsh, MaterialIsGiven) {
  const FeModel without = read_gmsh(data("bricks.msh"), {});
  EXPECT_TRUE(without.materials.empty());
  EXPECT_EQ(without.elements[3].material, -1);
  ASSERT_EQ(without.notes.size(), 1u);
  EXPECT_EQ(without.notes[0], data("bricks.msh") +
                                  ": the format has no material; give Young's modulus, Poisson's "
                                  "ratio and density with the file");
  FeReadOptions options;
  options.material = Material{210000.0, 0.3, 7.85e-9};
  const FeModel with = read_gmsh(data("bricks.msh"), options);
  ASSERT_EQ(with.materials.size(), 1u);
  EXPECT_EQ(with.materials[0].density, 7.85e-9);
  EXPECT_EQ(with.elements[3].material, 0);
  EXPECT_TRUE(with.notes.empty());
}

/// Format 2 writes an element once for each of its groups.
TEST(Gmsh, ElementOfTwoGroupsIsTakenOnce) {
  const FeModel m = parse_gmsh(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"ALL\"\n3 2 \"LEFT\"\n"
      "$EndPhysicalNames\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n$EndNodes\n"
      "$Elements\n3\n1 4 2 1 1 1 2 3 4\n2 4 2 2 1 1 2 3 4\n3 4 2 1 1 2 3 4 5\n$EndElements\n",
      "two.msh", {});
  EXPECT_EQ(m.elements.size(), 2u);
  EXPECT_EQ(m.element_sets.at("ALL"), (std::vector<int>{0, 1}));
  EXPECT_EQ(m.element_sets.at("LEFT"), std::vector<int>{0});
  EXPECT_EQ(
      m.notes.front().substr(0, 86),
      "two.msh: the format has no material; give Young's modulus, Poisson's ratio and density");
  EXPECT_EQ(m.notes.back(),
            "two.msh: 1 elements are in the file again for a second physical group and are taken "
            "once");
}

const char* const tiny =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"BODY\"\n$EndPhysicalNames\n"
    "$Entities\n0 0 0 1\n1 0 0 0 1 1 1 1 1 0\n$EndEntities\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";

std::string mesh_error(std::string_view text) {
  return error_of([&] { parse_gmsh(text, "arm.msh", {}); });
}

struct FileError {
  const char* from;
  const char* to;
  const char* expected;
};

TEST(Gmsh, ErrorsOfText) {
  ASSERT_EQ(mesh_error(tiny), "no error");
  const FileError errors[] = {
      {"4.1 0 8", "4.0 0 8", "arm.msh:2: unsupported"},
      {"$MeshFormat\n4", "MeshFormat\n4", "arm.msh:1: wrong_file"},
      {"3 1 \"BODY\"", "3 1 BODY", "arm.msh:6: wrong_value"},
      {"1 4 1 4\n", "1 400000000000 1 4\n", "arm.msh:13: damaged"},
      {"1 4 1 4\n", "1 5 1 4\n", "arm.msh:13: contradiction"},
      {"1 4 1 4\n3 1 0 4\n1", "1 3 1 4\n3 1 0 3\n1", "arm.msh:21: damaged"},
      {"1\n2\n3\n4\n0", "1\n2\n2\n4\n0", "arm.msh:17: duplicate\narm.msh:27: not_found"},
      {"0 1 0\n", "0 1 x\n", "arm.msh:21: not_a_number"},
      {"1 0 0\n", "1 0 1e999\n", "arm.msh:20: not_a_number"},
      {"1 1 2 3 4\n", "1 1 2 3 7\n", "arm.msh:27: not_found"},
      {"1 1 2 3 4\n", "1 1 2 3 3\n", "arm.msh:27: duplicate"},
      {"1 1 2 3 4\n$EndElements\n", "1 1 2 3", "arm.msh:27: damaged"},
      {"3 1 4 1\n", "3 1 77 1\n", "arm.msh:26: unknown_key"},
      {"3 1 4 1\n", "3 1 2 1\n", "arm.msh:26: wrong_value"},
      {"1 1 1 1\n3 1 4 1\n1 1 2 3 4\n", "0 0 0 0\n", "arm.msh: missing"},
      {"1 1 1 1\n3 1 4 1\n1 1 2 3 4\n", "1 1 1 1\n2 1 2 1\n1 1 2 3\n", "arm.msh: missing"},
      {"1 1 1 1\n3 1 4 1\n1 1 2 3 4\n", "1 2 1 2\n3 1 4 2\n1 1 2 3 4\n1 1 2 3 4\n",
       "arm.msh:28: duplicate"},
      {"1 1 1 1\n3 1 4 1\n1 1 2 3 4\n", "1 1 1 1\n3 1 14 1\n9 1 2 3 4 1 2 3 4 1 2 3 4 1 2\n",
       "arm.msh:27: unsupported"},
      {"1 1 1 1\n3 1 4 1\n1 1 2 3 4\n",
       "1 1 1 1\n3 1 12 1\n9 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3\n",
       "arm.msh:27: unsupported"},
      {"$Elements\n", "$Comments\n", "arm.msh:24: damaged"},
      {"$Nodes\n1 4 1 4", "$PartitionedEntities\n1 4 1 4", "arm.msh:12: unsupported"},
  };
  for (const FileError& error : errors) {
    std::string text = tiny;
    const std::size_t at = text.find(error.from);
    ASSERT_NE(at, std::string::npos) << error.from;
    text.replace(at, std::strlen(error.from), error.to);
    EXPECT_EQ(mesh_error(text), error.expected);
  }
}

TEST(Gmsh, ErrorsOfBinary) {
  const std::string good = read_whole_file(data("bricks_bin.msh.gz"));
  ASSERT_EQ(mesh_error(good), "no error");
  const std::size_t nodes = good.find("$Nodes\n") + 7, elements = good.find("$Elements\n") + 10;
  // Truncated in the last node of the last element.
  const std::size_t end = good.find("$EndElements") - 1;
  EXPECT_EQ(mesh_error(std::string_view(good).substr(0, end - 5)), "arm.msh: damaged");
  // A count that nothing backs.
  std::string text = good;
  text[nodes + 13] = 1;
  EXPECT_EQ(mesh_error(text), "arm.msh: damaged");
  // Rubbish in a node number, a coordinate that is no number, a wrong order of bytes.
  text = good;
  text[nodes + 58] = 1;
  EXPECT_EQ(mesh_error(text), "arm.msh: out_of_range");
  text = good;
  const std::size_t one = text.find("8\n") + 2;
  text[one] = 7;
  EXPECT_EQ(mesh_error(text), "arm.msh: wrong_value");
  text = good;
  text.erase(elements);
  EXPECT_EQ(mesh_error(text), "arm.msh: damaged");
}

}  // namespace
}  // namespace floatframe::test
