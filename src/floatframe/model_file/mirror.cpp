#include "floatframe/model_file/mirror.hpp"

#include "floatframe/body/body_shape.hpp"
#include "floatframe/body/mirrored.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {

namespace {

TimeFunction negative(const TimeFunction& f) {
  std::vector<PiecewisePolynomial::Piece> pieces = f.pieces.pieces();
  for (PiecewisePolynomial::Piece& piece : pieces)
    for (double& c : piece.coefficients) c = -c;
  TimeFunction out = f;
  out.pieces = PiecewisePolynomial(f.pieces.breaks(), std::move(pieces));
  for (SineTerm& s : out.sines) s.amplitude = -s.amplitude;
  if (!f.formula) return out;
  auto formula = std::make_shared<Formula>(*f.formula);
  formula->text = "-(" + formula->text + ")";
  formula->steps.push_back({.op = FormulaOp::negative});
  formula->sources.push_back(formula->text);
  out.formula = std::move(formula);
  return out;
}

}  // namespace

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
  for (CoordinateMotion& m : j.motions)
    if (mirrored_sign(j.type, m.coordinate, x) < 0.0) m.motion = negative(m.motion);
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
