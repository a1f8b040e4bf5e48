// Cards of Nastran that repeat the one before: the same as the deck written out.
#include <gtest/gtest.h>

#include "floatframe/formats/nastran/nastran_cards.hpp"
#include "floatframe/formats/nastran/read_nastran.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

/// Name and fields of all cards, a line each.
std::string cards_of(const std::string& text) {
  TextSource source(text, "arm.bdf");
  NastranCards cards(source, false);
  std::string all;
  NastranCard card;
  while (cards.next(card)) {
    all += card.name;
    for (const std::string_view field : card.fields) all += "," + std::string(field);
    all += '\n';
  }
  source.throw_if_any();
  return all;
}

std::string cards_error(const std::string& text) {
  return error_of([&] { cards_of(text); });
}

TEST(NastranReplication, FieldsAreThoseOfTheCardBefore) {
  EXPECT_EQ(cards_of("GRID,1,,0.,0.5,-1.\n"
                     "=,*1,,*10.,==\n"
                     "=(2)\n"
                     "=,*(2),=,=,*(.25),7.\n"
                     "GRID,9,=,=,=,*-1\n"
                     "=1\n"),
            "GRID,1,,0.,0.5,-1.\n"
            "GRID,2,,10.,0.5,-1.\n"
            "GRID,3,,20.,0.5,-1.\n"
            "GRID,4,,30.,0.5,-1.\n"
            "GRID,6,,30.,0.75,7.\n"
            "GRID,9,,30.,0.75,6.\n"
            "GRID,9,,30.,0.75,5.\n");
}

// Columns, tabs, large fields and continuations.
TEST(NastranReplication, EveryFieldFormat) {
  EXPECT_EQ(cards_of("PCOMP   1       -.1     \t\t\t\t\t\t+A\n"
                     "+A      7       .1      0.      YES     7       .1      90.     YES\n"
                     "=       *1      =       \n"
                     "        =       *.1     =       =       ==\n"
                     "=*      *1              *.1\n"),
            "PCOMP,1,-.1,,,,,,,7,.1,0.,YES,7,.1,90.,YES\n"
            "PCOMP,2,-.1,,,,,,,7,0.2,0.,YES,7,.1,90.,YES\n"
            "PCOMP,3,0.\n");
}

// Not numbers: the text of an equation.
TEST(NastranReplication, EquationsStayAsTheyAre) {
  EXPECT_EQ(cards_of("DEQATN,1,F(A)\nDEQATN,2,=A,*2\n"), "DEQATN,1,F(A)\nDEQATN,2,=A,*2\n");
}

TEST(NastranReplication, Chain) {
  TextSource source(
      "GRID,1,,0.,0.,0.\n=,*1,,*10.,==\n=98\nCBAR,1,1,1,2,0.,1.,0.\n=,*1,=,*1,*1,==\n=97\n"
      "PBAR,1,1,1.,1.,1.,1.\nMAT1,1,2.+11,,.3,1.\n",
      "arm.bdf");
  const FeModel model = read_nastran(source, false, {});
  ASSERT_EQ(model.nodes(), 100);
  EXPECT_EQ(model.positions[99], Vec3(990.0, 0.0, 0.0));
  ASSERT_EQ(model.elements.size(), 99u);
  EXPECT_EQ(model.elements[98].nodes[1], 99);
  EXPECT_EQ(model.elements[98].source.line, 6);
}

TEST(NastranReplication, Errors) {
  EXPECT_EQ(cards_error("=,*1\n"),
            "arm.bdf:1: found '=' in field 1, but there is no card before to repeat");
  EXPECT_EQ(
      cards_error("GRID,1,,0.\n=4\n"),
      "arm.bdf:2: found '=4' in field 1, expected '=' and the fields of a card, or after such "
      "a card '=n', how many more there are");
  EXPECT_EQ(
      cards_error("GRID,1,,0.\n=,*1\n=X\n"),
      "arm.bdf:3: found '=X' in field 1, expected '=' and the fields of a card, or after such "
      "a card '=n', how many more there are");
  EXPECT_EQ(cards_error("GRID,1,,0.\n=,*1,*1\n"),
            "arm.bdf:2: field 3 is '*1' and that of the card before ''; '=', '==', and '*' with a "
            "number to add to a number are read");
  EXPECT_EQ(cards_error("GRID,1,,0.\n=,%2,\n"),
            "arm.bdf:2: field 2 is '%2' and that of the card before '1'; '=', '==', and '*' with a "
            "number to add to a number are read");
  EXPECT_EQ(
      cards_error("GRID,1,,0.\n=,*1\n=999999\n=,*1\n=2\n"),
      "arm.bdf:5: more than 1000000 cards are repeated by '=n'; write the deck with its cards");
}

}  // namespace
}  // namespace floatframe::test
