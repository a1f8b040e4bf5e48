#pragma once
// The order of calls of equations_of_motion.hpp: debug builds keep what a formulation has been
// asked for, and asserts compare. Release builds keep nothing.
namespace floatframe {

class CallOrder {
#ifndef NDEBUG
 public:
  enum Stage { nothing, positions, velocities, dynamics, residual };

  void reach(Stage s) noexcept {
    if (s == positions) accelerated_ = false;
    if (s >= dynamics) weighed_ = true;
    stage_ = s;
  }
  /// Terms of the same positions and velocities are kept.
  void accelerate() noexcept { accelerated_ = true; }
  void factorise(int slot, bool regular) noexcept { factorised_[slot] = regular; }

  bool has(Stage s) const noexcept { return stage_ >= s; }
  /// M is there, at these positions or at those of the iterate before.
  bool has_masses() const noexcept { return weighed_ && stage_ >= velocities; }
  bool has_accelerations() const noexcept { return accelerated_ && stage_ >= velocities; }
  bool has_factors(int slot) const noexcept {
    return (slot == 0 || slot == 1) && factorised_[slot];
  }

 private:
  Stage stage_ = nothing;
  bool weighed_ = false, accelerated_ = false, factorised_[2] = {false, false};
#endif
};

}  // namespace floatframe
