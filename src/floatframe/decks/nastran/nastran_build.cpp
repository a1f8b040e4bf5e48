#include "floatframe/decks/nastran/nastran_build.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace floatframe {
namespace {

using SystemKind = Orientation::Kind;

/// A point in the coordinates of a system; angles in degrees.
Vec3 to_basic(const Orientation& f, const Vec3& x) {
  constexpr double degree = std::numbers::pi / 180.0;
  Vec3 local = x;
  if (f.kind == SystemKind::cylindrical) {
    local = {x(0) * std::cos(x(1) * degree), x(0) * std::sin(x(1) * degree), x(2)};
  } else if (f.kind == SystemKind::spherical) {
    const double r = x(0) * std::sin(x(1) * degree);
    local = {r * std::cos(x(2) * degree), r * std::sin(x(2) * degree),
             x(0) * std::cos(x(1) * degree)};
  }
  return f.origin + f.axes * local;
}

}  // namespace

Mat3 nastran_axes_at(const Orientation& f, const Vec3& p) {
  if (f.kind == SystemKind::rectangular) return f.axes;
  const Vec3 local = f.axes.transpose() * (p - f.origin);
  const double r = std::hypot(local(0), local(1)), R = local.norm();
  const bool on_axis = !(r > 1e-12 * R);
  const double c = on_axis ? 1.0 : local(0) / r, s = on_axis ? 0.0 : local(1) / r;
  Mat3 T;
  if (f.kind == SystemKind::cylindrical) {
    T << c, -s, 0, s, c, 0, 0, 0, 1;
  } else {
    const double z = R > 0.0 ? local(2) / R : 1.0, w = R > 0.0 ? r / R : 0.0;
    T << w * c, z * c, -s, w * s, z * s, c, z, -w, 0;
  }
  return f.axes * T;
}

Mat3 NastranBuild::axes(int node) const {
  const auto it = turned_axes.find(node);
  return it == turned_axes.end() ? Mat3::Identity() : it->second;
}

Mat3 NastranBuild::axes_of_system(int system, const FeSource& at, int node) {
  return nastran_axes_at(frame(system, at), model.positions[node]);
}

bool NastranBuild::direction(const NastranDirection& given, int from, bool turned,
                             const NastranEntity& e, Vec3& out) {
  out = turned ? Vec3(axes(from) * given.vector) : given.vector;
  if (given.node == 0) return true;
  const int other = node(given.node, e);
  if (other >= 0) out = model.positions[other] - model.positions[from];
  return other >= 0;
}

int NastranBuild::add_node(const Vec3& p, const FeSource& at, const std::string& who) {
  if (largest_id_ == 0)
    largest_id_ = *std::max_element(model.node_ids.begin(), model.node_ids.end());
  if (largest_id_ == std::numeric_limits<int>::max())
    source.stop(ErrorCode::incomplete, at,
                "{} needs a node of its own, but there is no number above {}", who, largest_id_);
  model.positions.push_back(p);
  model.node_ids.push_back(++largest_id_);
  model.node_sources.push_back(at);
  model.generated_nodes.push_back(model.nodes() - 1);
  turned.push_back(0);
  if (!rotates.empty()) rotates.push_back(1);
  return model.nodes() - 1;
}

void NastranBuild::give_rotations(int node, const NastranEntity& e) {
  if (rotates[node] != 0) return;
  rotates[node] = 1;
  const int extra = add_node(model.positions[node], e.at, e.label());
  add_rigid_spider(model, node, e.label(), e.at).nodes = {extra};
}

int NastranBuild::node(int id, const FeSource& at, const std::string& who) {
  const auto it = node_of.find(id);
  if (it != node_of.end()) return it->second;
  if (id > 0)
    source.error(ErrorCode::not_found, at,
                 content.scalar_points.contains(id)
                     ? fmt::format("{} has the scalar point {}, expected a node (GRID)", who, id)
                     : fmt::format("{} has node {}, which is not in the file", who, id));
  return -1;
}

void NastranBuild::spend(std::size_t members, const FeSource& at) {
  spent_ += members;
  const std::uint64_t most = 10'000'000 + 100 * (content.grids.size() + content.elements.size());
  if (spent_ > most)
    source.stop(ErrorCode::too_large, at,
                "the sets and supports have more than {} members in all, too many for a file of {} "
                "nodes and {} elements",
                most, content.grids.size(), content.elements.size());
}

