// Faulty ANSYS decks: each with the code and place of its error.
#include <gtest/gtest.h>

#include "decks/ansys_deck.hpp"

namespace floatframe::test {
namespace {

const std::string bad_nodes =
    "N,1,0,0,0\nN,2,2,0,0\nN,3,2,1,0\nN,4,0,1,0\nN,5,0,0,1\nN,6,2,0,1\nN,7,2,1,1\nN,8,0,1,1\n";
const std::string bad_solid = "ET,1,185\n" + bad_nodes + "E,1,2,3,4,5,6,7,8\n";

std::string bad_layers(const std::string& layers,
                       const std::string& elements = "E,1,2,3,4,5,6,7,8\n") {
  return "ET,1,190\n" + bad_nodes + elements + cdb_steel + "SECTYPE,1,SHELL\n" + layers;
}
const std::string bad_two_layers =
    "SECDATA,1,1\nSECDATA,1,2\nMP,EX,2,7e4\nMP,PRXY,2,.3\nMP,DENS,2,1\n"
    "LOCAL,11,0,0,0,0,0,0,90\n";
std::string bad_many_layers(int count) {
  std::string text;
  for (int k = 0; k < count; ++k) text += "SECDATA,1,1\n";
  return text;
}

struct BadAnsysDeck {
  std::string text, message;
};

void expect_errors(std::initializer_list<BadAnsysDeck> cases) {
  for (const BadAnsysDeck& c : cases)
    EXPECT_EQ(ansys_error(c.text), "a.cdb:" + c.message) << c.text;
}

TEST(BadAnsys, Commands) {
  expect_errors({
      {"HELLO,1\n", "1: unknown_key"},
      {"/prep7\n*do,i,1,10\n", "2: unsupported"},
      {"LUMPM,MAYBE\n", "1: wrong_value"},
      {"vmesh,all\n", "1: unsupported"},
      {"*if,a,eq,1,then\n", "1: unsupported"},
      {"ET,1,185\nKEYOPT,2,1,1\n", "2: missing"},
      {"ET,1,185\nKEYOPT,1,44,1\n", "2: out_of_range"},
      {"ET,1,BRICK\n", "1: wrong_value"},
      {"ETBLOCK,1,1\n(2i9,19a9)\n        0      185\n", "3: out_of_range"},
      {"ET,0,185\n", "1: missing"},
      {"ET\n", "1: missing"},
      {"R,1,a+b\n", "1: unsupported"},
      {"a='text'\nR,1,a\n", "2: unsupported"},
      {"R,1.5,2\n", "1: not_a_number"},
      {"RMORE,1\n", "1: missing"},
      {"RLBLOCK,1,1,6,7\n(2i8,6g16.9)\n(7g16.9)\n       1      12\n", "4: wrong_count"},
      {"RLBLOCK,1,1,6,7\n(8g16.9)\n(7g16.9)\n", "1: wrong_value"},
      {"RLBLOCK,1,1,6,7\n(2i8,6g16.9)\n(7g16.9)\n       0       6\n", "4: wrong_count"},
      {"SECDATA,1\n", "1: missing"},
      {"SECTYPE,1,SHELL\nSECBLOCK,2\n0.1,1\n/GO\n", "2: wrong_count"},
      {"SECTYPE,1,BEAM,MESH\nSECREAD,a\n", "2: unsupported"},
      {"RBE3,1,all,x\n", "1: unsupported"},
  });
}

TEST(BadAnsys, NodesAndElements) {
  expect_errors({
      {"N,0,1,2,3\n", "1: missing"},
      {"N,1,1\nN,1,2\n", "2: duplicate"},
      {"CSYS,1\nN,1,1\n", "2: unsupported"},
      {"N,R5.3,XYZ,1,0,0,1,2,3\n", "1: wrong_value"},
      {"N,R5.3,ANG,1,0,0,1,2,3\n", "1: not_found"},
      {"NBLOCK,6,SOLID\n", "1: damaged"},
      {"NBLOCK,6,SOLID\n        1        0\n", "2: wrong_value"},
      {"NBLOCK,6,SOLID\n(3i9)\n", "1: missing"},
      {"NBLOCK,6,SOLID\n(3i9,6e21.13e3)\n       1x        0        0\n", "3: not_a_number"},
      {"NBLOCK,6,SOLID\n(1i9,3e20.9e3)\n        1          1.0.0\n", "3: not_a_number"},
      {"NBLOCK,6,SOLID\n(1i9,3e20.9e3)\n       -4          1.0\n", "3: out_of_range"},
      {"NBLOCK,6,SOLID\n(1i3,3e4.1)\n  1 1.0 2.0 3.0 4.0\n", "3: wrong_count"},
      {"EBLOCK,19,SOLID\n(19e9.1)\n", "1: wrong_count"},
      {"EBLOCK,19,SOLID\n(19i2)\n 1 1 1 1 0 0 0 0 8 0 5 1 2 3\n-1\n", "3: wrong_count"},
      {"EBLOCK,19,SOLID\n(19i2)\n 1 1 1 1 0 0 0 0 2 0 5 1 2 3\n-1\n", "3: wrong_count"},
      {"EBLOCK,19,SOLID\n(19i2)\n 1 1 1 1 0 0 0 0 0 0 5 1 2 3\n-1\n", "3: wrong_count"},
      {"EBLOCK,19,SOLID\n(19i2)\n 1 1 1 1 0 0 0 0 1 0 0 1\n-1\n", "3: out_of_range"},
      {bad_solid + cdb_steel + "EN,1,1,2,3,4,5,6,7,8\n", "21: duplicate"},
      {bad_solid + "EMORE,1,2,3,4,5,6,7,8,1,2,3,4,5\n", "11: too_large"},
      {"EMORE,1\n", "1: missing"},
      {"EN,R5.5,NODE,1\n", "1: missing"},
      {"EN,R5.5,WHAT,1\n", "1: wrong_value"},
      {bad_nodes + "E,1,2,3,4,5,6,7,8\n", "9: not_found"},
      {"ET,1,179\n" + bad_nodes + "E,1,2,3\n", "1: unsupported"},
      {"ET,1,42\n" + bad_nodes + "E,1,2,3,4\n", "1: unsupported"},
      {"ET,1,185\n" + bad_nodes + "E,1,2,3,4,5,6,7,9\n", "10: not_found"},
      {"ET,1,185\n" + bad_nodes + "E,1,2,1,4,5,6,7,8\n", "10: missing"},
      {"ET,1,185\n" + bad_nodes + "EN,1,1,2,3,4,5,6,7,8,1\n", "10: wrong_count"},
      {"ET,1,185\nKEYOPT,1,3,1\n" + bad_nodes + "E,1,2,3,4,5,6,7,8\n" + cdb_steel,
       "11: contradiction"},
      {bad_layers("SECDATA,-1,1\n"), "21: out_of_range"},
      {bad_layers("SECDATA,1,1e30\n"), "21: not_a_number"},
      {bad_layers("SECDATA,0,1\n"), "21: missing"},
      {bad_layers("SECDATA,1,1\nSECOFFSET,TOP\n"), "21: unsupported"},
      {bad_layers("SECDATA,1,1\nSECCONTROL,1\n"), "21: unsupported"},
      {bad_layers(bad_many_layers(251)), "21: too_large"},
      {bad_layers(bad_two_layers, "E,1,2,3,4,5,5,5,5\n"), "10: unsupported"},
      {bad_layers(bad_two_layers, "ESYS,11\nE,1,2,3,4,5,6,7,8\n"), "11: geometry"},
      {"ET,1,21\nN,1\nE,1\n", " missing"},
      {bad_solid + cdb_steel + "CMBLOCK,A,NODE,2\n(8i10)\n         1         9\n",
       "21: wrong_value"},
      {bad_solid + cdb_steel + "CMBLOCK,A,ELEM,2\n(8i10)\n        10       -20\n",
       "21: wrong_value"},
      {bad_solid + cdb_steel + "CMBLOCK,A,NODE,2\n(8i10)\n         1       -99\n",
       "21: wrong_value"},
      {bad_solid + cdb_steel + "CMBLOCK,A,NODE,2\n(8i10)\n         5        -3\n",
       "21: wrong_value"},
      {"CMBLOCK,A,NODE,3\n(8i10)\n         1         2\n/GO\n", "1: wrong_count"},
      {"CMBLOCK,,NODE,3\n", "1: missing"},
      {"LOCAL,5,0\n", "1: out_of_range"},
      {"LOCAL,11,7\n", "1: out_of_range"},
      {"LOCAL,R5.0,XX,11,0\n", "1: wrong_value"},
  });
}

TEST(BadAnsys, Materials) {
  expect_errors({
      {bad_solid + "MP,EX,1,1,2\n", "11: unsupported"},
      {bad_solid + "MP,DENS,1,1\n", "11: missing"},
      {bad_solid + "MP,EX,1,1\n", "11: missing"},
      {bad_solid + "MP,EX,1,-1\nMP,PRXY,1,.3\n", "11: out_of_range"},
      {bad_solid + "MP,EX,1,1\nMP,PRXY,1,.5\n", "11: out_of_range"},
      {bad_solid + "MP,EX,1,1\nMP,PRXY,1,.3\nMP,GXY,1,1\n", "11: incomplete"},
      {bad_solid + "MP,EX,1,1\nMP,PRXY,1,.3\nMP,DENS,1,-2\n", "11: out_of_range"},
      {bad_solid + "MPTEMP,1,20,100\nMPDATA,EX,1,1,2e5,1e5\nMPDATA,PRXY,1,1,.3\n",
       "12: wrong_value"},
      {bad_solid + "MPDATA,EX,1,3,2e5\n", "11: wrong_count"},
      {bad_solid + "MP,EX,1,1\nMP,EY,1,1\nMP,PRXY,1,.3\nMP,PRYZ,1,.3\nMP,PRXZ,1,.3\n",
       "11: incomplete"},
      {bad_solid + "MP,EX,2,1\nMP,PRXY,2,.3\n", "10: not_found"},
      {bad_solid + "TB,HYPER,1\n", "11: unsupported"},
      {bad_solid + "TB,ANEL,1\nTBDATA,1,1,2,3\n", "11: wrong_count"},
      {bad_solid + "TB,ANEL,1\nTBDATA,7,1,2,3\n", "12: out_of_range"},
      {bad_solid + "TB,ELASTIC,1,2,2\nTBTEMP,100\nTBDATA,1,1e5,.3\nTBTEMP,20\nTBDATA,1,2e5,.3\n",
       "11: wrong_value"},
      {bad_solid + "TB,ELASTIC,1,2,2\nTBFIELD,FREQ,100\nTBDATA,1,1e5,.3\n", "12: unsupported"},
      {bad_solid + "TB,ELASTIC,1\nTBDATA,1,1,2,3\n", "12: wrong_count"},
      {bad_solid + "MP,EX,1,2e5\nMP,PRXY,1,.3\nTB,ELASTIC,1\nTBDATA,1,1e5,.3\n", "11: exclusive"},
      {bad_solid + "TB,ELASTIC,1\nTBDATA,1,1e5,.3\nTB,DENS,1\nTBDATA,1,2\nMP,DENS,1,3\n",
       "11: exclusive"},
      {bad_solid + "TB,ELASTIC,1\nTBDATA,1,1e5,.3\nMP,NUXY,1,.2\n", "11: exclusive"},
      {bad_solid + "TB,ELASTIC,1\nTBDATA,1,1e5,.3\nMP,EY,1,2e5\n", "11: exclusive"},
  });
}

TEST(BadAnsys, ShellsBeamsAndPoints) {
  const std::string shell = "ET,1,181\n" + bad_nodes + cdb_steel;
  const std::string beam = "ET,1,188\n" + bad_nodes + cdb_steel;
  expect_errors({
      {shell + "E,1,2,3,4\n", "20: missing"},
      {shell + "SECTYPE,1,SHELL\nE,1,2,3,4\n", "20: missing"},
      {shell + "SECTYPE,1,SHELL\nSECDATA,1,1.5\nE,1,2,3,4\n", "20: not_a_number"},
      {shell + "SECTYPE,1,SHELL\nSECDATA,1,-1\nE,1,2,3,4\n", "20: not_a_number"},
      {shell + "SECTYPE,1,SHELL\nSECDATA,-1\nE,1,2,3,4\n", "20: out_of_range"},
      {shell + "SECTYPE,1,SHELL\nSECDATA,1\nSECOFFSET,CENT\nE,1,2,3,4\n", "20: unsupported"},
      {shell + "SECTYPE,1,SHELL\nSECDATA,1\nSECCONTROL,5,5\nE,1,2,3,4\n", "20: unsupported"},
      {shell + "KEYOPT,1,1,1\nR,1,2\nE,1,2,3,4\n", "22: unsupported"},
      {shell + "R,1,2,3,2,2\nE,1,2,3,4\n", "20: contradiction"},
      {shell + "R,1,2\nRMORE,,8\nE,1,2,3,4\n", "20: out_of_range"},
      {beam + "E,1,2\n", "20: not_found"},
      {beam + "SECTYPE,1,BEAM,RECT\nSECDATA,1\nE,1,2\n", "20: out_of_range"},
      {beam + "SECTYPE,1,BEAM,CTUBE\nSECDATA,2,1\nE,1,2\n", "20: out_of_range"},
      {beam + "SECTYPE,1,BEAM,ASEC\nSECDATA,1,1,3,1,0,1\nE,1,2\n", "20: contradiction"},
      {beam + "SECTYPE,1,BEAM,RECT\nSECDATA,1,1\nE,1,1\n", "22: geometry"},
      {beam + "SECTYPE,1,BEAM,RECT\nSECDATA,1,1\nN,9,1\nE,1,2,9\n", "23: geometry"},
      {"ET,1,180\n" + bad_nodes + cdb_steel + "E,1,2\n", "20: missing"},
      {beam + "E,1,2\nE,2,3\nSECNUM,2\nE,3,4\n", "20: not_found\na.cdb:23: not_found"},
      {shell + "R,1,2,3,2,2\nE,1,2,3,4\nE,2,3,4,5\n", "20: contradiction"},
      {"ET,1,4\n" + bad_nodes + cdb_steel + "E,1,2\nE,2,3\nE,3,4\n", "20: not_found"},
      {"ET,1,180\n" + bad_nodes + cdb_steel + "R,1,2,0,1\nE,1,2\n", "21: unsupported"},
      {beam + "SECTYPE,1,BEAM,RECT\nSECDATA,1,1\nSECCONTROL,5\nE,1,2\n", "20: unsupported"},
      {"ET,1,4\n" + bad_nodes + cdb_steel + "E,1,2\n", "20: not_found"},
      {bad_solid + cdb_steel + "ET,2,14\nTYPE,2\nR,1,5\nE,1\n", "24: incomplete"},
      {bad_solid + cdb_steel + "ET,2,14\nTYPE,2\nR,1,-5\nE,1,2\n", "24: out_of_range"},
      {bad_solid + cdb_steel + "ET,2,21\nTYPE,2\nR,1,1,2,1\nE,1\nE,2\n", "23: unsupported"},
      {bad_solid + cdb_steel + "ET,2,21\nKEYOPT,2,3,2\nTYPE,2\nR,1,-5\nE,1\nE,2\n",
       "24: out_of_range"},
      {bad_solid + cdb_steel + "ET,2,21\nTYPE,2\nR,1,1,1,1,0,-2\nE,1\n", "23: out_of_range"},
      {bad_solid + cdb_steel + "ET,2,21\nTYPE,2\nR,1,1,1,1\nRMORE,,5\nE,1\n", "23: unsupported"},
      {bad_solid + cdb_steel + "ET,2,184\nKEYOPT,2,1,6\nTYPE,2\nE,1,2\n", "24: unsupported"},
      {bad_solid + cdb_steel + "CE,1,5,1,UX,1\n", "21: unsupported"},
      {bad_solid + cdb_steel + "CE,1,0,1,TEMP,1\n", "21: wrong_value"},
      {bad_solid + cdb_steel + "CP,1,UX,all\n", "21: unsupported"},
      {bad_solid + cdb_steel + "CERIG,1,99\n", "21: not_found"},
      {bad_solid + cdb_steel + "N,50,9\nET,2,170\nET,3,178\nREAL,4\nTYPE,2\nE,50\nTYPE,3\nE,1,2\n",
       "26: unsupported"},
  });
}

}  // namespace
}  // namespace floatframe::test
