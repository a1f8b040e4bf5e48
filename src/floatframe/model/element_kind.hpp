#pragma once
// Interface of an element. A new one is one file model/elements/<name>.cpp and its struct with one
// entry in elements.hpp: reader, validation, mirror, outputs, energies, pictures, statics, linear
// systems, both formulations, the table of the documentation and the generic tests run over the
// list.
//
// An element acts on its markers and never accesses a coordinate. Its law is a template over its
// scalar (element_evaluation.hpp): steps call it by name with doubles, without a pointer: noexcept,
// no allocation; linear systems with dual numbers. The pointers of an ElementKind are used at load
// time only.
#include <array>
#include <span>
#include <string>

#include "floatframe/description/placement.hpp"
#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/element_build.hpp"
#include "floatframe/model/element_evaluation.hpp"
#include "floatframe/model/element_outputs.hpp"
#include "floatframe/model/example_numbers.hpp"

namespace floatframe {

struct SystemMotion;

/// A test regime of the element: contact or none, on a slope, following, ...
struct ElementRegime {
  const char* name;
  /// Terms of the symmetric part of the tangent at rest that the rows of Efforts omit; empty if
  /// none.
  const char* rows_leave_out = "";
  /// At rest the wrench is minus the gradient of the energy, and motion only dissipates energy.
  bool conservative = true;
  bool differences = false;  ///< slopes are differences: rounding of the measure is divided by 1e-6
  bool acts = true;          ///< some wrench in at least some of the examples
  bool regular = true;  ///< the wrench has a derivative here. False where it has none (the ends of
                        ///< a spring coincide, a wheel flat on the road): there the tests check
                        ///< only that the tangent is finite
};

/// Type, laws and signals of an element from its keys.
void take_keys(Element& element, const Model& model);
/// The signals of its keys, in their order.
std::vector<std::optional<SignalDescription>> signal_values(const ElementDescription& element);

struct ElementExample {
  Model model;  ///< holds roads and inputs
  Element element;
  std::vector<MarkerState> markers;
  Vec3 origin = Vec3::Zero();
  double t = 0.0, reference_angle = 0.0;
  std::vector<double> inputs;
  std::vector<double> links;   ///< results of other elements, times their factors
  std::vector<double> states;  ///< and kept numbers
  double state_weight = std::numeric_limits<double>::infinity();

  /// With these keys: their laws and signals, and inputs by the names of `model.inputs`.
  template <class Keys>
  void keys(Keys keys) {
    element.keys = std::make_shared<const ElementKeys>(std::move(keys));
    take_keys(element, model);
    link_signals();
  }
  /// A function of time plus a new input.
  SignalDescription signal(ExampleNumbers& numbers);
  /// The same with a result of another element.
  SignalDescription linked_signal(ExampleNumbers& numbers);
  /// The same with a formula of the measure of the element, its rate, the input and the time.
  SignalDescription local_signal(ExampleNumbers& numbers);

