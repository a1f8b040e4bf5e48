// Nodes that no line of a file gives are in the model, but no place on the part is one of them.
#include <gtest/gtest.h>

#include <algorithm>

#include "decks/ansys_deck.hpp"
#include "decks/deck_text.hpp"
#include "floatframe/fe/interface_selection.hpp"

namespace floatframe::test {
namespace {

std::vector<int> nodes_at(const FeModel& model, NodeChoice::By by, const Vec3& point) {
  NodeChoice choice;
  choice.by = by;
  choice.point = point;
  choice.axis = Vec3::UnitX();
  return choose_nodes(model, choice);
}

const std::string bar_cards = "PBAR,5,9,1.,1.,1.,1.\nMAT1,9,2e11,,.3,7800.\nENDDATA\n";

TEST(MadeNodes, EndsOfBars) {
  const FeModel model = read_bdf(
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.,0.,0.\n"
      "CBAR,7,5,1,2,0.,0.,1.\n,456,,0.,0.,.1,0.,0.,.1\nCBAR,8,5,2,3,0.,0.,1.\n" +
      bar_cards);
  ASSERT_GT(model.nodes(), 3);
  for (int k = 0; k < model.nodes(); ++k)
    EXPECT_EQ(std::count(model.generated_nodes.begin(), model.generated_nodes.end(), k), k >= 3);
  EXPECT_EQ(nodes_at(model, NodeChoice::By::nearest, Vec3(0.0, 0.0, 0.1)), std::vector<int>{0});
  EXPECT_EQ(nodes_at(model, NodeChoice::By::plane, Vec3::Zero()), std::vector<int>{0});
}

TEST(MadeNodes, PlacesOfMasses) {
  const FeModel model = read_bdf(
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nCBAR,7,5,1,2,0.,0.,1.\nCONM2,10,1,,2.,0.,.5,.5\n" +
      bar_cards);
  EXPECT_EQ(model.generated_nodes, std::vector<int>{2});
  EXPECT_EQ(nodes_at(model, NodeChoice::By::nearest, Vec3(0.0, 0.5, 0.5)), std::vector<int>{0});
}

// Commands of one line, divided by $: the node is one of the file.
TEST(MadeNodes, NotThoseOnTheLineOfAnElement) {
  const FeModel model = ansys_of(
      "/PREP7\nET,1,188\nMP,EX,1,2e11\nMP,PRXY,1,.3\nMP,DENS,1,7850\nSECTYPE,1,BEAM,RECT\n"
      "SECDATA,.02,.03\nSECNUM,1\nN,2,1,0,0\nN,3,2,0,0\nE,2,3\nN,1,0,0,0 $ E,1,2\n");
  EXPECT_TRUE(model.generated_nodes.empty());
  const std::vector<int> found = nodes_at(model, NodeChoice::By::nearest, Vec3::Zero());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(model.node_label(found[0]), "node 1");
}

}  // namespace
}  // namespace floatframe::test
