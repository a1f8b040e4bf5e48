#include "floatframe/reduction/bar_stress.hpp"

#include "floatframe/body/fe_stress.hpp"
#include "floatframe/fe/body_loads.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/reduction/fixed_interface.hpp"

namespace floatframe {
namespace {

/// Above this limit the stress places of a body would be larger than the rest of it.
constexpr std::size_t many_bars = 2000;

NodalShapes shapes_of(const MatX& X, int nodes) {
  NodalShapes out{MatX(3 * nodes, X.cols()), MatX(3 * nodes, X.cols())};
  for (int k = 0; k < nodes; ++k) {
    out.U.middleRows<3>(3 * k) = X.middleRows<3>(6 * k);
    out.Theta.middleRows<3>(3 * k) = X.middleRows<3>(6 * k + 3);
  }
  return out;
}

ElementMass mass_of(const ReductionOptions& options) {
  if (options.mass_model == MassModel::isoparametric) return ElementMass::linear;
  return options.section_inertia ? ElementMass::section_inertia : ElementMass::consistent;
}

/// Forces and moments, six rows per node.
MatX mass_forces(const FeModel& model, const MatX& X, ElementMass mass) {
  if (mass != ElementMass::linear)
    return assemble_mass(model, mass == ElementMass::section_inertia, 6) * X;
  const SparseRows M = assemble_scalar_mass(model);
  MatX F = MatX::Zero(X.rows(), X.cols());
  for (int k = 0; k < model.nodes(); ++k)
    for (SparseRows::InnerIterator it(M, k); it; ++it)
      F.middleRows<3>(6 * k) += it.value() * X.middleRows<3>(6 * it.col());
  return F;
}

/// All loads.
MatX bar_loads(const FeModel& model, const MatX& X, ElementMass mass) {
  MatX F(X.rows(), body_load_cases + X.cols());
  const NodalShapes loads = linear_loads(model, mass);
  for (int k = 0; k < model.nodes(); ++k) {
    F.block(6 * k, 0, 3, body_load_cases) = loads.U.middleRows<3>(3 * k);
    F.block(6 * k + 3, 0, 3, body_load_cases) = loads.Theta.middleRows<3>(3 * k);
  }
  F.rightCols(X.cols()) = mass_forces(model, X, mass);
  return F;
}

}  // namespace

std::shared_ptr<const BodyStress> bar_stress(const FeModel& model, const MatX& X, const MatX& K_y,
                                             const std::vector<int>& held,
                                             const ReductionOptions& options) {
  if (X.cols() == 0 || X.rows() != 6 * model.nodes() || model.elements.empty() ||
      model.elements.size() > many_bars)
    return nullptr;
  for (const FeElement& e : model.elements)
    if (!is_beam(e.type)) return nullptr;
  const ElementMass mass = mass_of(options);
  const StressRecovery recovery(model, {}, mass);
  auto out = std::make_shared<BodyStress>(recovery.layout());
  for (StressPlace& place : out->places) place.number = 0;
  for (BeamSectionPlace& section : out->sections) section.number = 0;
  StressFields modes;
  modes.displacements = shapes_of(X, model.nodes());
  StressRecovery::Recovered found = recovery.recover(modes);
  out->modes = std::move(found.places);
  out->section_modes = std::move(found.sections);
  if (held.empty()) return out;
  const MatX F = bar_loads(model, X, mass);
  const SparseMatrix K = assemble_stiffness(model), no_mass(K.rows(), K.cols());
  try {
    const FixedInterface fixed(K, no_mass, {}, held, [](int) { return std::string(); });
    const MatX r = fixed.inner_response(F) - X * ldlt_solve(K_y, X.transpose() * F);
    StressFields loads;
    loads.displacements = shapes_of(r, model.nodes());
    loads.linear = body_load_cases;
    loads.density = std::move(modes.displacements);
    found = recovery.recover(loads);
    out->loads = std::move(found.places);
    out->section_loads = std::move(found.sections);
  } catch (const InputError&) {
    // The direct factors have no accurate digits: the modes use another method (bar_chains.hpp).
  }
  return out;
}

}  // namespace floatframe
