// The Magic Formula against tables of two programs that share no code (README of the data): every
// row within 1e-8 of the largest value of its column.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tyres/tyre_table.hpp"

namespace floatframe::test {
namespace {

struct ReferenceSet {
  const char* name;
  const char* tyre;
  MagicForm form;
};

/// Compares a computed value with a column, if the table has it there.
void compare_cell(const TyreTable& table, std::size_t row, const std::string& column,
                  double value) {
  if (!table.has(column) || std::isnan(table.at(row, column))) return;
  EXPECT_NEAR(value, table.at(row, column), 1e-8 * table.scale(column) + 1e-300)
      << column << " of row " << table.at(row, "id");
}

/// Keeps the largest deviation of its test, as part of the largest value of the column.
class MagicReference : public ::testing::TestWithParam<ReferenceSet> {
 protected:
  void TearDown() override {
    if (worst < 0.0) return;
    std::printf("[ figure ] %s %s, %s %.3g\n", GetParam().name,
                GetParam().form == MagicForm::book ? "book" : "manual",
                ::testing::UnitTest::GetInstance()->current_test_info()->name(), worst);
  }
  void compare(const TyreTable& table, std::size_t row, const std::string& column, double value) {
    compare_cell(table, row, column, value);
    if (!table.has(column) || std::isnan(table.at(row, column))) return;
    worst = std::max(worst, std::abs(value - table.at(row, column)) / table.scale(column));
  }
  double worst = -1.0;
};

MagicTyre tyre_of_row(const TirFile& file, const TyreTable& table, std::size_t row, MagicForm form,
                      MagicSide side = MagicSide::file) {
  return magic_tyre(file, {.form = form, .pressure = table.at(row, "p_Pa"), .side = side});
}

TEST_P(MagicReference, ForcesAndMomentsOfEveryRow) {
  const ReferenceSet set = GetParam();
  const TyreTable table = tyre_table(std::string(set.name) + ".csv");
  const TirFile file = read_tir(tyre_data(set.tyre));
  const bool book = set.form == MagicForm::book;
  const std::string suffix = book ? "_star" : "";
  ASSERT_GT(table.rows.size(), 140U);
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const MagicTyre tyre = tyre_of_row(file, table, k, set.form);
    const MagicForces<double> f = magic_forces(tyre, input_of(table, k));
    compare(table, k, "Fx" + suffix, f.Fx);
    compare(table, k, "Fy" + suffix, f.Fy);
    compare(table, k, "Mx" + suffix, f.Mx);
    compare(table, k, "My" + suffix, f.My);
    compare(table, k, "Mz" + suffix, f.Mz);
    if (book) continue;
    compare(table, k, "Kxk", f.Kx);
    compare(table, k, "Kya", f.Ky);
    compare(table, k, "mux", f.mux);
    compare(table, k, "muy", f.muy);
    compare(table, k, "t", f.trail);
    compare(table, k, "Mzr", f.residual);
  }
}

/// On the other side the tyre is the mirror image: angle and camber with the other sign give Fy, Mx
/// and Mz with the other sign.
TEST_P(MagicReference, OtherSide) {
  const ReferenceSet set = GetParam();
  const TyreTable table = tyre_table(std::string(set.name) + ".csv");
  const TirFile file = read_tir(tyre_data(set.tyre));
  const std::string suffix = set.form == MagicForm::book ? "_star" : "";
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const MagicTyre tyre = tyre_of_row(file, table, k, set.form, MagicSide::right);
    MagicInput<double> in = input_of(table, k);
    in.tan_alpha = -in.tan_alpha;
    in.camber = -in.camber;
    const MagicForces<double> f = magic_forces(tyre, in);
    compare(table, k, "Fx" + suffix, f.Fx);
    compare(table, k, "Fy" + suffix, -f.Fy);
    compare(table, k, "Mx" + suffix, -f.Mx);
    compare(table, k, "My" + suffix, f.My);
    compare(table, k, "Mz" + suffix, -f.Mz);
  }
}

/// Loaded and effective radius at the spin omega = (1 + kappa) Vx/Re, patch, stiffnesses, lengths.
TEST_P(MagicReference, RadiiPatchAndLengthsOfEveryRow) {
  const ReferenceSet set = GetParam();
  if (set.form == MagicForm::book) GTEST_SKIP() << "the same in both forms";
  const TyreTable table = tyre_table(std::string(set.name) + ".csv");
  const TirFile file = read_tir(tyre_data(set.tyre));
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const MagicTyre tyre = tyre_of_row(file, table, k, set.form);
    const MagicInput<double> in = input_of(table, k);
    const MagicForces<double> f = magic_forces(tyre, in);
    double spin = in.speed / tyre.R0;
    for (int i = 0; i < 60; ++i) spin = in.rolling / magic_effective_radius(tyre, in.load, spin);
    const double free = free_radius(tyre, spin);
    double low = 0.6 * free, high = free;  // the load falls with the radius
    for (int i = 0; i < 80; ++i) {
      const double middle = 0.5 * (low + high);
      (magic_load(tyre, middle, in.camber, spin, f.Fx, f.Fy) > in.load ? low : high) = middle;
    }
    compare(table, k, "Re", magic_effective_radius(tyre, in.load, spin));
    compare(table, k, "Rl", low);
    // In 6.2 the column holds the deflection with the part of the camber.
    if (tyre.version == MagicVersion::mf61) compare(table, k, "rho", free - low);
    compare(table, k, "a", magic_patch(tyre, in.load).length);
    compare(table, k, "b", magic_patch(tyre, in.load).width);
    const MagicLengths<double> lengths = magic_lengths(tyre, in.load, in.camber);
    compare(table, k, "Cx", lengths.Cx);
    compare(table, k, "Cy", lengths.Cy);
    compare(table, k, "sigma_x", lengths.sigma_x);
    compare(table, k, "sigma_y", lengths.sigma_y);
  }
}

