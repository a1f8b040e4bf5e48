#include "floatframe/model/curve_checks.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace floatframe {
namespace {

double extent_of(const std::vector<Vec3>& points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(p);
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

double tangent_turn(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Halves the interval towards the larger turn of the tangent; 0 if nothing is left of it.
double corner_between(const SpaceCurve& curve, double a, double b, double& at) {
  constexpr double least = 1e-6;
  Vec3 before = curve.at(a).dc, after = curve.at(b).dc;
  for (;;) {
    if (!(tangent_turn(before, after) > least)) return 0.0;
    const double middle = a + 0.5 * (b - a);
    if (!(middle > a && middle < b)) break;
    const Vec3 between = curve.at(middle).dc;
    if (!between.allFinite()) return 0.0;
    const bool left = tangent_turn(before, between) > tangent_turn(between, after);
    (left ? b : a) = middle;
    (left ? after : before) = between;
  }
  at = b;
  return tangent_turn(before, after);
}

/// The distance of two straight lines from a to b and from c to d.
double distance_of_chords(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 p = b - a, q = d - c, r = a - c;
  const double pp = p.squaredNorm(), qq = q.squaredNorm(), pq = p.dot(q);
  if (!(pp > 0.0 && qq > 0.0)) return r.norm();
  const double pr = p.dot(r), qr = q.dot(r), across = pp * qq - pq * pq;
  double s = across > 1e-12 * pp * qq ? std::clamp((pq * qr - qq * pr) / across, 0.0, 1.0) : 0.0;
  const double t = std::clamp((pq * s + qr) / qq, 0.0, 1.0);
  s = std::clamp((pq * t - pr) / pp, 0.0, 1.0);
  return (r + s * p - t * q).norm();
}

/// The parameters next to these at which both places are nearest, by Gauss and Newton; true if they
/// are the same place.
bool meets(const SpaceCurve& curve, double step, double same, CurveCrossing& x) {
  constexpr int passes = 30;
  const CurveCrossing from = x;
  for (int pass = 0; pass < passes; ++pass) {
    const CurveValue p = curve.at(x.u), q = curve.at(x.w);
    const Vec3 r = p.c - q.c;
    if (r.norm() < same) return true;
    const double pp = p.dc.squaredNorm(), qq = q.dc.squaredNorm(), pq = p.dc.dot(q.dc);
    const double across = pp * qq - pq * pq + 1e-9 * pp * qq;  // tangents may be parallel
    if (!(across > 0.0)) return false;
    x.u = std::clamp(x.u - (qq * p.dc.dot(r) - pq * q.dc.dot(r)) / across, from.u - step,
                     from.u + step);
    x.w = std::clamp(x.w - (pq * p.dc.dot(r) - pp * q.dc.dot(r)) / across, from.w - step,
                     from.w + step);
  }
  return false;
}

/// A pole of the same sign on both sides: the place between a and b that is farthest from the
/// origin, by the golden section, if it is farther than any curve goes.
std::optional<CurveGap> pole_between(const SpaceCurve& curve, double a, double b) {
  constexpr double part = 0.6180339887498949, unbounded = 1e9;
  constexpr int passes = 80;
  const auto far = [&](double u) -> double {
    const double r = curve.at(u).c.norm();
    return std::isfinite(r) ? r : std::numeric_limits<double>::infinity();
  };
  double p = b - part * (b - a), q = a + part * (b - a), at_p = far(p), at_q = far(q);
  for (int pass = 0; pass < passes; ++pass) {
    if (at_p > unbounded || at_q > unbounded)
      return CurveGap{at_p > at_q ? p : q, std::numeric_limits<double>::infinity()};
    if (at_p > at_q) {
      b = q, q = p, at_q = at_p;
      p = b - part * (b - a), at_p = far(p);
    } else {
      a = p, p = q, at_p = at_q;
      q = a + part * (b - a), at_q = far(q);
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<CurveGap> curve_gap(const SpaceCurve& curve) {
  const std::vector<double>& u = curve.parameters();
  const double smallest = 1e-6 * (1.0 + extent_of(curve.samples()));
  // A closed curve begins again at its last sample.
  const double end = u.back() - (curve.closed() ? 1e-9 * (u.back() - u.front()) : 0.0);
  for (std::size_t k = 1; k < u.size(); ++k)
    if (const auto gap = gap_between(u[k - 1], std::min(u[k], end), smallest,
                                     [&](double x) { return curve.at(x); }))
      return gap;
  const std::vector<Vec3>& c = curve.samples();
  for (std::size_t k = 1; k + 1 < u.size(); ++k)
    if (c[k].norm() > c[k - 1].norm() && !(c[k].norm() < c[k + 1].norm()))
      if (const auto pole = pole_between(curve, u[k - 1], std::min(u[k + 1], end))) return pole;
  return std::nullopt;
}

CurveCorners curve_corners(const SpaceCurve& curve) {
  CurveCorners out;
  const auto count = [&](double angle, double at) {
    if (!(angle > 0.0)) return;
    ++out.count;
    if (angle > out.angle) out.angle = angle, out.at = at;
  };
  const std::vector<double>& u = curve.parameters();
  const double length = u.back() - u.front();
  const double end = u.back() - (curve.closed() ? 1e-9 * length : 0.0);
  for (std::size_t k = 1; k < u.size(); ++k) {
    double at = 0.0;
    const double angle = corner_between(curve, u[k - 1], std::min(u[k], end), at);
    count(angle, at);
  }
  if (!curve.closed()) return out;
  const double seam = tangent_turn(curve.at(end).dc, curve.at(u.front()).dc);
  count(seam > 1e-6 ? seam : 0.0, u.front());
  return out;
}

std::optional<CurveCrossing> curve_crossing(const SpaceCurve& curve) {
  constexpr std::size_t most_chords = 400;
  const std::vector<double>& all = curve.parameters();
  const std::size_t n = std::min(most_chords, all.size() - 1);
  std::vector<double> u;
  std::vector<Vec3> c;
  for (std::size_t k = 0; k <= n; ++k) {
    u.push_back(all[k * (all.size() - 1) / n]);
    c.push_back(curve.at(u.back()).c);
  }
  if (!curve.closed()) c.back() = curve.samples().back();
  std::vector<double> sag, chord;
  for (std::size_t k = 0; k < n; ++k) {
    chord.push_back((c[k + 1] - c[k]).norm());
    sag.push_back((curve.at(0.5 * (u[k] + u[k + 1])).c - 0.5 * (c[k] + c[k + 1])).norm());
  }
  const double same = 1e-7 * extent_of(c);
  // Neighbours are near to each other, and so are those of a chord that is bent.
  constexpr std::size_t apart = 4;
  for (std::size_t i = 0; i + apart < n; ++i)
    for (std::size_t j = i + apart; j < n; ++j) {
      if (curve.closed() && i + n < j + apart) continue;
      const double near = 1.5 * (sag[i] + sag[j]) + 1e-9;
      const double reach = near + chord[i] + chord[j];
      if ((c[i] - c[j]).squaredNorm() > reach * reach) continue;
      if (!(distance_of_chords(c[i], c[i + 1], c[j], c[j + 1]) < near)) continue;
      CurveCrossing x{0.5 * (u[i] + u[i + 1]), 0.5 * (u[j] + u[j + 1])};
      if (meets(curve, u[1] - u[0], same, x)) return x;
    }
  return std::nullopt;
}

}  // namespace floatframe
