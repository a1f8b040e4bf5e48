// ANSYS decks: MATRIX27 as springs, and solids of layers.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "decks/ansys_deck.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/model_checks.hpp"

namespace floatframe::test {
namespace {

using Mat12 = Eigen::Matrix<double, 12, 12>;

/// A stiffness as real constants: the upper triangle by rows, six in a line.
std::string matrix_constants_of(const Mat12& K, int digits = 17) {
  std::string text = "R,7";
  int k = 0;
  for (int i = 0; i < 12; ++i)
    for (int j = i; j < 12; ++j, ++k) {
      if (k > 0 && k % 6 == 0) text += "\nRMORE";
      text += fmt::format(",{:.{}g}", K(i, j), digits);
    }
  return text + "\n";
}

/// Two nodes 5 apart along x, the second turned by 30 degrees about z, beside a brick.
std::string matrix_deck(const std::string& constants, const std::string& options = "4") {
  return "ET,1,185\nET,2,27\nKEYOPT,2,3," + options +
         "\nN,1\nN,2,2\nN,3,2,1\nN,4,0,1\nN,5,0,0,1\nN,6,2,0,1\nN,7,2,1,1\nN,8,0,1,1\n"
         "N,20,3,0,0\nN,21,8,0,0,30\nE,1,2,3,4,5,6,7,8\n" +
         cdb_steel + constants + "TYPE,2\nREAL,7\nE,20,21\n";
}

Mat12 of_springs(const FeModel& m) {
  Mat12 K = Mat12::Zero();
  for (const Spring& s : m.springs) {
    Eigen::Matrix<double, 12, 1> d;
    d << s.directions[0], s.directions[1];
    K += s.stiffness * d * d.transpose();
  }
  return K;
}

/// Bending in two planes, tension and torsion of a beam along x.
Mat12 beam_matrix(double L, double EA, double GJ, double EIy, double EIz) {
  Eigen::Matrix<double, 6, 12> B = Eigen::Matrix<double, 6, 12>::Zero();  // strains of the ends
  B(0, 0) = B(1, 3) = -1;
  B(0, 6) = B(1, 9) = 1;
  for (int end = 0; end < 2; ++end) {  // rotations from the chord
    B(2 + end, 1) = 1 / L;
    B(2 + end, 7) = -1 / L;
    B(2 + end, 5 + 6 * end) = 1;
    B(4 + end, 2) = -1 / L;
    B(4 + end, 8) = 1 / L;
    B(4 + end, 4 + 6 * end) = 1;
  }
  Mat6 D = Mat6::Zero();
  D(0, 0) = EA / L;
  D(1, 1) = GJ / L;
  D.block<2, 2>(2, 2) << 4 * EIz / L, 2 * EIz / L, 2 * EIz / L, 4 * EIz / L;
  D.block<2, 2>(4, 4) << 4 * EIy / L, 2 * EIy / L, 2 * EIy / L, 4 * EIy / L;
  return B.transpose() * D * B;
}

TEST(AnsysMatrices, StiffnessIsTheSumOfItsSprings) {
  const Mat12 K = beam_matrix(5.0, 2e5, 3e4, 7e3, 9e3);
  Mat12 T = Mat12::Identity();  // nodal axes of the second node
  const Mat3 R = Eigen::AngleAxisd(EIGEN_PI / 6, Vec3::UnitZ()).toRotationMatrix();
  T.block<3, 3>(6, 6) = T.block<3, 3>(9, 9) = R;
  const FeModel m = ansys_of(matrix_deck(matrix_constants_of(T.transpose() * K * T)));
  ASSERT_EQ(m.springs.size(), 6u);  // as many as strains
  EXPECT_LE((of_springs(m) - K).norm(), 1e-9 * K.norm());
  EXPECT_LE(((of_springs(m) - K).bottomRightCorner<3, 3>().norm()), 1e-9 * 9e3);
  for (const Spring& s : m.springs) {
    EXPECT_EQ(m.node_ids[s.nodes[0]], 20);
    EXPECT_GT(s.stiffness, 0.0);
  }
  // With the nine digits that a file may have.
  const FeModel rough = ansys_of(matrix_deck(matrix_constants_of(T.transpose() * K * T, 9)));
  EXPECT_EQ(rough.springs.size(), 6u);
  EXPECT_LE((of_springs(rough) - K).norm(), 1e-7 * K.norm());
}

/// The example of the manual: C1 = C58 = K, C7 = -K is a spring along x.
TEST(AnsysMatrices, OneSpring) {
  Mat12 K = Mat12::Zero();
  K(0, 0) = K(6, 6) = 40.0;
  K(0, 6) = K(6, 0) = -40.0;
  std::string text = matrix_deck(matrix_constants_of(K));
  text.replace(text.find("0,0,30"), 6, "0,0,00");
  const FeModel m = ansys_of(text);
  ASSERT_EQ(m.springs.size(), 1u);
  EXPECT_EQ(m.springs[0].stiffness, 40.0);
  EXPECT_LE((m.springs[0].directions[0] - Vec6::Unit(0)).norm(), 1e-15);
  EXPECT_LE((m.springs[0].directions[1] + Vec6::Unit(0)).norm(), 1e-15);
  EXPECT_TRUE(ansys_of(matrix_deck("R,7\n")).springs.empty());
}

TEST(AnsysMatrices, Errors) {
  Mat12 K = Mat12::Zero();
  K(3, 3) = K(9, 9) = 40.0;
  K(3, 9) = K(9, 3) = -60.0;
  const std::string constants = matrix_constants_of(K), at = "element 2 (MATRIX27): ";
  EXPECT_EQ(ansys_error(matrix_deck(constants)), "a.cdb:40: out_of_range");
  K.setZero();
  K(1, 1) = 5.0;
  EXPECT_EQ(ansys_error(matrix_deck(matrix_constants_of(K))), "a.cdb:40: unsupported");
  EXPECT_EQ(ansys_error(matrix_deck(constants, "3")), "a.cdb:40: unsupported");
  EXPECT_EQ(ansys_error(matrix_deck(constants + "RMORE,3\n")), "a.cdb:25: wrong_count");
  EXPECT_EQ(ansys_error(matrix_deck("R,8,1\n")), "a.cdb:28: not_found");
  const FeModel damper = ansys_of(matrix_deck(constants, "5"));
  EXPECT_TRUE(damper.springs.empty());
  EXPECT_EQ(damper.notes.at(0), "a.cdb:40: " + at +
                                    "its damping is ignored, the part has modal damping "
                                    "(--damping)");
}

/// Masses of rigid points; directions are those of the nodes, the second turned by 30 degrees.
TEST(AnsysMatrices, MassesOfPoints) {
  const auto deck = [](const Mat12& M) {
    // A beam between the nodes, so that they have rotations.
    return matrix_deck(matrix_constants_of(M), "2") +
           "ET,3,188\nSECTYPE,3,BEAM,CSOLID\nSECDATA,1\nTYPE,3\nSECNUM,3\nE,20,21\n";
  };
  Mat3 J;
  J << 5, 1, 0.5, 1, 7, -0.25, 0.5, -0.25, 9;
  Mat12 M = Mat12::Zero();
  M.diagonal() << 2, 2, 2, 3, 4, 5, 6, 6, 6, 0, 0, 0;
  M.block<3, 3>(9, 9) = J;
  const FeModel m = ansys_of(deck(M));
  ASSERT_EQ(m.masses.size(), 2u);
  EXPECT_EQ(m.node_ids[m.masses[0].node], 20);
  EXPECT_EQ(m.node_ids[m.masses[1].node], 21);
  EXPECT_EQ(m.masses[0].mass, 2.0);
  EXPECT_EQ(m.masses[1].mass, 6.0);
  EXPECT_LE((m.masses[0].J - Mat3(Vec3(3, 4, 5).asDiagonal())).norm(), 1e-14);
  const Mat3 R = Eigen::AngleAxisd(EIGEN_PI / 6, Vec3::UnitZ()).toRotationMatrix();
  EXPECT_LE((m.masses[1].J - R * J * R.transpose()).norm(), 1e-13);
  EXPECT_TRUE(m.springs.empty());
  Mat12 one = Mat12::Zero();
  one.diagonal().head<3>().setConstant(4.0);
  EXPECT_EQ(ansys_of(deck(one)).masses.size(), 1u);

  const std::string wrong = "a.cdb:40: unsupported";
  Mat12 bad = M;
  bad(1, 1) = 2.5;
  EXPECT_EQ(ansys_error(deck(bad)), wrong);
  bad = M;
  bad(0, 4) = bad(4, 0) = 0.5;
  EXPECT_EQ(ansys_error(deck(bad)), wrong);
  bad = M;
  bad(0, 6) = bad(6, 0) = 0.5;
  EXPECT_EQ(ansys_error(deck(bad)), wrong);
  bad = -M;
  EXPECT_EQ(ansys_error(deck(bad)), "a.cdb:40: out_of_range");
}

/// A node that only a spring turns keeps its inertia.
TEST(AnsysMatrices, InertiaOnASpring) {
  const FeModel m =
      ansys_of(matrix_deck("R,7\n") +
               "ET,3,14\nKEYOPT,3,2,4\nR,8,50\nET,4,21\nR,9,1,1,1,2,3,4\nTYPE,3\nREAL,8\nE,20,1\n"
               "TYPE,4\nREAL,9\nE,20\nE,2\n");
  ASSERT_EQ(m.masses.size(), 2u);
  EXPECT_EQ(m.masses[0].J.diagonal(), Vec3(2, 3, 4));
  EXPECT_TRUE(m.masses[1].J.isZero(0.0));
}

TEST(AnsysLayers, OfOneMaterial) {
  const std::string nodes =
      "N,1\nN,2,2\nN,3,2,1\nN,4,0,1\nN,5,0,0,1\nN,6,2,0,1\nN,7,2,1,1\nN,8,0,1,1\n";
  for (const char* type : {"ET,1,185\nKEYOPT,1,3,1\n", "ET,1,190\n"}) {
    const FeModel m = ansys_of(type + nodes + cdb_steel +
                               "MP,EX,2,7e4\nMP,PRXY,2,.33\nMP,DENS,2,2.7e-9\nSECTYPE,1,SHELL\n"
                               "SECDATA,.5,2\nSECDATA,0,1\nSECDATA,.5,2,45\nE,1,2,3,4,5,6,7,8\n");
    ASSERT_EQ(m.elements.size(), 1u);
    EXPECT_EQ(m.materials.at(m.elements[0].material).young, 7e4);
    EXPECT_EQ(m.elements[0].layup, -1);
    EXPECT_EQ(m.elements[0].type, FeElementType::hex8i);
  }
}

const std::string layer_materials =
    cdb_steel +
    "MP,EX,2,7e4\nMP,EY,2,9e3\nMP,EZ,2,8e3\nMP,PRXY,2,.3\nMP,PRYZ,2,.3\nMP,PRXZ,2,.25\n"
    "MP,GXY,2,5e3\nMP,GYZ,2,3e3\nMP,GXZ,2,4e3\nMP,DENS,2,1.6e-9\n";
const std::string layers_of_three =
    "SECTYPE,1,SHELL\nSECDATA,.25,2,30\nSECDATA,0,1\nSECDATA,1,,\nSECDATA,.75,2,-45,5\n"
    "SECOFFSET,MID\n";

TEST(AnsysLayers, OfSeveralMaterials) {
  struct Kind {
    const char* type;
    std::string nodes;
    FeElementType element;
  };
  const std::string corners =
      "N,1\nN,2,2\nN,3,2,1\nN,4,0,1\nN,5,0,0,1\nN,6,2,0,1\nN,7,2,1,1\nN,8,0,1,1\n";
  const std::string middles =
      "N,9,1\nN,10,2,.5\nN,11,1,1\nN,12,0,.5\nN,13,1,0,1\nN,14,2,.5,1\nN,15,1,1,1\n"
      "N,16,0,.5,1\nN,17,0,0,.5\nN,18,2,0,.5\nN,19,2,1,.5\nN,20,0,1,.5\n";
  const std::string all =
      "EN,1,1,2,3,4,5,6,7,8\nEMORE,9,10,11,12,13,14,15,16\n"
      "EMORE,17,18,19,20\n";
  for (const Kind& kind :
       {Kind{"ET,1,185\nKEYOPT,1,3,1\n", "E,1,2,3,4,5,6,7,8\n", FeElementType::hex8i},
        Kind{"ET,1,185\nKEYOPT,1,3,1\n", "E,1,2,3,3,5,6,7,7\n", FeElementType::wedge6},
        Kind{"ET,1,190\n", "E,1,2,3,4,5,6,7,8\n", FeElementType::hex8i},
        Kind{"ET,1,186\nKEYOPT,1,3,1\n", middles + all, FeElementType::hex20r},
        Kind{"ET,1,186\nKEYOPT,1,3,1\nKEYOPT,1,2,1\n", middles + all, FeElementType::hex20}}) {
    for (const bool turned : {false, true}) {
      const FeModel m =
          ansys_of(kind.type + corners + layer_materials + layers_of_three +
                   (turned ? "LOCAL,11,0,0,0,0,90\nCSYS,0\nESYS,11\n" : "") + kind.nodes);
      ASSERT_EQ(m.elements.size(), 1u);
      const FeElement& e = m.elements[0];
      EXPECT_EQ(e.type, kind.element);
      ASSERT_EQ(e.layup, 0);
      EXPECT_EQ(m.notes.at(0),
                "a.cdb: 1 solids have layers: each layer has the points of its element here, in "
                "ANSYS as many through its thickness as SECDATA gives");
      const std::vector<ShellPly>& plies = m.layups.at(0).plies;
      ASSERT_EQ(plies.size(), 3u);
      const double thickness[] = {0.25, 1.0, 0.75}, angle[] = {30, 0, -45};
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(plies[k].thickness, thickness[k]);
        EXPECT_NEAR(plies[k].angle * 180 / std::numbers::pi, angle[k], 1e-13);
        EXPECT_EQ(m.material_names.at(plies[k].material), k == 1 ? "1" : "2");
      }
      ASSERT_NO_THROW(validate(m));
      // The block is 1 thick, so the plies are halves of what the section says.
      const double mass =
          (kind.element == FeElementType::wedge6 ? 1.0 : 2.0) * (0.5 * 1.6e-9 + 0.5 * 7.85e-9);
      EXPECT_NEAR(volume_times_density(m), mass, 1e-12 * mass);
      // Axis 1 of the first ply: x, or y of the turned system, and 30 degrees.
      const NodalPly at = element_kernel(e.type).nodal_ply(gather(m, e), 0);
      const Mat3 R =
          Eigen::AngleAxisd((turned ? 120 : 30) * std::numbers::pi / 180.0, Vec3::UnitZ())
              .toRotationMatrix();
      const Mat6 D = turned_elasticity(*m.materials[plies[0].material].elasticity, R);
      EXPECT_LE((at.D - D).norm(), 1e-12 * D.norm());
    }
  }
}

}  // namespace
}  // namespace floatframe::test
