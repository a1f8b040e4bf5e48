// Rigid elements whose independent components are of several nodes. With q the rigid motion about a
// point c and r = x - c, a component along the axis e of a node is
//   e.u = e.q_u + (r x e).q_theta,   e.theta = e.q_theta.
// The six independent components give q = N^-1 u_n, each other one is an equation b q - u_m = 0.
#include <fmt/format.h>

#include <cmath>

#include "floatframe/decks/nastran/nastran_build.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

/// A component 0 to 5 of a node, in its displacement system.
struct Component {
  int node = -1, axis = 0;
};

class RigidBuilder {
 public:
  RigidBuilder(NastranBuild& build, const NastranRigid& rigid) : b_(build), r_(rigid) {}

  void build() {
    std::vector<Component> independent, dependent;
    if (!components(r_.independent, independent) || !components(r_.dependent, dependent)) return;
    if (independent.size() != 6) return;  // an error
    c_ = b_.model.positions[independent[0].node];
    for (const auto& list : {independent, dependent})
      for (const Component& x : list)
        size_ = std::max(size_, (b_.model.positions[x.node] - c_).norm());
    if (size_ == 0.0) size_ = 1.0;
    Mat6 N;
    for (int i = 0; i < 6; ++i) N.row(i) = row(independent[i]).transpose();
    if (pivoted_rank(N, 1e-9) < 6)
      return b_.error(ErrorCode::dependent, r_,
                      "its six independent components do not define a rigid motion");
    const Mat6 inverse = N.inverse();
    for (const Component& x : dependent) {
      // A node of solids has no rotations to follow.
      if (x.axis >= 3 && b_.rotates[x.node] == 0) continue;
      const Vec6 share = inverse.transpose() * row(x);
      LinearEquation e{{}, r_.at};
      add(x, unit(x), e);
      for (int i = 0; i < 6; ++i)
        if (std::abs(share(i)) > 1e-14) add(independent[i], -share(i) * unit(independent[i]), e);
      b_.equations.add(x.node, x.axis >= 3, e);
    }
  }

 private:
  bool components(const std::vector<NastranRigid::Part>& parts, std::vector<Component>& out) {
    for (const NastranRigid::Part& p : parts) {
      const int node = b_.node(p.node, r_);
      if (node < 0) return false;
      for (int axis = 0; axis < 6; ++axis)
        if (((p.mask >> axis) & 1u) != 0) out.push_back({node, axis});
    }
    return true;
  }

  /// Rotations count with a length, so that all are lengths.
  double unit(const Component& x) const { return x.axis < 3 ? 1.0 : size_; }

  Vec6 row(const Component& x) const {
    const Vec3 e = b_.axes(x.node).col(x.axis % 3);
    Vec6 out = Vec6::Zero();
    if (x.axis >= 3) {
      out.tail<3>() = e;
    } else {
      out.head<3>() = e;
      out.tail<3>() = (b_.model.positions[x.node] - c_).cross(e) / size_;
    }
    return out;
  }

  void add(const Component& x, double factor, LinearEquation& e) {
    add_nastran_direction(e, x.node, x.axis < 3 ? 0 : 3, b_.axes(x.node).col(x.axis % 3), factor);
  }

  NastranBuild& b_;
  const NastranRigid& r_;
  Vec3 c_ = Vec3::Zero();
  double size_ = 0.0;
};

/// d.(u_b - u_a) = 0 with d from a to b.
void rigid_rod(NastranBuild& build, const NastranRigid& r) {
  const int a = build.node(r.independent[0].node, r), b = build.node(r.dependent[0].node, r);
  if (a < 0 || b < 0) return;
  const Vec3 d = build.model.positions[b] - build.model.positions[a];
  if (!(d.norm() > 0.0)) return build.error(ErrorCode::geometry, r, "it has no length");
  LinearEquation e{{}, r.at};
  for (int k = 0; k < 3; ++k) {
    if (std::abs(d(k)) <= 1e-14 * d.norm()) continue;
    e.terms.push_back({b, k, d(k) / d.norm()});
    e.terms.push_back({a, k, -d(k) / d.norm()});
  }
  build.equations.add(b, false, e);
}

}  // namespace

void give_nastran_rigid_rotations(NastranBuild& build) {
  for (const NastranRigid& r : build.content.rigids)
    for (const NastranRigid::Part& p : r.independent) {
      const auto it = build.node_of.find(p.node);
      if ((p.mask >> 3) != 0 && it != build.node_of.end()) build.give_rotations(it->second, r);
    }
}

void build_nastran_rigids(NastranBuild& build) {
  for (const bool rods : {false, true})
    for (const NastranRigid& r : build.content.rigids)
      if ((r.card == "RROD") == rods) rods ? rigid_rod(build, r) : RigidBuilder(build, r).build();
}

}  // namespace floatframe
