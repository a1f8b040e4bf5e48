#include "floatframe/io/mirror.hpp"

namespace floatframe {
namespace {

void place_vector(std::vector<double>& v, std::size_t at, const Placement& x, bool axial) {
  if (v.size() < at + 3) return;
  const Vec3 a(v[at], v[at + 1], v[at + 2]);
  const Vec3 b = axial ? x.axial(a) : x.polar(a);
  for (std::size_t i = 0; i < 3; ++i) v[at + i] = b[static_cast<Eigen::Index>(i)];
}

}  // namespace

Placement operator*(const Placement& outer, const Placement& inner) {
  return {outer.P * inner.P, outer.P * inner.t + outer.t};
}

Placement reflection(int axis, double at) {
  Placement x;
  x.P(axis, axis) = -1.0;
  x.t[axis] = 2.0 * at;
  return x;
}

Placement translation(const Vec3& shift) { return {Mat3::Identity(), shift}; }

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
  switch (j.type) {
    case JointType::weld:
      break;
    case JointType::revolute:
      j.axis = x.axial(j.axis);
      break;
    case JointType::prismatic:
      j.axis = x.polar(j.axis);
      break;
    case JointType::cylindrical:
      j.axis = x.polar(j.axis);
      if (j.position.size() == 2) j.position[1] *= x.det();
      if (j.velocity.size() == 2) j.velocity[1] *= x.det();
      break;
    case JointType::universal:
      j.axis = x.axial(j.axis);
      j.axis_2 = x.axial(j.axis_2);
      break;
    case JointType::spherical:
      place_vector(j.position, 0, x, true);
      place_vector(j.velocity, 0, x, true);
      break;
    case JointType::free:
      for (auto* v : {&j.position, &j.velocity}) {
        place_vector(*v, 0, x, false);
        place_vector(*v, 3, x, true);
      }
      break;
  }
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

void place(OutputDescription& o, const Placement& x) { place(o.at, x); }

}  // namespace floatframe
