#include "floatframe/reduction/bar_second_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/memory_room.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/quadrature.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/reduction/following_frame.hpp"

namespace floatframe {
namespace {

/// Above this limit only nodes with a name are kept.
constexpr int many_nodes = 2000;
/// Limit of the numbers of all nodes that are kept by default.
constexpr Eigen::Index default_memory_limit = 1 << 19;
/// Numbers of one group of pairs of modes.
constexpr Eigen::Index group_numbers = 1 << 23;

/// Second moments of the mass of a section per length, body axes.
Mat3 section_moments(const ElementInput& in, const Mat3& T) {
  const Vec3 own = in.material.density * Vec3(0.0, in.section.Iz, in.section.Iy);
  return T * own.asDiagonal() * T.transpose();
}

Mat3 moments_of(const PointMass& p) { return 0.5 * p.J.trace() * Mat3::Identity() - p.J; }  // (21)

bool sections_turn(const ReductionOptions& options) {
  return options.mass_model == MassModel::hermite && options.section_inertia;
}

/// Masses that rotate with nodes: sections and point masses; null: none.
std::shared_ptr<SecondOrder> turning_of(const FeModel& model, const MatX& X,
                                        const ReductionOptions& options) {
  const bool masses = options.mass_model == MassModel::hermite &&
                      std::any_of(model.masses.begin(), model.masses.end(),
                                  [](const PointMass& p) { return !p.J.isZero(0.0); });
  if (!sections_turn(options) && !masses) return nullptr;
  auto out = std::make_shared<SecondOrder>(SecondOrder::zero(static_cast<int>(X.cols())));
  if (masses)
    for (const PointMass& p : model.masses)
      add_turning(moments_of(p), X.middleRows<3>(6 * p.node + 3), *out);
  if (!sections_turn(options)) return out;
  static const LineRule rule = gauss_jacobi(5, 0);
  for (const FeElement& e : model.elements) {
    const ElementInput in = gather(model, e);
    const BentBeam beam(in, e, X);
    const Mat3 P = section_moments(in, beam.T);
    for (int g = 0; g < 5; ++g)
      add_turning(P * (rule.weight(g) * beam.L), beam.T * beam.rotation(rule.u(g)), *out);
  }
  return out;
}

/// Contribution of the foreshortening inside the elements to the part linear between the nodes:
///   h(x) = linear - e_1 (int_0^x f dx - x/L gamma),  f = v'^T v' + w'^T w'
///   int h dm = linear - e_1 rho A int (L/2 - x) f dx
///   int x h dm = linear - e_1 rho A int (L^2/6 - x^2/2) f dx
void add_shortening_inside(const ElementInput& in, const BentBeam& beam, SecondOrder& out) {
  static const LineRule rule = gauss_jacobi(5, 0);
  const Eigen::Index nm = beam.q.cols();
  MatX D0 = MatX::Zero(nm, nm), D1 = D0;
  for (int g = 0; g < 5; ++g) {
    const double x = rule.u(g) * beam.L, dx = rule.weight(g) * beam.L;
    const Mat3X r = beam.rotation(rule.u(g));
    const MatX f =
        dx * in.material.density * in.section.A * r.bottomRows<2>().transpose() * r.bottomRows<2>();
    D0 -= (0.5 * beam.L - x) * f;
    D1 -= (beam.L * beam.L / 6.0 - 0.5 * x * x) * f;
  }
  const Vec3 e = beam.T.col(0);
  for (int j = 0; j < 3; ++j) {
    out.S2[j] += e(j) * D0;
    for (int i = 0; i < 3; ++i) out.S2i[i][j] += e(j) * (in.p[0](i) * D0 + e(i) * D1);
  }
}

/// And the twist: int (int_0^x g dx - x/L tau) dx = int (L/2 - x) g dx, g = v'^T w'' - w'^T v'',
/// which rotates the sections about the axis.
void add_twist_inside(const ElementInput& in, const BentBeam& beam, SecondOrder& out) {
  static const LineRule rule = gauss_jacobi(5, 0);
  const Eigen::Index nm = beam.q.cols();
  MatX D = MatX::Zero(nm, nm);
  for (int g = 0; g < 5; ++g) {
    const double x = rule.u(g) * beam.L, dx = rule.weight(g) * beam.L;
    const Mat3X r = beam.rotation(rule.u(g));
    const auto k = beam.curvature(rule.u(g));
    // -w' and v' against -w'' and v''.
    const MatX half = 0.5 * (r.row(1).transpose() * k.row(1) - r.row(2).transpose() * k.row(0));
    D += (0.5 * beam.L - x) * dx * (half + half.transpose());
  }
  const Mat3 turned = skew(Vec3(beam.T.col(0))) * section_moments(in, beam.T);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) out.S2i[i][j] += turned(j, i) * D;
}

/// Nodal forces and moments of the loads rho e_j (rows j) and rho r_i e_j (rows 3 + 3 i + j), with
/// displacements that are linear between the nodes; moments of masses rotating with them.
MatX load_rows(const FeModel& model, const ReductionOptions& options) {
  MatX rows = MatX::Zero(12, 6 * model.nodes());
  const SparseRows M = assemble_scalar_mass(model);
  for (int k = 0; k < model.nodes(); ++k)
    for (SparseRows::InnerIterator it(M, k); it; ++it) {
      const Vec3 moment = it.value() * model.positions[it.col()];
      for (int j = 0; j < 3; ++j) {
        rows(j, 6 * k + j) += it.value();
        for (int i = 0; i < 3; ++i) rows(3 + 3 * i + j, 6 * k + j) += moment(i);
      }
    }
  if (options.mass_model != MassModel::hermite) return rows;
  const auto turn = [&](int node, const Mat3& P) {
    for (int i = 0; i < 3; ++i) rows.block<3, 3>(3 + 3 * i, 6 * node + 3) -= skew(Vec3(P.col(i)));
  };
  for (const PointMass& p : model.masses) turn(p.node, moments_of(p));
  if (!options.section_inertia) return rows;
  for (const FeElement& e : model.elements) {
    const ElementInput in = gather(model, e);
    const Mat3 P = 0.5 * (in.p[1] - in.p[0]).norm() * section_moments(in, beam_axes(in));
    for (int k = 0; k < 2; ++k) turn(e.nodes[k], P);
  }
  return rows;
}

/// integrals: a row for each load, a column for each pair.
void add_pairs(const MatX& integrals, const std::vector<ModePair>& pairs, SecondOrder& out) {
  const auto add = [&](Eigen::Index row, MatX& m) {
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const auto [a, b] = pairs[p];
      m(a, b) += integrals(row, static_cast<Eigen::Index>(p));
      if (a != b) m(b, a) += integrals(row, static_cast<Eigen::Index>(p));
    }
  };
  for (int j = 0; j < 3; ++j) {
    add(j, out.S2[j]);
    for (int i = 0; i < 3; ++i) add(3 + 3 * i + j, out.S2i[i][j]);
  }
}

