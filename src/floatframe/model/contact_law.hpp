#pragma once
// Contact in one direction with an exact coefficient of restitution (Hunt and Crossley 1975), of a
// compression d and its rate ddot:
//   push = k d^n (1 + b ddot), never pulling; d^n odd in d where a branch is held beyond its edge
//   its slopes: n k d^(n-1) (1 + b ddot) over d, b k d^n over ddot; energy k d^(n+1) / (n + 1)
// b makes the restitution exact: of m d'' = -k d^n (1 + b d') from the speed v to -e v the
// integrals of u du / (1 + b u) are equal on the way in and out: with c = b v
//   c (1 + e) = ln((1 + c) / (1 - c e))                                                        (1)
// v is the speed of the touch: a kept number of the element, the speed at the end of the last step
// apart, which is the touch where edges are located.
#include <algorithm>
#include <cmath>

#include "floatframe/math/dual.hpp"
#include "floatframe/model/element_keys.hpp"

namespace floatframe {

/// c of (1); 0 for e = 1.
double damping_of_restitution(double e);

/// The spring of a contact, and how it is damped.
struct ContactSpring {
  double stiffness = 0.0;    ///< k [N/m^n] or [N m/rad^n]
  double exponent = 1.0;     ///< n >= 1
  double damping = 0.0;      ///< c of (1)
  double least_speed = 0.0;  ///< slower touches are damped as one at this speed
};

template <class S>
struct ContactForce {
  S push = 0.0, energy = 0.0, energy_rate = 0.0;
  double slope = 0.0, damping = 0.0;  ///< of the push over d and over ddot
  bool pushes = false;
};

/// In touch; `speed`: that of the touch.
template <class S>
ContactForce<S> contact_force(const ContactSpring& spring, double speed, const S& d,
                              const S& d_dot) noexcept {
  using std::abs;
  using std::pow;
  ContactForce<S> out;
  if (value_of(d) == 0.0) return out;
  const double b = spring.damping / std::max(speed, spring.least_speed), n = spring.exponent;
  const S size = abs(d), slope = spring.stiffness * pow(size, n - 1.0), elastic = slope * d,
          factor = 1.0 + b * d_dot;
  out.energy = elastic * d / (n + 1.0);
  out.energy_rate = elastic * d_dot;
  out.pushes = value_of(factor) > 0.0;
  if (!out.pushes) return out;
  out.push = elastic * factor;
  out.slope = value_of(n * slope * factor);
  out.damping = value_of(elastic * b);
  return out;
}

/// The keys of a contact, whose members stand in its struct K.
template <class K>
struct ContactKeys {
  static constexpr NumberRule restitutions = {"a number above 0 and up to 1", "", 0.0, 1.0, true};
  static constexpr ElementKey number(const char* name, const char* about, NumberRule rule,
                                     KeyMember member, double fallback = 0.0) {
    return {.name = name,
            .kind = KeyKind::number,
            .about = about,
            .required = fallback == 0.0,
            .rule = rule,
            .fallback = fallback,
            .member = member};
  }
  static constexpr ElementKey stiffness(const char* unit) {
    return number("stiffness", "force per compression to the power of `exponent`",
                  positive_number(unit), described_by<&K::stiffness>);
  }
  static constexpr ElementKey exponent =
      number("exponent", "of the compression; 1.5: Hertz", {"a number >= 1", "", 1.0},
             described_by<&K::exponent>, 1.0);
  static constexpr ElementKey restitution = number(
      "restitution", "of a touch: the speed apart over the speed together, if nothing else acts",
      restitutions, described_by<&K::restitution>, 1.0);
  static constexpr ElementKey least_speed(const char* unit) {
    return number("least_speed", "slower touches are damped as one at this speed",
                  positive_number(unit), described_by<&K::least_speed>, 0.01);
  }
};

/// From the struct of an element with these keys.
template <class K>
ContactSpring contact_spring(const K& keys) {
  return {keys.stiffness, keys.exponent, damping_of_restitution(keys.restitution),
          keys.least_speed};
}

}  // namespace floatframe
