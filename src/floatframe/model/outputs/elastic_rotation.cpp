// Rotation of a node of a body by its deformation [rad]: the rotation vector of R_F^T R_P with the
// frame F of the body.
#include "floatframe/math/so3.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

template <class S>
S elastic_rotation_measure(const MeasurePorts<S>& in) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  using M = Eigen::Matrix<S, 3, 3>;
  const Eigen::Quaternion<S> q(M(in.relative->R.transpose() * in.marker->R));
  return in.along(V(in.relative->R * quaternion_log(q)));
}

}  // namespace

FLOATFRAME_MEASURED(elastic_rotation)

constinit const OutputKind elastic_rotation_output = {
    .about = "rotation vector by the deformation, from the frame of the body, in its axes",
    .of = OutputOf::flexible_point,
    .components = world_axes,
    .unit = "rad",
    .frames = OutputFrames::in,
    .reflects = Reflects::axial,
    FLOATFRAME_MEASURE(elastic_rotation)};

}  // namespace floatframe
