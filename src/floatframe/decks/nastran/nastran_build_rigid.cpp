// Rigid elements whose independent components are at several nodes. With q the rigid motion about a
// point c and r = x - c, a component along the axis e of a node is
//   e.u = e.q_u + (r x e).q_theta,   e.theta = e.q_theta.
// The six independent components give q = N^-1 u_n, each other one gives an equation b q - u_m = 0.
//
// RBE3 in general: its reference r moves as the rigid motion q that fits weighted components of
// nodes best,
//   sum_i A_i^T W_i A_i q = sum_i A_i^T W_i u_i,   A_i = [1 -skew(x_i - x_r); 0 1],
// with W_i the sum of w e e^T over the components e of node i; of rotations w counts with the
// square of the mean distance of the nodes from the reference. For each component d of REFC
// d.u_r = d.q is an equation. They are solved for components of the nodes, so that the reference
// can be an interface.
#include <bit>
#include <cmath>

#include "floatframe/decks/nastran/nastran_build.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"

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

using Key = std::pair<int, int>;  // node, axis

class MeanBuilder {
 public:
  MeanBuilder(NastranBuild& build, const NastranSpider& s) : b_(build), s_(s) {}

  void build() {
    reference_ = b_.node(s_.reference, s_);
    if (reference_ < 0 || !gather() || !averages()) return;
    taken();
    if (solve(false) || solve(true)) return;
    b_.error(ErrorCode::dependent, s_,
             "too many of its nodes depend on other rigid elements or equations already");
  }

 private:
  Vec3 arm(int node) const { return b_.model.positions[node] - b_.model.positions[reference_]; }

  /// Weights of each node, in basic axes.
  bool gather() {
    std::set<int> others;
    double sum = 0.0;
    for (const int id : s_.nodes) {
      const int node = b_.node(id, s_);
      if (node < 0) return false;
      if (node != reference_ && others.insert(node).second) sum += arm(node).norm();
    }
    const double mean = others.empty() ? 0.0 : sum / static_cast<double>(others.size());
    size_ = mean > 0.0 ? mean : 1.0;
    for (std::size_t i = 0; i < s_.nodes.size(); ++i) {
      const int node = b_.node_of.at(s_.nodes[i]);
      Mat6& W = weights_.try_emplace(node, Mat6::Zero()).first->second;
      const Mat3 T = b_.axes(node);
      for (int c = 0; c < 6; ++c) {
        if (((s_.components[i] >> c) & 1u) == 0 || (c >= 3 && b_.rotates[node] == 0)) continue;
        const int block = c < 3 ? 0 : 3;
        const double w = s_.weights[i] * (c < 3 ? 1.0 : size_ * size_);
        W.block<3, 3>(block, block) += w * T.col(c % 3) * T.col(c % 3).transpose();
      }
    }
    return true;
  }

  /// A_i for q whose rotations are times the size, so that all of it is a length.
  Mat6 motion(int node) const {
    Mat6 A = Mat6::Identity();
    A.block<3, 3>(0, 3) = -skew(arm(node)) / size_;
    A.block<3, 3>(3, 3) /= size_;
    return A;
  }

