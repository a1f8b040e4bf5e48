// Equations that say nothing, or that hold a part: seen when the file is read.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "floatframe/formats/fe_file.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

const std::string equation_deck =
    "*NODE, NSET=ALL\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 0., 0., 1.\n9, 5., 0., 0.\n"
    "*NSET, NSET=TWO\n1, 2\n*ELEMENT, TYPE=C3D4, ELSET=BODY\n1, 1, 2, 3, 4\n*MATERIAL, NAME=M\n"
    "*ELASTIC\n2e5, 0.3\n*DENSITY\n7.85e-9\n*SOLID SECTION, ELSET=BODY, MATERIAL=M\n*EQUATION\n";

FeModel equation_model(const std::string& text, const char* name = "e.inp") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / name) << text;
  return read_fe_file(folder.path() / name);
}

std::string equation_error(const std::string& text, const char* name = "e.inp") {
  const std::string whole = error_of([&] { static_cast<void>(equation_model(text, name)); });
  return whole.substr(std::min(whole.find(name), whole.size()));
}

std::vector<std::string> equation_notes(const FeModel& m) {
  std::vector<std::string> out;
  for (const std::string& note : m.notes)
    if (note.find("0 = 0") != std::string::npos) out.push_back(note.substr(note.find("e.inp")));
  return out;
}

TEST(EquationChecks, EmptyEquationsAreDropped) {
  const FeModel m = equation_model(equation_deck +
                                   "2\n1, 1, 1., 1, 1, -1.\n2\nTWO, 2, 1., TWO, 2, -1.\n"
                                   "2\n1, 1, 1., 2, 1, -1.\n");
  EXPECT_EQ(m.equations.size(), 1u);
  EXPECT_EQ(equation_notes(m),
            (std::vector<std::string>{
                "e.inp:18: the equation says 0 = 0, since its terms cancel: left out",
                "e.inp:20: 2 equations say 0 = 0, since their terms cancel: left out"}));
}

TEST(EquationChecks, ThatHoldThePartAreRefused) {
  EXPECT_EQ(equation_error(equation_deck + "1\n2, 3, 1.\n"), "e.inp:18: unsupported");
  EXPECT_EQ(equation_error(equation_deck + "3\n2, 3, 1., 3, 1, 2., 3, 1, -2.\n"),
            "e.inp:18: unsupported");
  // A node of no element that is held leaves the others free.
  EXPECT_EQ(equation_error(equation_deck + "3\n1, 1, 1., 2, 1, -1., 9, 1, 1.\n1\n9, 1, 1.\n"), "");
  EXPECT_EQ(equation_error("GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\n"
                           "GRID,4,,0.,0.,1.\nCTETRA,1,1,1,2,3,4\nPSOLID,1,1\n"
                           "MAT1,1,2.+11,,.3,8000.\nMPC,1,1,2,1.\n",
                           "e.bdf"),
            "e.bdf:8: unsupported");
}

}  // namespace
}  // namespace floatframe::test
