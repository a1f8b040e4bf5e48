// The expression language, plain scalars and "did you mean".
#include "floatframe/yaml/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/core/suggest.hpp"

namespace floatframe {
namespace {

std::string meant(const std::string& word) { return ", did you mean '" + word + "'?"; }

const ParameterScope scope{
    {"ne", 10.0}, {"mass", 2.5}, {"flexible", true}, {"road", std::string("stairs")}};

double number(const std::string& text) {
  return std::get<double>(evaluate_expression(text, scope));
}
bool truth(const std::string& text) { return std::get<bool>(evaluate_expression(text, scope)); }
std::string error(const std::string& text) {
  try {
    evaluate_expression(text, scope);
  } catch (const ExpressionError& error) {
    return error.what();
  }
  return "none";
}

TEST(Expression, Arithmetic) {
  EXPECT_EQ(number("2*ne+1"), 21.0);
  EXPECT_EQ(number("1 + 2 * 3 - 4 / 8"), 6.5);
  EXPECT_EQ(number("8 - 3 - 2"), 3.0);
  EXPECT_EQ(number("8 / 4 / 2"), 1.0);
  EXPECT_EQ(number("-2 ^ 2"), -4.0);
  EXPECT_EQ(number("2 ^ 3 ^ 2"), 512.0);
  EXPECT_EQ(number("2 ^ -1"), 0.5);
  EXPECT_EQ(number("(1 + 2) * -(3 - 5)"), 6.0);
  EXPECT_EQ(number("1.5e-3 * 1E3"), 1.5);
  EXPECT_EQ(number("- - 3"), 3.0);
}

TEST(Expression, Functions) {
  EXPECT_EQ(number("sqrt(16)"), 4.0);
  EXPECT_EQ(number("sin(pi / 2)"), 1.0);
  EXPECT_EQ(number("atan2(1, -1)"), std::atan2(1.0, -1.0));
  EXPECT_EQ(number("max(1, mass, 2)"), 2.5);
  EXPECT_EQ(number("min(3, 1, 2)"), 1.0);
  EXPECT_EQ(number("abs(-3)"), 3.0);
  EXPECT_EQ(number("floor(2.7) + ceil(2.2) + round(2.5)"), 8.0);
  EXPECT_EQ(number("exp(log(7))"), std::exp(std::log(7.0)));
  EXPECT_EQ(number("4 * atan(1)"), std::numbers::pi);
}

TEST(Expression, Conditions) {
  EXPECT_TRUE(truth("flexible and not (ne < 5)"));
  EXPECT_TRUE(truth("road == 'stairs' or false"));
  EXPECT_FALSE(truth("road != \"stairs\""));
  EXPECT_TRUE(truth("ne >= 10 and ne <= 10"));
  EXPECT_EQ(number("if(flexible, 1, 2)"), 1.0);
  EXPECT_EQ(std::get<std::string>(evaluate_expression("if(ne > 50, 'fine', 'coarse')", scope)),
            "coarse");
}

TEST(Expression, Errors) {
  EXPECT_EQ(error(""), "the expression is empty");
  EXPECT_EQ(error("1 +"), "a value is missing at the end");
  EXPECT_EQ(error("(1 + 2"), "a ')' is missing");
  EXPECT_EQ(error("1 2"), "unexpected '2'");
  EXPECT_EQ(error("nee"), "unknown parameter 'nee', did you mean 'ne'?");
  EXPECT_EQ(error("and"), "unexpected 'and'");
  EXPECT_EQ(error("sqr(2)"), "unknown function 'sqr', did you mean 'sqrt'?");
  EXPECT_EQ(error("sqrt(-1)"), "sqrt of -1 is not defined");
  EXPECT_EQ(error("log(0)"), "log of 0 is not defined");
  EXPECT_EQ(error("asin(2)"), "asin of 2 is not defined");
  EXPECT_EQ(error("1 / (ne - 10)"), "division by zero");
  EXPECT_EQ(error("10 ^ 400"), "the result is not a finite number");
  EXPECT_EQ(error("road + 1"), "'+' needs numbers, found 'stairs'");
  EXPECT_EQ(error("flexible * 2"), "'*' needs numbers, found true");
  EXPECT_EQ(error("not 3"), "'not' needs true or false, found 3");
  EXPECT_EQ(error("road == 3"), "cannot compare a text with a number");
  EXPECT_EQ(error("atan2(1)"), "atan2 takes 2 arguments, found 1");
  EXPECT_EQ(error("010"), "'010' is not a number (a number must not start with 0)");
  EXPECT_EQ(error("0x10"), "'0x10' is not a number (write a decimal number)");
  EXPECT_EQ(error("'open"), "a text is not closed");
  EXPECT_EQ(error(std::string(100000, '(')), "nested too deeply");
  EXPECT_EQ(error(std::string(100000, '-')), "nested too deeply");
}

TEST(Expression, OnlyWhatIsNeededIsComputed) {
  const ParameterScope zero{{"a", 0.0}, {"on", false}, {"road", std::string("stairs")}};
  const auto value = [&](const char* text) { return evaluate_expression(text, zero); };
  const auto complaint = [&](const char* text) {
    try {
      evaluate_expression(text, zero);
    } catch (const ExpressionError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(std::get<double>(value("if(a == 0, 1, 1 / a)")), 1.0);
  EXPECT_EQ(std::get<double>(value("if(a != 0, 1 / a, sqrt(4))")), 2.0);
  EXPECT_EQ(std::get<double>(value("if(true, 1, if(true, sqrt(-1), 10 ^ 999) + log(a))")), 1.0);
  EXPECT_EQ(std::get<double>(value("if(a == 0, 1, if(1 / a > 2, 'x', 3) + 1)")), 1.0);
  EXPECT_FALSE(std::get<bool>(value("a != 0 and 1 / a > 2")));
  EXPECT_TRUE(std::get<bool>(value("a == 0 or 1 / a > 2")));
  EXPECT_TRUE(std::get<bool>(value("on and 1 / a > 2 or a == 0 or log(a) > 1")));
  EXPECT_FALSE(std::get<bool>(value("not (a == 0 or 1 / a > 2)")));
  EXPECT_TRUE(std::get<bool>(value("if(on and 1 / a > 0, false, true)")));
  EXPECT_EQ(complaint("if(a == 1, 1, 1 / a)"), "division by zero");
  EXPECT_EQ(complaint("a == 0 and 1 / a > 2"), "division by zero");
  EXPECT_EQ(complaint("on or 1 / a > 2"), "division by zero");
  EXPECT_EQ(complaint("if(a == 0, 1, 1 / b)"), "unknown parameter 'b'");
  EXPECT_EQ(complaint("if(a == 0, 1, 1 / )"), "unexpected ')'");
  EXPECT_EQ(complaint("if(a == 0, 1, (1 / a)"), "a ')' is missing");
  EXPECT_EQ(complaint("if(a == 0, 1, road + 1)"), "'+' needs numbers, found 'stairs'");
  EXPECT_EQ(complaint("if(a == 0, 1, sqrt(1, 2))"), "sqrt takes 1 argument, found 2");
  EXPECT_EQ(complaint("if(a == 0, 1, sqr(4))"), "unknown function 'sqr', did you mean 'sqrt'?");
  EXPECT_EQ(complaint("if(a == 0, 1, not (1 / a))"), "'not' needs true or false, found a number");
  EXPECT_EQ(complaint("if(a == 0, 1, 1 / a == 'x')"), "cannot compare a number with a text");
  EXPECT_EQ(complaint("if(a == 0, 1)"), "if takes 3 arguments, found 2");
  EXPECT_EQ(complaint("if(a, 1, 2)"), "'if' needs true or false, found 0");
  EXPECT_EQ(complaint("on and 3"), "'and' needs true or false, found 3");
  EXPECT_EQ(complaint("a == 0 or road"), "'or' needs true or false, found 'stairs'");
}

TEST(Expression, Constants) {
  EXPECT_DOUBLE_EQ(number("30 * deg"), std::numbers::pi / 6);
  EXPECT_DOUBLE_EQ(number("90 * km_h"), 25.0);
  EXPECT_DOUBLE_EQ(number("60 * rpm"), 2 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(number("18 * inch"), 0.4572);
  EXPECT_DOUBLE_EQ(number("250 * mm"), 0.25);
  EXPECT_DOUBLE_EQ(number("3 * g0"), 29.41995);
  // A parameter of the user goes first.
  EXPECT_EQ(std::get<double>(evaluate_expression("2 * mm", {{"mm", 7.0}})), 14.0);
  EXPECT_EQ(error("dge"), "unknown parameter 'dge', did you mean 'deg'?");
}

TEST(Expression, LongTextsAreRefused) {
  const ParameterScope long_one{{"a", std::string(10000, 'x')}};
  EXPECT_EQ(std::get<std::string>(substitute_parameters("${a}-${5}", long_one)).size(), 10002u);
  EXPECT_THROW(substitute_parameters("${a}${a}", long_one), ExpressionError);
}

TEST(Expression, Substitution) {
  EXPECT_EQ(std::get<double>(substitute_parameters("${ne}", scope)), 10.0);
  EXPECT_EQ(std::get<bool>(substitute_parameters("${flexible}", scope)), true);
  EXPECT_EQ(std::get<std::string>(substitute_parameters("bar_${ne}_${road}", scope)),
            "bar_10_stairs");
  EXPECT_EQ(std::get<std::string>(substitute_parameters("plain", scope)), "plain");
  EXPECT_THROW(substitute_parameters("${ne", scope), ExpressionError);
}

TEST(PlainScalars, AreClassified) {
  using Kind = PlainScalar::Kind;
  const auto kind = [](const char* text) { return classify_plain_scalar(text).kind; };
  for (const char* text : {"0", "-3", "+2.5", ".5", "5.", "1e3", "1.5E-3", "0.0", "-0"})
    EXPECT_EQ(kind(text), Kind::number) << text;
  for (const char* text : {"010", "-07", "0x1F", "1_000", ".inf", "-.INF", ".nan", "NaN", "1e999"})
    EXPECT_EQ(kind(text), Kind::bad_number) << text;
  for (const char* text : {"yes", "No", "on", "OFF", "True", "FALSE"})
    EXPECT_EQ(kind(text), Kind::bad_boolean) << text;
  for (const char* text : {"front", "1a", "3 m", "-", ".", "e5", "1e", "--1", "1.2.3"})
    EXPECT_EQ(kind(text), Kind::text) << text;
  for (const char* text : {"", "~", "null"}) EXPECT_EQ(kind(text), Kind::null) << text;
  EXPECT_EQ(classify_plain_scalar("-1.25e2").number, -125.0);
  EXPECT_EQ(classify_plain_scalar("1e-999").number, 0.0);
}

TEST(Suggestion, NearestKnownName) {
  const std::vector<std::string> known{"clamped", "static_modes", "normal_modes"};
  EXPECT_EQ(did_you_mean("clampd", known), meant("clamped"));
  EXPECT_EQ(did_you_mean("Clamped", known), meant("clamped"));
  EXPECT_EQ(did_you_mean("calmped", known), meant("clamped"));
  EXPECT_EQ(did_you_mean("colour", known), "");
  EXPECT_EQ(did_you_mean("mas", {"masses", "mass_model"}), meant("masses"));
  EXPECT_EQ(did_you_mean("mas", {"material", "mass"}), meant("mass"));
  EXPECT_EQ(did_you_mean("ma", {"masses"}), "");
  EXPECT_EQ(edit_distance("abcd", "abdc"), 1);
  EXPECT_EQ(edit_distance("", "abc"), 3);
}

}  // namespace
}  // namespace floatframe
