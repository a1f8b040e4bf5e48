// Laminates of Abaqus, CalculiX and Nastran decks: the same layers in both languages are the same
// part, and where axis 1 lies without being told.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "decks/deck_text.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/model_checks.hpp"

namespace floatframe::test {
namespace {

FeModel layered_inp(const std::string& text, DeckDialect dialect = DeckDialect::abaqus) {
  return valid_inp(text, of_dialect(dialect));
}

/// Two elements in the xy plane, the first sides along x and along y.
const std::string abaqus_mesh =
    "*NODE\n1, 0., 0., 0.\n2, 2., 0., 0.\n3, 2., 1., 0.\n4, 0., 1., 0.\n5, 3., .5, 0.\n"
    "*ELEMENT, TYPE=S4, ELSET=SKIN\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=S3, ELSET=SKIN\n2, 2, 5, 3\n"
    "*MATERIAL, NAME=PLY\n*ELASTIC, TYPE=LAMINA\n1.4e5, 1.e4, .3, 5000., 5000., 3000.\n"
    "*DENSITY\n1.6e-9\n*MATERIAL, NAME=CORE\n*ELASTIC\n500., .25\n*DENSITY\n1.e-10\n";
const std::string nastran_mesh =
    "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,1.,0.\nGRID,4,,0.,1.,0.\nGRID,5,,3.,.5,0.\n"
    "MAT8,1,1.4+5,1.+4,.3,5000.,5000.,3000.,1.6-9\nMAT1,2,500.,,.25,1.-10\n"
    "CORD2R,7,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n";

/// As both programs would have them with consistent mass.
void expect_same(FeModel a, FeModel b) {
  for (FeModel* m : {&a, &b})
    for (FeElement& e : m->elements) e.mass_form = MassForm::consistent;
  const FeSystem x = assemble(a), y = assemble(b);
  EXPECT_LT((x.K - y.K).norm(), 1e-10 * x.K.norm());
  EXPECT_LT((x.M - y.M).norm(), 1e-12 * x.M.norm());
}

TEST(LayeredDecks, TheSameLaminateInBothLanguages) {
  const std::string plies = "1., 3, PLY, 0., P1\n2., 3, CORE, , P2\n.5, 3, PLY, 45.\n";
  const FeModel a =
      layered_inp(abaqus_mesh + "*ORIENTATION, NAME=O\n1., 0., 0., 0., 1., 0.\n3, 10.\n" +
                  "*SHELL SECTION, ELSET=SKIN, COMPOSITE, ORIENTATION=O\n" + plies);
  const FeModel n =
      valid_bdf(nastran_mesh +
                "CORD2R,8,,0.,0.,0.,0.,0.,1.\n,0.984807753012208,0.17364817766693,0.\n"
                "CQUAD4,1,3,1,2,3,4,8\nCTRIA3,2,3,2,5,3,8\n"
                "PCOMP,3\n,1,1.,0.,YES,2,2.,0.\n,1,.5,45.\n");
  ASSERT_EQ(a.shells.at(0).plies.size(), 3u);
  EXPECT_NEAR(a.shells[0].thickness, 3.5, 1e-15);
  EXPECT_EQ(n.shells.at(0).plies.size(), 3u);
  expect_same(a, n);
  const double area = 2.0 + 0.5;
  EXPECT_NEAR(volume_times_density(a), area * (1.5 * 1.6e-9 + 2.0 * 1e-10), 1e-18);
  // PCOMPG, and symmetric ones: half of the plies, or all of them.
  const std::string elements = "CQUAD4,1,3,1,2,3,4,10.\nCTRIA3,2,3,2,5,3,73.43494882\n";
  const FeModel g =
      valid_bdf(nastran_mesh + elements + "PCOMPG,3\n,1,1,1.,0.,YES\n,2,2,2.,0.\n,3,1,.5,45.\n");
  EXPECT_EQ(g.shells.at(0).plies.size(), 3u);
  const FeModel symmetric = layered_inp(
      abaqus_mesh + "*ORIENTATION, NAME=O\n1., 0., 0., 0., 1., 0.\n3, 10.\n" +
      "*SHELL SECTION, ELSET=SKIN, COMPOSITE, SYMMETRIC, ORIENTATION=O, OFFSET=SNEG\n" + plies);
  ASSERT_EQ(symmetric.shells.at(0).plies.size(), 6u);
  const FeModel sym =
      valid_bdf(nastran_mesh +
                "CORD2R,8,,0.,0.,0.,0.,0.,1.\n,0.984807753012208,0.17364817766693,0.\n"
                "CQUAD4,1,3,1,2,3,4,8\nCTRIA3,2,3,2,5,3,8\n"
                "PCOMP,3,0.,,,,,,SYM\n,1,1.,0.,YES,2,2.,0.\n,1,.5,45.\n");
  EXPECT_NEAR(sym.shells.at(0).offset, 3.5, 1e-15);
  expect_same(symmetric, sym);
}

// Axis 1 of the quadrilateral and of the triangle, whose side 1-2 lies at -26.565 degrees... of x.
Vec3 axis_of(const FeModel& model, int element) {
  const ElementInput in = gather(model, model.elements.at(element));
  EXPECT_TRUE(in.layers.has_value());
  return in.layers ? in.layers->axis : Vec3(Vec3::Zero());
}

TEST(LayeredDecks, WhereAxisOneLies) {
  const std::string layers = "*SHELL SECTION, ELSET=SKIN, COMPOSITE\n1., 3, PLY, 0.\n";
  const double to_5 = std::atan2(0.5, 1.0), degree = std::numbers::pi / 180.0;
  const auto direction = [](double angle) { return Vec3(std::cos(angle), std::sin(angle), 0.0); };
  // Abaqus: global x projected, or z where x is the normal.
  FeModel m = layered_inp(abaqus_mesh + layers);
  EXPECT_LT((axis_of(m, 1) - Vec3::UnitX()).norm(), 1e-14);
  std::string across = abaqus_mesh;
  for (const auto& [from, to] : {std::pair{"1, 0., 0., 0.", "1, 0., 0., 0."},
                                 {"2, 2., 0., 0.", "2, 0., 2., 0."},
                                 {"3, 2., 1., 0.", "3, 0., 2., 1."},
                                 {"4, 0., 1., 0.", "4, 0., 0., 1."},
                                 {"5, 3., .5, 0.", "5, 0., 3., .5"}})
    across.replace(across.find(from), std::string(from).size(), to);
  m = layered_inp(across + layers);
  EXPECT_LT((axis_of(m, 0) - Vec3::UnitZ()).norm(), 1e-14);
  EXPECT_LT((axis_of(m, 1) - Vec3::UnitZ()).norm(), 1e-14);
  // Nastran: the side G1-G2, turned by THETA; or the x axis of MCID.
  const std::string ply = "PCOMP,3\n,1,1.,0.\n";
  m = valid_bdf(nastran_mesh + "CQUAD4,1,3,1,2,3,4\nCTRIA3,2,3,2,5,3,30.\n" + ply);
  EXPECT_LT((axis_of(m, 0) - Vec3::UnitX()).norm(), 1e-14);
  EXPECT_LT((axis_of(m, 1) - direction(to_5 + 30 * degree)).norm(), 1e-14);
  m = valid_bdf(nastran_mesh + "CQUAD4,1,3,1,2,3,4,0\nCTRIA3,2,3,2,5,3,7\n" + ply);
  EXPECT_LT((axis_of(m, 1) - Vec3::UnitX()).norm(), 1e-14);
  // Abaqus: the axis after the one that is turned about. Here 2 is the normal: 3 is projected.
  m = layered_inp(abaqus_mesh + "*ORIENTATION, NAME=O\n1., 1., 0., 0., 0., 1.\n2, 0.\n" +
                  "*SHELL SECTION, ELSET=SKIN, MATERIAL=PLY, ORIENTATION=O\n1.\n");
  const double half = std::sqrt(0.5);
  EXPECT_LT((axis_of(m, 0) - Vec3(half, -half, 0)).norm(), 1e-14);
  // A cylinder about z: axis 1 is radial, and with a turn of 90 degrees about 3 it goes round.
  const std::string cylinder = "*ORIENTATION, NAME=O, SYSTEM=CYLINDRICAL\n0., 0., 0., 0., 0., 1.\n";
  const std::string one = "*SHELL SECTION, ELSET=SKIN, MATERIAL=PLY, ORIENTATION=O\n1.\n";
  m = layered_inp(abaqus_mesh + cylinder + "3, 90.\n" + one);
  EXPECT_LT((axis_of(m, 0) - direction(std::atan2(0.5, 1.0) + 90 * degree)).norm(), 1e-14);
  // CalculiX needs no second line.
  m = layered_inp(abaqus_mesh + cylinder + one, DeckDialect::calculix);
  EXPECT_LT((axis_of(m, 0) - direction(std::atan2(0.5, 1.0))).norm(), 1e-14);
}

// Orientations of plies by name are the angles between them.
TEST(LayeredDecks, PliesWithOrientations) {
  const std::string base = abaqus_mesh + "*ORIENTATION, NAME=O\n1., 0., 0., 0., 1., 0.\n3, 20.\n" +
                           "*ORIENTATION, NAME=P\n1., 0., 0., 0., 1., 0.\n3, 65.\n" +
                           "*SHELL SECTION, ELSET=SKIN, COMPOSITE, ORIENTATION=O, OFFSET=.25\n";
  const FeModel named = layered_inp(base + "1., , PLY, O\n2., , PLY, P\n");
  const FeModel turned = layered_inp(base + "1., , PLY\n2., , PLY, 45.\n");
  EXPECT_NEAR(turned.shells.at(0).offset, -0.75, 1e-15);
  expect_same(named, turned);
}

// PSHELL with other materials for bending and coupling, and a PCOMP whose matrices they are.
TEST(LayeredDecks, PshellOfSeveralMaterials) {
  // A = T G1, D = T^3/12 G2, B = -T^2 G4 of two plies of MAT8 0/90, written down here.
  const double nu21 = 0.3 / 14.0, d = 1.0 - 0.3 * nu21;
  const double q11 = 1.4e5 / d, q22 = 1e4 / d, q12 = 3000.0 / d;
  const auto mat2 = [](int id, double g11, double g12, double g22, double g33) {
    char text[200];
    std::snprintf(text, sizeof text, "MAT2,%d,%.12g,%.12g,0.,%.12g,0.,%.12g,1.6-9\n", id, g11, g12,
                  g22, g33);
    return std::string(text);
  };
  const double mean = 0.5 * (q11 + q22);
  // int z Q dz over two plies of 1/2 T: (Q_top - Q_bottom) T^2/8 = -G4 T^2.
  const std::string materials = mat2(11, mean, q12, mean, 5000.0) + mat2(12, mean, q12, mean, 5e3);
  char g4[200];
  std::snprintf(g4, sizeof g4, "MAT2,14,%.12g,0.,0.,%.12g\n", (q11 - q22) / 8.0, (q22 - q11) / 8.0);
  const std::string elements = "CQUAD4,1,3,1,2,3,4,15.\nCTRIA3,2,3,2,5,3,-5.\n";
  const FeModel pcomp = valid_bdf(nastran_mesh + elements + "PCOMP,3\n,1,1.,0.,,1,1.,90.\n");
  const FeModel pshell =
      valid_bdf(nastran_mesh + elements + materials + g4 + "PSHELL,3,11,2.,12,1.,,,\n,,,14\n");
  FeModel layered = pcomp;
  layered.shells.at(0).shear = 0.0;
  const FeSystem x = assemble(layered), y = assemble(pshell);
  EXPECT_LT((x.K - y.K).norm(), 1e-9 * x.K.norm());
}

// ZOFFS and Z0 put the same plies at the same height; PSHELL takes ZOFFS too.
TEST(LayeredDecks, Offsets) {
  const std::string plies = "\n,1,1.,0.,,1,1.,90.\n";
  const FeModel zoffs =
      valid_bdf(nastran_mesh + "CQUAD4,1,3,1,2,3,4,0.,.7\nCTRIA3,2,3,2,5,3,0.,.7\nPCOMP,3" + plies);
  const FeModel z0 =
      valid_bdf(nastran_mesh + "CQUAD4,1,3,1,2,3,4,0.\nCTRIA3,2,3,2,5,3,0.\nPCOMP,3,-.3" + plies);
  expect_same(zoffs, z0);
  const FeModel plain =
      valid_bdf(nastran_mesh + "CQUAD4,1,3,1,2,3,4,,.7\nCTRIA3,2,3,2,5,3\nPSHELL,3,2,1.,2\n");
  EXPECT_EQ(plain.shells.size(), 2u);
  EXPECT_NEAR(plain.shells.at(0).offset, 0.7, 1e-15);
}

// MAT9 in the axes of a coordinate system is ENGINEERING CONSTANTS with an orientation.
TEST(LayeredDecks, SolidsInBothLanguages) {
  const EngineeringConstants c{1.4e5, 1e4, 8e3, .3, .35, .45, 5e3, 4e3, 3e3};
  const Mat6 D = elasticity_of(c);
  std::string mat9 = "MAT9,1";
  int field = 2;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) {
      char text[40];
      std::snprintf(text, sizeof text, ",%.12g", D(i, j));
      if (field++ == 9) mat9 += "\n", field = 2;
      mat9 += text;
    }
  const FeModel a = layered_inp(
      "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 0., 0., 1.\n"
      "*ELEMENT, TYPE=C3D4, ELSET=B\n1, 1, 2, 3, 4\n*MATERIAL, NAME=M\n"
      "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n1.4e5, 1.e4, 8.e3, .3, .35, .45, 5.e3, 4.e3,\n3.e3\n"
      "*DENSITY\n1.6e-9\n*ORIENTATION, NAME=O\n1., 1., 0., -1., 1., 0.\n"
      "*SOLID SECTION, ELSET=B, MATERIAL=M, ORIENTATION=O\n");
  const FeModel n = valid_bdf(
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n"
      "CORD2R,7,,0.,0.,0.,0.,0.,1.\n,1.,1.,0.\nCTETRA,1,1,1,2,3,4\nPSOLID,1,1,7\n" +
      mat9 + ",1.6-9\n");
  const FeSystem x = assemble(a), y = assemble(n);
  EXPECT_LT((x.K - y.K).norm(), 1e-9 * x.K.norm());
}

// The whole of A, B and D of a deck from the energies of constant strains and curvatures, against
// classical laminate theory.
TEST(LayeredDecks, PcompAgainstLaminateTheory) {
  const FeModel m = valid_bdf(
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,1.,0.\nGRID,4,,0.,1.,0.\nGRID,5,,3.,.5,0.\n"
      "CORD2R,7,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nMAT8,1,1.4+5,1.+4,.3,5000.,,,1.6-9\n"
      "CQUAD4,1,3,1,2,3,4,7\nCTRIA3,2,3,2,5,3,7\n"
      "PCOMP,3,-.03\n,1,.01,0.,YES,1,.02,90.\n,1,.015,45.,YES,1,.01,-30.\n");
  struct Ply {
    double thickness, degrees;
  };
  const double E1 = 1.4e5, E2 = 1e4, nu12 = 0.3, G12 = 5000.0, part = 1.0 - nu12 * nu12 * E2 / E1;
  Mat3 Q;
  Q << E1 / part, nu12 * E2 / part, 0.0, nu12 * E2 / part, E2 / part, 0.0, 0.0, 0.0, G12;
  Mat6 abd = Mat6::Zero();
  double z = -0.03;
  for (const Ply& ply : {Ply{0.01, 0.0}, Ply{0.02, 90.0}, Ply{0.015, 45.0}, Ply{0.01, -30.0}}) {
    const double a = ply.degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
    Mat3 T;  // strain in the axes of the ply
    T << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
    const Mat3 q = T.transpose() * Q * T;
    const double top = z + ply.thickness;
    abd.topLeftCorner<3, 3>() += q * (top - z);
    abd.topRightCorner<3, 3>() += q * (top * top - z * z) / 2.0;
    abd.bottomRightCorner<3, 3>() += q * (top * top * top - z * z * z) / 3.0;
    z = top;
  }
  abd.bottomLeftCorner<3, 3>() = abd.topRightCorner<3, 3>().transpose();
  // u = e x, w = -kappa x^2/2, theta = (w_y, -w_x).
  MatX fields = MatX::Zero(6 * m.nodes(), 6);
  for (int n = 0; n < m.nodes(); ++n) {
    const double x = m.positions[n].x(), y = m.positions[n].y();
    auto row = fields.middleRows<6>(6 * n);
    row(0, 0) = x;
    row(1, 1) = y;
    row(0, 2) = y / 2.0, row(1, 2) = x / 2.0;
    row(2, 3) = -x * x / 2.0, row(4, 3) = x;
    row(2, 4) = -y * y / 2.0, row(3, 4) = -y;
    row(2, 5) = -x * y / 2.0, row(3, 5) = -x / 2.0, row(4, 5) = y / 2.0;
  }
  const Mat6 found = fields.transpose() * assemble(m).K * fields / 2.5;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      EXPECT_NEAR(found(i, j), abd(i, j), 1e-9 * std::sqrt(abd(i, i) * abd(j, j))) << i << j;
}

// With a material or layers *SHELL GENERAL SECTION is *SHELL SECTION.
TEST(LayeredDecks, GeneralSections) {
  for (const std::string rest :
       {"ELSET=SKIN, MATERIAL=CORE, OFFSET=SPOS\n.5\n",
        "ELSET=SKIN, COMPOSITE, OFFSET=.1\n1., , PLY, 30.\n2., , CORE\n"}) {
    const FeModel general = layered_inp(abaqus_mesh + "*SHELL GENERAL SECTION, " + rest),
                  plain = layered_inp(abaqus_mesh + "*SHELL SECTION, " + rest);
    expect_same(general, plain);
    EXPECT_EQ(general.elements[0].mass_form, plain.elements[0].mass_form);
  }
  const auto error = [](const std::string& text) {
    return error_of([&] { layered_inp(abaqus_mesh + text); });
  };
  EXPECT_EQ(error("*SHELL GENERAL SECTION, ELSET=SKIN, DENSITY=3.\n1., 0., 1., 0., 0., 1.\n"),
            "deck.inp:21: unsupported");
  EXPECT_EQ(error("*SHELL GENERAL SECTION, ELSET=SKIN, COMPOSITE, SMEAR ALL LAYERS\n1., , PLY\n")
                .substr(0, 73),
            "deck.inp:21: unsupported");
}

}  // namespace
}  // namespace floatframe::test
