#pragma once
// What the constraints of a point or a direction along or about an axis share: their keys, their
// markers with z along the axis, and their picture. Load time only.
#include "floatframe/description/sentences.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/model_builder.hpp"

namespace floatframe {

template <class C>
constexpr ElementKey constraint_from_key(const char* about) {
  return place_key("from", about, member<C, &AxisConstraint::a>);
}
template <class C>
constexpr ElementKey constraint_to_key(const char* about) {
  return place_key("to", about, member<C, &AxisConstraint::b>);
}
template <class C>
constexpr ElementKey constraint_axis_key(const char* about) {
  return {.name = "axis",
          .kind = KeyKind::direction,
          .about = about,
          .required = true,
          .member = member<C, &AxisConstraint::axis>};
}
constexpr ElementKey constraint_axis_2_key(const char* about, KeyMember of) {
  return {
      .name = "axis_2", .kind = KeyKind::direction, .about = about, .required = true, .member = of};
}

inline void validate_constraint(const ElementCheck& check) { check.two_bodies("from", "to"); }

/// Connects the two markers, z along these directions of the design configuration.
inline bool build_constraint(ElementBuild& build, const Mat3& R_a, const Mat3& R_b,
                             bool oriented_b) {
  const bool from = build.connect("from", true, R_a), to = build.connect("to", oriented_b, R_b);
  return from && to;
}
inline Mat3 constraint_axes(const ElementBuild& build, const char* key) {
  return frame_with_z(unit_vector(build.direction(key)));
}

/// The parts of a constraint between its markers, one after the other.
class ConstraintParts {
 public:
  ConstraintParts(const Model& model, const Element& element, const ConstraintPart& part,
                  std::vector<ConstraintPart>& parts)
      : base_(part), length_(1.0), parts_(parts) {
    base_.a = element.markers[0];
    base_.b = element.markers[1];
    for (const int marker : {base_.a, base_.b})  // of b, unless it is the ground
      if (const int body = model.markers[marker].body; body >= 0)
        length_ = model.bodies[body].length;
  }
  ConstraintPart& add(ConstraintType type) {
    parts_.push_back(base_);
    parts_.back().type = type;
    return parts_.back();
  }
  /// Of directions: the row is scaled to lengths, and its force is a torque.
  ConstraintPart& add_directions(ConstraintType type, const Vec3& e_a, const Vec3& n_b) {
    ConstraintPart& p = add(type);
    p.e_a = e_a;
    p.n_b = n_b;
    p.scale = p.force = length_;
    return p;
  }

 private:
  ConstraintPart base_;
  double length_;
  std::vector<ConstraintPart>& parts_;
};

inline Picture picture_of_constraint(const Element& element) {
  return {.symbol = Picture::Symbol::ring, .a = element.markers[0], .b = element.markers[1]};
}

inline constexpr ElementRegime constraint_regimes[] = {{.name = "anywhere", .acts = false}};

template <class C>
ElementExample constraint_example(ExampleNumbers& numbers) {
  ElementExample x;
  C keys;
  keys.axis = numbers.direction();
  x.keys(keys);
  x.markers = {numbers.marker(), numbers.marker()};
  return x;
}

}  // namespace floatframe
