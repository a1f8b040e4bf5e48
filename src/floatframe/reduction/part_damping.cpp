#include "floatframe/reduction/part_damping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

/// Rounding of a given matrix, of its largest entry in the modes.
constexpr double given_rounding = 1e-9;
/// Resistance to rigid motions that is reported, relative to the modes.
constexpr double rigid_damping = 1e-6;

/// Displacements at the rows of the given matrices.
MatX at_rows(const FeSystem& system, const std::vector<Dof>& dofs, const MatX& Q) {
  const MatX u = system.T * Q, theta = system.T_theta * Q;
  MatX out(static_cast<Eigen::Index>(dofs.size()), Q.cols());
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const Eigen::Index row = 3 * static_cast<Eigen::Index>(dofs[i].node) + dofs[i].axis % 3;
    out.row(static_cast<Eigen::Index>(i)) = dofs[i].axis < 3 ? u.row(row) : theta.row(row);
  }
  return out;
}

MatX given_damping(const FeMatrices& given, const FeSystem& system, const MatX& R, const MatX& X,
                   const FlexibleBody& body, HealthReport& health) {
  const MatX M = mass_matrix_at_rest(body.invariants);
  Vec6 size = Vec6::Ones();  // of rotations: lengths
  size.tail<3>().setConstant(
      std::sqrt(body.invariants.m / body.invariants.inertia_about_origin().trace()));
  const LeastNorm rigid(size.asDiagonal() * M.topLeftCorner<6, 6>() * size.asDiagonal());
  const MatX follow =
      size.asDiagonal() * rigid.solve(MatX(size.asDiagonal() * M.topRightCorner(6, X.cols())));
  const MatX X_e = at_rows(system, given.dofs, X - R * follow);
  MatX D = X_e.transpose() * (given.C * X_e);
  D = (0.5 * (D + D.transpose())).eval();
  const SymmetricEigen own = symmetric_eigen(D);
  const double top = own.values.cwiseAbs().maxCoeff();
  if (own.values(0) < -given_rounding * top)
    throw InputError(
        ErrorCode::out_of_range,
        fmt::format("the damping matrix gives energy to a deformation (smallest eigenvalue in the "
                    "modes {:.3g}, largest {:.3g}), expected none below zero",
                    own.values(0), top));
  // Rounding must not add energy either.
  D = own.vectors * own.values.cwiseMax(0.0).asDiagonal() * own.vectors.transpose();
  const MatX R_rows = at_rows(system, given.dofs, R);
  const MatX C_R = given.C * R_rows;
  const double most = given.C.coeffs().cwiseAbs().maxCoeff() * R_rows.cwiseAbs().maxCoeff();
  if (C_R.cwiseAbs().maxCoeff() > rigid_damping * most)
    health.notes.push_back(
        "the damping matrix resists rigid motions too (a share of the mass, or dampers to the "
        "ground): only what it does to deformations about the mean axes is in the body");
  return 0.5 * (D + D.transpose());
}

}  // namespace

std::vector<InterfaceDofs> mounted_at(const std::vector<InterfacePlace>& interfaces) {
  std::vector<InterfaceDofs> out;
  for (std::size_t k = 0; k < interfaces.size(); ++k) {
    unsigned mask = 0;
    for (const int axis : interfaces[k].axes) mask |= 1u << static_cast<unsigned>(axis);
    out.push_back({static_cast<int>(k), mask});
  }
  return out;
}

void add_damping(const PlacedPart& part, const MatX& X, FlexibleBody& body, HealthReport& health) {
  const ModalDamping& damping = part.options.damping;
  body.D = damping_matrix(body, damping);
  if (body.modes() == 0) return;
  if (part.model.matrices && part.model.matrices->C.nonZeros() > 0)
    body.D += given_damping(*part.model.matrices, part.system, part.R, X, body, health);
  health.damping = own_damping(body);
  if (damping.reference == DampingReference::mounted && health.damping.mounted.empty())
    health.warnings.push_back(
        "damping is given for the mounted part, but no mode is left with its interfaces held: keep "
        "normal modes; what is damped are deformations by motions of the interfaces");
}

}  // namespace floatframe
