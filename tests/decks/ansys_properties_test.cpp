// ANSYS decks: materials, shells, beams, rods, each against what it means.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "decks/ansys_deck.hpp"
#include "floatframe/fe/elasticity.hpp"
#include "floatframe/fe/shell_layers.hpp"

namespace floatframe::test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

const std::string cdb_ply = cdb_material(1, {{"EX", 1.3e5},
                                             {"EY", 9e3},
                                             {"EZ", 8e3},
                                             {"PRXY", 0.3},
                                             {"PRYZ", 0.4},
                                             {"PRXZ", 0.25},
                                             {"NUXY", 0.021},
                                             {"GXY", 5e3},
                                             {"GYZ", 3.2e3},
                                             {"GXZ", 4.5e3},
                                             {"DENS", 1.6e-9}});
constexpr EngineeringConstants ply_constants{1.3e5, 9e3, 8e3, 0.3, 0.25, 0.4, 5e3, 4.5e3, 3.2e3};

TEST(AnsysMaterials, OrthotropicByMajorOrMinorRatios) {
  const Mat6 D = elasticity_of(ply_constants);
  const FeModel major = ansys_of(cdb_brick + cdb_ply);
  ASSERT_TRUE(major.materials.at(0).elasticity);
  EXPECT_LE((*major.materials[0].elasticity - D).norm(), 1e-14 * D.norm());
  // NUXY = PRXY EY/EX, NUYZ = PRYZ EZ/EY, NUXZ = PRXZ EZ/EX
  const FeModel minor =
      ansys_of(cdb_brick +
               fmt::format("MP,EX,1,1.3e5\nMP,EY,1,9e3\nMP,EZ,1,8e3\nMP,NUXY,1,{:.17g}\nMP,NUYZ,1,"
                           "{:.17g}\nMP,NUXZ,1,{:.17g}\nMP,GXY,1,5e3\nMP,GYZ,1,3.2e3\n"
                           "MP,GXZ,1,4.5e3\nMP,DENS,1,1\n",
                           0.3 * 9e3 / 1.3e5, 0.4 * 8e3 / 9e3, 0.25 * 8e3 / 1.3e5));
  EXPECT_LE((*minor.materials.at(0).elasticity - D).norm(), 1e-14 * D.norm());
  // TB,ANEL has the upper triangle by rows, xz last.
  std::string table = "MP,DENS,1,1\nTB,ANEL,1,1,21,0\nTBTEMP,0\n";
  std::vector<double> list;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) list.push_back(D(i, j));
  for (std::size_t k = 0; k < list.size(); k += 6) {
    table += fmt::format("TBDATA,{}", k + 1);
    for (std::size_t i = k; i < std::min(k + 6, list.size()); ++i)
      table += fmt::format(",{:.17g}", list[i]);
    table += "\n";
  }
  EXPECT_LE((*ansys_of(cdb_brick + table).materials.at(0).elasticity - D).norm(), 1e-14 * D.norm());
  const FeModel both = ansys_of(cdb_brick + "MP,EX,1,1\n" + table);
  EXPECT_LE((*both.materials.at(0).elasticity - D).norm(), 1e-14 * D.norm());
  EXPECT_EQ(both.notes.at(0),
            "a.cdb:11: material 1 has TB,ANEL, which is taken, and EX by MP, which is not");
}

