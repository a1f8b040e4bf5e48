// Bars of Nastran: sections against integrals over their outlines, offsets and pins against closed
// forms and against the same part with nodes of its own, BAROR, tapers.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <string>
#include <vector>

#include "decks/deck_text.hpp"
#include "decks/section_outline.hpp"

namespace floatframe::test {
namespace {

struct NamedSection {
  const char* card;                      ///< type and dimensions
  std::vector<SectionOutline> outlines;  ///< z, y
  double J;
};

const std::vector<NamedSection>& named_sections() {
  static const std::vector<NamedSection> sections = {
      {"BAR\n,2.,3.", {{{0, 0}, {2, 0}, {2, 3}, {0, 3}}}, 0},
      {"BOX\n,4.,6.,.5,.25",
       {{{0, 0}, {4, 0}, {4, 6}, {0, 6}}, {{.25, .5}, {.25, 5.5}, {3.75, 5.5}, {3.75, .5}}},
       4 * 20.625 * 20.625 / (2 * 3.75 / .5 + 2 * 5.5 / .25)},
      {"BOX1\n,4.,6.,.5,.6,.2,.3",
       {{{0, 0}, {4, 0}, {4, 6}, {0, 6}}, {{.2, .6}, {.2, 5.5}, {3.7, 5.5}, {3.7, .6}}},
       4 * std::pow(3.75 * 5.45, 2) / (3.75 / .5 + 3.75 / .6 + 5.45 / .2 + 5.45 / .3)},
      {"I\n,8.,4.,6.,.5,.7,.9",
       mirrored({{2, 0}, {2, .7}, {.25, .7}, {.25, 7.1}, {3, 7.1}, {3, 8}}),
       (4 * .343 + 6.4 * .125 + 6 * .729) / 3},
      {"I1\n,3.,.5,5.,6.",
       mirrored({{1.75, 0}, {1.75, .5}, {.25, .5}, {.25, 5.5}, {1.75, 5.5}, {1.75, 6}}),
       (3.5 + 3.5 + 5) * .125 / 3},
      {"T\n,4.,5.,.6,.5",
       {{{-.25, 0}, {.25, 0}, {.25, 4.4}, {2, 4.4}, {2, 5}, {-2, 5}, {-2, 4.4}, {-.25, 4.4}}},
       (4 * .216 + 4.4 * .125) / 3},
      {"T1\n,4.,5.,.6,.5",
       {{{-5, -.25}, {0, -.25}, {0, -2}, {.6, -2}, {.6, 2}, {0, 2}, {0, .25}, {-5, .25}}},
       (4 * .216 + 5 * .125) / 3},
      {"T2\n,4.,5.,.6,.5",
       {{{-2, 0}, {2, 0}, {2, .6}, {.25, .6}, {.25, 5}, {-.25, 5}, {-.25, .6}, {-2, .6}}},
       (4 * .216 + 4.4 * .125) / 3},
      {"CHAN\n,3.,6.,.4,.5",
       {{{0, 0}, {3, 0}, {3, .5}, {.4, .5}, {.4, 5.5}, {3, 5.5}, {3, 6}, {0, 6}}},
       (6 * .064 + 2 * 2.6 * .125) / 3},
      {"CHAN1\n,3.,.4,5.,6.",
       {{{0, 0}, {3.4, 0}, {3.4, .5}, {.4, .5}, {.4, 5.5}, {3.4, 5.5}, {3.4, 6}, {0, 6}}},
       (6 * .064 + 2 * 3 * .125) / 3},
      {"CHAN2\n,.4,.5,3.,6.",
       {{{0, 0}, {6, 0}, {6, 3}, {5.6, 3}, {5.6, .5}, {.4, .5}, {.4, 3}, {0, 3}}},
       (6 * .125 + 2 * 2.5 * .064) / 3},
      {"Z\n,2.,.4,5.,6.",
       {{{1.6, 0}, {4, 0}, {4, .5}, {2, .5}, {2, 6}, {-.4, 6}, {-.4, 5.5}, {1.6, 5.5}}},
       (6 * .064 + 2 * 2 * .125) / 3},
      {"H\n,3.,1.,6.,.5", mirrored({{1.5, 2.75}, {1.5, 0}, {2, 0}, {2, 6}, {1.5, 6}, {1.5, 3.25}}),
       (2 * 6 + 3) * .125 / 3},
      {"CROSS\n,3.,.5,6.,.4",
       mirrored({{.25, -3}, {.25, -.2}, {1.75, -.2}, {1.75, .2}, {.25, .2}, {.25, 3}}),
       (6 * .125 + 3 * .064) / 3},
      {"HAT\n,4.,.5,6.,2.", mirrored({{2.5, 3.5}, {2.5, 0}, {5, 0}, {5, .5}, {3, .5}, {3, 4}}),
       (6 + 2 * 3 + 2 * 2.5) * .125 / 3},
      {"L\n,4.,6.,.5,.4",
       {{{0, 0}, {4, 0}, {4, .5}, {.4, .5}, {.4, 6}, {0, 6}}},
       (4 * .125 + 5.5 * .064) / 3}};
  return sections;
}

const std::string pin_deck =
    "GRID,1,,0.,0.,0.\nGRID,2,,10.,0.,0.\nMAT1,1,100.,,.25,2.\nCBAR,1,1,1,2,0.,1.,0.\n";

// Section axes y and z are the element's Y and Z here; the section's own y is the reference vector.
TEST(NastranBars, SectionsAgainstIntegrals) {
  for (const NamedSection& n : named_sections()) {
    const FeModel model = read_bdf(pin_deck + "PBARL,1,1,," + n.card + "\n");
    const BeamSection& s = model.sections.at(0);
    const OutlineSums o = outline_sums(n.outlines);
    const double A = o.A, I1 = o.Iyy, I2 = o.Izz, I12 = o.Iyz;
    const Vec3 v = model.elements.at(0).reference.normalized();
    const double c = v(1), b = v(2);
    EXPECT_NEAR(s.A, A, 1e-12 * A) << n.card;
    EXPECT_NEAR(s.Iz, c * c * I1 + b * b * I2 + 2 * b * c * I12, 1e-12 * I1) << n.card;
    EXPECT_NEAR(s.Iy, b * b * I1 + c * c * I2 - 2 * b * c * I12, 1e-12 * I1) << n.card;
    EXPECT_NEAR((c * c - b * b) * I12 - b * c * (I1 - I2), 0.0, 1e-12 * I1) << n.card;
    if (n.J > 0.0) {
      EXPECT_NEAR(s.J, n.J, 1e-12 * n.J) << n.card;
    }
  }
}

TEST(NastranBars, TurnOfThePrincipalAxes) {
  const FeModel model = read_bdf(pin_deck + "PBAR,1,1,1.,5.,4.,1.\n,,,,,,,,\n,,,2.\n");
  const BeamSection& s = model.sections.at(0);
  EXPECT_NEAR(s.Iz, 4.5 + std::sqrt(4.25), 1e-12);
  EXPECT_NEAR(s.Iy, 4.5 - std::sqrt(4.25), 1e-12);
  const Vec3 v = model.elements.at(0).reference;
  EXPECT_NEAR(std::atan2(v(2), v(1)), 0.5 * std::atan2(4.0, 1.0), 1e-12);
}

/// Displacement of dof (node, axis) under a unit force there, with node 0 held.
double compliance(const FeModel& model, int node, int axis) {
  const FeSystem system = assemble(model);
  std::vector<int> rows;
  for (int i = 0; i < system.size(); ++i) {
    if (system.dofs[i].node != 0) rows.push_back(i);
  }
  const MatX K = MatX(system.K)(rows, rows);
  VecX f = VecX::Zero(K.rows());
  Eigen::Index at = -1;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Dof d = system.dofs[rows[i]];
    if (d.node == node && d.axis == axis) at = static_cast<Eigen::Index>(i);
  }
  f(at) = 1.0;
  return VecX(Eigen::CompleteOrthogonalDecomposition<MatX>(K).solve(f))(at);
}

TEST(NastranBars, OffsetAgainstClosedForm) {
  const double E = 100, A = .1, I = .2, L = 10, h = 2;
  const std::string property = "PBAR,1,1,.1,.2,.3,.4\n";
  std::string offset = pin_deck + property;
  offset.insert(offset.find("0.,1.,0.\n") + 8, "\n,,,0.,2.,0.,0.,2.,0.");
  const FeModel model = read_bdf(offset);
  EXPECT_EQ(model.nodes(), 4);
  // The axial force bends the bar with F h.
  EXPECT_NEAR(compliance(model, 1, 0), L / (E * A) + h * h * L / (E * I), 1e-9);
  EXPECT_NEAR(compliance(read_bdf(pin_deck + property), 1, 0), L / (E * A), 1e-12);
  EXPECT_NEAR(compliance(model, 1, 1), L * L * L / (3 * E * I), 1e-9);
  // Offsets in the axes of the element, of a bar along Y.
  const std::string upright =
      "GRID,1,,0.,0.,0.\nGRID,2,,0.,10.,0.\nMAT1,1,100.,,.25,2.\nPBAR,1,1,.1,.2,.3,.4\n"
      "CBAR,1,1,1,2,0.,0.,1.,";
  const FeModel element = read_bdf(upright + "GOO\n,,,0.,2.,0.,0.,2.,0.\n");
  EXPECT_LT((element.positions[2] - Vec3(0, 0, 2)).norm(), 1e-12);
  EXPECT_LT((element.positions[3] - Vec3(0, 10, 2)).norm(), 1e-12);
  EXPECT_NEAR(compliance(element, 1, 1), L / (E * A) + h * h * L / (E * I), 1e-9);
  EXPECT_EQ(bdf_error(upright + "GXO\n"), "arm.bdf:5: wrong_value");
}

TEST(NastranBars, PinsAgainstClosedForm) {
  const double E = 100, I1 = .2, I2 = .3, L = 10;
  const std::string property = "PBAR,1,1,.1,.2,.3,.4\n";
  const auto pinned = [&](const std::string& pa, const std::string& pb) {
    std::string deck = pin_deck + property;
    // A second bar holds the rotations of node 2.
    deck += "GRID,3,,20.,0.,0.\nCBAR,2,1,2,3,0.,1.,0.\n";
    return read_bdf(deck.insert(deck.find("0.,1.,0.\n") + 8, "\n," + pa + "," + pb));
  };
  // Two bars between held ends: the one that is pinned at the middle node carries 3EI/L^3.
  const auto middle = [&](const FeModel& model, int axis) {
    const FeSystem system = assemble(model);
    std::vector<int> rows;
    for (int i = 0; i < system.size(); ++i) {
      const Dof d = system.dofs[i];
      if (d.node != 0 && d.node != 2 && (d.node != 1 || d.axis < 3)) rows.push_back(i);
    }
    const MatX K = MatX(system.K)(rows, rows);
    const MatX C = K.inverse();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Dof d = system.dofs[rows[i]];
      if (d.node == 1 && d.axis == axis) return 1.0 / C(Eigen::Index(i), Eigen::Index(i));
    }
    return 0.0;
  };
  const double k1 = E * I1 / (L * L * L), k2 = E * I2 / (L * L * L);
  EXPECT_NEAR(middle(pinned("", "6"), 1), (12 + 3) * k1, 1e-9 * k1);
  EXPECT_NEAR(middle(pinned("", "6"), 2), (12 + 12) * k2, 1e-9 * k2);
  EXPECT_NEAR(middle(pinned("", "5"), 2), (12 + 3) * k2, 1e-9 * k2);
  EXPECT_NEAR(middle(pinned("", "456"), 2), (12 + 3) * k2, 1e-9 * k2);
  EXPECT_NEAR(middle(pinned("56", "56"), 1), 12 * k1, 1e-9 * k1);
  EXPECT_NEAR(middle(pinned("", "2"), 1), 12 * k1, 1e-9 * k1);
  EXPECT_NEAR(middle(pinned("456", "456"), 0), 2 * E * .1 / L, 1e-12);
  EXPECT_NEAR(middle(pinned("1", "1"), 0), E * .1 / L, 1e-12);
}

