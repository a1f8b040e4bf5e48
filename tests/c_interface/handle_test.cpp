// What calls of the C interface return, in the right order and the wrong one.
#include <cmath>
#include <limits>

#include "c_interface/handle_case.hpp"
#include "floatframe/c_interface/bounded_text.hpp"
#include "support/figures.hpp"

namespace floatframe::test {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();

class HandleCalls : public HandleCase {};

TEST_F(HandleCalls, NamesUnitsAndLimits) {
  const Handle s = opened();
  ASSERT_TRUE(s != nullptr);
  EXPECT_STREQ(floatframe_model_name(s.get()), "machine");
  EXPECT_STREQ(floatframe_fingerprint(s.get()), "");
  EXPECT_STREQ(floatframe_message(s.get()), "");
  ASSERT_EQ(floatframe_input_count(s.get()), 3);
  EXPECT_STREQ(floatframe_input_name(s.get(), 1), "aim");
  EXPECT_STREQ(floatframe_input_unit(s.get(), 0), "N");
  EXPECT_STREQ(floatframe_input_unit(s.get(), 2), "");
  EXPECT_EQ(floatframe_input_initial(s.get(), 1), 0.1);
  EXPECT_EQ(floatframe_input_low(s.get(), 0), -50.0);
  EXPECT_EQ(floatframe_input_high(s.get(), 0), 50.0);
  EXPECT_EQ(floatframe_input_low(s.get(), 2), -endless);
  EXPECT_EQ(floatframe_input_high(s.get(), 2), endless);
  for (int k = 0; k < floatframe_input_count(s.get()); ++k)
    EXPECT_EQ(floatframe_find_input(s.get(), floatframe_input_name(s.get(), k)), k);
  for (int k = 0; k < floatframe_output_count(s.get()); ++k)
    EXPECT_EQ(floatframe_find_output(s.get(), floatframe_output_name(s.get(), k)), k);
  EXPECT_STREQ(floatframe_output_unit(s.get(), floatframe_find_output(s.get(), "spin")), "rad");
  for (const int k : {-1, 3, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    EXPECT_EQ(floatframe_input_name(s.get(), k), nullptr);
    EXPECT_EQ(floatframe_input_unit(s.get(), k), nullptr);
    EXPECT_TRUE(std::isnan(floatframe_input(s.get(), k)));
    EXPECT_TRUE(std::isnan(floatframe_input_initial(s.get(), k)));
    EXPECT_TRUE(std::isnan(floatframe_input_low(s.get(), k)));
    EXPECT_TRUE(std::isnan(floatframe_input_high(s.get(), k)));
    EXPECT_EQ(floatframe_parameter_name(s.get(), k), nullptr);
    EXPECT_EQ(floatframe_set_input(s.get(), k, 0.0), FLOATFRAME_INVALID);
    EXPECT_EQ(floatframe_set_parameter(s.get(), k, 0.0), FLOATFRAME_INVALID);
    EXPECT_EQ(floatframe_note(s.get(), k), nullptr);
  }
  for (const char* name : {"", "pus", "push ", "spin", "PUSH"})
    EXPECT_EQ(floatframe_find_input(s.get(), name), -1) << name;
}

TEST_F(HandleCalls, FilesThatAreNoModels) {
  char text[2000];
  EXPECT_EQ(floatframe_open(folder_.file("none.yaml").c_str(), text, sizeof text), nullptr);
  expect_in(text, "none.yaml");
  const std::string wrong = folder_.write("wrong.yaml", "floatframe: 1\nbodys: {}\n");
  EXPECT_EQ(floatframe_open(wrong.c_str(), text, sizeof text), nullptr);
  expect_in(text, "wrong.yaml:2:1");
  std::vector<std::byte> bytes = pack_model(path_).to_bytes();
  bytes[bytes.size() / 2] ^= std::byte{1};
  EXPECT_EQ(floatframe_open_memory(bytes.data(), bytes.size(), text, sizeof text), nullptr);
  expect_in(text, "damaged");
}

TEST_F(HandleCalls, InputsKeepTheirRules) {
  for (const Handle& s : {opened(), started(opened())}) {
    EXPECT_EQ(floatframe_set_input(s.get(), 0, 20.0), FLOATFRAME_OK);
    for (const double x : {no_number, endless, -endless, 50.000001, -51.0}) {
      EXPECT_EQ(floatframe_set_input(s.get(), 0, x), FLOATFRAME_INVALID);
      expect_in(floatframe_message(s.get()), "-50");
      EXPECT_EQ(floatframe_input(s.get(), 0), 20.0);
    }
    EXPECT_EQ(floatframe_set_input(s.get(), 1, 7.0), FLOATFRAME_WARNING);
    expect_in(floatframe_message(s.get()), "input 'aim'");
    EXPECT_EQ(floatframe_input(s.get(), 1), 1.0);
    EXPECT_EQ(floatframe_set_input(s.get(), 1, no_number), FLOATFRAME_INVALID);
    EXPECT_EQ(floatframe_set_input(s.get(), 3, 0.0), FLOATFRAME_INVALID);
    expect_in(floatframe_message(s.get()), "2");
  }
}

TEST_F(HandleCalls, OptionsHaveTheSentencesOfModelFiles) {
  const Handle s = opened();
  const auto refused = [&](const char* key, const char* value, const char* sentence) {
    EXPECT_EQ(floatframe_set_option(s.get(), key, value), FLOATFRAME_INVALID) << key;
    expect_in(floatframe_message(s.get()), sentence);
  };
  refused("coordinates", "cartesian", "relative or absolute");
  refused("step", "0", "positive number [s]");
  refused("step", "1 ms", "found '1 ms'");
  refused("tolerence", "1e-9", "mean 'tolerance'?");
  EXPECT_EQ(floatframe_set_option(s.get(), "coordinates", "absolute"), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_set_option(s.get(), "min_step", "1e-3"), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_set_option(s.get(), "step", "1e-4"), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_start(s.get()), FLOATFRAME_INVALID) << "the smallest step is above the step";
  EXPECT_TRUE(std::isnan(floatframe_time(s.get())));
  EXPECT_EQ(floatframe_set_option(s.get(), "min_step", "0"), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_start(s.get()), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_step_size(s.get()), 1e-4);
}

TEST_F(HandleCalls, NoStart) {
  const std::string path = folder_.write("falls.yaml", R"(floatframe: 1
bodies: {stone: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}
joints: {loose: {type: free, child: stone}}
outputs: {z: {position: stone, axis: z}}
simulation: {step: 0.01, start: equilibrium}
)");
  const Handle s(floatframe_open(path.c_str(), nullptr, 0));
  ASSERT_TRUE(s != nullptr);
  EXPECT_EQ(floatframe_start(s.get()), FLOATFRAME_NO_START);
  EXPECT_GT(std::string(floatframe_message(s.get())).size(), 20u);
  EXPECT_EQ(floatframe_step(s.get()), FLOATFRAME_WRONG_ORDER);
  EXPECT_EQ(floatframe_set_option(s.get(), "start", "given"), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_start(s.get()), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_step(s.get()), FLOATFRAME_OK);
}

// After a step that fails nothing goes on until a state is restored, or the start is renewed.
TEST_F(HandleCalls, FailedSteps) {
  const Handle s = opened();
  for (const auto& [key, value] : {std::pair{"max_iterations", "1"},
                                   std::pair{"tolerance", "1e-13"}, std::pair{"min_step", "2e-3"}})
    ASSERT_EQ(floatframe_set_option(s.get(), key, value), FLOATFRAME_OK)
        << floatframe_message(s.get());
  ASSERT_EQ(floatframe_start(s.get()), FLOATFRAME_OK);
  const std::vector<std::byte> state = saved(s.get());
  const std::vector<double> before(floatframe_outputs(s.get()),
                                   floatframe_outputs(s.get()) + floatframe_output_count(s.get()));
  for (int again = 0; again < 3; ++again) {
    EXPECT_EQ(floatframe_step(s.get()), FLOATFRAME_STEP_FAILED);
    expect_in(floatframe_message(s.get()), "no convergence");
    EXPECT_EQ(floatframe_time(s.get()), 0.0);
    EXPECT_EQ(floatframe_save(s.get(), nullptr), FLOATFRAME_WRONG_ORDER);
    EXPECT_TRUE(equal_bits(
        before, {floatframe_outputs(s.get()), floatframe_outputs(s.get()) + before.size()}));
  }
  EXPECT_EQ(restore(s.get(), state), FLOATFRAME_OK) << floatframe_message(s.get());
  EXPECT_EQ(floatframe_save(s.get(), nullptr), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_step(s.get()), FLOATFRAME_STEP_FAILED);
  EXPECT_EQ(floatframe_start(s.get()), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_save(s.get(), nullptr), FLOATFRAME_OK);
}

TEST(BoundedTexts, NoCharacterIsCutInTwo) {
  char to[8];
  copy_text("1234567", to, sizeof to);
  EXPECT_STREQ(to, "1234567");
  copy_text("123456\u00e4", to, sizeof to);
  EXPECT_STREQ(to, "123456");
  copy_text("12345\u00e48", to, sizeof to);
  EXPECT_STREQ(to, "12345\u00e4");
  copy_text("1234\u20ac89", to, sizeof to);
  EXPECT_STREQ(to, "1234\u20ac");
  copy_text("12345\u20ac", to, sizeof to);
  EXPECT_STREQ(to, "12345");
  copy_text("x", to, 1);
  EXPECT_STREQ(to, "");
  copy_text("x", nullptr, 0);
  BoundedText text;
  text.set(std::string(10000, 'x'));
  EXPECT_EQ(std::string(text.c_str()), std::string(4095, 'x'));
  text.format("{} {:g}", std::string(3000, 'y'), 1.5);
  EXPECT_EQ(std::string(text.c_str()), std::string(1023, 'y')) << "is cut, not lost";
}

}  // namespace
}  // namespace floatframe::test