void NastranBuild::note(const FeSource& at, const std::string& text) {
  model.notes.push_back(source.mark(at).before(text));
}

void NastranBuild::note(const NastranCount& count, const std::string& text) {
  if (count.number > 0) note(count.first, fmt::format("{} {}", count.number, text));
}

const Orientation& NastranBuild::frame(int id, const FeSource& at) {
  const auto it = frames_.find(id);
  if (it != frames_.end()) return it->second;
  return frames_[id] = make_frame(id, at);
}

Orientation NastranBuild::make_frame(int id, const FeSource& at) {
  if (id == 0) return {};
  const auto by_nodes = content.node_systems.find(id);
  const bool nodes = by_nodes != content.node_systems.end();
  const auto it = nodes ? by_nodes : content.systems.find(id);
  if (!nodes && it == content.systems.end()) {
    const auto other = content.other_systems.find(id);
    source.error(ErrorCode::not_found, at,
                 other == content.other_systems.end()
                     ? fmt::format("coordinate system {} is not in the file", id)
                     : fmt::format("coordinate system {} is a {}, which is not read (CORD1R, "
                                   "CORD1C, CORD1S, CORD2R, CORD2C and CORD2S are)",
                                   id, other->second));
    return {};
  }
  const NastranSystem& s = it->second;
  if (!open_.insert(id).second || open_.size() > 100) {
    source.error(ErrorCode::cycle, s.at,
                 "coordinate system {} refers to itself through its reference systems, or these "
                 "are more than 100 deep",
                 id);
    return {};
  }
  const Orientation base = nodes ? Orientation{} : frame(s.rid, s.at);
  std::array<Vec3, 3> points;
  for (std::size_t k = 0; k < 3; ++k)
    points[k] = nodes ? place_of(s.nodes[k], s) : to_basic(base, s.points[k]);
  open_.erase(id);
  return through(points, s);
}

/// Origin a, b on z, c in the xz plane.
Orientation NastranBuild::through(const std::array<Vec3, 3>& points, const NastranSystem& s) {
  Orientation f;
  const char kind = s.card.back();  // CORD2C
  f.kind = kind == 'C'   ? SystemKind::cylindrical
           : kind == 'S' ? SystemKind::spherical
                         : SystemKind::rectangular;
  f.origin = points[0];
  const Vec3 z = points[1] - points[0], x = points[2] - points[0], y = z.cross(x);
  if (!(y.norm() > 1e-12 * z.norm() * x.norm())) {
    source.error(ErrorCode::geometry, s.at,
                 "coordinate system {}: its points A, B and C are on a line", s.id);
    return f;
  }
  f.axes.col(2) = z.normalized();
  f.axes.col(1) = y.normalized();
  f.axes.col(0) = f.axes.col(1).cross(f.axes.col(2));
  return f;
}

Vec3 NastranBuild::place_of(int id, const NastranSystem& system) {
  if (grid_of_.empty())
    for (const NastranGrid& g : content.grids)
      grid_of_.try_emplace(g.id, static_cast<int>(&g - content.grids.data()));
  const auto it = grid_of_.find(id);
  if (it == grid_of_.end()) {
    source.error(ErrorCode::not_found, system.at,
                 "coordinate system {} has node {}, which is not in the file", system.id, id);
    return Vec3(id, 0.1 * id * id, 1.0);  // any position; the error is reported already
  }
  const NastranGrid& g = content.grids[it->second];
  return to_basic(frame(g.cp, g.at), g.x);
}

void build_nastran_nodes(NastranBuild& build) {
  FeModel& model = build.model;
  const std::size_t n = build.content.grids.size();
  model.positions.reserve(n);
  model.node_ids.reserve(n);
  model.node_sources.reserve(n);
  build.node_of.reserve(n);
  build.turned.reserve(n);
  for (const NastranGrid& g : build.content.grids) {
    const auto [it, fresh] = build.node_of.try_emplace(g.id, model.nodes());
    if (!fresh && g.id > 0) {
      const FeSource& first = model.node_sources[it->second];
      build.source.error(ErrorCode::duplicate, g.at,
                         "node {} is in the file twice, first in line {}", g.id, first.line);
    }
    model.positions.push_back(to_basic(build.frame(g.cp, g.at), g.x));
    model.node_ids.push_back(g.id);
    model.node_sources.push_back(g.at);
    // Cylindrical and spherical systems rotate with the position.
    const Orientation* cd = g.cd == 0 || g.cd == -1 ? nullptr : &build.frame(g.cd, g.at);
    build.turned.push_back(cd != nullptr &&
                           (cd->kind != SystemKind::rectangular || !cd->axes.isIdentity(1e-9)));
    if (build.turned.back() != 0)
      build.turned_axes[model.nodes() - 1] = nastran_axes_at(*cd, model.positions.back());
  }
  if (n == 0) build.source.error(ErrorCode::missing, {0, 0}, "the file has no nodes (GRID)");
}

