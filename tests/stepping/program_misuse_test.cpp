// What a program may hand to the analyses besides a model of build_model ends in an InputError.
#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "floatframe/advice/mode_advice.hpp"
#include "floatframe/linear/linearize.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/start/check.hpp"
#include "floatframe/start/statics.hpp"
#include "support/error_of.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

const std::string empty = "missing";

TEST(ProgramMisuse, ModelsThatAreNotBuilt) {
  Model model = model_of(stepped_machine);
  const SimulationDescription options = model.simulation;
  const Model nothing;
  const Model moved = std::move(model);
  EXPECT_EQ(error_of([&] { Simulation s(nothing); }), empty);
  for (const Model* m : {&nothing, static_cast<const Model*>(&model)}) {
    EXPECT_EQ(error_of([&] { Simulation s(*m, {.step = 1e-3}); }), empty);
    EXPECT_EQ(error_of([&] { run(*m, options); }), empty);
    EXPECT_EQ(error_of([&] { check(*m); }), empty);
    EXPECT_EQ(error_of([&] { statics(*m); }), empty);
    EXPECT_EQ(error_of([&] { linearize(*m, {.step = 1e-3}); }), empty);
    EXPECT_EQ(error_of([&] { advise(*m, options, {}); }), empty);
    EXPECT_EQ(error_of([&] { with_modes(*m, {}); }), empty);
  }
  Model torn = moved;
  torn.bodies.front().data = nullptr;
  EXPECT_EQ(error_of([&] { Simulation s(torn); }).substr(0, 53), "missing");
  torn = moved;
  torn.amplitudes.pop_back();
  EXPECT_NE(error_of([&] { Simulation s(torn); }), "no error");
  EXPECT_EQ(error_of([&] { Simulation s(moved); }), "no error");
}

TEST(ProgramMisuse, ModesToKeep) {
  const Model model = model_of(stepped_machine);
  std::vector<std::vector<int>> all;
  for (const Body& body : model.bodies) {
    all.emplace_back();
    for (int k = 0; k < body.modes(); ++k) all.back().push_back(k);
  }
  EXPECT_EQ(error_of([&] { with_modes(model, all); }), "no error");
  EXPECT_EQ(error_of([&] { with_modes(model, {}); }), "wrong_count");
  for (const std::vector<int>& wrong : {std::vector<int>{-1}, {1000}, {0, 0}, {1, 0}}) {
    std::vector<std::vector<int>> keep = all;
    keep.back() = wrong;
    EXPECT_EQ(error_of([&] { with_modes(model, keep); }).substr(0, 6), "wrong_");
  }
}

TEST(ProgramMisuse, OptionsOfTheAdvice) {
  const Model model = model_of(stepped_machine);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](const AdviceOptions& o) {
    return error_of([&] { advise(model, model.simulation, o); });
  };
  EXPECT_EQ(refused({.drop_share = nan}), "out_of_range");
  EXPECT_EQ(refused({.static_ratio = -1.0}), "out_of_range");
  EXPECT_EQ(refused({.tolerance = -2.0}), "out_of_range");
  EXPECT_EQ(refused({.repeat = 0}), "out_of_range");
}

TEST(ProgramMisuse, StepsThatAreTooSmall) {
  const Model model = model_of(stepped_machine);
  Simulation s(model);
  for (const double h : {1e-300, 1e-160, 1e-20, 1e-14}) {
    EXPECT_EQ(s.step(h).status, StepStatus::invalid_step);
    EXPECT_TRUE(contains(s.failure(), "expected a positive number [s] of at least"));
  }
  EXPECT_TRUE(s.step());
  EXPECT_TRUE(s.step(1e-6));
}

}  // namespace
}  // namespace floatframe::test
