// Mode set -> flexible body: inertia integrals, projection data, modal damping.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "floatframe/body/fe_invariants.hpp"
#include "floatframe/body/modal_mass.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/strain_energy.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/reduction/bar_second_order.hpp"
#include "floatframe/reduction/bar_stress.hpp"
#include "floatframe/reduction/reduction.hpp"

namespace floatframe {
namespace {

InertiaInvariants compute_invariants(const FeModel& model, const MatX& X,
                                     const ReductionOptions& options) {
  if (options.mass_model == MassModel::isoparametric) return invariants_isoparametric(model, X);
  return invariants_hermite(model, X, options.section_inertia);
}

/// Replaces the modes by those of (K, M_ff).
void orthonormalise(const FeModel& model, const ReductionOptions& options, ModeSet& set) {
  const MatX M = modal_mass(compute_invariants(model, set.X, options));
  if (M.rows() == 0) return;
  // Each mode has unit mass: displacements and rotations differ in size.
  const VecX s =
      M.diagonal().unaryExpr([](double m) { return m > 0.0 ? 1.0 / std::sqrt(m) : 0.0; });
  const VecX masses = symmetric_eigenvalues(s.asDiagonal() * M * s.asDiagonal());
  if (!(masses(0) > 1e-14 * masses(M.rows() - 1))) {
    throw InputError(ErrorCode::singular,
                     "the modes cannot be orthonormalised: a combination of them has no mass");
  }
  const SymmetricEigen modes = generalised_eigen(set.K, M);
  MatX X = set.X * modes.vectors;
  set.K = modes.values.asDiagonal();
  set.names.clear();
  for (Eigen::Index a = 0; a < X.cols(); ++a) {
    X.col(a) *= sign_of_largest(X.col(a));
    set.names.push_back("orthonormal " + std::to_string(a + 1));
  }
  set.X = X;
}

ModeSet user_basis(const FeModel& model, const MatX& X) {
  const int rows = model.dofs_per_node() * model.nodes();
  if (X.rows() != rows) {
    throw InputError(ErrorCode::wrong_count, "the given basis has " + std::to_string(X.rows()) +
                                                 " rows; " + std::to_string(model.nodes()) +
                                                 " nodes need " + std::to_string(rows));
  }
  if (!X.allFinite())
    throw InputError(ErrorCode::not_finite, "the given basis has entries that are not finite");
  ModeSet set;
  set.X = X;
  const bool rotations = model.dofs_per_node() == 6;
  set.K = rotations ? strain_energy(model, rows_of_nodes(X, 0), rows_of_nodes(X, 3))
                    : strain_energy(model, X, MatX());
  for (Eigen::Index a = 0; a < X.cols(); ++a) set.names.push_back("given " + std::to_string(a + 1));
  return set;
}

std::shared_ptr<ProjectionData> projection_data(const FeModel& model, const MatX& X,
                                                const ReductionOptions& options) {
  if (options.mass_model == MassModel::hermite) return nullptr;
  const int n = model.nodes();
  const int d = model.dofs_per_node();
  auto data = std::make_shared<ProjectionData>();
  data->p.resize(3, n);
  data->X.resize(3 * n, X.cols());
  const bool six = options.mass_model == MassModel::six_dof;
  if (six) data->X_theta = MatX::Zero(3 * n, X.cols());
  for (int k = 0; k < n; ++k) {
    data->p.col(k) = model.positions[k];
    data->X.middleRows<3>(3 * k) = X.middleRows<3>(d * k);
    if (six && d == 6) data->X_theta.middleRows<3>(3 * k) = X.middleRows<3>(6 * k + 3);
  }
  if (six) {
    data->M_6 = assemble_mass(model, options.section_inertia, 6);
  } else {
    data->M_s = assemble_scalar_mass(model);
  }
  return data;
}

/// Supports of the frame: nodes that define its body frame, and those with static modes.
std::vector<InterfaceDofs> interfaces_of(const FeModel& model, const ReductionOptions& options) {
  std::map<int, unsigned> masks;
  for (const auto* list : {&options.clamped, &options.interfaces})
    for (const NodeDofs& d : *list)
      if (const int node = d.node.empty() ? d.index : model.find_node(d.node);
          node >= 0 && node < model.nodes())
        masks[node] |= d.mask & (model.dofs_per_node() == 6 ? 63u : 7u);
  if (options.analytic && !options.basis) masks = {{0, 63u}, {model.nodes() - 1, 7u}};
  std::vector<InterfaceDofs> out;
  for (const auto& [node, mask] : masks)
    if (mask != 0) out.push_back({node, mask});
  return out;
}

}  // namespace

FlexibleBody reduce(const FeModel& model, const ReductionOptions& options,
                    SecondOrderOf second_order) {
  validate(model);
  for (const FeElement& e : model.elements) {
    const bool shear = e.type == FeElementType::beam2 && model.sections[e.section].has_shear();
    if (shear || e.mass_form != MassForm::consistent)
      throw InputError(
          ErrorCode::unsupported,
          fmt::format("{} has {}, which bodies of bars do not have: reduce it as a part",
                      model.element_label(static_cast<int>(&e - model.elements.data())),
                      shear ? "a shear area" : "lumped mass"));
  }
  if (options.mass_model == MassModel::isoparametric) {
    for (const PointMass& p : model.masses) {
      if (p.J.cwiseAbs().maxCoeff() > 0.0) {
        throw InputError(ErrorCode::unsupported,
                         "the point mass on " + model.node_label(p.node) +
                             " has rotary inertia, which the isoparametric mass model with three "
                             "rows per node leaves out; use six_dof or hermite");
      }
    }
  }
  if (const auto complaint = damping_complaint(options.damping))
    throw InputError(ErrorCode::out_of_range, "damping: " + *complaint);
  ModeSet set = options.basis      ? user_basis(model, *options.basis)
                : options.analytic ? analytic_bar_modes(model, options.analytic->dynamic_per_plane)
                                   : craig_bampton_modes(model, options);
  if (options.orthonormalise) orthonormalise(model, options, set);

  InertiaInvariants invariants = compute_invariants(model, set.X, options);
  if (options.analytic && !options.basis && !options.orthonormalise) {
    // For the dynamic shapes, each separately.
    const Eigen::Index dynamic = set.K.rows() - 2;
    const VecX m = modal_mass(invariants).diagonal().tail(dynamic);
    set.frequencies =
        (set.K.diagonal().tail(dynamic).array() / m.array()).sqrt().matrix().unaryExpr(&hertz);
  }
  const MatX X = set.X;
  FlexibleBody body = body_of_modes(std::move(set), std::move(invariants));
  body.mass_model = options.mass_model;
  const std::shared_ptr<ProjectionData> projection = projection_data(model, X, options);
  BarSecondOrder bent =
      bar_second_order(model, X, options, second_order == SecondOrderOf::all_nodes);
  body.turning = std::move(bent.turning);
  body.second_order = std::move(bent.second_order);
  if (projection) projection->h = std::move(bent.h);
  body.projection = projection;
  if (model.dofs_per_node() == 6)
    body.stress = bar_stress(model, X, body.K, held_dofs(model, X, options), options);
  const int d = model.dofs_per_node();
  const Eigen::Index nm = X.cols();
  body.nodes.resize(model.nodes());
  for (int k = 0; k < model.nodes(); ++k) {
    ModalNode& node = body.nodes[k];
    if (!model.node_names.empty()) node.name = model.node_names[k];
    node.p = model.positions[k];
    node.X = X.middleRows<3>(d * k);
    node.X_theta = Mat3X::Zero(3, nm);
    if (d == 6) node.X_theta = X.middleRows<3>(6 * k + 3);
  }
  body.interfaces = interfaces_of(model, options);
  body.D = damping_matrix(body, options.damping);
  return body;
}

}  // namespace floatframe
