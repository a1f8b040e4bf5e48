#pragma once
// The keys of a force element: their names in model files, and their members in a description.
// Reader, validation, mirror and the table of the documentation use these tables. Load time
// only.
#include <array>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/model/description.hpp"

namespace floatframe {

enum class ForceKeyKind {
  place,             ///< {body, at} or {body, node}, also on the ground
  own_place,         ///< `body`, and `at` or `node`, among the keys of the force; not on the ground
  joint,             ///< the name of one
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
  stiffness_matrix,  ///< 6 x 6: three displacements and three rotations; or 2 x 2
  damping_matrix,    ///< the same of their rates
  speed_table        ///< rows of a speed and eight coefficients of a plane (bearing_table.hpp)
};

/// The quantity that laws and signals refer to: a displacement, a rotation, or the coordinate of
/// the joint given by the key `joint`.
enum class ForceAxis { along, about, coordinate };

struct ForceAxisUnits {
  const char *displacement, *rate, *force, *stiffness, *damping;
};
constexpr ForceAxisUnits force_axis_units(bool turning) noexcept {
  return turning ? ForceAxisUnits{"rad", "rad/s", "N m", "N m/rad", "N m s/rad"}
                 : ForceAxisUnits{"m", "m/s", "N", "N/m", "N s/m"};
}

/// A member of a description struct; none: the value is stored in ForceValues only.
struct ForceMember {
  std::optional<ForceValue> (*read)(const ForceDescription&) = nullptr;
  void (*write)(ForceDescription&, const ForceValue&) = nullptr;
};

struct ForceKey {
  const char* name;
  ForceKeyKind kind;
  const char* about;  ///< the documentation: a phrase in Markdown, without units
  bool required = false;
  ForceAxis axis = ForceAxis::along;
  NumberRule rule = any_number("");
  std::span<const char* const> words = {};
  double fallback = 0.0;                           ///< number or index of the word without the key
  std::array<double, 3> vector = {0.0, 0.0, 1.0};  ///< direction without the key
  bool axial = false;                              ///< how a direction reflects
  const char* of = nullptr;                        ///< of a stop: the key of the spring
  ForceMember member = {};
};

namespace force_member {
template <class T>
struct Optional : std::false_type {};
template <class T>
struct Optional<std::optional<T>> : std::true_type {};

template <auto member, class S, class T>
constexpr ForceMember access(T S::*) {
  return {[](const ForceDescription& f) -> std::optional<ForceValue> {
            const T& x = std::get<S>(f.kind).*member;
            if constexpr (Optional<T>::value)
              return x ? std::optional(ForceValue(*x)) : std::nullopt;
            else if constexpr (std::is_enum_v<T>)
              return ForceValue(static_cast<int>(x));
            else
              return ForceValue(x);
          },
          [](ForceDescription& f, const ForceValue& value) {
            T& x = std::get<S>(f.kind).*member;
            if constexpr (Optional<T>::value)
              x = std::get<typename T::value_type>(value);
            else if constexpr (std::is_enum_v<T>)
              x = static_cast<T>(std::get<int>(value));
            else
              x = std::get<T>(value);
          }};
}
}  // namespace force_member

/// `.member = described_by<&SpringDamperDescription::spring>`
template <auto member>
inline constexpr ForceMember described_by = force_member::access<member>(member);

/// A required point on a body.
constexpr ForceKey place_key(const char* name, const char* about, ForceMember member = {}) {
  return {.name = name,
          .kind = ForceKeyKind::place,
          .about = about,
          .required = true,
          .member = member};
}
/// A law, a stop or a signal.
constexpr ForceKey law_key(const char* name, ForceKeyKind kind, const char* about,
                           ForceMember member = {}, ForceAxis axis = ForceAxis::along) {
  return {.name = name, .kind = kind, .about = about, .axis = axis, .member = member};
}

/// The keys of a type.
std::span<const ForceKey> force_keys(ForceType type) noexcept;
/// The value of a key, numbers as double and words by their index, if it is valid.
std::optional<ForceValue> force_value(const ForceDescription& force, const ForceKey& key);
void set_force_value(ForceDescription& force, const ForceKey& key, const ForceValue& value);

/// The values of a description by key; missing values are the defaults.
class ForceView {
 public:
  explicit ForceView(const ForceDescription& force) : force_(&force) {}
  const ForceDescription& description() const { return *force_; }
  const ForceKey& key(const std::string& name) const;
  bool has(const std::string& name) const { return force_value(*force_, key(name)).has_value(); }

  AttachmentDescription place(const std::string& name) const;
  std::string text(const std::string& name) const;
  Vec3 direction(const std::string& name) const;
  double number(const std::string& name) const;
  int word(const std::string& name) const;
  bool flag(const std::string& name) const;
  PiecewisePolynomial law(const std::string& name) const;
  std::optional<SignalDescription> signal(const std::string& name) const;
  MatX matrix(const std::string& name) const;  ///< 0 x 0: not given

 private:
  const ForceDescription* force_;
};

/// Checks of the values of a force in combination: called by the reader, with the words of its
/// file, and by `validate`. Each value is valid by itself, or listed in `wrong`.
struct ForceCheck : ForceView {
  using ForceView::ForceView;
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
