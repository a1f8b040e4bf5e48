// Invalid Gmsh meshes and matrix files, each with the code and place of its error.
#include <gtest/gtest.h>

#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/gmsh/read_gmsh.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

struct InvalidMesh {
  std::string text, expected;
};

TEST(BadMeshes, GmshFramesAndCounts) {
  const std::string form = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
  const std::string elements = "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n";
  const std::string form4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  const std::string nodes4 =
      "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n";
  ASSERT_EQ(error_of([&] { parse_gmsh(form + nodes + elements, "a.msh", {}); }), "no error");
  const InvalidMesh meshes[] = {
      {"$MeshFormat\n4.1 0\n", "a.msh:2: wrong_value"},
      {"$MeshFormat\n4.1 2 8\n", "a.msh:2: out_of_range"},
      {"$MeshFormat\n4.1 1 4\n", "a.msh:2: unsupported"},
      {form + "Nodes\n", "a.msh:4: wrong_value"},
      {form + elements, "a.msh:8: missing"},
      {form + nodes, "a.msh:11: missing"},
      {form + nodes + nodes, "a.msh:11: duplicate"},
      {form + "$PhysicalNames\n1.5\n", "a.msh:5: wrong_value"},
      {form + "$PhysicalNames\n2\n3 1 \"A\"\n3 1 \"B\"\n$EndPhysicalNames\n" + nodes + elements,
       "a.msh:7: duplicate"},
      {form + "$Nodes\n1\n0 0 0 0\n$EndNodes\n", "a.msh:6: out_of_range"},
      {form + "$Nodes\n1\nx 0 0 0\n$EndNodes\n", "a.msh:6: not_a_number"},
      {form + nodes + "$Elements\n1\n1 4 -1 1 2 3 4\n$EndElements\n", "a.msh:13: wrong_count"},
      {form + nodes + "$Elements\n1\n-1 4 2 1 1 1 2 3 4\n$EndElements\n", "a.msh:13: out_of_range"},
      {form4 + nodes4 + "$Elements\n1 2 1 2\n3 1 4 1\n1 1 2 3 4\n$EndElements\n",
       "a.msh:17: contradiction"},
  };
  for (const InvalidMesh& mesh : meshes) {
    SCOPED_TRACE(mesh.text);
    EXPECT_EQ(error_of([&] { parse_gmsh(mesh.text, "a.msh", {}); }), mesh.expected);
  }
}

/// A stiffness with its mass, its degrees of freedom and its nodes.
struct InvalidMatrices {
  std::string stiffness, mass, dofs, nodes, expected;
};

TEST(BadMeshes, MatrixMarketWithTables) {
  const std::string good =
      "%%MatrixMarket matrix coordinate real symmetric\n3 3 3\n1 1 2.\n2 2 2.\n3 3 2.\n";
  const std::string banner = "%%MatrixMarket matrix coordinate real symmetric\n";
  const std::string map = "1 1\n1 2\n1 3\n", table = "1, 0, 0, 0\n";
  const InvalidMatrices all[] = {
      {good, good, map, table, "no error"},
      {banner, good, map, table, "K.mtx:1: missing"},
      {banner + "3 3 x\n", good, map, table, "K.mtx:2: wrong_count"},
      {banner + "3 3 1\n4 1 2.\n", good, map, table, "K.mtx:3: out_of_range"},
      {banner + "3 3 1\n1 1\n", good, map, table, "K.mtx:3: wrong_count"},
      {banner + "3 3 1\n1 x 2.\n", good, map, table, "K.mtx:3: not_a_number"},
      {banner + "3 3 1\n1 1 two\n", good, map, table, "K.mtx:3: not_a_number"},
      {banner + "3 3 3\n1 1 0.\n2 2 0.\n3 3 0.\n", good, map, table, "dofs.txt: missing"},
      {good, banner + "3 3 2\n1 1 2.\n", map, table, "M.mtx:2: wrong_count"},
      {good, good, "\n", table, "dofs.txt: missing"},
      {good, good, "1 1\n1 2\n1 7\n", table, "dofs.txt:3: wrong_value"},
      {good, good, "1 1\n1 2\n2 3\n", table, "dofs.txt:3: not_found"},
      {good, good, "1 1\n1 2\n1 1\n", table, "dofs.txt:3: unsupported"},
      {good, good, map, "\n", "nodes.csv: missing"},
      {good, good, map, "1, 0, 0\n", "nodes.csv:1: wrong_count"},
      {good, good, map, "a, 0, 0, 0\n", "nodes.csv:1: not_a_number"},
      {good, good, map, "1, 0, y, 0\n", "nodes.csv:1: not_a_number"},
      {good, good, map, "1, 0, 0, 0\n1, 1, 0, 0\n", "nodes.csv:2: duplicate"},
  };
  for (const InvalidMatrices& m : all) {
    SCOPED_TRACE(m.expected);
    TemporaryFolder folder;
    FeReadOptions options;
    options.mass = folder.write("M.mtx", m.mass);
    options.dofs = folder.write("dofs.txt", m.dofs);
    options.nodes = folder.write("nodes.csv", m.nodes);
    const std::string K = folder.write("K.mtx", m.stiffness);
    EXPECT_EQ(folder.without(error_of([&] { read_fe_file(K, options, "matrix_market"); })),
              m.expected);
  }
}

}  // namespace
}  // namespace floatframe::test
