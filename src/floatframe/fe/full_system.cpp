#include "floatframe/fe/full_system.hpp"

#include <vector>

#include "floatframe/fe/block_assembly.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/lumped_mass.hpp"
#include "floatframe/fe/springs.hpp"

namespace floatframe {
namespace {

/// Rows and columns of given matrices in the order of the table.
SparseMatrix ordered(const SparseMatrix& A, const std::vector<Dof>& dofs, const DofTable& table) {
  std::vector<int> place(dofs.size());
  for (std::size_t i = 0; i < dofs.size(); ++i) place[i] = table.index(dofs[i].node, dofs[i].axis);
  SparseMatrix P(static_cast<Eigen::Index>(dofs.size()), table.size());
  std::vector<Eigen::Triplet<double>> ones;
  for (std::size_t i = 0; i < dofs.size(); ++i)
    ones.emplace_back(static_cast<int>(i), place[i], 1.0);
  P.setFromTriplets(ones.begin(), ones.end());
  const SparseMatrix AP = A * P;
  return SparseMatrix(P.transpose()) * AP;
}

void add_point_masses(const FeModel& model, const DofTable& table, BlockAssembly& assembly) {
  for (const PointMass& p : model.masses) {
    for (int i = 0; i < 3; ++i) {
      assembly.add({p.node, i}, {p.node, i}, p.mass);
      for (int j = 0; j < 3 && table.count(p.node) == 6; ++j) {
        assembly.add({p.node, 3 + i}, {p.node, 3 + j}, p.J(i, j));
      }
    }
  }
}

template <class Skip>
SparseMatrix mass_of(const FeModel& model, const DofTable& table, Integration integration,
                     Skip&& skip) {
  BlockAssembly assembly(model, table);
  MatX matrix;
  for (const FeElement& e : model.elements) {
    if (skip(e)) continue;
    const ElementKernel& kernel = element_kernel(e.type);
    const ElementInput input = gather(model, e, integration);
    if (kernel.dofs_per_node == 3) {
      scalar_mass_matrix(kernel, input, matrix);
      assembly.add_scalar(e.nodes.data(), kernel.nodes, matrix);
    } else {
      mass_matrix(kernel, input, true, matrix);
      assembly.add(e.nodes.data(), kernel.nodes, kernel.dofs_per_node, matrix);
    }
  }
  add_point_masses(model, table, assembly);
  SparseMatrix M = assembly.finish();
  if (model.matrices) M += ordered(model.matrices->M, model.matrices->dofs, table);
  return M;
}

}  // namespace

SparseMatrix full_stiffness(const FeModel& model, const DofTable& table, Integration integration) {
  const std::vector<SpringBlock> springs = spring_system(model, table).blocks;
  BlockAssembly assembly(model, table, springs);
  MatX matrix;
  for (const FeElement& e : model.elements) {
    const ElementKernel& kernel = element_kernel(e.type);
    kernel.stiffness(gather(model, e, integration), matrix);
    assembly.add(e.nodes.data(), kernel.nodes, kernel.dofs_per_node, matrix);
  }
  for (const SpringBlock& block : springs)
    for (std::size_t i = 0; i < block.dofs.size(); ++i)
      for (std::size_t j = 0; j < block.dofs.size(); ++j)
        assembly.add(block.dofs[i], block.dofs[j],
                     block.K(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  SparseMatrix K = assembly.finish();
  if (model.matrices) K += ordered(model.matrices->K, model.matrices->dofs, table);
  return K;
}

SparseMatrix full_mass(const FeModel& model, const DofTable& table, Integration integration) {
  return mass_of(model, table, integration, [](const FeElement&) { return false; });
}

SparseMatrix mass_without_stations(const FeModel& model, const DofTable& table,
                                   Integration integration) {
  return mass_of(model, table, integration, has_mass_stations);
}

bool has_mass_stations(const FeElement& element) noexcept {
  return element.mass_form == MassForm::consistent &&
         element_kernel(element.type).mass_stations != nullptr;
}

}  // namespace floatframe
