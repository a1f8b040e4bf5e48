#include <algorithm>
#include <cmath>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/full_system.hpp"
#include "floatframe/fe/rigid_leaders.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

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

  /// The part of the block that is not represented, as a mass: rotations times h.
  double deviation(const Mat6& M, double h) const {
    Mat6 D = Mat6::Zero();  // M_rr is exact
    D.topLeftCorner<3, 3>() = M.topLeftCorner<3, 3>() - mu * Mat3::Identity();
    D.topRightCorner<3, 3>() = M.topRightCorner<3, 3>() / h + skew(s_b);
    D.bottomLeftCorner<3, 3>() = M.bottomLeftCorner<3, 3>() / h - skew(s_a);
    return D.cwiseAbs().maxCoeff();
  }
};

/// Length of the arms that carry rotary inertia: about the size of the part, which preserves
/// accuracy at any size; a power of two, so that a part about 1 m large has arms of 1 m.
double arm_length(const FeModel& model) {
  Eigen::AlignedBox3d box;
  for (const FeElement& e : model.elements)
    for (int a = 0; a < element_kernel(e.type).nodes; ++a) box.extend(model.positions[e.nodes[a]]);
  if (box.isEmpty())
    for (const Vec3& p : model.positions) box.extend(p);
  const double size = box.isEmpty() ? 0.0 : box.diagonal().norm();
  return size > 0.0 ? std::exp2(std::round(std::log2(size))) : 1.0;
}

/// Index of the first of the three points on the arms of each node, after those of the nodes: only
/// nodes with rotary mass have them; -1 otherwise.
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

