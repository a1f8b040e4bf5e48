#pragma once
// Members of a turning model, for its source files.
#include "floatframe/linear/linear_reduction.hpp"
#include "floatframe/rotors/steady_turning.hpp"
#include "floatframe/rotors/turning_model.hpp"
#include "floatframe/tangents/small_motions.hpp"

namespace floatframe {

struct TurningModel::Impl {
  Model model;
  std::unique_ptr<RelativeFormulation> f;
  Rotor rotor;
  VecX q;  ///< of the last steady state: initial guess for the next
  int massless = 0;
  bool weightless = false;  ///< gravity is omitted
  std::vector<std::string> notes;

  SteadyTurning steady(double speed, double angle);
  MatX motion_map(const SteadyTurning& s, double angle) const;
  MatX world_map(const SteadyTurning& s, double angle) const;

  /// Maps a state z to the inertial frame, and its rate along the steady motion: T, Tdot + T A.
  struct InWorld {
    MatX T, rate;
  };
  InWorld in_world(const SteadyTurning& s);
  InWorld in_world(const SteadyTurning& s, const LinearSystem& system);
  bool bent(const SteadyTurning& s) const;
  InWorld in_world(double speed, double angle, SteadyTurning& s);
};

/// T^+ B; the columns of T have different magnitudes.
MatX least_squares(const MatX& T, const MatX& B);

}  // namespace floatframe
