#include <algorithm>
#include <cmath>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/full_system.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

struct NodePair {
  int node = -1;
  Mat6 M = Mat6::Zero();
};

/// Blocks of one column of nodes.
void blocks_of(const SparseMatrix& M, const DofTable& table, const std::vector<Dof>& dofs,
               int column, std::vector<NodePair>& blocks) {
  blocks.clear();
  for (int c = 0; c < table.count(column); ++c) {
    std::size_t at = 0;  // rows ascend
    for (SparseMatrix::InnerIterator it(M, table.index(column, c)); it; ++it) {
      const Dof& row = dofs[it.row()];
      while (at < blocks.size() && blocks[at].node < row.node) ++at;
      if (at == blocks.size() || blocks[at].node != row.node) {
        blocks.insert(blocks.begin() + static_cast<std::ptrdiff_t>(at), {row.node, Mat6::Zero()});
      }
      blocks[at].M(row.axis, c) = it.value();
    }
  }
}

/// Velocities of the points 0 (the node) and 1..3 (at h e_k) are v and v + h omega x e_k, so masses
/// m(k, l) between the points of two nodes have
///   M_tt = mu I,  M_tr = -h skew(s_b),  M_rt = h skew(s_a),  M_rr = h^2 (tr(P) I - P^T)
/// with mu = sum m, s_b(l) = sum_k m(k, l), s_a(k) = sum_l m(k, l), P(k, l) = m(k, l).
struct PointMasses {
  double mu = 0.0;
  Vec3 s_a = Vec3::Zero(), s_b = Vec3::Zero();
  Mat3 P = Mat3::Zero();

  PointMasses(const Mat6& M, double h) {
    const auto axial = [](const Mat3& A) {
      return Vec3(0.5 * Vec3(A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)));
    };
    mu = M.topLeftCorner<3, 3>().trace() / 3.0;
    s_b = -axial(M.topRightCorner<3, 3>()) / h;
    s_a = axial(M.bottomLeftCorner<3, 3>()) / h;
    const Mat3 rotary = M.bottomRightCorner<3, 3>() / (h * h);
    P = 0.5 * rotary.trace() * Mat3::Identity() - rotary.transpose();
  }

  /// What of the block is not represented, as a mass: rotations times h.
  double deviation(const Mat6& M, double h) const {
    Mat6 D = Mat6::Zero();  // M_rr is exact
    D.topLeftCorner<3, 3>() = M.topLeftCorner<3, 3>() - mu * Mat3::Identity();
    D.topRightCorner<3, 3>() = M.topRightCorner<3, 3>() / h + skew(s_b);
    D.bottomLeftCorner<3, 3>() = M.bottomLeftCorner<3, 3>() / h - skew(s_a);
    return D.cwiseAbs().maxCoeff();
  }
};

/// Length of the arms that carry rotary inertia: about the size of the part, so that no digits are
/// lost whatever that is; a power of two, so that a part about 1 m large has arms of 1 m.
double arm_length(const FeModel& model) {
  Eigen::AlignedBox3d box;
  for (const Element& e : model.elements)
    for (int a = 0; a < element_kernel(e.type).nodes; ++a) box.extend(model.positions[e.nodes[a]]);
  if (box.isEmpty())
    for (const Vec3& p : model.positions) box.extend(p);
  const double size = box.isEmpty() ? 0.0 : box.diagonal().norm();
  return size > 0.0 ? std::exp2(std::round(std::log2(size))) : 1.0;
}

/// Where the three points on the arms of each node begin, behind those of the nodes: only nodes
/// whose rotation carries mass have them; -1 without.
std::vector<int> arm_points(const DofTable& table, const SparseMatrix& M, int nodes, int& points) {
  std::vector<int> extra(nodes, -1);
  points = nodes;
  for (int k = 0; k < nodes; ++k) {
    bool heavy = false;
    for (int axis = 3; axis < table.count(k); ++axis) {
      for (SparseMatrix::InnerIterator it(M, table.index(k, axis)); it; ++it) {
        heavy = heavy || it.value() != 0.0;
      }
    }
    if (!heavy) continue;
    extra[k] = points;
    points += 3;
  }
  return extra;
}