NastranNumbers::NastranNumbers(std::vector<std::pair<int, int>> number_and_index)
    : sorted_(std::move(number_and_index)) {
  std::sort(sorted_.begin(), sorted_.end());
}

bool NastranNumbers::append(int first, int last, std::vector<int>& indices) const {
  auto it = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{first, -1});
  const std::size_t before = indices.size();
  for (; it != sorted_.end() && it->first <= last; ++it) indices.push_back(it->second);
  return indices.size() > before;
}

std::set<int> selected_nastran_sets(NastranBuild& build,
                                    const std::vector<std::pair<int, FeSource>>& selected,
                                    const std::map<int, std::vector<int>>& added,
                                    const std::set<int>& there, const char* what) {
  std::set<int> sets;
  for (const auto& [id, at] : selected) {
    if (id != selected.front().first) {
      build.source.error(
          ErrorCode::exclusive, at,
          "the case control selects {} sets {} and {}; only one can be read, remove the other",
          what, selected.front().first, id);
      return sets;
    }
    const auto joined = added.find(id);
    if (joined == added.end()) {
      sets.insert(id);
    } else {
      if (there.contains(id))
        build.source.error(
            ErrorCode::exclusive, at,
            "the set {} is one of {} cards and one of {}ADD, expected only one of both", id, what,
            what);
      for (const int set : joined->second)
        if (!there.contains(set))
          build.source.error(ErrorCode::not_found, at,
                             "{}ADD {} joins set {}, which is not in the file", what, id, set);
      if (build.source.errors() > 0) return {};
      sets.insert(joined->second.begin(), joined->second.end());
    }
  }
  return sets;
}

void build_nastran_sets(NastranBuild& build, bool only_nodes) {
  const NastranContent& c = build.content;
  const NastranNumbers nodes({build.node_of.begin(), build.node_of.end()});
  std::vector<std::pair<int, int>> list;
  for (std::size_t e = 0; e < build.model.elements.size(); ++e)
    list.emplace_back(build.model.elements[e].id, static_cast<int>(e));
  const NastranNumbers elements(std::move(list));
  std::map<std::pair<bool, std::string>, std::unordered_set<int>> members_of;
  for (const NastranSet& set : c.sets) {
    if (set.elements && only_nodes) continue;
    const char* const what = set.elements ? "element" : "node";
    std::vector<int> members;
    bool complete = true;
    for (const auto& [first, last] : set.ranges) {
      const std::size_t before = members.size();
      const bool found = (set.elements ? elements : nodes).append(first, last, members);
      build.spend(members.size() - before, set.at);
      if (found || (!set.elements && c.scalar_points.overlaps(first, last))) continue;
      complete = false;
      if (!set.strict || first == 0) continue;
      build.source.error(
          ErrorCode::not_found, set.at,
          first == last
              ? fmt::format("set {} has {} {}, which is not in the file", set.id, what, first)
              : fmt::format("set {}: there is no {} from {} to {}", set.id, what, first, last));
    }
    if (!complete) continue;
    const auto name = c.names.sets.find(set.id);
    auto& sets = set.elements ? build.model.element_sets : build.model.node_sets;
    const std::string key =
        name == c.names.sets.end() ? fmt::format("SET {}", set.id) : name->second;
    // Members without duplicates, in the order of the file; several cards of one set are combined.
    std::vector<int>& known = sets[key];
    std::unordered_set<int>& there = members_of[{set.elements, key}];
    if (there.empty()) there.insert(known.begin(), known.end());
    for (const int m : members)
      if (there.insert(m).second) known.push_back(m);
  }
}

}  // namespace floatframe