constexpr MagicForm manual = MagicForm::manual, book = MagicForm::book;
INSTANTIATE_TEST_SUITE_P(
    Sets, MagicReference,
    ::testing::Values(ReferenceSet{"a_205_60R15_mf61", "a_205_60R15_mf61.tir", manual},
                      ReferenceSet{"a_205_60R15_mf61", "a_205_60R15_mf61.tir", book},
                      ReferenceSet{"b_mf61", "b_mf61.tir", manual},
                      ReferenceSet{"b_mf61", "b_mf61.tir", book},
                      ReferenceSet{"b_mf61_lfzo", "b_mf61_lfzo.tir", manual},
                      ReferenceSet{"b_mf62", "b_mf62.tir", manual},
                      ReferenceSet{"c_235_60R16_mf52", "c_235_60R16_mf52.tir", manual},
                      ReferenceSet{"c_235_60R16_mf52", "c_235_60R16_mf52.tir", book}));

TEST(MagicFormula, RollsBackwardsAsTheMirrorImage) {
  const TyreTable table = tyre_table("a_sym_reverse.csv");
  const MagicTyre tyre = magic_tyre_of("a_sym_mf61.tir");
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const MagicInput<double> in =
        steady_input(table.at(k, "Fz_N"), table.at(k, "Vcx"), table.at(k, "Vsx"),
                     table.at(k, "Vcy"), table.at(k, "gamma_deg") * degree);
    const MagicForces<double> f = magic_forces(tyre, in);
    compare_cell(table, k, "Fx", f.Fx);
    compare_cell(table, k, "Fy", f.Fy);
    compare_cell(table, k, "Mx", f.Mx);
    compare_cell(table, k, "My", f.My);
    compare_cell(table, k, "Mz", f.Mz);
  }
}

TEST(MagicFormula, RelaxationLengthsOf52) {
  const TyreTable table = tyre_table("c_relaxation_mf52.csv");
  const MagicTyre tyre = magic_tyre_of("c_235_60R16_mf52.tir");
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const double camber = table.at(k, "gamma_deg") * degree;
    const MagicLengths<double> l = magic_lengths(tyre, table.at(k, "Fz_N"), camber);
    EXPECT_NEAR(l.sigma_x, table.at(k, "sigma_kappa_m"), 1e-8);
    EXPECT_NEAR(l.sigma_y, table.at(k, "sigma_alpha_m"), 1e-8);
  }
}

/// A first-order lag of tan(alpha): 1 - exp(-V t/sigma) of it, and its gain and phase.
TEST(MagicFormula, RelaxationInItsClosedForm) {
  const MagicTyre tyre = magic_tyre_of("a_205_60R15_mf61.tir");
  const TyreTable steps = tyre_table("relaxation_step.csv");
  for (std::size_t k = 0; k < steps.rows.size(); ++k) {
    const double Fz = steps.at(k, "Fz_N"), V = steps.at(k, "Vx");
    const double sigma = magic_lengths(tyre, Fz, 0.0).sigma_y;
    EXPECT_NEAR(sigma, steps.at(k, "sigma_m"), 1e-8);
    const double lagged = std::tan(steps.at(k, "alpha_step_deg") * degree) *
                          -std::expm1(-V * steps.at(k, "t_s") / sigma);
    EXPECT_NEAR(std::atan(lagged) / degree, steps.at(k, "alpha_lagged_deg"), 1e-8);
    const MagicForces<double> f =
        magic_forces(tyre, MagicInput<double>{Fz, 0.0, lagged, 0.0, V, V, 1.0});
    EXPECT_NEAR(f.Fy, steps.at(k, "Fy_N"), 1e-8 * steps.scale("Fy_N"));
  }
  const TyreTable sines = tyre_table("relaxation_sine.csv");
  for (std::size_t k = 0; k < sines.rows.size(); ++k) {
    const double sigma = magic_lengths(tyre, sines.at(k, "Fz_N"), 0.0).sigma_y;
    const double w = 2.0 * std::numbers::pi * sines.at(k, "f_Hz") * sigma / sines.at(k, "Vx");
    EXPECT_NEAR(1.0 / std::sqrt(1.0 + w * w), sines.at(k, "gain"), 1e-8);
    EXPECT_NEAR(-std::atan(w) / degree, sines.at(k, "phase_deg"), 1e-7);
  }
}

}  // namespace
}  // namespace floatframe::test