TEST(AnsysMaterials, IsotropicInAllForms) {
  for (const char* text :
       {"MP,EX,1,2.1e5\nMP,PRXY,1,0.3\nMP,DENS,1,7e-9\n",
        "MP,EX,1,2.1e5\nMP,NUXY,1,0.3\nMP,DENS,1,7e-9\n",
        "TB,ELASTIC,1,1,2,ISOT\nTBTEMP,0\nTBDATA,1,2.1e5,0.3\nTB,DENS,1\nTBDATA,1,7e-9\n",
        "MPTEMP,1,20,100\nMPDATA,EX,1,1,2.1e5,2.1e5\nMPDATA,PRXY,1,1,0.3\nMPDATA,DENS,1,1,7e-9\n",
        "MP,EX,1,2.1e5\nMP,EY,1,2.1e5\nMP,EZ,1,2.1e5\nMP,PRXY,1,.3\nMP,PRYZ,1,.3\nMP,PRXZ,1,.3\n"
        "MP,GXY,1,80769.230769230769\nMP,DENS,1,7e-9\n"}) {
    const Material m = ansys_of(cdb_brick + text).materials.at(0);
    EXPECT_FALSE(m.elasticity) << text;
    EXPECT_EQ(m.young, 2.1e5);
    EXPECT_EQ(m.poisson, 0.3);
    EXPECT_EQ(m.density, 7e-9);
  }
  FeReadOptions warm;
  warm.temperature = 60.0;
  for (const char* word : {"TBTEMP,", "TBFIELD,TEMP,"}) {
    const std::string table = fmt::format(
        "TB,ELAS,1,2,2\n{0}20\nTBDATA,1,2.2e5,.3\n{0}100\nTBDATA,1,2e5,.3\nTB,DENS,1\n"
        "TBDATA,1,7e-9\n",
        word);
    EXPECT_NEAR(ansys_of(cdb_brick + table, warm).materials.at(0).young, 2.1e5, 1e-6) << word;
  }
  const FeModel at = ansys_of(cdb_brick +
                                  "MPTEMP,1,20,100\nMPDATA,EX,1,1,2.2e5,2.0e5\n"
                                  "MPDATA,PRXY,1,1,.3,.3\nMPDATA,DENS,1,1,7e-9\n",
                              warm);
  EXPECT_NEAR(at.materials.at(0).young, 2.1e5, 1e-9);
  EXPECT_EQ(at.notes.at(0),
            "a.cdb:12: material 1 is taken at the temperature 60 (its table of EX goes from 20 to "
            "100)");
  const FeModel without = ansys_of(cdb_brick + "MP,EX,1,2.1e5\nMP,PRXY,1,0.3\n");
  EXPECT_TRUE(without.without_density.contains(0));
  const FeModel plastic = ansys_of(cdb_brick + cdb_steel + "TB,BISO,1,1\nTBDATA,1,200,2000\n");
  EXPECT_EQ(plastic.notes.at(0),
            "a.cdb:21: TB,BISO of material 1 is not linear: the part has the elastic constants "
            "given with it");
}

/// R_z R_x R_y; systems of cylinders and spheres; solids have the axes of ESYS.
TEST(AnsysMaterials, AxesOfCoordinateSystems) {
  const Mat3 R = (Eigen::AngleAxisd(30 * degree, Vec3::UnitZ()) *
                  Eigen::AngleAxisd(20 * degree, Vec3::UnitX()) *
                  Eigen::AngleAxisd(10 * degree, Vec3::UnitY()))
                     .toRotationMatrix();
  for (const bool written : {true, false}) {
    const auto system = [&](int kind) {
      return written ? fmt::format(
                           "LOCAL,R5.0,LOC, 11, {0}, 1.0, 2.0, 3.0\nLOCAL,R5.0,ANG, 11, {0}, "
                           "30., 20., 10.\nLOCAL,R5.0,PRM, 11, {0}, 1.0, 1.0\nCSYS,0\n",
                           kind)
                     : fmt::format("LOCAL,11,{},1,2,3,30,20,10\nCSYS,0\n", kind);
    };
    for (int kind = 0; kind < 3; ++kind) {
      const FeModel m = ansys_of("ET,1,185\n" + system(kind) + cdb_square +
                                 "ESYS,11\nE,1,2,3,4,5,6,7,8\n" + cdb_ply);
      ASSERT_EQ(m.elements.at(0).orientation, 0);
      const Orientation& o = m.orientations.at(0);
      // At a place on local coordinates r, around, up: radial, around, towards the pole.
      const double r = 2.0, a = 0.4, u = 0.3;
      const Vec3 local = kind == 2 ? Vec3(r * std::cos(u) * std::cos(a),
                                          r * std::cos(u) * std::sin(a), r * std::sin(u))
                                   : Vec3(r * std::cos(a), r * std::sin(a), u);
      Mat3 here = Mat3::Identity();
      if (kind == 1) here << std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1;
      if (kind == 2) {
        here.col(0) = local.normalized();
        here.col(1) = Vec3(-std::sin(a), std::cos(a), 0);
        here.col(2) = here.col(0).cross(here.col(1));
      }
      EXPECT_LE((o.at(Vec3(1, 2, 3) + R * local) - R * here).norm(), 1e-14) << kind;
    }
  }
}

