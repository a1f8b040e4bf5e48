#include "floatframe/reduction/bar_second_order.hpp"

#include <algorithm>
#include <set>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/quadrature.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/rigid_motion.hpp"
#include "floatframe/reduction/fixed_interface.hpp"

namespace floatframe {
namespace {

/// Above this only nodes with a name are kept.
constexpr int many_nodes = 2000;

/// Slopes and twist of a beam in its own axes.
struct BentBeam {
  double L = 0.0;
  Mat3 T;
  Eigen::Matrix<double, 12, Eigen::Dynamic> q;  ///< displacements of the ends, local axes

  BentBeam(const ElementInput& in, const Element& e, const MatX& X)
      : L((in.p[1] - in.p[0]).norm()), T(beam_axes(in)), q(12, X.cols()) {
    for (int a = 0; a < 4; ++a)
      q.middleRows<3>(3 * a) = T.transpose() * X.middleRows<3>(6 * e.nodes[a / 2] + 3 * (a % 2));
  }

  /// Rows rx, -w', v' at s = x/L.
  Mat3X rotation(double s) const {
    const double s2 = s * s;
    const double d[4] = {(-6 * s + 6 * s2) / L, 1 - 4 * s + 3 * s2, (6 * s - 6 * s2) / L,
                         3 * s2 - 2 * s};
    Mat3X r(3, q.cols());
    r.row(0) = (1 - s) * q.row(3) + s * q.row(9);
    r.row(1) = -d[0] * q.row(2) + d[1] * q.row(4) - d[2] * q.row(8) + d[3] * q.row(10);
    r.row(2) = d[0] * q.row(1) + d[1] * q.row(5) + d[2] * q.row(7) + d[3] * q.row(11);
    return r;
  }

  /// X_e^T G_e X_e, from the slope of the chord and those of the ends.
  MatX gamma() const {
    MatX sum = MatX::Zero(q.cols(), q.cols());
    for (const auto& [u, r, sign] : {std::tuple{1, 5, 1.0}, {2, 4, -1.0}}) {
      const VecX s = (q.row(u + 6) - q.row(u)).transpose() / L;
      const VecX a = sign * q.row(r).transpose(), b = sign * q.row(r + 6).transpose();
      const VecX t = a + b;
      MatX half = 18.0 * s * s.transpose() - 3.0 * s * t.transpose();
      half += 2.0 * (a * a.transpose() + b * b.transpose()) - a * b.transpose();
      sum += L / 30.0 * (half + half.transpose());
    }
    return sum;
  }
};

Eigen::Index pairs(Eigen::Index nm) { return nm * (nm + 1) / 2; }

/// Lower half of a symmetric matrix as a row.
VecX packed(const MatX& m) {
  VecX out(pairs(m.rows()));
  Eigen::Index k = 0;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j <= i; ++j) out(k++) = m(i, j);
  return out;
}

template <class Row>
void unpack(const Row& row, Eigen::Ref<MatX> m) {
  Eigen::Index k = 0;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j <= i; ++j) m(i, j) = m(j, i) = row(k++);
}

/// Displacements of second order of one pair of modes in each column, six rows per node.
class FollowingFrame {
 public:
  FollowingFrame(const FeModel& model, const MatX& X)
      : model_(model), gamma_(model.elements.size()) {
    for (std::size_t e = 0; e < model.elements.size(); ++e) {
      const Element& element = model.elements[e];
      gamma_[e] = packed(BentBeam(gather(model, element), element, X).gamma());
    }
    columns_ = pairs(X.cols());
  }

  /// Free of strain, the first node at rest; nothing if the frame has loops or pieces.
  std::optional<MatX> tree() const {
    std::vector<std::vector<std::pair<int, bool>>> at(model_.positions.size());
    for (std::size_t e = 0; e < model_.elements.size(); ++e) {
      at[model_.elements[e].nodes[0]].emplace_back(static_cast<int>(e), true);
      at[model_.elements[e].nodes[1]].emplace_back(static_cast<int>(e), false);
    }
    if (model_.elements.size() + 1 != at.size()) return std::nullopt;
    MatX h = MatX::Zero(6 * model_.nodes(), columns_);
    std::vector<char> seen(at.size(), 0);
    std::vector<int> next = {0};
    seen[0] = 1;
    for (std::size_t i = 0; i < next.size(); ++i) {
      for (const auto& [e, outward] : at[next[i]]) {
        const Element& element = model_.elements[e];
        const int other = element.nodes[outward ? 1 : 0];
        if (seen[other] != 0) continue;
        seen[other] = 1;
        next.push_back(other);
        const Vec3 x = beam_axes(gather(model_, element)).col(0) * (outward ? -1.0 : 1.0);
        h.middleRows<3>(6 * other) = h.middleRows<3>(6 * next[i]) + x * gamma_[e].transpose();
      }
    }
    if (next.size() != at.size()) return std::nullopt;
    return h;
  }