/// A bar across space, pinned about its own axes: the same in the axes of the part.
TEST(NastranBars, PinsTurnWithTheBar) {
  const std::string rest = "MAT1,1,100.,,.25,2.\nPBAR,1,1,.1,.2,.3,.4\n";
  const FeModel straight = read_bdf(
      "GRID,1,,0.,0.,0.\nGRID,2,,3.,0.,0.\nGRID,3,,3.,4.,0.\nCBAR,1,1,1,2,0.,1.,0.\n,,25\n"
      "CBAR,2,1,2,3,1.,0.,0.\n" +
      rest);
  // Turned by rotating (x, y, z) to (y, z, x) and then by 30 degrees about z.
  const FeModel turned = read_bdf(
      "CORD2R,5,,0.,0.,0.,1.,0.,0.\n,0.,.86602540378443865,.5\n"
      "GRID,1,5,0.,0.,0.\nGRID,2,5,3.,0.,0.\nGRID,3,5,3.,4.,0.\nGRDSET,,,,,,5\n"
      "CBAR,1,1,1,2,0.,1.,0.\n,,25\nCBAR,2,1,2,3,1.,0.,0.\n" +
      rest);
  // Node 1 held: the force at node 3 along its own axes moves it as far.
  const FeSystem s = assemble(straight), t = assemble(turned);
  const auto flexibility = [](const FeSystem& system) {
    std::vector<int> rows;
    for (int i = 0; i < system.size(); ++i) {
      if (system.dofs[i].node != 0) rows.push_back(i);
    }
    const MatX C =
        Eigen::CompleteOrthogonalDecomposition<MatX>(MatX(system.K)(rows, rows)).pseudoInverse();
    Mat3 out = Mat3::Zero();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t j = 0; j < rows.size(); ++j) {
        const Dof a = system.dofs[rows[i]], b = system.dofs[rows[j]];
        if (a.node == 2 && b.node == 2 && a.axis < 3 && b.axis < 3)
          out(a.axis, b.axis) = C(Eigen::Index(i), Eigen::Index(j));
      }
    }
    return out;
  };
  Mat3 R;
  R.col(2) = Vec3(1, 0, 0);
  R.col(0) = Vec3(0, std::sqrt(0.75), 0.5);
  R.col(1) = R.col(2).cross(R.col(0));
  const Mat3 C = flexibility(s), D = flexibility(t);
  EXPECT_LT((R * C * R.transpose() - D).norm(), 1e-9 * C.norm());
}