/// Classical laminate theory: A, B, D of the plies from the bottom.
TEST(AnsysShells, Laminates) {
  const FeModel m =
      ansys_of("ET,1,181\nKEYOPT,1,3,2\n" + cdb_square +
               "SECTYPE,        1,SHELL,    ,        \nSECOFFSET,BOT\nSECBLOCK,      3\n"
               "     0.150000,         1,    45.000000,         3\n"
               "     0.100000,         2,     0.000000,         3\n"
               "     0.200000,         0,    90.000000,         3\n"
               "SECCONTROL,0,0,0,2e-9,1,1,1\nE,1,2,3,4\n" +
               cdb_ply + "MP,EX,2,7e4\nMP,PRXY,2,.33\nMP,DENS,2,2.7e-9\n");
  ASSERT_EQ(m.elements.at(0).type, FeElementType::quad4);
  const ShellSection& s = m.shells.at(0);
  EXPECT_NEAR(s.thickness, 0.45, 1e-15);
  EXPECT_NEAR(s.offset, 0.225, 1e-15);
  EXPECT_NEAR(s.shear, 0.375, 1e-15);
  EXPECT_EQ(s.mass, 2e-9);
  const ShellLayers layers = shell_layers(s, m.materials[m.elements[0].material], m.materials);
  Mat3 A = Mat3::Zero(), B = A, D = A;
  const Mat3 Q_ply = plane_stress(m.materials[0]), Q_metal = plane_stress(m.materials[1]);
  // Q of orthotropic plies in closed form
  const double nu21 = 0.3 * 9e3 / 1.3e5, q = 1.0 - 0.3 * nu21;
  Mat3 Q;
  Q << 1.3e5 / q, nu21 * 1.3e5 / q, 0, nu21 * 1.3e5 / q, 9e3 / q, 0, 0, 0, 5e3;
  EXPECT_LE((Q_ply - Q).norm(), 1e-14 * Q.norm());
  double z = -0.225;
  for (const auto& [t, Q_layer] : {std::pair{0.15, turned_plane(Q, 45 * degree)},
                                   {0.1, Q_metal},
                                   {0.2, turned_plane(Q, 90 * degree)}}) {
    const double top = z + t;
    A += t * Q_layer;
    B += 0.5 * (top * top - z * z) * Q_layer;
    D += (top * top * top - z * z * z) / 3.0 * Q_layer;
    z = top;
  }
  EXPECT_LE((layers.A - A).norm(), 1e-13 * A.norm());
  EXPECT_LE((layers.B - B).norm(), 1e-13 * A.norm());
  EXPECT_LE((layers.D - D).norm(), 1e-13 * D.norm());
}

TEST(AnsysShells, DirectionsSectionsAndConstants) {
  // A trapezium: axis 1 is the mean of the sides 1-2 and 4-3, 15 degrees away from 1-2.
  const double t = std::tan(30 * degree);
  const std::string nodes = fmt::format("N,1,0,0\nN,2,1,0\nN,3,1,{:.17g}\nN,4,0,1\n", 1 + t);
  const FeModel m =
      ansys_of("ET,1,181\nET,2,63\nET,3,93\nET,4,281\n" + nodes +
               "N,5,.5,0\nN,6,1,.7\nN,7,.5,1.3\nN,8,0,.5\n"
               "LOCAL,11,0,0,0,0,40\nCSYS,0\nSECTYPE,1,SHELL\nSECDATA,.2,1,25\n"
               "SECOFFSET,TOP\nR,1,.3,.3,.3,.3,,10\nRMORE,2\nRMORE\n"
               "RMORE,5e-9\n"
               "R,R5.0,LOC,3,1,.4,.4,.4\nR,R5.0,LOC,3,4,.4\nTYPE,1\nEN,1,1,2,3,4\nESYS,11\nEN,2,1,"
               "2,3,3\nTYPE,2\nEN,3,1,2,3,4\n"
               "TYPE,3\nREAL,3\nEN,4,1,2,3,4,5,6,7,8\nTYPE,4\nEN,5,1,2,3,3,5,6,3,8\n" +
               cdb_ply);
  ASSERT_EQ(m.elements.size(), 5u);
  const double mean = std::atan2(0.5 * t, 1.0);
  EXPECT_NEAR(m.elements[0].angle, mean + 25 * degree, 1e-15);
  EXPECT_EQ(m.elements[1].type, FeElementType::tri3);
  EXPECT_NEAR(m.elements[1].angle, 25 * degree, 1e-15);
  EXPECT_NEAR(m.orientations.at(m.elements[1].orientation).axes(1, 0), std::sin(40 * degree),
              1e-15);
  EXPECT_EQ(m.shells[m.elements[0].section].offset, -0.1);
  const ShellSection& thin = m.shells[m.elements[2].section];
  EXPECT_EQ(thin.thickness, 0.3);
  EXPECT_EQ(thin.shear, 0.0);
  EXPECT_EQ(thin.bending_factor, 2.0);
  EXPECT_EQ(thin.mass, 5e-9);
  EXPECT_NEAR(m.elements[2].angle, 10 * degree, 1e-15);
  EXPECT_EQ(m.elements[3].type, FeElementType::quad8);
  EXPECT_EQ(m.shells[m.elements[3].section].thickness, 0.4);
  EXPECT_EQ(m.elements[4].type, FeElementType::tri6);
  EXPECT_EQ(m.elements[4].nodes[5], 7);
}

