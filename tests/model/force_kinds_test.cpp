// Every registered kind of force in each of its regimes: reaction, work, dissipation, and the exact
// tangent against differences of the wrench and against the rows that the formulations use. A new
// kind in model/force_list.hpp is covered by being there.
#include <gtest/gtest.h>

#include <set>

#include "floatframe/model/force_kind.hpp"
#include "support/exact_tangents.hpp"
#include "support/marker_motion.hpp"

namespace floatframe::test {
namespace {

constexpr int force_samples = 40;

struct ForceCase {
  ForceType type;
  std::size_t regime;
  const ForceKind& kind() const { return force_kind(type); }
  std::string name() const {
    return std::string(force_type_name(type)) + "_" + kind().regimes[regime].name;
  }
};

std::vector<ForceCase> all_force_cases() {
  std::vector<ForceCase> all;
  for (const ForceType type : force_types)
    for (std::size_t k = 0; k < force_kind(type).regimes.size(); ++k) all.push_back({type, k});
  return all;
}

class ForceOfKind : public ::testing::TestWithParam<ForceCase> {
 protected:
  ForceExample example() {
    const ForceExample x = GetParam().kind().example(GetParam().regime, numbers_);
    EXPECT_EQ(x.force.type, GetParam().type);
    return x;
  }
  static const ForceRegime& regime() { return GetParam().kind().regimes[GetParam().regime]; }
  static ForceState evaluate(const ForceExample& x, const MarkerPair& p) {
    ForceState s;
    evaluate_force(x.model, x.force, p.a, p.b, x.origin, x.t, x.reference_angle, s, x.inputs);
    return s;
  }
  static ForceTangent tangent(const ForceExample& x, const MarkerPair& p) {
    return exact_tangent({x.model, x.force, p.a, p.b, x.origin, x.t, x.reference_angle, x.inputs});
  }
  static MatX numeric_stiffness(const ForceExample& x, const MarkerPair& p) {
    return -jacobian([&](const Vec12& d) { return stacked(evaluate(x, moved(p, d)).wrench); });
  }
  static MatX numeric_damping(const ForceExample& x, const MarkerPair& p) {
    const Vec12 v = velocity(p);
    return -jacobian(
        [&](const Vec12& d) { return stacked(evaluate(x, with_velocity(p, v + d)).wrench); });
  }
  ExampleNumbers numbers_{11};
};

TEST_P(ForceOfKind, ActionEqualsReaction) {
  for (int k = 0; k < force_samples; ++k) {
    const ForceExample x = example();
    const WrenchRow w = evaluate(x, {x.a, x.b}).wrench;
    if (GetParam().kind().markers == ForceMarkers::one) {
      EXPECT_EQ(w.Fa.norm() + w.Ta.norm(), 0.0);
      continue;
    }
    EXPECT_LT((w.Fa + w.Fb).norm(), 1e-12 * (1 + w.Fa.norm()));
    const Vec3 moment = w.Ta + w.Tb + x.a.r.cross(w.Fa) + x.b.r.cross(w.Fb);
    EXPECT_LT(moment.norm(), 1e-12 * (1 + w.Fa.norm() + w.Ta.norm()));
  }
}

TEST_P(ForceOfKind, WorkIsTheLossOfPotentialEnergy) {
  if (!regime().conservative || !regime().regular) return;
  for (int k = 0; k < force_samples; ++k) {
    const ForceExample x = example();
    if (!regime().regular) continue;
    const MarkerPair p = with_velocity({x.a, x.b}, Vec12::Zero());
    const MatX gradient = jacobian(
        [&](const Vec12& d) { return VecX::Constant(1, evaluate(x, moved(p, d)).energy); });
    const Vec12 w = stacked(evaluate(x, p).wrench);
    EXPECT_LT((w + gradient.row(0).transpose()).norm(), 1e-8 * (1 + w.norm()));
  }
}

TEST_P(ForceOfKind, MotionTakesEnergyOut) {
  if (!regime().conservative || !regime().regular) return;
  for (int k = 0; k < force_samples; ++k) {
    const ForceExample x = example();
    const MarkerPair p{x.a, x.b};
    const ForceState s = evaluate(x, p), rest = evaluate(x, with_velocity(p, Vec12::Zero()));
    const double power = (stacked(s.wrench) - stacked(rest.wrench)).dot(velocity(p));
    EXPECT_LE(power, 1e-12);
    if (s.row_count > 0) {
      EXPECT_LT(power, -1e-9);
    }
  }
}

// What springs keep, what dampers take and what the wrench does, in the motion at hand and with the
// targets that move; tyres leave the account to their users.
TEST_P(ForceOfKind, EnergyRateBelongsToTheEnergy) {
  if (!regime().regular || GetParam().kind().energy == EnergyCategory::tyres) return;
  for (int k = 0; k < force_samples; ++k) {
    const ForceExample x = example();
    const MarkerPair p{x.a, x.b};
    const Vec12 v = velocity(p);
    const VecX rate = derivative(
        [&](double h) {
          ForceExample later = x;
          later.t += h;
          return VecX::Constant(1, evaluate(later, moved(p, h * v)).energy).eval();
        },
        1e-4);
    const ForceState s = evaluate(x, p);
    EXPECT_NEAR(s.energy_rate, rate[0], 1e-6 * (1.0 + std::abs(rate[0])));
    if (!regime().conservative) continue;
    EXPECT_NEAR(stacked(s.wrench).dot(v), -s.energy_rate - s.damping,
                1e-11 * (1.0 + std::abs(s.energy_rate) + s.damping));
    EXPECT_GE(s.damping, 0.0);
  }
}

TEST_P(ForceOfKind, LengthAndRateBelongTogether) {
  for (int k = 0; k < force_samples; ++k) {
    const ForceExample x = example();
    if (!regime().regular) continue;
    const MarkerPair p{x.a, x.b};
    const Vec12 v = velocity(p);
    const VecX rate = derivative(
        [&](double h) { return VecX::Constant(1, evaluate(x, moved(p, h * v)).length).eval(); },
        1e-4);
    EXPECT_NEAR(evaluate(x, p).rate, rate[0], 1e-7);
  }
}

TEST_P(ForceOfKind, TangentAgainstFiniteDifferences) {
  double worst = 0.0;
  for (int k = 0; k < force_samples; ++k) {
    const ForceExample x = example();
    const MarkerPair p{x.a, x.b};
    const ForceTangent t = tangent(x, p);
    ASSERT_TRUE(t.K.allFinite());
    ASSERT_TRUE(t.C.allFinite());
    if (!regime().regular) continue;
    const MatX K = numeric_stiffness(x, p), C = numeric_damping(x, p);
    const double scale = 1.0 + std::max(K.cwiseAbs().maxCoeff(), C.cwiseAbs().maxCoeff());
    worst = std::max(worst, (t.K - K).cwiseAbs().maxCoeff() / scale);
    worst = std::max(worst, (t.C - C).cwiseAbs().maxCoeff() / scale);
  }
  EXPECT_LT(worst, 1e-8);
  std::printf("[ figure ] tangent_error_%s %.1e\n", GetParam().name().c_str(), worst);
}

// The rows are the symmetric part of the stiffness at rest and of the damping, but for what the
// regime says they leave out; and what it says is true.
TEST_P(ForceOfKind, KeysWorkAsTheirRowsState) {
  double left_out = 0.0;
  for (int k = 0; k < force_samples; ++k) {
    const ForceExample x = example();
    const MarkerPair p = with_velocity({x.a, x.b}, Vec12::Zero());
    const ForceTangent t = tangent(x, p);
    const ForceState s = evaluate(x, p);
    Mat12 K = Mat12::Zero(), C = Mat12::Zero();
    for (int r = 0; r < s.row_count; ++r) {
      const Vec12 g = stacked(s.rows[r].g);
      K += s.rows[r].k * g * g.transpose();
      C += s.rows[r].c * g * g.transpose();
    }
    ASSERT_TRUE(K.allFinite());
    const double scale = 1.0 + t.K.cwiseAbs().maxCoeff();
    left_out =
        std::max(left_out, (0.5 * (t.K + t.K.transpose()) - K).cwiseAbs().maxCoeff() / scale);
    left_out =
        std::max(left_out, (0.5 * (t.C + t.C.transpose()) - C).cwiseAbs().maxCoeff() / scale);
  }
  if (std::string(regime().rows_leave_out).empty()) {
    EXPECT_LT(left_out, 1e-12);
  } else {
    EXPECT_GT(left_out, 1e-3);
  }
}

TEST_P(ForceOfKind, RegimeIsReached) {
  bool acts = false;
  for (int k = 0; k < force_samples; ++k) {
    const ForceExample x = example();
    const ForceState s = evaluate(x, {x.a, x.b});
    acts = acts || stacked(s.wrench).norm() > 0.0;
    EXPECT_TRUE(stacked(s.wrench).allFinite());
    EXPECT_LE(s.row_count, static_cast<int>(std::size(s.rows)));
  }
  EXPECT_EQ(acts, regime().acts);
}

INSTANTIATE_TEST_SUITE_P(EveryKind, ForceOfKind, ::testing::ValuesIn(all_force_cases()),
                         [](const auto& c) { return c.param.name(); });

TEST(ForceKinds, AreComplete) {
  std::set<std::string> names;
  for (const ForceType type : force_types) {
    const ForceKind& kind = force_kind(type);
    const std::string name = force_type_name(type);
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_TRUE(kind.build && kind.example && *kind.about) << name;
    EXPECT_FALSE(kind.regimes.empty()) << name;
    std::set<std::string> keys;
    for (const ForceKey& key : kind.keys) {
      EXPECT_TRUE(keys.insert(key.name).second) << name << " " << key.name;
      // A type with a description struct keeps all in it; a stop is part of its spring.
      EXPECT_EQ(key.member.read != nullptr, kind.blank != nullptr && !key.of) << key.name;
      EXPECT_TRUE(*key.about) << name << " " << key.name;
      if (key.of) {
        EXPECT_TRUE(keys.contains(key.of)) << name << " " << key.name;
      }
    }
    if (kind.blank) {
      EXPECT_EQ((ForceDescription{"", kind.blank(), {}}.type()), type);
    }
  }
}

}  // namespace
}  // namespace floatframe::test