TEST(NastranBars, DefaultsOfBars) {
  const std::string nodes =
      "GRID,1,,0.,0.,0.\nGRID,2,,10.,0.,0.\nMAT1,1,100.,,.25,2.\nPBAR,7,1,.1,.2,.3,.4\n";
  const FeModel model = read_bdf(nodes + "CBAR,1,,1,2\nBAROR,,7,,,0.,0.6,0.8\n");
  EXPECT_EQ(model.elements.at(0).reference, Vec3(0, 0.6, 0.8));
  EXPECT_EQ(model.element_sets.count("PID 7"), 1u);
  EXPECT_EQ(bdf_error(nodes + "CBAR,1,,1,2\nBEAMOR,,7,,,0.,0.6,0.8\n"), "arm.bdf:5: missing");
  EXPECT_EQ(bdf_error(nodes + "CBAR,1,,1,2\nBAROR,,7,,,0.,1.,0.\nBAROR,,7,,,0.,1.,0.\n"),
            "arm.bdf:7: duplicate");
}

// Bars without bending stiffness are rods, with torsion if they have a J.
TEST(NastranBars, BarsWithoutBending) {
  const std::string nodes =
      "GRID,1,,0.,0.,0.\nGRID,2,,10.,0.,0.\nMAT1,1,100.,,.25,2.\n"
      "CBEAM,9,9,1,2,0.,1.,0.\nPBEAM,9,1,1.,2.,3.,,4.\n";
  const auto same = [&](const std::string& bar, const std::string& rod) {
    const FeModel a = read_bdf(nodes + bar), b = read_bdf(nodes + rod);
    const FeSystem x = assemble(a), y = assemble(b);
    ASSERT_EQ(x.size(), y.size());
    EXPECT_LT((x.K - y.K).norm(), 1e-14 * y.K.norm()) << bar;
    EXPECT_LT((x.M - y.M).norm(), 1e-14 * y.M.norm()) << bar;
  };
  same("CBAR,1,1,1,2,0.,1.,0.\nPBAR,1,1,.5\n", "CROD,1,1,1,2\nPROD,1,1,.5\n");
  same("CBAR,1,1,1,2,0.,1.,0.\n,456,56\nPBAR,1,1,.5,,,.3,.7\n",
       "CROD,1,1,1,2\nPROD,1,1,.5,.3,,.7\n");
  same("CBEAM,1,1,1,2,0.,1.,0.\nPBEAM,1,1,.5,0.,0.,,.3\n", "CROD,1,1,1,2\nPROD,1,1,.5,.3\n");
  const FeModel model = read_bdf(nodes + "CBAR,1,1,1,2,0.,1.,0.\nPBAR,1,1,.5,,,.3\n");
  EXPECT_EQ(model.notes.at(0),
            "arm.bdf:7: PBAR 1: without I1, I2 its elements are rods with torsion");
  // Beside the line of its nodes: a force of 1 turns them, which the beam resists.
  const FeModel beside =
      read_bdf(nodes + "CBAR,1,1,1,2,0.,1.,0.\n,,,0.,2.,0.,0.,2.,0.\nPBAR,1,1,.5\n");
  const double axial = 10. / 100, k = 100 * .5 / 10, turn = 10. / (100 * 2.);
  // K of u and rz of node 2, rz of the other plane's stiffness EI/L: with f = k (u - 2 rz)
  Eigen::Matrix2d K;
  K << 1 / axial + k, -2 * k, -2 * k, 4 * k + 1 / turn;
  EXPECT_NEAR(compliance(beside, 1, 0), K.inverse()(0, 0), 1e-9);
}

