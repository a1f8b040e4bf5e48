#include "floatframe/formulation/clusters.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <numeric>

#include "floatframe/math/union_find.hpp"

namespace floatframe {

namespace {

/// Bodies on the paths between tied markers, without their lowest common ancestor.
UnionFind tied_bodies(const TreeKinematics& tree, std::span<const std::vector<int>> ties) {
  UnionFind sets(tree.body_count());
  for (const std::vector<int>& markers : ties) {
    std::vector<int> way;
    for (const std::vector<int>& path : paths_of(tree, markers).paths)
      way.insert(way.end(), path.begin(), path.end());
    for (std::size_t i = 1; i < way.size(); ++i) sets.join(way[i], way[0]);
  }
  return sets;
}

/// Adjacency of the bodies of one cluster through ties and joints of the tree.
std::vector<std::vector<int>> neighbours(const TreeKinematics& tree, const UnionFind& sets,
                                         std::span<const std::vector<int>> ties) {
  std::vector<std::vector<int>> near(tree.body_count());
  const auto join = [&](int a, int b) {
    if (a < 0 || b < 0 || a == b || sets.root(a) != sets.root(b)) return;
    near[a].push_back(b);
    near[b].push_back(a);
  };
  for (const std::vector<int>& markers : ties)
    for (std::size_t i = 1; i < markers.size(); ++i)
      join(tree.marker(markers[0]).body, tree.marker(markers[i]).body);
  for (int i = 0; i < tree.body_count(); ++i) join(i, tree.body(i).parent);
  return near;
}

/// The bodies connected with `first`, the nearest first.
std::vector<int> by_distance(int first, const std::vector<std::vector<int>>& near) {
  std::vector<int> order{first};
  std::vector<bool> met(near.size(), false);
  met[first] = true;
  for (std::size_t k = 0; k < order.size(); ++k)
    for (const int i : near[order[k]])
      if (!met[i]) {
        met[i] = true;
        order.push_back(i);
      }
  return order;
}

/// By the distance from the outermost body (Cuthill and McKee 1969), but parents before children.
void order_bodies(Cluster& c, const TreeKinematics& tree,
                  const std::vector<std::vector<int>>& near) {
  const std::vector<int> order = by_distance(by_distance(c.bodies.front(), near).back(), near);
  assert(order.size() == c.bodies.size());
  std::vector<bool> waits(near.size(), false);
  for (const int i : c.bodies) waits[i] = true;
  c.bodies.clear();
  for (const int body : order) {
    std::vector<int> way;
    for (int i = body; i >= 0 && waits[i]; i = tree.body(i).parent) way.push_back(i);
    for (auto i = way.rbegin(); i != way.rend(); ++i) {
      c.bodies.push_back(*i);
      waits[*i] = false;
    }
  }
}

/// The parent of a cluster: of the parents of its bodies outside of it the one nearest to the
/// ground.
int parent_of(const Cluster& c, const TreeKinematics& tree, const UnionFind& sets,
              const std::vector<int>& depth) {
  int best = tree.body_count() + 2, parent = -1;
  for (const int i : c.bodies) {
    const int p = tree.body(i).parent;
    if (p >= 0 && sets.root(p) == sets.root(i)) continue;
    const int d = p < 0 ? 0 : depth[p];
    if (d < best) {
      best = d;
      parent = p;
    }
  }
  return parent;
}

}  // namespace

MarkerPaths paths_of(const TreeKinematics& tree, std::span<const int> markers) {
  MarkerPaths found;
  for (const int marker : markers) {
    std::vector<int>& path = found.paths.emplace_back();
    for (int i = tree.marker(marker).body; i >= 0; i = tree.body(i).parent) path.push_back(i);
  }
  const auto shared = [&] {
    return std::ranges::all_of(found.paths, [&](const std::vector<int>& path) {
      return !path.empty() && path.back() == found.paths[0].back();
    });
  };
  while (shared()) {
    found.ancestor = found.paths[0].back();
    for (std::vector<int>& path : found.paths) path.pop_back();
  }
  return found;
}

std::vector<Cluster> find_clusters(const TreeKinematics& tree,
                                   std::span<const std::vector<int>> ties) {
  const UnionFind sets = tied_bodies(tree, ties);
  // In the order of their first body, parents before children.
  std::vector<Cluster> clusters;
  std::vector<int> cluster_of_set(tree.body_count(), -1), depth(tree.body_count(), 0);
  for (const Topology::Link& link : tree.topology().links) {
    const int root = sets.root(link.body);
    if (cluster_of_set[root] < 0) {
      cluster_of_set[root] = static_cast<int>(clusters.size());
      clusters.emplace_back();
    }
    clusters[cluster_of_set[root]].bodies.push_back(link.body);
    depth[link.body] = link.parent < 0 ? 1 : depth[link.parent] + 1;
  }
  const std::vector<std::vector<int>> near = neighbours(tree, sets, ties);
  for (Cluster& c : clusters) {
    c.parent = parent_of(c, tree, sets, depth);
    int coordinates = 0;
    for (const int i : c.bodies) coordinates += tree.body(i).nj + tree.body(i).nm;
    if (coordinates >= wide_cluster) order_bodies(c, tree, near);
  }
  // The parent of a cluster found early may be in one found later.
  std::vector<int> level(clusters.size(), -1);
  const std::function<int(int)> level_of = [&](int k) {
    const int parent = clusters[k].parent;
    if (level[k] < 0) level[k] = parent < 0 ? 0 : level_of(cluster_of_set[sets.root(parent)]) + 1;
    return level[k];
  };
  std::vector<int> order(clusters.size());
  std::iota(order.begin(), order.end(), 0);
  for (const int k : order) level_of(k);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return level[a] < level[b]; });
  std::vector<Cluster> sorted;
  for (const int k : order) sorted.push_back(std::move(clusters[k]));
  return sorted;
}

void number_coordinates(TreeKinematics& tree, std::vector<Cluster>& clusters) {
  std::vector<int> order;
  for (const Cluster& c : clusters) order.insert(order.end(), c.bodies.begin(), c.bodies.end());
  tree.number_coordinates(order);
  for (Cluster& c : clusters) {
    const TreeBody &first = tree.body(c.bodies.front()), &last = tree.body(c.bodies.back());
    c.offset = first.iv;
    c.size = last.iy + last.nm - c.offset;
    c.n = c.size + (c.parent < 0 ? 0 : 6 + tree.body(c.parent).nm);
  }
}

}  // namespace floatframe
