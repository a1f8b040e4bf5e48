// Ends of bars. An offset end is a node of its own, tied rigidly: u' = u + theta x d, theta' =
// theta. A pinned end is a node of its own too, tied only in the components that are not pinned, in
// the axes of the element. What two pins of a bar release twice is released once, else nothing
// would hold the end.
#include <fmt/format.h>

#include <algorithm>

#include "floatframe/decks/nastran/nastran_build.hpp"
#include "floatframe/decks/stiffeners.hpp"
#include "floatframe/fe/beam_tangent.hpp"
#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {
namespace {

/// One of two equal releases that a bar has at both ends: 1, 4, and in each plane what is more than
/// two of the deflections and slopes.
void without_double_releases(unsigned& a, unsigned& b) {
  for (const unsigned component : {1u, 8u}) {
    if ((a & b & component) != 0) b &= ~component;
  }
  for (const auto& [deflection, slope] : {std::pair{2u, 32u}, std::pair{4u, 16u}}) {
    if ((a & b & deflection) != 0) b &= ~deflection;
    if ((a & b & slope) == 0) continue;
    a &= ~deflection;
    b &= ~deflection;
  }
}

}  // namespace

Mat3 nastran_bar_axes(const Vec3& along, const Vec3& v) {
  Mat3 T;
  T.col(0) = along.normalized();
  T.col(2) = along.cross(v).normalized();
  T.col(1) = T.col(2).cross(T.col(0));
  return T;
}

void nastran_bar_without_axes(NastranBuild& build, const FeSource& at, const std::string& who) {
  build.source.error(ErrorCode::geometry, at,
                     "{}: it has no length, or its orientation vector is along its axis", who);
}

bool NastranBars::place(const NastranElement& e, double turn, bool bends, Element& element) {
  static const NastranBarEnds plain;
  const NastranBarEnds& ends = e.ends < 0 ? plain : b_.content.bar_ends[e.ends];
  const std::string who = fmt::format("{} {}", e.card, e.id);
  const int node[2] = {element.nodes[0], element.nodes[1]};
  const Vec3 p[2] = {b_.model.positions[node[0]], b_.model.positions[node[1]]};
  if (element.type != ElementType::rod2) {
    const bool pinned = (ends.pins[0] | ends.pins[1]) != 0;
    const bool beside = !ends.offset[0].isZero(0.0) || !ends.offset[1].isZero(0.0);
    bars_.push_back({{node[0], node[1], -1}, beside, bends && !pinned});
  }
  if (e.orientation_node > 0) {
    const int other = b_.node(e.orientation_node, e.at, who);
    if (other < 0) return false;
    element.reference = b_.model.positions[other] - p[0];
  } else {
    element.reference = e.orientation;
    if (ends.axes[0] == 'G') element.reference = b_.axes(node[0]) * e.orientation;
  }
  if (e.ends < 0 && turn == 0.0) {
    if (!is_along_axis(p[1] - p[0], element.reference)) return true;
    nastran_bar_without_axes(b_, e.at, who);
    return false;
  }
  Vec3 arm[2], end[2];
  for (int k = 0; k < 2; ++k) {
    const Mat3 T = ends.axes[1 + k] == 'G' ? b_.axes(node[k])
                                           : nastran_bar_axes(p[1] - p[0], element.reference);
    arm[k] = ends.offset[k] == Vec3::Zero() ? Vec3::Zero() : Vec3(T * ends.offset[k]);
    end[k] = p[k] + arm[k];
  }
  const Mat3 T = nastran_bar_axes(end[1] - end[0], element.reference);
  if (!(T.squaredNorm() > 2.5)) {  // a column without length is zero
    nastran_bar_without_axes(b_, e.at, who);
    return false;
  }
  element.reference = std::cos(turn) * T.col(1) + std::sin(turn) * T.col(2);
  unsigned pins[2] = {ends.pins[0], ends.pins[1]};
  without_double_releases(pins[0], pins[1]);
  const bool rod = element.type == ElementType::rod2;
  if (rod) pins[0] &= 7u, pins[1] &= 7u;
  for (int k = 0; k < 2; ++k) {
    if (pins[k] == 0 && arm[k].isZero(0.0)) continue;
    int* shared = nullptr;
    if (pins[k] == 0) {
      shared = &offset_nodes_[{double(node[k]), arm[k](0), arm[k](1), arm[k](2)}];
      if (*shared > 0) {
        element.nodes[k] = *shared;
        continue;
      }
    }
    Tie t;
    t.fresh = b_.add_node(end[k], e.at, who);
    t.node = node[k];
    t.arm = arm[k];
    if (pins[k] != 0) t.axes = T;
    t.mask = (rod ? 7u : 63u) & ~pins[k];
    t.at = e.at;
    element.nodes[k] = t.fresh;
    if (shared != nullptr) *shared = t.fresh;
    ties_.push_back(t);
  }
  return true;
}

void NastranBars::finish() {
  free_drilling_at_stiffeners(b_.model, bars_);
  std::vector<char> dofs(b_.model.positions.size(), 0);
  for (const Element& e : b_.model.elements) {
    const ElementKernel& kernel = element_kernel(e.type);
    for (int k = 0; k < kernel.nodes; ++k) {
      char& d = dofs[e.nodes[k]];
      d = std::max(d, static_cast<char>(kernel.dofs_per_node));
    }
  }
  for (const Tie& t : ties_) {
    const bool held = dofs[t.node] == 6;
    tie(t, held);
    if (dofs[t.node] > 0 || spiders_.contains(t.node)) continue;
    b_.model.masses.push_back({t.node, 0.0, Mat3::Zero()});  // it has displacements
    dofs[t.node] = 3;
  }
}

void NastranBars::tie(const Tie& t, bool rotates) {
  FeModel& model = b_.model;
  // Rotations of a node of nothing but pinned or offset bars come with a spider.
  const bool needs_rotations = (t.mask >> 3) != 0 || !t.arm.isZero(0.0);
  if (!rotates && needs_rotations) {
    const auto [it, fresh] = spiders_.try_emplace(t.node, static_cast<int>(model.spiders.size()));
    if (fresh) {
      Spider s;
      s.name = fmt::format("bars of node {}", model.node_ids[t.node]);
      s.reference = t.node;
      s.source = t.at;
      model.spiders.push_back(std::move(s));
    }
    if (t.mask == 63u) {
      model.spiders[it->second].nodes.push_back(t.fresh);
      return;
    }
    if (fresh) {  // a node that only gives the reference its rotations
      const int extra = b_.add_node(model.positions[t.node], t.at, "a pinned bar");
      model.spiders[it->second].nodes.push_back(extra);
    }
  }
  for (int c = 0; c < 6; ++c) {
    if (((t.mask >> c) & 1u) == 0) continue;
    const bool rotation = c >= 3;
    const int first = rotation ? 3 : 0;
    const Vec3 axis = t.axes.col(c % 3), lever = t.arm.cross(axis);
    LinearEquation e;
    e.source = t.at;
    for (int k = 0; k < 3; ++k) {
      if (axis(k) == 0.0) continue;
      e.terms.push_back({t.fresh, first + k, axis(k)});
      e.terms.push_back({t.node, first + k, -axis(k)});
    }
    for (int k = 0; k < 3 && !rotation; ++k) {
      if (lever(k) != 0.0) e.terms.push_back({t.node, 3 + k, -lever(k)});
    }
    b_.equations.add(t.fresh, rotation, std::move(e));
  }
}

}  // namespace floatframe
