// A number that is none is one error, where it stands, and nothing that would follow from it.
#include <gtest/gtest.h>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

const std::string one_error_deck =
    "*NODE, NSET=ALL\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 0., 0., 1.\n"
    "*ELEMENT, TYPE=C3D4, ELSET=BODY\n1, 1, 2, 3, 4\n*MATERIAL, NAME=M\n*ELASTIC\n2e5, 0.3\n"
    "*DENSITY\n7.85e-9\n*SOLID SECTION, ELSET=BODY, MATERIAL=M\n";  // 13 lines

struct OneError {
  const char* text;
  const char* expected;
};

TEST(OneError, OfANumberThatIsNone) {
  const OneError cases[] = {
      {"*EQUATION\n2\n1, 1, nan, 2, 1, -1.\n", "one.inp:16: not_a_number"},
      {"*EQUATION\n2\n1, nan, 1., 2, 1, -1.\n", "one.inp:16: out_of_range"},
      {"*EQUATION\nnan\n1, 1, 1., 2, 1, -1.\n", "one.inp:15: not_a_number"},
      {"*EQUATION\n2\nnan, 1, 1., 2, 1, -1.\n", "one.inp:16: not_found"},
      {"*TRANSFORM, NSET=ALL\nnan, 0., 0., 0., 1., 0.\n", "one.inp:15: not_a_number"},
      {"*TRANSFORM, NSET=ALL, TYPE=C\n0., 0., 0., 0., 0., inf\n", "one.inp:15: not_a_number"},
      {"*ELSET, ELSET=A, GENERATE\n1, nan\n", "one.inp:15: not_a_number"},
      {"*ELSET, ELSET=A\n1, nan\n", "one.inp:15: not_found"},
      {"*NSET, NSET=A, GENERATE\n1, 4, 1.5\n", "one.inp:15: not_a_number"},
      {"*NGEN\n1, nan, 1\n", "one.inp:15: not_a_number"},
      {"*NGEN, LINE=C\n2, 3, 1, nan\n", "one.inp:15: not_a_number"},
      {"*NFILL\nALL, ALL, nan\n", "one.inp:15: not_a_number"},
      {"*NCOPY, CHANGE NUMBER=x, OLD SET=ALL, SHIFT\n1., 0., 0.\n", "one.inp:14: not_a_number"},
      {"*ELGEN\n1, nan\n", "one.inp:15: not_a_number"},
      {"*ELGEN\nnan, 2\n", "one.inp:15: not_a_number"},
      {"*ELCOPY, ELEMENT SHIFT=x, OLD SET=BODY, SHIFT NODES=1\n", "one.inp:14: not_a_number"},
      {"*SYSTEM\n0., 0., 0., nan, 0., 0.\n", "one.inp:15: not_a_number"},
      {"*ORIENTATION, NAME=O\n1., 0., 0., 0., 1., 0.\nnan, 30.\n", "one.inp:14: out_of_range"},
      {"*ELEMENT, TYPE=DCOUP3D, ELSET=D\n9, 1\n*DISTRIBUTING COUPLING, ELSET=D\n2, nan\n",
       "one.inp:17: not_a_number"},
      {"*ELEMENT, TYPE=DCOUP3D, ELSET=D\n9, 1\n*DISTRIBUTING COUPLING, ELSET=D\n2, -1.\n",
       "one.inp:17: out_of_range"},
  };
  for (const OneError& c : cases)
    EXPECT_EQ(inp_error(one_error_deck + c.text, {}, "one.inp"), c.expected) << c.text;
}

}  // namespace
}  // namespace floatframe::test
