// Tangent of the relative formulation: composite inertia inside clusters, elimination between them.
#include <algorithm>

#include "floatframe/formulation/relative.hpp"
#include "floatframe/math/partial_ldlt.hpp"
#include "floatframe/math/small_products.hpp"

namespace floatframe {

namespace {

/// Lower triangle of front += w g g^T on the rows and columns first..first+n, in whole lanes: what
/// lies above the diagonal is scratch, and g is zero beyond the front.
void add_outer(MatX& front, int first, int n, const double* g, double w) noexcept {
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

// elements

void RelativeFormulation::fill_gradient(const Element& e, const WrenchRow& g,
                                        double* row) const noexcept {
  for (int j = 0; j < e.width; ++j) row[j] = 0.0;
  for (const PathEntry& p : e.path) {
    const MarkerData& m = mark(p.marker);
    const Vec3& force = p.side_b ? g.Fb : g.Fa;
    const Vec3& torque = p.side_b ? g.Tb : g.Ta;
    double* out = row + (p.front - e.first);
    if (p.what == PathEntry::What::marker_modes) {
      for (int j = 0; j < p.count; ++j) {
        out[j] += m.Jr.col(j).dot(force);
        if (m.rotates) out[j] += m.Jw.col(j).dot(torque);
      }
      continue;
    }
    Vec6 f;
    f.head<3>() = force;
    f.tail<3>() = m.s.r.cross(force) + torque;
    add_transposed_times(directions(p), p.count, f.data(), out);
  }
}

void RelativeFormulation::fill_distance(const Element& e, double* rows) const noexcept {
  for (int j = 0; j < 3 * e.width; ++j) rows[j] = 0.0;
  for (const PathEntry& p : e.path) {
    const MarkerData& m = mark(p.marker);
    const double sign = p.side_b ? 1.0 : -1.0;
    double* x = rows + (p.front - e.first);
    double* y = x + e.width;
    double* z = y + e.width;
    if (p.what == PathEntry::What::marker_modes) {
      for (int j = 0; j < p.count; ++j) {
        x[j] += sign * m.Jr(0, j);
        y[j] += sign * m.Jr(1, j);
        z[j] += sign * m.Jr(2, j);
      }
      continue;
    }
    const double* c = directions(p);
    const Vec3& r = m.s.r;
    for (int j = 0; j < p.count; ++j, c += 6) {
      x[j] += sign * (c[0] + c[4] * r[2] - c[5] * r[1]);
      y[j] += sign * (c[1] + c[5] * r[0] - c[3] * r[2]);
      z[j] += sign * (c[2] + c[3] * r[1] - c[4] * r[0]);
    }
  }
}

void RelativeFormulation::add_geometric(int marker, const Vec3& force) noexcept {
  const MarkerData& m = mark(marker);
  if (m.body < 0) return;
  BodyData& b = body(m.body);
  b.G_force += force;
  b.G_virial.noalias() += m.s.r * force.transpose();
  if (m.local)
    for (int k = 0; k < b.nm; ++k) b.G_modal.col(k) += m.Jr.col(k).cross(force);
}

void RelativeFormulation::gather_geometric(double s) noexcept {
  for (BodyData& b : bodies_) {
    b.G_force.setZero();
    b.G_virial.setZero();
    b.G_modal.setZero();
  }
  for (std::size_t k = 0; k < model_.forces.size(); ++k) {
    const Force& f = model_.forces[k];
    const WrenchRow& w = force_states_[k].wrench;
    if (f.a >= 0) add_geometric(f.a, -s * w.Fa);
    add_geometric(f.b, -s * w.Fb);
  }
  // Multipliers only: the penalty part vanishes with convergence and would disturb the tangent.
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    WrenchRow sum;
    sum_rows(k, lambda_, sum);
    add_geometric(parts_[k].a, s * sum.Fa);
    add_geometric(parts_[k].b, s * sum.Fb);
  }
}

void RelativeFormulation::assemble_elements(double damping, double s, double penalty,
                                            bool geometric, Linearization& l) noexcept {
  for (std::size_t k = 0; k < model_.forces.size(); ++k) {
    const ForceState& f = force_states_[k];
    const Element& e = force_elements_[k];
    for (int r = 0; r < f.row_count; ++r) {
      const TangentRow& row = f.rows[r];
      const double weight = s * row.k + damping * row.c;
      if (weight == 0.0) continue;
      if (e.cluster >= 0) {
        fill_gradient(e, row.g, slots_.data());
        add_outer(l.fronts[e.cluster], e.first, e.width, slots_.data(), weight);
      } else if (e.body >= 0) {  // a body against the ground: into its own matrix
        BodyData& b = body(e.body);
        const bool side_b = mark(e.b).body >= 0;
        const MarkerData& m = mark(side_b ? e.b : e.a);
        const Vec3& force = side_b ? row.g.Fb : row.g.Fa;
        const Vec3& torque = side_b ? row.g.Tb : row.g.Ta;
        auto g = slots_.head(6 + b.nm);
        g.head<3>() = force;
        g.segment<3>(3) = m.s.r.cross(force) + torque;
        g.tail(b.nm).setZero();
        if (m.local) {
          g.tail(b.nm).noalias() += m.Jr.transpose() * force;
          if (m.rotates) g.tail(b.nm).noalias() += m.Jw.transpose() * torque;
        }
        for (Eigen::Index j = 0; j < g.size(); ++j) b.T.col(j) += (weight * g[j]) * g;
      }
    }
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Element& e = part_elements_[k];
    if (e.cluster < 0) continue;
    MatX& front = l.fronts[e.cluster];
    double* g = l.gradients.data() + e.gradient;
    const PartGradients gradients = constraint_kind(parts_[k].type).gradients;
    if (gradients == PartGradients::unit) {
      fill_distance(e, g);
      add_three_outer(front, e.first, e.width, g, penalty);
      continue;
    }
    for (int r = 0; r < parts_[k].rows(); ++r, g += e.width) {
      fill_gradient(e, rows_[part_offset_[k] + r].gradient, g);
      add_outer(front, e.first, e.width, g, penalty);
    }
    if (geometric && gradients == PartGradients::line) {
      fill_distance(e, slots_.data());
      add_three_outer(front, e.first, e.width, slots_.data(),
                      s * lambda_[part_offset_[k]] / parts_[k].scale);
    }
  }
}

// assembly and factorisation

void RelativeFormulation::assemble_cluster(Cluster& c, MatX& front) noexcept {
  const Eigen::Index ld = front.rows();
  // Composite inertia inside the cluster, leaves to root (theory section 10).
  for (std::size_t k = c.bodies.size(); k-- > 0;) {
    const int i = c.bodies[k];
    BodyData& b = body(i);
    const int width = b.nj + b.nm, at = b.iv - c.offset;
    const int nt = 6 + b.nm;
    const double* T = b.T.data();
    const double* S = b.S.data();
    double* U = b.U.data();
    const Mat3 G_angular = b.G_virial - b.G_virial.trace() * Mat3::Identity();
    const auto geometric = [&](const double* s) -> Vec3 {
      const Eigen::Map<const Vec3> linear(s), angular(s + 3);
      return linear.cross(b.G_force) + G_angular * angular;
    };
    // U = Mz S + [0, N]: what a unit of each coordinate asks of the body's twist.
    for (int j = 0; j < width; ++j) {
      double* u = U + 6 * j;
      if (j < b.nj)
        for (int r = 0; r < 6; ++r) u[r] = 0.0;
      else
        for (int r = 0; r < 6; ++r) u[r] = T[static_cast<Eigen::Index>(6 + j - b.nj) * nt + r];
      if (j >= b.nj && !b.psi) continue;
      const double* x = S + 6 * j;
      for (int p = 0; p < 6; ++p)
        for (int r = 0; r < 6; ++r) u[r] += T[static_cast<Eigen::Index>(p) * nt + r] * x[p];
    }
    // Modes against modes: Y + S^T U + N^T S.
    for (int j = b.nj; j < width; ++j) {
      double* column = front.data() + static_cast<Eigen::Index>(at + j) * ld + at;
      const double* y = T + static_cast<Eigen::Index>(6 + j - b.nj) * nt + 6 - b.nj;
      for (int r = j; r < width; ++r) column[r] += y[r];
      if (!b.psi) continue;
      for (int r = j; r < width; ++r)
        column[r] += dot6(S + 6 * r, U + 6 * j) +
                     dot6(T + static_cast<Eigen::Index>(6 + r - b.nj) * nt, S + 6 * j);
    }
    for (int j = 0; j < b.nj; ++j) {
      Eigen::Map<Vec3>(U + 6 * j + 3) += geometric(S + 6 * j);
    }
    for (int j = 0; j < b.nm; ++j) Eigen::Map<Vec3>(U + 6 * (b.nj + j) + 3) += b.G_modal.col(j);
    for (int j = 0; j < b.nj; ++j) {
      // Coordinate j stands above l, but rotations of one ball have no order: symmetric part.
      const bool above = j < b.ordered;
      double* column = front.data() + static_cast<Eigen::Index>(at + j) * ld + at;
      for (int l = j; l < b.nj; ++l)
        column[l] += above ? dot6(S + 6 * j, U + 6 * l)
                           : 0.5 * (dot6(S + 6 * l, U + 6 * j) + dot6(S + 6 * j, U + 6 * l));
      for (int l = b.nj; l < width; ++l) column[l] += dot6(U + 6 * l, S + 6 * j);
    }
    // Couplings with everything between here and the cluster's parent.
    int current = i;
    while (true) {
      const BodyData& d = body(current);
      if (d.parent < 0) break;
      const BodyData& p = body(d.parent);
      if (d.parent == c.parent) {
        for (int l = 0; l < width; ++l) {
          double* column = front.data() + static_cast<Eigen::Index>(at + l) * ld + c.size;
          for (int r = 0; r < 6; ++r) column[r] += U[6 * l + r];
          if (d.phi) add_transposed_times(d.Phi.data(), p.nm, U + 6 * l, column + 6);
        }
        break;
      }
      const int pj = p.iv - c.offset, py = p.iy - c.offset;
      const auto couple = [&](const double* directions, int count, int column_at) {
        for (int a = 0; a < count; ++a) {
          double* column = front.data() + static_cast<Eigen::Index>(column_at + a) * ld + at;
          add_transposed_times(U, width, directions + 6 * a, column);
        }
      };
      if (d.phi) couple(d.Phi.data(), p.nm, py);
      couple(p.S.data(), p.psi ? p.nj + p.nm : p.nj, pj);
      current = d.parent;
    }
    if (b.parent < 0) continue;
    BodyData& p = body(b.parent);
    p.G_force += b.G_force;
    p.G_virial += b.G_virial;
    if (b.phi)
      for (int q = 0; q < b.nm_parent; ++q) p.G_modal.col(q) += geometric(b.Phi.data() + 6 * q);
    auto Mz = b.T.topLeftCorner<6, 6>();
    if (b.phi) b.MzPhi.noalias() = Mz.lazyProduct(b.Phi);
    if (b.parent != c.parent) {
      p.T.topLeftCorner<6, 6>() += Mz;
      if (b.phi) {
        p.T.topRightCorner(6, p.nm) += b.MzPhi;
        p.T.bottomRightCorner(p.nm, p.nm).noalias() += b.Phi.transpose().lazyProduct(b.MzPhi);
      }
    } else {
      front.block<6, 6>(c.size, c.size) += Mz;
      if (b.phi) {
        front.block(c.size + 6, c.size, b.nm_parent, 6) += b.MzPhi.transpose();
        front.block(c.size + 6, c.size + 6, b.nm_parent, b.nm_parent).noalias() +=
            b.Phi.transpose().lazyProduct(b.MzPhi);
      }
    }
  }
}

int RelativeFormulation::factorize(double mass, double damping, double s, double alpha,
                                   int slot) noexcept {
  gather_geometric(s);
  return eliminate(mass, damping, s, s * alpha, true, linearizations_[slot]);
}

int RelativeFormulation::factorize_metric(double s, double penalty, int slot) noexcept {
  for (BodyData& b : bodies_) {
    b.G_force.setZero();
    b.G_virial.setZero();
    b.G_modal.setZero();
  }
  return eliminate(1.0, 0.0, s, penalty, false, linearizations_[slot]);
}

int RelativeFormulation::eliminate(double mass, double damping, double s, double penalty,
                                   bool geometric, Linearization& linear) noexcept {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    BodyData& b = bodies_[i];
    b.T = b.M;
    if (mass != 1.0) b.T *= mass;
    if (b.nm > 0) {
      const FlexibleBody& data = *model_.bodies[i].data;
      b.T.bottomRightCorner(b.nm, b.nm) += s * data.K;
      if (b.damped && damping != 0.0) b.T.bottomRightCorner(b.nm, b.nm) += damping * data.D;
    }
    linear.bodies[i].S = b.S;
    if (b.phi) linear.bodies[i].Phi = b.Phi;
  }
  for (MatX& front : linear.fronts) clear_lower(front);
  assemble_elements(damping, s, penalty, geometric, linear);
  for (std::size_t k = cluster_order_.size(); k-- > 0;) {
    Cluster& c = clusters_[cluster_order_[k]];
    MatX& front = linear.fronts[cluster_order_[k]];
    assemble_cluster(c, front);
    const int failed = partial_ldlt(front.data(), c.n, c.size, c.original.data());
    if (failed >= 0) return c.offset + failed;
    if (c.parent >= 0) {
      BodyData& p = body(c.parent);
      const int np = c.n - c.size;
      for (int j = 0; j < np; ++j) {
        p.T(j, j) += front(c.size + j, c.size + j);
        for (int i = j + 1; i < np; ++i) {
          const double x = front(c.size + i, c.size + j);
          p.T(i, j) += x;
          p.T(j, i) += x;
        }
      }
    }
  }
  return -1;
}

void RelativeFormulation::solve(VecX& x, int slot) noexcept {
  solve_with(linearizations_[slot], x, nullptr, nullptr);
}

void RelativeFormulation::solve(VecX& x, const VecX& w, VecX& increments, int slot) noexcept {
  solve_with(linearizations_[slot], x, &w, &increments);
}

void RelativeFormulation::solve_with(Linearization& linear, VecX& x, const VecX* w,
                                     VecX* increments) noexcept {
  // Leaves to root: linear terms of the minimisation 1/2 x^T T x - b^T x; body vectors h carry them
  // upwards.
  for (BodyData& b : bodies_) b.h.setZero();
  if (increments) increments->setZero();
  for (std::size_t k = cluster_order_.size(); k-- > 0;) {
    Cluster& c = clusters_[cluster_order_[k]];
    const MatX& front = linear.fronts[cluster_order_[k]];
    double* work = c.work.data();
    for (int j = 0; j < c.size; ++j) work[j] = x[c.offset + j];
    for (int j = c.size; j < c.work.size(); ++j) work[j] = 0.0;
    if (w)
      for (const int part : c.parts) {
        const std::size_t q = part;
        const Element& e = part_elements_[q];
        const double* g = linear.gradients.data() + e.gradient;
        double* out = work + e.first;
        const double* f = w->data() + part_offset_[q];
        if (parts_[q].rows() == 3) {
          for (int j = 0; j < e.width; j += 4)
            lanes(out + j) += f[0] * lanes(g + j) + f[1] * lanes(g + e.width + j) +
                              f[2] * lanes(g + 2 * e.width + j);
          continue;
        }
        for (int r = 0; r < parts_[q].rows(); ++r, g += e.width) {
          for (int j = 0; j < e.width; j += 4) lanes(out + j) += f[r] * lanes(g + j);
        }
      }
    for (std::size_t l = c.bodies.size(); l-- > 0;) {
      const std::size_t i = c.bodies[l];
      BodyData& b = bodies_[i];
      const Linearization::Directions& d = linear.bodies[i];
      const Vec6 hz = b.h.head<6>();
      double* own = work + (b.iv - c.offset);
      add_transposed_times(d.S.data(), b.psi ? b.nj + b.nm : b.nj, hz.data(), own);
      for (int j = 0; j < b.nm; ++j) own[b.nj + j] += b.h[6 + j];
      if (b.parent < 0) continue;
      double* up = b.parent != c.parent ? body(b.parent).h.data() : work + c.size;
      for (int j = 0; j < 6; ++j) up[j] += hz[j];
      if (b.phi) add_transposed_times(d.Phi.data(), b.nm_parent, hz.data(), up + 6);
    }
    partial_forward(front.data(), c.n, c.size, work);
    if (c.parent >= 0) {
      double* up = body(c.parent).h.data();
      for (int j = c.size; j < c.n; ++j) up[j - c.size] += work[j];
    }
  }
  // Root to leaves: h now holds the increments [Z; y] of each body.
  for (const int k : cluster_order_) {
    Cluster& c = clusters_[k];
    const MatX& front = linear.fronts[k];
    double* work = c.work.data();
    if (c.parent >= 0) {
      const double* up = body(c.parent).h.data();
      for (int j = c.size; j < c.n; ++j) work[j] = up[j - c.size];
    }
    partial_backward(front.data(), c.n, c.size, work);
    for (int j = 0; j < c.size; ++j) x[c.offset + j] = work[j];
    if (increments)
      for (const int part : c.parts) {
        const std::size_t q = part;
        const Element& e = part_elements_[q];
        const double* g = linear.gradients.data() + e.gradient;
        const double* in = work + e.first;
        for (int r = 0; r < parts_[q].rows(); ++r, g += e.width) {
          Lanes products = {};
          for (int j = 0; j < e.width; j += 4) products += lanes(g + j) * lanes(in + j);
          (*increments)[part_offset_[q] + r] = sum(products);
        }
      }
    for (const int i : c.bodies) {
      BodyData& b = body(i);
      const Linearization::Directions& d = linear.bodies[i];
      Vec6 z = Vec6::Zero();
      if (b.parent >= 0) {
        const BodyData& p = body(b.parent);
        z = p.h.head<6>();
        if (b.phi) add_times(d.Phi.data(), p.nm, p.h.data() + 6, z.data());
      }
      const double* own = work + (b.iv - c.offset);
      add_times(d.S.data(), b.psi ? b.nj + b.nm : b.nj, own, z.data());
      for (int j = 0; j < b.nm; ++j) b.h[6 + j] = own[b.nj + j];
      b.h.head<6>() = z;
    }
  }
}

}  // namespace floatframe
