#pragma once
// The system at a sample, as seen by outputs in either formulation: markers, bodies, joints and
// forces of the model, never coordinates. Its functions are direct calls (formulation/
// output_view.cpp), noexcept and free of allocation.
#include "floatframe/model/force_evaluation.hpp"
#include "floatframe/model/marker_state.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/model/reactions.hpp"

namespace floatframe {

class RelativeFormulation;
class AbsoluteFormulation;

class OutputView {
 public:
  /// After `positions(t, q)`, `velocities`, `forces` and `set_accelerations` of the formulation,
  /// and `dynamics` if an output needs inertia terms. `reactions` if an output needs them.
  OutputView(const RelativeFormulation& formulation, double t, const VecX& q,
             const Reactions* reactions = nullptr) noexcept;
  OutputView(const AbsoluteFormulation& formulation, double t, const VecX& q,
             const Reactions* reactions = nullptr) noexcept;

  const Model& model() const noexcept { return model_; }
  double time() const noexcept { return t_; }
  /// Position of a marker in the world [m].
  Vec3 place(int marker) const noexcept { return this->marker(marker).r + origin_; }
  /// Motion of a marker, world axes; its position `r` is relative to a point common to all markers.
  const MarkerState& marker(int marker) const noexcept;
  /// Of the marker's point [m/s2].
  Vec3 acceleration(int marker) const noexcept;
  /// Of the origin of the body frame, world axes [m, m/s, m/s2].
  Vec3 body_position(int body) const noexcept;
  Vec3 body_velocity(int body) const noexcept;
  Vec3 body_acceleration(int body) const noexcept;
  /// R_WB
  const Mat3& body_rotation(int body) const noexcept;
  /// w_WB, world axes [rad/s].
  Vec3 body_angular_velocity(int body) const noexcept;
  /// World axes [rad/s2].
  Vec3 body_angular_acceleration(int body) const noexcept;
  double amplitude(int body, int mode) const noexcept;
  double amplitude_rate(int body, int mode) const noexcept;
  double amplitude_acceleration(int body, int mode) const noexcept;
  /// [J]
  double kinetic_energy(int body) const noexcept;
  double gravity_energy(int body) const noexcept;
  double elastic_energy(int body) const noexcept;
  const ForceState& force(int force) const noexcept;
  /// Only for outputs that require them (`OutputTerms::reactions`).
  const Reactions& reactions() const noexcept { return *reactions_; }

 private:
  template <class Get>
  decltype(auto) from(Get get) const noexcept;

  const RelativeFormulation* relative_ = nullptr;  // one of the two
  const AbsoluteFormulation* absolute_ = nullptr;
  const Model& model_;
  const VecX& q_;
  const Reactions* reactions_;
  double t_;
  Vec3 origin_;
};

/// Last sample of an output: angles over several turns are continued from there.
struct FollowedOutput {
  bool started = false;
  double time = 0.0, position = 0.0, rate = 0.0;
};

}  // namespace floatframe
