#include "floatframe/inertia/inertia_terms.hpp"

#include <fmt/format.h>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/inertia/projection.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

/// With amplitudes of the size of the body.
BodyMotion complete(const FlexibleBody& body, BodyMotion motion) {
  for (VecX* x : {&motion.y, &motion.ydot}) {
    if (x->size() == 0) *x = VecX::Zero(body.modes());
    if (x->size() != body.modes())
      throw InputError(fmt::format("found {} modal amplitudes, expected {}: one for each mode",
                                   x->size(), body.modes()));
  }
  return motion;
}

InertiaTerms zero_terms(int n) { return {MatX::Zero(n, n), VecX::Zero(n)}; }

const ProjectionData& projection_data(const FlexibleBody& body) {
  if (!body.projection)
    throw InputError("found a body without nodal masses, expected one that keeps ProjectionData");
  return *body.projection;
}

}  // namespace

InertiaTerms relative_preprocessing(const FlexibleBody& body, const BodyMotion& motion) {
  const BodyMotion m = complete(body, motion);
  const PreprocessingData data(body.invariants);
  PreprocessingWorkspace work(body.modes());
  InertiaTerms t = zero_terms(6 + body.modes());
  relative_preprocessing(data, m.r0, m.A, m.omega, m.y.data(), m.ydot.data(), work, t.M, t.Qv);
  return t;
}

InertiaTerms absolute_preprocessing(const FlexibleBody& body, const BodyMotion& motion) {
  const BodyMotion m = complete(body, motion);
  const PreprocessingData data(body.invariants);
  PreprocessingWorkspace work(body.modes());
  InertiaTerms t = zero_terms(12 + body.modes());
  absolute_preprocessing(data, m.A, skew(m.omega) * m.A, m.y.data(), m.ydot.data(), work, t.M,
                         t.Qv);
  return t;
}

InertiaTerms relative_projection(const FlexibleBody& body, const BodyMotion& motion) {
  const BodyMotion m = complete(body, motion);
  const ProjectionData& data = projection_data(body);
  ProjectionWorkspace work(data);
  InertiaTerms t = zero_terms(6 + body.modes());
  relative_projection(data, m.r0, m.A, m.omega, m.y.data(), m.ydot.data(), work, t.M, t.Qv);
  return t;
}

InertiaTerms absolute_projection(const FlexibleBody& body, const BodyMotion& motion) {
  const BodyMotion m = complete(body, motion);
  const ProjectionData& data = projection_data(body);
  ProjectionWorkspace work(data);
  InertiaTerms t = zero_terms(12 + body.modes());
  absolute_projection(data, m.A, skew(m.omega) * m.A, m.y.data(), m.ydot.data(), work, t.M, t.Qv);
  return t;
}

}  // namespace floatframe
