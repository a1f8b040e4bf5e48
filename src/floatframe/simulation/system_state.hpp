#pragma once
// Stored states, and runs that start from one or away from an equilibrium.
#include <optional>
#include <span>
#include <vector>

#include "floatframe/formulation/relative.hpp"
#include "floatframe/integrator/augmented_lagrangian.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/joint_measure.hpp"
#include "floatframe/model/system_state.hpp"
#include "floatframe/simulation/results.hpp"

namespace floatframe {

/// The model with the start values of a state. Throws InputError if the state is of another model.
Model with_start_values(const Model& model, const SystemState& state);

/// The model that a run with these options starts from, if it differs from the given one.
std::optional<Model> started_model(const Model& model, const SimulationDescription& options);

/// Start of a run in relative coordinates: given values, equilibrium or a state, and offsets from
/// the latter two, with loops closed. Throws InputError for a state of another model, RunError if
/// there is no start state.
State start_state(RelativeFormulation& f, const SimulationDescription& options,
                  StartReport* report = nullptr);

/// Tracks the coordinates of all joints, so that turns are counted.
class JointFollower {
 public:
  explicit JointFollower(const Model& model);

  /// After a step: brings f to the state and updates the counts.
  template <class F>
  void follow(F& f, const State& state) {
    kinematics_at(f, state);
    follow_present(f, state.t);
  }
  /// At the present positions and velocities of f.
  template <class F>
  void follow_present(const F& f, double t) {
    const std::vector<Joint>& joints = f.model().joints;
    for (std::size_t k = 0; k < joints.size(); ++k) {
      SystemState::Joint& j = joints_[k];
      const MarkerState& F_ = f.marker(joints[k].frame_F);
      const MarkerState& M = f.marker(joints[k].frame_M);
      for (std::size_t i = 0; i < j.position.size(); ++i) {
        const int component = static_cast<int>(i);
        const double rate = joint_velocity(joints[k], F_, M, component);
        const double turned = started_ ? 0.5 * (t - time_) * (j.velocity[i] + rate) : 0.0;
        const double expected = !started_ && joints[k].motion ? evaluate(*joints[k].motion, t).f
                                                              : j.position[i] + turned;
        j.position[i] = joint_position(joints[k], F_, M, component, expected);
        j.velocity[i] = rate;
      }
    }
    time_ = t;
    started_ = true;
  }
  const std::vector<SystemState::Joint>& joints() const noexcept { return joints_; }

  /// Coordinates and rates of all joints one after the other, to be stored with their time.
  std::vector<double> numbers() const;
  std::size_t size() const noexcept;
  double time() const noexcept { return time_; }
  /// `numbers`: `size()` of them, taken at time t.
  void restore(std::span<const double> numbers, double t) noexcept;

 private:
  std::vector<SystemState::Joint> joints_;
  double time_ = 0.0;
  bool started_ = false;
};

/// Poses and velocities of the bodies from the rest of a state.
void place_bodies(const Model& model, InertiaMethod inertia, SystemState& state);

/// The state of f at `state`, to which f is moved; poses are set by `place_bodies`.
template <class F>
SystemState system_state(F& f, const State& state, JointFollower& joints) {
  joints.follow(f, state);
  const Model& model = f.model();
  SystemState s;
  s.model = model.name;
  s.time = state.t;
  s.joints = joints.joints();
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    SystemState::Body b;
    b.name = model.bodies[i].name;
    const int modes = model.bodies[i].modes();
    b.amplitudes = b.amplitude_rates = VecX::Zero(modes);
    for (int m = 0; m < modes; ++m) {
      b.amplitudes[m] = f.amplitude(state.q, static_cast<int>(i), m);
      b.amplitude_rates[m] = f.amplitude_rate(state.v, static_cast<int>(i), m);
    }
    s.bodies.push_back(std::move(b));
  }
  return s;
}

}  // namespace floatframe