 private:
  void link_signals();
};
/// What a state of an element follows at rest: it is the change of `place` since the start, at most
/// `largest` by size.
struct Deflection {
  double place = 0.0;  ///< [m] or [rad]
  double largest = 0.0;
  double period = 0.0;  ///< places that differ by it are the same: a turn; 0: none
};
/// Fills `out`, which is clear on entry. The step calls it by name, without a pointer.
template <ElementType type>
void efforts_of(const Ports& in, Efforts& out) noexcept;

/// For an element that only holds its markers.
#define FLOATFRAME_NO_LAW(name) \
  template <>                   \
  void efforts_of<ElementType::name>(const Ports&, Efforts&) noexcept {}
/// Defines it by the template `<name>_law(const PortsOf<S>&, EffortsOf<S>&)`.
#define FLOATFRAME_LAW(name)                                                   \
  template <>                                                                  \
  void efforts_of<ElementType::name>(const Ports& in, Efforts& out) noexcept { \
    name##_law(in, out);                                                       \
  }

/// The types of the elements of a list.
std::vector<ElementType> types_of(ElementList list);

struct ElementKind {
  const char* about;  ///< its function: for the documentation, a phrase in Markdown
  std::span<const ElementKey> keys;
  ElementList list = ElementList::forces;
  /// The key of joints that holds its keys but the joint and its coordinate; null: none.
  const char* joint_word = nullptr;
  EnergyCategory energy = EnergyCategory::springs;
  /// The units of its results.
  ElementAxis axis = ElementAxis::along;
  /// It has a length and a rate.
  bool measured = true;
  /// An empty struct of this type.
  ElementKeys (*blank)();
  /// The natural value of a law given as a number: that of the design configuration.
  double (*free_value)(const ElementView& values, const ElementKey& key) = nullptr;
  /// Checks of the values in combination.
  void (*validate)(const ElementCheck& check) = nullptr;
  /// Connects `build.element` to its markers; false after an error.
  bool (*build)(ElementBuild& build);
  /// Appends its constraints between its markers; `part` carries the element as their owner.
  void (*rows)(const Model& model, const Element& element, ConstraintPart part,
               std::vector<ConstraintPart>& parts) = nullptr;
  /// With these keys it acts by its law, else it holds by its rows. Null: by what it has.
  bool (*gives_way)(const ElementKeys& keys) = nullptr;
  /// Changes of the mirrored element besides mirrored points and directions.
  void (*mirror)(ElementDescription& element, const Placement& x) = nullptr;
  /// Changes of the mirrored element if its coordinate of a joint changes the sign.
  void (*reverse)(ElementDescription& element) = nullptr;
  /// States and kept numbers of an element with these keys; null: none.
  void (*states)(Element& element) = nullptr;
  /// Its values with their units, if there are several.
  std::vector<ElementValue> (*values)(const ElementKeys& keys) = nullptr;
  /// Their values at a start that gives none: those of the element at rest in this motion. Null:
  /// zero.
  void (*start)(const Ports& in, double* states) noexcept = nullptr;
  /// Changes the kept numbers when the start is found, at which the ports are.
  void (*settle)(const Ports& in, double* states) noexcept = nullptr;
  /// Of an element whose states are deflections, as of bristles. Null: at rest states without an
  /// equation keep their values.
  Deflection (*deflection)(const Ports& in, int state) noexcept = nullptr;
  /// What such states, kept at zero, leave out of an equilibrium: "friction". Null: nothing.
  const char* left_out_at_rest = nullptr;
  /// Changes the kept numbers at the end of a step, at which the ports are. Step time.
  void (*after_step)(const Ports& in, double* states) noexcept = nullptr;
  /// Of a sampled element (sampling.hpp): its values y at an instant, and its own kept numbers
  /// behind those of `take_clock`. Step time.
  void (*sample)(const Ports& in, double* own, double* y) noexcept = nullptr;
  /// For types that may measure a rotation vector, limited to half a turn: true if it does.
  bool (*ends_at_half_turn)(const Element& element) noexcept = nullptr;
  bool along_line = false;  ///< acts along the line between its ends, which is undefined if they
                            ///< coincide, unless it has a joint
  /// Its actuator may be a formula of its own measure (local_formula.hpp).
  bool local_actuator = false;
  bool bears = false;    ///< `is_bearing`
  bool on_line = false;  ///< its second marker slides along z of the first, a straight line
  bool contact = false;  ///< with a restitution at the speed of a touch, which is its first kept
                         ///< number, and the key `least_speed`
  bool profile_only = false;  ///< of roads it feels the profile alone: none with width
  bool rolls = false;         ///< at rest it may roll a vehicle that nothing holds
  /// `lifted_by`: the last signal, which belongs to no key, lifts it.
  const char* lifted = nullptr;
  /// Why its force is not a number there; for messages.
  std::string (*complaint)(const Ports& in) = nullptr;
  /// Its law over dual numbers; null: it has none.
  void (*dual)(const DualPorts& in, EffortsOf<Dual>& out) noexcept = nullptr;
  /// For laws with branches. Called between steps.
  BranchSide (*side)(const Ports& in) noexcept = nullptr;
  /// The branch on which an equilibrium is looked for first; `free_branch`: on any.
  std::int64_t resting_branch = free_branch;
  Picture (*picture)(const Element& element) = nullptr;
  std::vector<Stroke> (*strokes)(const Model& model, const Element& element) = nullptr;
  /// What is odd about its start, for notes of statics and checks.
  void (*note)(const Element& element, const SystemMotion& start,
               std::vector<std::string>& notes) = nullptr;
  /// What linear systems put in the place of its law, one sentence without its full stop; empty:
  /// nothing else.
  std::string (*linear_note)(const Element& element) = nullptr;
  std::span<const ElementRegime> regimes;
};

const ElementKind& element_kind(ElementType type) noexcept;

/// A random element and motion in one of the regimes, away from the kinks of its laws.
ElementExample element_example(ElementType type, std::size_t regime, ExampleNumbers& numbers);
/// They stand beside the kinds, not in them: the linker leaves out of FMUs what none of them calls.
using ExampleMaker = ElementExample (*)(std::size_t regime, ExampleNumbers&);

#define FLOATFRAME_KIND(name, Keys)        \
  extern const ElementKind name##_element; \
  extern const ExampleMaker name##_examples;
FLOATFRAME_ELEMENTS(FLOATFRAME_KIND)
#undef FLOATFRAME_KIND

/// Stops of an element with a length.
inline constexpr ElementKey bump_stop_key = {
    .name = "bump_stop", .kind = KeyKind::bump_stop, .about = "below a length", .of = "spring"};
inline constexpr ElementKey rebound_stop_key = {.name = "rebound_stop",
                                                .kind = KeyKind::rebound_stop,
                                                .about = "above a length",
                                                .of = "spring"};

/// For an element of two frames with the axes e₁, e₂, e₃: `axis` is e₃.
constexpr ElementKey axis_2_key(KeyMember member) {
  return {.name = "axis_2",
          .kind = KeyKind::direction,
          .about = "the first axis, e₁, without its part along `axis`; e₂ = e₃ x e₁",
          .vector = {1.0, 0.0, 0.0},
          .member = member};
}
/// Its design axes.
Mat3 element_axes(const ElementView& values);
/// Its points are on two bodies, its axes differ, and it has a law.
void validate_framed(const ElementCheck& check);
/// Its joint has one coordinate.
void validate_coordinate(const ElementCheck& check);
/// A joint, and which of its coordinates.
constexpr ElementKey joint_key(KeyMember member) {
  return {.name = "joint",
          .kind = KeyKind::joint,
          .about = "one with a coordinate q",
          .required = true,
          .member = member};
}
constexpr ElementKey coordinate_key(KeyMember member) {
  return {.name = "coordinate",
          .kind = KeyKind::own_coordinate,
          .about = "which one, if the joint has several",
          .member = member};
}
/// The keys of an applied load, whose struct is L: a force along, or a torque about the direction.
template <class L>
constexpr std::array<ElementKey, 4> load_keys(ElementAxis axis) {
  return {{{.name = "body",
            .kind = KeyKind::own_place,
            .about = "where it acts",
            .required = true,
            .member = member<L, &AppliedLoad::at>},
           {.name = "direction",
            .kind = KeyKind::vector,
            .about = "used as given, not normalised",
            .required = true,
            .vector = {1.0, 0.0, 0.0},
            .axial = axis == ElementAxis::about,
            .member = member<L, &AppliedLoad::direction>},
           {.name = "magnitude",
            .kind = KeyKind::load,
            .about = "times the direction",
            .required = true,
            .axis = axis,
            .member = member<L, &AppliedLoad::magnitude>},
           {.name = "follows",
            .kind = KeyKind::flag,
            .about = "the direction turns with the body",
            .member = member<L, &AppliedLoad::follows>}}};
}
/// The load on its only marker: along an axis of the world or one that turns with the body.
template <class S>
Eigen::Matrix<S, 3, 1> load_of(const PortsOf<S>& in, const AppliedLoad& load) noexcept {
  const Eigen::Matrix<S, 3, 1> along = in.signal(0).f * load.direction.template cast<S>();
  if (!load.follows) return along;
  return in.marker(0).R * along;
}
Picture picture_of_load(const Element& element, Picture::Symbol symbol, const AppliedLoad& load);

/// A law at x on the held branch: the segment of the spring and that of the damper.
struct SpringBranch {
  std::int64_t held;
  static constexpr std::int64_t most = std::int64_t{1} << 31;  ///< stretches of a law
  static std::int64_t of(std::size_t spring, std::size_t damper) noexcept {
    return static_cast<std::int64_t>(spring) * most + static_cast<std::int64_t>(damper);
  }
  std::size_t spring() const noexcept { return static_cast<std::size_t>(held / most); }
  std::size_t damper() const noexcept { return static_cast<std::size_t>(held % most); }
};
/// Value and slope of a law.
template <class S>
struct LawValue {
  S f;
  double df;
};
template <class S>
LawValue<S> law_of(const PiecewisePolynomial& law, const S& x) noexcept {
  const PiecewisePolynomial::Value y = law(value_of(x));
  return {chained(y.f, y.df, x), y.df};
}
template <class S>
LawValue<S> law_of(const PiecewisePolynomial& law, std::size_t segment, const S& x) noexcept {
  const PiecewisePolynomial::Value y = law.stretch_value(segment, value_of(x));
  return {chained(y.f, y.df, x), y.df};
}
/// The law 0 of an element, of a spring, and the law 1, of a damper, on the held branch.
template <class S>
LawValue<S> spring_of(const PortsOf<S>& in, const S& x) noexcept {
  if (in.branch == free_branch || in.element.switched) return law_of(in.element.laws[0], x);
  return law_of(in.element.laws[0], SpringBranch{in.branch}.spring(), x);
}
template <class S>
LawValue<S> damper_of(const PortsOf<S>& in, const S& rate) noexcept {
  if (in.branch == free_branch || in.element.switched) return law_of(in.element.laws[1], rate);
  return law_of(in.element.laws[1], SpringBranch{in.branch}.damper(), rate);
}
template <class S>
S energy_of(const PiecewisePolynomial& law, const S& x) noexcept {
  return chained(law_energy(law, value_of(x)), law(value_of(x)).f, x);
}
/// The side of an element with a spring and a damper, at their arguments.
BranchSide spring_side(const Ports& in, double x, double rate) noexcept;

/// Distance of x beyond the nearer edge of segment k, and the segment beyond that edge.
struct StretchSide {
  double beyond;
  std::size_t next;
};
StretchSide stretch_side(const PiecewisePolynomial& f, std::size_t k, double x) noexcept;

/// An applied load.
template <class L>
ElementExample example_load(bool follows, ExampleNumbers& numbers) {
  ElementExample x;
  L load;
  load.direction = numbers.vector(2.0);
  load.follows = follows;
  load.magnitude = x.linked_signal(numbers);
  x.t = numbers(0.0, 1.0);
  x.keys(load);
  x.markers = {numbers.marker()};
  return x;
}
/// Smooth and curved laws for the examples: spring of a length in [0, 4] m, damper of a rate.
PiecewisePolynomial example_spring(ExampleNumbers& numbers);
PiecewisePolynomial example_damper(ExampleNumbers& numbers);

}  // namespace floatframe
