// Parameters of packed models: before the start the start is found with them, later they act from
// the next step; saved states hold them.
#include <cmath>
#include <limits>

#include "c_interface/handle_case.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "support/figures.hpp"

namespace floatframe::test {
namespace {

class HandleParameters : public HandleCase {};

TEST_F(HandleParameters, AreThoseOfThePackedModel) {
  const Handle s = packed();
  ASSERT_EQ(floatframe_parameter_count(s.get()), 2);
  for (const auto& [name, value] : {std::pair{"stiff", 3.0}, std::pair{"load", 2.0}}) {
    const int k = floatframe_find_parameter(s.get(), name);
    ASSERT_GE(k, 0) << name;
    EXPECT_STREQ(floatframe_parameter_name(s.get(), k), name);
    EXPECT_NE(floatframe_parameter_unit(s.get(), k), nullptr);
    EXPECT_NE(floatframe_parameter_about(s.get(), k), nullptr);
    EXPECT_EQ(floatframe_parameter(s.get(), k), value);
  }
  EXPECT_EQ(std::string(floatframe_fingerprint(s.get())).size(), 16u);
  EXPECT_EQ(floatframe_parameter_count(opened().get()), 0);
  const Handle file = opened();
  EXPECT_EQ(floatframe_set_parameter(file.get(), 0, 1.0), FLOATFRAME_INVALID);
  expect_in(floatframe_message(file.get()), "packed model");
}

TEST_F(HandleParameters, BeforeTheStart) {
  Simulation expected(load_model(path_, {{"stiff", "5"}, {"load", "1.5"}}));
  const Handle s = packed();
  EXPECT_EQ(floatframe_set_parameter(s.get(), floatframe_find_parameter(s.get(), "stiff"), 5.0),
            FLOATFRAME_OK);
  EXPECT_EQ(floatframe_set_parameter(s.get(), floatframe_find_parameter(s.get(), "load"), 1.5),
            FLOATFRAME_OK);
  EXPECT_EQ(floatframe_start(s.get()), FLOATFRAME_OK) << floatframe_message(s.get());
  EXPECT_TRUE(equal_bits(steps(s.get(), 0, 20), steps(expected, 0, 20)));
}

TEST_F(HandleParameters, FromTheNextStepOn) {
  Simulation expected(load_model(path_));
  steps(expected, 0, 10);
  expected.change_model(load_model(path_, {{"stiff", "5"}, {"load", "1.5"}}));
  const Handle s = started(packed());
  steps(s.get(), 0, 10);
  const std::int32_t indices[] = {floatframe_find_parameter(s.get(), "stiff"),
                                  floatframe_find_parameter(s.get(), "load")};
  const double values[] = {5.0, 1.5};
  const double time = floatframe_time(s.get());
  ASSERT_EQ(floatframe_set_parameters(s.get(), indices, values, 2), FLOATFRAME_OK)
      << floatframe_message(s.get());
  EXPECT_EQ(floatframe_time(s.get()), time);
  EXPECT_EQ(floatframe_parameter(s.get(), indices[0]), 5.0);
  EXPECT_TRUE(equal_bits(steps(s.get(), 10, 30), steps(expected, 10, 30)));
  EXPECT_EQ(floatframe_set_parameters(s.get(), nullptr, nullptr, 0), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_set_parameters(s.get(), nullptr, values, 2), FLOATFRAME_INVALID);
}

TEST_F(HandleParameters, ThatGiveNoModel) {
  const Handle s = packed();
  const int load = floatframe_find_parameter(s.get(), "load");
  EXPECT_EQ(floatframe_set_parameter(s.get(), load, std::nan("")), FLOATFRAME_INVALID);
  expect_in(floatframe_message(s.get()), "parameter 'load'");
  EXPECT_EQ(floatframe_set_parameter(s.get(), load, -1.0), FLOATFRAME_OK) << "the start judges";
  EXPECT_EQ(floatframe_start(s.get()), FLOATFRAME_INVALID);
  EXPECT_EQ(floatframe_step(s.get()), FLOATFRAME_WRONG_ORDER);
  EXPECT_EQ(floatframe_set_parameter(s.get(), load, 2.0), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_start(s.get()), FLOATFRAME_OK) << floatframe_message(s.get());
  steps(s.get(), 0, 3);
  const std::vector<std::byte> before = saved(s.get());
  EXPECT_EQ(floatframe_set_parameter(s.get(), load, -1.0), FLOATFRAME_INVALID);
  EXPECT_EQ(floatframe_parameter(s.get(), load), 2.0);
  EXPECT_EQ(saved(s.get()), before);
}

TEST_F(HandleParameters, ThatHoldForAWholeRun) {
  std::string text = tunable_machine();
  const std::string old = "step: 2.0e-3";
  ASSERT_NE(text.find(old), std::string::npos);
  text.replace(text.find(old), old.size(), "step: \"${0.001 * load}\"");
  const std::string path = folder_.write("paced.yaml", text);
  Simulation expected(load_model(path, {{"load", "1"}}));
  const std::vector<std::byte> bytes = pack_model(path).to_bytes();
  char message[1000];
  const Handle s(floatframe_open_memory(bytes.data(), bytes.size(), message, sizeof message));
  ASSERT_TRUE(s != nullptr) << message;
  ASSERT_EQ(floatframe_start(s.get()), FLOATFRAME_OK);
  steps(s.get(), 0, 3);
  const int load = floatframe_find_parameter(s.get(), "load");
  EXPECT_EQ(floatframe_set_parameter(s.get(), load, 1.0), FLOATFRAME_INVALID);
  expect_in(floatframe_message(s.get()), "whole run");
  EXPECT_EQ(floatframe_reset(s.get()), FLOATFRAME_OK);
  EXPECT_TRUE(std::isnan(floatframe_time(s.get())) && std::isnan(floatframe_output(s.get(), 0)));
  EXPECT_EQ(floatframe_step(s.get()), FLOATFRAME_WRONG_ORDER);
  for (int k = 0; k < floatframe_input_count(s.get()); ++k)
    floatframe_set_input(s.get(), k, floatframe_input_initial(s.get(), k));
  EXPECT_EQ(floatframe_set_parameter(s.get(), load, 1.0), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_start(s.get()), FLOATFRAME_OK) << floatframe_message(s.get());
  EXPECT_EQ(floatframe_step_size(s.get()), 0.001);
  EXPECT_TRUE(equal_bits(steps(s.get(), 0, 20), steps(expected, 0, 20)));
}

TEST_F(HandleParameters, InputsAndTheStepFollow) {
  std::string text = tunable_machine();
  for (const auto& [from, to] : {std::pair{"max: 50}", "max: \"${25 * load}\"}"},
                                 std::pair{"initial: 0.1", "initial: \"${0.05 * load}\""},
                                 std::pair{"step: 2.0e-3", "step: \"${0.001 * load}\""}}) {
    const std::string old = from;
    ASSERT_NE(text.find(old), std::string::npos);
    text.replace(text.find(old), old.size(), to);
  }
  const std::string path = folder_.write("limited.yaml", text);
  const std::vector<std::byte> bytes = pack_model(path).to_bytes();
  char message[1000];
  const auto fresh = [&] {
    return Handle(floatframe_open_memory(bytes.data(), bytes.size(), message, sizeof message));
  };
  const Handle s = fresh();
  ASSERT_TRUE(s != nullptr) << message;
  const int load = floatframe_find_parameter(s.get(), "load");
  ASSERT_GE(load, 0);
  EXPECT_EQ(floatframe_set_input(s.get(), 0, 90.0), FLOATFRAME_INVALID);
  ASSERT_EQ(floatframe_set_parameter(s.get(), load, 4.0), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_input_high(s.get(), 0), 100.0);
  EXPECT_EQ(floatframe_step_size(s.get()), 0.004);
  EXPECT_EQ(floatframe_input(s.get(), 1), 0.2) << "as the model says, until it is set";
  EXPECT_EQ(floatframe_set_input(s.get(), 0, 90.0), FLOATFRAME_OK) << floatframe_message(s.get());
  ASSERT_EQ(floatframe_start(s.get()), FLOATFRAME_OK) << floatframe_message(s.get());
  EXPECT_EQ(floatframe_input(s.get(), 1), 0.2);
  ASSERT_EQ(floatframe_step(s.get()), FLOATFRAME_OK);
  const std::vector<std::byte> state = saved(s.get());

  const Handle other = fresh();
  ASSERT_EQ(restore(other.get(), state), FLOATFRAME_OK) << floatframe_message(other.get());
  EXPECT_EQ(floatframe_input_high(other.get(), 0), 100.0) << "of the state's parameters";
  EXPECT_EQ(floatframe_set_input(other.get(), 0, 95.0), FLOATFRAME_OK);

  const Handle set = fresh();
  ASSERT_EQ(floatframe_set_input(set.get(), 1, 0.3), FLOATFRAME_OK);
  ASSERT_EQ(floatframe_set_parameter(set.get(), load, 4.0), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_input(set.get(), 1), 0.3) << "what was set stays";
}

TEST_F(HandleParameters, AreInSavedStates) {
  const Handle s = packed();
  const int stiff = floatframe_find_parameter(s.get(), "stiff");
  floatframe_set_parameter(s.get(), stiff, 4.0);
  ASSERT_EQ(floatframe_start(s.get()), FLOATFRAME_OK);
  steps(s.get(), 0, 5);
  ASSERT_EQ(floatframe_set_parameter(s.get(), stiff, 6.0), FLOATFRAME_OK);
  steps(s.get(), 5, 10);
  const std::vector<std::byte> state = saved(s.get());
  const std::vector<double> expected = steps(s.get(), 10, 20);
  ASSERT_EQ(floatframe_set_parameter(s.get(), stiff, 8.0), FLOATFRAME_OK);
  steps(s.get(), 20, 25);

  // The same handle, which has another value now; one that has not started; one of another start.
  const Handle fresh = packed(), other = started(packed());
  steps(other.get(), 0, 2);
  for (floatframe_simulation* h : {s.get(), fresh.get(), other.get()}) {
    ASSERT_EQ(restore(h, state), FLOATFRAME_OK) << floatframe_message(h);
    EXPECT_EQ(floatframe_parameter(h, stiff), 6.0);
    EXPECT_EQ(floatframe_step_count(h), 10);
    EXPECT_TRUE(equal_bits(steps(h, 10, 20), expected));
  }
  EXPECT_EQ(floatframe_start(s.get()), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_parameter(s.get(), stiff), 6.0) << "the start has the present values";
}

}  // namespace
}  // namespace floatframe::test
