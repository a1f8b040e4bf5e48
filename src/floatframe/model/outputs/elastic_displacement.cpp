// Displacement of a point of a body by its deformation [m], from the undeformed place in the frame
// of the body (F, with the axes of the world in the design configuration):
//   u = p_P - p_F - R_F R_WB,design p_B,undeformed
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

/// In the axes of F.
Vec3 undeformed_place(const Model& model, int marker) noexcept {
  const Marker& m = model.markers[marker];
  const Body& body = model.bodies[m.body];
  const Vec3 p_B = m.node < 0 ? m.X_NM.p : Vec3(body.data->nodes[m.node].p + m.X_NM.p);
  return body.X_WB.R * p_B;
}

template <class S>
S elastic_displacement_measure(const MeasurePorts<S>& in) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const Vec3 p = undeformed_place(in.model, in.output.marker);
  return in.along(in.position() - in.relative->R * V(p.template cast<S>()));
}

}  // namespace

FLOATFRAME_MEASURED(elastic_displacement)

constinit const OutputKind elastic_displacement_output = {
    .about = "by the deformation, from the undeformed place in the frame of the body, in its axes",
    .of = OutputOf::flexible_point,
    .components = world_axes,
    .unit = "m",
    .frames = OutputFrames::in,
    .reflects = Reflects::polar,
    FLOATFRAME_MEASURE(elastic_displacement)};

}  // namespace floatframe
