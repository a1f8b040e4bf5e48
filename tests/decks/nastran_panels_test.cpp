// Shear panels of Nastran: closed forms of Garvey's panel, rods along its edges, mass.
#include <gtest/gtest.h>

#include "decks/deck_text.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

constexpr double E_mod = 7e10, nu = 0.25, G = E_mod / (2 * (1 + nu)), t = 0.002;

std::string panel(const std::string& more = "") {
  return "GRID,1,,0.,0.,0.\nGRID,2,,.6,0.,0.\nGRID,3,,.6,.4,0.\nGRID,4,,0.,.4,0.\n"
         "CSHEAR,1,1,1,2,3,4\nPSHEAR,1,1,.002" +
         more + "\nMAT1,1,7.+10,,.25,2700.\n";
}

MatX panel_stiffness(const std::array<Vec3, 4>& p) {
  ElementInput in;
  for (std::size_t i = 0; i < 4; ++i) in.p[i] = p[i];
  in.material = {E_mod, nu, 2700.0};
  in.shell.thickness = t;
  EXPECT_EQ(shear4_kernel.error(in), "");
  MatX K;
  shear4_kernel.stiffness(in, K);
  return K;
}

/// The force of node 1 along its diagonal, squared, over the factor of K: L_13^2/4 (q/2 E) ...
double flexibility_of(const std::array<Vec3, 4>& p, double f1) {
  return f1 * f1 / panel_stiffness(p).block<3, 3>(0, 0).trace();
}

// A rectangle a x b: the force of a corner at unit flow is (a, b)/2, its flexibility a b/(G t).
TEST(NastranPanels, Rectangle) {
  const double a = .6, b = .4;
  const FeSystem system = assemble(valid_bdf(panel()));
  MatX K(system.K);
  VecX f(12);
  f << a, b, 0, a, -b, 0, -a, -b, 0, -a, b, 0;
  f /= 2;
  VecX rows(12);
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) rows(system.row(i, k)) = f(3 * i + k);
  EXPECT_LT((K - rows * rows.transpose() * G * t / (a * b)).norm(), 1e-12 * K.norm());
  // Lumped: a quarter at each corner.
  EXPECT_NEAR(system.M.coeff(0, 0), 2700 * a * b * t / 4, 1e-14);
}

// Parallelogram with the skew s = cot(angle): a b/(G t) (1 + 2 s^2/(1 + nu)). Turned in space.
TEST(NastranPanels, Parallelogram) {
  Random random(3);
  const double a = .6, b = .4, s = .35;
  const Mat3 R = random.rotation();
  const std::array<Vec3, 4> p{Vec3(0, 0, 0), R * Vec3(a, 0, 0), R * Vec3(a + s * b, b, 0),
                              R * Vec3(s * b, b, 0)};
  EXPECT_NEAR(flexibility_of(p, .5 * (p[2] - p[0]).norm()),
              a * b / (G * t) * (1 + 2 * s * s / (1 + nu)), 1e-12 * a * b / (G * t));
}

// Trapezoid with parallel sides: with the heights y_1 and y_3 of these from the point where the
// others meet and the slopes s, c of the others
//   A/(G t) (y_1/y_3)^2 (1 + 2/3 (s^2 + s c + c^2)/(1 + nu)).
TEST(NastranPanels, Trapezoid) {
  const double y1 = 1.1, y3 = .5, s = .4, c = -.15;
  const std::array<Vec3, 4> p{Vec3(c * y1, -y1, 0), Vec3(s * y1, -y1, 0), Vec3(s * y3, -y3, 0),
                              Vec3(c * y3, -y3, 0)};
  const double area = .5 * (s - c) * (y1 * y1 - y3 * y3);
  // f_1 = L_12/2 (e_12 x e_14)/(d_13 x e_14)
  const Vec3 d = (p[2] - p[0]).normalized(), e = (p[3] - p[0]).normalized();
  const double f1 = .5 * (p[1] - p[0]).cross(e)(2) / d.cross(e)(2);
  const double expected =
      area / (G * t) * (y1 / y3) * (y1 / y3) * (1 + 2. / 3 * (s * s + s * c + c * c) / (1 + nu));
  EXPECT_NEAR(flexibility_of(p, f1), expected, 1e-12 * expected);
  // The same panel from another corner, and reversed.
  const MatX K = panel_stiffness(p);
  const MatX turned = panel_stiffness({p[1], p[2], p[3], p[0]}),
             reversed = panel_stiffness({p[0], p[3], p[2], p[1]});
  EXPECT_LT((K.topLeftCorner<3, 3>() - turned.bottomRightCorner<3, 3>()).norm(), 1e-11 * K.norm());
  EXPECT_LT((K.topLeftCorner<3, 3>() - reversed.topLeftCorner<3, 3>()).norm(), 1e-11 * K.norm());
}

