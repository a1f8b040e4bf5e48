#include "floatframe/reduction/rigid_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/reduction/connectivity.hpp"
#include "floatframe/reduction/free_structure.hpp"

namespace floatframe {
namespace {

constexpr std::size_t named = 5;

/// The nodes with the largest values, as long as these are at least half of the largest.
std::string largest_nodes(const FeModel& model, const VecX& of_node) {
  const double top = of_node.maxCoeff();
  std::vector<std::pair<long, int>> order;  // rounded, so that equal ones stay in their order
  for (int k = 0; k < model.nodes(); ++k)
    if (of_node(k) >= 0.5 * top) order.emplace_back(-std::lround(1e5 * of_node(k) / top), k);
  std::sort(order.begin(), order.end());
  std::vector<int> nodes;
  for (const auto& entry : order) nodes.push_back(entry.second);
  return list_nodes(model, nodes, named);
}

double largest_entry(const SparseMatrix& K, const VecX& s) {
  double largest = 0.0;
  for (int j = 0; j < K.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(K, j); it; ++it)
      largest = std::max(largest, std::abs(it.value()) / (s(it.row()) * s(j)));
  return largest;
}

}  // namespace

double part_size(const FeModel& model, const FeSystem& system) {
  Eigen::AlignedBox3d box;
  for (int k = 0; k < model.nodes(); ++k) {
    const int* const start = system.T.outerIndexPtr();
    if (start[3 * k] != start[3 * k + 3]) box.extend(model.positions[k]);
  }
  return box.isEmpty() ? 0.0 : 0.5 * box.diagonal().norm();
}

VecX row_lengths(const FeSystem& system, double size) {
  VecX s = VecX::Ones(system.size());
  for (int row = 0; row < system.size(); ++row)
    if (system.dofs[row].axis >= 3 && size > 0.0) s(row) = size;
  return s;
}

double check_rigid_motions(const FeModel& model, const FeSystem& system) {
  Eigen::AlignedBox3d box;
  for (const Dof& dof : system.dofs) box.extend(model.positions[dof.node]);
  if (box.isEmpty()) return 0.0;
  const double size = part_size(model, system);
  const VecX s = row_lengths(system, size);
  MatX R = rigid_motions(model, system, box.center());
  if (size > 0.0) R.rightCols<3>() /= size;
  const double largest = largest_entry(system.K, s);
  if (!(largest > 0.0)) return 0.0;
  const VecX force = s.cwiseInverse().cwiseProduct((system.K * R).cwiseAbs().rowwise().maxCoeff());
  const double residual = force.maxCoeff() / largest;
  if (residual <= largest_rigid_residual) return residual;
  if (!std::isfinite(residual))
    throw InputError(ErrorCode::too_large,
                     fmt::format("the stiffness has entries of {:.1e}, too large to compute with: "
                                 "a size or a material is in other units or mistyped",
                                 largest));
  VecX of_node = VecX::Zero(model.nodes());
  for (int row = 0; row < system.size(); ++row) {
    double& f = of_node(system.dofs[row].node);
    f = std::max(f, force(row));
  }
  throw InputError(
      ErrorCode::contradiction,
      fmt::format("rigid motions cause forces of {:.1e} of the largest stiffness at {}: a support, "
                  "a spring to ground or a wrong linear equation is in the model",
                  residual, largest_nodes(model, of_node)));
}

std::string mechanism_text(const FeModel& model, const FeSystem& system, const VecX& shape) {
  const double size = part_size(model, system);
  const VecX u = system.T * shape, turn = system.T_theta * shape;
  VecX of_node(model.nodes());
  for (int k = 0; k < model.nodes(); ++k)
    of_node(k) = std::max(u.segment<3>(3 * k).norm(), size * turn.segment<3>(3 * k).norm());
  return fmt::format(
      "the part is a mechanism: besides the six rigid motions there is at least one without "
      "stiffness, which moves most at {}",
      largest_nodes(model, of_node));
}

std::string stiffness_cause_text(const FeModel& model, double residual) {
  const Spring* holding = nullptr;
  double largest = 0.0;
  for (const Spring& s : model.springs) {
    if (s.nodes[1] < 0) continue;  // rejected before
    // Its elongation in rotations about its first node: moments of its directions.
    const Vec3 r = model.positions[s.nodes[1]] - model.positions[s.nodes[0]];
    const Vec3 d = s.directions[1].head<3>();
    const Vec3 moment = s.directions[0].tail<3>() + s.directions[1].tail<3>() + r.cross(d);
    if (moment.norm() <= 1e-9 * (1.0 + r.norm()) * s.directions[1].norm()) continue;
    const double energy = s.stiffness * moment.squaredNorm();
    if (energy <= largest) continue;
    largest = energy;
    holding = &s;
  }
  if (holding != nullptr)
    return fmt::format(
        "{} does not act along the line of its nodes, so it holds the part against turning; give "
        "it nodes at one place or on its line",
        model.spring_label(static_cast<int>(holding - model.springs.data())));
  if (residual > 1e-9)
    return "a support, a spring to ground or a wrong linear equation is in the model";
  return "the stiffness does not carry enough digits for such a slender part; use fewer elements";
}

void check_stiffness_of(const FeModel& model, const FeSystem& system, const MatX& shapes) {
  if (shapes.cols() == 0) return;
  const MatX force = system.K * shapes;
  const MatX magnitude = SparseMatrix(system.K.cwiseAbs()) * shapes.cwiseAbs();
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
    const double energy = shapes.col(k).dot(force.col(k));
    const double rounding = shapes.col(k).cwiseAbs().dot(magnitude.col(k));
    if (!(energy > least_strain_energy * rounding))
      throw InputError(ErrorCode::singular, mechanism_text(model, system, shapes.col(k)));
  }
}

}  // namespace floatframe
