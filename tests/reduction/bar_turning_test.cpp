// What turns with bars - sections, point masses with inertia, the twist of second order - against
// sections that finite rotations carry along the bent bar; and what does not take memory.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/fe/bar_frame.hpp"
#include "floatframe/inertia/inertia_terms.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/reduction/following_frame.hpp"
#include "floatframe/reduction/reduction.hpp"
#include "support/iltis_parts.hpp"
#include "support/random_body.hpp"
#include "support/reference_json.hpp"

namespace floatframe::test {
namespace {

BarFrame flat_bar(int elements) {
  BarFrame frame = straight_bar(1.0, 0.02, elements);
  frame.bars[0].section = BeamSection::rectangle(0.06, 0.02);
  frame.bars[0].reference = Vec3::UnitY();
  return frame;
}

ReductionOptions bending(int modes, bool section_inertia = true) {
  ReductionOptions options;
  options.clamped = {{"inner", all_dofs}};
  options.interfaces = {{"outer", 6u}};
  options.normal_modes = modes;
  options.mass_model = MassModel::hermite;
  options.section_inertia = section_inertia;
  return options;
}

/// Sections of the bar along its bent axis: the first one stays, each next one is turned by the
/// least rotation that takes its tangent along, so that the bar has no twist.
struct TurnedSections {
  FeModel model;
  MatX X;

