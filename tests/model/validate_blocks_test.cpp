// Every field of blocks, one change at a time.
#include "support/valid_description.hpp"

namespace floatframe::test {
namespace {

template <class Block>
Block& block(ModelDescription& d) {
  return std::get<Block>(d.controllers[0].kind);
}

template <class Block>
ModelDescription with_block(Block keys) {
  ModelDescription d = valid_description();
  d.controllers = {{"b", std::move(keys), {}}};
  return d;
}

void expect_errors(const ModelDescription& good, const std::vector<DescriptionCase>& cases) {
  EXPECT_EQ(errors(good), "no error");
  for (const DescriptionCase& c : cases) {
    ModelDescription d = good;
    c.change(d);
    EXPECT_EQ(errors(d), c.expected);
  }
}

TEST(ValidateBlocks, TransferFunctions) {
  TransferFunction f;
  f.numerator = MatX{{0.0, 2.0, 1.0}};
  f.denominator = MatX{{1.0, 3.0}};
  expect_errors(
      with_block(f),
      {{[](D& d) { block<TransferFunction>(d).numerator(0) = 1.0; },
        "controllers.b.numerator: out_of_range"},
       {[](D& d) { block<TransferFunction>(d).numerator.resize(0, 0); }, "controllers.b: missing"},
       {[](D& d) { block<TransferFunction>(d).numerator(1) = nan; },
        "controllers.b.numerator: out_of_range"},
       {[](D& d) {
          block<TransferFunction>(d).denominator = MatX{{0.0, 3.0}};
        },
        "controllers.b.denominator: out_of_range"},
       {[](D& d) { block<TransferFunction>(d).denominator = MatX{{2.0}}; },
        "controllers.b.denominator: out_of_range"},
       {[](D& d) { block<TransferFunction>(d).denominator = MatX::Ones(2, 2); },
        "controllers.b.denominator: wrong_count"},
       {[](D& d) { block<TransferFunction>(d).denominator = MatX::Ones(1, 102); },
        "controllers.b.denominator: wrong_count"},
       {[](D& d) { block<TransferFunction>(d).initial = static_cast<BlockStart>(2); },
        "controllers.b.initial: out_of_range"},
       {[](D& d) { block<TransferFunction>(d).input.input = "x"; },
        "controllers.b.input.input: not_found"}});
}

TEST(ValidateBlocks, StateSpaces) {
  StateSpaceBlock f;
  f.inputs.resize(2);
  f.A = f.B = MatX::Ones(2, 2);
  f.C = MatX::Ones(1, 2);
  expect_errors(
      with_block(f),
      {{[](D& d) { block<StateSpaceBlock>(d).A = MatX::Ones(2, 1); },
        "controllers.b.A: wrong_count"},
       {[](D& d) { block<StateSpaceBlock>(d).A.resize(0, 0); }, "controllers.b: missing"},
       {[](D& d) { block<StateSpaceBlock>(d).B = MatX::Ones(1, 2); },
        "controllers.b.B: wrong_count"},
       {[](D& d) { block<StateSpaceBlock>(d).C = MatX::Ones(2, 1); },
        "controllers.b.C: wrong_count"},
       {[](D& d) { block<StateSpaceBlock>(d).D = MatX::Ones(1, 1); },
        "controllers.b.D: wrong_count"},
       {[](D& d) { block<StateSpaceBlock>(d).inputs.clear(); }, "controllers.b.inputs: missing"},
       {[](D& d) { block<StateSpaceBlock>(d).inputs[1].input = "x"; },
        "controllers.b.inputs[2].input: not_found"}});
  f.inputs.resize(1);
  f.B = MatX::Ones(1, 2);  // of one input
  EXPECT_EQ(errors(with_block(f)), "no error");
}

TEST(ValidateBlocks, FiltersAndLimits) {
  LowPass filter;
  filter.time = 1.0;
  expect_errors(
      with_block(filter),
      {{[](D& d) { block<LowPass>(d).time.reset(); }, "controllers.b: incomplete"},
       {[](D& d) { block<LowPass>(d).frequency = 1.0; }, "controllers.b.frequency: exclusive"},
       {[](D& d) { block<LowPass>(d).damping = 0.0; }, "controllers.b.damping: out_of_range"}});
  LimitedIntegral integral;
  integral.lower = -1.0;
  expect_errors(with_block(integral),
                {{[](D& d) { block<LimitedIntegral>(d).initial = -2.0; },
                  "controllers.b.initial: out_of_range"},
                 {[](D& d) { block<LimitedIntegral>(d).upper = -1.0; },
                  "controllers.b.lower: out_of_range\ncontrollers.b.initial: out_of_range"},
                 {[](D& d) { block<LimitedIntegral>(d).unwind = 0.0; },
                  "controllers.b.unwind: out_of_range"}});
  Limiter limiter;
  limiter.lower = -1.0;
  expect_errors(
      with_block(limiter),
      {{[](D& d) { block<Limiter>(d).lower.reset(); }, "controllers.b: incomplete"},
       {[](D& d) { block<Limiter>(d).upper = -1.0; }, "controllers.b.lower: out_of_range"},
       {[](D& d) { block<Limiter>(d).upper = nan; }, "controllers.b.upper: out_of_range"}});
  RateLimiter rate;
  rate.rising = 1.0;
  expect_errors(
      with_block(rate),
      {{[](D& d) { block<RateLimiter>(d).rising = 0.0; }, "controllers.b.rising: out_of_range"},
       {[](D& d) { block<RateLimiter>(d).falling = -1.0; }, "controllers.b.falling: out_of_range"},
       {[](D& d) { block<RateLimiter>(d).time = 0.0; }, "controllers.b.time: out_of_range"}});
  Hysteresis relay;
  relay.upper = 1.0;
  expect_errors(
      with_block(relay),
      {{[](D& d) { block<Hysteresis>(d).upper = 0.0; }, "controllers.b.lower: out_of_range"},
       {[](D& d) { block<Hysteresis>(d).above = nan; }, "controllers.b.above: out_of_range"},
       {[](D& d) { block<Hysteresis>(d).initial = static_cast<RelaySide>(-1); },
        "controllers.b.initial: out_of_range"}});
  Delay delay;
  delay.time = 0.1;
  expect_errors(with_block(delay),
                {{[](D& d) { block<Delay>(d).time = 0.0; }, "controllers.b.time: out_of_range"},
                 {[](D& d) { block<Delay>(d).pade = 11.0; }, "controllers.b.pade: out_of_range"},
                 {[](D& d) { block<Delay>(d).pade = 2.5; }, "controllers.b.pade: out_of_range"}});
}

TEST(ValidateBlocks, Drivers) {
  PathFollowing path;
  path.points = MatX{{0.0, 0.0}, {1.0, 0.0}, {2.0, 1.0}};
  path.wheelbase = 2.5;
  expect_errors(
      with_block(path),
      {{[](D& d) { block<PathFollowing>(d).points.resize(0, 0); }, "controllers.b: missing"},
       {[](D& d) {
          block<PathFollowing>(d).circle = MatX{{0.0, 0.0, 9.0}};
        },
        "controllers.b: exclusive"},
       {[](D& d) {
          block<PathFollowing>(d).points = MatX{{0.0, 0.0}};
        },
        "controllers.b.points: wrong_count"},
       {[](D& d) { block<PathFollowing>(d).points = MatX::Ones(2, 2); },
        "controllers.b.points: geometry"},
       {[](D& d) { block<PathFollowing>(d).points = MatX::Ones(2, 3); },
        "controllers.b.points: wrong_count"},
       {[](D& d) { block<PathFollowing>(d).wheelbase = 0.0; },
        "controllers.b.wheelbase: out_of_range"},
       {[](D& d) { block<PathFollowing>(d).preview = nan; }, "controllers.b.preview: out_of_range"},
       {[](D& d) {
          block<PathFollowing>(d).points.resize(0, 0);
          block<PathFollowing>(d).circle = MatX{{0.0, 0.0, 0.0}};
        },
        "controllers.b.circle: out_of_range"},
       {[](D& d) {
          block<PathFollowing>(d).points.resize(0, 0);
          block<PathFollowing>(d).circle = MatX{{0.0, 0.0, 9.0}};
          block<PathFollowing>(d).closed = true;
        },
        "controllers.b.closed: incomplete"}});
  SpeedControl speed;
  speed.mass = 1500.0;
  speed.lower = -1.0;
  expect_errors(
      with_block(speed),
      {{[](D& d) { block<SpeedControl>(d).mass = 0.0; }, "controllers.b.mass: out_of_range"},
       {[](D& d) { block<SpeedControl>(d).upper = -2.0; }, "controllers.b.lower: out_of_range"},
       {[](D& d) { block<SpeedControl>(d).integral = -1.0; },
        "controllers.b.integral: out_of_range"}});
}

TEST(ValidateBlocks, Sampled) {
  ZeroOrderHold hold;
  hold.period = 0.01;
  hold.delay = 10.0;
  expect_errors(
      with_block(hold),
      {{[](D& d) { block<ZeroOrderHold>(d).period.reset(); }, "controllers.b: missing"},
       {[](D& d) { block<ZeroOrderHold>(d).period = 0.0; }, "controllers.b.period: out_of_range"},
       {[](D& d) { block<ZeroOrderHold>(d).offset = -1.0; }, "controllers.b.offset: out_of_range"},
       {[](D& d) { block<ZeroOrderHold>(d).delay = 10.01; }, "controllers.b.delay: too_large"},
       {[](D& d) { block<ZeroOrderHold>(d).initial = nan; },
        "controllers.b.initial: out_of_range"}});
  Pid pid;
  pid.derivative = 1.0;
  pid.period = 0.01;
  expect_errors(with_block(pid),
                {{[](D& d) { block<Pid>(d).delay = -1.0; }, "controllers.b.delay: out_of_range"}});
  StateSpaceBlock f;
  f.inputs.resize(1);
  f.A = f.B = f.C = MatX::Ones(1, 1);
  expect_errors(
      with_block(f),
      {{[](D& d) { block<StateSpaceBlock>(d).delay = 0.1; }, "controllers.b.delay: incomplete"},
       {[](D& d) { block<StateSpaceBlock>(d).offset = 0.1; }, "controllers.b.offset: incomplete"}});
}

}  // namespace
}  // namespace floatframe::test