/// Scalar masses between the points of nodes a and b, last that of the nodes themselves.
void add_masses(const PointMasses& m, int a, int b, int ea, int eb, Triplets& masses) {
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

/// Three rows of `to` from `row` on get factor times the three rows of a node.
void add_rows(const SparseRows& from, int node, const Mat3& factor, int row, Triplets& to) {
  for (int j = 0; j < 3; ++j)
    for (SparseRows::InnerIterator it(from, 3 * node + j); it; ++it)
      for (int i = 0; i < 3; ++i)
        if (factor(i, j) != 0.0)
          to.emplace_back(row + i, static_cast<int>(it.col()), factor(i, j) * it.value());
}

/// Rotating nodes, and those fixed to them.
class Turning {
 public:
  Turning(const FeModel& model, const FeSystem& system, PointModel& out)
      : model_(model),
        system_(system),
        out_(out),
        leaders_(rigid_leaders(model, system)),
        rotation_(model.positions.size(), -1),
        strained_(model.positions.size(), 0) {
    for (const FeElement& e : model.elements) {
      const ElementKernel& kernel = element_kernel(e.type);
      for (int a = 0; kernel.dofs_per_node == 3 && a < kernel.nodes; ++a) strained_[e.nodes[a]] = 1;
    }
  }

  /// Index for a node; -1: none.
  int rotation_of(int node) {
    while (leaders_[node] >= 0 && turn_alike(system_, node, leaders_[node])) node = leaders_[node];
    int& rotation = rotation_[node];
    if (rotation < 0 && system_.T_theta.middleRows(3 * node, 3).nonZeros() > 0) {
      rotation = new_rotation();
      add_rows(system_.T_theta, node, Mat3::Identity(), 3 * rotation, rows_);
    }
    return rotation;
  }
  int rotation_of(const MassStation& station, const FeElement& e) {
    const int rotation = new_rotation();
    for (Eigen::Index k = 0; k < station.shares.size(); ++k) {
      const int node = e.nodes[static_cast<std::size_t>(k)];
      add_rows(system_.T, node, station.theta.middleCols<3>(6 * k), 3 * rotation, rows_);
      add_rows(system_.T_theta, node, station.theta.middleCols<3>(6 * k + 3), 3 * rotation, rows_);
    }
    return rotation;
  }

  void add(int point, int rotation, const Vec3& arm) {
    if (rotation >= 0) add_to(out_.arms, point, rotation, arm);
  }
  /// Motion of a point from the node that it moves with, which may be fixed to others.
  void add_fixed(int point, int node, double share) {
    std::vector<PointArm>& to = strained_[node] != 0 ? out_.strained_arms : out_.arms;
    each_leader(node,
                [&](int rotation, const Vec3& arm) { add_to(to, point, rotation, share * arm); });
  }
  void add_followers() {
    for (int k = 0; k < model_.nodes(); ++k)
      each_leader(k,
                  [&](int rotation, const Vec3& arm) { add_to(out_.followers, k, rotation, arm); });
  }
  void finish() {
    out_.rotations.resize(3 * rotations_, system_.size());
    out_.rotations.setFromTriplets(rows_.begin(), rows_.end());
  }

 private:
  int new_rotation() { return rotations_++; }

  template <class Use>
  void each_leader(int node, Use&& use) {
    for (int k = node; leaders_[k] >= 0; k = leaders_[k]) {
      const Vec3 arm = model_.positions[k] - model_.positions[leaders_[k]];
      const int rotation = rotation_of(leaders_[k]);
      if (rotation >= 0 && !arm.isZero(0.0)) use(rotation, arm);
    }
  }

  /// Points are visited in order.
  static void add_to(std::vector<PointArm>& arms, int point, int rotation, const Vec3& arm) {
    for (auto it = arms.rbegin(); it != arms.rend() && it->point == point; ++it)
      if (it->rotation == rotation) {
        it->arm += arm;
        return;
      }
    arms.push_back({point, rotation, arm});
  }

  const FeModel& model_;
  const FeSystem& system_;
  PointModel& out_;
  std::vector<int> leaders_, rotation_;
  std::vector<char> strained_;  // nodes of elements without rotations
  Triplets rows_;
  int rotations_ = 0;
};

class PointBuilder {
 public:
  PointBuilder(const FeModel& model, const FeSystem& system, PointModel& out)
      : model_(model),
        system_(system),
        out_(out),
        turning_(model, system, out),
        h_(arm_length(model)),
        positions_(model.positions) {}

  void add_nodes(const SparseMatrix& M, const DofTable& table);
  void add_stations(Integration integration);
  void finish();

 private:
  int add_point(const Vec3& p) {
    positions_.push_back(p);
    return static_cast<int>(positions_.size()) - 1;
  }
  void add_arms_of_nodes(const std::vector<int>& extra, const std::vector<char>& heavy);
  void add_station(const MassStation& station, const FeElement& e);

  const FeModel& model_;
  const FeSystem& system_;
  PointModel& out_;
  Turning turning_;
  double h_;
  std::vector<Vec3> positions_;
  Triplets masses_, motion_;
};

void PointBuilder::add_nodes(const SparseMatrix& M, const DofTable& table) {
  const int nodes = model_.nodes();
  std::vector<Dof> dofs;
  for (int k = 0; k < nodes; ++k)
    for (int axis = 0; axis < table.count(k); ++axis) dofs.push_back({k, axis});
  int points = 0;
  const std::vector<int> extra = arm_points(table, M, nodes, points);
  out_.rotary = points > nodes;
  std::vector<NodePair> blocks;
  std::vector<char> heavy(model_.positions.size(), 0);
  double deviation = 0.0, largest = 0.0;
  for (int b = 0; b < nodes; ++b) {
    blocks_of(M, table, dofs, b, blocks);
    heavy[b] = blocks.empty() ? 0 : 1;
    for (const NodePair& block : blocks) {
      const PointMasses m(block.M, h_);
      largest = std::max(largest, block.M.topLeftCorner<3, 3>().cwiseAbs().maxCoeff());
      deviation = std::max(deviation, m.deviation(block.M, h_));
      add_masses(m, block.node, b, extra[block.node], extra[b], masses_);
    }
  }
  out_.anisotropy = largest > 0.0 ? deviation / largest : 0.0;
  add_arms_of_nodes(extra, heavy);
}

void PointBuilder::add_arms_of_nodes(const std::vector<int>& extra,
                                     const std::vector<char>& heavy) {
  for (int k = 0; k < model_.nodes(); ++k) {
    add_rows(system_.T, k, Mat3::Identity(), 3 * k, motion_);
    if (heavy[k] != 0) turning_.add_fixed(k, k, 1.0);
  }
  for (int k = 0; k < model_.nodes(); ++k) {
    for (int i = 0; i < 3 && extra[k] >= 0; ++i) {
      const Vec3 arm = h_ * Vec3::Unit(i);
      const int point = add_point(model_.positions[k] + arm);
      add_rows(system_.T, k, Mat3::Identity(), 3 * point, motion_);
      add_rows(system_.T_theta, k, -skew(arm), 3 * point, motion_);
      turning_.add_fixed(point, k, 1.0);
      turning_.add(point, turning_.rotation_of(k), arm);
    }
  }
}

void PointBuilder::add_stations(Integration integration) {
  std::vector<MassStation> stations;
  for (const FeElement& e : model_.elements) {
    if (!has_mass_stations(e)) continue;
    element_kernel(e.type).mass_stations(gather(model_, e, integration), stations);
    for (const MassStation& station : stations) add_station(station, e);
  }
}

void PointBuilder::add_station(const MassStation& station, const FeElement& e) {
  Vec3 p = Vec3::Zero();
  for (Eigen::Index k = 0; k < station.shares.size(); ++k)
    p += station.shares(k) * model_.positions[e.nodes[static_cast<std::size_t>(k)]];
  const int rotation = station.moments.isZero(0.0) ? -1 : turning_.rotation_of(station, e);
  out_.rotary = out_.rotary || rotation >= 0;
  const auto add = [&](const Vec3& arm) {
    const int point = add_point(p + arm);
    const MatX u = station.u - skew(arm) * station.theta;
    for (Eigen::Index k = 0; k < station.shares.size(); ++k) {
      const int node = e.nodes[static_cast<std::size_t>(k)];
      add_rows(system_.T, node, u.middleCols<3>(6 * k), 3 * point, motion_);
      add_rows(system_.T_theta, node, u.middleCols<3>(6 * k + 3), 3 * point, motion_);
      turning_.add_fixed(point, node, station.shares(k));
    }
    if (!arm.isZero(0.0)) turning_.add(point, rotation, arm);
    return point;
  };
  const int centre = add(Vec3::Zero());
  masses_.emplace_back(centre, centre, station.mass);
  for (int i = 0; i < 3; ++i) {
    const double m = station.moments(i) / (h_ * h_);
    if (m == 0.0) continue;
    const int point = add(h_ * station.axes.col(i));
    masses_.emplace_back(centre, centre, m);
    masses_.emplace_back(point, point, m);
    masses_.emplace_back(centre, point, -m);
    masses_.emplace_back(point, centre, -m);
  }
}

void PointBuilder::finish() {
  turning_.add_followers();
  turning_.finish();
  const auto points = static_cast<Eigen::Index>(positions_.size());
  out_.p.resize(3, points);
  for (Eigen::Index k = 0; k < points; ++k) out_.p.col(k) = positions_[static_cast<std::size_t>(k)];
  out_.M_s.resize(points, points);
  out_.M_s.setFromTriplets(masses_.begin(), masses_.end());
  out_.T.resize(3 * points, system_.size());
  out_.T.setFromTriplets(motion_.begin(), motion_.end());
}

}  // namespace

PointModel point_model(const FeModel& model, const FeSystem& system, Integration integration) {
  PointModel out;
  PointBuilder builder(model, system, out);
  {
    const DofTable table = dof_table(model);
    SparseMatrix M = mass_without_stations(model, table, integration);
    if (model.matrices && !model.matrices->scalars.empty()) {
      std::vector<char> point(M.rows(), 1);
      for (const int node : model.matrices->scalars)
        std::fill_n(point.begin() + table.begin[node], table.count(node), 0);
      M.prune([&](Eigen::Index i, Eigen::Index j, double) { return point[i] && point[j]; });
    }
    builder.add_nodes(M, table);
  }
  builder.add_stations(integration);
  builder.finish();
  return out;
}

}  // namespace floatframe
