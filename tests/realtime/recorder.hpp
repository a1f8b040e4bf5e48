#pragma once
// A paced run of tests/data/good_models/inputs.yaml and a partner that notes all it is sent.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <vector>

#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/realtime/realtime.hpp"

namespace floatframe::test {

inline const ModelDescription& description() {
  static const ModelDescription d = read_model(FLOATFRAME_TEST_DATA "/good_models/inputs.yaml");
  return d;
}

inline Model model() { return build_model(description()); }

/// Notes all outputs; sends inputs that a test chooses.
class Recorder : public SignalPort {
 public:
  bool receive(InputBuffer& inputs) noexcept override {
    ++received;
    if (!answer) return false;
    answer(*this, inputs);
    return true;
  }
  void send(std::uint64_t step, double time, std::span<const double> outputs,
            bool last) noexcept override {
    // A run that ends early sends its last good state again.
    EXPECT_TRUE(step == steps.size() || (last && step + 1 == steps.size())) << step;
    steps.push_back(step);
    row.assign(1, time);
    row.insert(row.end(), outputs.begin(), outputs.end());
    rows.insert(rows.end(), row.begin(), row.end());
    ended = last;
  }
  bool wait() noexcept override { return received < patience; }

  std::function<void(Recorder&, InputBuffer&)> answer;
  long received = 0, patience = std::numeric_limits<long>::max();
  std::vector<std::uint64_t> steps;
  std::vector<double> row, rows;
  bool ended = false;
};

inline SimulationDescription simulation(double duration, double step = 0.005) {
  SimulationDescription s = description().simulation;
  s.duration = duration;
  s.step = step;
  return s;
}

inline RealTimeOptions unpaced() {
  RealTimeOptions o;
  o.paced = false;
  return o;
}

}  // namespace floatframe::test
