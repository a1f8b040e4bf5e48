// The fronts of the clusters: elements, composite inertia, elimination.
#include "floatframe/formulation/cluster_tangent.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "floatframe/math/partial_ldlt.hpp"
#include "floatframe/math/small_products.hpp"

namespace floatframe {

namespace {

/// Lower triangle of front += w g g^T on the rows and columns first..first+n, in whole lanes:
/// entries above the diagonal are scratch, and g is zero beyond the front.
void add_outer(MatX& front, int first, int n, const double* g, double w) noexcept {
  assert(first % 4 == 0 && n % 4 == 0 && first >= 0 && first + n <= front.rows());
  const Eigen::Index ld = front.rows();
  double* column = front.data() + first * ld + first;
  const int columns = std::min(n, static_cast<int>(front.cols()) - first);
  for (int j = 0; j < columns; ++j, column += ld) {
    const double x = w * g[j];
    if (x == 0.0) continue;
    for (int i = j & ~3; i < n; i += 4) lanes(column + i) += x * lanes(g + i);
  }
}

/// The same for the three rows of g (n each): front += w (g0 g0^T + g1 g1^T + g2 g2^T).
void add_three_outer(MatX& front, int first, int n, const double* g, double w) noexcept {
  const Eigen::Index ld = front.rows();
  assert(first % 4 == 0 && n % 4 == 0 && first >= 0 && first + n <= front.rows());
  const double *g0 = g, *g1 = g + n, *g2 = g + 2 * n;
  double* column = front.data() + first * ld + first;
  const int columns = std::min(n, static_cast<int>(front.cols()) - first);
  for (int j = 0; j < columns; ++j, column += ld) {
    const double x = w * g0[j], y = w * g1[j], z = w * g2[j];
    for (int i = j & ~3; i < n; i += 4)
      lanes(column + i) += x * lanes(g0 + i) + y * lanes(g1 + i) + z * lanes(g2 + i);
  }
}

/// Zeros in the lower triangle, in whole lanes.
void clear_lower(MatX& front) noexcept {
  const Eigen::Index ld = front.rows();
  double* column = front.data();
  for (Eigen::Index j = 0; j < front.cols(); ++j, column += ld)
    for (Eigen::Index i = j & ~3; i < ld; i += 4) lanes(column + i) = Lanes{};
}

}  // namespace

// geometric stiffness

void ClusterTangent::clear_geometric() noexcept {
  for (BodyTangent& b : bodies_) {
    b.G_force.setZero();
    b.G_virial.setZero();
    b.G_modal.setZero();
  }
}

void ClusterTangent::add_geometric(int marker, const Vec3& force) noexcept {
  const TreeMarker& m = tree_.marker(marker);
  if (m.body < 0) return;
  BodyTangent& b = bodies_[m.body];
  b.G_force += force;
  b.G_virial.noalias() += m.s.r * force.transpose();
  if (m.local)
    for (Eigen::Index k = 0; k < b.G_modal.cols(); ++k)
      b.G_modal.col(k) += m.Jr.col(k).cross(force);
}

void ClusterTangent::gather_geometric(double s) noexcept {
  forces_.add_wrenches(
      [&](int marker, const Vec3& force, const Vec3&) { add_geometric(marker, s * force); });
  // Multipliers only: the penalty part vanishes at convergence and would disturb the tangent.
  constraints_.add_wrenches(
      constraints_.multipliers(),
      [&](int marker, const Vec3& force, const Vec3&) { add_geometric(marker, s * force); });
}

/// K_G of second-order displacements: due to accelerations of the bodies, and forces and
/// multipliers on them.
void ClusterTangent::add_stiffening(const std::vector<BodyTerms>& terms, double s) noexcept {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const SecondOrder* second_order = terms[i].inertia.second_order();
    if (!second_order) continue;
    assert(bodies_[i].K_G.rows() == terms[i].M.rows() - 6);
    const TreeBody& b = tree_.body(static_cast<int>(i));
    const Vec6 z = b.Zdot + b.Zdot_0;
    const Mat3 G = skew(Vec3(z.tail<3>())) + skew(b.w_WB) * skew(b.w_WB);
    const Vec3 a = z.head<3>() + G * b.p_OB;
    bodies_[i].K_G.setZero();
    floatframe::add_stiffness(*second_order, b.R_WB.transpose() * a,
                              b.R_WB.transpose() * G * b.R_WB, s, bodies_[i].K_G);
  }
  const auto add = [&](int marker, const Vec3& force, const Vec3& torque) {
    const TreeMarker& m = tree_.marker(marker);
    if (!m.second) return;
    const Mat3 R_BW = tree_.body(m.body).R_WB.transpose();
    m.add_stiffness(R_BW * force, R_BW * torque, s, bodies_[m.body].K_G);
  };
  forces_.add_wrenches(add);
  constraints_.add_wrenches(constraints_.multipliers(), add);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    BodyTangent& t = bodies_[i];
    if (!terms[i].inertia.second_order()) continue;
    t.T.bottomRightCorner(t.K_G.rows(), t.K_G.cols()) += t.K_G;
  }
}

