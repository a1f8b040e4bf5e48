#include "floatframe/reactions/least_reactions.hpp"

#include <cassert>
#include <cmath>
#include <iterator>
#include <numeric>

#include "floatframe/math/contracts.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/reactions/part_wrenches.hpp"

namespace floatframe {

namespace {

/// Columns of J that are shorter than this, relative to the longest, are zero.
constexpr double no_column = 1e-7;

/// e of the factors, of the diagonal and of 1.
constexpr double held_softly = 1e-11;
/// Residual of the wrenches relative to lambda before the correction: below the first limit none is
/// made; above the second (more than 1e-8 after the correction) the basis is used.
constexpr double negligible = 3e-11, correctable = 1e-5;

std::vector<int> every_joint(const Model& model) {
  std::vector<int> joints(model.joints.size());
  std::iota(joints.begin(), joints.end(), 0);
  return joints;
}

/// out += U V^T of rigid bodies, six numbers per row; four and two of a column at a time.
void add_product(const double* u, const double* v, int rows, double* out,
                 Eigen::Index stride) noexcept {
  using Eigen::Array2d, Eigen::Array4d;
  Array4d upper[6];
  Array2d lower[6];
  for (int j = 0; j < 6; ++j) {
    upper[j].setZero();
    lower[j].setZero();
  }
  for (int r = 0; r < rows; ++r, u += 6, v += 6) {
    const Array4d row = Eigen::Map<const Array4d>(u);
    const Array2d end = Eigen::Map<const Array2d>(u + 4);
    for (int j = 0; j < 6; ++j) {
      upper[j] += v[j] * row;
      lower[j] += v[j] * end;
    }
  }
  for (int j = 0; j < 6; ++j, out += stride) {
    Eigen::Map<Array4d>(out) += upper[j];
    Eigen::Map<Array2d>(out + 4) += lower[j];
  }
}

/// x := A^-1 x for the leading n x n of a positive definite A, by Cholesky.
void solve_small(Mat6& A, int n, Vec6& x) noexcept {
  assert(n >= 0 && n <= 6);
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

LeastReactions::LeastReactions(const Model& model)
    : model_(model), all_(model, every_joint(model)), held_(model.joints.size()) {
  all_.number_rows(0);
  std::vector<int> sizes;
  for (const Body& b : model.bodies) {
    column_.push_back(std::accumulate(sizes.begin(), sizes.end(), 0));
    sizes.push_back(6 + b.modes());
    VecX scale = VecX::Ones(b.modes());
    for (Eigen::Index k = 0; k < scale.size(); ++k) {
      double most = 0.0;
      for (const ModalNode& node : b.data->nodes) most = std::max(most, node.X.col(k).norm());
      if (most > 0.0) scale[k] = 1.0 / most;
    }
    mode_scale_.push_back(scale);
  }
  std::vector<std::pair<int, int>> edges;
  int numbers = 0, k = 0;
  const auto body_of = [&](int marker) { return model.markers[marker].body; };
  for (const ConstraintPart& p : all_.parts()) {
    const std::vector<int> markers = all_.continues(k) ? std::vector<int>() : all_.markers(k);
    std::vector<Side> sides;
    for (const int marker : markers)
      if (const int body = body_of(marker);
          body >= 0 && std::ranges::find(sides, body, &Side::body) == sides.end())
        sides.push_back({body, sizes[body], 0, column_[body]});
    const bool goes_on =
        p.continues || (!groups_.empty() && std::ranges::equal(groups_.back().sides, sides, {},
                                                               &Side::body, &Side::body));
    if (!goes_on) groups_.push_back({std::move(sides), k, 0, all_.offset(k), 0});
    ++groups_.back().parts;
    if (!p.continues) groups_.back().rows += p.rows();
    if (p.counted_by() >= 0 && p.owner.element >= 0) held_[p.owner.joint].push_back(k);
    ++k;
  }
  for (Group& g : groups_)
    for (Side& s : g.sides) {
      s.at = numbers;
      numbers += s.size * g.rows;
      for (const Side& other : g.sides)
        if (&other < &s) edges.emplace_back(other.body, s.body);
    }
  rows_of_J_.assign(numbers, 0.0);
  normal_ = BlockLdlt(sizes, edges);
  const int columns = normal_.unknowns();
  U_ = MatX::Zero(rows(), columns);
  lengths_ = projected_ = load_ = left_ = x_ = VecX::Zero(columns);
  least_ = VecX::Zero(rows());
}

/// Adds the gradients of one marker of a part.
void LeastReactions::fill(const Formulation& f, const SystemMotion& motion, const Group& group,
                          int part, bool of_b) noexcept {
  assert(part >= group.first && part < group.first + group.parts);
  const ConstraintPart& p = all_.parts()[part];
  const LocalMarker& m = f.local_marker(of_b ? p.b : p.a);
  if (m.body < 0) return;
  const Side& side = *std::ranges::find(group.sides, m.body, &Side::body);
  assert(model_.bodies[m.body].length > 0.0);
  const Vec3 arm = motion.body(m.body).R_WB * m.p_B;
  const double per_length = 1.0 / model_.bodies[m.body].length;
  double* out = rows_of_J_.data() + side.at + (all_.offset(part) - group.row) * side.size;
  for (int r = 0; r < p.rows(); ++r, out += side.size) {
    const WrenchRow& g = all_.row(part, r).gradient;
    const Vec3 &force = of_b ? g.b.F : g.a.F, &torque = of_b ? g.b.T : g.a.T;
    Eigen::Map<Vec3> frame(out), turning(out + 3);
    frame += force;
    turning += per_length * (arm.cross(force) + torque);
    if (!m.local) continue;
    const VecX& scale = mode_scale_[m.body];
    for (int k = 0; k < scale.size(); ++k) {
      double x = m.Jr.col(k).dot(force);
      if (m.rotates) x += m.Jw.col(k).dot(torque);
      out[6 + k] += scale[k] * x;
    }
  }
}

void LeastReactions::add_normal_equations(const Side& s, const Side& t, int rows) noexcept {
  assert(s.body >= 0 && t.body >= 0 && s.size > 0 && t.size > 0);
  int os = 0, ot = 0;
  MatX& front = normal_.front(s.body, t.body, os, ot);
  // The lower triangle is read.
  const Side &low = os >= ot ? s : t, &high = os >= ot ? t : s;
  double* corner = &front(std::max(os, ot), std::min(os, ot));
  const double* u = rows_of_J_.data() + low.at;
  const double* v = rows_of_J_.data() + high.at;
  if (low.size == 6 && high.size == 6) return add_product(u, v, rows, corner, front.rows());
  for (int r = 0; r < rows; ++r)
    for (int j = 0; j < high.size; ++j)
      for (int i = 0; i < low.size; ++i)
        corner[j * front.rows() + i] += u[r * low.size + i] * v[r * high.size + j];
}

void LeastReactions::place(const Formulation& f) noexcept {
  const SystemMotion& motion = f.motion();
  all_.evaluate(motion.t, [&](int marker) -> const MarkerState& { return motion.marker(marker); });
  normal_.set_zero();
  std::ranges::fill(rows_of_J_, 0.0);
  for (const Group& group : groups_) {
    for (int k = group.first; k < group.first + group.parts; ++k) {
      fill(f, motion, group, k, false);
      fill(f, motion, group, k, true);
    }
    for (const Side& s : group.sides) add_normal_equations(s, s, group.rows);
    for (const Side& s : group.sides)
      for (const Side& t : group.sides)
        if (&s < &t) add_normal_equations(s, t, group.rows);
  }
  for (int i = 0; i < std::ssize(model_.bodies); ++i) {
    MatX& front = normal_.front(i);
    for (int k = 0; k < 6 + model_.bodies[i].modes(); ++k)
      front(k, k) += held_softly * (1.0 + front(k, k));
  }
  factorised_ = normal_.factorize() < 0;
  dense_ = false;
}

void LeastReactions::times_transpose(const VecX& lambda, VecX& out) const noexcept {
  assert(lambda.size() == rows() && out.size() == normal_.unknowns());
  out.setZero();
  for (const Group& g : groups_)
    for (const Side& s : g.sides)
      with_rows(s, g.rows, [&](const auto& J) {
        out.segment(s.column, s.size) += J.lazyProduct(lambda.segment(g.row, g.rows));
      });
}

void LeastReactions::add_times(const VecX& x, VecX& lambda) const noexcept {
  assert(lambda.size() == rows() && x.size() == normal_.unknowns());
  for (const Group& g : groups_)
    for (const Side& s : g.sides)
      with_rows(s, g.rows, [&](const auto& J) {
        lambda.segment(g.row, g.rows) += J.transpose().lazyProduct(x.segment(s.column, s.size));
      });
}

void LeastReactions::add_load(const LocalMarker& m, const SystemMotion& motion, const Vec3& force,
                              const Vec3& torque) noexcept {
  if (m.body < 0) return;
  const Vec3 arm = motion.body(m.body).R_WB * m.p_B;
  double* out = load_.data() + column_[m.body];
  Eigen::Map<Vec3> frame(out), turning(out + 3);
  frame += force;
  turning += (arm.cross(force) + torque) / model_.bodies[m.body].length;
  if (!m.local) return;
  const VecX& scale = mode_scale_[m.body];
  for (int k = 0; k < scale.size(); ++k) {
    double x = m.Jr.col(k).dot(force);
    if (m.rotates) x += m.Jw.col(k).dot(torque);
    out[6 + k] += scale[k] * x;
  }
}

void LeastReactions::find_load(const Formulation& f, const Reactions& reactions) noexcept {
  assert(reactions.joints.size() == model_.joints.size());
  assert(reactions.elements.size() == model_.elements.size());
  load_.setZero();
  const SystemMotion& motion = f.motion();
  // The reaction acts back on a, with a moment if the points are apart.
  const auto add = [&](int a, int b, const Reactions::Wrench& w) {
    const Vec3 d = motion.marker(b).r - motion.marker(a).r;
    add_load(f.local_marker(b), motion, -w.force, -w.torque);
    add_load(f.local_marker(a), motion, w.force, w.torque + d.cross(w.force));
  };
  for (std::size_t j = 0; j < model_.joints.size(); ++j)
    add(model_.joints[j].frame_F, model_.joints[j].frame_M, reactions.joints[j]);
  for (std::size_t k = 0; k < model_.elements.size(); ++k)
    if (const Element& e = model_.elements[k]; e.links())
      add(e.markers[0], e.markers[1], reactions.elements[k]);
  for (std::size_t k = 0; k < all_.parts().size(); ++k) {
    const ConstraintPart& p = all_.parts()[k];
    if (!p.apart) continue;
    const double lambda = reactions.forces[p.owner.element] / p.force;
    const WrenchRow& g = all_.row(k, 0).gradient;
    add_load(f.local_marker(p.a), motion, lambda * g.a.F, lambda * g.a.T);
    add_load(f.local_marker(p.b), motion, lambda * g.b.F, lambda * g.b.T);
  }
}

bool LeastReactions::solve_sparse() noexcept {
  if (!factorised_) return false;
  const double size = largest(load_);
  x_ = load_;
  normal_.solve(x_);
  least_.setZero();
  add_times(x_, least_);
  times_transpose(least_, left_);
  left_ = load_ - left_;
  // The correction leaves a residual of this fraction of the load.
  const double error = largest(left_);
  if (!(error <= correctable * size)) return false;
  if (error > negligible * size) {
    normal_.solve(left_);
    add_times(left_, least_);
  }
  return true;
}

void LeastReactions::project_to_minimum_norm(VecX& lambda) noexcept {
  times_transpose(lambda, load_);
  if (solve_sparse())
    lambda = least_;
  else
    shorten_dense(lambda);
}

void LeastReactions::project_to_minimum_norm(const Formulation& f, Reactions& reactions) noexcept {
  find_load(f, reactions);
  if (!solve_sparse()) {
    multipliers(reactions, least_);
    shorten_dense(least_);
  }
  wrenches(least_, reactions);
}

void LeastReactions::orthonormalise() noexcept {
  U_.setZero();
  for (const Group& g : groups_)
    for (const Side& s : g.sides)
      with_rows(s, g.rows,
                [&](const auto& J) { U_.block(g.row, s.column, g.rows, s.size) += J.transpose(); });
  dense_ = true;
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

void LeastReactions::multipliers(const Reactions& reactions, VecX& lambda) noexcept {
  lambda.setZero();
  std::size_t k = 0;
  const std::size_t parts = all_.parts().size();
  // Elements first: the wrench of a joint includes those that hold its coordinates.
  for (k = 0; k < parts; ++k) {
    const ConstraintPart& p = all_.parts()[k];
    if (p.owner.element >= 0 && !model_.elements[p.owner.element].links())
      lambda[all_.offset(k)] = reactions.forces[p.owner.element] / p.force;
  }
  for (k = 0; k < parts;) {
    const ConstraintPart& first = all_.parts()[k];
    const auto [joint, element] = first.owner;
    if (element >= 0 && !model_.elements[element].links()) {
      ++k;
      continue;
    }
    // The parts of a joint, or of an element that links bodies, are consecutive: J_k^T lambda_k =
    // -wrench of them, by the normal equations of its at most six rows.
    const int row = all_.offset(k);
    const WrenchRow* gradients[6];
    int n = 0;
    while (k < parts && all_.parts()[k].owner.joint == joint &&
           all_.parts()[k].owner.element == element)
      for (int r = 0, part = k++; r < all_.parts()[part].rows(); ++r)
        gradients[n++] = &all_.row(part, r).gradient;
    // Rows of directions, which follow those of points, are scaled by a length.
    const double length =
        joint >= 0 ? model_.bodies[model_.joints[joint].child].length : all_.parts()[k - 1].scale;
    Reactions::Wrench wrench = joint >= 0 ? reactions.joints[joint] : reactions.elements[element];
    for (std::size_t i = 0; joint >= 0 && i < held_[joint].size(); ++i) {
      const int m = held_[joint][i];
      const WrenchRow& g = all_.row(m, 0).gradient;
      wrench.force += lambda[all_.offset(m)] * g.b.F;
      wrench.torque += lambda[all_.offset(m)] * g.b.T;
    }
    Mat6 A = Mat6::Zero();
    Vec6 x = Vec6::Zero();
    for (int i = 0; i < n; ++i) {
      const WrenchRow& gi = *gradients[i];
      x[i] = -(gi.b.F.dot(wrench.force) + gi.b.T.dot(wrench.torque) / (length * length));
      for (int j = 0; j <= i; ++j) {
        const WrenchRow& gj = *gradients[j];
        A(i, j) = A(j, i) = gi.b.F.dot(gj.b.F) + gi.b.T.dot(gj.b.T) / (length * length);
      }
    }
    solve_small(A, n, x);
    for (int i = 0; i < n; ++i) lambda[row + i] = x[i];
  }
}

void LeastReactions::shorten_dense(VecX& lambda) noexcept {
  assert(lambda.size() == rows());
  if (!dense_) orthonormalise();
  for (Eigen::Index j = 0; j < rank_; ++j) projected_[j] = U_.col(j).dot(lambda);
  lambda.setZero();
  for (Eigen::Index j = 0; j < rank_; ++j) lambda += projected_[j] * U_.col(j);
}

void LeastReactions::wrenches(const VecX& lambda, Reactions& reactions) const noexcept {
  for (Reactions::Wrench& w : reactions.joints) w = {};
  add_part_wrenches(all_, lambda, reactions);
}

}  // namespace floatframe