  /// Calls use(J dx, R) of all of them.
  template <class Use>
  void each(const VecX& y, const Use& use) const {
    constexpr int parts = 20;
    Mat3 R = Mat3::Identity();
    Vec3 t = Vec3::UnitX();
    for (const FeElement& e : model.elements) {
      const ElementInput in = gather(model, e);
      const BentBeam beam(in, e, X);
      const Vec3 own =
          in.material.density * Vec3(in.section.Iy + in.section.Iz, in.section.Iy, in.section.Iz);
      const Mat3 J = beam.T * own.asDiagonal() * beam.T.transpose();
      for (int k = 0; k <= 2 * parts; ++k) {
        const VecX theta = beam.T * beam.rotation(k / (2.0 * parts)) * y;
        const Vec3 next = (Vec3::UnitX() + Vec3(0.0, theta[2], -theta[1])).normalized();
        const Vec3 c = t.cross(next);
        const double sine = c.norm();
        if (sine > 0.0) R = rotation_exp(c / sine * std::asin(sine)) * R;
        t = next;
        const double simpson = k == 0 || k == 2 * parts ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
        use(Mat3(J * (simpson * beam.L / (6.0 * parts))), R);
      }
    }
  }
  /// int R J R^T dx.
  Mat3 inertia(const VecX& y) const {
    Mat3 sum = Mat3::Zero();
    each(y, [&](const Mat3& J, const Mat3& R) { sum += R * J * R.transpose(); });
    return sum;
  }
  /// Angular momentum of the sections at rates ydot.
  Vec3 momentum(const VecX& y, const VecX& ydot) const {
    const double h = 1e-4;
    std::vector<Mat3> ahead, behind;
    each(y + h * ydot, [&](const Mat3&, const Mat3& R) { ahead.push_back(R); });
    each(y - h * ydot, [&](const Mat3&, const Mat3& R) { behind.push_back(R); });
    Vec3 sum = Vec3::Zero();
    std::size_t k = 0;
    each(y, [&](const Mat3& J, const Mat3& R) {
      const Mat3 spin = (ahead[k] - behind[k]) / (2.0 * h) * R.transpose();
      ++k;
      const Vec3 w(spin(2, 1) - spin(1, 2), spin(0, 2) - spin(2, 0), spin(1, 0) - spin(0, 1));
      sum += R * J * R.transpose() * (0.5 * w);
    });
    return sum;
  }
};

TEST(BarTurning, SectionsOfABarBentInTwoPlanes) {
  // The rotary part of the inertia terms to second order (M_rr) and first order (M_rf).
  const FeModel model = build_bar_frame(flat_bar(4));
  const MatX X = craig_bampton_modes(model, bending(2)).X;
  const auto reduced = [&](bool section_inertia) {
    ReductionOptions options = bending(2, section_inertia);
    options.basis = X;
    return reduce(model, options);
  };
  const FlexibleBody with = reduced(true), without = reduced(false);
  ASSERT_TRUE(with.turning);
  EXPECT_FALSE(without.turning);
  EXPECT_TRUE(with.turning->nodes.empty());
  const TurnedSections sections{model, X};
  Random random(5);
  // Tips move by like parts of the length.
  VecX y = random.vector(static_cast<int>(X.cols())),
       ydot = random.vector(static_cast<int>(y.size()));
  const Eigen::Index tip = 6 * model.find_node("outer");
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    const double slope = X.col(k).segment<6>(tip).norm() + X.col(k).cwiseAbs().maxCoeff();
    y[k] /= slope;
    ydot[k] /= slope;
  }
  const auto difference = [&](double size) {
    BodyMotion m;
    m.y = size * y;
    const MatX rotary = relative_preprocessing(with, m).M - relative_preprocessing(without, m).M;
    return std::pair(
        (rotary.block<3, 3>(3, 3) - sections.inertia(m.y)).norm(),
        (rotary.block(3, 6, 3, y.size()) * ydot - sections.momentum(m.y, ydot)).norm());
  };
  const auto [inertia, momentum] = difference(3e-2);
  const auto [inertia_small, momentum_small] = difference(3e-3);
  EXPECT_GT(std::log10(inertia / inertia_small), 2.8);
  EXPECT_GT(std::log10(momentum / momentum_small), 1.8);
  // Without the twist angular momentum about the axis would be wrong in first order.
  BodyMotion m;
  m.y = 3e-3 * y;
  const double about_axis = sections.momentum(m.y, ydot)[0];
  EXPECT_GT(std::abs(about_axis), 30.0 * momentum_small);
}

TEST(BarTurning, OnlyWhereMassTurns) {
  const FeModel model = build_bar_frame(flat_bar(4));
  for (const MassModel mass : {MassModel::isoparametric, MassModel::six_dof}) {
    ReductionOptions options = bending(2, mass == MassModel::six_dof);
    options.mass_model = mass;
    EXPECT_FALSE(reduce(model, options).turning);
  }
  FeModel loaded = model;
  loaded.masses.push_back({loaded.find_node("outer"), 1.0, Mat3(Vec3(3, 2, 1.5).asDiagonal())});
  // Bent by forces and moments at the tip.
  ReductionOptions options = bending(0, false);
  options.interfaces = {{"outer", 54u}};
  const FlexibleBody body = reduce(loaded, options);
  ASSERT_TRUE(body.turning);
  // The disc at the tip turns with the last section.
  const ModalNode& tip = body.nodes[static_cast<std::size_t>(loaded.find_node("outer"))];
  FeModel bare = loaded;
  bare.masses.back().J.setZero();
  ReductionOptions same = options;
  same.basis = craig_bampton_modes(loaded, options).X;
  const FlexibleBody point = reduce(bare, same);
  const TurnedSections sections{model, *same.basis};
  Random random(7);
  const VecX y = random.vector(body.modes());
  const double slope = (tip.X_theta * y).norm();
  const auto difference = [&](double size) {
    BodyMotion m;
    m.y = size / slope * y;
    Mat3 R;
    sections.each(m.y, [&](const Mat3&, const Mat3& at) { R = at; });
    const Mat3 J = R * loaded.masses.back().J * R.transpose();
    const MatX rotary = relative_preprocessing(body, m).M - relative_preprocessing(point, m).M;
    return (rotary.block<3, 3>(3, 3) - J).norm();
  };
  EXPECT_GT(std::log10(difference(3e-2) / difference(3e-3)), 2.8);
}

TEST(BarTurning, NamedNodesAreThoseOfAll) {
  // The same numbers, whether all nodes are asked for or those with names, in groups of pairs or at
  // once.
  const FeModel model = build_bar_frame(straight_bar(1.0, 0.02, 60));
  ReductionOptions options = bending(6);
  const FlexibleBody all = reduce(model, options);
  const FlexibleBody named = reduce(model, options, SecondOrderOf::named_nodes);
  ASSERT_EQ(all.second_order->nodes.size(), 61U);
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_EQ(all.second_order->S2[j], named.second_order->S2[j]);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(all.second_order->S2i[i][j], named.second_order->S2i[i][j]);
      EXPECT_EQ(all.turning->S2i[i][j], named.turning->S2i[i][j]);
    }
  }
  options.normal_modes = 44;
  const FlexibleBody many = reduce(model, options, SecondOrderOf::named_nodes);
  ASSERT_EQ(many.second_order->nodes.size(), 2U);
  EXPECT_EQ(many.nodes[static_cast<std::size_t>(many.second_order->nodes[1].node)].name, "outer");
  options.mass_model = MassModel::isoparametric;
  options.section_inertia = false;
  EXPECT_EQ(reduce(model, options, SecondOrderOf::named_nodes).projection->h.size(), 0);
}

}  // namespace
}  // namespace floatframe::test