// A general quadrilateral: the integral in closed form, which has logarithms (nu = 0.25).
TEST(NastranPanels, Quadrilateral) {
  const std::array<Vec3, 4> p{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(.8, .7, 0), Vec3(.1, .5, 0)};
  const Vec3 d = (p[2] - p[0]).normalized(), e = (p[3] - p[0]).normalized();
  const double f1 = .5 * (p[1] - p[0]).cross(e)(2) / d.cross(e)(2),
               expected = 1.1274018656452662 / (G * t);
  EXPECT_NEAR(flexibility_of(p, f1), expected, 1e-12 * expected);
}

// A general quadrilateral is between trapezoids that it goes over to.
TEST(NastranPanels, QuadrilateralApproachesATrapezoid) {
  const auto at = [](double h) {
    return panel_stiffness({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(.8, .5 + h, 0), Vec3(.1, .5, 0)});
  };
  const MatX K = at(0.0);
  const double first = (at(1e-4) - K).norm(), second = (at(2e-4) - K).norm();
  EXPECT_NEAR(second / first, 2.0, 1e-2);
  EXPECT_LT(first, 1e-3 * K.norm());
}

// F1 up to 1.01: the rods share the panel; F2 above: half a width of F2 t each.
TEST(NastranPanels, RodsAlongTheEdges) {
  const FeModel m = valid_bdf(panel(",.5,1.,20."));
  ASSERT_EQ(m.elements.size(), 5u);
  for (int k = 0; k < 4; ++k) {
    const FeElement& rod = m.elements[static_cast<std::size_t>(k)];
    EXPECT_EQ(rod.type, FeElementType::rod2);
    EXPECT_EQ(rod.nodes[0], k);
    EXPECT_EQ(rod.nodes[1], (k + 1) % 4);
    EXPECT_NEAR(m.sections[static_cast<std::size_t>(rod.section)].A,
                k % 2 == 0 ? .5 * .4 * t : .5 * 20 * t * t, 1e-15);
  }
  // Pulled along 12 the whole panel carries: E t b/a.
  const FeSystem system = assemble(m);
  VecX u = VecX::Zero(system.size());
  u(system.row(1, 0)) = u(system.row(2, 0)) = 1.0;
  EXPECT_NEAR(u.dot(system.K * u), E_mod * t * .4 / .6, 1e-6 * E_mod * t);
  u.setZero();
  for (int i = 0; i < 4; ++i) u(system.row(i, 2)) = 1.0;
  EXPECT_NEAR(u.dot(system.M * u), .24 * (2700 * t + .5), 1e-12);
}

TEST(NastranPanels, Errors) {
  EXPECT_EQ(invalid_bdf(panel(",,-1.")), "arm.bdf:6: out_of_range");
  std::string text = panel();
  text.replace(text.find("1,2,3,4"), 7, "1,3,2,4");
  EXPECT_EQ(invalid_bdf(text), "arm.bdf:5: geometry");
  text = panel();
  text.replace(text.find("MAT1,1,7.+10,,.25"), 17, "MAT8,1,7.+10,7.+10,.25,2.+10");
  EXPECT_EQ(invalid_bdf(text), "arm.bdf:6: wrong_value");
}

}  // namespace
}  // namespace floatframe::test
