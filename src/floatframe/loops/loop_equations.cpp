#include "floatframe/loops/loop_equations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "floatframe/math/dense.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/joint_measure.hpp"

namespace floatframe {
namespace {

/// Bodies lighter than this fraction of the mean, or without inertia, count as if they had it.
constexpr double least_share = 1e-4;
/// Amplitudes change last: as if the modes were heavier by this factor.
constexpr double elastic_cost = 100.0;

/// Bodies at both ends of loop closures: joints outside of the tree, and elements that hold two
/// bodies.
std::vector<std::array<int, 3>> closing_edges(const RelativeFormulation& f) {
  const Model& model = f.model();
  std::vector<char> in_tree(model.joints.size(), 0);
  for (const TreeBody& b : f.tree().bodies()) in_tree[b.joint] = 1;
  std::vector<std::array<int, 3>> edges;  // joint or -1, bodies
  int j = -1;
  for (const Joint& joint : model.joints)
    if (!in_tree[++j] && (!joint_is_free(joint.type) || !joint.position.empty()))
      edges.push_back({j, joint.parent, joint.child});
  for (const Element& e : model.elements)
    if (e.links())
      for (std::size_t i = 1; i < e.markers.size(); ++i)
        edges.push_back({-1, model.markers[e.markers[0]].body, model.markers[e.markers[i]].body});
  return edges;
}

}  // namespace

LoopMembers loop_members(const RelativeFormulation& f) {
  const std::vector<TreeBody>& bodies = f.tree().bodies();
  LoopMembers m;
  m.joint.assign(f.model().joints.size(), 0);
  m.body.assign(bodies.size(), 0);
  std::vector<int> depth(bodies.size(), 0);
  for (const int i : f.tree().order())
    depth[i] = bodies[i].parent < 0 ? 1 : depth[bodies[i].parent] + 1;
  const auto depth_of = [&](int body) { return body < 0 ? 0 : depth[body]; };
  for (const ConstraintPart& p : f.constraint_set().parts()) {
    if (p.coordinate < 0) continue;
    m.any = true;
    m.add(f.model(), p.owner.joint);
  }
  for (const auto& [joint, a, b] : closing_edges(f)) {
    if (a == b) continue;
    m.any = true;
    if (joint >= 0) m.joint[joint] = 1;
    // Up both branches to their common body.
    for (int x = a, y = b; x != y;) {
      int& lower = depth_of(x) >= depth_of(y) ? x : y;
      m.body[lower] = 1;
      m.joint[bodies[lower].joint] = 1;
      lower = bodies[lower].parent;
    }
  }
  return m;
}

std::vector<LoopValue> loop_values(const RelativeFormulation& f, const LoopMembers& members,
                                   bool rates) {
  std::vector<LoopValue> values;
  int j = -1;
  for (const Joint& joint : f.model().joints) {
    ++j;
    // A prescribed motion fixes its coordinate.
    if (!members.joint[j] || joint.motion >= 0) continue;
    const JointKind& kind = joint_kind(joint.type);
    const std::vector<double>& given = rates ? joint.velocity : joint.position;
    for (int k = 0; k < std::ssize(given); ++k) {
      if (f.model().motion_of(joint, k)) continue;
      LoopValue v{j, -1, k, 1, Vec3(given[k], 0.0, 0.0), joint.keep};
      v.angle = kind.coordinates.all()[k].unit == JointUnit::rad;
      if (rates && joint_is_free(joint.type) && joint.parent < 0 && k < 3)
        v.given[0] += f.model().simulation.velocity[k];
      if (!rates && k == kind.rotation_vector) {
        v.count = 3;
        v.given = Vec3(given[k], given[k + 1], given[k + 2]);
        k += 2;
      }
      values.push_back(v);
    }
  }
  const std::vector<VecX>& amplitudes = rates ? f.model().amplitude_rates : f.model().amplitudes;
  for (int i = 0; i < std::ssize(amplitudes); ++i)
    for (int k = 0; k < amplitudes[i].size() && members.body[i]; ++k)
      values.push_back({-1, i, k, 1, Vec3(amplitudes[i][k], 0.0, 0.0)});
  return values;
}

double measured(const RelativeFormulation& f, const LoopValue& v, double reference) {
  if (v.joint < 0) return f.tree().body(v.body).y[v.component];
  const Joint& joint = f.model().joints[v.joint];
  return joint_position(joint, f.marker(joint.frame_F), f.marker(joint.frame_M), v.component,
                        reference);
}

double measured_rate(const RelativeFormulation& f, const LoopValue& v, int k) {
  if (v.joint < 0) return f.tree().body(v.body).yd[v.component];
  const Joint& joint = f.model().joints[v.joint];
  return joint_velocity(joint, f.marker(joint.frame_F), f.marker(joint.frame_M), v.component + k);
}

LoopEquations::LoopEquations(RelativeFormulation& f, const LoopMembers& members,
                             std::vector<LoopValue> values, LoopMoves moves, bool keeps)
    : f_(f), values_(std::move(values)) {
  double mass = 0.0, length = 0.0, count = 0.0;
  for (std::size_t i = 0; i < members.body.size(); ++i) {
    if (!members.body[i]) continue;
    mass += f.model().bodies[i].data->invariants.m;
    length = std::max(length, f.model().bodies[i].length);
    count += 1.0;
  }
  const double least_mass = mass > 0.0 ? least_share * mass / count : 1.0;
  scale_ = std::sqrt(mass > 0.0 ? mass : 1.0) * length;
  for (const LoopValue& v : values_)
    for (int k = 0; k < v.count; ++k) {
      value_holds_.push_back(moves != LoopMoves::values || (v.kept && keeps));
      value_scale_.push_back(v.angle ? length : 1.0);
    }
  for (int i = 0; i < f.tree().body_count(); ++i) {
    const TreeBody& b = f.tree().body(i);
    if (members.body[i]) add_body(i, least_mass, least_mass * length * length);
    if (members.joint[b.joint])
      for (int k = 0; k < b.nj; ++k) mobile_.push_back(b.iv + k);
    const bool given = std::any_of(values_.begin(), values_.end(),
                                   [&](const LoopValue& v) { return v.body == i; });
    if (members.body[i] && (given || moves != LoopMoves::joints))
      for (int k = 0; k < b.nm; ++k) mobile_.push_back(b.iy + k);
  }
  begin_here();
}

void LoopEquations::add_body(int body, double least_mass, double least_inertia) {
  const Body& b = f_.model().bodies[body];
  const InertiaInvariants& v = b.data->invariants;
  BodyShape s{body,
              rows_,
              std::sqrt(v.m + least_mass),
              v.centre_of_mass(),
              Mat3::Zero(),
              VecX::Zero(b.modes())};
  const SymmetricEigen e =
      symmetric_eigen(v.P_u - v.m * s.c_B * s.c_B.transpose() + least_inertia * Mat3::Identity());
  for (int k = 0; k < 3; ++k)
    s.U_B.col(k) = std::sqrt(std::max(e.values[k], least_inertia)) * e.vectors.col(k);
  for (int k = 0; k < b.modes(); ++k) {
    double most = 0.0;
    for (const ModalNode& node : b.data->nodes) most = std::max(most, node.X.col(k).norm());
    s.mode_costs[k] = elastic_cost * s.root_mass * (most > 0.0 ? most : b.length);
  }
  rows_ += 12 + s.mode_costs.size();
  bodies_.push_back(std::move(s));
}

VecX LoopEquations::shape() const {
  VecX x(rows_);
  const SystemMotion& motion = f_.motion();
  for (const BodyShape& s : bodies_) {
    const BodyKinematics& b = motion.body(s.body);
    const Mat3& R = b.R_WB;
    x.segment<3>(s.row) = s.root_mass * (b.p_WB + R * s.c_B);
    const Mat3 U = R * s.U_B;
    for (int k = 0; k < 3; ++k) x.segment<3>(s.row + 3 + 3 * k) = U.col(k);
    x.segment(s.row + 12, s.mode_costs.size()) = s.mode_costs.cwiseProduct(b.y);
  }
  return x;
}

void LoopEquations::begin_here() { shape_0_ = shape(); }

VecX LoopEquations::displacement() const { return shape() - shape_0_; }

void LoopEquations::fill_column(Eigen::Index column, int coordinate) {
  f_.velocities(VecX::Unit(f_.velocities(), coordinate));
  const SystemMotion& motion = f_.motion();
  for (const BodyShape& s : bodies_) {
    const BodyKinematics& b = motion.body(s.body);
    const Mat3& R = b.R_WB;
    const Vec3& w = b.w_WB;
    A_.col(column).segment<3>(s.row) = s.root_mass * (b.v_WB + w.cross(R * s.c_B));
    for (int k = 0; k < 3; ++k)
      A_.col(column).segment<3>(s.row + 3 + 3 * k) = w.cross(R * s.U_B.col(k));
    A_.col(column).segment(s.row + 12, s.mode_costs.size()) = s.mode_costs.cwiseProduct(b.yd);
  }
  Eigen::Index row = 0;
  for (const LoopValue& v : values_) {
    for (int k = 0; k < v.count; ++k) G_(row++, column) = measured_rate(f_, v, k);
  }
}

void LoopEquations::evaluate(const VecX& open, const std::vector<char>& counts, const VecX& off,
                             const VecX& v) {
  const Eigen::Index n = unknowns();
  A_ = MatX::Zero(rows_, n);
  G_ = MatX::Zero(off.size(), n);
  for (Eigen::Index j = 0; j < n; ++j) fill_column(j, mobile_[j]);
  f_.velocities(v);
  const MatX J = f_.constraint_jacobian();
  const Eigen::Index held = std::count(value_holds_.begin(), value_holds_.end(), 1);
  J_ = MatX::Zero(open.size() + held, n);
  r_ = VecX::Zero(J_.rows());
  wishes_ = MatX::Zero(off.size() - held, n);
  missed_ = VecX::Zero(wishes_.rows());
  for (Eigen::Index i = 0; i < open.size(); ++i) {
    if (!counts[i]) continue;
    J_.row(i) = J(i, mobile_);
    r_[i] = open[i];
  }
  Eigen::Index hold = open.size(), wish = 0;
  for (Eigen::Index i = 0; i < off.size(); ++i) {
    const bool holds = value_holds_[i];
    (holds ? J_.row(hold) : wishes_.row(wish)) = value_scale_[i] * G_.row(i);
    (holds ? r_[hold++] : missed_[wish++]) = value_scale_[i] * off[i];
  }
}

VecX LoopEquations::moved(const VecX& x) const {
  const VecX own = x(mobile_);
  return A_ * own;
}

LoopEquations::Step LoopEquations::step(const VecX& along, const VecX* d) const {
  const Eigen::Index n = unknowns();
  Step s{along, 0, 0};
  if (n == 0) return s;
  VecX x = along(mobile_);
  // x + W y with |A W y| = |y|.
  const auto& [Q_A, W] = orthonormal_columns(A_);
  const MatX JW = J_ * W;
  const VecX left = r_ + J_ * x;
  VecX y = VecX::Zero(n);
  MatX N = MatX::Identity(n, n);
  if (JW.rows() > 0) {
    const PivotedQr qr = pivoted_qr(JW.transpose(), 1e-11);
    s.rank = qr.rank;
    const MatX Q = qr.Q.leftCols(qr.rank);
    if (qr.rank > 0) y = Q * qr_solve(JW * Q, -left);
    N = qr.Q.rightCols(n - qr.rank);
  }
  if (wishes_.rows() > 0 && N.cols() > 0) {
    // Values that may change: satisfied as closely as possible, before any other criterion for the
    // remaining freedom.
    const MatX C = wishes_ * W;
    const MatX CN = C * N;
    const double most = CN.rowwise().norm().maxCoeff(), zero = 1e-8 * C.norm();
    if (most > zero) {
      const PivotedQr qr = pivoted_qr(CN.transpose(), zero / most);
      const MatX Q = qr.Q.leftCols(qr.rank);
      y += N * (Q * qr_solve(CN * Q, -(missed_ + wishes_ * x + C * y)));
      N = (N * qr.Q.rightCols(N.cols() - qr.rank)).eval();
    }
  }
  s.free = N.cols();
  if (s.free > 0 && d != nullptr) y -= N * (N.transpose() * (y + Q_A.transpose() * (*d + A_ * x)));
  x += W * y;
  s.x(mobile_) = x;
  return s;
}

VecX LoopEquations::nearest() const {
  constexpr double firm = 1e4, slow = 1e-3;
  const Eigen::Index n = unknowns(), values = std::ssize(value_holds_);
  if (n == 0) return VecX::Zero(f_.velocities());
  MatX H(J_.rows() + n, n);
  H << J_, slow * MatX::Identity(n, n);
  VecX b = VecX::Zero(H.rows());
  b.head(r_.size()) = -r_;
  H.middleRows(J_.rows() - values, values) *= firm;
  b.segment(J_.rows() - values, values) *= firm;
  VecX x = VecX::Zero(f_.velocities());
  x(mobile_) = qr_solve(H, b);
  return x;
}

}  // namespace floatframe
