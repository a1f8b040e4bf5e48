#pragma once
// The motion of the system at one instant, in world axes: what outputs, watches, reactions,
// recording, export and questions about mass read, in any formulation. It is a view of what the
// formulation holds (`Formulation::motion`), valid until the formulation moves; what is not at hand
// there is filled only if a reader needs it (`MotionNeeds`). Step time: no heap, noexcept.
#include <cassert>
#include <span>
#include <vector>

#include "floatframe/math/contracts.hpp"
#include "floatframe/model/element_evaluation.hpp"
#include "floatframe/model/marker_state.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/model/reactions.hpp"

namespace floatframe {

/// What a reader needs in addition to poses, velocities and forces.
struct MotionNeeds {
  bool accelerations = false;  ///< of bodies, modes and markers, after `set_accelerations`
  bool energies = false;       ///< and momenta of the bodies, after `dynamics`
  bool reactions = false;      ///< and accelerations that satisfy the equations of motion

  friend MotionNeeds operator|(MotionNeeds a, MotionNeeds b) noexcept {
    return {a.accelerations || b.accelerations, a.energies || b.energies,
            a.reactions || b.reactions};
  }
};

/// The frame of a body and its modal amplitudes.
struct BodyKinematics {
  // Held by the formulation.
  const Mat3& R_WB;
  const Vec3& w_WB;                   ///< angular velocity [rad/s]
  Eigen::Map<const VecX> y, yd, ydd;  ///< amplitudes, rates, accelerations
  // Filled.
  Vec3 p_WB = Vec3::Zero();              ///< [m]
  Vec3 v_WB = Vec3::Zero();              ///< of the origin [m/s]
  Vec3 a_WB = Vec3::Zero();              ///< of the origin [m/s2]
  Vec3 alpha_WB = Vec3::Zero();          ///< angular acceleration [rad/s2]
  double kinetic_energy = 0.0;           ///< [J]
  double gravity_energy = 0.0;           ///< zero at the origin of the world [J]
  double elastic_energy = 0.0;           ///< [J]
  Vec3 first_moment = Vec3::Zero();      ///< m p_WC [kg m]
  Vec3 momentum = Vec3::Zero();          ///< [kg m/s]
  Vec3 angular_momentum = Vec3::Zero();  ///< about the origin of the world [kg m2/s]
};

struct SystemMotion {
  const Model& model;
  double t = 0.0;              ///< [s]
  Vec3 origin = Vec3::Zero();  ///< positions of markers are measured from this point [m]
  std::vector<BodyKinematics> bodies;
  std::vector<const MarkerState*> markers;
  std::vector<Vec3> marker_accelerations;          ///< of the points [m/s2]
  std::vector<Vec3> marker_angular_accelerations;  ///< angular accelerations [rad/s2]
  std::span<const double> inputs;                  ///< values of model.inputs
  const Efforts* efforts = nullptr;                ///< one for each element
  std::vector<const double*> states;  ///< of each element, and behind them its kept numbers
  struct CountedAngle {
    int joint, component;
    const double* angle;  ///< [rad]
  };
  std::vector<CountedAngle> counted;     ///< angles whose turns elements count
  const Reactions* reactions = nullptr;  ///< if an output needs them

  explicit SystemMotion(const Model& m)
      : model(m),
        marker_accelerations(m.markers.size()),
        marker_angular_accelerations(m.markers.size()) {}
  SystemMotion(const SystemMotion&) = delete;
  SystemMotion& operator=(const SystemMotion&) = delete;

  const BodyKinematics& body(int i) const noexcept {
    assert(is_index(i, bodies));
    return bodies[static_cast<std::size_t>(i)];
  }
  const MarkerState& marker(int i) const noexcept {
    assert(is_index(i, markers));
    return *markers[static_cast<std::size_t>(i)];
  }
  /// Position of a marker in the world [m].
  Vec3 place(int i) const noexcept { return marker(i).r + origin; }
  const Efforts& effort(int i) const noexcept {
    assert(is_index(i, model.elements));
    return efforts[i];
  }
  /// Where a coordinate of a joint begins, of whose turns that counts: at the angle that an element
  /// has counted, else at its motion or the start value of the user.
  double start_position(int joint, int component) const noexcept;
  /// Power of an element on its markers [W].
  double power(int element) const noexcept;
  /// Debug builds: NaN until it is filled.
  void poison_filled() noexcept {
    for (BodyKinematics& b : bodies) {
      for (Vec3* x : {&b.p_WB, &b.v_WB, &b.a_WB, &b.alpha_WB}) poison(*x);
      for (Vec3* x : {&b.first_moment, &b.momentum, &b.angular_momentum}) poison(*x);
      for (double* e : {&b.kinetic_energy, &b.gravity_energy, &b.elastic_energy}) poison(*e);
    }
    for (Vec3& a : marker_accelerations) poison(a);
    for (Vec3& a : marker_angular_accelerations) poison(a);
  }
};

/// `of` a body; of -1 the sum over all.
template <class Of>
auto sum_of_bodies(const SystemMotion& motion, int body, Of of) noexcept {
  if (body >= 0) return of(motion.body(body));
  auto sum = of(motion.body(0));
  for (std::size_t i = 1; i < motion.bodies.size(); ++i) sum += of(motion.bodies[i]);
  return sum;
}

/// Of the modes of a body, and of all bodies [J].
double elastic_energy(const Body& body, const BodyKinematics& motion) noexcept;
double elastic_energy(const SystemMotion& motion) noexcept;
/// Power that modal damping dissipates [W].
double modal_damping_power(const SystemMotion& motion) noexcept;

}  // namespace floatframe
