#pragma once
// The built system: immutable, shared by threads; names are resolved to indices. Made by
// `build_model`.
//
// Markers are the only interface: joints and elements have markers and never access
// coordinates. A marker is attached to a node of a flexible body and moves with its deformation, or
// is fixed in a rigid body or in the ground:
//   p_BM = p + X y + exp(skew(X_theta y)) p_NM,   R_BM = exp(skew(X_theta y)) R_NM.
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/description/description.hpp"
#include "floatframe/model/gauge.hpp"
#include "floatframe/model/model_hints.hpp"

namespace floatframe {

class SlidePath;

struct Marker {
  int body = -1;  ///< -1: ground
  int node = -1;  ///< node of a flexible body; -1: fixed in the body frame (ground: world frame)
  Pose X_NM;      ///< in the node frame; with node = -1 in the body frame
  bool rotates = false;  ///< the rotation of the node enters (orientation or offset is used and
                         ///< X_theta is not zero)
  /// It slides along nodes of its flexible body, at the foot of the marker `guide`; else null.
  std::shared_ptr<const SlidePath> path = nullptr;
  int guide = -1;
};

struct Body {
  std::string name;
  std::shared_ptr<const FlexibleBody> data;
  Pose X_WB;            ///< design pose
  double length = 1.0;  ///< characteristic length: scales direction rows to lengths [m]
  bool geometric_stiffening = false;
  bool stiffening_given = false;  ///< the key is given, for it or for all bodies
  int modes() const noexcept { return data->modes(); }
  /// Second-order displacements are included (SecondOrder).
  bool stiffens() const noexcept {
    return geometric_stiffening && modes() > 0 && data->second_order != nullptr;
  }
};

struct Joint {
  std::string name;
  JointType type = JointType::free;
  int parent = -1, child = -1;             ///< bodies
  int frame_F = -1, frame_M = -1;          ///< markers on parent and child, z along the joint axis
  Vec3 axis_2 = Vec3::UnitX();             ///< in the joint frame
  std::vector<double> position, velocity;  ///< start values, in the user's form
  bool keep = false;                       ///< they must not move when loops are closed
  int motion = -1;                         ///< the element that prescribes its only coordinate
  /// Of several coordinates those that prescribe them, -1: none; empty: none at all.
  std::vector<int> motions = {};
  bool cut = false;        ///< marked as cut by the user, for relative coordinates
  bool automatic = false;  ///< a free joint added for a body that no joint leads to
};

struct Road {
  std::string name;
  PiecewisePolynomial pieces;
  std::vector<CosineBump> bumps;
  /// Heights over x and y, and friction; null: a profile alone.
  std::shared_ptr<const RoadSurface> surface = nullptr;
};

/// A signal port: a function of time plus, with `input` >= 0, the value of that input.
/// A formula of the measure of its own element and its rate, of inputs and the time, which is a
/// part of the law of that.
struct LocalFormula {
  enum class Operand { time, input, measure, rate };
  struct Reference {
    Operand of = Operand::time;
    int input = -1;
  };
  std::string name;  ///< of the element and the key
  SharedFormula formula;
  std::vector<Reference> references;
};

struct Signal {
  TimeFunction function;
  int input = -1;
  int link = -1;  ///< of Model::links: a result of an element is added
  bool given = false;
  bool differentiated = false;  ///< the rate of the function is used as well
  std::shared_ptr<const LocalFormula> local = nullptr;  ///< is added
};

/// The scalar force or torque of an element, its measure (length, deflection, angle) and the rate
/// of that. Measure and rate follow from the motion alone.
enum class ElementQuantity { force, length, rate };

/// A result of an element, times a factor, that is part of a signal of another one.
struct SignalLink {
  int from = -1, to = -1;  ///< elements
  int port = 0;            ///< the signal of the second one
  ElementQuantity quantity{};
  double factor = 1.0;
  int value = 0;  ///< of `EffortsOf::further`, from 1, in place of the force
  /// Among the results of an element: force, length, rate and further values.
  int result() const noexcept { return value > 0 ? 2 + value : static_cast<int>(quantity); }
};

/// A coordinate of a joint that an element acts on or holds, measured at the two markers of the
/// joint, which are consecutive ports of the element.
struct CoordinatePort {
  int joint = -1, component = 0;
  int port = 0;          ///< of the frame on the parent; the next one is on the child
  bool counted = false;  ///< an angle that is followed over several turns
};

struct OutputFormula;

struct Output {
  std::string name, unit;
  OutputType type = OutputType::position;
  int marker = -1, to = -1;   ///< of points; `to`: the second of two
  int body = -1, joint = -1;  ///< no body: of a quantity of all bodies
  int element = -1;           ///< of a force, or of a reaction
  int component = 0;
  int gauge = -1;
  int relative = -1, axes = -1;  ///< markers; -1: the world
  double factor = 1.0;           ///< of the unit: column = factor * value in SI
  std::shared_ptr<const OutputFormula> formula;
};

/// What a reference of a formula stands for.
struct FormulaOperand {
  enum class Kind {
    time,
    input,
    link,     ///< a result of another element: the signal `index` of the element
    measure,  ///< `output` of the present motion
    sample    ///< `output` at the last accepted instant: the kept number `index`
  } kind = Kind::time;
  int index = -1;
  Output output;
  double factor = 1.0, offset = 0.0;  ///< of the output: those of a mirror
  std::array<int, 4> ports{-1, -1, -1,
                           -1};  ///< the markers of a measure among those of the element
  int angle = -1;                ///< its turns are counted: the coordinate of the element
};

/// A formula of samples, and what each of its references stands for.
struct OutputFormula {
  SharedFormula formula;
  std::vector<FormulaOperand> operands;
};

/// A value is computed at the instants first + k period, k = 0, 1, ..., and acts `delay` later.
struct SampleClock {
  double first = 0.0, period = 0.0, delay = 0.0;  ///< [s]; no period: the element is not sampled
  int waiting = 0;                                ///< values that do not act yet
  SourceMark mark = {};                           ///< of its key
  bool ticks() const noexcept { return period > 0.0; }
};

/// What an element reads of the reaction of a joint. The load is its last kept number [N] or [N m].
struct LoadPort {
  int joint = -1;       ///< -1: none
  double across = 1.0;  ///< factor of the forces across the axis [1] or [m]
  double along = 0.0;   ///< of the force along the axis [1] or [m]
  double length = 0.0;  ///< of the bearing, which carries moments [m]; 0: none does
};

/// An element: what it is connected to, by index, and what it does. The table of
/// keys of its kind gives the key of each law and signal.
struct Element {
  std::string name;
  ElementType type{};
  std::vector<int> markers;                 ///< its ports on bodies, in the order of its kind
  std::vector<PiecewisePolynomial> laws;    ///< those of its keys, in their order
  std::vector<Signal> signals;              ///< those of its keys, in their order
  std::vector<CoordinatePort> coordinates;  ///< of joints, in the order of its kind
  std::vector<FormulaOperand> operands;     ///< of the references of its formula
  LoadPort load;                            ///< of the joint whose reaction it reads
  std::vector<std::string> values;          ///< the names of its values, if it has several
  int road = -1;
  int states = 0;            ///< variables of first order of its law
  int kept = 0;              ///< numbers that change between steps only
  SampleClock clock;         ///< of its value, if it is sampled
  bool rates_first = false;  ///< its law gives the rates of its states alone (PortsOf::rates_alone)
  bool remembers = false;    ///< they are a past, which the law reads by `PortsOf::kept` alone
  VecX start_states;         ///< states and kept numbers at the start; empty: those of the kind
  bool acts = true;          ///< by a law
  bool holds = false;        ///< its markers, by constraints
  bool reads = false;        ///< its markers only: it exerts nothing
  bool rotational = false;   ///< its measure is an angle
  bool driven = false;       ///< by a signal that it follows or that is a force, or by a function
  bool target_jumps = false;  ///< one that it follows may jump
  bool switched = false;  ///< its branches are those of its local formula, and its laws have none
  std::shared_ptr<const ElementKeys> keys;  ///< what the user has said
  std::shared_ptr<const void> data;         ///< what the kind has computed from it
  /// Its angle is followed over several turns.
  bool counts_turns() const noexcept { return exerts() && rotational; }
  /// It holds bodies to each other, as a joint does.
  bool links() const noexcept { return holds && coordinates.empty(); }
  /// Values beside the force, which is the first one.
  int further() const noexcept { return std::max<int>(1, std::ssize(values)) - 1; }
  /// It exerts forces, as everything that acts but controllers.
  bool exerts() const noexcept { return acts && !reads && !markers.empty(); }
};

/// An external signal. Its value belongs to a run, not to the model: see `set_inputs` of the
/// formulations.
struct Input {
  std::string name, unit;
  double initial = 0.0;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool clamp = false;  ///< a value outside is replaced by the nearer limit, not refused
};

/// The origin of a constraint row: a joint, an element, or an element that holds a coordinate of a
/// joint.
struct ConstraintOwner {
  int joint = -1, element = -1;
};

struct Model {
  std::string name;
  Vec3 gravity = Vec3::Zero();
  std::vector<Body> bodies;
  std::vector<Joint> joints;      ///< automatic free joints last
  std::vector<Element> elements;  ///< of forces, controllers, rods, constraints, couplings, motions
  std::vector<SignalLink> links;  ///< from element to element
  std::vector<Road> roads;
  std::vector<Input> inputs;
  std::vector<Marker> markers;
  std::vector<Output> outputs;
  std::vector<Output> measures;  ///< of formulas; no columns
  std::optional<Output> until;   ///< the formula that ends runs where it crosses zero
  std::vector<Gauge> gauges;
  std::vector<VecX> amplitudes, amplitude_rates;  ///< start values, per body
  double mean_mass = 1.0;  ///< of the bodies with mass: scales the penalty [kg]
  SimulationDescription simulation;
  std::optional<VehicleDescription> vehicle;  ///< for manoeuvres; the motion does not depend on it
  ModelHints hints;     ///< for checks of the model; nothing else depends on them
  bool linear = false;  ///< it is evaluated for a linear system: delays are approximated
  /// What prescribes a coordinate of a joint; nullptr: nothing.
  const TimeFunction* motion_of(const Joint& joint, std::size_t component = 0) const noexcept {
    const int by = joint.motions.empty() ? joint.motion : joint.motions[component];
    return by < 0 ? nullptr : &elements[by].signals[0].function;
  }
};

/// States of all elements together.
int state_count(const Model& model) noexcept;

/// Checks and builds: reduces flexible bodies (equal descriptions once), finds nodes, adds free
/// joints to bodies without a joint that leads to them. Throws InputError with every error.
Model build_model(const ModelDescription& description);

/// Returns the model itself if `build_model` has made it; InputError if it is empty
/// (default-constructed or moved from) or inconsistent.
const Model& built(const Model& model);

}  // namespace floatframe
