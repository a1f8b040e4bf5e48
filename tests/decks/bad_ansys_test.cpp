// Faulty ANSYS decks: every sentence of the reader, with its line.
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
      {"HELLO,1\n",
       "1: 'HELLO' is not known: whether it changes stiffness or mass is not clear; remove it from "
       "the file if it does not"},
      {"/prep7\n*do,i,1,10\n", "2: *DO: loops are not read: write the model with CDWRITE"},
      {"LUMPM,MAYBE\n", "1: LUMPM: expected ON or OFF, found 'MAYBE'"},
      {"vmesh,all\n", "1: VMESH: geometry is not meshed here: write the mesh with CDWRITE"},
      {"*if,a,eq,1,then\n",
       "1: *IF: branches are not read, but that of CDWRITE over _CDRDOFF; found 'a'"},
      {"ET,1,185\nKEYOPT,2,1,1\n", "2: KEYOPT: there is no type 2 (ET) before"},
      {"ET,1,185\nKEYOPT,1,44,1\n", "2: KEYOPT: option 44, expected 1 to 18"},
      {"ET,1,BRICK\n", "1: ET: expected an element as 185 or SOLID185, found 'BRICK'"},
      {"ETBLOCK,1,1\n(2i9,19a9)\n        0      185\n",
       "3: ETBLOCK: type 0 is element 185, expected numbers of 1 or more"},
      {"ET,0,185\n", "1: ET: the number of the type: '0', expected a number of 1 or more"},
      {"ET\n", "1: ET: the number of the type: the field is empty, expected a number of 1 or more"},
      {"R,1,a+b\n",
       "1: R: the constant: 'a+b' is not a number; expressions and parameters that no *SET gives "
       "as "
       "a number are not read"},
      {"a='text'\nR,1,a\n",
       "2: R: the constant: 'a' is not a number; expressions and parameters that no *SET gives as "
       "a "
       "number are not read"},
      {"R,1.5,2\n", "1: R: the number of the set: '1.5' is not a whole number"},
      {"RMORE,1\n", "1: RMORE: there is no R before"},
      {"RLBLOCK,1,1,6,7\n(2i8,6g16.9)\n(7g16.9)\n       1      12\n",
       "4: RLBLOCK: set 1 has 12 real constants, but 6 are listed"},
      {"RLBLOCK,1,1,6,7\n(8g16.9)\n(7g16.9)\n",
       "1: RLBLOCK: its formats are not two whole numbers with reals, and reals"},
      {"RLBLOCK,1,1,6,7\n(2i8,6g16.9)\n(7g16.9)\n       0       6\n",
       "4: RLBLOCK: set 0 has 6 real constants"},
      {"SECDATA,1\n", "1: SECDATA: there is no SECTYPE before"},
      {"SECTYPE,1,SHELL\nSECBLOCK,2\n0.1,1\n/GO\n",
       "2: SECBLOCK: section 1 has 2 lines in its first line, but 1 are there"},
      {"SECTYPE,1,BEAM,MESH\nSECREAD,a\n",
       "2: SECREAD: sections in files of their own are not read: give their constants, "
       "SECTYPE,n,BEAM,ASEC"},
      {"RBE3,1,all,x\n",
       "1: RBE3: it takes arrays of the session: write the model with CDWRITE, which has it as CE"},
  });
}