// Beside a beam that holds all rotations: as the beam with second moments that are nearly zero.
TEST(NastranBars, BarsWithoutSomeOfTheirStiffness) {
  const std::string nodes =
      "GRID,1,,0.,0.,0.\nGRID,2,,3.,4.,12.\nMAT1,1,100.,30.,.25,2.\n"
      "CBEAM,9,9,1,2,0.,1.,0.\nPBEAM,9,1,1.,2.,3.,,4.\nCBAR,1,1,1,2,1.,1.,0.\n";
  for (const std::string shear : {"", "\n,\n,.5,.4"}) {
    for (const auto& [weak, full] :
         {std::pair{".5,.2,,", ".5,.2,1.-13,1.-13"}, std::pair{".5,,.2,.3", ".5,1.-13,.2,.3"},
          std::pair{".5,.2,.3,", ".5,.2,.3,1.-13"}}) {
      const FeModel a = read_bdf(nodes + "PBAR,1,1," + weak + shear + "\n"),
                    b = read_bdf(nodes + "PBAR,1,1," + full + shear + "\n");
      const MatX x = assemble(a).K, y = assemble(b).K;
      ASSERT_EQ(x.rows(), y.rows());
      EXPECT_LT((x - y).norm(), 1e-11 * y.norm()) << weak;
      EXPECT_EQ(a.elements.at(1).type, FeElementType::rod2);
    }
  }
  // Alone: a supported beam of two, 48 EI/l^3; rotations are condensed.
  const std::string row =
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,4.,0.,0.\nMAT1,1,100.,,.25,2.\n"
      "CBAR,1,1,1,2,0.,1.,0.\nCBAR,2,1,2,3,0.,1.,0.\nPBAR,1,1,.5,.2\n";
  const FeModel model = read_bdf(row);
  const FeSystem system = assemble(model);
  ASSERT_EQ(system.size(), 9);
  EXPECT_NEAR(system.K.coeff(system.row(1, 1), system.row(1, 1)), 48 * 100 * .2 / 64, 1e-9);
  EXPECT_EQ(model.notes.at(0),
            "arm.bdf:7: PBAR 1: without I2, J its elements are rods and springs that bend as the "
            "beam does (without rotary inertia, stress and stress stiffness of bending)");
  EXPECT_EQ(bdf_error(nodes + "PBAR,1,1,.5,.2,-.3,.4\n"), "arm.bdf:7: out_of_range");
  std::string pinned = nodes + "PBAR,1,1,.5,.2,.3\n";
  EXPECT_EQ(bdf_error(pinned.insert(pinned.find("PBAR"), ",45\n")), "arm.bdf:8: out_of_range");
}

}  // namespace
}  // namespace floatframe::test
