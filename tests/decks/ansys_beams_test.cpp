// ANSYS decks: shapes of beam sections against integrals along their outlines, and where the nodes
// lie in them.
#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "decks/ansys_deck.hpp"
#include "decks/section_outline.hpp"
#include "floatframe/fe/plate_section.hpp"

namespace floatframe::test {
namespace {

/// A beam of 1000 along x: y of the section is global y, z global z.
FeModel beam_of(const std::string& shape, const std::string& data, const std::string& more = "") {
  return ansys_of("ET,1,188\nN,1,0,0,0\nN,2,1000,0,0\n" + cdb_steel + "SECTYPE,        1,BEAM," +
                  shape + ",sec     ,    0\n" + more + "SECDATA," + data + "\nEN,1,1,2\n");
}

struct ShapeCase {
  const char *shape, *data;
  std::vector<SectionOutline> outlines;
};

const std::vector<ShapeCase>& shape_cases() {
  static const std::vector<ShapeCase> cases = {
      {"I", "80,60,110,10,20,5,0,0,0,0,0,0",
       mirrored({{40, 0}, {40, 10}, {2.5, 10}, {2.5, 90}, {30, 90}, {30, 110}})},
      {"CHAN",
       "60,40,100,10,8,6",
       {{{0, 0}, {60, 0}, {60, 10}, {6, 10}, {6, 92}, {40, 92}, {40, 100}, {0, 100}}}},
      {"L", "60,80,10,6", {{{0, 0}, {60, 0}, {60, 10}, {6, 10}, {6, 80}, {0, 80}}}},
      {"T",
       "60,80,10,6",
       {{{-30, 0}, {30, 0}, {30, 10}, {3, 10}, {3, 80}, {-3, 80}, {-3, 10}, {-30, 10}}}},
      {"Z",
       "60,40,100,10,8,6",
       {{{0, 0}, {60, 0}, {60, 10}, {6, 10}, {6, 100}, {-34, 100}, {-34, 92}, {0, 92}}}},
      {"HREC",
       "60,80,6,5,4,3",
       {{{0, 0}, {60, 0}, {60, 80}, {0, 80}}, {{6, 4}, {6, 77}, {55, 77}, {55, 4}}}},
      {"HATS",
       "20,30,50,60,4,5,6,7,8",
       {{{-20, 0},
         {7, 0},
         {7, 54},
         {42, 54},
         {42, 0},
         {80, 0},
         {80, 5},
         {50, 5},
         {50, 60},
         {0, 60},
         {0, 4},
         {-20, 4}}}},
  };
  return cases;
}

TEST(AnsysBeamShapes, AreaAndMomentsAreThoseOfTheOutline) {
  for (const ShapeCase& c : shape_cases()) {
    const OutlineSums s = outline_sums(c.outlines);
    const FeModel m = beam_of(c.shape, c.data, "SECOFFSET,CENT\n");
    ASSERT_EQ(m.elements.size(), 1u) << c.shape;
    const BeamSection& b = m.sections.at(m.elements[0].section);
    EXPECT_NEAR(b.A, s.A, 1e-12 * s.A) << c.shape;
    EXPECT_NEAR(b.Iy + b.Iz, s.Iyy + s.Izz, 1e-12 * (s.Iyy + s.Izz)) << c.shape;
    // The tensor of second moments, from the principal ones and y of the element.
    const Vec3 y = m.elements[0].reference, z = Vec3::UnitX().cross(y);
    EXPECT_NEAR(b.Iz * y.y() * y.y() + b.Iy * z.y() * z.y(), s.Izz, 1e-12 * s.Izz) << c.shape;
    EXPECT_NEAR(b.Iz * y.y() * y.z() + b.Iy * z.y() * z.z(), s.Iyz, 1e-12 * s.Izz) << c.shape;
    EXPECT_EQ(m.nodes(), 2) << c.shape;  // the centroid is at the nodes
    EXPECT_TRUE(m.equations.empty() && m.spiders.empty());
    // Torsion and shear of the solid section; of open thin ones near b t^3/3.
    EXPECT_GT(b.shear_y, 0.1 * b.A);
    EXPECT_GT(b.shear_z, 0.1 * b.A);
    EXPECT_LT(b.shear_y + b.shear_z, 5.0 / 3.0 * b.A);
  }
  const auto torsion = [](const char* shape, const char* data) {
    return beam_of(shape, data).sections.at(0).J;
  };
  EXPECT_NEAR(torsion("I", "100,100,200,1,1,1"), 398 / 3.0, 0.01 * 398 / 3.0);
  EXPECT_NEAR(torsion("L", "100,100,1,1"), 199 / 3.0, 0.01 * 199 / 3.0);
  EXPECT_NEAR(torsion("HREC", "101,101,1,1,1,1"), bredt_torsion(101, 101, 1, 1, 1, 1), 0.01 * 1e6);
  EXPECT_NEAR(torsion("HREC", "101,101,1,1,1,1"), 1e6, 0.01 * 1e6);
}

TEST(AnsysBeamShapes, AssumptionsAreNoted) {
  const auto notes = [](const char* shape, const char* data) { return beam_of(shape, data).notes; };
  EXPECT_TRUE(notes("I", "80,80,110,10,10,5").empty());
  EXPECT_TRUE(notes("HREC", "60,80,6,6,4,4").empty());
  EXPECT_EQ(notes("T", "60,80,10,6"),
            (std::vector<std::string>{
                "a.cdb:14: section 1 (T): its shear centre is taken at its centroid"}));
  EXPECT_EQ(notes("Z", "60,60,100,10,10,6"),
            (std::vector<std::string>{
                "a.cdb:14: section 1 (Z): its lower flange is taken to point to +y and the upper "
                "one to -y"}));
  EXPECT_EQ(notes("HATS", "20,30,50,60,4,5,6,7,8").at(1),
            "a.cdb:14: section 1 (HATS): its brims are taken to begin at the outer sides of the "
            "webs");
}

/// Equations and spiders hold for rigid motions, and the ends lie where they should.
void expect_arm(const FeModel& m, const Vec3& arm) {
  ASSERT_EQ(m.nodes(), 4);
  for (int end = 0; end < 2; ++end) {
    const int fresh = m.elements.at(0).nodes[end];
    EXPECT_GE(fresh, 2);
    EXPECT_LE((m.positions[fresh] - m.positions[end] - arm).norm(), 1e-4 * arm.norm());
  }
  ASSERT_EQ(m.spiders.size(), 2u);
  EXPECT_EQ(m.spiders[1].reference, 1);
  EXPECT_EQ(m.spiders[1].nodes, std::vector<int>{m.elements[0].nodes[1]});
}

TEST(AnsysBeamShapes, NodesOffTheCentroid) {
  // An I section: the origin is in the middle of the lower flange.
  expect_arm(beam_of("I", "80,80,110,10,10,5", "SECOFFSET,ORIGIN\n"), Vec3(0, 0, 55));
  expect_arm(beam_of("I", "80,80,110,10,10,5", "SECOFFSET,USER,0,160\n"), Vec3(0, 0, -105));
  // Of a box it is the lower left corner, of solid shapes and tubes the middle.
  expect_arm(beam_of("HREC", "60,80,5,5,4,4", "SECOFFSET,USER,60,40\n"), Vec3(0, -30, 0));
  expect_arm(beam_of("RECT", "60,80", "SECOFFSET,USER,30,-40\n"), Vec3(0, -30, 40));
  expect_arm(beam_of("ASEC", "10,5,2,8,0,3,4,-3", "SECOFFSET,ORIGIN\n"), Vec3(0, 4, -3));
  expect_arm(beam_of("ASEC", "10,5,2,8,0,3,4,-3,1,1", "SECOFFSET,SHRC\n"), Vec3(0, 3, -4));
  EXPECT_EQ(beam_of("ASEC", "10,5,2,8,0,3,4,-3", "SECOFFSET,CENT\n").nodes(), 2);
  EXPECT_EQ(beam_of("I", "80,80,110,10,10,5", "SECOFFSET,SHRC\n").nodes(), 2);
  // Thin walls: the shear centre of a channel is 3 b^2/(6 b + h) behind the web, its centroid
  // b^2/(2 b + h) before it.
  const double e = 3.0 * 1e4 / 800.0 + 1e4 / 400.0;
  const FeModel channel = beam_of("CHAN", "100.5,100.5,201,1,1,1", "SECOFFSET,SHRC\n");
  expect_arm(channel, Vec3(0, channel.positions[2].y(), 0));
  EXPECT_NEAR(channel.positions[2].y(), e, 2e-3 * e);
}

/// A node with rotations of its own: equations; u' = u + theta x d.
TEST(AnsysBeamShapes, ArmsOfNodesOfOtherBeams) {
  const FeModel m = ansys_of(
      "ET,1,188\nET,2,189\nN,1,0,0,0\nN,2,10,0,0\nN,3,5,0,0\nN,4,0,9,0\n" + cdb_steel +
      "SECTYPE,1,BEAM,RECT\nSECDATA,2,3\nSECTYPE,2,BEAM,RECT\nSECDATA,2,3\nSECOFFSET,USER,1,2\n"
      "SECN,1\nEN,1,1,3\nEN,2,3,2\nSECN,2\nEN,3,1,3\nTYPE,2\nEN,4,1,2,3\n");
  EXPECT_EQ(m.nodes(), 7);  // ends at one place are one node
  EXPECT_TRUE(m.spiders.empty());
  ASSERT_EQ(m.equations.size(), 18u);
  EXPECT_EQ(m.elements[2].nodes[0], m.elements[3].nodes[0]);
  EXPECT_EQ(m.elements[2].nodes[1], m.elements[3].nodes[1]);  // the middle
  EXPECT_LE((m.positions[4] - Vec3(0, -1, -2)).norm(), 1e-15);
  const Vec3 shift(0.3, -0.2, 0.7), turn(0.5, 0.4, -0.6);
  for (const LinearEquation& q : m.equations) {
    double sum = 0.0;
    for (const auto& t : q.terms)
      sum += t.factor * (t.axis < 3 ? shift + turn.cross(m.positions[t.node]) : turn)(t.axis % 3);
    EXPECT_NEAR(sum, 0.0, 1e-14);
    EXPECT_GE(q.terms[0].node, 4);
  }
}

/// Ends of beams and middles of straight edges are added in turn.
TEST(AnsysBeamShapes, NumbersOfNodesThatAreAdded) {
  const std::string brick = "EN,1,1,2,3,4,5,6,7,8\nEMORE,9\n", beam = "TYPE,2\nEN,2,1,2\n";
  for (const std::string& elements : {brick + beam, beam + "TYPE,1\n" + brick}) {
    const FeModel m =
        ansys_of("ET,1,186\nET,2,188\n" + cdb_square + "N,9,1\n" + cdb_steel +
                 "SECTYPE,1,BEAM,RECT\nSECDATA,.2,.3\nSECOFFSET,USER,1,2\n" + elements);
    EXPECT_EQ(m.nodes(), 9 + 11 + 2);
    EXPECT_EQ(std::set<int>(m.node_ids.begin(), m.node_ids.end()).size(), 22u);
    EXPECT_EQ(m.spiders.size(), 2u);
    EXPECT_EQ(m.spiders.at(0).name, "beams of node 1");
  }
}

TEST(AnsysBeamShapes, Pipes) {
  const auto pipe = [](const std::string& data, const std::string& more = "") {
    return ansys_of("ET,1,288\nET,2,289\nN,1,0,0,0\nN,2,1000,0,0\nN,3,500,0,0\n" + cdb_steel +
                    "MP,DENS,2,1e-9\nSECTYPE,1,PIPE,,p\nSECDATA," + data + "\n" + more +
                    "EN,1,1,2\nTYPE,2\nEN,2,1,2,3\n");
  };
  const FeModel m = pipe("20,3,16");
  ASSERT_EQ(m.elements.size(), 2u);
  EXPECT_EQ(m.elements[1].type, FeElementType::beam3);
  const BeamSection& s = m.sections.at(0);
  const double pi = std::numbers::pi;
  EXPECT_NEAR(s.A, pi * (100 - 49), 1e-10);
  EXPECT_NEAR(s.Iy, pi / 4 * (1e4 - 2401), 1e-9);
  EXPECT_NEAR(s.J, pi / 2 * (1e4 - 2401), 1e-9);
  EXPECT_EQ(s.bore, 14.0);
  EXPECT_GT(s.shear_y, 0.5 * s.A);
  EXPECT_NEAR(pipe("20").sections.at(0).A, pi * 100, 1e-10);  // solid
  const FeModel covered = pipe("20,3,8,0,1,0,2,5");
  EXPECT_NEAR(covered.materials[covered.elements[0].material].density * s.A,
              7.85e-9 * s.A + 1e-9 * pi * (225 - 100), 1e-15);
  const FeModel offset = pipe("20,3", "SECOFFSET,4,-5\n");
  EXPECT_LE((offset.positions[offset.elements[0].nodes[0]] - Vec3(0, -4, 5)).norm(), 1e-12);
}

TEST(AnsysBeamShapes, Errors) {
  const auto error = [](const std::string& shape, const std::string& data,
                        const std::string& more = "") {
    return error_of([&] { beam_of(shape, data, more); });
  };
  EXPECT_EQ(error("MESH", "1"), "a.cdb:14: unsupported");
  EXPECT_EQ(error("QUAD", "1"), "a.cdb:14: unsupported");
  EXPECT_EQ(error("I", "1,2,3"), "a.cdb:14: out_of_range");
  EXPECT_EQ(error("I", "80,80,20,10,10,5"), "a.cdb:14: geometry");
  EXPECT_EQ(error("L", "80,-80,10,5"), "a.cdb:14: unsupported");
  EXPECT_EQ(error("HATS", "1,1,10,20,1,1,1,5,5"), "a.cdb:14: geometry");
  EXPECT_EQ(error("CHAN", "20,20,10,5,5,1"), "a.cdb:14: geometry");
  EXPECT_EQ(error("HREC", "20,8,1,1,4,4"), "a.cdb:14: geometry");
  EXPECT_EQ(error("L", "1e7,1e7,1,1"), "a.cdb:14: unsupported");
  EXPECT_EQ(error("T", "60,80,10,6", "SECOFFSET,SHRC\n"), "a.cdb:14: unsupported");
  EXPECT_EQ(error("CHAN", "60,60,80,6,6,6", "SECOFFSET,USER,1,2\n"), "a.cdb:14: unsupported");
  EXPECT_EQ(error("RECT", "1,1", "SECOFFSET,MID\n"), "a.cdb:14: unsupported");
  EXPECT_EQ(error("RECT", "1,1", "SECOFFSET,USER,0,0,1\n"), "a.cdb:14: unsupported");
}

TEST(AnsysBeamShapes, ManySectionsAreNotComputed) {
  const auto deck = [](int count) {
    std::string text =
        "ET,1,188\nMP,EX,1,2.1e5\nMP,PRXY,1,0.3\nMP,DENS,1,7.8e-9\nN,1\nN,2,100\nN,3,0,1\n";
    for (int k = 1; k <= count; ++k)
      text += fmt::format("SECTYPE,{},BEAM,L\nSECDATA,20,20,10,10\n", k);
    for (int k = 1; k <= count; ++k) text += fmt::format("SECNUM,{}\nE,1,2,3\n", k);
    return text;
  };
  EXPECT_EQ(ansys_of(deck(200)).elements.size(), 200u);
  EXPECT_EQ(ansys_error(deck(201)), "a.cdb:408: too_large");
}

TEST(AnsysBeamShapes, ErrorsOfPipes) {
  const auto error = [](const std::string& data) {
    return ansys_error("ET,1,288\nN,1\nN,2,1\nSECTYPE,1,PIPE\nSECDATA," + data + "\n" + cdb_steel +
                       "E,1,2\n");
  };
  EXPECT_EQ(error("20,30"), "a.cdb:4: out_of_range");
  EXPECT_EQ(error("20,3,8,0,1,1"), "a.cdb:4: unsupported");
  EXPECT_EQ(error("20,3,8,0,1,0,7,1"), "a.cdb:4: missing");
  EXPECT_EQ(error("20,3,8,0,1,0,1,-1"), "a.cdb:4: out_of_range");
}

/// The number of USER is the place of the nodes above the middle; layers without thickness drop.
TEST(AnsysShells, Offsets) {
  const auto offset = [](const std::string& location) {
    const FeModel m = ansys_of("ET,1,181\nN,1\nN,2,1\nN,3,1,1\nN,4,0,1\n" + cdb_steel +
                               "SECTYPE,1,SHELL\nSECDATA,0.2,1\nSECDATA,0,1\nSECDATA,.4,1\n" +
                               location + "E,1,2,3,4\n");
    EXPECT_EQ(m.shells.at(0).plies.size(), 2u);
    return m.shells.at(0).offset;
  };
  EXPECT_NEAR(offset("SECOFFSET,USER,0.3\n"), offset("SECOFFSET,TOP\n"), 1e-15);
  EXPECT_NEAR(offset("SECOFFSET,USER,-0.3\n"), offset("SECOFFSET,BOT\n"), 1e-15);
  EXPECT_EQ(offset("SECOFFSET,USER,0.1\n"), -0.1);
  EXPECT_EQ(offset("SECOFFSET,MID\n"), 0.0);
  EXPECT_EQ(offset(""), 0.0);
}

}  // namespace
}  // namespace floatframe::test
