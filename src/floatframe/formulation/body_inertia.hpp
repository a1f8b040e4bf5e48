#pragma once
// The inertia terms of one body inside a formulation: selects the method at load time, owns the
// scratch memory. Rigid bodies use preprocessing with zero modes under either method.
#include <algorithm>
#include <cassert>
#include <memory>
#include <string>

#include "floatframe/body/second_order_on_masses.hpp"
#include "floatframe/formulation/equations_of_motion.hpp"
#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/inertia/projection.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

class BodyInertia {
 public:
  BodyInertia() = default;
  /// Throws InputError if the body's mass model is not compatible with the method.
  BodyInertia(const Body& of_model, InertiaMethod method)
      : data_(of_model.data->invariants), work_(of_model.modes()) {
    const FlexibleBody& body = *of_model.data;
    const std::string& name = of_model.name;
    if (body.modes() == 0) return;
    if (of_model.stiffens() && method == InertiaMethod::projection && body.projection &&
        body.projection->h.size() == 0)
      throw InputError(
          ErrorCode::incomplete,
          "bodies." + name + ": geometric_stiffening of a part needs inertia: preprocessing");
    second_order_ = second_order_on_masses(body, of_model.stiffens());
    if (second_order_ && method == InertiaMethod::preprocessing) {
      stiffening_ = StiffeningData(data_, *second_order_);
      special_ = true;
    }
    if (method == InertiaMethod::projection) {
      if (body.mass_model == MassModel::hermite || !body.projection)
        throw InputError(
            ErrorCode::incomplete,
            "bodies." + name +
                ": mass_model hermite has no nodal mass matrix, so it needs inertia: "
                "preprocessing; use mass_model isoparametric or six_dof with inertia: projection");
      projection_ = body.projection.get();
      special_ = true;
      projection_work_ = ProjectionWorkspace(*projection_, of_model.stiffens());
    } else if (body.mass_model == MassModel::six_dof) {
      throw InputError(
          ErrorCode::incomplete,
          "bodies." + name +
              ": mass_model six_dof is a nodal mass matrix, so it needs inertia: projection; use "
              "mass_model isoparametric or hermite with inertia: preprocessing");
    }
  }

  void relative(const Vec3& r0, const Mat3& A, const Vec3& omega, const double* y,
                const double* ydot, MatX& M, VecX& Qv) noexcept {
    assert(M.rows() == 6 + data_.modes());
    if (!special_)
      relative_preprocessing(data_, r0, A, omega, y, ydot, work_, M, Qv);
    else if (projection_)
      relative_projection(*projection_, r0, A, omega, y, ydot, projection_work_, M, Qv);
    else
      relative_stiffened(data_, stiffening_, r0, A, omega, y, ydot, work_, M, Qv);
  }
  void absolute(const Mat3& A, const Mat3& Adot, const double* y, const double* ydot, MatX& M,
                VecX& Qv) noexcept {
    assert(M.rows() == 12 + data_.modes());
    if (!special_)
      absolute_preprocessing(data_, A, Adot, y, ydot, work_, M, Qv);
    else if (projection_)
      absolute_projection(*projection_, A, Adot, y, ydot, projection_work_, M, Qv);
    else
      absolute_stiffened(data_, stiffening_, A, Adot, y, ydot, work_, M, Qv);
  }
  /// m_bar: its mass times the centre of mass in the body frame [kg m].
  Vec3 static_moment(const double* y) const noexcept {
    assert(y || data_.modes() == 0);
    Vec3 m = data_.m_u;  // (29)
    for (int a = 0; a < data_.modes(); ++a) m += data_.S.col(a) * y[a];
    if (!second_order_) return m;
    for (int j = 0; j < 3; ++j)
      for (int a = 0; a < data_.modes(); ++a)
        for (int b = 0; b < data_.modes(); ++b)
          m[j] += 0.5 * y[a] * second_order_->S2[j](a, b) * y[b];
    return m;
  }
  /// For a body that stiffens or whose nodes have rotating mass, else null.
  const SecondOrder* second_order() const noexcept { return second_order_.get(); }
  /// K_kk / M_kk of each mode, `no_inertia` for massless ones [1/s2].
  VecX own_frequencies_squared(const MatX& K) const {
    assert(K.rows() == data_.modes() && K.cols() == data_.modes());
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
  bool special_ = false;  ///< not preprocessing without second order
  std::shared_ptr<const SecondOrder> second_order_;
  StiffeningData stiffening_;
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
