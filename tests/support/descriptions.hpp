#pragma once
// Bodies, joints, rods and outputs of descriptions of models, each in one line.
#include <optional>
#include <string>
#include <utility>

#include "floatframe/description/description.hpp"

namespace floatframe::test {

inline AttachmentDescription place_on(const std::string& body, const Vec3& point = Vec3::Zero()) {
  return {body, point, std::nullopt, {}};
}

template <class Kind>
BodyDescription make_body(const std::string& name, Kind kind, const Vec3& at = Vec3::Zero()) {
  BodyDescription b;
  b.name = name;
  b.X_WB.p = b.X_WT.p = at;
  b.kind = std::move(kind);
  return b;
}

inline JointDescription make_joint(const std::string& name, JointType type,
                                   const std::string& parent, const std::string& child,
                                   const Vec3& at = Vec3::Zero(),
                                   const Vec3& axis = Vec3::UnitZ()) {
  JointDescription j;
  j.name = name;
  j.type = type;
  j.parent = place_on(parent, at);
  j.child = place_on(child, at);
  j.axis = axis;
  return j;
}

inline ElementDescription make_rod(const std::string& name, const AttachmentDescription& a,
                                   const AttachmentDescription& b,
                                   std::optional<double> length = {}) {
  return {name, Rod{a, b, length, {}}, {}};
}

/// Of a joint or a force.
inline OutputDescription make_output(const std::string& name, OutputType type,
                                     const std::string& entity, int component = 0) {
  OutputDescription o;
  o.name = name;
  o.type = type;
  o.entity = entity;
  o.component = component;
  return o;
}
inline OutputDescription make_output(const std::string& name, const AttachmentDescription& at,
                                     int component, OutputType type = OutputType::position) {
  OutputDescription o = make_output(name, type, "", component);
  o.at = at;
  return o;
}

}  // namespace floatframe::test
