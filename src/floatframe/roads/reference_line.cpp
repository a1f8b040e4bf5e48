#include "floatframe/roads/reference_line.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace floatframe {

ReferenceLine::ReferenceLine(double u0, double du, std::size_t steps, Node start, double heading)
    : u0_(u0),
      du_(du),
      steps_(steps),
      start_(start),
      cosine_{std::cos(heading), std::cos(heading)},
      sine_{std::sin(heading), std::sin(heading)},
      heading_{heading, heading} {
  assert(steps > 0 && du > 0.0);
  end_ = node(steps_);
}

ReferenceLine::ReferenceLine(double u0, double du, std::vector<Node> nodes, double first,
                             double last)
    : u0_(u0),
      du_(du),
      steps_(nodes.size() - 1),
      nodes_(std::move(nodes)),
      start_(nodes_.front()),
      end_(nodes_.back()),
      cosine_{std::cos(first), std::cos(last)},
      sine_{std::sin(first), std::sin(last)},
      heading_{first, last} {
  assert(nodes_.size() > 1 && du > 0.0);
  closed_ = steps_ > 2 && std::hypot(end_.x - start_.x, end_.y - start_.y) < 0.01 * du_;
  build_tree();
}

void ReferenceLine::build_tree() {
  leaves_ = 1;
  while (leaves_ * leaf < nodes_.size()) leaves_ *= 2;
  constexpr double none = std::numeric_limits<double>::infinity();
  tree_.assign(2 * leaves_ - 1, Box{none, -none, none, -none});
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    Box& box = tree_[leaves_ - 1 + k / leaf];
    box = {std::min(box.x0, nodes_[k].x), std::max(box.x1, nodes_[k].x),
           std::min(box.y0, nodes_[k].y), std::max(box.y1, nodes_[k].y)};
  }
  for (std::size_t k = leaves_ - 1; k-- > 0;) {
    const Box &a = tree_[2 * k + 1], &b = tree_[2 * k + 2];
    tree_[k] = {std::min(a.x0, b.x0), std::max(a.x1, b.x1), std::min(a.y0, b.y0),
                std::max(a.y1, b.y1)};
  }
}

void ReferenceLine::begin_at_origin() {
  const double c = cosine_[0], s = sine_[0], turn = heading_[0];
  if (nodes_.empty()) {
    *this = ReferenceLine(u0_, du_, steps_, Node{}, 0.0);
    return;
  }
  std::vector<Node> nodes = std::move(nodes_);
  for (Node& p : nodes) {
    const double x = p.x - start_.x, y = p.y - start_.y;
    p = {x * c + y * s, y * c - x * s};
  }
  *this = ReferenceLine(u0_, du_, std::move(nodes), 0.0, heading_[1] - turn);
}

ReferenceLine::Node ReferenceLine::node(std::size_t k) const noexcept {
  if (!nodes_.empty()) return nodes_[k];
  const double s = du_ * k;
  return {start_.x + s * cosine_[0], start_.y + s * sine_[0]};
}

double ReferenceLine::squared_distance(const Box& box, double x, double y) const noexcept {
  const double dx = std::max({box.x0 - x, 0.0, x - box.x1});
  const double dy = std::max({box.y0 - y, 0.0, y - box.y1});
  return dx * dx + dy * dy;
}

std::size_t ReferenceLine::nearest(double x, double y) const noexcept {
  std::array<std::size_t, 128> open;  // one a level, and the other child of each
  std::size_t count = 0, best = 0;
  double least = std::numeric_limits<double>::infinity();
  open[count++] = 0;
  while (count > 0) {
    const std::size_t k = open[--count];
    if (!(squared_distance(tree_[k], x, y) < least)) continue;
    if (k + 1 < leaves_) {
      const std::size_t a = 2 * k + 1, b = a + 1;
      const bool second = squared_distance(tree_[b], x, y) < squared_distance(tree_[a], x, y);
      open[count++] = second ? a : b;
      open[count++] = second ? b : a;
      continue;
    }
    const std::size_t begin = (k + 1 - leaves_) * leaf;
    for (std::size_t i = begin; i < std::min(begin + leaf, nodes_.size()); ++i) {
      const double dx = x - nodes_[i].x, dy = y - nodes_[i].y, d = dx * dx + dy * dy;
      if (d < least) least = d, best = i;
    }
  }
  return best;
}

ReferenceLine::Node ReferenceLine::chord(std::size_t k) const noexcept {
  const bool seam = closed_ && (k == 0 || k == steps_);
  const Node& a = nodes_[seam ? steps_ - 1 : k > 0 ? k - 1 : 0];
  const Node& b = nodes_[seam ? 1 : std::min(k + 1, steps_)];
  return {b.x - a.x, b.y - a.y};
}

/// From a node near the place up, then down, until it lies between the normals of both ends.
std::size_t ReferenceLine::interval(std::size_t near, double x, double y) const noexcept {
  const auto beyond = [&](std::size_t k) {
    const Node t = chord(k);
    return (x - nodes_[k].x) * t.x + (y - nodes_[k].y) * t.y;
  };
  std::size_t end = std::max<std::size_t>(near, 1);
  while (end < steps_ && beyond(end) > 0.0) ++end;
  while (end > 1 && beyond(end - 1) < 0.0) --end;
  return end - 1;
}

