// *MPC of Abaqus decks: rigid bars, pins and ties of two nodes.
#include <gtest/gtest.h>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

FeModel mpc_deck(const std::string& mpc) {
  return read_inp(
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 3, 0, 0\n6, 1, 0, 0\n"
      "*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1, 2, 3, 4\n*NSET, NSET=S\n2, 3, 4\n*MATERIAL, NAME=M\n"
      "*ELASTIC\n2e11, 0.3\n*DENSITY\n7800\n*SOLID SECTION, ELSET=E, MATERIAL=M\n*MPC\n" +
      mpc);
}

TEST(DeckMpc, BarsToOneNodeAreOneSpider) {
  const FeModel model = mpc_deck("BEAM, 2, 5\nbeam, 3, 5\nBEAM, 4, 5\n");
  const FeModel set = mpc_deck("BEAM, S, 5\n");
  for (const FeModel* m : {&model, &set}) {
    ASSERT_EQ(m->spiders.size(), 1u);
    EXPECT_EQ(m->spiders[0].kind, Spider::Kind::rigid);
    EXPECT_EQ(m->spiders[0].reference, 4);
    EXPECT_EQ(m->spiders[0].nodes, (std::vector<int>{1, 2, 3}));
    EXPECT_EQ(m->spiders[0].mask, 63u);
  }
}

TEST(DeckMpc, PinsAndTies) {
  const FeModel pin = mpc_deck("PIN, 6, 2\n");
  ASSERT_EQ(pin.equations.size(), 3u);
  for (int axis = 0; axis < 3; ++axis) {
    const auto& terms = pin.equations[axis].terms;
    ASSERT_EQ(terms.size(), 2u);
    EXPECT_EQ(terms[0].node, 5);
    EXPECT_EQ(terms[1].node, 1);
    EXPECT_EQ(terms[0].axis, axis);
    EXPECT_EQ(terms[0].factor, -terms[1].factor);
  }
  const FeModel tie = mpc_deck("TIE, 2, 6\n");
  ASSERT_EQ(tie.spiders.size(), 1u);
  EXPECT_EQ(tie.spiders[0].reference, 5);
}

TEST(DeckMpc, Errors) {
  const auto error = [](const std::string& mpc) { return error_of([&] { mpc_deck(mpc); }); };
  EXPECT_EQ(error("LINK, 2, 3\n"), "deck.inp:19: unsupported");
  EXPECT_EQ(error("BEAM, 2\n"), "deck.inp:19: wrong_count");
  EXPECT_EQ(error("TIE, 2, 5\n"), "deck.inp:19: unsupported");
  EXPECT_EQ(error("PIN, 2, 9\n"), "deck.inp:19: not_found");
}

}  // namespace
}  // namespace floatframe::test
