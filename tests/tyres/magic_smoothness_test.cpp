// What the Magic Formula must show beside its tables: exact derivatives, no gain of energy by slip,
// nothing that jumps at rest and without load, ranges.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

#include "tyres/tyre_table.hpp"

namespace floatframe::test {
namespace {

using Inputs = Eigen::Matrix<double, 7, 1>;

template <class S>
MagicInput<S> input_at(const S (&x)[7]) {
  return {x[0], x[1], x[2], x[3], x[4], x[5], x[6]};
}

Inputs forces_at(const MagicTyre& tyre, const Inputs& x) {
  const double v[7] = {x[0], x[1], x[2], x[3], x[4], x[5], x[6]};
  const MagicForces<double> f = magic_forces(tyre, input_at(v));
  return (Inputs() << f.Fx, f.Fy, f.Mx, f.My, f.Mz, f.Kx, f.Ky).finished();
}

/// Central differences of the steps h, h/2 and h/4, extrapolated to an error of h^6.
Inputs difference(const std::function<Inputs(double)>& f, double h) {
  const auto slope = [&](double step) -> Inputs { return (f(step) - f(-step)) / (2.0 * step); };
  const Inputs a = slope(h), b = slope(0.5 * h), c = slope(0.25 * h);
  const Inputs first = (4.0 * b - a) / 3.0, second = (4.0 * c - b) / 3.0;
  return (16.0 * second - first) / 15.0;
}

void expect_exact_derivatives(const MagicTyre& tyre, const Inputs& at, double extent) {
  Dual x[7];
  for (int k = 0; k < 7; ++k) x[k] = Dual::variable(at[k], k);
  const MagicForces<Dual> f = magic_forces(tyre, input_at(x));
  const Dual* of[] = {&f.Fx, &f.Fy, &f.Mx, &f.My, &f.Mz, &f.Kx, &f.Ky};
  const Inputs value = forces_at(tyre, at);
  const double sizes[] = {at[0], 0.1, 0.1, 0.1, 10.0, 10.0, 1.0};
  for (int k = 0; k < 7; ++k) {
    const Inputs slope = difference(
        [&](double h) {
          Inputs near = at;
          near[k] += h;
          return forces_at(tyre, near);
        },
        extent * sizes[k]);
    for (int i = 0; i < 7; ++i) {
      EXPECT_NEAR(of[i]->v, value[i], 1e-13 * (1.0 + std::abs(value[i])));
      const double scale = std::abs(value[i]) / sizes[k] + std::abs(slope[i]) + 1.0 / sizes[k];
      EXPECT_NEAR(of[i]->d[k], slope[i], 1e-8 * scale) << "result " << i << " over input " << k;
    }
  }
}

TEST(MagicDerivatives, AreExact) {
  std::mt19937 engine(44);
  const auto random = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  for (const char* name : {"a_205_60R15_mf61.tir", "b_mf61.tir", "c_235_60R16_mf52.tir"})
    for (const MagicForm form : {MagicForm::manual, MagicForm::book}) {
      const MagicTyre tyre = magic_tyre_of(name, {.form = form});
      for (int k = 0; k < 5; ++k) {
        // Away from where E changes its side.
        const double side = k % 2 == 0 ? 1.0 : -1.0;
        Inputs at;
        at << random(2000.0, 6000.0), side * random(0.04, 0.15), side * random(0.06, 0.2),
            random(0.02, 0.08), (k == 4 ? -1.0 : 1.0) * random(5.0, 30.0), 0.0, random(0.5, 1.0);
        at[5] = (1.0 + at[1]) * at[4];
        expect_exact_derivatives(tyre, at, 2e-3);
      }
    }
}

TEST(MagicDerivatives, AreExactWhereRollingTurns) {
  const MagicTyre tyre = magic_tyre_of("a_205_60R15_mf61.tir", {.turning_speed = 40.0});
  Inputs at;
  at << 3500.0, 0.05, 0.08, 0.03, 9.0, 10.0, 0.9;
  expect_exact_derivatives(tyre, at, 2e-3);
  at[4] = -9.0;
  expect_exact_derivatives(tyre, at, 2e-3);
}

TEST(MagicLoads, FollowTheForcesWithExactDerivatives) {
  for (const char* name : {"b_mf61.tir", "b_mf62.tir"}) {
    const MagicTyre tyre = magic_tyre_of(name);
    const auto load_at = [&](const auto& radius, const auto& camber, const auto& spin) {
      return balanced_load(tyre, radius, camber, spin, [&](const auto& F) {
        using S = std::remove_cvref_t<decltype(F)>;
        MagicInput<S> in;
        in.load = F;
        in.kappa = 0.02;
        in.tan_alpha = 0.08;
        in.camber = value_of(camber);
        in.speed = in.rolling = 20.0;
        return magic_forces(tyre, in);
      });
    };
    const double radius = 0.375, spin = 50.0, camber = 0.02;
    const double load = load_at(radius, camber, spin);
    MagicInput<double> in{load, 0.02, 0.08, camber, 20.0, 20.0, 1.0};
    const MagicForces<double> f = magic_forces(tyre, in);
    EXPECT_NEAR(magic_load(tyre, radius, camber, spin, f.Fx, f.Fy), load, 1e-9 * load);
    EXPECT_LT(load, magic_load(tyre, radius, camber, spin, 0.0, 0.0));
    const Dual slope = load_at(Dual::variable(radius, 0), Dual(camber), Dual::variable(spin, 1));
    EXPECT_NEAR(slope.v, load, 1e-12 * load);
    const auto over = [&](int k, double h) {
      const auto at = [&](double s) {
        return load_at(radius + (k == 0 ? s : 0.0), camber, spin + (k == 1 ? s : 0.0));
      };
      const auto d = [&](double s) { return (at(s) - at(-s)) / (2.0 * s); };
      return (4.0 * d(0.5 * h) - d(h)) / 3.0;
    };
    EXPECT_NEAR(slope.d[0], over(0, 1e-4), 1e-7 * std::abs(slope.d[0])) << name;
    EXPECT_NEAR(slope.d[1], over(1, 0.1), 1e-7 * std::abs(slope.d[1]) + 1e-6) << name;
  }
}

// Else tyres that hold against each other at rest would swing up: what changes its sign with the
// sense of rolling, as the lateral force of longitudinal slip does, would be a damper below zero.
TEST(MagicForces, HaveNoSlopeOverTheSpeedAtRest) {
  const MagicTyre tyre = magic_tyre_of("a_205_60R15_mf61.tir");
  for (const double kappa : {-0.05, 0.0, 0.03}) {
    const Dual speed = Dual::variable(0.0, 0);
    const MagicForces<Dual> f =
        magic_forces(tyre, MagicInput<Dual>{Dual(4000.0), Dual(kappa), Dual(0.01), Dual(0.02),
                                            speed, Dual(2.0), Dual(1.0)});
    for (const Dual* x : {&f.Fx, &f.Fy, &f.Mx, &f.Mz}) EXPECT_EQ(x->d[0], 0.0);
    const auto lateral = [&](double v) {
      return magic_forces(tyre, MagicInput<double>{4000.0, kappa, 0.01, 0.02, v, 2.0, 1.0}).Fy;
    };
    EXPECT_NEAR(f.Fy.v, 0.5 * (lateral(-1.0) + lateral(1.0)), 1e-9);
    if (kappa != 0.0) {
      EXPECT_GT(std::abs(lateral(1.0) - lateral(-1.0)), 100.0);
    }
  }
}

// Spin and camber make a tyre larger: its load begins at zero nevertheless.
TEST(MagicLoads, BeginAtZero) {
  for (const char* name :
       {"a_205_60R15_mf61.tir", "b_mf61.tir", "b_mf62.tir", "c_235_60R16_mf52.tir"})
    for (const double camber : {-0.1, 0.0, 0.05}) {
      const MagicTyre tyre = magic_tyre_of(name);
      const double spin = 120.0;
      const auto load = [&](double radius) {
        return magic_load(tyre, radius, camber, spin, 0.0, 0.0);
      };
      double low = 0.9 * tyre.R0, high = 1.1 * tyre.R0;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (load(middle) > 0.0 ? low : high) = middle;
      }
      EXPECT_LT(load(low - 1e-9), 1e-3) << name << " " << camber;
      EXPECT_GE(load(low), 0.0);
      for (const double up : {1e-3, 0.1, 10.0, 1e4})
        EXPECT_LE(load(high + up), 0.0) << name << " " << camber << " " << up;
    }
}

/// Power of the forces on the sliding of the contact point; without camber a symmetric tyre never
/// delivers any.
TEST(MagicFormula, SlipOfASymmetricTyreTakesPower) {
  const MagicTyre tyre = magic_tyre_of("a_sym_mf61.tir");
  for (const double Fz : {200.0, 1000.0, 2500.0, 4000.0, 7000.0})
    for (const double Vx : {-20.0, -3.0, 3.0, 20.0})
      for (int i = -24; i <= 24; ++i)
        for (int k = -24; k <= 24; ++k) {
          const double Vsx = std::abs(Vx) * i / 20.0, Vsy = std::abs(Vx) * k / 20.0;
          const MagicForces<double> f = magic_forces(tyre, steady_input(Fz, Vx, Vsx, Vsy, 0.0));
          EXPECT_LE(f.Fx * Vsx + f.Fy * Vsy, 1e-9) << Fz << " " << Vx << " " << Vsx << " " << Vsy;
        }
}

bool all_finite(const MagicForces<Dual>& f) {
  for (const Dual* x : {&f.Fx, &f.Fy, &f.Mx, &f.My, &f.Mz, &f.Kx, &f.Ky, &f.trail, &f.residual})
    if (!std::isfinite(x->v) || !x->d.isFinite().all()) return false;
  return true;
}

TEST(MagicFormula, StaysFinite) {
  for (const char* name : {"a_205_60R15_mf61.tir", "b_mf62.tir", "c_235_60R16_mf52.tir"})
    for (const MagicForm form : {MagicForm::manual, MagicForm::book})
      for (const bool limits : {false, true}) {
        const MagicTyre tyre = magic_tyre_of(name, {.form = form, .limits = limits});
        for (const double Fz : {-10.0, 0.0, 1e-300, 1e-9, 3000.0, 1e5})
          for (const double V : {-1.0, -1e-9, 0.0, 1e-300, 0.05})
            for (const double slip : {0.0, 1e-12, 1.0, 1e8})
              for (const double camber : {0.0, 0.3}) {
                const double at[7] = {Fz, slip, -slip, camber, V, V, 0.0};
                Dual x[7];
                for (int k = 0; k < 7; ++k) x[k] = Dual::variable(at[k], k);
                EXPECT_TRUE(all_finite(magic_forces(tyre, input_at(x))))
                    << name << " " << Fz << " " << V << " " << slip << " " << camber;
              }
      }
}

TEST(MagicFormula, NothingJumpsAtRestAndAtNoLoad) {
  const MagicTyre tyre = magic_tyre_of("a_205_60R15_mf61.tir");
  const MagicInput<double> before{3000.0, 0.03, 0.05, 0.02, -1e-9, -1e-9, 1.0};
  MagicInput<double> after = before;
  after.speed = after.rolling = 1e-9;
  const MagicForces<double> f = magic_forces(tyre, before), g = magic_forces(tyre, after);
  EXPECT_NEAR(f.Fx, g.Fx, 1e-4);
  EXPECT_NEAR(f.Fy, g.Fy, 1e-4);
  EXPECT_NEAR(f.Mx, g.Mx, 1e-4);
  EXPECT_NEAR(f.My, g.My, 1e-4);
  EXPECT_NEAR(f.Mz, g.Mz, 1e-4);
  MagicInput<double> light = before;
  light.load = 1e-6;
  const MagicForces<double> h = magic_forces(tyre, light);
  EXPECT_LT(std::abs(h.Fx) + std::abs(h.Fy) + std::abs(h.Mz), 1e-5);
}

TEST(MagicFormula, RangesHoldSlipsAndLoadIfAsked) {
  const MagicTyre free = magic_tyre_of("c_235_60R16_mf52.tir");
  const MagicTyre limited = magic_tyre_of("c_235_60R16_mf52.tir", {.limits = true});
  MagicInput<double> in{5000.0, 0.1, 0.1, 0.02, 20.0, 22.0, 1.0};
  EXPECT_EQ(magic_forces(free, in).Fy, magic_forces(limited, in).Fy);
  in.kappa = 3.0;  // KPUMAX 1.5
  MagicInput<double> edge = in;
  edge.kappa = 1.5;
  EXPECT_EQ(magic_forces(limited, in).Fx, magic_forces(free, edge).Fx);
  in = {20250.0, 0.05, 0.1, 0.02, 20.0, 21.0, 1.0};  // twice FZMAX
  edge = in;
  edge.load = 10125.0;
  EXPECT_NEAR(magic_forces(limited, in).Fy, 2.0 * magic_forces(free, edge).Fy, 1e-9);
}

/// Of the peak: the slope of the pure longitudinal force vanishes.
TEST(MagicRadius, SlipOfTheLargestForce) {
  const MagicTyre tyre = magic_tyre_of("a_sym_mf61.tir");
  for (const double Fz : {1000.0, 4000.0, 7000.0}) {
    const MagicStanding<double> at(tyre, Fz, 0.0);
    const MagicPeaks<double> peaks = magic_peaks(tyre, at, false),
                             least = magic_peaks(tyre, at, true);
    EXPECT_LE(least.x, peaks.x);
    EXPECT_LE(least.y, peaks.y);
    using D = DualNumber<2>;
    MagicInput<D> in;
    in.load = Fz;
    in.kappa = D::variable(peaks.x, 0);
    in.speed = in.rolling = 20.0;
    EXPECT_NEAR(magic_forces(tyre, in).Fx.d[0], 0.0, 1e-6 * Fz);
    in.kappa = 0.0;
    in.tan_alpha = D::variable(std::tan(peaks.y), 1);
    EXPECT_NEAR(magic_forces(tyre, in).Fy.d[1], 0.0, 1e-6 * Fz);
  }
}

}  // namespace
}  // namespace floatframe::test
