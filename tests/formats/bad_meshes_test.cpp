// Invalid Gmsh meshes and matrix files, each with its whole sentence.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/gmsh/read_gmsh.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

struct InvalidMesh {
  std::string text, sentence;
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
      {"$MeshFormat\n4.1 0\n",
       "a.msh:2: found '4.1 0', expected the version, 0 (ASCII) or 1 (binary) and the size of a "
       "number, as in '4.1 0 8'"},
      {"$MeshFormat\n4.1 2 8\n", "a.msh:2: found '2', expected 0 (ASCII) or 1 (binary)"},
      {"$MeshFormat\n4.1 1 4\n", "a.msh:2: numbers of '4' bytes are not read, only of 8"},
      {form + "Nodes\n", "a.msh:4: found 'Nodes', expected a section such as $Nodes"},
      {form + elements, "a.msh:8: the file has no section $Nodes"},
      {form + nodes, "a.msh:11: the file has no section $Elements"},
      {form + nodes + nodes, "a.msh:11: section $Nodes is in the file twice"},
      {form + "$PhysicalNames\n1.5\n",
       "a.msh:5: found '1.5', expected the number of physical names, a whole number from 0"},
      {form + "$PhysicalNames\n2\n3 1 \"A\"\n3 1 \"B\"\n$EndPhysicalNames\n" + nodes + elements,
       "a.msh:7: physical group 1 of dimension 3 has a second name 'B'"},
      {form + "$Nodes\n1\n0 0 0 0\n$EndNodes\n",
       "a.msh:6: the number of a node is 0, expected 1 or more"},
      {form + "$Nodes\n1\nx 0 0 0\n$EndNodes\n",
       "a.msh:6: found 'x', expected a node number, a whole number"},
      {form + nodes + "$Elements\n1\n1 4 -1 1 2 3 4\n$EndElements\n",
       "a.msh:13: an element with -1 tags, expected 2"},
      {form + nodes + "$Elements\n1\n-1 4 2 1 1 1 2 3 4\n$EndElements\n",
       "a.msh:13: the number of an element is -1, expected 1 or more"},
      {form4 + nodes4 + "$Elements\n1 2 1 2\n3 1 4 1\n1 1 2 3 4\n$EndElements\n",
       "a.msh:17: section $Elements says 2 elements, its blocks have 1"},
  };
  for (const InvalidMesh& mesh : meshes) {
    SCOPED_TRACE(mesh.text);
    EXPECT_EQ(error_of([&] { parse_gmsh(mesh.text, "a.msh", {}); }), mesh.sentence);
  }
}

/// A stiffness with its mass, its degrees of freedom and its nodes.
struct InvalidMatrices {
  std::string stiffness, mass, dofs, nodes, sentence;
};

TEST(BadMeshes, MatrixMarketWithTables) {
  const std::string good =
      "%%MatrixMarket matrix coordinate real symmetric\n3 3 3\n1 1 2.\n2 2 2.\n3 3 2.\n";
  const std::string banner = "%%MatrixMarket matrix coordinate real symmetric\n";
  const std::string map = "1 1\n1 2\n1 3\n", table = "1, 0, 0, 0\n";
  const InvalidMatrices all[] = {
      {good, good, map, table, "no error"},
      {banner, good, map, table,
       "K.mtx:1: the line with rows, columns and number of entries is missing"},
      {banner + "3 3 x\n", good, map, table,
       "K.mtx:2: the line is not rows, columns and number of entries, whole numbers up to "
       "2147483647"},
      {banner + "3 3 1\n4 1 2.\n", good, map, table,
       "K.mtx:3: row 4, column 1 is outside: the matrix is 3 x 3"},
      {banner + "3 3 1\n1 1\n", good, map, table, "K.mtx:3: the line is not row, column and value"},
      {banner + "3 3 1\n1 x 2.\n", good, map, table, "K.mtx:3: column: 'x' is not a whole number"},
      {banner + "3 3 1\n1 1 two\n", good, map, table, "K.mtx:3: value: 'two' is not a number"},
      {banner + "3 3 3\n1 1 0.\n2 2 0.\n3 3 0.\n", good, map, table,
       "dofs.txt: the stiffness is zero"},
      {good, banner + "3 3 2\n1 1 2.\n", map, table, "M.mtx:2: the mass has 1 entries, expected 2"},
      {good, good, "\n", table, "dofs.txt: there are no degrees of freedom in the file"},
      {good, good, "1 1\n1 2\n1 7\n", table,
       "dofs.txt:3: '1 7' is no degree of freedom, expected node and direction 1 to 6, or 0 of a "
       "scalar point"},
      {good, good, "1 1\n1 2\n2 3\n", table,
       "dofs.txt:3: node 2 is not among the nodes of nodes.csv"},
      {good, good, "1 1\n1 2\n1 1\n", table,
       "dofs.txt:3: degree of freedom 1.1 is there already (line 1); matrices in which beams and "
       "shells are expanded to solids cannot be read: read the deck"},
      {good, good, map, "\n", "nodes.csv: there are no nodes in the file"},
      {good, good, map, "1, 0, 0\n", "nodes.csv:1: the line has 3 fields, expected node, x, y, z"},
      {good, good, map, "a, 0, 0, 0\n", "nodes.csv:1: node number: 'a' is not a whole number"},
      {good, good, map, "1, 0, y, 0\n", "nodes.csv:1: coordinate 2 of node 1: 'y' is not a number"},
      {good, good, map, "1, 0, 0, 0\n1, 1, 0, 0\n",
       "nodes.csv:2: node 1 is there already (line 1)"},
  };
  for (const InvalidMatrices& m : all) {
    SCOPED_TRACE(m.sentence);
    TemporaryFolder folder;
    FeReadOptions options;
    options.mass = folder.write("M.mtx", m.mass);
    options.dofs = folder.write("dofs.txt", m.dofs);
    options.nodes = folder.write("nodes.csv", m.nodes);
    const std::string K = folder.write("K.mtx", m.stiffness);
    EXPECT_EQ(folder.without(error_of([&] { read_fe_file(K, options, "matrix_market"); })),
              m.sentence);
  }
}

}  // namespace
}  // namespace floatframe::test
