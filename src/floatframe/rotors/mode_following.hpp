#pragma once
// Tracks modes of a rotating system from speed to speed. Modes a and b of neighbouring speeds are
// matched by the modal assurance criterion of their inertial displacements, weighted by the masses,
//   MAC = |u_a^H M u_b|^2 / ((u_a^H M u_a) (u_b^H M u_b)) > 0.8
// modes of equal frequency by that of the space they span. Among several candidates the one with
// the nearest eigenvalue is taken. Where the criterion is not met, intermediate speeds are added,
// down to 1/512 of the interval, a bounded number in all; if that fails, the mode cannot be
// tracked, for example where a vibration becomes two motions without oscillation.
#include <map>
#include <vector>

#include "floatframe/rotors/turning_model.hpp"

namespace floatframe {

using TurningModes = std::vector<TurningMode>;

inline constexpr std::size_t no_mode = static_cast<std::size_t>(-1);

struct ModePath {
  std::size_t mode = no_mode;  ///< at the other speed; none: it cannot be tracked
  double end = 0.0;            ///< the last speed to which it was tracked [rad/s]
  std::complex<double> last;   ///< its eigenvalue there
  /// Intermediate speeds, and the mode there, in the order of tracking.
  std::vector<std::pair<double, std::size_t>> between{};
};

class ModeFollower {
 public:
  ModeFollower(TurningModel& turning, int most_extra_speeds)
      : turning_(turning), most_extra_(most_extra_speeds) {}

  const TurningModes& at(double speed);
  /// One path for each of the oscillating modes at `from`.
  std::vector<ModePath> follow(double from, double to, const std::vector<std::size_t>& modes);
  int extra_speeds() const noexcept { return extra_; }
  bool out_of_speeds() const noexcept { return extra_ >= most_extra_; }

 private:
  /// A mode where tracking began: its speed and |lambda|.
  struct Begin {
    double speed, size;
  };
  std::vector<ModePath> follow(double from, double to, const std::vector<std::size_t>& modes,
                               const std::vector<Begin>& begins, int depth);
  /// With at least 2^level parts of the interval.
  std::vector<ModePath> follow_in_pieces(double from, double to,
                                         const std::vector<std::size_t>& modes,
                                         const std::vector<Begin>& begins, int level);

  TurningModel& turning_;
  int most_extra_, extra_ = 0;
  std::map<double, TurningModes> known_;
};

/// Below this fraction of the largest |lambda| a mode is a rigid-body motion.
inline constexpr double rigid_part = 1e-7;
inline bool is_rigid(const TurningModes& modes, std::size_t k) {
  return std::abs(modes[k].lambda) <= rigid_part * std::abs(modes.back().lambda);
}

}  // namespace floatframe
