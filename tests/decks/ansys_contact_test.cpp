// ANSYS decks: bonded contact and remote points, each against what it means.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "decks/ansys_deck.hpp"

namespace floatframe::test {
namespace {

/// Two bricks, one on the other; contact elements on the upper, a target on the lower.
std::string two_bricks(int behaviour) {
  return "ET,1,185\n" + cdb_square +
         "N,11,0,0,1\nN,12,2,0,1\nN,13,2,1,1\nN,14,0,1,1\nN,15,0,0,2\nN,16,2,0,2\nN,17,2,1,2\n"
         "N,18,0,1,2\nE,1,2,3,4,5,6,7,8\nE,11,12,13,14,15,16,17,18\n" +
         cdb_steel +
         fmt::format(
             "ET,2,170\nET,3,174\nKEYOPT,3,12,{}\nR,4\nREAL,4\nTYPE,2\nE,5,6,7,8\nTYPE,3\n"
             "E,11,14,13,12\n",
             behaviour);
}

TEST(AnsysContact, BondedPairsAreTiedOthersByOption) {
  const FeModel bonded = ansys_of(two_bricks(5));
  EXPECT_EQ(bonded.elements.size(), 2u);
  ASSERT_EQ(bonded.equations.size(), 12u);
  // The nodes lie on those of the target.
  for (const LinearEquation& e : bonded.equations)
    for (const auto& term : e.terms)
      EXPECT_TRUE(std::abs(std::abs(term.factor) - 1.0) < 1e-12 || std::abs(term.factor) < 1e-12);
  EXPECT_EQ(bonded.notes.at(0),
            "a.cdb:36: bonded pair of real constants 4: 4 of 4 nodes are tied (within 0.0395)");
  FeReadOptions options;
  options.contact = DeckContact::ignore;
  EXPECT_TRUE(ansys_of(two_bricks(0), options).equations.empty());
  options.contact = DeckContact::tied;
  EXPECT_EQ(ansys_of(two_bricks(0), options).equations.size(), 12u);
  EXPECT_EQ(ansys_error(two_bricks(0)), "a.cdb:36: unsupported");
}

TEST(AnsysContact, RemotePoints) {
  const auto deck = [](int option) {
    return cdb_brick + cdb_steel +
           fmt::format(
               "N,50,5,0,0\nET,2,170\nET,3,174\nKEYOPT,3,2,2\nKEYOPT,3,4,{}\nKEYOPT,3,12,5\nREAL,"
               "4\nTYPE,2\nE,50\nTYPE,3\nE,2,3,7,6\n",
               option);
  };
  const FeModel rigid = ansys_of(deck(2)), mean = ansys_of(deck(1));
  ASSERT_EQ(rigid.spiders.size(), 1u);
  EXPECT_EQ(rigid.spiders[0].kind, Spider::Kind::rigid);
  EXPECT_EQ(rigid.node_ids[rigid.spiders[0].reference], 50);
  EXPECT_EQ(rigid.spiders[0].nodes, (std::vector<int>{1, 2, 5, 6}));
  EXPECT_EQ(mean.spiders.at(0).kind, Spider::Kind::mean);
  EXPECT_EQ(mean.notes.at(0),
            "a.cdb:29: the remote point of real constants 4: node 50 moves as the mean of 4 nodes, "
            "weighed by their shares of the area of the faces");
  for (const double w : mean.spiders[0].weights) EXPECT_DOUBLE_EQ(w, 0.25);
}

/// As Workbench writes them: the pilot has a shape of its own, and the next target again its own.
TEST(AnsysContact, ShapesOfTargets) {
  const auto deck = [](const std::string& shape) {
    return cdb_brick + cdb_steel +
           "N,50,5,0,0\nET,2,170\nET,3,174\nKEYOPT,3,2,2\nKEYOPT,3,4,2\nKEYOPT,3,12,5\nREAL,4\n"
           "TYPE,2\n" +
           shape + "\nEN,1001,50\ntshape\nTYPE,3\nE,2,3,7,6\n";
  };
  for (const char* shape : {"tshape,pilo", "TSHAP,PILOT", "TSHAP,PILO"}) {
    const FeModel m = ansys_of(deck(shape));
    ASSERT_EQ(m.spiders.size(), 1u) << shape;
    EXPECT_EQ(m.node_ids[m.spiders[0].reference], 50);
    EXPECT_EQ(m.spiders[0].nodes, (std::vector<int>{1, 2, 5, 6}));
  }
  EXPECT_EQ(ansys_error(deck("TSHAP,SPHE")), "a.cdb:29: unsupported");
}

/// Faces of different size and kind, with and without mid-side nodes.
TEST(AnsysContact, WeightsOfRemotePoints) {
  const auto weights = [](const std::string& faces, const char* number) {
    const FeModel m = ansys_of(
        cdb_brick + cdb_steel +
        "N,31,10\nN,32,14\nN,33,14,1\nN,34,10,1\nN,35,16\nN,36,12\nN,37,14,.5\nN,38,12,1\n"
        "N,39,10,.5\nN,40,15\nN,41,15,.5\nN,50,5,0,0\nET,2,170\nET,3," +
        std::string(number) +
        "\nKEYOPT,3,2,2\nKEYOPT,3,4,1\nKEYOPT,3,12,5\nREAL,4\nTYPE,2\nE,50\nTYPE,3\n" + faces);
    std::map<int, double> out;
    const Spider& s = m.spiders.at(0);
    for (std::size_t k = 0; k < s.nodes.size(); ++k)
      out[m.node_ids[s.nodes[k]]] = s.weights.empty() ? -1.0 : s.weights[k];
    return out;
  };
  const auto expect = [](const std::map<int, double>& found, const std::map<int, double>& right) {
    ASSERT_EQ(found.size(), right.size());
    for (const auto& [node, weight] : right) EXPECT_NEAR(found.at(node), weight, 1e-14) << node;
  };
  // A rectangle of 4 and a triangle of 1: a third of the triangle for each of its corners.
  expect(weights("E,31,32,33,34\nE,32,35,33,33\n", "173"),
         {{31, 1}, {32, 4.0 / 3}, {33, 4.0 / 3}, {34, 1}, {35, 1.0 / 3}});
  // int N_k^2 dA: 3/76 at the corners, 16/76 in the middles of a quadrilateral.
  const double c = 4 * 3.0 / 76, m = 4 * 16.0 / 76;
  expect(weights("E,31,32,33,34,36,37,38,39\n", "174"),
         {{31, c}, {32, c}, {33, c}, {34, c}, {36, m}, {37, m}, {38, m}, {39, m}});
  // One middle is not there.
  expect(weights("E,31,32,33,34,36,0,38,39\n", "174"),
         {{31, c}, {32, c + m / 2}, {33, c + m / 2}, {34, c}, {36, m}, {38, m}, {39, m}});
  // 1/19 and 16/57 of a triangle.
  const double tc = 1.0 / 19, tm = 1.0 / 3 - 1.0 / 19;
  expect(weights("E,32,35,33,33,40,41,33,37\n", "174"),
         {{32, tc}, {35, tc}, {33, tc}, {40, tm}, {41, tm}, {37, tm}});
  // Nodes alone.
  expect(weights("E,31\nE,32\nE,33\n", "175"), {{31, -1}, {32, -1}, {33, -1}});
}

}  // namespace
}  // namespace floatframe::test
