#include "floatframe/model/alignment.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/math/union_find.hpp"
#include "floatframe/model/joint_kind.hpp"

namespace floatframe {
namespace {

/// Rounding error of an exact relation [rad; relative to the size].
constexpr double exact = 1e-12;

/// Angle of two lines; the sign does not matter.
double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

Vec3 across(const Vec3& e, const Vec3& d) { return d - e * e.dot(d); }

/// Bodies joined by welds have one index; the ground is the last.
std::vector<int> rigid_groups(const Model& model) {
  const int ground = std::ssize(model.bodies);
  UnionFind welded(ground + 1);
  for (const Joint& j : model.joints)
    if (joint_velocities(j.type) == 0) welded.join(j.child, j.parent < 0 ? ground : j.parent);
  std::vector<int> roots;
  for (int i = 0; i <= ground; ++i) roots.push_back(welded.root(i));
  return roots;
}

/// The point closest to lines through `p` along `e`, or to points if `e` is zero.
Vec3 nearest_point(const std::vector<Vec3>& p, const std::vector<Vec3>& e) {
  Mat3 A = Mat3::Zero();
  Vec3 b = Vec3::Zero(), mean = Vec3::Zero();
  for (const Vec3& x : p) mean += x / p.size();
  for (std::size_t k = 0; k < p.size(); ++k) {
    const Mat3 P = Mat3::Identity() - e[k] * e[k].transpose();
    A += P;
    b += P * (p[k] - mean);
  }
  return mean + Vec3(LeastNorm(A, 1e-9).solve(VecX(b)));
}

/// R rotated by the smallest angle such that its column z points along `to`.
Mat3 turned(const Mat3& R, const Vec3& to) {
  const Vec3 z = R.col(2), target = z.dot(to) < 0.0 ? Vec3(-to) : to;
  const Vec3 c = z.cross(target);
  const double s = c.norm();
  return s > 0.0 ? Mat3(rotation_exp(c * (std::atan2(s, z.dot(target)) / s)) * R) : R;
}

}  // namespace

Alignment::Alignment(const Model& model, const LoopBlock& block) {
  const std::vector<int> group = rigid_groups(model);
  const int ground = std::ssize(model.bodies);
  for (const int index : block.joints) {
    const Joint& joint = model.joints[index];
    const JointKind& kind = joint_kind(joint.type);
    const Pose X_WF = design_pose(model, joint.frame_F);
    const JointPlace at{X_WF.p, X_WF.R, joint.axis_2};
    const int a = group[joint.parent < 0 ? ground : joint.parent], b = group[joint.child];
    between_.emplace_back(std::min(a, b), std::max(a, b));
    std::vector<ConstraintPart> parts;
    append_joint_parts(model, index, parts);
    bool turns = false, placed = false;
    for (const JointCoordinate& c : kind.coordinates.all())
      turns = turns || c.unit == JointUnit::rad;
    for (const ConstraintPart& p : parts)
      placed = placed || (constraint_kind(p.type).points && p.rows() >= 2);
    const int place = std::ssize(drawn_);
    LoopAxis axis{place, false, at.R.col(2), turns && placed, !turns};
    drawn_.push_back(at);
    if (kind.axes != JointAxes::none)
      axes_.push_back(axis);
    else if (axis.located && joint_velocities(joint.type) == 3)
      axes_.push_back({axis.joint, false, Vec3::Zero(), true, false});
    if (kind.axes != JointAxes::two) continue;
    axis.second = true;
    axis.e = at.R * at.axis_2;
    axes_.push_back(axis);
  }
  Vec3 low = drawn_.empty() ? Vec3::Zero().eval() : drawn_[0].p, high = low;
  for (const JointPlace& a : drawn_) {
    low = low.cwiseMin(a.p);
    high = high.cwiseMax(a.p);
  }
  size_ = (high - low).norm();
  if (!(size_ > 0.0)) size_ = 1.0;
}

Vec3 Alignment::mean_direction(const std::vector<int>& axes) const {
  const Vec3& first = axes_[axes[0]].e;
  Vec3 sum = Vec3::Zero();
  for (const int k : axes) sum += axes_[k].e.dot(first) < 0.0 ? Vec3(-axes_[k].e) : axes_[k].e;
  return sum.normalized();
}

/// Axes within the angle of their mean; every axis belongs to one group.
std::vector<std::vector<int>> Alignment::clusters(double angle) const {
  std::vector<std::vector<int>> found;
  std::vector<int> left;
  for (int k = 0; k < std::ssize(axes_); ++k)
    if (!axes_[k].e.isZero(0.0)) left.push_back(k);
  while (!left.empty()) {
    std::vector<int> cluster;
    for (const int k : left)
      if (angle_between(axes_[left[0]].e, axes_[k].e) <= 2.0 * angle) cluster.push_back(k);
    while (cluster.size() > 1) {
      const Vec3 mean = mean_direction(cluster);
      const auto off = [&](int k) { return angle_between(mean, axes_[k].e); };
      const auto worst = std::max_element(cluster.begin(), cluster.end(),
                                          [&](int a, int b) { return off(a) < off(b); });
      if (off(*worst) <= angle) break;
      cluster.erase(worst);
    }
    std::erase_if(
        left, [&](int k) { return std::find(cluster.begin(), cluster.end(), k) != cluster.end(); });
    found.push_back(std::move(cluster));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return found;
}

/// The direction of a line: that of an axis on it, or else the best fit of its points.
Vec3 Alignment::line_direction(const std::vector<int>& line) const {
  std::vector<int> hinges = line;
  std::erase_if(hinges, [&](int k) { return axes_[k].e.isZero(0.0); });
  if (!hinges.empty()) return mean_direction(hinges);
  Vec3 mean = Vec3::Zero();
  for (const int k : line) mean += place(k) / line.size();
  Mat3 spread = Mat3::Zero();
  for (const int k : line) spread += (place(k) - mean) * (place(k) - mean).transpose();
  return symmetric_eigen(spread).vectors.col(2);
}

/// Hinges and ball joints between the same two bodies, or three ball joints and more.
void Alignment::add_lines(const std::vector<std::vector<int>>& clusters, double distance,
                          std::vector<Relation>& found) const {
  const auto add = [&](std::vector<int> line, const Vec3& e) {
    Vec3 mean = Vec3::Zero();
    for (const int k : line) mean += place(k) / line.size();
    double off = 0.0;
    for (const int k : line) off = std::max(off, across(e, place(k) - mean).norm());
    if (line.size() > 1 && off > exact * size_ && off <= distance)
      found.push_back({Relation::Kind::one_line, std::move(line), {}});
  };
  std::map<std::pair<int, int>, std::vector<int>> balls;
  for (int k = 0; k < std::ssize(axes_); ++k)
    if (axes_[k].e.isZero(0.0)) balls[between_[axes_[k].joint]].push_back(k);
  for (const std::vector<int>& cluster : clusters) {
    std::map<std::pair<int, int>, std::vector<int>> pairs;
    for (const int k : cluster)
      if (axes_[k].located) pairs[between_[axes_[k].joint]].push_back(k);
    for (auto& [bodies, line] : pairs) {
      const auto of_pair = balls.find(bodies);
      if (of_pair != balls.end()) {
        line.insert(line.end(), of_pair->second.begin(), of_pair->second.end());
        balls.erase(of_pair);
      }
      add(std::move(line), mean_direction(cluster));
    }
  }
  for (auto& [bodies, line] : balls)
    if (line.size() > 2) add(line, line_direction(line));
}

/// Three lines or more, not all parallel, that nearly intersect in one point.
void Alignment::add_points(double distance, std::vector<Relation>& found) const {
  constexpr std::size_t most = 100;
  std::vector<std::vector<int>> met;
  std::vector<int> lines;
  for (int k = 0; k < std::ssize(axes_); ++k)
    if (axes_[k].located && !axes_[k].e.isZero(0.0)) lines.push_back(k);
  if (lines.size() > most) return;
  const auto off = [&](const Vec3& x, int k) { return across(axes_[k].e, x - place(k)).norm(); };
  for (const int i : lines)
    for (const int k : lines) {
      if (k <= i || angle_between(axes_[i].e, axes_[k].e) < 0.05) continue;
      const Vec3 x = nearest_point({place(i), place(k)}, {axes_[i].e, axes_[k].e});
      if (off(x, i) > distance || off(x, k) > distance) continue;
      std::vector<int> through;
      for (const int m : lines)
        if (off(x, m) <= 2.0 * distance) through.push_back(m);
      if (through.size() < 3 || std::find(met.begin(), met.end(), through) != met.end()) continue;
      met.push_back(through);
      std::vector<Vec3> p, e;
      for (const int m : through) {
        p.push_back(place(m));
        e.push_back(axes_[m].e);
      }
      const Vec3 mean = nearest_point(p, e);
      double worst = 0.0;
      for (const int m : through) worst = std::max(worst, off(mean, m));
      if (worst > exact * size_ && worst <= distance)
        found.push_back({Relation::Kind::one_point, through, {}});
    }
}

std::vector<Relation> Alignment::relations(double angle, double distance) const {
  std::vector<Relation> found;
  const std::vector<std::vector<int>> groups = clusters(angle);
  std::vector<Vec3> mean;
  for (const std::vector<int>& g : groups) {
    mean.push_back(mean_direction(g));
    const bool off = std::any_of(
        g.begin(), g.end(), [&](int k) { return angle_between(mean.back(), axes_[k].e) > exact; });
    if (off) found.push_back({Relation::Kind::parallel, g, {}});
  }
  for (std::size_t j = 1; j < groups.size(); ++j) {
    Relation r{Relation::Kind::perpendicular, groups[j], {}};
    bool off = false;
    for (std::size_t i = 0; i < j; ++i) {
      const double miss = std::abs(mean[i].dot(mean[j]));
      if (miss > angle) continue;
      r.normal.push_back(groups[i][0]);
      off = off || miss > exact;
    }
    if (off) found.push_back(r);
  }
  std::vector<int> sliding;
  Mat3 spread = Mat3::Zero();
  for (int k = 0; k < std::ssize(axes_); ++k)
    if (axes_[k].slides && !axes_[k].e.isZero(0.0)) {
      sliding.push_back(k);
      spread += axes_[k].e * axes_[k].e.transpose();
    }
  if (sliding.size() >= 3) {
    const Vec3 n = symmetric_eigen(spread).vectors.col(0);
    double off = 0.0;
    for (const int k : sliding) off = std::max(off, std::abs(n.dot(axes_[k].e)));
    if (off > exact && off <= angle)
      found.push_back({Relation::Kind::coplanar, std::move(sliding), {}});
  }
  add_lines(groups, distance, found);
  add_points(distance, found);
  return found;
}

std::vector<JointPlace> Alignment::aligned(const std::vector<Relation>& relations) const {
  std::vector<LoopAxis> axes = axes_;
  std::vector<JointPlace> places = drawn_;
  const auto point = [&](int axis) -> Vec3& { return places[axes[axis].joint].p; };
  for (const Relation& r : relations) {
    switch (r.kind) {
      case Relation::Kind::parallel: {
        const Vec3 mean = mean_direction(r.axes);
        for (const int k : r.axes) axes[k].e = axes[k].e.dot(mean) < 0.0 ? Vec3(-mean) : mean;
        break;
      }
      case Relation::Kind::perpendicular: {
        MatX normals(3, std::ssize(r.normal));
        Eigen::Index column = 0;
        for (const int k : r.normal) normals.col(column++) = axes[k].e;
        const PivotedQr qr = pivoted_qr(normals, 1e-6);
        if (qr.rank == 3) break;
        const MatX free = qr.Q.rightCols(3 - qr.rank);
        for (const int k : r.axes)
          axes[k].e = Vec3(free * (free.transpose() * axes[k].e)).normalized();
        break;
      }
      case Relation::Kind::coplanar: {
        Mat3 spread = Mat3::Zero();
        for (const int k : r.axes) spread += axes[k].e * axes[k].e.transpose();
        const Vec3 n = symmetric_eigen(spread).vectors.col(0);
        for (const int k : r.axes) axes[k].e = across(n, axes[k].e).normalized();
        break;
      }
      case Relation::Kind::one_line: {
        Vec3 mean = Vec3::Zero();
        for (const int k : r.axes) mean += point(k) / r.axes.size();
        const Vec3 e = axes[r.axes[0]].e.isZero(0.0) ? line_direction(r.axes) : axes[r.axes[0]].e;
        for (const int k : r.axes) point(k) = mean + e * e.dot(point(k) - mean);
        break;
      }
      case Relation::Kind::one_point: {
        std::vector<Vec3> p, e;
        for (const int k : r.axes) {
          p.push_back(point(k));
          e.push_back(axes[k].e);
        }
        const Vec3 x = nearest_point(p, e);
        for (const int k : r.axes) point(k) += across(axes[k].e, x - point(k));
        break;
      }
    }
  }
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const LoopAxis& axis = axes[k];
    JointPlace& at = places[axis.joint];
    const bool same = axis.e == axes_[k].e;
    if (axis.second && !(same && at.R == drawn_[axis.joint].R))
      at.axis_2 = (at.R.transpose() * axis.e).normalized();
    else if (!axis.second && !same)
      at.R = turned(at.R, axis.e);
  }
  return places;
}

double Alignment::moved(const std::vector<JointPlace>& places, int axis, bool distance) const {
  const LoopAxis& a = axes_[axis];
  const JointPlace& at = places[a.joint];
  if (distance) return (at.p - place(axis)).norm();
  return angle_between(a.e, a.second ? Vec3(at.R * at.axis_2) : Vec3(at.R.col(2)));
}

double Alignment::miss(const Relation& relation, int axis, const std::vector<int>& others) const {
  const LoopAxis& a = axes_[axis];
  std::vector<Vec3> p, e;
  for (const int k : others) {
    p.push_back(place(k));
    e.push_back(axes_[k].e);
  }
  switch (relation.kind) {
    case Relation::Kind::one_line: {
      Vec3 mean = Vec3::Zero();
      for (const Vec3& x : p) mean += x / p.size();
      return across(line_direction(others), place(axis) - mean).norm();
    }
    case Relation::Kind::one_point:
      return across(a.e, nearest_point(p, e) - place(axis)).norm();
    case Relation::Kind::coplanar: {
      Mat3 spread = Mat3::Zero();
      for (const Vec3& x : e) spread += x * x.transpose();
      return std::asin(std::min(1.0, std::abs(symmetric_eigen(spread).vectors.col(0).dot(a.e))));
    }
    default:
      return angle_between(mean_direction(others), a.e);
  }
}

}  // namespace floatframe
