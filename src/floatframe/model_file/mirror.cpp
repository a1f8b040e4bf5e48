#include "floatframe/model_file/mirror.hpp"

#include "floatframe/body/body_shape.hpp"
#include "floatframe/body/mirrored.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

void place(AttachmentDescription& a, const Placement& x) { a.point = x.point(a.point); }

void place(BodyDescription& b, const Placement& x) {
  b.X_WB = {x.point(b.X_WB.p), x.P * b.X_WB.R * x.P};
  if (auto* r = std::get_if<RigidDescription>(&b.kind)) {
    r->p_BC = x.P * r->p_BC;
    r->J_C = x.P * r->J_C * x.P;
    if (r->shape && x.P != Mat3::Identity())
      r->shape = std::make_shared<const BodyShape>(mirrored(*r->shape, x.P));
    b.X_WT = b.X_WB;
  } else {
    b.mirror = x.P * b.mirror;
  }
}

void place(JointDescription& j, const Placement& x) {
  place(j.parent, x);
  place(j.child, x);
  joint_kind(j.type).mirror(j, x);
}

void place(ElementDescription& f, const Placement& x) {
  const ElementKind& kind = element_kind(f.type());
  for (const ElementKey& key : kind.keys) {
    auto value = key_value(f, key);
    if (!value) continue;
    if (auto* at = std::get_if<AttachmentDescription>(&*value))
      place(*at, x);
    else if (auto* v = std::get_if<Vec3>(&*value))
      *v = key.axial ? x.axial(*v) : x.polar(*v);
    else
      continue;
    set_key_value(f, key, *value);
  }
  if (kind.mirror) kind.mirror(f, x);
}

void place(OutputDescription& o, const Placement& x) {
  place(o.at, x);
  place(o.to, x);
  if (o.relative) place(*o.relative, x);
  if (o.axes) place(*o.axes, x);
  o.gauge.toward = x.P * o.gauge.toward;
  o.gauge.along = x.P * o.gauge.along;
  o.gauge.direction = x.P * o.gauge.direction;
}

}  // namespace floatframe
