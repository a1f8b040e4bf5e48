#pragma once
// Handles of the C interface over the machine of the tests of stepping.
#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "floatframe/c_interface/floatframe.h"
#include "floatframe/model_file/pack_model.hpp"
#include "support/stepping_models.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {

struct CloseHandle {
  void operator()(floatframe_simulation* s) const noexcept { floatframe_close(s); }
};
using Handle = std::unique_ptr<floatframe_simulation, CloseHandle>;

/// The machine with a spring and a mass as parameters.
inline std::string tunable_machine() {
  std::string text = "floatframe: 1\nname: machine\nparameters: {stiff: 3, load: 2}\n";
  text += stepped_machine;
  for (const auto& [from, to] : {std::pair{"spring: 3,", "spring: \"${stiff}\","},
                                 std::pair{"{mass: 2,", "{mass: \"${load}\","}}) {
    const std::string old = from;
    text.replace(text.find(old), old.size(), to);
  }
  return text;
}

class HandleCase : public ::testing::Test {
 protected:
  HandleCase() : path_(folder_.write("machine.yaml", tunable_machine())) {}

  Handle opened() const {
    char text[1000];
    Handle s(floatframe_open(path_.c_str(), text, sizeof text));
    EXPECT_TRUE(s != nullptr) << text;
    return s;
  }
  /// From the packed model.
  Handle packed() const {
    if (bytes_.empty()) bytes_ = pack_model(path_).to_bytes();
    char text[1000];
    Handle s(floatframe_open_memory(bytes_.data(), bytes_.size(), text, sizeof text));
    EXPECT_TRUE(s != nullptr) << text;
    return s;
  }
  static Handle started(Handle s) {
    EXPECT_EQ(floatframe_start(s.get()), FLOATFRAME_OK) << floatframe_message(s.get());
    return s;
  }

  /// As `trace` of a Simulation, without its reports.
  static std::vector<double> steps(floatframe_simulation* s, int from, int to) {
    std::vector<double> all;
    for (int k = from; k < to; ++k) {
      EXPECT_EQ(floatframe_set_input(s, 0, 30.0 * std::sin(0.3 * k)), FLOATFRAME_OK);
      EXPECT_LE(floatframe_set_input(s, 1, 1.2 * std::cos(0.1 * k)), FLOATFRAME_WARNING);
      EXPECT_EQ(floatframe_step(s), FLOATFRAME_OK) << floatframe_message(s);
      all.push_back(floatframe_time(s));
      const double* outputs = floatframe_outputs(s);
      all.insert(all.end(), outputs, outputs + floatframe_output_count(s));
      for (int i = 0; i < floatframe_input_count(s); ++i) all.push_back(floatframe_input(s, i));
    }
    return all;
  }
  /// The same of a Simulation.
  static std::vector<double> steps(Simulation& s, int from, int to) {
    std::vector<double> all;
    for (int k = from; k < to; ++k) {
      drive_inputs(s, k);
      EXPECT_TRUE(s.step()) << s.failure();
      all.push_back(s.time());
      all.insert(all.end(), s.outputs().begin(), s.outputs().end());
      all.insert(all.end(), s.inputs().begin(), s.inputs().end());
    }
    return all;
  }
  static std::vector<std::byte> saved(floatframe_simulation* s) {
    std::size_t count = 0;
    EXPECT_EQ(floatframe_save(s, &count), FLOATFRAME_OK) << floatframe_message(s);
    const auto* bytes = static_cast<const std::byte*>(floatframe_saved(s));
    return {bytes, bytes + count};
  }
  static floatframe_status restore(floatframe_simulation* s, std::span<const std::byte> bytes) {
    return floatframe_restore(s, bytes.data(), bytes.size());
  }

  TemporaryFolder folder_;
  std::string path_;
  mutable std::vector<std::byte> bytes_;
};

}  // namespace floatframe::test