TEST(BadAnsys, NodesAndElements) {
  expect_errors({
      {"N,0,1,2,3\n", "1: N: the number of the node: '0', expected a number of 1 or more"},
      {"N,1,1\nN,1,2\n", "2: node 1 is in the file twice, first in line 1"},
      {"CSYS,1\nN,1,1\n",
       "2: N: the node is in coordinate system 1 (CSYS), only nodes in global rectangular "
       "coordinates are read"},
      {"N,R5.3,XYZ,1,0,0,1,2,3\n", "1: N: expected LOC or ANG, found 'XYZ'"},
      {"N,R5.3,ANG,1,0,0,1,2,3\n", "1: N: angles of node 1, which is not in the file before"},
      {"NBLOCK,6,SOLID\n", "1: the file ends where the format of NBLOCK is expected"},
      {"NBLOCK,6,SOLID\n        1        0\n",
       "2: NBLOCK: a format like (3i9,6e21.13e3) is expected, found '1        0'"},
      {"NBLOCK,6,SOLID\n(3i9)\n",
       "1: NBLOCK: its format has no column for the number of the node or not three for its "
       "coordinates"},
      {"NBLOCK,6,SOLID\n(3i9,6e21.13e3)\n       1x        0        0\n",
       "3: NBLOCK: the number of the node: '1x' is not a whole number"},
      {"NBLOCK,6,SOLID\n(1i9,3e20.9e3)\n        1          1.0.0\n",
       "3: NBLOCK: the coordinate: '1.0.0' is not a number"},
      {"NBLOCK,6,SOLID\n(1i9,3e20.9e3)\n       -4          1.0\n",
       "3: a node has the number -4, expected is 1 or more"},
      {"NBLOCK,6,SOLID\n(1i3,3e4.1)\n  1 1.0 2.0 3.0 4.0\n",
       "3: NBLOCK: the line is longer than its format, which has 4 columns"},
      {"EBLOCK,19,SOLID\n(19e9.1)\n",
       "1: EBLOCK: its format has 0 columns of whole numbers, expected more than 11"},
      {"EBLOCK,19,SOLID\n(19i2)\n 1 1 1 1 0 0 0 0 8 0 5 1 2 3\n-1\n",
       "3: element 5 has 8 nodes in its first line, but 3 are listed"},
      {"EBLOCK,19,SOLID\n(19i2)\n 1 1 1 1 0 0 0 0 2 0 5 1 2 3\n-1\n",
       "3: element 5 has 2 nodes in its first line, but 3 are listed"},
      {"EBLOCK,19,SOLID\n(19i2)\n 1 1 1 1 0 0 0 0 0 0 5 1 2 3\n-1\n",
       "3: element 5 has 0 nodes, expected 1 to 20"},
      {"EBLOCK,19,SOLID\n(19i2)\n 1 1 1 1 0 0 0 0 1 0 0 1\n-1\n",
       "3: an element has the number 0, expected is 1 or more"},
      {bad_solid + cdb_steel + "EN,1,1,2,3,4,5,6,7,8\n",
       "21: element 1 is in the file twice, first in line 10"},
      {bad_solid + "EMORE,1,2,3,4,5,6,7,8,1,2,3,4,5\n",
       "11: element 1 has more than 20 nodes, which no element has"},
      {"EMORE,1\n", "1: EMORE: there is no element before"},
      {"EN,R5.5,NODE,1\n", "1: EN: nodes, but no line ATTR before them"},
      {"EN,R5.5,WHAT,1\n", "1: EN: expected ATTR or NODE, found 'WHAT'"},
      {bad_nodes + "E,1,2,3,4,5,6,7,8\n", "9: element 1 is of type 1, which no ET gives"},
      {"ET,1,179\n" + bad_nodes + "E,1,2,3\n",
       "1: type 1 is PRETS179: the mesh is cut there, and what holds it together is the preload of "
       "an analysis; write the mesh without the cut"},
      {"ET,1,42\n" + bad_nodes + "E,1,2,3,4\n",
       "1: type 1 is element 42, which is not read; read are SOLID45, 92, 95, 185, 186, 187, 285, "
       "SOLSH190, SHELL63, 93, 181, 281, BEAM4, 188, 189, PIPE288, 289, LINK8, 180, COMBIN14, "
       "MATRIX27, MASS21 and MPC184"},
      {"ET,1,185\n" + bad_nodes + "E,1,2,3,4,5,6,7,9\n",
       "10: element 1 (SOLID185) has node 9, which is not in the file"},
      {"ET,1,185\n" + bad_nodes + "E,1,2,1,4,5,6,7,8\n",
       "10: element 1 (SOLID185): its nodes are repeated or missing in a way that makes no "
       "element"},
      {"ET,1,185\n" + bad_nodes + "EN,1,1,2,3,4,5,6,7,8,1\n",
       "10: element 1 (SOLID185): it has 9 nodes, at most 8 are expected"},
      {"ET,1,185\nKEYOPT,1,3,1\n" + bad_nodes + "E,1,2,3,4,5,6,7,8\n" + cdb_steel,
       "11: element 1 (SOLID185): it has layers (KEYOPT(3) = 1), but its section 1 is no "
       "SECTYPE,1,SHELL"},
      {bad_layers("SECDATA,-1,1\n"), "21: section 1: a layer is -1 thick, expected more than 0"},
      {bad_layers("SECDATA,1,1e30\n"),
       "21: section 1: a layer is of material 1e+30, which is no number of a material"},
      {bad_layers("SECDATA,0,1\n"), "21: section 1 has no layer with a thickness (SECDATA)"},
      {bad_layers("SECDATA,1,1\nSECOFFSET,TOP\n"),
       "21: section 1: SECOFFSET,TOP of layers of solids is not read: they fill their element"},
      {bad_layers("SECDATA,1,1\nSECCONTROL,1\n"),
       "21: section 1: SECCONTROL of layers of solids is not read"},
      {bad_layers(bad_many_layers(251)),
       "21: section 1 has 251 layers, expected at most 250 in a solid"},
      {bad_layers(bad_two_layers, "E,1,2,3,4,5,5,5,5\n"),
       "10: element 1 (SOLSH190): its layers are those of a pyramid or tetrahedron, expected a "
       "brick or a wedge"},
      {bad_layers(bad_two_layers, "ESYS,11\nE,1,2,3,4,5,6,7,8\n"),
       "11: element 1 (SOLSH190): the x axis of its coordinate system 11 is nearer to the normal "
       "of its layers than 45 degrees"},
      {"ET,1,21\nN,1\nE,1\n",
       " the file has 1 elements and none of them is a solid, a shell, a beam, a rod or a spring"},
      {bad_solid + cdb_steel + "CMBLOCK,A,NODE,2\n(8i10)\n         1         9\n",
       "21: component A has node 9, which is not in the file"},
      {bad_solid + cdb_steel + "CMBLOCK,A,ELEM,2\n(8i10)\n        10       -20\n",
       "21: component A has elements 10 to 20, of which element 10 is not in the file"},
      {bad_solid + cdb_steel + "CMBLOCK,A,NODE,2\n(8i10)\n         1       -99\n",
       "21: component A has nodes 1 to 99, of which node 99 is not in the file"},
      {bad_solid + cdb_steel + "CMBLOCK,A,NODE,2\n(8i10)\n         5        -3\n",
       "21: component A has nodes 5 to 3, expected numbers that rise"},
      {"CMBLOCK,A,NODE,3\n(8i10)\n         1         2\n/GO\n",
       "1: CMBLOCK: component A has 3 members in its first line, but 2 are listed"},
      {"CMBLOCK,,NODE,3\n", "1: CMBLOCK: the name of the component is missing"},
      {"LOCAL,5,0\n", "1: LOCAL: coordinate system 5, expected a number of 11 or more"},
      {"LOCAL,11,7\n", "1: LOCAL: coordinate system 11 is of kind 7, expected 0 to 3"},
      {"LOCAL,R5.0,XX,11,0\n", "1: LOCAL: expected LOC, ANG or PRM, found 'XX'"},
  });
}

