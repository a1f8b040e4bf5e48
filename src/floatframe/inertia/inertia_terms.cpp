#include "floatframe/inertia/inertia_terms.hpp"

#include <fmt/format.h>

#include "floatframe/body/second_order_on_masses.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/inertia/projection.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

void require_size(const char* what, const auto& x, Eigen::Index rows, Eigen::Index columns) {
  if (x.rows() != rows || x.cols() != columns)
    throw InputError(ErrorCode::wrong_count,
                     fmt::format("found {} of the size {} x {}, expected {} x {}", what, x.rows(),
                                 x.cols(), rows, columns));
}

/// With amplitudes of the magnitude of the body.
BodyMotion complete(const FlexibleBody& body, BodyMotion motion) {
  const int nm = body.modes();
  for (int i = 0; i < 3; ++i) {
    require_size("an integral Si", body.invariants.Si[i], 3, nm);
    for (int j = 0; j < 3; ++j) require_size("an integral Sij", body.invariants.Sij[i][j], nm, nm);
  }
  for (VecX* x : {&motion.y, &motion.ydot}) {
    if (x->size() == 0) *x = VecX::Zero(body.modes());
    if (x->size() != body.modes())
      throw InputError(ErrorCode::wrong_count,
                       fmt::format("found {} modal amplitudes, expected {}: one for each mode",
                                   x->size(), body.modes()));
  }
  return motion;
}

InertiaTerms zero_terms(int n) { return {MatX::Zero(n, n), VecX::Zero(n)}; }

/// Second-order terms at the masses of the body; null: none.
std::shared_ptr<const SecondOrder> second_order_in(const FlexibleBody& body,
                                                   const BodyMotion& motion) {
  if (motion.geometric_stiffening && !body.second_order)
    throw InputError(ErrorCode::missing,
                     "found a body without displacements of second order, expected one with "
                     "SecondOrder for geometric stiffening");
  auto found = second_order_on_masses(body, motion.geometric_stiffening);
  if (!found) return found;
  const int nm = body.modes();
  for (const MatX& m : found->S2) require_size("an integral S2", m, nm, nm);
  for (const auto& row : found->S2i)
    for (const MatX& m : row) require_size("an integral S2i", m, nm, nm);
  return found;
}

const ProjectionData& projection_data(const FlexibleBody& body, const BodyMotion& motion) {
  if (!body.projection)
    throw InputError(ErrorCode::missing,
                     "found a body without nodal masses, expected one that keeps ProjectionData");
  const ProjectionData& data = *body.projection;
  const int n = data.nodes(), nm = body.modes();
  require_size("modal translations", data.X, 3 * n, nm);
  if (data.six_dof()) {
    require_size("modal rotations", data.X_theta, 3 * n, nm);
    require_size("a mass matrix of the nodes", data.M_6, 6 * n, 6 * n);
  } else {
    require_size("a mass matrix of the nodes", data.M_s, n, n);
  }
  if (motion.geometric_stiffening)
    require_size("nodal displacements of second order", data.h, 3 * Eigen::Index{nm} * n, nm);
  return data;
}

}  // namespace

InertiaTerms relative_preprocessing(const FlexibleBody& body, const BodyMotion& motion) {
  const BodyMotion m = complete(body, motion);
  const PreprocessingData data(body.invariants);
  PreprocessingWorkspace work(body.modes());
  InertiaTerms t = zero_terms(6 + body.modes());
  if (const auto second_order = second_order_in(body, m)) {
    StiffeningData stiffening(data, *second_order);
    relative_stiffened(data, stiffening, m.r0, m.A, m.omega, m.y.data(), m.ydot.data(), work, t.M,
                       t.Qv);
    return t;
  }
  relative_preprocessing(data, m.r0, m.A, m.omega, m.y.data(), m.ydot.data(), work, t.M, t.Qv);
  return t;
}

InertiaTerms absolute_preprocessing(const FlexibleBody& body, const BodyMotion& motion) {
  const BodyMotion m = complete(body, motion);
  const PreprocessingData data(body.invariants);
  PreprocessingWorkspace work(body.modes());
  InertiaTerms t = zero_terms(12 + body.modes());
  if (const auto second_order = second_order_in(body, m)) {
    StiffeningData stiffening(data, *second_order);
    absolute_stiffened(data, stiffening, m.A, skew(m.omega) * m.A, m.y.data(), m.ydot.data(), work,
                       t.M, t.Qv);
    return t;
  }
  absolute_preprocessing(data, m.A, skew(m.omega) * m.A, m.y.data(), m.ydot.data(), work, t.M,
                         t.Qv);
  return t;
}

InertiaTerms relative_projection(const FlexibleBody& body, const BodyMotion& motion) {
  const BodyMotion m = complete(body, motion);
  const ProjectionData& data = projection_data(body, m);
  ProjectionWorkspace work(data, m.geometric_stiffening);
  InertiaTerms t = zero_terms(6 + body.modes());
  relative_projection(data, m.r0, m.A, m.omega, m.y.data(), m.ydot.data(), work, t.M, t.Qv);
  return t;
}

InertiaTerms absolute_projection(const FlexibleBody& body, const BodyMotion& motion) {
  const BodyMotion m = complete(body, motion);
  const ProjectionData& data = projection_data(body, m);
  ProjectionWorkspace work(data, m.geometric_stiffening);
  InertiaTerms t = zero_terms(12 + body.modes());
  absolute_projection(data, m.A, skew(m.omega) * m.A, m.y.data(), m.ydot.data(), work, t.M, t.Qv);
  return t;
}

}  // namespace floatframe
