#pragma once
// All elements: the struct of each type, with which a program describes one, and the list. An entry
// is the word of model files, the enumerator of ElementType and the name of the source file
// model/elements/<name>.cpp, which reflects the struct in a table of keys and ends in the
// ElementKind `<name>_element` and its `<name>_examples`; then the struct. Everything else runs
// over this list. Numbers and messages follow its order.
//
// Points and directions are those of the design configuration. Laws are functions of a measure.
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/description/attachment.hpp"
#include "floatframe/description/contact_elements.hpp"
#include "floatframe/description/coupling_elements.hpp"
#include "floatframe/description/force_function.hpp"
#include "floatframe/description/held_elements.hpp"
#include "floatframe/description/tyre_elements.hpp"

namespace floatframe {

/// Along the line between two points. Tension positive: F = spring(length - target) + damper(rate -
/// rate of the target) + actuator. With a target it is a cylinder that is driven; rates of targets
/// are those of a JointSpring.
struct SpringDamper {
  AttachmentDescription a, b;
  PiecewisePolynomial
      spring;  ///< of the length [m] -> [N]; bump and rebound stops are pieces of it
  PiecewisePolynomial damper;                         ///< of the rate of the length [m/s] -> [N]
  std::optional<SignalDescription> actuator;          ///< added to both [N]
  std::optional<SignalDescription> target = {};       ///< [m]
  std::optional<SignalDescription> target_rate = {};  ///< [m/s]
};

/// Springs in series with dampers along the line between two points, side by side: tension
/// F = sum k_i (length - z_i), zdot_i = k_i (length - z_i) / c_i. Free of force at a start.
struct Maxwell {
  AttachmentDescription a, b;
  MatX branches;  ///< n x 2: k [N/m], c [N s/m], positive
};

/// Along an axis fixed in a body, between a tip and the body point that slides with it (leaf
/// spring): length L = axis . (reference - tip); F = spring(L) + damper(dL/dt), tension pulls the
/// tip along +axis.
struct GuidedSpring {
  AttachmentDescription reference;  ///< on the body that carries the axis
  AttachmentDescription tip;
  Vec3 axis = Vec3::UnitZ();
  PiecewisePolynomial spring, damper;
  std::optional<SignalDescription> actuator;  ///< added to both [N]
};

/// About the axis of a revolute (angle) or along that of a prismatic joint (displacement):
/// generalised force on the coordinate = actuator - spring(q - target) - damper(qdot - rate of the
/// target). With a target it is a position-controlled motor, with the rate of a target alone
/// a speed-controlled one. Without `target_rate` the rate is the derivative of the function of time
/// in `target`; that of an input is not known and taken as zero.
struct JointSpring {
  std::string joint;
  PiecewisePolynomial spring, damper;
  std::optional<SignalDescription> actuator;     ///< [N] or [N m], positive raises the coordinate
  std::optional<SignalDescription> target;       ///< [m] or [rad]
  std::optional<SignalDescription> target_rate;  ///< [m/s] or [rad/s]
};

/// The rates that the rotational dampers of a bushing are laws of: those of the components of the
/// rotation vector, or the components of the angular velocity.
enum class RotationRate { rotation_vector, angular_velocity };

/// Elastic connection of two bodies, with a law for each displacement along and each rotation about
/// axes fixed in the body of `from`: e3 = axis, e1 = axis_2 without its part along e3, e2 = e3 x
/// e1.
struct Bushing {
  AttachmentDescription from, to;
  Vec3 axis = Vec3::UnitZ(), axis_2 = Vec3::UnitX();
  PiecewisePolynomial spring_x, spring_y, spring_z;     ///< [m] -> [N]
  PiecewisePolynomial spring_rx, spring_ry, spring_rz;  ///< [rad] -> [N m]
  PiecewisePolynomial damper_x, damper_y, damper_z;     ///< [m/s] -> [N]
  PiecewisePolynomial damper_rx, damper_ry, damper_rz;  ///< [rad/s] -> [N m]
  RotationRate rotation_rate = RotationRate::rotation_vector;
};

/// Force or torque: direction * magnitude(t), at a point of a body; the direction turns with the
/// body if `follows`.
struct AppliedLoad {
  AttachmentDescription at;
  Vec3 direction = Vec3::UnitX();  ///< used as given (not normalised)
  SignalDescription magnitude;     ///< [N] or [N m] per unit of direction
  bool follows = false;
};
struct AppliedForce : AppliedLoad {};
struct AppliedTorque : AppliedLoad {};

/// A shaft (`to`) in a housing (`from`), which carries the axes of a bushing; the shaft may turn
/// about e3 without end. Matrices are 6 x 6 - three displacements, two tilts, the spin - or 2 x 2
/// in the plane of e1, e2; 0 x 0: none.
struct Bearing {
  AttachmentDescription from, to;
  Vec3 axis = Vec3::UnitZ(), axis_2 = Vec3::UnitX();
  MatX stiffness;    ///< [N/m, N, N m/m, N m/rad]
  MatX damping;      ///< [N s/m, N s, N m s/m, N m s/rad]
  MatX speed_table;  ///< n x 9, added to both over the spin
};

/// Without mass, keeps the distance between two points, or prescribes it: a stiff cylinder.
struct Rod {
  AttachmentDescription a, b;
  std::optional<double> length;        ///< [m]; as drawn if absent
  std::optional<TimeFunction> motion;  ///< instead: the distance [m], positive, without jumps
};

/// Prescribes a coordinate of a joint [m or rad]: the key `motion` of joints.
struct PrescribedMotion {
  std::string joint;
  SignalDescription motion;
  int coordinate = 0;  ///< its number from 0
};

/// A force that a program gives as a function of x, v and the time: along the line between two
/// points, x their distance, tension positive; or on the only coordinate of a joint, x = q counted
/// over turns, against which it acts. In both cases F = k x + c v is a spring with a damper.
struct ForceLaw {
  std::optional<AttachmentDescription> a, b;  ///< both, or ...
  std::optional<std::string> joint;           ///< ... this
  ForceFunction law;
};

/// A controller that computes a value at the instants offset + k period, k = 0, 1, ..., from the
/// motion there. The value acts from `delay` later on, until the next one does.
struct Sampling {
  std::optional<double> period;         ///< [s]; absent: it acts continuously
  std::optional<double> offset, delay;  ///< [s]; absent: 0
};

/// A controller with proportional, integral and derivative terms of the error e = target -
/// measured: u = proportional e + i + derivative edot, clipped to [lower, upper]. edot is that of
/// `rate`, the rate of `measured`, if it is given, and of the target; else that of e behind a
/// filter of first order.
struct Pid : Sampling {
  SignalDescription measured;
  std::optional<SignalDescription> target;  ///< absent: 0
  std::optional<SignalDescription> rate;
  double proportional = 0.0, integral = 0.0, derivative = 0.0;  ///< [1], [1/s], [s], times units
  std::optional<double> filter;                                 ///< its time [s]
  std::optional<double> lower, upper;
  /// While u is clipped, i returns within this time [s]; absent: proportional / integral.
  std::optional<double> unwind;
};

/// The value of a formula of measures, inputs, results of elements and the time.
struct FormulaValue {
  SharedFormula formula;
};

/// What the states of a linear block are at a start that gives none: those at rest for its inputs
/// there, zero if it has a pole at 0; or zero.
enum class BlockStart { rest, zero };

/// y = numerator(s) / denominator(s) u; 1 x n: coefficients of descending powers of s; of z if it
/// is sampled.
struct TransferFunction : Sampling {
  SignalDescription input;
  MatX numerator, denominator;
  BlockStart initial = BlockStart::rest;
};

/// xdot = A x + B u, y = C x + D u, of inputs u and values y; sampled: x_k+1 = A x_k + B u_k.
struct StateSpaceBlock : Sampling {
  std::vector<SignalDescription> inputs;
  MatX A, B, C, D;                   ///< D 0 x 0: zero
  std::vector<std::string> outputs;  ///< names of the values; empty: only their numbers from 1
  BlockStart initial = BlockStart::rest;
};

/// A low pass of first order, 1 / (1 + time s), or with a damping of second order, 1 / (1 + 2
/// damping time s + time^2 s^2).
struct LowPass {
  SignalDescription input;
  std::optional<double> time;       ///< [s], or ...
  std::optional<double> frequency;  ///< ... 1 / (2 pi time) [Hz]
  std::optional<double> damping;
  BlockStart initial = BlockStart::rest;
};

/// The integral of the input, which stays within [lower, upper].
struct LimitedIntegral {
  SignalDescription input;
  double initial = 0.0;
  std::optional<double> lower, upper;
  double unwind = 1e-3;  ///< in which it returns to a limit that a step has crossed [s]
};

/// The input, clipped to [lower, upper].
struct Limiter {
  SignalDescription input;
  std::optional<double> lower, upper;
};

/// ydot = (input - y) / time, clipped to [-falling, rising].
struct RateLimiter {
  SignalDescription input;
  double rising = 0.0;            ///< [1/s], times units
  std::optional<double> falling;  ///< absent: equal to rising
  double time = 1e-3;             ///< [s]
};

enum class RelaySide { below, above };

/// `above` after the input has reached `upper`, `below` after it has reached `lower`.
struct Hysteresis {
  SignalDescription input;
  double lower = 0.0, upper = 0.0;
  double below = 0.0, above = 1.0;
  RelaySide initial = RelaySide::below;  ///< of an input between both
};

/// The input, sampled.
struct ZeroOrderHold : Sampling {
  SignalDescription input;
  double initial = 0.0;  ///< value until the first one acts
};

/// The input as it was `time` before; before the start it is that of the start.
struct Delay {
  SignalDescription input;
  double time = 0.0;  ///< [s]
  double pade = 2.0;  ///< order of its Pade approximation in linear systems, a whole number
};

/// The road-wheel angle with which a vehicle follows a path, in the axes of the world: a
/// cubic spline through points, or a circle.
struct PathFollowing {
  SignalDescription x, y;       ///< of the point that follows the path [m]
  SignalDescription vx, vy;     ///< its velocity [m/s]
  SignalDescription yaw_rate;   ///< [rad/s]
  MatX points = {};             ///< n x 2: x, y [m]; or ...
  MatX circle = {};             ///< ... 1 x 3: centre and radius [m], positive: to the left
  bool closed = false;          ///< the points are a ring
  double wheelbase = 0.0;       ///< [m]
  double course_gain = 10.0;    ///< omega_0 [1/s]
  double offset_gain = 0.5;     ///< omega_e [1/s]
  double preview = 0.2;         ///< T [s]
  double yaw_gain = 0.08;       ///< k_r [s]
  double integral_time = 0.05;  ///< T_0 [s]
  double largest_angle = 0.7;   ///< [rad]
};

/// The force that holds a vehicle at a speed: m (k_p (v_d - v) + k_i times its integral), clipped.
struct SpeedControl {
  SignalDescription measured, target;            ///< v, v_d [m/s]
  double mass = 0.0;                             ///< [kg]
  double proportional = 2.0;                     ///< k_p [1/s]
  double integral = 1.0;                         ///< k_i [1/s2]
  std::optional<double> lower = {}, upper = {};  ///< [N]
};

// clang-format off
#define FLOATFRAME_ELEMENTS(entry)      \
  entry(spring_damper, SpringDamper)    \
  entry(guided_spring, GuidedSpring)    \
  entry(joint_spring, JointSpring)      \
  entry(tyre, Tyre)                     \
  entry(bushing, Bushing)               \
  entry(force, AppliedForce)            \
  entry(torque, AppliedTorque)          \
  entry(maxwell, Maxwell)               \
  entry(bristle_friction, BristleFriction)   \
  entry(unilateral_spring, UnilateralSpring) \
  entry(bearing, Bearing)               \
  entry(rod, Rod)                       \
  entry(motion, PrescribedMotion)       \
  entry(coupling, Coupling)             \
  entry(force_law, ForceLaw)            \
  entry(pid, Pid)                       \
  entry(formula, FormulaValue)          \
  entry(transfer_function, TransferFunction) \
  entry(state_space, StateSpaceBlock)   \
  entry(integrator, LimitedIntegral)    \
  entry(filter, LowPass)                \
  entry(limiter, Limiter)               \
  entry(rate_limiter, RateLimiter)      \
  entry(hysteresis, Hysteresis)         \
  entry(zero_order_hold, ZeroOrderHold) \
  entry(delay, Delay)                   \
  entry(joint_stop, JointStop)          \
  entry(gear, Gear)                     \
  entry(bevel_gear, BevelGear)          \
  entry(planetary, PlanetaryGear)       \
  entry(differential, DifferentialGear) \
  entry(rack_and_pinion, RackAndPinion) \
  entry(screw, ScrewDrive)              \
  entry(belt, BeltDrive)                \
  entry(mimic, Mimic)                   \
  entry(in_line, InLine)                \
  entry(in_plane, InPlane)              \
  entry(parallel, Parallel)             \
  entry(perpendicular, Perpendicular)   \
  entry(constant_velocity, ConstantVelocity) \
  entry(cam, Cam)                       \
  entry(point_on_curve, PointOnCurve)   \
  entry(journal_bearing, JournalBearing) \
  entry(curve_on_curve, CurveOnCurve)   \
  entry(slide_along, SlideAlong) \
  entry(linear_tyre, LinearTyre) \
  entry(magic_formula_tyre, MagicFormulaTyre) \
  entry(tmeasy_tyre, TmeasyTyre) \
  entry(calspan_tyre, CalspanTyre) \
  entry(aerodynamic_load, AerodynamicLoad) \
  entry(path_follower, PathFollowing) \
  entry(speed_controller, SpeedControl)
// clang-format on

#define FLOATFRAME_ENTRY(name, Keys) name,
enum class ElementType { FLOATFRAME_ELEMENTS(FLOATFRAME_ENTRY) };
#undef FLOATFRAME_ENTRY

#define FLOATFRAME_ENTRY(name, Keys) ElementType::name,
inline constexpr ElementType element_types[] = {FLOATFRAME_ELEMENTS(FLOATFRAME_ENTRY)};
#undef FLOATFRAME_ENTRY

#define FLOATFRAME_ENTRY(name, Keys) #name,
inline constexpr const char* element_words[] = {FLOATFRAME_ELEMENTS(FLOATFRAME_ENTRY)};
#undef FLOATFRAME_ENTRY

/// "spring_damper", "tyre", ...
constexpr const char* element_type_name(ElementType type) noexcept {
  return element_words[index_of(type)];
}

/// The lists of a description, each with names of its own. Motions are described with their joints.
enum class ElementList { forces, controllers, rods, constraints, couplings, motions };
inline constexpr std::size_t element_list_count = 6;
/// The section of model files.
constexpr const char* element_list_name(ElementList list) noexcept {
  constexpr const char* names[element_list_count] = {"forces",      "controllers", "rods",
                                                     "constraints", "couplings",   "joints"};
  return names[index_of(list)];
}

template <class, class... Keys>
using VariantOf = std::variant<Keys...>;
/// What the user says about one element: one of the structs above, in the order of the list.
#define FLOATFRAME_ENTRY(name, Keys) , Keys
using ElementKeys = VariantOf<void FLOATFRAME_ELEMENTS(FLOATFRAME_ENTRY)>;
#undef FLOATFRAME_ENTRY

}  // namespace floatframe
