#pragma once
// The inertia terms of one body inside a formulation: picks the method at load time, owns its
// scratch. Rigid bodies use preprocessing with zero modes under either method.
#include <algorithm>
#include <string>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/formulation/equations_of_motion.hpp"
#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/inertia/projection.hpp"
#include "floatframe/model/description.hpp"

namespace floatframe {

class BodyInertia {
 public:
  BodyInertia() = default;
  /// Throws InputError if the body's mass model does not go with the method.
  BodyInertia(const FlexibleBody& body, const std::string& name, InertiaMethod method)
      : data_(body.invariants), work_(body.modes()) {
    if (body.modes() == 0) return;
    if (method == InertiaMethod::projection) {
      if (body.mass_model == MassModel::hermite || !body.projection)
        throw InputError(
            "bodies." + name +
            ": mass_model hermite has no nodal mass matrix, so it needs inertia: preprocessing; "
            "use mass_model isoparametric or six_dof with inertia: projection");
      projection_ = body.projection.get();
      projection_work_ = ProjectionWorkspace(*projection_);
    } else if (body.mass_model == MassModel::six_dof) {
      throw InputError(
          "bodies." + name +
          ": mass_model six_dof is a nodal mass matrix, so it needs inertia: projection; "
          "use mass_model isoparametric or hermite with inertia: preprocessing");
    }
  }

  void relative(const Vec3& r0, const Mat3& A, const Vec3& omega, const double* y,
                const double* ydot, MatX& M, VecX& Qv) noexcept {
    if (projection_)
      relative_projection(*projection_, r0, A, omega, y, ydot, projection_work_, M, Qv);
    else
      relative_preprocessing(data_, r0, A, omega, y, ydot, work_, M, Qv);
  }
  void absolute(const Mat3& A, const Mat3& Adot, const double* y, const double* ydot, MatX& M,
                VecX& Qv) noexcept {
    if (projection_)
      absolute_projection(*projection_, A, Adot, y, ydot, projection_work_, M, Qv);
    else
      absolute_preprocessing(data_, A, Adot, y, ydot, work_, M, Qv);
  }
  /// K_kk / M_kk of each mode, `no_inertia` for massless ones [1/s2].
  VecX own_frequencies_squared(const MatX& K) const {
    VecX w = VecX::Zero(data_.modes());
    for (Eigen::Index k = 0; k < w.size(); ++k) {
      const double mass = data_.M_ff(k, k);
      w[k] = mass > 0.0 ? std::max(0.0, K(k, k) / mass) : no_inertia;
    }
    return w;
  }
  const PreprocessingData& data() const noexcept { return data_; }

 private:
  PreprocessingData data_;
  PreprocessingWorkspace work_;
  const ProjectionData* projection_ = nullptr;
  ProjectionWorkspace projection_work_;
};

/// A body's terms of the equations of motion at the last evaluation, over its rigid coordinates and
/// its modal amplitudes.
struct BodyTerms {
  BodyInertia inertia;
  MatX M;               ///< mass matrix
  VecX Qv;              ///< velocity-dependent inertia forces
  bool damped = false;  ///< its modal damping is not zero
};

}  // namespace floatframe