bool keeps_all(const FeModel& model, Eigen::Index nm, bool all_nodes) {
  return model.nodes() <= many_nodes &&
         (all_nodes || 6 * nm * nm * model.nodes() <= default_memory_limit);
}

/// Memory: per mode the deformation of each element, per two modes the displacements of nodes.
void require_memory(const FeModel& model, Eigen::Index nm, bool all_nodes, bool projection) {
  constexpr double of_mode = 360.0;  // numbers of an element
  const double of_pairs = (keeps_all(model, nm, all_nodes) ? 6.0 : 0.0) + (projection ? 3.0 : 0.0);
  const auto modes = static_cast<double>(nm);
  const std::string complaint =
      memory_complaint(8.0 * model.nodes() * modes * (of_mode + of_pairs * modes));
  if (!complaint.empty())
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("the reduction of {} nodes to {} modes {}; fewer modes or "
                                 "elements are enough for nearly every body",
                                 model.nodes(), nm, complaint));
}

std::vector<SecondOrderNode> kept_nodes(const FeModel& model, Eigen::Index nm, bool all_nodes) {
  const bool all = keeps_all(model, nm, all_nodes);
  std::vector<SecondOrderNode> nodes;
  for (int k = 0; k < model.nodes(); ++k) {
    if (!all && (model.node_names.empty() || model.node_names[k].empty())) continue;
    SecondOrderNode& node = nodes.emplace_back();
    node.node = k;
    node.h.fill(MatX::Zero(nm, nm));
    node.theta.fill(MatX::Zero(nm, nm));
  }
  return nodes;
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

BarSecondOrder bar_second_order(const FeModel& model, const MatX& X,
                                const ReductionOptions& options, bool all_nodes) {
  BarSecondOrder out;
  const Eigen::Index nm = X.cols();
  if (nm == 0 || model.elements.empty() || X.rows() != 6 * model.nodes()) return out;
  for (const FeElement& e : model.elements)
    if (e.type != FeElementType::beam2) return out;
  const std::shared_ptr<SecondOrder> turning = turning_of(model, X, options);
  out.turning = turning;
  const std::vector<int> held = held_dofs(model, X, options);
  if (held.size() < 6) return out;
  require_memory(model, nm, all_nodes, all_nodes && options.mass_model != MassModel::hermite);
  const FollowingFrame frame(model, X, held);
  if (!frame.known()) return out;

  auto second_order = std::make_shared<SecondOrder>(SecondOrder::zero(static_cast<int>(nm)));
  second_order->nodes = kept_nodes(model, nm, all_nodes);
  if (all_nodes && options.mass_model != MassModel::hermite)
    out.h.resize(3 * nm * model.nodes(), nm);
  const MatX loads = load_rows(model, options);
  const std::vector<ModePair> pairs = mode_pairs(nm);
  const auto group = static_cast<std::size_t>(
      std::max<Eigen::Index>(1, group_numbers / (6 * Eigen::Index{model.nodes()})));
  MatX shortened(12, static_cast<Eigen::Index>(pairs.size())), twisted = shortened;
  for (std::size_t first = 0; first < pairs.size(); first += group) {
    const std::size_t count = std::min(group, pairs.size() - first);
    const auto at = static_cast<Eigen::Index>(first), n = static_cast<Eigen::Index>(count);
    MatX u = frame.follow(FollowingFrame::Strain::shortening, pairs, first, count);
    shortened.middleCols(at, n) = loads * u;
    const MatX twist = frame.follow(FollowingFrame::Strain::twist, pairs, first, count);
    twisted.middleCols(at, n) = loads * twist;
    u += twist;
    for (Eigen::Index p = 0; p < n; ++p) {
      const auto [a, b] = pairs[first + static_cast<std::size_t>(p)];
      for (SecondOrderNode& node : second_order->nodes)
        for (int j = 0; j < 3; ++j) {
          node.h[j](a, b) = node.h[j](b, a) = u(6 * node.node + j, p);
          node.theta[j](a, b) = node.theta[j](b, a) = u(6 * node.node + 3 + j, p);
        }
      for (int k = 0; out.h.size() > 0 && k < model.nodes(); ++k)
        for (int j = 0; j < 3; ++j) {
          const Eigen::Index row = nm * (3 * k + j);
          out.h(row + a, b) = out.h(row + b, a) = u(6 * k + j, p);
        }
    }
  }
  add_pairs(shortened, pairs, *second_order);
  add_pairs(twisted, pairs, turning ? *turning : *second_order);
  if (options.mass_model != MassModel::isoparametric)
    for (const FeElement& e : model.elements) {
      const ElementInput in = gather(model, e);
      const BentBeam beam(in, e, X);
      add_shortening_inside(in, beam, *second_order);
      if (sections_turn(options)) add_twist_inside(in, beam, *turning);
    }
  out.second_order = std::move(second_order);
  return out;
}

}  // namespace floatframe
