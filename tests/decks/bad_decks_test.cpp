// Invalid decks and matrices, each with the code and place of its error.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "decks/deck_text.hpp"
#include "floatframe/formats/matrices/matrix_model.hpp"
#include "floatframe/formats/matrices/read_matrices.hpp"
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
     "bad.inp:4: wrong_count"},
    {"too_few_nodes", "7: 1, 1, 2, 3", "bad.inp:7: wrong_count"},
    {"missing_node_of_element", "5:", "bad.inp:6: not_found"},
    {"missing_node_of_set", "+*NSET, NSET=HOLE\n1, 2, 17\n", "bad.inp:15: not_found"},
    {"missing_set", "+*NSET, NSET=HOLE\n1, 2\n*BOUNDARY\nHOLES, 1, 3\n", "bad.inp:17: not_found"},
    {"unknown_type", "6: *ELEMENT, TYPE=C3D27, ELSET=BODY", "bad.inp:6: unsupported"},
    {"plane_type_with_section", "6: *ELEMENT, TYPE=CPS4, ELSET=BODY", "bad.inp:13: wrong_value"},
    {"solid_section_of_beam",
     "+*ELEMENT, TYPE=B31, ELSET=ROD\n2, 1, 2\n*SOLID SECTION, ELSET=ROD, MATERIAL=STEEL\n",
     "bad.inp:16: wrong_value"},
    {"node_twice", "5: 4, 0., 0., 1.\n2, 1., 0., 1.", "bad.inp:6: duplicate"},
    {"element_twice", "7: 1, 1, 2, 3, 4\n1, 1, 2, 3, 4", "bad.inp:8: duplicate"},
    {"material_twice", "+*MATERIAL, NAME=Steel\n", "bad.inp:14: duplicate"},
    {"missing_material", "8: *MATERIAL, NAME=STEAL", "bad.inp:13: not_found"},
    {"missing_elasticity", "9: *EXPANSION", "bad.inp:8: missing"},
    {"orthotropic", "9: *ELASTIC, TYPE=ENGINEERING CONSTANTS", "bad.inp:9: missing"},
    {"poisson", "10: 210000., 0.5", "bad.inp:9: out_of_range"},
    {"temperature_dependent", "10: 210000., 0.3, 20.\n190000., 0.3, 300.", "bad.inp:9: incomplete"},
    {"descending_temperatures", "10: 210000., 0.3, 300.\n190000., 0.3, 20.",
     "bad.inp:9: incomplete"},
    {"fields", "9: *ELASTIC, DEPENDENCIES=1", "bad.inp:9: unsupported"},
    {"no_section", "13:", "bad.inp:7: missing"},
    {"shell_without_section",
     "+*ELEMENT, TYPE=S3, ELSET=SHELLS\n2, 1, 2, 3\n*SHELL SECTION, ELSET=SHELLS, MATERIAL=STEEL\n"
     "0.1\n*ELEMENT, TYPE=S3\n3, 2, 3, 4\n",
     "bad.inp:19: missing"},
    {"two_sections", "+*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL\n", "bad.inp:14: wrong_value"},
    {"section_of_missing_set", "13: *SOLID SECTION, ELSET=BODDY, MATERIAL=STEEL",
     "bad.inp:13: not_found"},
    {"orientation", "13: *SOLID SECTION, ELSET=BODY, MATERIAL=STEEL, ORIENTATION=OR1",
     "bad.inp:13: not_found"},
    {"utf16", "=\xff\xfe*\x01N\x01", "bad.inp: unreadable"},
    {"control_bytes", "=*NODE\n\x01\x02\x03\x04\x05\x06\n", "bad.inp: unreadable"},
    {"words_first", "=solid part\n*NODE\n1\n", "bad.inp:1: wrong_value"},
    {"no_nodes", "=*HEADING\nnothing\n", "bad.inp: missing"},
    {"empty_set", "+*NSET, NSET=HOLE\n*NSET, NSET=OTHER\n1\n", "bad.inp:14: missing"},
    {"set_in_itself", "+*NSET, NSET=A\n1, B\n*NSET, NSET=B\nA\n", "bad.inp:17: cycle"},
    {"generate", "+*NSET, NSET=A, GENERATE\n9, 3\n", "bad.inp:15: out_of_range"},
    {"coordinate", "4: 3, 0., 1.O, 0.", "bad.inp:4: not_a_number"},
    {"too_large", "4: 3, 0., 1e999, 0.", "bad.inp:4: not_a_number"},
    {"not_a_number", "10: nan, 0.3", "bad.inp:10: not_a_number"},
    {"node_number", "4: 3.5, 0., 1., 0.", "bad.inp:4: not_a_number"},
    {"equation_cut_off", "+*EQUATION\n3\n1, 1, 1., 2, 1, -1.\n", "bad.inp:15: wrong_count"},
    {"tie", "+*TIE, NAME=T\nA, B\n", "bad.inp:15: not_found\nbad.inp:15: not_found"},
    {"spring", "+*SPRING, ELSET=S\n\n100.\n", "bad.inp:14: not_found"},
    {"connector", "+*CONNECTOR SECTION, ELSET=S\nHINGE\n", "bad.inp:14: unsupported"},
    {"transform", "+*TRANSFORM, NSET=A\n1., 0., 0., 0., 1., 0.\n", "bad.inp:14: not_found"},
    {"mistyped_keyword", "13: *SOLD SECTION, ELSET=BODY, MATERIAL=STEEL",
     "bad.inp:13: unknown_key"},
    {"second_part", "=*PART, NAME=A\n*END PART\n*PART, NAME=B\n*END PART\n", "bad.inp:3: missing"},
    {"mass_without_value", "+*ELEMENT, TYPE=MASS, ELSET=M\n9, 1\n", "bad.inp:15: missing"},
    {"face_that_is_not_there", "+*SURFACE, NAME=S\nBODY, S5\n", "bad.inp:15: not_found"},
    {"missing_surface",
     "+*SURFACE, NAME=BORE\nBODY, S1\n*COUPLING, REF NODE=4, SURFACE=BOER\n*KINEMATIC\n",
     "bad.inp:16: not_found"},
    {"missing_parameter", "+*RIGID BODY, NSET=BODY\n", "bad.inp:14: incomplete"},
    {"reference_of_several", "+*NSET, NSET=R\n1, 2\n*RIGID BODY, NSET=R, REF NODE=R\n",
     "bad.inp:16: wrong_count"},
    {"pipe",
     "+*ELEMENT, TYPE=B31, ELSET=ROD\n2, 1, 2\n"
     "*BEAM SECTION, ELSET=ROD, MATERIAL=STEEL, SECTION=PIPE\n1., 2.\n",
     "bad.inp:17: geometry"},
    {"include_in_memory", "+*INCLUDE, INPUT=other.inp\n", "bad.inp:14: unreadable"},
};