/// Scalar masses between the points of nodes a and b, that of the nodes themselves last.
void add_masses(const PointMasses& m, int a, int b, int ea, int eb,
                std::vector<Eigen::Triplet<double>>& masses) {
  double rest = m.mu;
  for (int l = 0; l < 3 && eb >= 0; ++l) {
    const double value = m.s_b(l) - (ea >= 0 ? m.P.col(l).sum() : 0.0);
    masses.emplace_back(a, eb + l, value);
    rest -= value;
  }
  for (int k = 0; k < 3 && ea >= 0; ++k) {
    const double value = m.s_a(k) - (eb >= 0 ? m.P.row(k).sum() : 0.0);
    masses.emplace_back(ea + k, b, value);
    rest -= value;
    for (int l = 0; l < 3 && eb >= 0; ++l) {
      masses.emplace_back(ea + k, eb + l, m.P(k, l));
      rest -= m.P(k, l);
    }
  }
  masses.emplace_back(a, b, rest);
}

/// Displacements of all points from those of the independent degrees of freedom.
SparseRows motion_of_points(const FeSystem& system, const std::vector<int>& extra, int points,
                            double h) {
  std::vector<Eigen::Triplet<double>> motion;
  const auto copy = [&](const SparseRows& from, int row, int to, double factor) {
    for (SparseRows::InnerIterator it(from, row); it; ++it) {
      motion.emplace_back(to, static_cast<int>(it.col()), factor * it.value());
    }
  };
  for (int k = 0; k < static_cast<int>(extra.size()); ++k) {
    const int e = extra[k];
    for (int i = 0; i < 3; ++i) {
      copy(system.T, 3 * k + i, 3 * k + i, 1.0);
      for (int j = 0; j < 3 && e >= 0; ++j) {
        const int row = 3 * (e + j) + i;
        copy(system.T, 3 * k + i, row, 1.0);
        const Mat3 S = -h * skew(Vec3::Unit(j));  // theta x h e_j
        for (int c = 0; c < 3; ++c) {
          if (S(i, c) != 0.0) copy(system.T_theta, 3 * k + c, row, S(i, c));
        }
      }
    }
  }
  SparseRows T(3 * points, system.size());
  T.setFromTriplets(motion.begin(), motion.end());
  return T;
}

}  // namespace

PointModel point_model(const FeModel& model, const FeSystem& system, Integration integration) {
  const DofTable table = dof_table(model);
  const SparseMatrix M = full_mass(model, table, integration);
  const int nodes = model.nodes();
  std::vector<Dof> dofs;
  for (int k = 0; k < nodes; ++k) {
    for (int axis = 0; axis < table.count(k); ++axis) dofs.push_back({k, axis});
  }
  int points = 0;
  const std::vector<int> extra = arm_points(table, M, nodes, points);
  PointModel out;
  const double h = arm_length(model);
  out.p.resize(3, points);
  for (int k = 0; k < nodes; ++k) {
    const Vec3& p = model.positions[k];
    out.p.col(k) = p;
    const int e = extra[k];
    for (int i = 0; i < 3 && e >= 0; ++i) out.p.col(e + i) = p + h * Vec3::Unit(i);
  }

  std::vector<Eigen::Triplet<double>> masses;
  std::vector<NodePair> blocks;
  double deviation = 0.0, largest = 0.0;
  for (int b = 0; b < nodes; ++b) {
    blocks_of(M, table, dofs, b, blocks);
    for (const NodePair& block : blocks) {
      const PointMasses m(block.M, h);
      largest = std::max(largest, block.M.topLeftCorner<3, 3>().cwiseAbs().maxCoeff());
      deviation = std::max(deviation, m.deviation(block.M, h));
      add_masses(m, block.node, b, extra[block.node], extra[b], masses);
    }
  }
  out.M_s.resize(points, points);
  out.M_s.setFromTriplets(masses.begin(), masses.end());
  out.anisotropy = largest > 0.0 ? deviation / largest : 0.0;
  out.T = motion_of_points(system, extra, points, h);
  return out;
}

}  // namespace floatframe
