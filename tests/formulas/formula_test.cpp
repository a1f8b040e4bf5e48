// Formulas: values, exact derivatives, switches, faults.
#include <gtest/gtest.h>

#include <random>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/formulas/formula_evaluation.hpp"
#include "support/random_count.hpp"

namespace floatframe {
namespace {

double value(const std::string& text, const std::vector<double>& x = {},
             const FormulaTables& tables = {}) {
  FormulaSwitches switches;
  FormulaFault fault;
  const SharedFormula f = formula(text, tables);
  return evaluate_formula<double>(
      *f, [&](int i) { return x[static_cast<std::size_t>(i)]; }, switches, fault);
}
std::string fault_of(const std::string& text, const std::vector<double>& x) {
  FormulaSwitches switches;
  FormulaFault fault;
  const SharedFormula f = formula(text);
  EXPECT_TRUE(std::isnan(evaluate_formula<double>(
      *f, [&](int i) { return x[static_cast<std::size_t>(i)]; }, switches, fault)));
  return fault_text(*f, fault);
}
std::string error(const std::string& text) {
  try {
    formula(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "none";
}

TEST(Formula, Values) {
  EXPECT_EQ(value("1 + 2 * 3 - 4 / 8"), 6.5);
  EXPECT_EQ(value("-2 ^ 2"), -4.0);
  EXPECT_EQ(value("2 ^ 3 ^ 2"), 512.0);
  EXPECT_EQ(value("clip(x, -1, 2) + 10 * clip(y, -1, 2)", {3.0, -7.0}), -8.0);
  EXPECT_EQ(value("if(x > 1 and y < 2, sqrt(x - 1), -1)", {5.0, 1.0}), 2.0);
  EXPECT_EQ(value("if(x > 1 and y < 2, sqrt(x - 1), -1)", {0.0, 1.0}), -1.0);
  EXPECT_EQ(value("if(x > 1 or not (y == 2), 1, 0)", {0.0, 2.0}), 0.0);
  EXPECT_EQ(value("if(x != 1 or y >= 2, 1, 0)", {1.0, 2.0}), 1.0);
  EXPECT_EQ(value("min(x, 3, y) + max(x, 3, y)", {1.0, 7.0}), 8.0);
  EXPECT_EQ(value("sign(x) + sign(y)", {-2.0, 0.0}), -1.0);
  EXPECT_EQ(value("smoothstep(x, 1, 10, 3, 20)", {2.0}), 15.0);
  EXPECT_EQ(value("smoothstep(x, 1, 10, 3, 20)", {9.0}), 20.0);
  EXPECT_EQ(value("sum_of_sines(x, 2, 1, 0, 3, 2, pi / 2)", {0.0}), 3.0);
  EXPECT_NEAR(value("chirp(x, 1, 3, 2)", {2.0}), std::sin(2 * std::numbers::pi * 4.0), 1e-14);
  EXPECT_EQ(value("atan2(y, x)", {1.0, -1.0}), std::atan2(1.0, -1.0));
  EXPECT_EQ(value("90 * deg"), std::numbers::pi / 2);
}

TEST(Formula, ReferencesAreFoundOnce) {
  const SharedFormula f =
      formula("tip.z + angle(arm) + rotation(body, yaw) + angle('arm') + angle(a, 2) + t + time");
  ASSERT_EQ(f->references.size(), 5u);
  EXPECT_EQ(f->references[0], (FormulaReference{"", "tip.z", ""}));
  EXPECT_EQ(f->references[1], (FormulaReference{"angle", "arm", ""}));
  EXPECT_EQ(f->references[2], (FormulaReference{"rotation", "body", "yaw"}));
  EXPECT_EQ(f->references[3], (FormulaReference{"angle", "a", "2"}));
  EXPECT_TRUE(f->references[4].is_time());
  EXPECT_FALSE(f->is_of_time());
  EXPECT_EQ(formula(f->text)->text, f->text);
}

TEST(Formula, ConstantsAreFolded) {
  EXPECT_EQ(formula("2 * pi * 3 ^ 2 * sqrt(4) + clip(1, 2, 3)")->steps.size(), 5u);
  EXPECT_EQ(formula("if(x > 1, 2 * 3, 4 * 5) * 2")->steps.size(), 9u);
}

TEST(Formula, Faults) {
  EXPECT_EQ(fault_of("1 + y / x", {2.0, 0.0}), "division by zero in '(y / x)'");
  EXPECT_EQ(fault_of("sqrt(x)", {-4.0}), "'sqrt(x)' is not defined for -4");
  EXPECT_EQ(fault_of("x ^ 0.5", {-4.0}), "'(x ^ 0.5)' is not defined for -4");
  EXPECT_EQ(fault_of("exp(x)", {1e4}), "'exp(x)' is not a finite number");
  EXPECT_EQ(value("if(x > 0, sqrt(x), 0)", {-4.0}), 0.0);
  EXPECT_EQ(value("max(x, 0) ^ y", {-4.0, 1.5}), 0.0);
  EXPECT_EQ(fault_of("x ^ y", {0.0, -1.0}), "'(x ^ y)' is not defined for 0");
}

// What is chosen from leaves one value behind it, however often that is done.
TEST(Formula, AnyNumberOfBranches) {
  std::string sum = "0", all = "x > 0", deep = "x";
  for (int k = 0; k < 100; ++k) {
    sum += " + if(x > " + std::to_string(k) + " and (y > 0 or x > 1), 1, y)";
    all += " and x > " + std::to_string(k - 100);
  }
  EXPECT_EQ(value(sum, {40.5, 2.0}), 41.0 + 59 * 2.0);
  EXPECT_EQ(value("if(" + all + ", 1, 2) + x", {0.5}), 1.5);
  for (int k = 0; k < 40; ++k) deep = "(2 - (x + " + deep + "))";
  EXPECT_TRUE(error(deep).ends_with("nested too deeply")) << error(deep);
}

TEST(Formula, Errors) {
  EXPECT_EQ(error("1 +"), "formula '1 +': a value is missing at the end");
  EXPECT_EQ(error("x > 1"),
            "formula 'x > 1': found a condition, expected a number: if(condition, a, b) chooses "
            "one");
  EXPECT_EQ(error("clip(1, 2)"), "formula 'clip(1, 2)': clip takes 3 arguments, found 2");
  EXPECT_EQ(error("chirp(t, x, 1, 2)"),
            "formula 'chirp(t, x, 1, 2)': found 'x' in 'chirp', expected a constant number");
  EXPECT_EQ(error("'a' + 1"), "formula ''a' + 1': found the text 'a', expected a number");
  EXPECT_EQ(error("table(gas, t)"), "formula 'table(gas, t)': unknown table 'gas'");
  EXPECT_EQ(error("if(1, 2, 3)"), "formula 'if(1, 2, 3)': 'if' needs true or false, found '1'");
  EXPECT_EQ(error("(x < 1) + 1"), "formula '(x < 1) + 1': '+' needs numbers, found '(x < 1)'");
}

TEST(Formula, Tables) {
  FormulaTables tables;
  tables.curves["c"] =
      std::make_shared<PiecewisePolynomial>(PiecewisePolynomial::polynomial({1.0, 2.0, 3.0}));
  GridTable grid{(VecX(3) << 0.0, 1.0, 3.0).finished(), (VecX(2) << 0.0, 2.0).finished(),
                 (MatX(3, 2) << 0.0, 4.0, 1.0, 5.0, 7.0, 9.0).finished()};
  tables.grids["g"] = std::make_shared<GridTable>(grid);
  EXPECT_EQ(value("table(c, x)", {2.0}, tables), 17.0);
  EXPECT_EQ(value("table2('g', x, y)", {2.0, 1.0}, tables), 5.5);
  EXPECT_EQ(value("table2(g, x, y)", {9.0, -1.0}, tables), 7.0);
  EXPECT_THROW(formula("table2(c, t, t)", tables), InputError);
}

TEST(Formula, NoiseIsLinearBetweenNormalNumbers) {
  const SharedFormula f = formula("noise(3, 0.01)");
  double sum = 0.0, squares = 0.0;
  constexpr int n = 40000;
  for (int k = 0; k < n; ++k) {
    const double x = formula_at(*f, 0.01 * k).f;
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / n, 0.0, 0.02);
  EXPECT_NEAR(squares / n, 1.0, 0.03);
  const PiecewisePolynomial::Value a = formula_at(*f, 0.012), b = formula_at(*f, 0.018);
  EXPECT_NEAR(b.f - a.f, 0.006 * a.df, 1e-12);
  EXPECT_NE(formula_at(*formula("noise(4, 0.01)"), 0.0).f, formula_at(*f, 0.0).f);
}

TEST(Formula, DerivativesInTime) {
  for (const char* text :
       {"3 * sin(2 * t) ^ 2 + t ^ 3", "exp(-t) * cos(5 * t)", "atan2(sin(t), 0.3 + cos(t))",
        "smoothstep(t, 0, 1, 2, 5)", "t ^ (1 + t)", "chirp(t, 1, 3, 2)", "tanh(t) / (1 + t)",
        "asin(0.3 * t) + acos(0.2 * t) + atan(t) + tan(0.4 * t)", "log(1 + t) * sqrt(1 + t)",
        "sum_of_sines(t, 1, 2, 0.1, 3, 0.5, 0)", "sign(t - 0.5, 0.1)"}) {
    const SharedFormula f = formula(text);
    const double t = 0.7, h = 1e-4;
    const auto at = [&](double x) { return formula_at(*f, x); };
    EXPECT_NEAR(at(t).df, (at(t + h).f - at(t - h).f) / (2 * h), 1e-4) << text;
    EXPECT_NEAR(at(t).ddf, (at(t + h).df - at(t - h).df) / (2 * h), 1e-3) << text;
  }
}

// The second derivative of x^n, 1 < n < 2, is infinite at zero.
TEST(Formula, RootsAtZero) {
  for (const char* const text : {"(t^2)^1.5", "t^1.5", "sqrt(t)", "(1 - cos(t))^1.25 + t^3"}) {
    const PiecewisePolynomial::Value v = formula_at(*formula(text), 0.0);
    EXPECT_EQ(v.f, 0.0) << text;
    EXPECT_EQ(v.df, 0.0) << text;
    EXPECT_EQ(v.ddf, 0.0) << text;
  }
  EXPECT_NEAR(formula_at(*formula("(t^2)^1.5"), 0.1).ddf, 0.6, 1e-14);
}

/// A random formula of x, y and z.
std::string random_formula(std::mt19937& random, int depth) {
  const auto number = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  if (depth == 0) {
    constexpr const char* leaves[] = {"x", "y", "z", "0.7", "2"};
    return leaves[number(5)];
  }
  const auto part = [&] { return random_formula(random, depth - 1); };
  switch (number(14)) {
    case 0:
      return "(" + part() + " + " + part() + ")";
    case 1:
      return "(" + part() + " - " + part() + ")";
    case 2:
      return "(" + part() + " * " + part() + ")";
    case 3:
      return "(" + part() + " / (3 + sin(" + part() + ")))";
    case 4:
      return "sin(" + part() + ")";
    case 5:
      return "exp(tanh(" + part() + "))";
    case 6:
      return "sqrt(1 + (" + part() + ") ^ 2)";
    case 7:
      return "atan2(" + part() + ", 2 + cos(" + part() + "))";
    case 8:
      return "if(" + part() + " < " + part() + ", " + part() + ", " + part() + ")";
    case 9:
      return "clip(" + part() + ", -2.3, 1.7)";
    case 10:
      return "smoothstep(" + part() + ", -1.1, 0.2, 1.3, " + part() + ")";
    case 11:
      return "max(" + part() + ", " + part() + ")";
    case 12:
      return "abs(" + part() + ")";
    default:
      return "(2 + cos(" + part() + ")) ^ sin(" + part() + ")";
  }
}

TEST(Formula, DerivativesOfRandomFormulas) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-2.0, 2.0);
  using D = DualNumber<3>;
  int compared = 0;
  const int count = test::random_count(500);
  for (int n = 0; n < count; ++n) {
    const std::string text = random_formula(random, 3 + n % 3);
    const SharedFormula f = formula(text);
    const std::vector<double> at{any(random), any(random), any(random)};
    const auto place = [&](int i) {
      return f->references[static_cast<std::size_t>(i)].name[0] - 'x';
    };
    FormulaSwitches pieces;
    FormulaFault fault;
    const D exact = evaluate_formula<D>(
        *f, [&](int i) { return D::variable(at[static_cast<std::size_t>(place(i))], place(i)); },
        pieces, fault);
    if (fault.kind != FormulaFault::Kind::none) continue;
    for (int k = 0; k < 3; ++k) {
      const auto difference = [&](double h) {
        const auto moved = [&](double by) {
          FormulaSwitches held;
          held.held = pieces.present;
          return evaluate_formula<double>(
              *f,
              [&](int i) {
                return at[static_cast<std::size_t>(place(i))] + (place(i) == k ? by : 0.0);
              },
              held, fault);
        };
        return (moved(h) - moved(-h)) / (2.0 * h);
      };
      const double h = 1e-3, extrapolated = (4.0 * difference(h / 2) - difference(h)) / 3.0;
      const double size = std::max(1.0, std::abs(extrapolated));
      // Differences across the ends of a smoothstep, which hold no switch, converge slowly.
      if (std::abs(difference(h / 2) - difference(h)) > 1e-4 * size) continue;
      EXPECT_NEAR(exact.d[k], extrapolated, 1e-7 * size) << text;
      ++compared;
    }
  }
  EXPECT_GT(compared, 13 * count / 5);
}

TEST(Formula, SwitchesAreHeldAndFindTheirEdges) {
  const SharedFormula f = formula("if(x < 1, x ^ 2, clip(x, 0, 5))");
  const auto at = [&](double x, std::int64_t held) {
    FormulaSwitches s;
    s.held = held;
    FormulaFault fault;
    const double y = evaluate_formula<double>(
        *f, [&](int) { return x; }, s, fault);
    return std::pair(y, s);
  };
  const auto [y, free] = at(0.5, 0);
  EXPECT_EQ(y, 0.25);
  EXPECT_EQ(free.present, 1);  // below 1; the clip was not evaluated
  const auto [beyond, held] = at(1.5, free.present);
  EXPECT_EQ(beyond, 2.25);
  EXPECT_EQ(held.beyond, 0.5);
  EXPECT_EQ(held.crossed, 0);
  EXPECT_EQ(held.next, 2);
  const auto [above, clipped] = at(6.0, 2 + 4 * 2);
  EXPECT_EQ(above, 6.0);
  EXPECT_EQ(clipped.beyond, 1.0);
  EXPECT_EQ(clipped.crossed, 1);
  EXPECT_EQ(clipped.next, 3);
}

}  // namespace
}  // namespace floatframe
