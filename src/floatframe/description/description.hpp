#pragma once
// The description of a system by the user, by name, before anything is computed: the model file is
// read into it, and a C++ program may fill it directly. Plain structs with documented units and
// defaults; `build_model` converts it to a Model.
//
// Geometry is given in the *design configuration*: all bodies in place, the system assembled, joint
// coordinates and modal amplitudes zero. Points and directions of joints and forces are world
// coordinates of that configuration, so a joint at a point needs no body coordinates; each body has
// a design pose X_WB.
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/description/elements.hpp"
#include "floatframe/description/hints.hpp"
#include "floatframe/description/joint_list.hpp"
#include "floatframe/description/output_list.hpp"
#include "floatframe/description/vehicle_description.hpp"
#include "floatframe/math/piecewise_polynomial.hpp"
#include "floatframe/math/pose.hpp"
#include "floatframe/math/types.hpp"
#include "floatframe/reduction/reduction_options.hpp"
#include "floatframe/roads/road_surface.hpp"

namespace floatframe {

// ----------------------------------------------------------------------------------------------
// flexible bodies

struct SolidRound {
  double diameter = 0.0;
};  ///< [m]
struct HollowRound {
  double outer = 0.0, inner = 0.0;
};  ///< diameters [m]
struct Rectangle {
  double width = 0.0, height = 0.0;
};  ///< along local y, along local z [m]
struct SectionConstants {
  double A = 0, Iy = 0, Iz = 0, J = 0;
};  ///< [m2], [m4]
using SectionDescription = std::variant<SolidRound, HollowRound, Rectangle, SectionConstants>;

/// A straight bar, divided into equal 2-node Euler-Bernoulli beams.
struct BarDescription {
  std::string name;
  std::string from, to;  ///< names of points; bars that share a point share its node
  std::optional<std::string>
      from_bar;                ///< instead of `from`: start at a node of this earlier bar ...
  double from_fraction = 0.0;  ///< ... at this fraction of its length counted from its `from` end
  int elements = 1;
  SectionDescription section;
  Vec3 reference =
      Vec3::UnitZ();  ///< local y is in the plane of the bar and this vector (design axes)
  Origin origin;
};

struct NodeMass {
  std::string node;
  double mass = 0.0;  ///< [kg]
  Origin origin;
};

/// A frame of bars.
struct FrameDescription {
  double young = 0.0, poisson = 0.0, density = 0.0;  ///< [Pa], [-], [kg/m3]
  std::map<std::string, Vec3> points;                ///< template design coordinates [m]
  std::vector<BarDescription> bars;
  std::vector<NodeMass> masses;
};

/// A frame and its reduction: its nodes are those of the ends of bars, by the names of points.
struct FlexibleDescription : FrameDescription, ReductionOptions {};

struct RigidDescription {
  double mass = 0.0;         ///< [kg]; zero is legitimate (massless link)
  Vec3 p_BC = Vec3::Zero();  ///< centre of mass in the body frame [m]
  Mat3 J_C = Mat3::Zero();   ///< inertia about the centre of mass, body axes [kg m2]
  /// Its shape, in the body frame; null: known by its mass and markers only.
  std::shared_ptr<const BodyShape> shape = nullptr;
};

struct BodyDescription {
  std::string name;
  Pose X_WB;  ///< design pose; for a mirrored body the pose *after* mirroring
  /// diag(+-1): the body is the mirror image of what `flexible` describes: body coordinates p_B = P
  /// p_template_B.
  Mat3 mirror = Mat3::Identity();
  Pose X_WT;  ///< design pose of the template (equals X_WB when not mirrored)
  /// The modes of a flexible `kind` are fixed at zero: a rigid body with its mass properties that
  /// keeps its nodes.
  bool rigid = false;
  /// Second-order displacements of the modes are included, which stiffen a body that spins or
  /// carries load; absent: as in SimulationDescription.
  std::optional<bool> geometric_stiffening;
  double largest_angle = 0.0;  ///< of the angles in which its orientation is given [rad]
  std::variant<RigidDescription, FlexibleDescription, FlexibleBody> kind;
  Origin origin;
};

// -----------------------------------------------------------------------------------------------
// joints

/// A value from outside while the model runs, constant during a step: from a controller or a test
/// rig in real time; otherwise it keeps its initial value.
struct InputDescription {
  std::string name;
  std::string unit;                 ///< for people and for the layout of packets
  double initial = 0.0;             ///< value until another one comes
  std::optional<double> low, high;  ///< values outside are rejected ...
  bool clamp = false;               ///< ... or, if true, replaced by the nearer limit
  Origin origin;
};

/// A function of time that a coordinate of a joint follows.
struct CoordinateMotion {
  int coordinate = 0;  ///< its number from 0; no component of a rotation vector
  TimeFunction motion;
};

struct JointDescription {
  std::string name;
  JointType type = JointType::free;
  /// Model files give one design point for both, or a node for either. Two that are apart in the
  /// design configuration, points or nodes, are brought together at the start.
  AttachmentDescription parent, child;
  /// For joints with one or two axes: their meaning is given in the table of joints in
  /// docs/model-file.md.
  Vec3 axis = Vec3::UnitZ();
  Vec3 axis_2 = Vec3::UnitX();  ///< not parallel to axis
  /// Initial coordinates (start values where loops must close): JointKind::coordinates, in this
  /// order [m] or [rad].
  std::vector<double> position;
  std::vector<double> velocity;
  /// The given start values must not change when loops are closed.
  bool keep = false;
  std::optional<TimeFunction> motion;     ///< prescribed, if it is the only coordinate
  std::vector<CoordinateMotion> motions;  ///< the same of joints with several coordinates
  bool cut = false;                       ///< named as a cut joint of the relative formulation
  Origin origin;
};

// -----------------------------------------------------------------------------------------------
// elements

/// An element: where it acts and what it does, in the struct of its type.
struct ElementDescription {
  std::string name;
  ElementKeys kind;
  Origin origin;
  ElementType type() const noexcept { return static_cast<ElementType>(kind.index()); }
};

/// Height z(x) = pieces(x) + sum of cosine bumps height/2 (1 - cos(2 pi (x - start)/length)) on
/// their intervals.
struct CosineBump {
  double start = 0.0, length = 1.0, height = 0.0;  ///< [m]
};
/// Beside the profile, heights over x and y, which are added, and friction: `surface`, null for a
/// road of a profile alone.
struct RoadDescription {
  std::string name;
  PiecewisePolynomial pieces;
  std::vector<CosineBump> bumps;
  Origin origin;
  std::shared_ptr<const RoadSurface> surface = nullptr;
};

// -------------------------------------------------------------------------------------------
// outputs, simulation

/// Axes in which a reaction is given: those of the world, of the joint's frame on its parent or on
/// its child, or of a point, which are those of the world in the design configuration and rotate
/// with the body there.
enum class OutputAxes { world, parent, child, place };

/// Location of a stress, a strain or a section force: a node of the body, by `at.node` of the
/// output or by its number in the finite-element file, or the location nearest to `at.point`.
struct GaugeDescription {
  int node = 0;                                              ///< number; 0: by name or point
  enum class Layer { any, top, bottom } layer = Layer::any;  ///< of shells
  std::string material;  ///< of those that meet at a node, its name; empty: any
  /// Of several locations at a node the farthest in this direction, design configuration.
  Vec3 toward = Vec3::Zero();
  /// Of several beam elements at a node the one that extends in this direction from there.
  Vec3 along = Vec3::Zero();
  Vec3 direction = Vec3::Zero();  ///< of a strain, design configuration
  bool inertia_loads = true;      ///< false: by the modes alone
};

/// A frame on a body with the axes of the world in the design configuration: at a point or a node,
/// or, without `place`, that of the body itself, which no mode moves.
struct ReferenceDescription : AttachmentDescription {
  bool place = false;
};

struct OutputDescription {
  std::string name;  ///< column title without the unit
  OutputType type = OutputType::position;
  AttachmentDescription at;  ///< for point quantities (node/point given) or body quantities
  AttachmentDescription to;  ///< the second of two points
  std::string entity;        ///< joint, force, rod, constraint or coupling name
  std::string value;         ///< of an element with several: its name, or its number from 1
  bool rod = false;          ///< a reaction of a rod
  bool constraint = false;   ///< a reaction of a constraint
  bool about = false;        ///< a reaction about the point `at`, else about that of joint or rod
  OutputAxes in = OutputAxes::world;  ///< of a reaction; of a place: `to`
  bool whole = false;                 ///< a quantity of all bodies together, not of `at.body`
  /// The frame that a motion is relative to, and the axes of its components; absent: the world, and
  /// the axes of `relative`.
  std::optional<ReferenceDescription> relative, axes;
  std::string unit;  ///< of the column: of `output_units`, or any text for a formula
  int component = 0;
  GaugeDescription gauge;
  SharedFormula formula;
  Origin origin;
};

enum class Coordinates { relative, absolute };
enum class InertiaMethod { preprocessing, projection };
enum class Start { given, equilibrium, state };
/// Effect of an input that is set between two steps on the next one: it is constant over the whole
/// step, or varies linearly from its last value.
enum class InputUse { held, ramp };

/// A displacement of a body from its start position; bodies attached to it by joints move with it.
struct StartOffset {
  Vec3 translation = Vec3::Zero();  ///< of the origin of its frame, world [m]
  /// Rotation vector, world [rad]. Without one the body keeps its orientation as far as its joints
  /// allow.
  std::optional<Vec3> rotation;
};

/// Selects the states that a run stores in addition to its outputs (docs/result-file.md).
struct RecordDescription {
  /// by_command: stored by `floatframe run`, not by others.
  enum class States { by_command, none, states } states = States::by_command;
  /// Interval among the output instants; 0: all, or as many as give at most 20 000.
  int every = 0;
  std::vector<std::string>
      bodies;                 ///< coordinates of these and of bodies carrying them; empty: all
  bool accelerations = true;  ///< of the integrator, which (q, v) do not decide to the bit
};

struct SystemState;

struct SimulationDescription {
  Coordinates coordinates = Coordinates::relative;
  InertiaMethod inertia = InertiaMethod::preprocessing;
  /// For all flexible bodies without a separate value; absent: false, but linear analyses include
  /// it for bodies that spin or carry load.
  std::optional<bool> geometric_stiffening = {};
  double step = 1e-3;            ///< [s]
  double duration = 1.0;         ///< [s]
  double output_interval = 0.0;  ///< [s]; 0: every step
  /// Runs end before the duration where it crosses zero; null, or that of the model.
  SharedFormula until = nullptr;
  Start start = Start::given;
  std::shared_ptr<const SystemState> state;   ///< initial state for Start::state
  std::map<std::string, StartOffset> offset;  ///< by body, from the equilibrium or the state
  /// Added to the velocity of every free joint at the start [m/s]; not with Start::state, which
  /// specifies all velocities.
  Vec3 velocity = Vec3::Zero();
  double spectral_radius =
      1.0;  ///< at infinite frequency: 1 = trapezoidal rule, below 1 = generalised-alpha
  double tolerance = 1e-9;  ///< Newton: bound of the largest coordinate increment; the error left
                            ///< is about a hundredth of it
  int max_iterations = 20;
  double min_step = 0.0;             ///< smallest substep [s]; 0: step / 1024
  double penalty = 0.0;              ///< 0: chosen from masses and step
  double position_tolerance = 1e-9;  ///< constraint violation accepted after a step [m]
  double velocity_tolerance = 1e-8;  ///< after the projections [m/s]
  /// Steps are divided where a force or its slope jumps: edges of roads, contact, corners of laws,
  /// all corners of functions of time. Without: at jumps and single corners of the latter.
  bool locate_edges = false;
  InputUse input = InputUse::held;
  RecordDescription record;
  /// Of the group in the model file; code that changes `step` or `duration` later calls `given_by`.
  Origin origin;

