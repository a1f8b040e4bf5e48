// ANSYS decks: springs, masses, rigid links, equations, each against what it means.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/ansys_deck.hpp"

namespace floatframe::test {
namespace {

TEST(AnsysPoints, SpringsMassesAndRigidLinks) {
  const FeModel m =
      ansys_of(cdb_brick + cdb_steel +
               "N,20,5,0,0\nN,21,5,3,4,90\nN,22,6,0,0\nN,23,7,0,0\nN,24,8,1,0\nET,2,14\nET,3,"
               "14\nKEYOPT,3,2,1\nET,4,14\n"
               "KEYOPT,4,3,1\nET,5,21\nET,6,21\nKEYOPT,6,3,2\nET,7,184\nKEYOPT,7,1,1\nET,8,184\n"
               "R,2,100,3\nR,5,2,2,2,3,4,5\nR,6,.5\nREAL,2\nTYPE,2\nEN,2,20,21\nTYPE,3\nEN,3,20,"
               "21\nEN,4,20\n"
               "TYPE,4\nEN,5,20,21\nREAL,5\nTYPE,5\nEN,6,20\nEN,7,1\nREAL,6\nTYPE,6\nEN,8,2\nTYPE,"
               "7\nEN,9,20,2\n"
               "EN,10,20,3\nEN,11,20,7\nTYPE,8\nEN,12,23,24\nCERIG,22,1,UXYZ\nCERIG,22,4,UXYZ\n");
  ASSERT_EQ(m.springs.size(), 4u);
  Vec6 d = Vec6::Zero();
  d.head<3>() = Vec3(0, 0.6, 0.8);
  EXPECT_LE((m.springs[0].directions[1] - d).norm() + (m.springs[0].directions[0] + d).norm(),
            1e-15);
  EXPECT_EQ(m.springs[0].stiffness, 100.0);
  // UX of the second node, whose axes are turned by 90 degrees about z, is along y.
  EXPECT_LE((m.springs[1].directions[0] + Vec6::Unit(0)).norm(), 1e-15);
  EXPECT_LE((m.springs[1].directions[1] - Vec6::Unit(1)).norm(), 1e-15);
  EXPECT_EQ(m.springs[2].nodes[1], -1);
  EXPECT_NEAR(m.springs[3].directions[1](5), 0.8, 1e-15);
  ASSERT_EQ(m.masses.size(), 3u);
  EXPECT_EQ(m.masses[0].mass, 2.0);
  EXPECT_EQ(m.masses[0].J(1, 1), 4.0);
  EXPECT_TRUE(m.masses[1].J.isZero(0.0));  // a node of solids alone has no rotations
  EXPECT_EQ(m.masses[2].mass, 0.5);
  ASSERT_EQ(m.spiders.size(), 2u);
  EXPECT_EQ(m.node_ids[m.spiders[0].reference], 20);
  EXPECT_EQ(m.spiders[0].nodes, (std::vector<int>{1, 2, 6}));
  EXPECT_EQ(m.spiders[1].mask, 7u);
  EXPECT_EQ(m.spiders[1].nodes, (std::vector<int>{0, 3}));
  ASSERT_EQ(m.equations.size(), 1u);  // the rigid link keeps its length
  EXPECT_EQ(m.equations[0].terms.size(), 4u);
  EXPECT_NEAR(m.equations[0].terms[0].factor, std::sqrt(0.5), 1e-15);
}

TEST(AnsysPoints, EquationsInTurnedAxes) {
  for (const bool written : {true, false}) {
    const FeModel m = ansys_of(
        "ET,1,185\nN,1,0,0,0,90\n" + cdb_square.substr(cdb_square.find("N,2")) +
        "E,1,2,3,4,5,6,7,8\n" + cdb_steel +
        (written ? "CE,R5.0,DEFI,       1,       3,  0.00000000    \nCE,R5.0,NODE,      1,UX  ,  "
                   "2.0    ,"
                   "      2,UY  , -1.0\nCE,R5.0,NODE,      3,UZ  , -1.0\nCP,R5.0,DEFI,  1,  3,UZ\n"
                   "CP,R5.0,NODE, 5, 6, 7\n"
                 : "CE,1,0,1,UX,2,2,UY,-1\nCE,1,0,3,UZ,-1\nCP,NEXT,UZ,5,6,7\n"));
    ASSERT_EQ(m.equations.size(), 3u);
    const auto& terms = m.equations[0].terms;
    ASSERT_EQ(terms.size(), 3u);
    EXPECT_EQ(terms[0].axis, 1);
    EXPECT_NEAR(terms[0].factor, 2.0, 1e-15);
    EXPECT_EQ(terms[2].node, 2);
    EXPECT_EQ(m.equations[2].terms[0].node, 6);
    EXPECT_EQ(m.equations[2].terms[1].node, 4);
    EXPECT_EQ(m.equations[2].terms[1].factor, -1.0);
  }
}

}  // namespace
}  // namespace floatframe::test
