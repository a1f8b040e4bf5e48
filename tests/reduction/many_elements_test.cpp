// Bars of very many elements: the sixth digit of frequencies and of static shapes, and the sentence
// where it is lost.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/fe/bar_frame.hpp"
#include "floatframe/fe/strain_energy.hpp"
#include "floatframe/reduction/reduction.hpp"
#include "support/error_of.hpp"
#include "support/iltis_parts.hpp"

namespace floatframe {
namespace {

/// Two slender bars in a corner, 1 m and 0.5 m.
BarFrame corner(int elements) {
  BarFrame frame;
  frame.material = {7e10, 0.3, 2700.0};
  frame.points = {{"inner", {0, 0, 0}}, {"knee", {0.6, 0.8, 0}}, {"outer", {0.6, 0.8, 0.5}}};
  for (const auto& [from, to] : {std::pair{"inner", "knee"}, {"knee", "outer"}}) {
    Bar bar;
    bar.name = from;
    bar.from = from;
    bar.to = to;
    bar.elements = elements / 2;
    bar.section = BeamSection::rectangle(0.01, 0.02);
    bar.reference = Vec3(0.8, -0.6, 0.0);
    frame.bars.push_back(bar);
  }
  return frame;
}

BarFrame rod(int elements) {
  BarFrame frame = test::straight_bar(1.0, 0.02, elements);
  frame.material = {7e10, 0.3, 2700.0};
  frame.bars[0].section = BeamSection::rectangle(0.01, 0.02);
  frame.bars[0].reference = Vec3::UnitY();
  return frame;
}

ReductionOptions options_of(int normal_modes) {
  ReductionOptions options;
  options.clamped = {{"inner", all_dofs}};
  options.interfaces = {{"outer", all_dofs}};
  options.normal_modes = normal_modes;
  options.mass_model = MassModel::hermite;
  return options;
}

double error(const MatX& a, const MatX& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

/// 20 000 elements gave 27.7 Hz where there are 22.8 Hz; 50 000 were called singular.
TEST(ManyElements, FrequenciesOfAFreeTip) {
  const BeamSection s = BeamSection::rectangle(0.01, 0.02);
  const double exact = std::pow(1.8751040687119611, 2) / (2.0 * std::numbers::pi) *
                       std::sqrt(7e10 * std::min(s.Iy, s.Iz) / (2700.0 * s.A));
  ReductionOptions options = options_of(4);
  options.interfaces.clear();
  for (const int elements : {100, 101, 20000, 50000}) {
    const FlexibleBody body = reduce(build_bar_frame(rod(elements)), options);
    EXPECT_NEAR(body.fixed_interface_frequencies(0), exact, 1e-6 * exact) << elements;
    EXPECT_NEAR(body.fixed_interface_frequencies(1), 2.0 * exact, 2e-6 * exact) << elements;
  }
  options.normal_modes = 0;
  options.max_frequency = 6.0 * exact;  // 1 and 2 times the first, 6.27 above
  EXPECT_EQ(reduce(build_bar_frame(rod(1000)), options).fixed_interface_frequencies.size(), 2);
}

TEST(ManyElements, StaticShapesAndStiffness) {
  const FlexibleBody few = reduce(build_bar_frame(corner(100)), options_of(6));
  for (const int elements : {1000, 20000}) {
    const FlexibleBody many = reduce(build_bar_frame(corner(elements)), options_of(6));
    ASSERT_EQ(many.modes(), few.modes());
    EXPECT_EQ(many.mode_names, few.mode_names);
    EXPECT_LT(error(many.K.topLeftCorner(6, 6), few.K.topLeftCorner(6, 6)), 1e-7) << elements;
    EXPECT_LT(error(many.fixed_interface_frequencies, few.fixed_interface_frequencies), 1e-6)
        << elements;
    EXPECT_LT(error(many.invariants.S, few.invariants.S), 1e-5) << elements;
    // Node in the middle of the first bar.
    const Mat3X X = many.nodes[elements / 4].X.leftCols(6);
    EXPECT_LT(error(X, few.nodes[25].X.leftCols(6)), 1e-7) << elements;
    const Mat3X X_theta = many.nodes[elements / 4].X_theta.leftCols(6);
    EXPECT_LT(error(X_theta, few.nodes[25].X_theta.leftCols(6)), 1e-7) << elements;
  }
}

/// The same model with and without long beams.
TEST(ManyElements, LongBeamsAreExact) {
  FeModel chained = build_bar_frame(corner(120));
  chained.masses = {{31, 0.2}};
  FeModel direct = chained;
  // Other sections by one rounding error: no rows of equal elements.
  const BeamSection s = direct.sections[0];
  for (std::size_t e = 0; e < direct.elements.size(); ++e) {
    direct.elements[e].section = static_cast<int>(direct.sections.size());
    direct.sections.push_back(s);
    if (e % 2 == 0) direct.sections.back().A = std::nextafter(s.A, 1.0);
  }
  const FlexibleBody a = reduce(chained, options_of(12)), b = reduce(direct, options_of(12));
  EXPECT_LT(error(a.K, b.K), 1e-7);
  EXPECT_LT(error(a.invariants.S.cwiseAbs(), b.invariants.S.cwiseAbs()), 1e-6);
  EXPECT_LT(error(a.fixed_interface_frequencies, b.fixed_interface_frequencies), 1e-7);
}

/// Unlike elements, so that none can be put together.
std::string error_of_unlike(int elements) {
  FeModel model = build_bar_frame(rod(elements));
  const BeamSection s = model.sections[0];
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    model.elements[e].section = static_cast<int>(e);
    model.sections.resize(e + 1, s);
    if (e % 2 == 0) model.sections[e].A *= 1.001;
  }
  return test::error_of([&] { reduce(model, options_of(2)); });
}

TEST(ManyElements, IsRefusedWhereDigitsAreLost) {
  EXPECT_EQ(error_of_unlike(150), "no error");
  EXPECT_EQ(error_of_unlike(6000), "too_large");
  EXPECT_EQ(error_of_unlike(20000), "too_large");
}

/// A basis of the user: the stiffness of its shapes.
TEST(ManyElements, GivenBasis) {
  for (const int elements : {100, 20000}) {
    const FeModel model = build_bar_frame(rod(elements));
    ReductionOptions options;
    options.mass_model = MassModel::hermite;
    options.basis = MatX::Zero(6 * model.nodes(), 1);
    for (int k = 0; k < model.nodes(); ++k) {
      const double x = model.positions[k].x();
      (*options.basis)(6 * k + 2, 0) = x * x * (3.0 - x) / 2.0;
      (*options.basis)(6 * k + 4, 0) = -x * (6.0 - 3.0 * x) / 2.0;
    }
    const double EI = 7e10 * model.sections[0].Iy;
    EXPECT_NEAR(reduce(model, options).K(0, 0), 3.0 * EI, 1e-6 * EI) << elements;
  }
}

}  // namespace
}  // namespace floatframe