  /// Moves the strain-free frame as a rigid body so that six dofs are at rest.
  void hold(const std::vector<int>& held, MatX& h) const {
    Mat6 A;
    for (Eigen::Index i = 0; i < 6; ++i) {
      const int dof = held[i];
      A.row(i) = rigid_motion_at(model_.positions[dof / 6]).row(dof % 6);
    }
    const MatX q = lu_solve(A, MatX(-h(held, Eigen::all)));
    for (int k = 0; k < model_.nodes(); ++k)
      h.middleRows<6>(6 * k) += rigid_motion_at(model_.positions[k]) * q;
  }

  /// Nothing if the direct factors have no digits.
  std::optional<MatX> with_strain(const std::vector<int>& held) const {
    MatX f = MatX::Zero(6 * model_.nodes(), columns_);
    for (std::size_t e = 0; e < model_.elements.size(); ++e) {
      const Element& element = model_.elements[e];
      const ElementInput in = gather(model_, element);
      const double L = (in.p[1] - in.p[0]).norm();
      const Vec3 force = in.material.young * in.section.A / L * beam_axes(in).col(0);
      f.middleRows<3>(6 * element.nodes[0]) += force * gamma_[e].transpose();
      f.middleRows<3>(6 * element.nodes[1]) -= force * gamma_[e].transpose();
    }
    const SparseMatrix K = assemble_stiffness(model_);
    const SparseMatrix no_mass(K.rows(), K.cols());
    try {
      const FixedInterface fixed(K, no_mass, {}, held, [](int) { return std::string(); });
      return fixed.inner_response(f);
    } catch (const InputError&) {
      return std::nullopt;  // very many elements: the modes went another way (bar_chains.hpp)
    }
  }

 private:
  const FeModel& model_;
  std::vector<VecX> gamma_;
  Eigen::Index columns_ = 0;
};

/// What the foreshortening inside of the elements adds to what is linear between the nodes:
///   h(x) = linear - e_1 (int_0^x f dx - x/L gamma),  f = v'^T v' + w'^T w'
///   int h dm = linear - e_1 rho A int (L/2 - x) f dx
///   int x h dm = linear - e_1 rho A int (L^2/6 - x^2/2) f dx
/// and the second order of the rotation of sections.
void add_inside(const ElementInput& in, const BentBeam& beam, bool section_inertia,
                SecondOrder& out) {
  static const LineRule rule = gauss_jacobi(5, 0);
  const Eigen::Index nm = beam.q.cols();
  MatX D0 = MatX::Zero(nm, nm), D1 = D0;
  const double rho = in.material.density;
  const Mat3 P =
      rho * beam.T * Vec3(0.0, in.section.Iz, in.section.Iy).asDiagonal() * beam.T.transpose();
  for (int g = 0; g < 5; ++g) {
    const double x = rule.u(g) * beam.L, dx = rule.weight(g) * beam.L;
    const Mat3X r = beam.rotation(rule.u(g));
    const MatX f = dx * rho * in.section.A * r.bottomRows<2>().transpose() * r.bottomRows<2>();
    D0 -= (0.5 * beam.L - x) * f;
    D1 -= (beam.L * beam.L / 6.0 - 0.5 * x * x) * f;
    if (section_inertia) add_turning(P * dx, beam.T * r, out);
  }
  const Vec3 e = beam.T.col(0);
  for (int j = 0; j < 3; ++j) {
    out.S2[j] += e(j) * D0;
    for (int i = 0; i < 3; ++i) out.S2i[i][j] += e(j) * (in.p[0](i) * D0 + e(i) * D1);
  }
}

}  // namespace