// elements

void ClusterTangent::assemble_own_row(const TreeElement& e, const Wrench* row,
                                      double weight) noexcept {
  BodyTangent& b = bodies_[e.body];
  const Eigen::Index nm = b.G_modal.cols();
  assert(scratch_.size() >= 6 + nm);
  auto g = scratch_.head(6 + nm);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  g.tail(nm).setZero();
  for (std::size_t i = 0; i < e.markers.size(); ++i) {
    const TreeMarker& m = tree_.marker(e.markers[i]);
    if (m.body < 0) continue;
    const auto& [force, torque] = row[i];
    sum += force;
    moment += m.s.r.cross(force) + torque;
    if (!m.local) continue;
    g.tail(nm).noalias() += m.Jr.transpose() * force;
    if (m.rotates) g.tail(nm).noalias() += m.Jw.transpose() * torque;
  }
  g.head<3>() = sum;
  g.segment<3>(3) = moment;
  for (Eigen::Index j = 0; j < g.size(); ++j) b.T.col(j) += (weight * g[j]) * g;
}

void ClusterTangent::assemble_forces(const Weights& w, Factors& factors) noexcept {
  for (std::size_t k = 0; k < force_elements_.size(); ++k) {
    const Efforts& f = forces_.state(k);
    const TreeElement& e = force_elements_[k];
    assert(f.row_count >= 0 && f.row_count <= std::ssize(f.rows));
    for (int r = 0; r < f.row_count; ++r) {
      const double weight = w.s * f.rows[r].k + w.damping * f.rows[r].c;
      if (weight == 0.0) continue;
      if (e.cluster >= 0) {
        fill_gradient(tree_, e, f.gradient(r), scratch_.data());
        add_outer(factors.fronts[e.cluster], e.first, e.width, scratch_.data(), weight);
      } else if (e.body >= 0) {  // one body: into its own matrix
        assemble_own_row(e, f.gradient(r), weight);
      }
    }
  }
}

void ClusterTangent::assemble_parts(const Weights& w, Factors& factors) noexcept {
  for (std::size_t k = 0; k < part_elements_.size(); ++k) {
    const ConstraintPart& part = constraints_.parts()[k];
    const TreeElement& e = part_elements_[k];
    if (e.cluster < 0) continue;
    MatX& front = factors.fronts[e.cluster];
    double* g = factors.gradients.data() + e.gradient;
    assert(e.gradient + part.rows() * e.width <= std::ssize(factors.gradients));
    const PartGradients gradients = constraint_kind(part.type).gradients;
    if (gradients == PartGradients::unit) {
      fill_distance(tree_, e, g);
      add_three_outer(front, e.first, e.width, g, w.penalty);
      continue;
    }
    const int row = constraints_.offset(k);
    for (int r = 0; r < part.rows(); ++r, g += e.width) {
      constraints_.gradient(k, r, row_);
      fill_gradient(tree_, e, row_.data(), g);
      add_outer(front, e.first, e.width, g, w.penalty);
    }
    if (w.geometric && gradients == PartGradients::line) {
      assert(part.scale > 0.0);
      fill_distance(tree_, e, scratch_.data());
      add_three_outer(front, e.first, e.width, scratch_.data(),
                      w.s * constraints_.multipliers()[row] / part.scale);
    }
  }
}

// composite inertia inside a cluster

void ClusterTangent::find_products(int i) noexcept {
  const TreeBody& b = tree_.body(i);
  const double* T = bodies_[i].T.data();
  const double* S = b.own.data();
  double* U = bodies_[i].U.data();
  const int width = b.nj + b.nm, nt = 6 + b.nm;
  assert(b.own.cols() == width && bodies_[i].U.cols() == width);
  for (int j = 0; j < width; ++j) {
    double* u = U + 6 * j;
    if (j < b.nj)
      for (int r = 0; r < 6; ++r) u[r] = 0.0;
    else
      for (int r = 0; r < 6; ++r) u[r] = T[static_cast<Eigen::Index>(6 + j - b.nj) * nt + r];
    if (j >= b.nj && !b.moves_M) continue;
    const double* x = S + 6 * j;
    for (int p = 0; p < 6; ++p)
      for (int r = 0; r < 6; ++r) u[r] += T[static_cast<Eigen::Index>(p) * nt + r] * x[p];
  }
}

