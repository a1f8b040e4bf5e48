// Integrals of points with mass always pass; what no distribution of mass has does not.
#include "floatframe/body/check_invariants.hpp"

#include <gtest/gtest.h>

#include "floatframe/fe/bar_frame.hpp"
#include "floatframe/reduction/reduction.hpp"
#include "support/iltis_parts.hpp"
#include "support/point_masses.hpp"

namespace floatframe::test {
namespace {

/// Masses at random points with random shapes, all lengths times `size`, far from the origin by
/// `away`. Lines: all points on one line.
FlexibleBody points(Random& random, int nm, double size, double away, bool line) {
  FlexibleBody body;
  PointMasses masses = random_point_masses(random, 9, nm);
  const Vec3 direction = random.vec3();
  for (Vec3& p : masses.p) p = size * (line ? Vec3(p.x() * direction) : p) + Vec3::Constant(away);
  if (nm > 1)
    for (Mat3X& X : masses.X) X.col(1).setZero();  // moves no mass
  body.invariants = integrals_of(masses, nm);
  const MatX A = random.matrix(nm, nm);
  body.K = 1e5 * (A * A.transpose() + MatX::Identity(nm, nm));
  body.D = A * A.transpose();
  return body;
}

std::string errors(const FlexibleBody& body, InvariantSource source = InvariantSource::integrals) {
  std::string text;
  for (const InvariantError& f : check_invariants(body, source))
    text += (text.empty() ? "" : "\n") + f.quantity + ": " + f.sentence;
  return text;
}

TEST(CheckInvariants, AnyDistributionOfMassPasses) {
  Random random(3);
  for (const int nm : {0, 1, 2, 6, 20})
    for (const double size : {1e-4, 1.0, 1e4})
      for (const double away : {0.0, 1.0, 100.0})
        for (const bool line : {false, true}) {
          const FlexibleBody body = points(random, nm, size, away * size, line);
          for (const auto source :
               {InvariantSource::integrals, InvariantSource::rotary, InvariantSource::parameters})
            EXPECT_EQ(errors(body, source), "") << nm << ' ' << size << ' ' << away << ' ' << line;
        }
}

TEST(CheckInvariants, BarsOfAllMassModelsPass) {
  for (const MassModel model : {MassModel::isoparametric, MassModel::six_dof, MassModel::hermite}) {
    ReductionOptions options;
    options.clamped = {{"inner", all_dofs}};
    options.interfaces = {{"outer", all_dofs}};  // torsion moves no mass
    options.normal_modes = 3;
    options.mass_model = model;
    options.damping = 0.01;
    EXPECT_EQ(errors(reduce(build_bar_frame(straight_bar(1.0, 0.02, 4)), options)), "");
  }
}

TEST(CheckInvariants, EachMistakeHasItsSentence) {
  Random random(5);
  const FlexibleBody good = points(random, 3, 1.0, 0.0, false);
  const auto with = [&](const auto& change, InvariantSource source = InvariantSource::integrals) {
    FlexibleBody body = good;
    change(body, body.invariants);
    return errors(body, source);
  };
  using B = FlexibleBody;
  using V = InertiaInvariants;
  EXPECT_EQ(with([](B&, V& v) { v.m = 0.0; }), "m: found 0, expected a positive mass [kg]");
  EXPECT_EQ(with([](B&, V& v) { v.S(0, 0) = NAN; }), "S: found a number that is not finite");
  EXPECT_EQ(with([](B&, V& v) { v.P_u.setZero(); }).substr(0, 56),
            "P_u: found zeros, expected the second moments of a body ");
  EXPECT_EQ(with([](B&, V& v) { v.P_u(0, 1) += 1.0; }).substr(0, 10), "P_u: found");
  EXPECT_TRUE(with([](B&, V& v) {
                v.m_u *= 100.0;
              }).starts_with("P_u: found second moments about the centre of mass down to -"));
  EXPECT_TRUE(
      with([](B&, V& v) { v.Sij[0][0] *= -1.0; }).starts_with("S11: found the modal mass -"));
  EXPECT_EQ(with([](B&, V& v) { v.Sij[1][0] *= 2.0; }),
            "S21: found another matrix than the transpose of S12, expected the same");
  EXPECT_EQ(with([](B&, V& v) { v.S *= 10.0; }).substr(0, 27), "S: the integrals m, m_u, P_");
  EXPECT_EQ(with([](B& b, V&) { b.K.setZero(); }),
            "K: found the stiffness 0 of mode 1, expected a positive number (rigid motions are not "
            "among the modes)");
  EXPECT_EQ(with([](B& b, V&) { b.K(0, 1) = b.K(1, 0) = 10.0 * b.K.maxCoeff(); }).substr(0, 56),
            "K: found a combination of modes of negative stiffness (s");
  EXPECT_EQ(with([](B& b, V&) { b.D = -b.D.eval(); }).substr(0, 53),
            "D: found a combination of modes that gains energy (sm");
  // Rotary inertia of nodes: what is no distribution of mass may have a positive M(0).
  const auto twisted = [](B&, V& v) {
    v.Sij[0][1] *= 3.0;
    v.Sij[1][0] *= 3.0;
  };
  EXPECT_EQ(with(twisted, InvariantSource::rotary), "");
  EXPECT_NE(with(twisted), "");
  EXPECT_EQ(with([](B& b, V&) { b.K.setZero(); }, InvariantSource::rotary).substr(0, 34),
            "K: found the stiffness 0 of mode 1");
  EXPECT_EQ(with([](B&, V& v) { v.S *= 10.0; }, InvariantSource::rotary).substr(0, 49),
            "S: the mass matrix at zero deformation is not pos");
  // Bodies of other origin: no stiffness, second-order terms that are an estimate.
  const auto estimate = [](B& b, V& v) {
    b.K.setZero();
    const MatX M = v.Sij[0][0] + v.Sij[1][1] + v.Sij[2][2];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) v.Sij[i][j] = i == j ? MatX(M / 3.0) : MatX::Zero(3, 3);
  };
  EXPECT_EQ(with(estimate, InvariantSource::parameters), "");
  EXPECT_EQ(with([](B&, V& v) { v.S *= 10.0; }, InvariantSource::parameters).substr(0, 49),
            "S: the mass matrix at zero deformation is not pos");
  // Sizes that do not fit are the business of others.
  EXPECT_EQ(with([](B& b, V&) { b.K.resize(2, 2); }), "");
}

}  // namespace
}  // namespace floatframe::test
