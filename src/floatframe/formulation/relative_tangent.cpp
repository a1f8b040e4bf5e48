// Tangent of the relative formulation: composite inertia inside clusters, elimination between them.
#include "floatframe/formulation/relative.hpp"
#include "floatframe/math/partial_ldlt.hpp"

namespace floatframe {

// tangent

void RelativeFormulation::fill_gradient(const Element& e, const WrenchRow& g) noexcept {
  const auto n = static_cast<Eigen::Index>(e.columns.size());
  slots_.head(n).setZero();
  for (std::size_t k = 0; k < e.path.size(); ++k) {
    const PathEntry& p = e.path[k];
    const MarkerData& m = mark(p.marker);
    const Vec3& force = p.side_b ? g.Fb : g.Fa;
    const Vec3& torque = p.side_b ? g.Tb : g.Ta;
    double* out = slots_.data() + e.entry_slot[k];
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
    const BodyData& b = body(p.body);
    switch (p.what) {
      case PathEntry::What::joint:
        for (int j = 0; j < p.count; ++j) out[j] += b.b.col(j).dot(f);
        break;
      case PathEntry::What::own_modes:
        for (int j = 0; j < p.count; ++j) out[j] -= b.Psi.col(j).dot(f);
        break;
      case PathEntry::What::parent_modes:
        for (int j = 0; j < p.count; ++j) out[j] += b.Phi.col(j).dot(f);
        break;
      case PathEntry::What::marker_modes:
        break;
    }
  }
}

void RelativeFormulation::add_rank_one(const Element& e, const WrenchRow& g,
                                       double weight) noexcept {
  if (weight == 0.0) return;
  fill_gradient(e, g);
  Cluster& c = clusters_[static_cast<std::size_t>(e.cluster)];
  const std::size_t n = e.columns.size();
  for (std::size_t j = 0; j < n; ++j) {
    const double w = weight * slots_[static_cast<Eigen::Index>(j)];
    if (w == 0.0) continue;
    double* column = c.front.data() + static_cast<Eigen::Index>(e.columns[j]) * c.front.rows();
    for (std::size_t i = j; i < n; ++i)
      column[e.columns[i]] += w * slots_[static_cast<Eigen::Index>(i)];
  }
}

void RelativeFormulation::add_isotropic(const Element& e, double weight) noexcept {
  // J = d(r_b - r_a)/d(columns), 3 x n, column by column in slots_; front += weight J^T J.
  const auto n = static_cast<Eigen::Index>(e.columns.size());
  slots_.head(3 * n).setZero();
  for (std::size_t k = 0; k < e.path.size(); ++k) {
    const PathEntry& p = e.path[k];
    const MarkerData& m = mark(p.marker);
    const double sign = p.side_b ? 1.0 : -1.0;
    double* out = slots_.data() + 3 * e.entry_slot[k];
    if (p.what == PathEntry::What::marker_modes) {
      for (int j = 0; j < 3 * p.count; ++j) out[j] += sign * m.Jr.data()[j];
      continue;
    }
    const BodyData& b = body(p.body);
    const Mat6X& columns = p.what == PathEntry::What::joint       ? b.b
                           : p.what == PathEntry::What::own_modes ? b.Psi
                                                                  : b.Phi;
    const double factor = p.what == PathEntry::What::own_modes ? -sign : sign;
    const Vec3 r = m.s.r;
    for (int j = 0; j < p.count; ++j) {
      const double* c = columns.data() + 6 * j;
      out[3 * j] += factor * (c[0] + c[4] * r[2] - c[5] * r[1]);
      out[3 * j + 1] += factor * (c[1] + c[5] * r[0] - c[3] * r[2]);
      out[3 * j + 2] += factor * (c[2] + c[3] * r[1] - c[4] * r[0]);
    }
  }
  Cluster& c = clusters_[static_cast<std::size_t>(e.cluster)];
  const double* J = slots_.data();
  for (Eigen::Index j = 0; j < n; ++j) {
    const double x = weight * J[3 * j], y = weight * J[3 * j + 1], z = weight * J[3 * j + 2];
    double* column =
        c.front.data() +
        static_cast<Eigen::Index>(e.columns[static_cast<std::size_t>(j)]) * c.front.rows();
    for (Eigen::Index i = j; i < n; ++i)
      column[e.columns[static_cast<std::size_t>(i)]] +=
          x * J[3 * i] + y * J[3 * i + 1] + z * J[3 * i + 2];
  }
}

void RelativeFormulation::assemble_cluster(Cluster& c) noexcept {
  // Composite inertia inside the cluster, leaves to root (theory section 10).
  for (std::size_t k = c.bodies.size(); k-- > 0;) {
    const int i = c.bodies[k];
    BodyData& b = body(i);
    const int ij = b.iv - c.offset, iy = b.iy - c.offset;
    auto Mz = b.T.topLeftCorner<6, 6>();
    if (b.nm > 0) {
      auto N = b.T.topRightCorner(6, b.nm);
      auto Y = b.T.bottomRightCorner(b.nm, b.nm);
      if (b.psi) {  // from the body frame to marker M
        b.U.leftCols(b.nm).noalias() = Mz * b.Psi;
        Y.noalias() -= b.Psi.transpose() * N;
        Y.noalias() -= N.transpose() * b.Psi;
        Y.noalias() += b.Psi.transpose() * b.U.leftCols(b.nm);
        N -= b.U.leftCols(b.nm);
      }
      c.front.block(iy, iy, b.nm, b.nm) += Y;
      b.U.rightCols(b.nm) = N;
      b.U.bottomRightCorner(3, b.nm) += b.G_modal;
    }
    const Mat3 G_angular = b.G_virial - b.G_virial.trace() * Mat3::Identity();
    const auto geometric = [&](const auto& s) -> Vec3 {
      return s.template head<3>().cross(b.G_force) + G_angular * s.template tail<3>();
    };
    for (int j = 0; j < b.nj; ++j) {
      b.U.col(j).noalias() = Mz * b.b.col(j);
      b.U.col(j).tail<3>() += geometric(b.b.col(j));
    }
    for (int j = 0; j < b.nj; ++j) {
      // Coordinate j stands above l, but rotations of one ball have no order: symmetric part.
      const bool above = (b.type == JointType::free && j < 3) || b.type == JointType::cylindrical ||
                         b.type == JointType::universal;
      for (int l = j; l < b.nj; ++l)
        c.front(ij + l, ij + j) +=
            above ? b.b.col(j).dot(b.U.col(l))
                  : 0.5 * (b.b.col(l).dot(b.U.col(j)) + b.b.col(j).dot(b.U.col(l)));
      for (int l = 0; l < b.nm; ++l) c.front(iy + l, ij + j) += b.U.col(b.nj + l).dot(b.b.col(j));
    }
    // Couplings with everything between here and the cluster's parent.
    const int width = b.nj + b.nm;
    int current = i;
    while (true) {
      const BodyData& d = body(current);
      if (d.parent < 0) break;
      const bool inside = d.parent != c.parent;
      const BodyData& p = body(d.parent);
      if (inside) {
        const int pj = p.iv - c.offset, py = p.iy - c.offset;
        if (d.phi)
          for (int a = 0; a < p.nm; ++a)
            for (int l = 0; l < width; ++l) c.front(ij + l, py + a) += d.Phi.col(a).dot(b.U.col(l));
        for (int a = 0; a < p.nj; ++a)
          for (int l = 0; l < width; ++l) c.front(ij + l, pj + a) += p.b.col(a).dot(b.U.col(l));
        if (p.psi)
          for (int a = 0; a < p.nm; ++a)
            for (int l = 0; l < width; ++l) c.front(ij + l, py + a) -= p.Psi.col(a).dot(b.U.col(l));
        current = d.parent;
        continue;
      }
      c.front.block(c.size, ij, 6, width) += b.U;
      if (d.phi) c.front.block(c.size + 6, ij, p.nm, width).noalias() += d.Phi.transpose() * b.U;
      break;
    }
    if (b.parent < 0) continue;
    {
      BodyData& p = body(b.parent);
      p.G_force += b.G_force;
      p.G_virial += b.G_virial;
      if (b.phi)
        for (int k2 = 0; k2 < b.nm_parent; ++k2) p.G_modal.col(k2) += geometric(b.Phi.col(k2));
    }
    if (b.phi) b.MzPhi.noalias() = Mz * b.Phi;
    if (b.parent != c.parent) {
      BodyData& p = body(b.parent);
      p.T.topLeftCorner<6, 6>() += Mz;
      if (b.phi) {
        p.T.topRightCorner(6, p.nm) += b.MzPhi;
        p.T.bottomRightCorner(p.nm, p.nm).noalias() += b.Phi.transpose() * b.MzPhi;
      }
    } else {
      c.front.block<6, 6>(c.size, c.size) += Mz;
      if (b.phi) {
        c.front.block(c.size + 6, c.size, b.nm_parent, 6) += b.MzPhi.transpose();
        c.front.block(c.size + 6, c.size + 6, b.nm_parent, b.nm_parent).noalias() +=
            b.Phi.transpose() * b.MzPhi;
      }
    }
  }
}

int RelativeFormulation::factorize(double mass, double damping, double s, double alpha) noexcept {
  for (const int i : order_) {
    BodyData& b = body(i);
    b.T.noalias() = mass * b.M;
    if (b.nm > 0) {
      const FlexibleBody& data = *model_.bodies[static_cast<std::size_t>(i)].data;
      b.T.bottomRightCorner(b.nm, b.nm) += s * data.K + damping * data.D;
    }
    b.G_force = s * b.g_force;
    b.G_virial = s * b.g_virial;
    b.G_modal = s * b.g_modal;
  }
  for (Cluster& c : clusters_) c.front.setZero();
  for (std::size_t k = 0; k < model_.forces.size(); ++k) {
    const ForceState& f = force_states_[k];
    const Element& e = force_elements_[k];
    for (int r = 0; r < f.row_count; ++r) {
      const TangentRow& row = f.rows[r];
      const double weight = s * row.k + damping * row.c;
      if (e.cluster >= 0) {
        add_rank_one(e, row.g, weight);
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
    if (parts_[k].kind == ConstraintPart::Kind::coincident) {
      add_isotropic(e, s * alpha);
      continue;
    }
    for (int r = 0; r < parts_[k].rows(); ++r)
      add_rank_one(e, rows_[static_cast<std::size_t>(part_offset_[k] + r)].gradient, s * alpha);
    if (parts_[k].kind == ConstraintPart::Kind::distance)  // its gradient d/L turns with the rod
      add_isotropic(e, s * lambda_[part_offset_[k]] / parts_[k].scale);
  }

  for (std::size_t k = cluster_order_.size(); k-- > 0;) {
    Cluster& c = clusters_[static_cast<std::size_t>(cluster_order_[k])];
    assemble_cluster(c);
    const int failed = partial_ldlt(c.front.data(), static_cast<int>(c.front.rows()), c.n, c.size,
                                    c.original.data());
    if (failed >= 0) return c.offset + failed;
    if (c.parent >= 0) {
      BodyData& p = body(c.parent);
      const int np = c.n - c.size;
      for (int j = 0; j < np; ++j) {
        p.T(j, j) += c.front(c.size + j, c.size + j);
        for (int i = j + 1; i < np; ++i) {
          const double x = c.front(c.size + i, c.size + j);
          p.T(i, j) += x;
          p.T(j, i) += x;
        }
      }
    }
  }
  return -1;
}

void RelativeFormulation::solve(VecX& x) noexcept {
  // Leaves to root: linear terms of the minimisation 1/2 x^T T x - b^T x; body vectors h carry them
  // upwards.
  for (BodyData& b : bodies_) b.h.setZero();
  for (std::size_t k = cluster_order_.size(); k-- > 0;) {
    Cluster& c = clusters_[static_cast<std::size_t>(cluster_order_[k])];
    c.work.head(c.size) = x.segment(c.offset, c.size);
    c.work.tail(c.n - c.size).setZero();
    for (std::size_t l = c.bodies.size(); l-- > 0;) {
      BodyData& b = body(c.bodies[l]);
      const Vec6 hz = b.h.head<6>();
      if (b.psi) b.h.tail(b.nm).noalias() -= b.Psi.transpose() * hz;
      c.work.segment(b.iy - c.offset, b.nm) += b.h.tail(b.nm);
      for (int j = 0; j < b.nj; ++j) c.work[b.iv - c.offset + j] += b.b.col(j).dot(hz);
      if (b.parent < 0) continue;
      if (b.parent != c.parent) {
        BodyData& p = body(b.parent);
        p.h.head<6>() += hz;
        if (b.phi) p.h.tail(p.nm).noalias() += b.Phi.transpose() * hz;
      } else {
        c.work.segment<6>(c.size) += hz;
        if (b.phi) c.work.tail(b.nm_parent).noalias() += b.Phi.transpose() * hz;
      }
    }
    partial_forward(c.front.data(), static_cast<int>(c.front.rows()), c.n, c.size, c.work.data());
    if (c.parent >= 0) body(c.parent).h += c.work.tail(c.n - c.size);
  }
  // Root to leaves: h now holds the increments [Z; y] of each body.
  for (const int k : cluster_order_) {
    Cluster& c = clusters_[static_cast<std::size_t>(k)];
    if (c.parent >= 0) c.work.tail(c.n - c.size) = body(c.parent).h;
    partial_backward(c.front.data(), static_cast<int>(c.front.rows()), c.n, c.size, c.work.data());
    x.segment(c.offset, c.size) = c.work.head(c.size);
    for (const int i : c.bodies) {
      BodyData& b = body(i);
      Vec6 z = Vec6::Zero();
      if (b.parent >= 0) {
        const BodyData& p = body(b.parent);
        z = p.h.head<6>();
        if (b.phi) z.noalias() += b.Phi * p.h.tail(p.nm);
      }
      for (int j = 0; j < b.nj; ++j) z += b.b.col(j) * x[b.iv + j];
      b.h.tail(b.nm) = x.segment(b.iy, b.nm);
      if (b.psi) z.noalias() -= b.Psi * b.h.tail(b.nm);
      b.h.head<6>() = z;
    }
  }
}

}  // namespace floatframe
