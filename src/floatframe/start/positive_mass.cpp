#include "floatframe/start/positive_mass.hpp"

#include <fmt/format.h>

#include "floatframe/body/second_order_on_masses.hpp"
#include "floatframe/inertia/inertia_terms.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

/// The same place for every body: M of the modes and of the frame does not depend on it.
double smallest_of_unit_diagonal(const Body& body, const VecX& y) {
  BodyMotion motion;
  motion.y = y;
  motion.geometric_stiffening = body.stiffens();
  const FlexibleBody& data = *body.data;
  const MatX M = data.mass_model == MassModel::six_dof ? relative_projection(data, motion).M
                                                       : relative_preprocessing(data, motion).M;
  if (!(M.diagonal().minCoeff() > 0.0)) return 0.0;
  const VecX s = M.diagonal().cwiseSqrt().cwiseInverse();
  return symmetric_eigenvalues(s.asDiagonal() * M * s.asDiagonal())[0];
}

}  // namespace

double mass_margin(const Body& body, const VecX& y) {
  if (body.modes() == 0 || !second_order_on_masses(*body.data, body.stiffens())) return 1.0;
  const double undeformed = smallest_of_unit_diagonal(body, VecX::Zero(body.modes()));
  constexpr double rounding = 1e-12;
  if (!(undeformed > rounding)) return 1.0;
  return smallest_of_unit_diagonal(body, y) / undeformed;
}

std::string lost_mass(const Body& body, const VecX& y) {
  constexpr double little = 0.1;  // a failed step came from a state that still had some
  if (!(mass_margin(body, y) < little)) return {};
  return fmt::format(
      "the mass matrix of body '{}' is hardly positive at this deformation, as displacements of "
      "second order count in it: take mean axes as its body reference (the default of parts), "
      "fewer modes or a stiffer body",
      body.name);
}

}  // namespace floatframe
