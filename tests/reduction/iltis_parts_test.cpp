// Frequencies, stiffness and inertia of the three flexible parts of the Iltis: every printed digit
// of its data sheet.
#include "support/iltis_parts.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <numbers>

#include "floatframe/body/fe_invariants.hpp"

namespace floatframe::test {
namespace {

std::string print(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

TEST(IltisParts, AArm) {
  const FeModel model = build_bar_frame(a_arm_frame(10));
  ASSERT_EQ(model.elements.size(), 21u);
  ASSERT_EQ(model.nodes(), 22);
  const FlexibleBody body = reduce(model, a_arm_options());
  ASSERT_EQ(body.modes(), 4);
  EXPECT_EQ(print("%.3f", body.fixed_interface_frequencies(0)), "862.983");
  EXPECT_EQ(print("%.3f", body.fixed_interface_frequencies(1)), "1090.467");
  EXPECT_EQ(print("%.8e", body.K(0, 0)), "2.31883442e+07");
  EXPECT_EQ(print("%.8e", body.K(0, 1)), "-1.51402252e+07");
  EXPECT_EQ(print("%.8e", body.K(1, 1)), "1.32383235e+07");
  EXPECT_EQ(body.K(1, 0), body.K(0, 1));

  EXPECT_EQ(print("%.3f", body.invariants.m), "6.000");
  const Vec3 centre = body.invariants.centre_of_mass() + Vec3(0.970, 0.259, -0.268);
  EXPECT_EQ(print("%.5f", centre.x()), "0.97364");
  EXPECT_EQ(print("%.5f", centre.y()), "0.42233");
  EXPECT_EQ(print("%.5f", centre.z()), "-0.30628");
  const Mat3 J = body.invariants.inertia_about_centre();
  EXPECT_EQ(print("%.5f", J(0, 0)), "0.05130");
  EXPECT_EQ(print("%.5f", J(1, 1)), "0.02223");
  EXPECT_EQ(print("%.5f", J(2, 2)), "0.06815");
  EXPECT_EQ(print("%.5f", J(0, 1)), "-0.00178");
  EXPECT_EQ(print("%.5f", J(0, 2)), "0.00047");
  EXPECT_EQ(print("%.5f", J(1, 2)), "0.01143");
}

void check_bar(double length, double diameter, const char* statics, const char* first,
               const char* second, const char* format_second) {
  ReductionOptions options;
  options.analytic = AnalyticShapes{2};
  const FlexibleBody body = reduce(build_bar_frame(straight_bar(length, diameter, 10)), options);
  ASSERT_EQ(body.modes(), 6);
  const MatX M = body.invariants.Sij[0][0] + body.invariants.Sij[1][1] + body.invariants.Sij[2][2];
  const auto frequency = [&](int a) {
    return std::sqrt(body.K(a, a) / M(a, a)) / (2.0 * std::numbers::pi);
  };
  for (int plane = 0; plane < 2; ++plane) {
    EXPECT_EQ(print("%.2f", frequency(plane)), statics);
    EXPECT_EQ(print("%.2f", frequency(2 + plane)), first);
    EXPECT_EQ(print(format_second, frequency(4 + plane)), second);
  }
}

TEST(IltisParts, UpperLink) {
  check_bar(0.3366470704, 0.030, "193.83", "846.61", "2815.1", "%.1f");
}
TEST(IltisParts, TrackRod) { check_bar(0.3842460149, 0.020, "99.19", "433.24", "1440.6", "%.1f"); }

TEST(IltisParts, FinerMeshesConverge) {
  // Isoparametric frequencies approach those of the consistent mass with the square of the element
  // length.
  ReductionOptions options = a_arm_options();
  VecX last;
  std::vector<VecX> f;
  for (const int elements : {5, 10, 20, 40, 100}) {
    f.push_back(
        reduce(build_bar_frame(a_arm_frame(elements)), options).fixed_interface_frequencies);
  }
  for (int a = 0; a < 2; ++a) {
    const double order = std::log2((f[1](a) - f[2](a)) / (f[2](a) - f[3](a)));
    EXPECT_NEAR(order, 2.0, 0.1);
  }
}

TEST(IltisParts, IntegralsOfTwoHundredElementsAreQuick) {
  const FeModel model = build_bar_frame(a_arm_frame(100));
  ASSERT_EQ(model.elements.size(), 201u);
  const MatX X = craig_bampton_modes(model, a_arm_options()).X;
  double best = 1e9, best_hermite = 1e9;
  for (int i = 0; i < 20; ++i) {
    const auto a = std::chrono::steady_clock::now();
    const InertiaInvariants v = invariants_isoparametric(model, X);
    const auto b = std::chrono::steady_clock::now();
    const InertiaInvariants h = invariants_hermite(model, X, true);
    const auto c = std::chrono::steady_clock::now();
    ASSERT_NEAR(v.m, h.m, 1e-12);
    best = std::min(best, std::chrono::duration<double, std::milli>(b - a).count());
    best_hermite = std::min(best_hermite, std::chrono::duration<double, std::milli>(c - b).count());
  }
  std::printf("201 elements, 4 modes: isoparametric %.3f ms, exact beam integrals %.3f ms\n", best,
              best_hermite);
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__)
  EXPECT_LT(best, 2.0);
  EXPECT_LT(best_hermite, 2.0);
#endif
}

}  // namespace
}  // namespace floatframe::test