TEST(AnsysBeams, SectionsAndOrientation) {
  const FeModel m = ansys_of(
      "ET,1,188\nET,2,189\nET,3,4\nET,4,180\nET,5,8\nN,1,0,0,0\nN,2,2,0,0\nN,3,1,0,0\nN,4,0,0,5\n"
      "N,5,0,3,0\nN,6,1,2,5\n" +
      cdb_steel +
      "SECTYPE,1,BEAM,RECT\nSECDATA,2,3,2,2\nSECOFFSET,CENT\nSECTYPE,2,BEAM,CTUBE\nSECDATA,1,2,8\n"
      "SECTYPE,3,BEAM,ASEC\nSECDATA,10,5,2,8,0,3,,,,,,,.5,.8\nSECCONTROL,,,,7.85e-9\n"
      "SECTYPE,4,LINK\nSECDATA,6\nR,3,10,8,5,2,1,30\nRMORE,,4,1.2,1.5,,7.85e-8\nR,5,7\n"
      "EN,1,1,2\nEN,2,1,4\nEN,3,1,5,6\nSECN,2\nTYPE,2\nEN,4,1,2,3,4\nSECN,3\nTYPE,1\nEN,5,1,2\n"
      "TYPE,3\nREAL,3\nEN,6,1,2\nTYPE,4\nSECN,4\nEN,7,1,2\nTYPE,5\nREAL,5\nEN,8,1,2\n");
  ASSERT_EQ(m.elements.size(), 8u);
  const auto section = [&](int e) { return m.sections.at(m.elements.at(e).section); };
  const auto y_of = [&](int e) { return m.elements.at(e).reference; };
  // Without a node y is parallel to the global xy plane; along z it is the global y.
  EXPECT_LE((y_of(0) - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_LE((y_of(1) - Vec3::UnitY()).norm(), 1e-15);
  // The node lies in the plane of x and z.
  const Vec3 x = Vec3::UnitY(), towards(1, 2, 5), z = (towards - towards.dot(x) * x).normalized();
  EXPECT_LE((x.cross(y_of(2)) - z).norm(), 1e-15);
  // B along y, H along z
  EXPECT_NEAR(section(0).Iz, 3 * 8 / 12.0, 1e-15);
  EXPECT_NEAR(section(0).Iy, 2 * 27 / 12.0, 1e-15);
  EXPECT_NEAR(section(0).shear_y, 5.0, 1e-15);
  EXPECT_EQ(m.elements[3].type, FeElementType::beam3);
  EXPECT_EQ(m.elements[3].nodes[1], 2);
  EXPECT_NEAR(section(3).A, 3 * std::numbers::pi, 1e-14);
  EXPECT_NEAR(section(3).Iy, (16 - 1) * std::numbers::pi / 4, 1e-14);
  // Of constants with Iyz: principal second moments, their sum and product are kept.
  EXPECT_NEAR(section(4).Iy + section(4).Iz, 13, 1e-14);
  EXPECT_NEAR(section(4).Iy * section(4).Iz, 5 * 8 - 2 * 2, 1e-13);
  EXPECT_EQ(section(4).shear_z, 5.0);
  EXPECT_EQ(section(4).shear_y, 8.0);
  const Vec3 own = y_of(4);  // int y'^2 is largest along it
  EXPECT_NEAR(8 * own.y() * own.y() + 2 * 2 * own.y() * own.z() + 5 * own.z() * own.z(),
              section(4).Iz, 1e-13);
  EXPECT_NEAR(m.materials[m.elements[4].material].density, 7.85e-9 + 7.85e-10, 1e-22);
  // BEAM4: theta turns y towards z.
  EXPECT_NEAR(y_of(5).z(), 0.5, 1e-15);
  EXPECT_EQ(section(5).Iz, 8.0);
  EXPECT_EQ(section(5).Iy, 5.0);
  EXPECT_EQ(section(5).J, 4.0);
  EXPECT_NEAR(section(5).shear_z, 10 / 1.2, 1e-14);
  EXPECT_NEAR(section(5).shear_y, 10 / 1.5, 1e-14);
  EXPECT_NEAR(m.materials[m.elements[5].material].density, 2 * 7.85e-9, 1e-22);
  EXPECT_EQ(m.elements[6].type, FeElementType::rod2);
  EXPECT_EQ(section(6).A, 6.0);
  EXPECT_EQ(section(7).A, 7.0);
}

}  // namespace
}  // namespace floatframe::test