  /// The rows of d.u_r - d.q, rotations of the reference times the size too.
  bool averages() {
    Mat6 normal = Mat6::Zero();
    for (const auto& [node, W] : weights_) normal += motion(node).transpose() * W * motion(node);
    const SymmetricEigen eigen = symmetric_eigen(normal);
    Mat6 inverse = Mat6::Zero(), known = Mat6::Zero();
    for (int k = 0; k < 6 && eigen.found; ++k) {
      if (!(eigen.values(k) > 1e-9 * eigen.values(5))) continue;
      const Vec6 v = eigen.vectors.col(k);
      inverse += v * v.transpose() / eigen.values(k);
      known += v * v.transpose();
    }
    const Mat3 T = b_.axes(reference_);
    rows_ = std::popcount(s_.mask);
    int row = 0;
    for (int c = 0; c < 6; ++c) {
      if (((s_.mask >> c) & 1u) == 0) continue;
      Vec6 d = Vec6::Zero();
      d.segment<3>(c < 3 ? 0 : 3) = T.col(c % 3);
      if ((known * d - d).norm() > 1e-6)
        return b_.fail(
            ErrorCode::singular, s_,
            "the components of its nodes do not define how component {} of the reference moves",
            c + 1);
      const Vec6 g = inverse * d;
      for (const auto& [node, W] : weights_) {
        const Vec6 share = W * motion(node) * g;
        for (int k = 0; k < 6; ++k)
          if (share(k) != 0.0) column({node, k})(row) -= share(k);
      }
      for (int k = 0; k < 3; ++k)
        if (T(k, c % 3) != 0.0)
          column({reference_, c < 3 ? k : 3 + k})(row) += T(k, c % 3) * (c < 3 ? 1.0 : size_);
      ++row;
    }
    return true;
  }

  VecX& column(const Key& key) {
    return columns_.try_emplace(key, VecX::Zero(rows_)).first->second;
  }

  /// Components that depend on others.
  void taken() {
    for (const Spider& s : b_.model.spiders) {
      if (s.kind != Spider::Kind::rigid) continue;
      for (const int node : s.nodes)
        for (int k = 0; k < 6; ++k)
          if (((s.mask >> k) & 1u) != 0) taken_.insert({node, k});
    }
    for (const LinearEquation& e : b_.model.equations)
      taken_.insert({e.terms.front().node, e.terms.front().axis});
    for (const auto& [block, rows] : b_.equations.blocks())
      for (int k = 0; k < 3; ++k) taken_.insert({block.first, block.second ? 3 + k : k});
  }

  /// Solves the rows for as many dofs, chosen by pivoting. False if these are too few.
  bool solve(bool with_reference) {
    std::vector<Key> keys;
    for (const auto& [key, c] : columns_)
      if ((with_reference || key.first != reference_) && !taken_.contains(key)) keys.push_back(key);
    if (static_cast<int>(keys.size()) < rows_) return false;
    MatX C(rows_, static_cast<Eigen::Index>(keys.size()));
    for (Eigen::Index i = 0; i < C.cols(); ++i)
      C.col(i) = columns_.at(keys[i]) / (keys[i].second < 3 ? 1.0 : size_);
    const PivotedQr qr = pivoted_qr(C);
    if (!(std::abs(qr.diagonal(rows_ - 1)) > 1e-9 * std::abs(qr.diagonal(0)))) return false;
    MatX pivots(rows_, rows_);
    std::vector<Key> solved;
    for (int k = 0; k < rows_; ++k) {
      solved.push_back(keys[qr.pivots(k)]);
      pivots.col(k) = columns_.at(solved.back());
    }
    const LeastNorm inverse(pivots);
    for (const auto& [node, axis] : solved) equations_.push_back({{{node, axis, 1.0}}, s_.at});
    for (const auto& [key, c] : columns_) {
      if (std::find(solved.begin(), solved.end(), key) != solved.end()) continue;
      const VecX f = inverse.solve(c);
      const double unit = key.second < 3 ? 1.0 : size_;
      for (int k = 0; k < rows_; ++k) {
        const double own = solved[k].second < 3 ? 1.0 : size_;
        if (std::abs(f(k)) * own > 1e-14 * unit)
          equations_[k].terms.push_back({key.first, key.second, f(k)});
      }
    }
    for (LinearEquation& e : equations_) b_.model.equations.push_back(std::move(e));
    return true;
  }

  NastranBuild& b_;
  const NastranSpider& s_;
  int reference_ = -1, rows_ = 0;
  double size_ = 1.0;
  std::map<int, Mat6> weights_;
  std::map<Key, VecX> columns_;
  std::set<Key> taken_;
  std::vector<LinearEquation> equations_;
};

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

void build_nastran_mean(NastranBuild& build, const NastranSpider& s) {
  MeanBuilder(build, s).build();
}

}  // namespace floatframe