namespace {

/// The angular rows of G s: the linear ones are zero.
Vec3 geometric_moment(const Vec3& G_force, const Mat3& G_angular, const double* s) noexcept {
  const Eigen::Map<const Vec3> linear(s), angular(s + 3);
  return linear.cross(G_force) + G_angular * angular;
}

}  // namespace

void ClusterTangent::add_own(const Cluster& c, int i, MatX& front) noexcept {
  const TreeBody& b = tree_.body(i);
  BodyTangent& t = bodies_[i];
  const Eigen::Index ld = front.rows();
  const int width = b.nj + b.nm, at = b.iv - c.offset, nt = 6 + b.nm;
  assert(at >= 0 && at + width <= c.size && t.T.rows() == nt);
  const double* T = t.T.data();
  const double* S = b.own.data();
  double* U = t.U.data();
  // Modes against modes: Y + S^T U + N^T S.
  for (int j = b.nj; j < width; ++j) {
    double* column = front.data() + static_cast<Eigen::Index>(at + j) * ld + at;
    const double* y = T + static_cast<Eigen::Index>(6 + j - b.nj) * nt + 6 - b.nj;
    for (int r = j; r < width; ++r) column[r] += y[r];
    if (!b.moves_M) continue;
    for (int r = j; r < width; ++r)
      column[r] += dot6(S + 6 * r, U + 6 * j) +
                   dot6(T + static_cast<Eigen::Index>(6 + r - b.nj) * nt, S + 6 * j);
  }
  // Geometric stiffness from here on: U += G S.
  t.G_angular = t.G_virial - t.G_virial.trace() * Mat3::Identity();
  for (int j = 0; j < b.nj; ++j)
    Eigen::Map<Vec3>(U + 6 * j + 3) += geometric_moment(t.G_force, t.G_angular, S + 6 * j);
  for (int j = 0; j < b.nm; ++j) Eigen::Map<Vec3>(U + 6 * (b.nj + j) + 3) += t.G_modal.col(j);
  // Joint against joint and modes.
  for (int j = 0; j < b.nj; ++j) {
    // Coordinate j is above l, but rotations of a spherical joint have no order: symmetric part.
    const bool above = j < b.ordered;
    double* column = front.data() + static_cast<Eigen::Index>(at + j) * ld + at;
    for (int l = j; l < b.nj; ++l)
      column[l] += above ? dot6(S + 6 * j, U + 6 * l)
                         : 0.5 * (dot6(S + 6 * l, U + 6 * j) + dot6(S + 6 * j, U + 6 * l));
    for (int l = b.nj; l < width; ++l) column[l] += dot6(U + 6 * l, S + 6 * j);
  }
}

void ClusterTangent::add_couplings(const Cluster& c, int i, MatX& front) const noexcept {
  const TreeBody& b = tree_.body(i);
  const double* U = bodies_[i].U.data();
  const Eigen::Index ld = front.rows();
  const int width = b.nj + b.nm, at = b.iv - c.offset;
  assert(at >= 0 && at + width <= c.size && c.n <= front.cols());
  const auto couple = [&](const double* directions, int count, int column_at) {
    for (int a = 0; a < count; ++a) {
      double* column = front.data() + static_cast<Eigen::Index>(column_at + a) * ld + at;
      add_transposed_times(U, width, directions + 6 * a, column);
    }
  };
  for (int current = i; tree_.body(current).parent >= 0; current = tree_.body(current).parent) {
    const TreeBody& d = tree_.body(current);
    const TreeBody& p = tree_.body(d.parent);
    if (d.parent == c.parent) {
      for (int l = 0; l < width; ++l) {
        double* column = front.data() + static_cast<Eigen::Index>(at + l) * ld + c.size;
        for (int r = 0; r < 6; ++r) column[r] += U[6 * l + r];
        if (d.parent_moves_F) add_transposed_times(d.of_parent.data(), p.nm, U + 6 * l, column + 6);
      }
      return;
    }
    if (d.parent_moves_F) couple(d.of_parent.data(), p.nm, p.iy - c.offset);
    couple(p.own.data(), p.moving(), p.iv - c.offset);
  }
}