class BadDecks : public testing::TestWithParam<Case> {};

TEST_P(BadDecks, GiveErrors) {
  EXPECT_EQ(inp_error(deck_of(GetParam().text), {}, "bad.inp"), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Abaqus, BadDecks, testing::ValuesIn(decks), name_of);

TEST(BadDecks, SoundDeckIsSound) { EXPECT_EQ(inp_error(valid), "no error"); }

// Two nodes with three degrees of freedom; "K" or "M" as lines "row column value".
const std::string map_text = "1.1\n1.2\n2.1\n";
const std::string matrix_text = "1 1 2.\n1 2 -1.\n2 2 2.\n2 3 -1.\n3 3 2.\n";

const Case calculix[] = {
    {"row_too_large", "1 1 2.\n2 2 2.\n3 3 2.\n3 4 1.\n", "bad.sti:4: out_of_range"},
    {"line_cut_off", "1 1 2.\n1 2 -1.\n2 2\n", "bad.sti:3: wrong_count"},
    {"file_cut_off", "1 1 2.\n1 2 -1.\n", "bad.sti:2: damaged"},
    {"negative_diagonal", "1 1 2.\n2 2 -2.\n3 3 2.\n", "bad.sti:2: out_of_range"},
    {"entry_twice", "1 1 2.\n1 2 -1.\n1 2 -1.\n2 2 2.\n3 3 2.\n", "bad.sti:3: duplicate"},
    {"not_symmetric", "1 1 2.\n1 2 -1.\n2 1 -1.5\n2 2 2.\n3 3 2.\n", "bad.sti:3: contradiction"},
    {"value", "1 1 2.\n1 2 -1.e\n2 2 2.\n3 3 2.\n", "bad.sti:2: not_a_number"},
    {"penalty", "1 1 1e36\n2 2 2.\n3 3 2.\n", "bad.sti:1: unsupported"},
    {"empty", "\n", "bad.sti: missing"},
};

class BadCalculix : public testing::TestWithParam<Case> {};

TEST_P(BadCalculix, GiveErrors) {
  EXPECT_EQ(error_of([] {
              TextSource nodes("1,0,0,0\n2,1,0,0\n", "nodes.csv"), K(GetParam().text, "bad.sti"),
                  M(matrix_text, "bad.mas"), dofs(map_text, "bad.dof");
              read_calculix_matrices(K, M, dofs, read_node_table(nodes));
            }),
            GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Matrices, BadCalculix, testing::ValuesIn(calculix), name_of);

const Case maps[] = {
    {"direction", "1.1\n1.7\n2.1\n", "bad.dof:2: wrong_value"},
    {"node_not_there", "1.1\n1.2\n5.1\n", "bad.dof:3: not_found"},
    {"dof_twice", "1.1\n1.2\n1.1\n", "bad.dof:3: unsupported"},
    {"too_short", "1.1\n1.2\n", "bad.sti:4: out_of_range\nbad.sti:5: out_of_range"},
};

class BadMaps : public testing::TestWithParam<Case> {};

TEST_P(BadMaps, GiveErrors) {
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
     "bad_K.mtx:1: wrong_value"},
    {"wrong_count",
     "%%MatrixMarket matrix coordinate real symmetric\n3 3 4\n1 1 2.\n2 2 2.\n3 3 2.\n",
     "bad_K.mtx:2: wrong_count"},
    {"wrong_size", "%%MatrixMarket matrix coordinate real symmetric\n4 4 1\n1 1 2.\n",
     "bad_K.mtx:2: wrong_count"},
    {"entries_without_end",
     "%%MatrixMarket matrix coordinate real symmetric\n3 3 1000000000000\n1 1 2.\n",
     "bad_K.mtx:2: wrong_count"},
    {"no_banner", "3 3 1\n1 1 2.\n", "bad_K.mtx:1: wrong_file"},
};

class BadMarket : public testing::TestWithParam<Case> {};

TEST_P(BadMarket, GiveErrors) {
  EXPECT_EQ(error_of([] {
              TextSource nodes("1,0,0,0\n2,1,0,0\n", "nodes.csv"), K(GetParam().text, "bad_K.mtx"),
                  M("", "bad_M.mtx"), dofs(map_text, "bad_dofs.csv");
              read_matrix_market(K, M, dofs, read_node_table(nodes));
            }),
            GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Matrices, BadMarket, testing::ValuesIn(market), name_of);

const Case labels[] = {
    {"internal_node", "1,1, 1,1, 2.\n-4,1, 1,1, 1.\n", "bad_STIF1.mtx:2: unsupported"},
    {"four_fields", "1,1, 1,1, 2.\n1,1, 1,2\n", "bad_STIF1.mtx:2: wrong_count"},
    {"temperature", "1,1, 1,1, 2.\n1,11, 1,11, 2.\n", "bad_STIF1.mtx:2: out_of_range"},
    {"mass_only", "1,1, 1,1, 2.\n", "bad_MASS1.mtx:1: not_found"},
};

class BadLabels : public testing::TestWithParam<Case> {};

TEST_P(BadLabels, GiveErrors) {
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
  EXPECT_EQ(errors("a.inp"), "c.inp:3: cycle");
}

TEST_F(BadFiles, MissingInclude) {
  write("a.inp", "*HEADING\n*INCLUDE, INPUT=mesh/arm.inp\n");
  EXPECT_EQ(errors("a.inp"), "a.inp:2: not_found");
}

TEST_F(BadFiles, IncludesNestedTooDeeply) {
  for (int k = 0; k < 40; ++k) {
    write(fmt::format("{}.inp", k), fmt::format("*INCLUDE, INPUT={}.inp\n", k + 1));
  }
  EXPECT_EQ(errors("0.inp", "abaqus"), "31.inp:1: too_large");
}

TEST_F(BadFiles, ErrorInAnIncludedFile) {
  write("a.inp", "*INCLUDE, INPUT=nodes.txt\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n");
  write("nodes.txt", "*NODE\n1, 0., x\n");
  EXPECT_EQ(errors("a.inp"), "nodes.txt:2: not_a_number");
}

TEST_F(BadFiles, GarbageWithTheEndingOfADeck) {
  write("a.inp", std::string("\x7f"
                             "ELF\x02\x01\x01\0\0\0",
                             10));
  EXPECT_EQ(errors("a.inp"), "a.inp: unreadable");
}

/// Without the list of formats at the end.
std::string before_list(const std::string& text) { return text.substr(0, text.find("known are")); }

TEST_F(BadFiles, UnknownContentAndEnding) {
  write("a.txt", "once upon a time\n");
  EXPECT_EQ(before_list(errors("a.txt")), "a.txt: wrong_file");
}

TEST_F(BadFiles, UnknownFormatAndMissingFile) {
  write("a.inp", valid);
  EXPECT_EQ(before_list(errors("a.inp", "abacus")), "a.inp: not_found");
  EXPECT_EQ(errors("b.inp"), "b.inp: unreadable");
  EXPECT_EQ(errors("."), ".: unreadable");
  write("empty.inp", "");
  EXPECT_EQ(errors("empty.inp"), "empty.inp: missing");
}

TEST_F(BadFiles, MatricesWithoutCompanionFiles) {
  write("a.sti", matrix_text);
  EXPECT_EQ(errors("a.sti"), "a.sti: missing\na.sti: missing\na.sti: missing");
}

}  // namespace
}  // namespace floatframe::test
