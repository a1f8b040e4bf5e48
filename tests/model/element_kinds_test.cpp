// Every registered kind of element in each of its regimes: reaction, work, dissipation, and the
// exact tangent against differences of the wrenches, against the energy by dual numbers and against
// the rows that the formulations use. A new kind in model/elements.hpp is covered by being there.
#include <gtest/gtest.h>

#include <set>

#include "floatframe/model/element_kind.hpp"
#include "support/element_motion.hpp"

namespace floatframe::test {
namespace {

constexpr int element_samples = 40;

struct ElementCase {
  ElementType type;
  std::size_t regime;
  const ElementKind& kind() const { return element_kind(type); }
  std::string name() const {
    return std::string(element_type_name(type)) + "_" + kind().regimes[regime].name;
  }
};

std::vector<ElementCase> all_element_cases() {
  std::vector<ElementCase> all;
  for (const ElementType type : element_types)
    for (std::size_t k = 0; k < element_kind(type).regimes.size(); ++k) all.push_back({type, k});
  return all;
}

class ElementOfKind : public ::testing::TestWithParam<ElementCase> {
 protected:
  ElementExample example() {
    ElementExample x = element_example(GetParam().type, GetParam().regime, numbers_);
    EXPECT_EQ(x.element.type, GetParam().type);
    return x;
  }
  static const ElementRegime& regime() { return GetParam().kind().regimes[GetParam().regime]; }
  static bool keeps_account() {
    return regime().regular && GetParam().kind().energy != EnergyCategory::tyres;
  }
  ExampleNumbers numbers_{11};
};

// Of elements between bodies; those at one place are loads from outside.
TEST_P(ElementOfKind, ActionEqualsReaction) {
  for (int k = 0; k < element_samples; ++k) {
    const ElementExample x = example();
    if (x.markers.size() < 2) return;
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    double size = 1.0;
    const Efforts e = efforts(x);
    for (std::size_t i = 0; i < x.markers.size(); ++i) {
      force += e.wrench[i].F;
      moment += e.wrench[i].T + x.markers[i].r.cross(e.wrench[i].F);
      size += e.wrench[i].F.norm() + e.wrench[i].T.norm();
    }
    EXPECT_LT(force.norm(), 1e-12 * size);
    EXPECT_LT(moment.norm(), 1e-12 * size);
  }
}

// By dual numbers: exact to rounding.
TEST_P(ElementOfKind, WorkIsTheLossOfPotentialEnergy) {
  if (!regime().conservative || !regime().regular) return;
  for (int k = 0; k < element_samples; ++k) {
    ElementExample x = example();
    at_rest(x);
    const Efforts e = efforts(x);
    for (std::size_t i = 0; i < x.markers.size(); ++i) {
      const Placed placed(x);
      TangentFinder finder(x.model, placed.ports().element);
      const EffortsOf<Dual>& dual = finder.along_marker(placed.ports(), static_cast<int>(i));
      Vec6 w;
      w << e.wrench[i].F, e.wrench[i].T;
      EXPECT_LT((w + dual.energy.d.head<6>().matrix()).norm(), 1e-12 * (1.0 + w.norm()));
    }
  }
}

TEST_P(ElementOfKind, MotionTakesEnergyOut) {
  if (!regime().conservative || !regime().regular) return;
  for (int k = 0; k < element_samples; ++k) {
    const ElementExample x = example();
    ElementExample still = x;
    at_rest(still);
    const Efforts e = efforts(x);
    const double power = (stacked(e) - stacked(efforts(still))).dot(velocities(x));
    EXPECT_LE(power, 1e-12);
    if (e.row_count > 0 && x.element.states == 0) {  // a state may take it
      EXPECT_LT(power, -1e-9);
    }
  }
}

// What springs keep, what dampers take and what the wrench does, in the motion at hand and with the
// targets that move; tyres leave the account to their users.
TEST_P(ElementOfKind, EnergyRateBelongsToTheEnergy) {
  if (!keeps_account()) return;
  for (int k = 0; k < element_samples; ++k) {
    const ElementExample x = example();
    const VecX v = velocities(x);
    const VecX rate = derivative(
        [&](double h) {
          ElementExample later = switched(moved(x, h * v), h * state_rates(x));
          later.t += h;
          return VecX::Constant(1, efforts(later).energy).eval();
        },
        1e-4);
    const Efforts e = efforts(x);
    EXPECT_NEAR(e.energy_rate, rate[0], 1e-6 * (1.0 + std::abs(rate[0])));
    if (!regime().conservative) continue;
    EXPECT_NEAR(stacked(e).dot(v), -e.energy_rate - e.damping,
                1e-11 * (1.0 + std::abs(e.energy_rate) + e.damping));
    EXPECT_GE(e.damping, 0.0);
  }
}

TEST_P(ElementOfKind, LengthAndRateBelongTogether) {
  if (!regime().regular) return;
  for (int k = 0; k < element_samples; ++k) {
    const ElementExample x = example();
    const VecX v = velocities(x);
    const VecX rate = derivative(
        [&](double h) { return VecX::Constant(1, efforts(moved(x, h * v)).length).eval(); }, 1e-4);
    EXPECT_NEAR(efforts(x).rate, rate[0], 1e-7);
  }
}

TEST_P(ElementOfKind, TangentAgainstFiniteDifferences) {
  double worst = 0.0;
  for (int k = 0; k < element_samples; ++k) {
    const ElementExample x = example();
    const EffortTangent t = exact_tangent(Placed(x).ports());
    ASSERT_TRUE(t.K.allFinite());
    ASSERT_TRUE(t.C.allFinite());
    if (!regime().regular) continue;
    const Eigen::Index n = velocities(x).size(), inner = inner_count(x);
    // Differences of small slopes round with the size of what they are of.
    const double rounds = 1e-2 * largest_entry(results(x));
    const auto compare = [&](const MatX& exact, const MatX& differences) {
      worst = std::max(
          worst, largest_entry(exact - differences) / (1.0 + rounds + largest_entry(differences)));
    };
    if (n > 0) {  // it has markers
      const MatX K = -jacobian([&](const VecX& d) { return stacked(efforts(moved(x, d))); }, n);
      const MatX C = -jacobian([&](const VecX& d) { return stacked(efforts(faster(x, d))); }, n);
      const double scale = 1.0 + std::max(largest_entry(K), largest_entry(C));
      worst = std::max(worst, largest_entry(t.K - K) / scale);
      worst = std::max(worst, largest_entry(t.C - C) / scale);
      compare(t.motion, jacobian([&](const VecX& d) { return results(moved(x, d)); }, n));
      compare(t.rates, jacobian([&](const VecX& d) { return results(faster(x, d)); }, n));
    }
    if (inner == 0) continue;
    constexpr double fine = 0.1;  // deflections of tyres bend their laws within millimetres
    compare(t.slopes,
            jacobian([&](const VecX& d) { return results(changed(x, fine * d)); }, inner) / fine);
    if (n > 0)
      compare(
          t.of_inner,
          -jacobian([&](const VecX& d) { return stacked(efforts(changed(x, fine * d))); }, inner) /
              fine);
    // Length and rate follow from the motion.
    EXPECT_TRUE(t.slopes.middleRows(x.element.states + 1, 2).isZero(0.0));
  }
  EXPECT_LT(worst, 1e-8);
  std::printf("[ figure ] tangent_error_%s %.1e\n", GetParam().name().c_str(), worst);
}

TEST_P(ElementOfKind, SlopesOfTheStatesAreExact) {
  for (int k = 0; k < element_samples; ++k) {
    const ElementExample x = example();
    const Eigen::Index ns = x.element.states;
    if (ns == 0) return;
    const MatX exact = exact_tangent(Placed(x).ports()).slopes.topLeftCorner(ns, ns);
    const Efforts e = efforts(x);
    const MatX slopes = Eigen::Map<const MatX>(e.state_slopes.data(), ns, ns).transpose();
    EXPECT_LT((slopes - exact).cwiseAbs().maxCoeff(), 1e-12 * (1.0 + exact.cwiseAbs().maxCoeff()));
  }
}

/// With states that follow with the weight w: -d(wrenches)/dp with dz = (w - f_z)^-1 f_p dp.
EffortTangent with_states_following(const ElementExample& x) {
  EffortTangent t = exact_tangent(Placed(x).ports());
  const Eigen::Index ns = x.element.states;
  if (ns == 0 || !std::isfinite(x.state_weight)) return t;
  const MatX slopes = x.state_weight * MatX::Identity(ns, ns) - t.slopes.topLeftCorner(ns, ns),
             of_states = t.of_inner.leftCols(ns);
  t.K += of_states * slopes.partialPivLu().solve(t.motion.topRows(ns));
  t.C += of_states * slopes.partialPivLu().solve(t.rates.topRows(ns));
  return t;
}

// The rows are the symmetric part of the stiffness at rest and of the damping, but for what the
// regime says they leave out; and what it says is true.
TEST_P(ElementOfKind, RowsAreTheTangentButForWhatTheyLeaveOut) {
  double left_out = 0.0;
  for (int k = 0; k < element_samples; ++k) {
    ElementExample x = example();
    if (x.element.markers.empty()) return;
    at_rest(x);
    const EffortTangent t = with_states_following(x);
    const RowTangent rows = tangent_of_rows(efforts(x));
    ASSERT_TRUE(rows.K.allFinite());
    const double scale = 1.0 + largest_entry(t.K);
    for (const auto& [exact, row] : {std::pair(t.K, rows.K), std::pair(t.C, rows.C)})
      left_out = std::max(left_out, largest_entry(0.5 * (exact + exact.transpose()) - row) / scale);
  }
  if (std::string(regime().rows_leave_out).empty()) {
    EXPECT_LT(left_out, regime().differences ? 1e-9 : 1e-12);
  } else {
    EXPECT_GT(left_out, 1e-3);
  }
}

TEST_P(ElementOfKind, RegimeIsReached) {
  bool acts = false;
  for (int k = 0; k < element_samples; ++k) {
    const Efforts e = efforts(example());
    acts = acts || stacked(e).norm() > 0.0;
    EXPECT_TRUE(stacked(e).allFinite());
  }
  EXPECT_EQ(acts, regime().acts);
}

INSTANTIATE_TEST_SUITE_P(EveryKind, ElementOfKind, ::testing::ValuesIn(all_element_cases()),
                         [](const auto& c) { return c.param.name(); });

TEST(ElementKinds, AreComplete) {
  std::set<std::string> names;
  for (const ElementType type : element_types) {
    const ElementKind& kind = element_kind(type);
    const std::string name = element_type_name(type);
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_TRUE(kind.blank && kind.build && (kind.dual || kind.rows)) << name;
    EXPECT_TRUE(kind.picture || kind.axis == ElementAxis::coordinate ||  // else as joints
                kind.list == ElementList::controllers)
        << name;
    EXPECT_TRUE(*kind.about) << name;
    EXPECT_FALSE(kind.regimes.empty()) << name;
    EXPECT_EQ((ElementDescription{"", kind.blank(), {}}.type()), type);
    std::set<std::string> keys;
    for (const ElementKey& key : kind.keys) {
      EXPECT_TRUE(keys.insert(key.name).second) << name << " " << key.name;
      EXPECT_EQ(key.member.read == nullptr, key.of != nullptr || key.kind == KeyKind::linear_file)
          << key.name;
      EXPECT_TRUE(*key.about) << name << " " << key.name;
      if (key.of) {
        EXPECT_TRUE(keys.contains(key.of)) << name << " " << key.name;
      }
    }
  }
}

}  // namespace
}  // namespace floatframe::test