LinePlace ReferenceLine::in_interval(std::size_t k, double x, double y) const noexcept {
  const Node &p = nodes_[k], &q = nodes_[k + 1];
  const Node e{q.x - p.x, q.y - p.y}, s = chord(k), t = chord(k + 1);
  const double length = std::sqrt(e.x * e.x + e.y * e.y);
  const double near = 1.0 / (s.x * e.x + s.y * e.y), far = 1.0 / (t.x * e.x + t.y * e.y);
  const double a = near * (s.x * (x - p.x) + s.y * (y - p.y));
  const double b = far * (t.x * (q.x - x) + t.y * (q.y - y));
  const double ax = near * s.x, ay = near * s.y, bx = -far * t.x, by = -far * t.y;
  const double sum = a + b, share = a / sum;
  // share = a / sum, differentiated twice; a and sum are linear.
  const double sx = ax + bx, sy = ay + by;
  const double dx = (ax - share * sx) / sum, dy = (ay - share * sy) / sum;
  LinePlace out;
  out.u = u0_ + du_ * (k + share);  // (1)
  out.ux = du_ * dx;
  out.uy = du_ * dy;
  out.uxx = -2.0 * du_ * dx * sx / sum;
  out.uxy = -du_ * (dx * sy + dy * sx) / sum;
  out.uyy = -2.0 * du_ * dy * sy / sum;
  out.v = (e.x * (y - p.y) - e.y * (x - p.x)) / length;
  out.vx = -e.y / length;
  out.vy = e.x / length;
  return out;
}

LinePlace ReferenceLine::straight(bool behind, double x, double y) const noexcept {
  const Node& p = behind ? end_ : start_;
  const double c = cosine_[behind ? 1 : 0], s = sine_[behind ? 1 : 0];
  LinePlace out;
  out.u = (behind ? last() : u0_) + (x - p.x) * c + (y - p.y) * s;
  out.v = (y - p.y) * c - (x - p.x) * s;
  out.ux = out.vy = c;
  out.uy = s;
  out.vx = -s;
  return out;
}

LinePlace ReferenceLine::at(double x, double y) const noexcept {
  if (nodes_.empty()) return straight(false, x, y);
  LinePlace out = in_interval(interval(nearest(x, y), x, y), x, y);
  if (closed_ && (out.u < u0_ || out.u > last())) {
    const LinePlace other = in_interval(out.u < u0_ ? steps_ - 1 : 0, x, y);
    if (other.u >= u0_ && other.u <= last()) return other;
  }
  if (out.u < u0_) return straight(false, x, y);
  if (out.u > last()) return straight(true, x, y);
  return out;
}

std::size_t ReferenceLine::index_of(double u) const noexcept {
  const double k = (u - u0_) / du_;
  if (!(k > 0.0)) return 0;
  return k < steps_ ? static_cast<std::size_t>(k) : steps_ - 1;
}

ReferenceLine::Node ReferenceLine::place(double u, double v) const noexcept {
  const bool behind = u > last();
  if (nodes_.empty() || u < u0_ || behind) {
    const double s = u - (behind ? last() : u0_);
    const Node& p = behind ? end_ : start_;
    const double cosine = cosine_[behind ? 1 : 0], sine = sine_[behind ? 1 : 0];
    return {p.x + s * cosine - v * sine, p.y + s * sine + v * cosine};
  }
  const std::size_t k = index_of(u);
  const double share = (u - u0_) / du_ - k;
  const Node &p = nodes_[k], &q = nodes_[k + 1], e{q.x - p.x, q.y - p.y};
  const double length = std::sqrt(e.x * e.x + e.y * e.y);
  // On the normals of both ends, at the distance v from the step.
  const auto beside = [&](const Node& at, const Node& t) {
    const double w = v * length / (t.x * e.x + t.y * e.y);
    return Node{at.x - w * t.y, at.y + w * t.x};
  };
  const Node a = beside(p, chord(k)), b = beside(q, chord(k + 1));
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

double ReferenceLine::heading(double u) const noexcept {
  const std::size_t k = index_of(u);
  if (nodes_.empty() || k == 0) return heading_[0];
  return std::atan2(nodes_[k].y - nodes_[k - 1].y, nodes_[k].x - nodes_[k - 1].x);
}

double ReferenceLine::curvature(double u, double v) const noexcept {
  if (nodes_.empty()) return 0.0;
  const std::size_t k = index_of(u), n = std::max(1, static_cast<int>(0.5 / du_));
  if (n > k || k + n > steps_) return 0.0;
  const Node &p = nodes_[k - n], &q = nodes_[k], &r = nodes_[k + n];
  const double turn = (q.x - p.x) * (r.y - q.y) - (q.y - p.y) * (r.x - q.x);
  const double c = turn / std::pow(du_ * n, 3.0);
  if (!(std::abs(c) > 1e-10)) return c;
  const double radius = 1.0 / c - v;
  return std::abs(radius) < 1e-6 ? 1e6 : 1.0 / radius;
}

}  // namespace floatframe
