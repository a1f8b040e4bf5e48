#include "floatframe/model_file/mirror.hpp"

#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

void place(AttachmentDescription& a, const Placement& x) { a.point = x.point(a.point); }

void place(BodyDescription& b, const Placement& x) {
  b.X_WB = {x.point(b.X_WB.p), x.P * b.X_WB.R * x.P};
  if (auto* r = std::get_if<RigidDescription>(&b.kind)) {
    r->p_BC = x.P * r->p_BC;
    r->J_C = x.P * r->J_C * x.P;
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

void place(RodDescription& r, const Placement& x) {
  place(r.a, x);
  place(r.b, x);
}

void place(ForceDescription& f, const Placement& x) {
  if (auto* s = std::get_if<SpringDamperDescription>(&f.kind)) {
    place(s->a, x);
    place(s->b, x);
  } else if (auto* g = std::get_if<GuidedSpringDescription>(&f.kind)) {
    place(g->reference, x);
    place(g->tip, x);
    g->axis = x.polar(g->axis);
  } else if (auto* t = std::get_if<TyreDescription>(&f.kind)) {
    place(t->centre, x);
    t->axis = x.polar(t->axis);  // a line: its sense does not matter
  } else if (auto* l = std::get_if<AppliedLoadDescription>(&f.kind)) {
    place(l->at, x);
    l->direction = l->torque ? x.axial(l->direction) : x.polar(l->direction);
  }
}

void place(OutputDescription& o, const Placement& x) {
  place(o.at, x);
  place(o.to, x);
}

}  // namespace floatframe
