#include "floatframe/model/curve_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "floatframe/math/so3.hpp"

namespace floatframe {

namespace {

constexpr double whole_turn = 2.0 * std::numbers::pi;
constexpr int contact_entries = 2048;

double angle_of(const Vec3& v, const Vec3& e1, const Vec3& e2) noexcept {
  return std::atan2(v.dot(e2), v.dot(e1));
}

}  // namespace

CurvatureRange curvatures(const SpaceCurve& curve, const Vec3& k) {
  CurvatureRange range{std::numeric_limits<double>::infinity(),
                       -std::numeric_limits<double>::infinity()};
  for (const double u : curve.parameters()) {
    const SpaceCurve::Value v = curve.at(u);
    const double kappa = k.dot(v.dc.cross(v.ddc)) / std::pow(v.dc.norm(), 3);
    range.low = std::min(range.low, kappa);
    range.high = std::max(range.high, kappa);
  }
  return range;
}

CurveContact::CurveContact(const SpaceCurve& one, const SpaceCurve& two, const Vec3& k, bool same)
    : swapped_(!curvatures(two, k).one_sign()),
      a_(swapped_ ? two : one),
      b_(swapped_ ? one : two),
      k_(k),
      sense_(same ? 1.0 : -1.0) {
  orthonormal_complement(k_, e1_, e2_);
  for (const double u : a_.parameters()) {
    const SpaceCurve::Value v = a_.at(u);
    points_.push_back(v.c);
    tangents_.push_back(v.dc.normalized());
    angles_.push_back(angle_of(v.dc, e1_, e2_));
  }
  // The angle of the tangent of b over w: monotonous.
  std::vector<double> turned;
  const std::vector<double>& w = b_.parameters();
  for (const double x : w) {
    const double angle = angle_of(b_.at(x).dc, e1_, e2_);
    turned.push_back(
        turned.empty() ? angle : turned.back() + std::remainder(angle - turned.back(), whole_turn));
  }
  const bool rises = turned.back() > turned.front();
  first_angle_ = std::min(turned.front(), turned.back());
  last_angle_ = std::max(turned.front(), turned.back());
  whole_ = last_angle_ - first_angle_ > whole_turn - 1e-6;
  std::size_t at = 0;
  for (int j = 0; j <= contact_entries; ++j) {
    const double part = static_cast<double>(j) / contact_entries;
    const double reach = rises ? part : 1.0 - part;
    const double angle = first_angle_ + (last_angle_ - first_angle_) * reach;
    while (at + 2 < w.size() && (rises ? turned[at + 1] < angle : turned[at + 1] > angle)) ++at;
    const double step = turned[at + 1] - turned[at];
    const double x = step != 0.0 ? std::clamp((angle - turned[at]) / step, 0.0, 1.0) : 0.0;
    w_.push_back(w[at] + x * (w[at + 1] - w[at]));
    q_.push_back(b_.at(w_.back()).c);
  }
  if (!rises) {
    std::reverse(w_.begin(), w_.end());
    std::reverse(q_.begin(), q_.end());
  }
}

int CurveContact::entry(double angle) const noexcept {
  double x = std::fmod(angle - first_angle_, whole_turn);
  if (x < 0.0) x += whole_turn;
  const double span = last_angle_ - first_angle_;
  if (x > span && !whole_) return -1;
  return std::clamp(static_cast<int>(x / span * contact_entries + 0.5), 0, contact_entries);
}

CurveContact::Start CurveContact::begin(const Mat3& R, const Vec3& d) const noexcept {
  const double turned = angle_of(R * e1_, e1_, e2_) + (sense_ < 0.0 ? std::numbers::pi : 0.0);
  Start best;
  best.size = std::numeric_limits<double>::infinity();
  double before = 0.0;
  int last = -1;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const int j = entry(angles_[i] - turned);
    const bool follows = last >= 0;
    last = j;
    if (j < 0) continue;
    const Vec3 D = d + R * q_[j] - points_[i];
    const double along = tangents_[i].dot(D), off = std::abs(k_.cross(tangents_[i]).dot(D));
    const bool crosses = follows && (along > 0.0) != (before > 0.0);
    before = along;
    // Where nothing crosses, beyond the ends of a curve, the pair that is nearest to it.
    const double size = crosses ? off : std::abs(along) + off;
    if (crosses < best.crosses || (crosses == best.crosses && size >= best.size)) continue;
    best = {a_.parameters()[i], w_[j], size, crosses};
  }
  if (!std::isfinite(best.size)) best = {a_.parameters().front(), w_.front(), 0.0, false};
  return best;
}

CurveContact::Point CurveContact::at(const Mat3& R, const Vec3& d) const noexcept {
  Start x = begin(R, d);
  const std::vector<double>&u = a_.parameters(), &w = b_.parameters();
  const double most_u = 8.0 * (u[1] - u[0]), most_w = 8.0 * (w[1] - w[0]);
  SpaceCurve::Value p = a_.at(x.u), q = b_.at(x.w);
  constexpr int most_steps = 40;
  for (int step = 0; step < most_steps; ++step) {
    // (1) times |p'|: G_1 = p'.D, G_2 = (k x p').R q'
    const Vec3 D = d + R * q.c - p.c, n = k_.cross(p.dc), dq = R * q.dc;
    const double g1 = p.dc.dot(D), g2 = n.dot(dq);
    const double a11 = p.ddc.dot(D) - p.dc.squaredNorm(), a12 = p.dc.dot(dq),
                 a21 = k_.cross(p.ddc).dot(dq), a22 = n.dot(R * q.ddc);
    const double det = a11 * a22 - a12 * a21;
    if (!(std::abs(det) > 0.0)) break;
    const double du = std::clamp(-(a22 * g1 - a12 * g2) / det, -most_u, most_u),
                 dw = std::clamp(-(a11 * g2 - a21 * g1) / det, -most_w, most_w);
    x.u += du;
    x.w += dw;
    p = a_.at(x.u);
    q = b_.at(x.w);
    if (!(std::abs(du) > 1e-15 * (std::abs(x.u) + most_u) ||
          std::abs(dw) > 1e-15 * (std::abs(x.w) + most_w)))
      break;
  }
  Point c;
  c.speed = p.dc.norm();
  c.t = p.dc / c.speed;
  c.n = k_.cross(c.t);
  c.q = R * q.c;
  c.dq = R * q.dc;
  c.phi = c.n.dot(d + c.q - p.c);
  c.turn = c.n.dot(p.ddc) / c.speed;
  c.along = c.t.dot(c.dq);
  c.bend = c.n.dot(R * q.ddc);
  return c;
}

}  // namespace floatframe
