#include "floatframe/formats/nastran/nastran_build.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {
namespace {

/// A point in the coordinates of a system; angles in degrees.
Vec3 to_basic(const NastranFrame& f, const Vec3& x) {
  constexpr double degree = std::numbers::pi / 180.0;
  Vec3 local = x;
  if (f.kind == 'C') {
    local = {x(0) * std::cos(x(1) * degree), x(0) * std::sin(x(1) * degree), x(2)};
  } else if (f.kind == 'S') {
    const double r = x(0) * std::sin(x(1) * degree);
    local = {r * std::cos(x(2) * degree), r * std::sin(x(2) * degree),
             x(0) * std::cos(x(1) * degree)};
  }
  return f.origin + f.R * local;
}

}  // namespace

int NastranBuild::node(int id, const FeSource& at, const std::string& who) {
  const auto it = node_of.find(id);
  if (it != node_of.end()) return it->second;
  if (id > 0) source.error(at, fmt::format("{} has node {}, which is not in the file", who, id));
  return -1;
}

void NastranBuild::spend(std::size_t members, const FeSource& at) {
  spent_ += members;
  const std::uint64_t most = 10'000'000 + 100 * (content.grids.size() + content.elements.size());
  if (spent_ > most) {
    source.stop(at, fmt::format("the sets and supports have more than {} members in all, too many "
                                "for a file of {} nodes and {} elements",
                                most, content.grids.size(), content.elements.size()));
  }
}

void NastranBuild::note(const FeSource& at, const std::string& text) {
  model.notes.push_back(ErrorEntry{source.mark(at), text}.text());
}

const NastranFrame& NastranBuild::frame(int id, const FeSource& at) {
  const auto it = frames_.find(id);
  if (it != frames_.end()) return it->second;
  return frames_[id] = made(id, at);
}

NastranFrame NastranBuild::made(int id, const FeSource& at) {
  if (id == 0) return {};
  const auto it = content.systems.find(id);
  if (it == content.systems.end()) {
    const auto other = content.other_systems.find(id);
    source.error(at, other == content.other_systems.end()
                         ? fmt::format("coordinate system {} is not in the file", id)
                         : fmt::format("coordinate system {} is a {}, which is not read (CORD2R, "
                                       "CORD2C and CORD2S are)",
                                       id, other->second));
    return {};
  }
  const NastranSystem& s = it->second;
  if (!open_.insert(id).second || open_.size() > 100) {
    source.error(s.at, fmt::format("coordinate system {} refers to itself through its reference "
                                   "systems, or these are more than 100 deep",
                                   id));
    return {};
  }
  const NastranFrame& base = frame(s.rid, s.at);
  open_.erase(id);
  const Vec3 a = to_basic(base, s.a), b = to_basic(base, s.b), c = to_basic(base, s.c);
  NastranFrame f;
  f.kind = s.kind;
  f.origin = a;
  const Vec3 z = b - a, y = z.cross(c - a);
  if (z.norm() == 0.0 || y.norm() <= 1e-12 * z.norm() * (c - a).norm()) {
    source.error(s.at,
                 fmt::format("coordinate system {}: its points A, B and C are on a line", id));
    return f;
  }
  f.R.col(2) = z.normalized();
  f.R.col(1) = y.normalized();
  f.R.col(0) = f.R.col(1).cross(f.R.col(2));
  return f;
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
      build.source.error(
          g.at, fmt::format("node {} is in the file twice, first in line {}", g.id, first.line));
    }
    model.positions.push_back(to_basic(build.frame(g.cp, g.at), g.x));
    model.node_ids.push_back(g.id);
    model.node_sources.push_back(g.at);
    // Cylindrical and spherical systems turn with the place.
    const NastranFrame* cd = g.cd == 0 || g.cd == -1 ? nullptr : &build.frame(g.cd, g.at);
    build.turned.push_back(cd != nullptr && (cd->kind != 'R' || !cd->R.isIdentity(1e-9)));
  }
  if (n == 0) build.source.error({0, 0}, "the file has no nodes (GRID)");
}

}  // namespace floatframe
