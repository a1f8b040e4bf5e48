// Pairs of modes of parts that bend alike in two directions: a number that cuts one is noted,
// limits and automatic choices keep them whole.
#include <gtest/gtest.h>

#include "floatframe/body/cut_pair.hpp"
#include "reduction/part_beam.hpp"
#include "support/contains.hpp"

namespace floatframe::test {
namespace {

/// The beam of part_beam.hpp, a little wider than high.
FeModel nearly_square(double wider) {
  FeModel model = beam();
  for (Vec3& p : model.positions) p.y() *= 1.0 + wider;
  return model;
}

PartOptions by(int modes, double below, double mass) {
  PartOptions options = both_ends();
  options.modes = modes > 0 ? std::optional(modes) : std::nullopt;
  options.max_frequency = below;
  options.effective_mass = mass;
  options.check_free_modes = false;
  options.stresses = false;
  return options;
}

std::vector<double> frequencies(const HealthReport& health) {
  std::vector<double> all;
  for (const ModeHealth& m : health.normal_modes) all.push_back(m.frequency);
  return all;
}

bool notes_cut(const HealthReport& health, std::size_t kept) {
  return count_with(health.notes, "modes: " + std::to_string(kept) + " cuts a pair") > 0;
}

/// By the frequencies of more modes: the last has a partner that is left out.
bool cuts(const std::vector<double>& all, std::size_t kept) {
  std::size_t begin = kept - 1;
  while (begin > 0 && all[begin - 1] > 0.998 * all[kept - 1]) --begin;
  return all[kept] < 1.002 * all[kept - 1] && (kept - begin) % 2 == 1;
}

TEST(ModePairs, NumberThatCutsOneIsNoted) {
  for (const ModeMethod method : {ModeMethod::craig_bampton, ModeMethod::free_free}) {
    PartOptions many = by(12, 0.0, 0.0);
    many.method = method;
    const std::vector<double> all = frequencies(reduce_part(beam(), many).health);
    ASSERT_EQ(all.size(), 12u);
    int cut = 0;
    for (std::size_t kept = 1; kept < 8; ++kept) {
      PartOptions few = by(static_cast<int>(kept), 0.0, 0.0);
      few.method = method;
      const HealthReport health = reduce_part(beam(), few).health;
      EXPECT_EQ(health.normal_modes.size(), kept);
      EXPECT_EQ(notes_cut(health, kept), cuts(all, kept)) << kept;
      cut += cuts(all, kept) ? 1 : 0;
    }
    EXPECT_GE(cut, 2);
  }
}

TEST(ModePairs, LimitsKeepThemWhole) {
  const std::vector<double> all =
      frequencies(reduce_part(nearly_square(5e-4), by(12, 0.0, 0.0)).health);
  ASSERT_LT(all[0], all[1]);
  ASSERT_LT(all[1], 1.001 * all[0]);
  const double between = 0.5 * (all[0] + all[1]);
  EXPECT_EQ(reduce_part(nearly_square(5e-4), by(0, between, 0.0)).health.normal_modes.size(), 2u);
  EXPECT_EQ(reduce_part(nearly_square(5e-4), by(0, 0.99 * all[0], 0.0)).health.normal_modes.size(),
            0u);
  // By a fraction of the effective mass, and by default.
  for (const double mass : {0.3, 0.5, 0.7, 0.8, 0.0}) {
    const HealthReport health = reduce_part(beam(), by(0, 0.0, mass)).health;
    const std::size_t kept = health.normal_modes.size();
    const std::vector<double> more =
        frequencies(reduce_part(beam(), by(static_cast<int>(kept) + 2, 0.0, 0.0)).health);
    EXPECT_FALSE(cuts(more, kept)) << mass << ": " << kept;
  }
}

}  // namespace
}  // namespace floatframe::test
