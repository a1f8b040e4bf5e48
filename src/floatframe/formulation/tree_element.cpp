#include "floatframe/formulation/tree_element.hpp"

#include <algorithm>
#include <cassert>

#include "floatframe/math/partial_ldlt.hpp"
#include "floatframe/math/small_products.hpp"

namespace floatframe {

namespace {

/// Position of the amplitudes of body i in the front of cluster c.
int mode_front(const TreeKinematics& tree, const Cluster& c, int i) {
  return i == c.parent ? c.size + 6 : tree.body(i).iy - c.offset;
}

/// The coordinates that move a marker: those of the bodies of its path, and the modes of its body.
void add_path(const TreeKinematics& tree, const Cluster& c, const std::vector<int>& path,
              int marker, int port, std::vector<PathEntry>& entries) {
  const auto add = [&](PathEntry::What what, int body, int front, int count) {
    if (count > 0) entries.push_back({what, body, marker, port, front, count});
  };
  for (const int i : path) {
    const TreeBody& d = tree.body(i);
    add(PathEntry::What::joint, i, d.iv - c.offset, d.nj);
    if (d.moves_M) add(PathEntry::What::own_modes, i, d.iy - c.offset, d.nm);
    if (d.parent_moves_F)
      add(PathEntry::What::parent_modes, i, mode_front(tree, c, d.parent), d.nm_parent);
  }
  const TreeMarker& m = tree.marker(marker);
  if (m.body >= 0 && m.local)
    add(PathEntry::What::marker_modes, m.body, mode_front(tree, c, m.body), tree.body(m.body).nm);
}

/// The six-row columns of a path entry that does not belong to the marker's body.
const double* directions(const TreeKinematics& tree, const PathEntry& p) noexcept {
  const TreeBody& b = tree.body(p.body);
  if (p.what == PathEntry::What::parent_modes) return b.of_parent.data();
  return b.own.data() + (p.what == PathEntry::What::own_modes ? 6 * b.nj : 0);
}

}  // namespace

std::vector<int> bodies_of(const TreeKinematics& tree, std::span<const int> markers) {
  std::vector<int> bodies;
  for (const int marker : markers) {
    const int body = tree.marker(marker).body;
    if (body >= 0 && std::find(bodies.begin(), bodies.end(), body) == bodies.end())
      bodies.push_back(body);
  }
  return bodies;
}

TreeElement make_element(const TreeKinematics& tree, const std::vector<Cluster>& clusters,
                         const std::vector<int>& cluster_of_body, std::span<const int> markers) {
  assert(!markers.empty() && std::ssize(cluster_of_body) == tree.body_count());
  TreeElement e;
  e.markers.assign(markers.begin(), markers.end());
  const auto [ancestor, paths] = paths_of(tree, markers);
  const auto moves = [](const std::vector<int>& path) { return !path.empty(); };
  const auto first = std::find_if(paths.begin(), paths.end(), moves);
  const int lead = first == paths.end() ? ancestor : first->front();
  if (lead < 0) return e;
  // All markers on one body: the element depends on its modes only, in the front of its cluster.
  e.cluster = cluster_of_body[lead];
  const Cluster& c = clusters[e.cluster];
  for (std::size_t i = 0; i < markers.size(); ++i)
    add_path(tree, c, paths[i], markers[i], static_cast<int>(i), e.path);
  if (e.path.empty()) return e;
  e.first = c.n;
  int last = 0;
  for (const PathEntry& p : e.path) {
    e.first = std::min(e.first, p.front);
    last = std::max(last, p.front + p.count);
  }
  e.first &= ~3;
  e.width = front_stride(last - e.first);
  assert(e.first >= 0 && last <= c.n);
  return e;
}

void fill_gradient(const TreeKinematics& tree, const TreeElement& e, const Wrench* gradient,
                   double* row) noexcept {
  assert(row || e.width == 0);
  for (int j = 0; j < e.width; ++j) row[j] = 0.0;
  for (const PathEntry& p : e.path) {
    const TreeMarker& m = tree.marker(p.marker);
    assert(p.front >= e.first && p.front + p.count <= e.first + e.width);
    const auto& [force, torque] = gradient[p.port];
    double* out = row + (p.front - e.first);
    if (p.what == PathEntry::What::marker_modes) {
      for (int j = 0; j < p.count; ++j) {
        out[j] += m.Jr.col(j).dot(force);
        if (m.rotates) out[j] += m.Jw.col(j).dot(torque);
      }
      continue;
    }
    Vec6 wrench;
    wrench.head<3>() = force;
    wrench.tail<3>() = m.s.r.cross(force) + torque;
    add_transposed_times(directions(tree, p), p.count, wrench.data(), out);
  }
}

void fill_distance(const TreeKinematics& tree, const TreeElement& e, double* rows) noexcept {
  assert(rows || e.width == 0);
  for (int j = 0; j < 3 * e.width; ++j) rows[j] = 0.0;
  for (const PathEntry& p : e.path) {
    const TreeMarker& m = tree.marker(p.marker);
    assert(p.front >= e.first && p.front + p.count <= e.first + e.width);
    const double sign = p.port == 1 ? 1.0 : -1.0;
    double* x = rows + (p.front - e.first);
    double* y = x + e.width;
    double* z = y + e.width;
    if (p.what == PathEntry::What::marker_modes) {
      for (int j = 0; j < p.count; ++j) {
        x[j] += sign * m.Jr(0, j);
        y[j] += sign * m.Jr(1, j);
        z[j] += sign * m.Jr(2, j);
      }
      continue;
    }
    const double* c = directions(tree, p);
    const Vec3& r = m.s.r;
    for (int j = 0; j < p.count; ++j, c += 6) {
      x[j] += sign * (c[0] + c[4] * r[2] - c[5] * r[1]);
      y[j] += sign * (c[1] + c[5] * r[0] - c[3] * r[2]);
      z[j] += sign * (c[2] + c[3] * r[1] - c[4] * r[0]);
    }
  }
}

}  // namespace floatframe