  /// The value of `key` comes no longer from the file but from an option of the command line
  /// ("--step"), or from an unknown source ("").
  void given_by(const char* option, const char* key) { origin.keys[key] = SourceMark{option}; }
};

/// Allowed misalignment of axes and points of joints in loops that prevents the loop from moving.
struct SnapDescription {
  bool on = true;
  double angle = 3e-3;     ///< [rad]
  double distance = 1e-3;  ///< relative to the size of the loops
};

struct ModelDescription {
  std::string name = "model";
  Vec3 gravity{0.0, 0.0, -9.81};  ///< [m/s2]
  SnapDescription snap;
  std::vector<BodyDescription> bodies;
  std::vector<JointDescription> joints;
  std::vector<ElementDescription> rods;         ///< elements of type `rod`
  std::vector<ElementDescription> constraints;  ///< of types that hold markers
  std::vector<ElementDescription> couplings;    ///< sums, and gears, belts, ... by name
  std::vector<ElementDescription> controllers;  ///< of types without places
  std::vector<ElementDescription> forces;       ///< all others
  std::vector<RoadDescription> roads;
  std::vector<InputDescription> inputs;
  std::vector<OutputDescription> outputs;
  std::vector<OutputDescription> measures;  ///< of formulas; no columns
  /// Initial modal amplitudes and their rates by body name.
  std::map<std::string, VecX> amplitudes, amplitude_rates;
  std::optional<VehicleDescription> vehicle;  ///< its roles, for manoeuvres
  SimulationDescription simulation;
  /// Hints that were found when the model was packed; null: `build_model` finds them.
  std::shared_ptr<const ModelHints> hints = nullptr;

  const std::vector<ElementDescription>& elements(ElementList list) const {
    return list == ElementList::rods          ? rods
           : list == ElementList::constraints ? constraints
           : list == ElementList::couplings   ? couplings
           : list == ElementList::controllers ? controllers
                                              : forces;
  }
};

}  // namespace floatframe