TEST(BadAnsys, Materials) {
  expect_errors({
      {bad_solid + "MP,EX,1,1,2\n",
       "11: MP: EX depends on the temperature, only constants are read"},
      {bad_solid + "MP,DENS,1,1\n", "11: material 1: it has no EX"},
      {bad_solid + "MP,EX,1,1\n", "11: material 1: it has no PRXY"},
      {bad_solid + "MP,EX,1,-1\nMP,PRXY,1,.3\n", "11: material 1: EX is -1, expected more than 0"},
      {bad_solid + "MP,EX,1,1\nMP,PRXY,1,.5\n",
       "11: material 1: PRXY is 0.5, expected more than -1 and less than 0.5"},
      {bad_solid + "MP,EX,1,1\nMP,PRXY,1,.3\nMP,GXY,1,1\n",
       "11: material 1: GXY is 1, but EX and PRXY give 0.384615: an orthotropic material needs EY "
       "and EZ"},
      {bad_solid + "MP,EX,1,1\nMP,PRXY,1,.3\nMP,DENS,1,-2\n",
       "11: material 1: DENS is -2, no negative density is expected"},
      {bad_solid + "MPTEMP,1,20,100\nMPDATA,EX,1,1,2e5,1e5\nMPDATA,PRXY,1,1,.3\n",
       "12: material 1: its EX depends on the temperature (20 to 100): say at which one "
       "with --temperature (key `temperature`)"},
      {bad_solid + "MPDATA,EX,1,3,2e5\n", "11: MPDATA: EX begins at place 3, but 0 are there"},
      {bad_solid + "MP,EX,1,1\nMP,EY,1,1\nMP,PRXY,1,.3\nMP,PRYZ,1,.3\nMP,PRXZ,1,.3\n",
       "11: material 1: it has EY or EZ, and no GXY"},
      {bad_solid + "MP,EX,2,1\nMP,PRXY,2,.3\n",
       "10: element 1 (SOLID185): it has material 1, which is not in the file"},
      {bad_solid + "TB,HYPER,1\n",
       "11: TB,HYPER: this table is not read; a part needs EX and PRXY, EX to GXZ, or TB,ANEL"},
      {bad_solid + "TB,ANEL,1\nTBDATA,1,1,2,3\n",
       "11: material 1: TB,ANEL has 3 constants, expected 21"},
      {bad_solid + "TB,ANEL,1\nTBDATA,7,1,2,3\n",
       "12: TB,ANEL: constants from place 7, expected from 1"},
      {bad_solid + "TB,ELASTIC,1,2,2\nTBTEMP,100\nTBDATA,1,1e5,.3\nTBTEMP,20\nTBDATA,1,2e5,.3\n",
       "11: material 1: its EX depends on the temperature (20 to 100): say at which one with "
       "--temperature (key `temperature`)"},
      {bad_solid + "TB,ELASTIC,1,2,2\nTBFIELD,FREQ,100\nTBDATA,1,1e5,.3\n",
       "12: TBFIELD: TB,ELAS of material 1 depends on 'FREQ', only temperatures (TEMP) are read"},
      {bad_solid + "TB,ELASTIC,1\nTBDATA,1,1,2,3\n",
       "12: TB,ELASTIC: 3 constants in a line, expected 2 of an isotropic material"},
      {bad_solid + "MP,EX,1,2e5\nMP,PRXY,1,.3\nTB,ELASTIC,1\nTBDATA,1,1e5,.3\n",
       "11: material 1: EX is 200000 by MP and EX is 100000 by TB,ELASTIC, leave one of the two in "
       "the file"},
      {bad_solid + "TB,ELASTIC,1\nTBDATA,1,1e5,.3\nTB,DENS,1\nTBDATA,1,2\nMP,DENS,1,3\n",
       "11: material 1: DENS is 3 by MP and DENS is 2 by TB,DENS, leave one of the two in the "
       "file"},
      {bad_solid + "TB,ELASTIC,1\nTBDATA,1,1e5,.3\nMP,NUXY,1,.2\n",
       "11: material 1: NUXY is 0.2 by MP and PRXY is 0.3 by TB,ELASTIC, leave one of the two in "
       "the file"},
      {bad_solid + "TB,ELASTIC,1\nTBDATA,1,1e5,.3\nMP,EY,1,2e5\n",
       "11: material 1: EY by MP stands beside TB,ELASTIC, which is isotropic, leave one of the "
       "two in the file"},
  });
}