std::vector<int> held_dofs(const FeModel& model, const MatX& X, const ReductionOptions& options) {
  std::set<int> held;
  const auto hold = [&](int node, unsigned mask) {
    for (int axis = 0; axis < 6; ++axis)
      if (((mask >> axis) & 1u) != 0) held.insert(6 * node + axis);
  };
  if (options.analytic && !options.basis) {
    hold(model.elements.front().nodes[0], all_dofs);
  } else if (!options.clamped.empty()) {
    for (const NodeDofs& c : options.clamped) {
      const int node = c.node.empty() ? c.index : model.find_node(c.node);
      if (node >= 0 && node < model.nodes()) hold(node, c.mask);
    }
  } else {
    for (int k = 0; k < model.nodes() && held.empty(); ++k)
      if (X.middleRows<6>(6 * k).isZero(0.0)) hold(k, all_dofs);
  }
  return {held.begin(), held.end()};
}

std::optional<BarSecondOrder> bar_second_order(const FeModel& model, const MatX& X,
                                               const ReductionOptions& options) {
  const Eigen::Index nm = X.cols();
  if (nm == 0 || model.elements.empty() || X.rows() != 6 * model.nodes()) return std::nullopt;
  for (const Element& e : model.elements)
    if (e.type != ElementType::beam2) return std::nullopt;
  const std::vector<int> held = held_dofs(model, X, options);
  if (held.size() < 6) return std::nullopt;
  const FollowingFrame frame(model, X);
  std::optional<MatX> u = held.size() == 6 ? frame.tree() : std::nullopt;
  if (u) {
    frame.hold(held, *u);
  } else {
    u = frame.with_strain(held);
  }
  if (!u) return std::nullopt;
  BarSecondOrder out;
  out.h.resize(3 * nm * model.nodes(), nm);
  out.theta.resize(out.h.rows(), nm);
  for (int k = 0; k < model.nodes(); ++k)
    for (int j = 0; j < 3; ++j) {
      unpack(u->row(6 * k + j), out.h.middleRows(nm * (3 * k + j), nm));
      unpack(u->row(6 * k + 3 + j), out.theta.middleRows(nm * (3 * k + j), nm));
    }
  return out;
}

std::shared_ptr<const SecondOrder> second_order_of(const FeModel& model, const MatX& X,
                                                   const BarSecondOrder& field,
                                                   const ReductionOptions& options) {
  const Eigen::Index nm = X.cols();
  auto out = std::make_shared<SecondOrder>(SecondOrder::zero(static_cast<int>(nm)));
  const SparseRows M = assemble_scalar_mass(model);
  // int dm and int r_ui dm at each node.
  MatX weights = MatX::Zero(model.nodes(), 4);
  for (int k = 0; k < model.nodes(); ++k)
    for (SparseRows::InnerIterator it(M, k); it; ++it) {
      weights(k, 3) += it.value();
      weights.row(k).head<3>() += it.value() * model.positions[it.col()].transpose();
    }
  for (int k = 0; k < model.nodes(); ++k)
    for (int j = 0; j < 3; ++j) {
      const MatX h = field.h.middleRows(nm * (3 * k + j), nm);
      out->S2[j] += weights(k, 3) * h;
      for (int i = 0; i < 3; ++i) out->S2i[i][j] += weights(k, i) * h;
    }
  if (options.mass_model != MassModel::isoparametric) {
    for (const Element& e : model.elements) {
      const ElementInput in = gather(model, e);
      add_inside(in, BentBeam(in, e, X), options.section_inertia, *out);
    }
    for (const PointMass& p : model.masses) {
      const Mat3 P = 0.5 * p.J.trace() * Mat3::Identity() - p.J;  // (21)
      add_turning(P, X.middleRows<3>(6 * p.node + 3), *out);
    }
  }
  for (int k = 0; k < model.nodes(); ++k) {
    if (model.nodes() > many_nodes && (model.node_names.empty() || model.node_names[k].empty()))
      continue;
    SecondOrderNode& node = out->nodes.emplace_back();
    node.node = k;
    for (int j = 0; j < 3; ++j) {
      node.h[j] = field.h.middleRows(nm * (3 * k + j), nm);
      node.theta[j] = field.theta.middleRows(nm * (3 * k + j), nm);
    }
  }
  return out;
}

}  // namespace floatframe
