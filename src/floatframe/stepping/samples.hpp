#pragma once
// Results of the last accepted instant that formulas refer to (FormulaOperand::Kind::sample): kept
// numbers of their elements, which follow from the motion at the end of each step. At a start they
// are those of the start, where forces may depend on accelerations and reactions that they change:
//   z = samples(a(z))                                                                          (1)
// is iterated from z = 0.
#include <vector>

#include "floatframe/model/output_kind.hpp"
#include "floatframe/start/start_up.hpp"

namespace floatframe {

class Samples {
 public:
  Samples() = default;
  explicit Samples(const Model& model);
  bool empty() const noexcept { return list_.empty(); }
  MotionNeeds needs() const noexcept { return needs_; }
  /// Into the states of elements. Step time.
  void take(const SystemMotion& motion, VecX& z) const noexcept {
    FollowedOutput nothing;
    for (const Sample& s : list_) z[s.place] = output_value(motion, *s.output, nothing);
  }
  /// The elements that keep some: "controllers 'a' and 'b'".
  const std::vector<std::string>& elements() const noexcept { return elements_; }

 private:
  struct Sample {
    const Output* output;
    Eigen::Index place;  ///< among the states of elements
  };
  std::vector<Sample> list_;
  std::vector<std::string> elements_;
  MotionNeeds needs_;
};

/// (1) with the accelerations of the start. If it does not converge the samples are those of z = 0,
/// and the result is a sentence without its full stop; else it is empty. `step`: of the simulation
/// [s].
std::string settle_samples(InitialisedModel& started, double step);

}  // namespace floatframe