TEST(BadAnsys, ShellsBeamsAndPoints) {
  const std::string shell = "ET,1,181\n" + bad_nodes + cdb_steel;
  const std::string beam = "ET,1,188\n" + bad_nodes + cdb_steel;
  expect_errors({
      {shell + "E,1,2,3,4\n",
       "20: element 1 (SHELL181): its section 1 is no SECTYPE,1,SHELL, and its real constants give "
       "no thickness"},
      {shell + "SECTYPE,1,SHELL\nE,1,2,3,4\n",
       "20: section 1 has no layer with a thickness (SECDATA)"},
      {shell + "SECTYPE,1,SHELL\nSECDATA,1,1.5\nE,1,2,3,4\n",
       "20: section 1: a layer is of material 1.5, which is no number of a material"},
      {shell + "SECTYPE,1,SHELL\nSECDATA,1,-1\nE,1,2,3,4\n",
       "20: section 1: a layer is of material -1, which is no number of a material"},
      {shell + "SECTYPE,1,SHELL\nSECDATA,-1\nE,1,2,3,4\n",
       "20: section 1: a layer is -1 thick, expected more than 0"},
      {shell + "SECTYPE,1,SHELL\nSECDATA,1\nSECOFFSET,CENT\nE,1,2,3,4\n",
       "20: section 1: SECOFFSET,CENT is not read, expected MID, TOP, BOT or USER"},
      {shell + "SECTYPE,1,SHELL\nSECDATA,1\nSECCONTROL,5,5\nE,1,2,3,4\n",
       "20: section 1: a transverse shear stiffness of its own (SECCONTROL) is not read"},
      {shell + "KEYOPT,1,1,1\nR,1,2\nE,1,2,3,4\n",
       "22: element 1 (SHELL181): KEYOPT(1) = 1: only shells with bending and membrane stiffness "
       "are read"},
      {shell + "R,1,2,3,2,2\nE,1,2,3,4\n",
       "20: real constants 1: the thickness is 2 at one corner and 3 at another, expected one"},
      {shell + "R,1,2\nRMORE,,8\nE,1,2,3,4\n", "20: real constants 1: constant 8 is 8, expected 0"},
      {beam + "E,1,2\n", "20: element 1 (BEAM188): its section 1 is no SECTYPE,1,BEAM"},
      {beam + "SECTYPE,1,BEAM,RECT\nSECDATA,1\nE,1,2\n",
       "20: section 1 (RECT): its sides are expected to be more than 0"},
      {beam + "SECTYPE,1,BEAM,CTUBE\nSECDATA,2,1\nE,1,2\n",
       "20: section 1 (CTUBE): expected an inner radius above 0 and a larger outer one"},
      {beam + "SECTYPE,1,BEAM,ASEC\nSECDATA,1,1,3,1,0,1\nE,1,2\n",
       "20: section 1 (ASEC): Iyz is larger than Iyy and Izz allow"},
      {beam + "SECTYPE,1,BEAM,RECT\nSECDATA,1,1\nE,1,1\n",
       "22: element 1 (BEAM188): its ends are at one place"},
      {beam + "SECTYPE,1,BEAM,RECT\nSECDATA,1,1\nN,9,1\nE,1,2,9\n",
       "23: element 1 (BEAM188): its node for the orientation is on its axis"},
      {"ET,1,180\n" + bad_nodes + cdb_steel + "E,1,2\n",
       "20: element 1 (LINK180): neither its section 1 (SECTYPE,1,LINK) nor its real constants 1 "
       "give an area above 0"},
      {beam + "E,1,2\nE,2,3\nSECNUM,2\nE,3,4\n",
       "20: element 1 (BEAM188): its section 1 is no SECTYPE,1,BEAM; the same holds for 1 other "
       "element\na.cdb:23: element 3 (BEAM188): its section 2 is no SECTYPE,2,BEAM"},
      {shell + "R,1,2,3,2,2\nE,1,2,3,4\nE,2,3,4,5\n",
       "20: real constants 1: the thickness is 2 at one corner and 3 at another, expected one"},
      {"ET,1,4\n" + bad_nodes + cdb_steel + "E,1,2\nE,2,3\nE,3,4\n",
       "20: element 1 (BEAM4): its real constants 1 are not in the file; the same holds for 2 "
       "other "
       "elements"},
      {"ET,1,180\n" + bad_nodes + cdb_steel + "R,1,2,0,1\nE,1,2\n",
       "21: element 1 (LINK180): it is for tension or compression alone (TENSKEY), which is not "
       "linear"},
      {beam + "SECTYPE,1,BEAM,RECT\nSECDATA,1,1\nSECCONTROL,5\nE,1,2\n",
       "20: section 1 (RECT): a transverse shear stiffness of its own (SECCONTROL) is not read"},
      {"ET,1,4\n" + bad_nodes + cdb_steel + "E,1,2\n",
       "20: element 1 (BEAM4): its real constants 1 are not in the file"},
      {bad_solid + cdb_steel + "ET,2,14\nTYPE,2\nR,1,5\nE,1\n",
       "24: element 2 (COMBIN14): it has one node, and no direction (KEYOPT(2))"},
      {bad_solid + cdb_steel + "ET,2,14\nTYPE,2\nR,1,-5\nE,1,2\n",
       "24: element 2 (COMBIN14): its stiffness is -5, expected none below 0"},
      {bad_solid + cdb_steel + "ET,2,21\nTYPE,2\nR,1,1,2,1\nE,1\nE,2\n",
       "23: real constants 1: masses of 1, 2 and 1 in the three directions; a part has one"},
      {bad_solid + cdb_steel + "ET,2,21\nKEYOPT,2,3,2\nTYPE,2\nR,1,-5\nE,1\nE,2\n",
       "24: real constants 1: a mass of -5 for element 2 (MASS21), expected none below 0"},
      {bad_solid + cdb_steel + "ET,2,21\nTYPE,2\nR,1,1,1,1,0,-2\nE,1\n",
       "23: real constants 1: a moment of inertia of -2 for element 2 (MASS21), expected none "
       "below "
       "0"},
      {bad_solid + cdb_steel + "ET,2,21\nTYPE,2\nR,1,1,1,1\nRMORE,,5\nE,1\n",
       "23: real constants 1: a mass beside its node (constant 8 is 5) is not read; give it a node "
       "of its own"},
      {bad_solid + cdb_steel + "ET,2,184\nKEYOPT,2,1,6\nTYPE,2\nE,1,2\n",
       "24: element 2 (MPC184): KEYOPT(1) = 6: joints are not read, they are joints of the model; "
       "rigid links (0) and beams (1) are"},
      {bad_solid + cdb_steel + "CE,1,5,1,UX,1\n",
       "21: CE 1: its constant is 5, only equations that sum to 0 are read"},
      {bad_solid + cdb_steel + "CE,1,0,1,TEMP,1\n",
       "21: CE: expected a degree of freedom UX to ROTZ, found 'TEMP'"},
      {bad_solid + cdb_steel + "CP,1,UX,all\n",
       "21: CP: 'all' needs the selection or component of the session, only numbers of nodes are "
       "read; write the model with CDWRITE"},
      {bad_solid + cdb_steel + "CERIG,1,99\n", "21: CERIG has node 99, which is not in the file"},
      {bad_solid + cdb_steel + "N,50,9\nET,2,170\nET,3,178\nREAL,4\nTYPE,2\nE,50\nTYPE,3\nE,1,2\n",
       "26: the remote point of real constants 4: CONTA178 with KEYOPT(2) = 0, KEYOPT(4) = 0, "
       "KEYOPT(12) = 0 is not read; multipoint constraints (2) that are always bonded (5, 6), "
       "rigid "
       "or spreading forces, are"},
  });
}

}  // namespace
}  // namespace floatframe::test
