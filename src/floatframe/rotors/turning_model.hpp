#pragma once
// A model whose rotor turns steadily, and its small motions in the inertial frame.
//
// The linear system there, zdot = A z, is in coordinates some of which rotate with the rotor. In
// the inertial frame they are m = T(t) z: displacements of points on the axis, rotations of bodies,
// amplitudes D(theta) y, and the increments of all their rates. Along the steady motion
//   mdot = (Tdot + T A) z = T B z,   B = T^+ (Tdot + T A)                                       (1)
// with B constant if the rotor is symmetric about its axis, whatever its supports. Eigenvalues of B
// are those in the inertial frame. Tdot T^+ + T A T^+ at another angle must be the same operator:
// `dependence_on_angle` measures the deviation.
#include <complex>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/linear/linear_system.hpp"
#include "floatframe/rotors/rotor.hpp"

namespace floatframe {

enum class MotionKind {
  forward,      ///< the axis of the rotor moves laterally, in the sense of the rotor,
  backward,     ///< against it,
  planar,       ///< or along lines
  along_axis,   ///< along or about itself: "axial or torsion"
  bending,      ///< hardly at all, but the rotor deforms: flap and lag of blades
  other_bodies  ///< the rotor hardly moves
};
/// "forward", "axial or torsion", ...
const char* kind_of_motion(MotionKind kind) noexcept;

/// One motion e^(lambda t) m of a rotating system, in the inertial frame.
struct TurningMode {
  std::complex<double> lambda;  ///< [1/s], Im >= 0
  Eigen::VectorXcd m;           ///< normalised
  /// Its displacements times the root of the masses, normalised: m_a^H m_b of these compares
  /// shapes.
  Eigen::VectorXcd shape;
  /// 1: points of the axis whirl on circles with the rotor, -1: against it, 0: on lines.
  double whirl = 0.0;
  double across = 0.0;  ///< lateral fraction of the motion of the axis; 0: no motion there
  MotionKind kind = MotionKind::along_axis;
  bool unbalance = false;  ///< forces that rotate with the rotor at its axis excite it
};

/// A force that rotates with the rotor, Re(size (e_1 - i e_2) e^(i W t)), at a point of its axis:
/// e_1, e_2 fixed and normal to the axis, e_1 x e_2 in the sense of positive speed.
struct AxisForce {
  int body = -1, node = -1;  ///< node: of a flexible body; -1: the point `p_BP`
  Vec3 p_BP = Vec3::Zero();
  std::complex<double> size = 1.0;  ///< [N]
};

/// Outputs y = mean + Re(amplitude e^(i W t)) under such forces.
struct TurningResponse {
  VecX means;
  Eigen::VectorXcd amplitudes;
  std::vector<char> smooth;  ///< the output has a slope there
};

class TurningModel {
 public:
  /// For the joint and axis of `find_rotor`. Relative coordinates regardless of the model. Weight
  /// is included if the model has it. Throws InputError, or RunError if there is no start state.
  TurningModel(const Model& model, const std::string& joint, const std::optional<Vec3>& axis);
  ~TurningModel();

  /// Modes at this speed [rad/s], ascending by |lambda|; of a pair the one with Im > 0. Throws
  /// RunError if there is no steady state.
  std::vector<TurningMode> modes(double speed);
  /// Relative change of eigenvalues if the systems of other angles of the rotor are mixed in:
  /// round-off for a symmetric rotor.
  double dependence_on_angle(double speed);

  /// Outputs of the model by their indices. `angle`: the angle of the rotor at evaluation, which
  /// changes the outputs that rotate with it. Throws RunError in an undamped resonance.
  TurningResponse response(double speed, const std::vector<AxisForce>& forces,
                           const std::vector<int>& outputs, double angle = 0.0);
  /// e_1, e_2 and the axis, in the inertial frame, at the start angle of the rotor.
  Mat3 directions() const;

  const Model& model() const;
  const Rotor& rotor() const;
  /// At the last speed: distance of the centre of mass of the rotor from its axis [m].
  double eccentricity() const;
  /// Messages for the user, one sentence each without its full stop.
  const std::vector<std::string>& notes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace floatframe
