#pragma once
// Counts the steps of each contact of the elements that have a restitution: with fewer than twenty
// the rebound is not that of the key (docs/range.md). What is observed are ends of full steps; a
// contact within one step is not seen. `follow` does not allocate.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "floatframe/model/element_evaluation.hpp"
#include "floatframe/model/system_motion.hpp"
#include "floatframe/run/range_warning.hpp"

namespace floatframe {

class ContactWatch {
 public:
  /// For runs with this step size [s].
  ContactWatch(const Model& model, double step);

  /// After every full step, with the efforts at its end.
  void follow(const SystemMotion& motion) noexcept {
    for (Watched& x : watched_) {
      if (motion.effort(x.element).force != 0.0) {
        if (x.ends++ == 0) x.touch = motion.t;
        x.speed = motion.states[x.element][x.kept];
        continue;
      }
      const std::int64_t steps = x.ends + 1;
      if (x.ends > 0 && steps < enough && x.speed >= x.least_speed) {
        if (x.first < 0.0) x.first = x.touch;
        x.fewest = std::min(x.fewest, steps);
      }
      x.ends = 0;
    }
  }

  /// The sentence about the first element with such a contact, if there is one.
  void warn(std::vector<RangeWarning>& out) const;

  /// Stores and restores the record, for runs that are continued elsewhere (state_bytes.hpp).
  template <class Stream>
  void serialize(Stream& s) {
    for (Watched& x : watched_) {
      s(x.ends);
      s(x.fewest);
      for (double* number : {&x.touch, &x.speed, &x.first}) s(*number);
    }
  }

 private:
  static constexpr std::int64_t enough = 20;
  struct Watched {
    int element = -1, kept = 0;
    double least_speed = 0.0;  ///< of the touches that count
    std::int64_t ends = 0;     ///< of steps in the present contact
    std::int64_t fewest = enough;
    double touch = 0.0, speed = 0.0;  ///< its time and speed
    double first = -1.0;  ///< time of the first one that was too short [s]; below zero: none
  };

  const Model& model_;
  double step_;
  std::vector<Watched> watched_;
};

}  // namespace floatframe
