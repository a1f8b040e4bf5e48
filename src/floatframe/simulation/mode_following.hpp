#pragma once
// Modes of a turning system followed from speed to speed. Modes a and b of neighbouring speeds are
// one by the modal assurance criterion of their displacements in the world, weighted by the masses,
//   MAC = |u_a^H M u_b|^2 / ((u_a^H M u_a) (u_b^H M u_b)) > 0.8
// of modes of equal frequency by that of the space they span. Among several the nearest eigenvalue
// decides. Where the criterion is not met speeds between are added, down to 1/512 of the interval,
// a bounded number in all; where that does not help the mode cannot be followed, as where a
// vibration becomes two motions that do not swing.
#include <map>
#include <vector>

#include "floatframe/simulation/turning_model.hpp"

namespace floatframe {

using TurningModes = std::vector<TurningMode>;

inline constexpr std::size_t no_mode = static_cast<std::size_t>(-1);

struct ModePath {
  std::size_t mode = no_mode;  ///< at the other speed; none: it cannot be followed
  double end = 0.0;            ///< the last speed to which it was followed [rad/s]
  std::complex<double> last;   ///< its eigenvalue there
  /// Speeds between, and its mode there, in the order in which it was followed.
  std::vector<std::pair<double, std::size_t>> between{};
};

class ModeFollower {
 public:
  ModeFollower(TurningModel& turning, int most_extra_speeds)
      : turning_(turning), most_extra_(most_extra_speeds) {}

  const TurningModes& at(double speed);
  /// One path for each of the modes at `from`, which swing.
  std::vector<ModePath> follow(double from, double to, const std::vector<std::size_t>& modes);
  int extra_speeds() const noexcept { return extra_; }
  bool out_of_speeds() const noexcept { return extra_ >= most_extra_; }

 private:
  /// A mode where it began to be followed: its speed and |lambda|.
  struct Begin {
    double speed, size;
  };
  std::vector<ModePath> follow(double from, double to, const std::vector<std::size_t>& modes,
                               const std::vector<Begin>& begins, int depth);
  /// With 2^level pieces of the interval at least.
  std::vector<ModePath> follow_in_pieces(double from, double to,
                                         const std::vector<std::size_t>& modes,
                                         const std::vector<Begin>& begins, int level);

  TurningModel& turning_;
  int most_extra_, extra_ = 0;
  std::map<double, TurningModes> known_;
};

/// Below this part of the largest |lambda| a mode is a rigid motion.
inline constexpr double rigid_part = 1e-7;
inline bool is_rigid(const TurningModes& modes, std::size_t k) {
  return std::abs(modes[k].lambda) <= rigid_part * std::abs(modes.back().lambda);
}

}  // namespace floatframe
