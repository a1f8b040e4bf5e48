#pragma once
// The keys of a force element: their names in model files, and their members in a description.
// Reader, validation, mirror and the table of the documentation use these tables. Load time
// only.
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/description/description.hpp"

namespace floatframe {

enum class KeyKind {
  place,             ///< {body, at} or {body, node}, also on the ground
  own_place,         ///< `body`, and `at` or `node`, among the keys of the force; not on the ground
  joint,             ///< the name of one
  own_coordinate,    ///< the name of one of the joint that the key `joint` names, from 0; -1: none
  road,              ///< the name of one
  direction,         ///< its length does not matter
  vector,            ///< the same, but used as given
  number,            ///< valid range as in `rule`
  word,              ///< one of `words`
  flag,              ///< true or false
  spring,            ///< law of a displacement
  damper,            ///< law of a rate
  bump_stop,         ///< {length, stiffness}: a ramp below, added to the law `of` ...
  rebound_stop,      ///< ... or above
  load,              ///< signal, a force
  target,            ///< signal, a displacement; its tables are smooth
  target_rate,       ///< signal, a rate
  signals,           ///< a list of signals, bare numbers
  motion,            ///< function of time, a displacement; without jumps
  terms,             ///< coordinates of joints with factors
  coordinate,        ///< of a joint: a displacement, an angle or either, as in `axis`
  stiffness_matrix,  ///< 6 x 6: three displacements and three rotations; or 2 x 2
  damping_matrix,    ///< the same of their rates
  function,          ///< of a program or by a formula, a force
  formula,           ///< of what it refers to
  speed_table,       ///< rows of a speed and eight coefficients of a plane (bearing_table.hpp)
  table,             ///< rows of numbers, named by `words`, each valid as in `rule`
  matrix,            ///< of any size; a list of numbers is a row
  points,            ///< rows of numbers, named by `words`, or a CSV file of them; may be absent
  shape,             ///< a formula of one variable, the only one of `words`
  numbers,           ///< a row, one of each of `words`, valid as in `rule`
  names,             ///< a list of names
  linear_file,       ///< its matrices and names are those of other keys (linear_file.hpp)
  file               ///< its path; the kind reads it when it builds, and keeps its content hash
};

/// The quantity that laws and signals refer to: a displacement, a rotation, or the coordinate of
/// the joint given by the key `joint`, or the first one of `terms`; none: a bare number.
enum class ElementAxis { along, about, coordinate, none };

struct AxisUnits {
  const char *displacement, *rate, *force, *stiffness, *damping;
};
constexpr AxisUnits axis_units(bool turning) noexcept {
  return turning ? AxisUnits{"rad", "rad/s", "N m", "N m/rad", "N m s/rad"}
                 : AxisUnits{"m", "m/s", "N", "N/m", "N s/m"};
}

/// A value of a key: number, word by its place in the list of words, flag, name, direction, place,
/// law, signal, matrix, function of time, terms, function of a program, formula, signals, names,
/// coordinate.
using KeyValue =
    std::variant<double, int, bool, std::string, Vec3, AttachmentDescription, PiecewisePolynomial,
                 SignalDescription, MatX, TimeFunction, std::vector<CoordinateTerm>, ForceFunction,
                 SharedFormula, std::vector<SignalDescription>, std::vector<std::string>,
                 CoordinateTerm>;

/// A member of the struct of a type; none: a stop, which is part of its spring, or a file.
struct KeyMember {
  std::optional<KeyValue> (*read)(const ElementDescription&) = nullptr;
  void (*write)(ElementDescription&, const KeyValue&) = nullptr;
  /// Where it lies in the description, for tests that no member of a struct is without a key.
  std::span<const std::byte> (*bytes)(const ElementDescription&) = nullptr;
};

/// The content of a file: the member that keeps it, empty: it is read when the element is built.
struct FileContent {
  KeyMember member;
  std::string (*read)(const std::string& path);
};

struct ElementKey {
  const char* name;
  KeyKind kind;
  const char* about;  ///< the documentation: a phrase in Markdown, without units
  bool required = false;
  ElementAxis axis = ElementAxis::along;
  NumberRule rule = any_number("");
  std::span<const char* const> words = {};
  double fallback = 0.0;                           ///< number, or index of the word, without the
                                                   ///< key; NaN: none
  std::array<double, 3> vector = {0.0, 0.0, 1.0};  ///< direction without the key
  bool axial = false;                              ///< how a direction reflects
  const char* of = nullptr;                        ///< of a stop: the key of the spring
  KeyMember member = {};
  const FileContent* content = nullptr;  ///< of a file
};

namespace key_member {
template <class T>
struct Optional : std::false_type {};
template <class T>
struct Optional<std::optional<T>> : std::true_type {};

// One function per type of a value, none per member: at load time size matters, not speed.
template <class T>
[[gnu::noinline]] std::optional<KeyValue> given(const T& x) {
  return KeyValue(x);
}
template <class T>
[[gnu::noinline]] void assign(T& x, const KeyValue& value) {
  x = std::get<T>(value);
}
template <class T>
[[gnu::noinline]] void assign(std::optional<T>& x, const KeyValue& value) {
  x = std::get<T>(value);
}

template <class S, auto member>
std::optional<KeyValue> read(const ElementDescription& f) {
  const auto& x = std::get<S>(f.kind).*member;
  using T = std::remove_cvref_t<decltype(x)>;
  if constexpr (Optional<T>::value)
    return x ? given(*x) : std::nullopt;
  else if constexpr (std::is_enum_v<T>)
    return given(static_cast<int>(x));
  else
    return given(x);
}
template <class S, auto member>
void write(ElementDescription& f, const KeyValue& value) {
  auto& x = std::get<S>(f.kind).*member;
  using T = std::remove_cvref_t<decltype(x)>;
  if constexpr (std::is_enum_v<T>)
    x = static_cast<T>(std::get<int>(value));
  else
    assign(x, value);
}
template <class S, auto member>
std::span<const std::byte> bytes(const ElementDescription& f) {
  return std::as_bytes(std::span(&(std::get<S>(f.kind).*member), 1));
}
template <class S, class T>
S owner(T S::*);
}  // namespace key_member

/// `.member = member<Tyre, &Tyre::radius>`, or `described_by<&Tyre::radius>`
template <class S, auto m>
inline constexpr KeyMember member = {key_member::read<S, m>, key_member::write<S, m>,
                                     key_member::bytes<S, m>};
template <auto m>
inline constexpr KeyMember described_by = member<decltype(key_member::owner(m)), m>;

/// The `fallback` of a number that may be absent.
inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// A required point on a body.
constexpr ElementKey place_key(const char* name, const char* about, KeyMember member = {}) {
  return {.name = name, .kind = KeyKind::place, .about = about, .required = true, .member = member};
}
/// A law, a stop or a signal.
constexpr ElementKey law_key(const char* name, KeyKind kind, const char* about,
                             KeyMember member = {}, ElementAxis axis = ElementAxis::along) {
  return {.name = name, .kind = kind, .about = about, .axis = axis, .member = member};
}

/// The keys of a type.
std::span<const ElementKey> element_keys(ElementType type) noexcept;
/// The value of a key; none: not given.
std::optional<KeyValue> key_value(const ElementDescription& force, const ElementKey& key);
void set_key_value(ElementDescription& force, const ElementKey& key, const KeyValue& value);

/// The values of a description by key; missing values are the defaults.
class ElementView {
 public:
  explicit ElementView(const ElementDescription& force) : force_(&force) {}
  const ElementDescription& description() const { return *force_; }
  const ElementKey& key(const std::string& name) const;
  bool has(const std::string& name) const { return key_value(*force_, key(name)).has_value(); }

