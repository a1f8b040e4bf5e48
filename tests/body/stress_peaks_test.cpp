// The largest stress over a motion, against the von Mises stress of each place at each instant.
#include "floatframe/body/stress_peaks.hpp"

#include <gtest/gtest.h>

#include <random>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/model/gauge.hpp"

namespace floatframe::test {
namespace {

constexpr int peak_modes = 5, peak_places = 9, peak_instants = 200;

MatX random_matrix(std::mt19937& random, Eigen::Index rows, Eigen::Index columns) {
  std::normal_distribution<double> normal;
  return MatX::NullaryExpr(rows, columns, [&] { return normal(random); });
}

/// Places with the stress of a solid, of a plane, of a bar and of nothing, in turned axes.
BodyStress stress_of_all_ranks(std::mt19937& random) {
  BodyStress out;
  out.places.resize(peak_places);
  out.modes = 1e9 * random_matrix(random, 6 * peak_places, peak_modes);
  out.loads = 1e6 * random_matrix(random, 6 * peak_places, body_load_cases + peak_modes);
  for (int p = 0; p < peak_places; ++p) {
    const Mat3 R =
        Eigen::Quaterniond(Eigen::Vector4d(random_matrix(random, 4, 1)).normalized()).matrix();
    for (MatX* m : {&out.modes, &out.loads})
      for (Eigen::Index k = 0; k < m->cols(); ++k) {
        Vec6 s = m->col(k).segment<6>(6 * p);
        if (p % 4 == 1) s(2) = s(4) = s(5) = 0.0;  // plane
        if (p % 4 == 2) s(1) = s(2) = s(4) = 0.0;  // bar
        if (p % 4 == 3) s *= p == 3 ? 0.0 : 1e-7;
        Mat3 S;
        S << s(0), s(3), s(5), s(3), s(1), s(4), s(5), s(4), s(2);
        const Mat3 T = R * S * R.transpose();
        m->col(k).segment<6>(6 * p) << T(0, 0), T(1, 1), T(2, 2), T(0, 1), T(1, 2), T(2, 0);
      }
  }
  return out;
}

TEST(StressPeaks, AreThoseOfEachPlaceAndInstant) {
  std::mt19937 random(7);
  const BodyStress stress = stress_of_all_ranks(random);
  const MatX y = 1e-3 * random_matrix(random, peak_instants, peak_modes);
  const MatX c = random_matrix(random, peak_instants, body_load_cases);
  const std::vector<int> places{8, 0, 1, 2, 3, 4, 5, 6, 7};
  StressPeaks peaks(stress, places, true), alone(stress, places, false);
  // In two parts, the first of which is no whole number of blocks.
  peaks.add(y.topRows(70), c.topRows(70));
  peaks.add(y.bottomRows(peak_instants - 70), c.bottomRows(peak_instants - 70));
  alone.add(y, {});
  ASSERT_EQ(peaks.of_all().size(), places.size());
  EXPECT_TRUE(alone.of_all().empty());
  for (std::size_t k = 0; k < places.size(); ++k) {
    double by_modes = 0.0, by_all = 0.0;
    Eigen::Index when_modes = -1, when_all = -1;
    for (Eigen::Index t = 0; t < peak_instants; ++t) {
      const Eigen::Index row = 6 * Eigen::Index{places[k]};
      const Vec6 s = stress.modes.middleRows<6>(row) * y.row(t).transpose();
      const Vec6 more = stress.loads.block<6, body_load_cases>(row, 0) * c.row(t).transpose();
      if (const double now = von_mises(s); now > by_modes) by_modes = now, when_modes = t;
      if (const double now = von_mises(s + more); now > by_all) by_all = now, when_all = t;
    }
    SCOPED_TRACE(places[k]);
    EXPECT_NEAR(std::sqrt(peaks.of_modes()[k].square), by_modes, 1e-9 * by_modes);
    EXPECT_NEAR(std::sqrt(peaks.of_all()[k].square), by_all, 1e-9 * by_all);
    EXPECT_EQ(peaks.of_modes()[k].instant, when_modes);
    EXPECT_EQ(peaks.of_all()[k].instant, when_all);
    EXPECT_NEAR(std::sqrt(alone.of_modes()[k].square), by_modes, 1e-9 * by_modes);
  }
}

}  // namespace
}  // namespace floatframe::test