void ClusterTangent::add_to_parent(const Cluster& c, int i, MatX& front) noexcept {
  const TreeBody& b = tree_.body(i);
  if (b.parent < 0) return;
  BodyTangent& t = bodies_[i];
  BodyTangent& p = bodies_[b.parent];
  p.G_force += t.G_force;
  p.G_virial += t.G_virial;
  if (b.parent_moves_F)
    for (int k = 0; k < b.nm_parent; ++k)
      p.G_modal.col(k) += geometric_moment(t.G_force, t.G_angular, b.of_parent.data() + 6 * k);
  auto Mz = t.T.topLeftCorner<6, 6>();
  if (b.parent_moves_F) t.Mz_Phi.noalias() = Mz.lazyProduct(b.of_parent);
  if (b.parent != c.parent) {
    p.T.topLeftCorner<6, 6>() += Mz;
    if (b.parent_moves_F) {
      p.T.topRightCorner(6, b.nm_parent) += t.Mz_Phi;
      p.T.bottomRightCorner(b.nm_parent, b.nm_parent).noalias() +=
          b.of_parent.transpose().lazyProduct(t.Mz_Phi);
    }
  } else {
    front.block<6, 6>(c.size, c.size) += Mz;
    if (b.parent_moves_F) {
      front.block(c.size + 6, c.size, b.nm_parent, 6) += t.Mz_Phi.transpose();
      front.block(c.size + 6, c.size + 6, b.nm_parent, b.nm_parent).noalias() +=
          b.of_parent.transpose().lazyProduct(t.Mz_Phi);
    }
  }
}

void ClusterTangent::assemble_cluster(const Cluster& c, MatX& front) noexcept {
  for (std::size_t k = c.bodies.size(); k-- > 0;) {
    const int i = c.bodies[k];
    find_products(i);
    add_own(c, i, front);
    add_couplings(c, i, front);
    add_to_parent(c, i, front);
  }
}

// factorisation

void ClusterTangent::load_bodies(const std::vector<BodyTerms>& terms, const Weights& w,
                                 Factors& factors) noexcept {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const TreeBody& b = tree_.body(static_cast<int>(i));
    BodyTangent& t = bodies_[i];
    assert(terms[i].M.rows() == 6 + b.nm);
    t.T = terms[i].M;
    if (w.mass != 1.0) t.T *= w.mass;
    if (b.nm > 0) {
      t.T.bottomRightCorner(b.nm, b.nm) += w.s * t.data->K;
      if (terms[i].damped && w.damping != 0.0)
        t.T.bottomRightCorner(b.nm, b.nm) += w.damping * t.data->D;
    }
    factors.bodies[i].own = b.own;
    if (b.parent_moves_F) factors.bodies[i].of_parent = b.of_parent;
  }
}

void ClusterTangent::hand_front_to_parent(const Cluster& c, const MatX& front) noexcept {
  MatX& T = bodies_[c.parent].T;
  const int np = c.n - c.size;
  assert(c.parent >= 0 && T.rows() == np);
  for (int j = 0; j < np; ++j) {
    T(j, j) += front(c.size + j, c.size + j);
    for (int i = j + 1; i < np; ++i) {
      const double x = front(c.size + i, c.size + j);
      T(i, j) += x;
      T(j, i) += x;
    }
  }
}

int ClusterTangent::factorize(const std::vector<BodyTerms>& terms, const Weights& weights,
                              int slot) noexcept {
  assert((slot == 0 || slot == 1) && terms.size() == bodies_.size());
  assert(!(weights.mass < 0.0) && !(weights.s < 0.0) && !(weights.penalty < 0.0));  // or NaN
  Factors& factors = factors_[slot];
  clear_geometric();
  if (weights.geometric) gather_geometric(weights.s);
  load_bodies(terms, weights, factors);
  if (second_order_ && weights.geometric) add_stiffening(terms, weights.s);
  for (std::size_t k = 0; k < clusters_.size(); ++k) {
    if (fronts_[k].profile.empty())
      clear_lower(factors.fronts[k]);
    else
      profile_clear(factors.fronts[k].data(), clusters_[k].n, clusters_[k].size,
                    fronts_[k].profile);
  }
  assemble_forces(weights, factors);
  assemble_parts(weights, factors);
  for (std::size_t k = clusters_.size(); k-- > 0;) {
    const Cluster& c = clusters_[k];
    MatX& front = factors.fronts[k];
    assemble_cluster(c, front);
    double* original = fronts_[k].original.data();
    const FrontProfile& profile = fronts_[k].profile;
    const int failed = profile.empty() ? partial_ldlt(front.data(), c.n, c.size, original)
                                       : profile_ldlt(front.data(), c.n, c.size, original, profile);
    if (failed >= 0) return c.offset + failed;
    if (c.parent >= 0) hand_front_to_parent(c, front);
  }
  return -1;
}

}  // namespace floatframe
