// A number that is none is one error, where it stands, and nothing that would follow from it.
#include <gtest/gtest.h>

#include "floatframe/decks/abaqus/read_abaqus.hpp"
#include "floatframe/formats/text/text_source.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

const std::string one_error_deck =
    "*NODE, NSET=ALL\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 0., 0., 1.\n"
    "*ELEMENT, TYPE=C3D4, ELSET=BODY\n1, 1, 2, 3, 4\n*MATERIAL, NAME=M\n*ELASTIC\n2e5, 0.3\n"
    "*DENSITY\n7.85e-9\n*SOLID SECTION, ELSET=BODY, MATERIAL=M\n";  // 13 lines

struct OneError {
  const char* text;
  const char* sentence;
};

TEST(OneError, OfANumberThatIsNone) {
  const OneError cases[] = {
      {"*EQUATION\n2\n1, 1, nan, 2, 1, -1.\n", "one.inp:16: factor: 'nan' is not a number"},
      {"*EQUATION\n2\n1, nan, 1., 2, 1, -1.\n",
       "one.inp:16: *EQUATION: the degree of freedom is 'nan', expected 1 to 6"},
      {"*EQUATION\nnan\n1, 1, 1., 2, 1, -1.\n",
       "one.inp:15: *EQUATION: 'nan' is no number of terms"},
      {"*EQUATION\n2\nnan, 1, 1., 2, 1, -1.\n", "one.inp:16: node set 'NAN' does not exist"},
      {"*TRANSFORM, NSET=ALL\nnan, 0., 0., 0., 1., 0.\n",
       "one.inp:15: coordinate of *TRANSFORM: 'nan' is not a number"},
      {"*TRANSFORM, NSET=ALL, TYPE=C\n0., 0., 0., 0., 0., inf\n",
       "one.inp:15: coordinate of *TRANSFORM: 'inf' is not a number"},
      {"*ELSET, ELSET=A, GENERATE\n1, nan\n",
       "one.inp:15: last number: 'nan' is not a whole number"},
      {"*ELSET, ELSET=A\n1, nan\n", "one.inp:15: element set 'NAN' does not exist"},
      {"*NSET, NSET=A, GENERATE\n1, 4, 1.5\n",
       "one.inp:15: increment: '1.5' is not a whole number"},
      {"*NGEN\n1, nan, 1\n", "one.inp:15: node: 'nan' is not a whole number"},
      {"*NGEN, LINE=C\n2, 3, 1, nan\n", "one.inp:15: node: 'nan' is not a whole number"},
      {"*NFILL\nALL, ALL, nan\n", "one.inp:15: number of intervals: 'nan' is not a whole number"},
      {"*NCOPY, CHANGE NUMBER=x, OLD SET=ALL, SHIFT\n1., 0., 0.\n",
       "one.inp:14: CHANGE NUMBER: 'x' is not a whole number"},
      {"*ELGEN\n1, nan\n", "one.inp:15: number of elements: 'nan' is not a whole number"},
      {"*ELGEN\nnan, 2\n", "one.inp:15: element: 'nan' is not a whole number"},
      {"*ELCOPY, ELEMENT SHIFT=x, OLD SET=BODY, SHIFT NODES=1\n",
       "one.inp:14: ELEMENT SHIFT: 'x' is not a whole number"},
      {"*SYSTEM\n0., 0., 0., nan, 0., 0.\n",
       "one.inp:15: coordinate of *SYSTEM: 'nan' is not a number"},
      {"*ORIENTATION, NAME=O\n1., 0., 0., 0., 1., 0.\nnan, 30.\n",
       "one.inp:14: *ORIENTATION turns about axis 'nan', expected 1, 2 or 3"},
      {"*ELEMENT, TYPE=DCOUP3D, ELSET=D\n9, 1\n*DISTRIBUTING COUPLING, ELSET=D\n2, nan\n",
       "one.inp:17: the weight of a node: 'nan' is not a number"},
      {"*ELEMENT, TYPE=DCOUP3D, ELSET=D\n9, 1\n*DISTRIBUTING COUPLING, ELSET=D\n2, -1.\n",
       "one.inp:17: the weight of a node is -1, expected more than 0"},
  };
  for (const OneError& c : cases)
    EXPECT_EQ(error_of([&] {
                TextSource source(one_error_deck + c.text, "one.inp");
                read_abaqus(source, {});
              }),
              c.sentence)
        << c.text;
}

}  // namespace
}  // namespace floatframe::test
