#include "floatframe/simulation/least_reactions.hpp"

#include <cmath>
#include <numeric>

#include "floatframe/formulation/relative.hpp"

namespace floatframe {

namespace {

/// Columns of J that are shorter than this, relative to the longest, are zero.
constexpr double no_column = 1e-7;

std::vector<int> every_joint(const Model& model) {
  std::vector<int> joints(model.joints.size());
  std::iota(joints.begin(), joints.end(), 0);
  return joints;
}

bool is_motion(const ConstraintPart& part) noexcept { return part.motion != nullptr; }

/// What lambda scaled by this is the force or torque along the coordinate of a motion.
double motion_scale(const ConstraintPart& part) noexcept {
  return constraint_kind(part.type).angle ? -part.scale : -1.0;
}

/// x := A^-1 x for the leading n x n of a positive definite A, by Cholesky.
void solve_small(Mat6& A, int n, Vec6& x) noexcept {
  for (int j = 0; j < n; ++j) {
    for (int k = 0; k < j; ++k)
      for (int i = j; i < n; ++i) A(i, j) -= A(i, k) * A(j, k);
    const double pivot = A(j, j) > 0.0 ? std::sqrt(A(j, j)) : 1.0;
    for (int i = j; i < n; ++i) A(i, j) /= pivot;
  }
  for (int j = 0; j < n; ++j) {
    for (int k = 0; k < j; ++k) x[j] -= A(j, k) * x[k];
    x[j] /= A(j, j);
  }
  for (int j = n; j-- > 0;) {
    for (int k = j + 1; k < n; ++k) x[j] -= A(k, j) * x[k];
    x[j] /= A(j, j);
  }
}

}  // namespace

template <class F>
LeastReactions<F>::LeastReactions(const Model& model)
    : model_(model), all_(model, every_joint(model)) {
  all_.number_rows(0);
  int columns = 0;
  for (const Body& b : model.bodies) {
    column_.push_back(columns);
    columns += 6 + b.modes();
    VecX scale = VecX::Ones(b.modes());
    for (Eigen::Index k = 0; k < scale.size(); ++k) {
      double most = 0.0;
      for (const ModalNode& node : b.data->nodes) most = std::max(most, node.X.col(k).norm());
      if (most > 0.0) scale[k] = 1.0 / most;
    }
    mode_scale_.push_back(scale);
  }
  U_ = MatX::Zero(rows(), columns);
  lengths_ = VecX::Zero(columns);
  projected_ = VecX::Zero(columns);
}

template <class F>
void LeastReactions<F>::add_column_block(int row, const F& f, int marker, const Vec3& force,
                                         const Vec3& torque) noexcept {
  const LocalMarker& m = f.local_marker(marker);
  if (m.body < 0) return;
  const int c = column_[m.body];
  const Vec3 arm = f.body_rotation(m.body) * m.p_B;
  const Vec3 moment = (arm.cross(force) + torque) / model_.bodies[m.body].length;
  for (int k = 0; k < 3; ++k) {
    U_(row, c + k) += force[k];
    U_(row, c + 3 + k) += moment[k];
  }
  if (!m.local) return;
  const VecX& scale = mode_scale_[m.body];
  for (int k = 0; k < static_cast<int>(scale.size()); ++k) {
    double x = m.Jr.col(k).dot(force);
    if (m.rotates) x += m.Jw.col(k).dot(torque);
    U_(row, c + 6 + k) += scale[k] * x;
  }
}

template <class F>
void LeastReactions<F>::place(const F& f, double t) noexcept {
  all_.evaluate(t, [&](int marker) -> const MarkerState& { return f.marker(marker); });
  U_.setZero();
  for (std::size_t k = 0; k < all_.parts().size(); ++k) {
    const ConstraintPart& p = all_.parts()[k];
    for (int r = 0; r < p.rows(); ++r) {
      const int row = all_.offset(k) + r;
      const WrenchRow& g = all_.row(row).gradient;
      add_column_block(row, f, p.a, g.Fa, g.Ta);
      add_column_block(row, f, p.b, g.Fb, g.Tb);
    }
  }
  orthonormalise();
}

template <class F>
void LeastReactions<F>::orthonormalise() noexcept {
  const Eigen::Index n = U_.cols(), most = std::min(U_.rows(), n);
  for (Eigen::Index j = 0; j < n; ++j) lengths_[j] = U_.col(j).norm();
  const double longest = n > 0 ? lengths_.maxCoeff() : 0.0;
  rank_ = 0;
  while (rank_ < most) {
    Eigen::Index next = rank_;
    for (Eigen::Index j = rank_; j < n; ++j)
      if (lengths_[j] > lengths_[next]) next = j;
    if (!(lengths_[next] > no_column * longest)) break;
    if (next != rank_) {
      U_.col(rank_).swap(U_.col(next));
      std::swap(lengths_[rank_], lengths_[next]);
    }
    for (Eigen::Index j = 0; j < rank_; ++j)
      U_.col(rank_) -= U_.col(j).dot(U_.col(rank_)) * U_.col(j);
    U_.col(rank_) /= U_.col(rank_).norm();
    for (Eigen::Index j = rank_ + 1; j < n; ++j) {
      U_.col(j) -= U_.col(rank_).dot(U_.col(j)) * U_.col(rank_);
      lengths_[j] = U_.col(j).norm();
    }
    ++rank_;
  }
}

template <class F>
void LeastReactions<F>::multipliers(const Reactions& reactions, VecX& lambda) noexcept {
  lambda.setZero();
  std::size_t k = 0;
  const std::size_t parts = all_.parts().size();
  // Motions and rods first: a joint's wrench holds that of its motion.
  for (k = 0; k < parts; ++k) {
    const ConstraintPart& p = all_.parts()[k];
    if (p.owner.kind == ConstraintOwner::Kind::rod)
      lambda[all_.offset(k)] = reactions.tensions[p.owner.index];
    else if (is_motion(p))
      lambda[all_.offset(k)] = reactions.motions[p.owner.index] / motion_scale(p);
  }
  for (k = 0; k < parts;) {
    const ConstraintPart& first = all_.parts()[k];
    if (first.owner.kind == ConstraintOwner::Kind::rod || is_motion(first)) {
      ++k;
      continue;
    }
    // The parts of a joint follow each other: J_k^T lambda_k = -wrench of them, by the normal
    // equations of its at most six rows.
    const int joint = first.owner.index, row = all_.offset(k);
    int n = 0;
    while (k < parts && all_.parts()[k].owner.kind == ConstraintOwner::Kind::joint &&
           all_.parts()[k].owner.index == joint && !is_motion(all_.parts()[k]))
      n += all_.parts()[k++].rows();
    const double length = model_.bodies[model_.joints[joint].child].length;
    Reactions::Wrench wrench = reactions.joints[joint];
    for (std::size_t m = 0; m < parts; ++m)
      if (const ConstraintPart& p = all_.parts()[m]; is_motion(p) && p.owner.index == joint) {
        wrench.force += lambda[all_.offset(m)] * all_.row(all_.offset(m)).gradient.Fb;
        wrench.torque += lambda[all_.offset(m)] * all_.row(all_.offset(m)).gradient.Tb;
      }
    Mat6 A = Mat6::Zero();
    Vec6 x = Vec6::Zero();
    for (int i = 0; i < n; ++i) {
      const WrenchRow& gi = all_.row(row + i).gradient;
      x[i] = -(gi.Fb.dot(wrench.force) + gi.Tb.dot(wrench.torque) / (length * length));
      for (int j = 0; j < n; ++j) {
        const WrenchRow& gj = all_.row(row + j).gradient;
        A(i, j) = gi.Fb.dot(gj.Fb) + gi.Tb.dot(gj.Tb) / (length * length);
      }
    }
    solve_small(A, n, x);
    for (int i = 0; i < n; ++i) lambda[row + i] = x[i];
  }
}

template <class F>
void LeastReactions<F>::shorten(VecX& lambda) noexcept {
  for (Eigen::Index j = 0; j < rank_; ++j) projected_[j] = U_.col(j).dot(lambda);
  lambda.setZero();
  for (Eigen::Index j = 0; j < rank_; ++j) lambda += projected_[j] * U_.col(j);
}

template <class F>
void LeastReactions<F>::wrenches(const VecX& lambda, Reactions& reactions) const noexcept {
  for (Reactions::Wrench& w : reactions.joints) w = {};
  add_part_wrenches(all_, lambda, reactions);
}

void add_part_wrenches(const ConstraintSet& set, const VecX& lambda,
                       Reactions& reactions) noexcept {
  for (std::size_t k = 0; k < set.parts().size(); ++k) {
    const ConstraintPart& p = set.parts()[k];
    const WrenchRow w = set.wrench(k, lambda);
    if (p.owner.kind == ConstraintOwner::Kind::rod) {
      reactions.rods[p.owner.index] = {-w.Fb, -w.Tb};
      reactions.tensions[p.owner.index] = lambda[set.offset(k)];
      continue;
    }
    Reactions::Wrench& joint = reactions.joints[p.owner.index];
    joint.force -= w.Fb;
    joint.torque -= w.Tb;
    if (is_motion(p)) reactions.motions[p.owner.index] = motion_scale(p) * lambda[set.offset(k)];
  }
}

template class LeastReactions<RelativeFormulation>;
template class LeastReactions<AbsoluteFormulation>;

}  // namespace floatframe
