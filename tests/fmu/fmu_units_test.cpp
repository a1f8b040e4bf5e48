// Units as text against their definitions.
#include "floatframe/fmu/fmu_units.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

using Exponents = std::array<int, 8>;  // kg m s A K mol cd rad

void expect_unit(const char* text, const Exponents& exponents, double factor = 1.0,
                 double offset = 0.0) {
  const std::optional<FmuUnit> unit = fmu_unit(text);
  ASSERT_TRUE(unit) << text;
  EXPECT_EQ(unit->exponents, exponents) << text;
  EXPECT_DOUBLE_EQ(unit->factor, factor) << text;
  EXPECT_DOUBLE_EQ(unit->offset, offset) << text;
}

TEST(FmuUnits, ProductsQuotientsAndExponents) {
  expect_unit("m", {0, 1});
  expect_unit("m/s2", {0, 1, -2});
  expect_unit("m/s^2", {0, 1, -2});
  expect_unit("m s-2", {0, 1, -2});
  expect_unit("m/s²", {0, 1, -2});
  expect_unit("kg m2", {1, 2});
  expect_unit("N m", {1, 2, -2});
  expect_unit("N.m", {1, 2, -2});
  expect_unit("N*m*s", {1, 2, -1});
  expect_unit("N s/m", {1, 0, -1});
  expect_unit("N/(m/s)", {1, 0, -1});
  expect_unit("N s/(m rad)", {1, 0, -1, 0, 0, 0, 0, -1});
  expect_unit("N m/rad", {1, 2, -2, 0, 0, 0, 0, -1});
  expect_unit("m/s/s", {0, 1, -2});
  expect_unit("1/s2", {0, 0, -2});
  expect_unit("1", {});
  expect_unit("-", {});
  expect_unit(" m ", {0, 1});
}

TEST(FmuUnits, Factors) {
  constexpr double degree = std::numbers::pi / 180.0;
  expect_unit("deg", {0, 0, 0, 0, 0, 0, 0, 1}, degree);
  expect_unit("deg/s", {0, 0, -1, 0, 0, 0, 0, 1}, degree);
  expect_unit("rpm", {0, 0, -1, 0, 0, 0, 0, 1}, std::numbers::pi / 30.0);
  expect_unit("km/h", {0, 1, -1}, 1.0 / 3.6);
  expect_unit("bar", {1, -1, -2}, 1e5);
  expect_unit("MPa", {1, -1, -2}, 1e6);
  expect_unit("mm", {0, 1}, 1e-3);
  expect_unit("mm2", {0, 2}, 1e-6);
  expect_unit("kN m", {1, 2, -2}, 1e3);
  expect_unit("kNm", {1, 2, -2}, 1e3);
  expect_unit("N/mm", {1, 0, -2}, 1e3);
  expect_unit("%", {}, 0.01);
  expect_unit("min", {0, 0, 1}, 60.0);
  expect_unit("ms", {0, 0, 1}, 1e-3);
  expect_unit("degC", {0, 0, 0, 0, 1}, 1.0, 273.15);
}

TEST(FmuUnits, WhatIsUnknownOrHasTwoMeaningsIsNone) {
  for (const char* text : {"",     " ",  "g",    "furlong", "N or N m", "J/kg K",
                           "m/",   "/m", "m//s", "(m",      "m)",       "10 N",
                           "12",   "m^", "mmm",  "kkg",     "m s)",     "((((((((((m))))))))))",
                           "m^99", "m-"})
    EXPECT_FALSE(fmu_unit(text)) << text;
}

// All units that columns may have.
TEST(FmuUnits, ThoseOfOutputsAreKnown) {
  for (const OutputUnit& unit : output_units) {
    ASSERT_TRUE(fmu_unit(unit.si)) << unit.si;
    ASSERT_TRUE(fmu_unit(unit.unit)) << unit.unit;
    EXPECT_EQ(fmu_unit(unit.si)->exponents, fmu_unit(unit.unit)->exponents) << unit.unit;
    EXPECT_NEAR(fmu_unit(unit.unit)->factor * unit.factor, 1.0, 1e-14) << unit.unit;
  }
  for (const char* text : {"m/s2", "rad/s2", "N m s", "N s", "J", "W", "1/s", "Pa", "s"})
    EXPECT_TRUE(fmu_unit(text)) << text;
}

}  // namespace
}  // namespace floatframe