  AttachmentDescription place(const std::string& name) const;
  std::string text(const std::string& name) const;
  Vec3 direction(const std::string& name) const;
  double number(const std::string& name) const;
  int word(const std::string& name) const;
  bool flag(const std::string& name) const;
  PiecewisePolynomial law(const std::string& name) const;
  std::optional<SignalDescription> signal(const std::string& name) const;
  MatX matrix(const std::string& name) const;  ///< 0 x 0: not given
  CoordinateTerm coordinate(const std::string& name) const;
  /// The coordinates of joints that its keys name.
  std::vector<CoordinateTerm> coordinates() const;

 private:
  const ElementDescription* force_;
};

/// Checks of the values of a force in combination: called by the reader, with the words of its
/// file, and by `validate`. Each value is valid by itself, or listed in `wrong`.
struct ElementCheck : ElementView {
  using ElementView::ElementView;
  std::set<std::string> wrong;  ///< keys
  bool from_file = false;       ///< places that name a node have its point
  /// Adds a sentence about a key, or with "" about the force.
  std::function<void(ErrorCode code, const std::string& key, const std::string& sentence)> error;
  /// The full name of an entity as written by the user.
  std::function<std::string(const std::string&)> written;
  /// For a valid joint.
  std::function<std::optional<JointType>(const std::string&)> joint_type;

  /// The value is given and valid.
  bool good(const std::string& key) const { return !wrong.contains(key) && has(key); }
  /// The user has given a value; for a law or matrix in a struct: other than zero.
  bool given(const std::string& key) const;
  /// The points are on two bodies; true if so and both are valid.
  bool two_bodies(const std::string& a, const std::string& b) const;
  /// At least one of the laws, stops and actuators is given.
  void some_law() const;
};

}  // namespace floatframe
