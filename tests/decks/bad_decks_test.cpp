// Invalid decks and matrices, each with the whole sentence it must give, place included.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "floatframe/decks/abaqus/read_abaqus.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/matrices/matrix_model.hpp"
#include "floatframe/formats/matrices/read_matrices.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

struct Case {
  const char* name;
  const char* text;
  const char* expected;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

std::string name_of(const testing::TestParamInfo<Case>& info) { return info.param.name; }

// A valid deck; each case replaces a line of it, or adds lines at its end.
const std::string valid =
    "*NODE\n"                                        // 1
    "1, 0., 0., 0.\n"                                // 2
    "2, 1., 0., 0.\n"                                // 3
    "3, 0., 1., 0.\n"                                // 4
    "4, 0., 0., 1.\n"                                // 5
    "*ELEMENT, TYPE=C3D4, ELSET=BODY\n"              // 6
    "1, 1, 2, 3, 4\n"                                // 7
    "*MATERIAL, NAME=STEEL\n"                        // 8
    "*ELASTIC\n"                                     // 9
    "210000., 0.3\n"                                 // 10
    "*DENSITY\n"                                     // 11
    "7.85e-9\n"                                      // 12
    "*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL\n";  // 13

/// "7: text" replaces line 7 of the valid deck ("7:" removes it); "+text" goes to its end; "=text"
/// is the whole deck.
std::string deck_of(const std::string& edit) {
  if (edit.front() == '=') return edit.substr(1);
  if (edit.front() == '+') return valid + edit.substr(1);
  const std::size_t colon = edit.find(':');
  const int line = std::stoi(edit.substr(0, colon));
  std::size_t begin = 0;
  for (int k = 1; k < line; ++k) begin = valid.find('\n', begin) + 1;
  const std::size_t end = valid.find('\n', begin) + 1;
  const std::string text = edit.size() > colon + 2 ? edit.substr(colon + 2) + "\n" : "";
  return valid.substr(0, begin) + text + valid.substr(end);
}

const Case decks[] = {
    {"element_cut_off", "=*NODE\n1, 0., 0., 0.\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3,",
     "bad.inp:4: element 1 (C3D4) has 3 nodes, expected 4"},
    {"too_few_nodes", "7: 1, 1, 2, 3", "bad.inp:7: element 1 (C3D4) has 3 nodes, expected 4"},
    {"missing_node_of_element", "5:", "bad.inp:6: element 1 (C3D4): node 4 does not exist"},
    {"missing_node_of_set", "+*NSET, NSET=HOLE\n1, 2, 17\n", "bad.inp:15: node 17 does not exist"},
    {"missing_set", "+*NSET, NSET=HOLE\n1, 2\n*BOUNDARY\nHOLES, 1, 3\n",
     "bad.inp:17: node set 'HOLES' does not exist, did you mean 'HOLE'?"},
    {"unknown_type", "6: *ELEMENT, TYPE=C3D27, ELSET=BODY",
     "bad.inp:6: *ELEMENT has the type 'C3D27', which is not supported, did you mean 'C3D20'?"},
    {"plane_type_with_section", "6: *ELEMENT, TYPE=CPS4, ELSET=BODY",
     "bad.inp:13: *SOLID SECTION names element 1 (CPS4); elements of this type are read as skins "
     "only, without a section"},
    {"solid_section_of_beam",
     "+*ELEMENT, TYPE=B31, ELSET=ROD\n2, 1, 2\n*SOLID SECTION, ELSET=ROD, MATERIAL=STEEL\n",
     "bad.inp:16: *SOLID SECTION names element 2 (B31), for which it is not supported"},
    {"node_twice", "5: 4, 0., 0., 1.\n2, 1., 0., 1.",
     "bad.inp:6: node 2 is there already (bad.inp:3)"},
    {"element_twice", "7: 1, 1, 2, 3, 4\n1, 1, 2, 3, 4",
     "bad.inp:8: element 1 is there already (bad.inp:7)"},
    {"material_twice", "+*MATERIAL, NAME=Steel\n",
     "bad.inp:14: *MATERIAL names the material 'STEEL' a second time (bad.inp:8)"},
    {"missing_material", "8: *MATERIAL, NAME=STEAL",
     "bad.inp:13: *SOLID SECTION names the material 'STEEL', which does not exist, did you mean "
     "'STEAL'?"},
    {"missing_elasticity", "9: *EXPANSION", "bad.inp:8: material 'STEEL' has no *ELASTIC"},
    {"orthotropic", "9: *ELASTIC, TYPE=ENGINEERING CONSTANTS",
     "bad.inp:9: *ELASTIC has no constant 3 of 9: eight stand in a line"},
    {"poisson", "10: 210000., 0.5",
     "bad.inp:9: *ELASTIC has Poisson's ratio 0.5, expected more than -1 and less than 0.5"},
    {"temperature_dependent", "10: 210000., 0.3, 20.\n190000., 0.3, 300.",
     "bad.inp:9: *ELASTIC depends on the temperature (20 to 300): say at which one with "
     "--temperature (key `temperature`)"},
    {"descending_temperatures", "10: 210000., 0.3, 300.\n190000., 0.3, 20.",
     "bad.inp:9: *ELASTIC has the temperature 20 after 300, expected ascending ones"},
    {"fields", "9: *ELASTIC, DEPENDENCIES=1",
     "bad.inp:9: *ELASTIC depends on field variables (DEPENDENCIES), which is not supported"},
    {"no_section",
     "13:", "bad.inp:7: element 1 (C3D4) has no section: no *SOLID SECTION names a set with it"},
    {"shell_without_section",
     "+*ELEMENT, TYPE=S3, ELSET=SHELLS\n2, 1, 2, 3\n*SHELL SECTION, ELSET=SHELLS, MATERIAL=STEEL\n"
     "0.1\n*ELEMENT, TYPE=S3\n3, 2, 3, 4\n",
     "bad.inp:19: element 3 (S3) has no section: no *SHELL SECTION names a set with it"},
    {"two_sections", "+*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL\n",
     "bad.inp:14: *SOLID SECTION names element 1 (C3D4), which has one already (bad.inp:13)"},
    {"section_of_missing_set", "13: *SOLID SECTION, ELSET=BODDY, MATERIAL=STEEL",
     "bad.inp:13: element set 'BODDY' does not exist, did you mean 'BODY'?"},
    {"orientation", "13: *SOLID SECTION, ELSET=BODY, MATERIAL=STEEL, ORIENTATION=OR1",
     "bad.inp:13: *SOLID SECTION names the orientation 'OR1', which does not exist"},
    {"utf16", "=\xff\xfe*\x01N\x01",
     "bad.inp: the file is text of 16 bits per character (UTF-16); save it as ASCII or UTF-8"},
    {"control_bytes", "=*NODE\n\x01\x02\x03\x04\x05\x06\n",
     "bad.inp: the file is binary, not text: byte 0x01 in line 2"},
    {"words_first", "=solid part\n*NODE\n1\n",
     "bad.inp:1: the deck begins with 'solid part', expected a keyword line (*...)"},
    {"no_nodes", "=*HEADING\nnothing\n", "bad.inp: the deck has no nodes"},
    {"empty_set", "+*NSET, NSET=HOLE\n*NSET, NSET=OTHER\n1\n",
     "bad.inp:14: node set 'HOLE' is empty"},
    {"set_in_itself", "+*NSET, NSET=A\n1, B\n*NSET, NSET=B\nA\n",
     "bad.inp:17: node set 'A' contains itself"},
    {"generate", "+*NSET, NSET=A, GENERATE\n9, 3\n",
     "bad.inp:15: GENERATE from 9 to 3 by 1 gives no numbers"},
    {"coordinate", "4: 3, 0., 1.O, 0.", "bad.inp:4: coordinate 2 of node 3: '1.O' is not a number"},
    {"too_large", "4: 3, 0., 1e999, 0.", "bad.inp:4: coordinate 2 of node 3: '1e999' is too large"},
    {"not_a_number", "10: nan, 0.3", "bad.inp:10: Young's modulus: 'nan' is not a number"},
    {"node_number", "4: 3.5, 0., 1., 0.", "bad.inp:4: node number: '3.5' is not a whole number"},
    {"equation_cut_off", "+*EQUATION\n3\n1, 1, 1., 2, 1, -1.\n",
     "bad.inp:15: *EQUATION has 2 terms, expected 3"},
    {"tie", "+*TIE, NAME=T\nA, B\n",
     "bad.inp:15: surface 'A' does not exist\nbad.inp:15: surface 'B' does not exist"},
    {"spring", "+*SPRING, ELSET=S\n\n100.\n", "bad.inp:14: element set 'S' does not exist"},
    {"connector", "+*CONNECTOR SECTION, ELSET=S\nHINGE\n",
     "bad.inp:14: *CONNECTOR SECTION is not supported: cut the deck there: each body is a part of "
     "its own, and the joint is one of the model"},
    {"transform", "+*TRANSFORM, NSET=A\n1., 0., 0., 0., 1., 0.\n",
     "bad.inp:14: node set 'A' does not exist"},
    {"mistyped_keyword", "13: *SOLD SECTION, ELSET=BODY, MATERIAL=STEEL",
     "bad.inp:13: *SOLD SECTION is not known, did you mean '*SOLID SECTION'?"},
    {"second_part", "=*PART, NAME=A\n*END PART\n*PART, NAME=B\n*END PART\n",
     "bad.inp:3: the deck has 2 parts and no instance of any (*INSTANCE)"},
    {"mass_without_value", "+*ELEMENT, TYPE=MASS, ELSET=M\n9, 1\n",
     "bad.inp:15: element 9 (MASS) has no *MASS"},
    {"face_that_is_not_there", "+*SURFACE, NAME=S\nBODY, S5\n",
     "bad.inp:15: surface 'S': element 1 (C3D4) has no face 5"},
    {"missing_surface",
     "+*SURFACE, NAME=BORE\nBODY, S1\n*COUPLING, REF NODE=4, SURFACE=BOER\n*KINEMATIC\n",
     "bad.inp:16: surface 'BOER' does not exist, did you mean 'BORE'?"},
    {"missing_parameter", "+*RIGID BODY, NSET=BODY\n",
     "bad.inp:14: *RIGID BODY needs the parameter REF NODE"},
    {"reference_of_several", "+*NSET, NSET=R\n1, 2\n*RIGID BODY, NSET=R, REF NODE=R\n",
     "bad.inp:16: reference node: node set 'R' has 2 nodes, expected one"},
    {"pipe",
     "+*ELEMENT, TYPE=B31, ELSET=ROD\n2, 1, 2\n"
     "*BEAM SECTION, ELSET=ROD, MATERIAL=STEEL, SECTION=PIPE\n1., 2.\n",
     "bad.inp:17: the wall of the pipe (2) is thicker than its radius (1)"},
    {"include_in_memory", "+*INCLUDE, INPUT=other.inp\n",
     "bad.inp:14: the include file 'other.inp' cannot be read here"},
};

class BadDecks : public testing::TestWithParam<Case> {};

TEST_P(BadDecks, SayWhatIsWrong) {
  const std::string found = error_of([] {
    TextSource source(deck_of(GetParam().text), "bad.inp");
    read_abaqus(source, {});
  });
  EXPECT_EQ(found, GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Abaqus, BadDecks, testing::ValuesIn(decks), name_of);

TEST(BadDecks, SoundDeckIsSound) {
  EXPECT_EQ(error_of([] {
              TextSource source(valid, "bad.inp");
              read_abaqus(source, {});
            }),
            "no error");
}

// Two nodes with three degrees of freedom; "K" or "M" as lines "row column value".
const std::string map_text = "1.1\n1.2\n2.1\n";
const std::string matrix_text = "1 1 2.\n1 2 -1.\n2 2 2.\n2 3 -1.\n3 3 2.\n";

const Case calculix[] = {
    {"row_too_large", "1 1 2.\n2 2 2.\n3 3 2.\n3 4 1.\n",
     "bad.sti:4: row 3, column 4 is outside: bad.dof has 3 degrees of freedom"},
    {"line_cut_off", "1 1 2.\n1 2 -1.\n2 2\n", "bad.sti:3: the line is not row, column and value"},
    {"file_cut_off", "1 1 2.\n1 2 -1.\n",
     "bad.sti:2: the stiffness ends without a diagonal entry for 1.2 and 1 more: the file is "
     "truncated or does not belong to these degrees of freedom"},
    {"negative_diagonal", "1 1 2.\n2 2 -2.\n3 3 2.\n",
     "bad.sti:2: the stiffness entry (1.2, 1.2) on the diagonal is -2, expected no negative value"},
    {"entry_twice", "1 1 2.\n1 2 -1.\n1 2 -1.\n2 2 2.\n3 3 2.\n",
     "bad.sti:3: the stiffness entry (1.1, 1.2) is there already (line 2)"},
    {"not_symmetric", "1 1 2.\n1 2 -1.\n2 1 -1.5\n2 2 2.\n3 3 2.\n",
     "bad.sti:3: the stiffness entry (1.1, 1.2) is -1.5, but -1 in the other half (line 2): the "
     "matrix is not symmetric"},
    {"value", "1 1 2.\n1 2 -1.e\n2 2 2.\n3 3 2.\n", "bad.sti:2: value: '-1.e' is not a number"},
    {"penalty", "1 1 1e36\n2 2 2.\n3 3 2.\n",
     "bad.sti:1: the stiffness entry (1.1, 1.1) on the diagonal is 1e+36, the penalty of a "
     "support: write the matrices without supports"},
    {"empty", "\n", "bad.sti: the stiffness has no entries"},
};

class BadCalculix : public testing::TestWithParam<Case> {};

TEST_P(BadCalculix, SayWhatIsWrong) {
  EXPECT_EQ(error_of([] {
              TextSource nodes("1,0,0,0\n2,1,0,0\n", "nodes.csv"), K(GetParam().text, "bad.sti"),
                  M(matrix_text, "bad.mas"), dofs(map_text, "bad.dof");
              read_calculix_matrices(K, M, dofs, read_node_table(nodes));
            }),
            GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Matrices, BadCalculix, testing::ValuesIn(calculix), name_of);

const Case maps[] = {
    {"direction", "1.1\n1.7\n2.1\n",
     "bad.dof:2: '1.7' is no degree of freedom, expected node and direction 1 to 6, or 0 of a "
     "scalar point"},
    {"node_not_there", "1.1\n1.2\n5.1\n", "bad.dof:3: node 5 is not among the nodes of nodes.csv"},
    {"dof_twice", "1.1\n1.2\n1.1\n",
     "bad.dof:3: degree of freedom 1.1 is there already (line 1); matrices in which beams and "
     "shells are expanded to solids cannot be read: read the deck"},
    {"too_short", "1.1\n1.2\n",
     "bad.sti:4: row 2, column 3 is outside: bad.dof has 2 degrees of freedom\nbad.sti:5: row 3, "
     "column 3 is outside: bad.dof has 2 degrees of freedom"},
};

class BadMaps : public testing::TestWithParam<Case> {};

TEST_P(BadMaps, SayWhatIsWrong) {
  EXPECT_EQ(error_of([] {
              TextSource nodes("1,0,0,0\n2,1,0,0\n", "nodes.csv"), K(matrix_text, "bad.sti"),
                  M(matrix_text, "bad.mas"), dofs(GetParam().text, "bad.dof");
              read_calculix_matrices(K, M, dofs, read_node_table(nodes));
            }),
            GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Matrices, BadMaps, testing::ValuesIn(maps), name_of);

const Case market[] = {
    {"complex", "%%MatrixMarket matrix coordinate complex symmetric\n3 3 1\n1 1 1. 0.\n",
     "bad_K.mtx:1: the banner says 'complex', expected real or integer"},
    {"wrong_count",
     "%%MatrixMarket matrix coordinate real symmetric\n3 3 4\n1 1 2.\n2 2 2.\n3 3 2.\n",
     "bad_K.mtx:2: the stiffness has 3 entries, expected 4"},
    {"wrong_size", "%%MatrixMarket matrix coordinate real symmetric\n4 4 1\n1 1 2.\n",
     "bad_K.mtx:2: the stiffness is 4 x 4, but bad_dofs.csv has 3 degrees of freedom"},
    {"entries_without_end",
     "%%MatrixMarket matrix coordinate real symmetric\n3 3 1000000000000\n1 1 2.\n",
     "bad_K.mtx:2: the line is not rows, columns and number of entries, whole numbers up to "
     "2147483647"},
    {"no_banner", "3 3 1\n1 1 2.\n",
     "bad_K.mtx:1: the first line is not '%%MatrixMarket matrix coordinate real symmetric'"},
};

class BadMarket : public testing::TestWithParam<Case> {};

TEST_P(BadMarket, SayWhatIsWrong) {
  EXPECT_EQ(error_of([] {
              TextSource nodes("1,0,0,0\n2,1,0,0\n", "nodes.csv"), K(GetParam().text, "bad_K.mtx"),
                  M("", "bad_M.mtx"), dofs(map_text, "bad_dofs.csv");
              read_matrix_market(K, M, dofs, read_node_table(nodes));
            }),
            GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Matrices, BadMarket, testing::ValuesIn(market), name_of);

const Case labels[] = {
    {"internal_node", "1,1, 1,1, 2.\n-4,1, 1,1, 1.\n",
     "bad_STIF1.mtx:2: node -4 is internal to Abaqus (Lagrange multipliers of distributing "
     "couplings, connectors or hybrid elements): write the matrices without them and give the "
     "interfaces here"},
    {"four_fields", "1,1, 1,1, 2.\n1,1, 1,2\n",
     "bad_STIF1.mtx:2: the line has 4 fields, expected node, direction, node, direction, value"},
    {"temperature", "1,1, 1,1, 2.\n1,11, 1,11, 2.\n",
     "bad_STIF1.mtx:2: direction 11 of node 1: expected 1 to 6"},
    {"mass_only", "1,1, 1,1, 2.\n",
     "bad_MASS1.mtx:1: degree of freedom 2.1 is not in the stiffness"},
};

class BadLabels : public testing::TestWithParam<Case> {};

TEST_P(BadLabels, SayWhatIsWrong) {
  EXPECT_EQ(error_of([] {
              TextSource nodes("1,0,0,0\n2,1,0,0\n", "nodes.csv"),
                  K(GetParam().text, "bad_STIF1.mtx"), M("2,1, 2,1, 1.\n", "bad_MASS1.mtx");
              read_abaqus_matrices(K, M, nullptr, read_node_table(nodes));
            }),
            GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Matrices, BadLabels, testing::ValuesIn(labels), name_of);

/// Files in a folder of their own.
class BadFiles : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) { folder_.write(name, text); }
  std::string errors(const std::string& name, const std::string& format = {}) {
    std::string text = folder_.without(error_of([&] { read_fe_file(folder_ / name, {}, format); }));
    const std::string folder = folder_.path().string();
    const std::size_t at = text.find(folder);
    return at == std::string::npos ? text : text.replace(at, folder.size(), "FOLDER");
  }
  TemporaryFolder folder_;
};

TEST_F(BadFiles, CircularInclude) {
  write("a.inp", "*HEADING\n*INCLUDE, INPUT=b.inp\n");
  write("b.inp", "*NODE\n1, 0.\n*INCLUDE, INPUT=\"c.inp\"\n");
  write("c.inp", "** c\n\n*INCLUDE,\nINPUT=.\\b.inp\n");
  EXPECT_EQ(errors("a.inp"), "c.inp:3: circular include: b.inp -> c.inp -> b.inp");
}

TEST_F(BadFiles, MissingInclude) {
  write("a.inp", "*HEADING\n*INCLUDE, INPUT=mesh/arm.inp\n");
  EXPECT_EQ(errors("a.inp"), "a.inp:2: the include file 'mesh/arm.inp' does not exist in 'FOLDER'");
}

TEST_F(BadFiles, IncludesNestedTooDeeply) {
  for (int k = 0; k < 40; ++k) {
    write(fmt::format("{}.inp", k), fmt::format("*INCLUDE, INPUT={}.inp\n", k + 1));
  }
  EXPECT_EQ(errors("0.inp", "abaqus"),
            "31.inp:1: includes are nested deeper than 32: 0.inp -> ... -> 31.inp -> 32.inp");
}

TEST_F(BadFiles, ErrorInAnIncludedFile) {
  write("a.inp", "*INCLUDE, INPUT=nodes.txt\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n");
  write("nodes.txt", "*NODE\n1, 0., x\n");
  EXPECT_EQ(errors("a.inp"), "nodes.txt:2: coordinate 2 of node 1: 'x' is not a number");
}

TEST_F(BadFiles, GarbageWithTheEndingOfADeck) {
  write("a.inp", std::string("\x7f"
                             "ELF\x02\x01\x01\0\0\0",
                             10));
  EXPECT_EQ(errors("a.inp"), "a.inp: the file is binary, not text: byte 0x00 in line 1");
}

/// Without the list of formats at the end.
std::string before_list(const std::string& text) { return text.substr(0, text.find("known are")); }

TEST_F(BadFiles, UnknownContentAndEnding) {
  write("a.txt", "once upon a time\n");
  EXPECT_EQ(before_list(errors("a.txt")),
            "a.txt: neither the ending nor the content of the file is known; ");
}

TEST_F(BadFiles, UnknownFormatAndMissingFile) {
  write("a.inp", valid);
  EXPECT_EQ(before_list(errors("a.inp", "abacus")),
            "a.inp: there is no format 'abacus', did you mean 'abaqus'?; ");
  EXPECT_EQ(errors("b.inp"), "b.inp: the file does not exist");
  EXPECT_EQ(errors("."), ".: this is a folder, not a file");
  write("empty.inp", "");
  EXPECT_EQ(errors("empty.inp"), "empty.inp: the file is empty");
}

TEST_F(BadFiles, MatricesWithoutTheirCompanions) {
  write("a.sti", matrix_text);
  EXPECT_EQ(errors("a.sti"),
            "a.sti: the mass matrix is missing: there is no 'a.mas' beside it; give the mass "
            "file\na.sti: the map of degrees of freedom is missing: there is no 'a.dof' beside "
            "it; give the dofs file\na.sti: the coordinates of the nodes are missing: there is "
            "no 'a.inp' or 'a.csv' beside it; give the nodes file");
}

}  // namespace
}  // namespace floatframe::test
