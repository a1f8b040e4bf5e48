// 2-node rod: an axial force only, straight, of one section. With the length L, the
// axis t and B = [-t^T t^T]/L the strain is B q:
//   K = EA L B^T B,   scalar mass rho A L/6 [2 1; 1 2] (in all directions)
// Stress stiffness: the axial force times the slope of the axis squared. A rod has no torsion;
// readers give it as a spring between the rotations of the nodes. Source: Przemieniecki, Theory of
// Matrix Structural Analysis (1968).
#include <cmath>

#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {
namespace {

std::string error(const ElementInput& in) {
  const double length = (in.p[1] - in.p[0]).norm();
  // A shorter one is round-off of the coordinates.
  if (!(length > 1e-12 * (in.p[0].norm() + in.p[1].norm()))) return "has zero length";
  if (!(in.section.A > 0.0) || !std::isfinite(in.section.A))
    return "has a section whose area is not positive";
  return {};
}

void stiffness(const ElementInput& in, MatX& out) {
  const Vec3 d = in.p[1] - in.p[0];
  const double L = d.norm();
  const Mat3 k = in.material.young * in.section.A / (L * L * L) * d * d.transpose();
  out.resize(6, 6);
  out << k, -k, -k, k;
}

void scalar_mass(const ElementInput& in, MatX& out) {
  line_mass(in.material.density * in.section.A * (in.p[1] - in.p[0]).norm(), out);
}

void stressed_points(const ElementInput& in, std::vector<StressedPoint>& points) {
  const double L = (in.p[1] - in.p[0]).norm();
  const Vec3 t = (in.p[1] - in.p[0]) / L;
  const Vec6 along = axial_stress(t);
  const Mat3 across = Mat3::Identity() - t * t.transpose();
  points.resize(1);
  StressedPoint& point = points[0];
  point.stress = MatX::Zero(6, 6);
  point.gradient = MatX::Zero(9, 6);
  for (int end = 0; end < 2; ++end) {
    const double side = end == 0 ? -1.0 : 1.0;
    point.stress.middleCols<3>(3 * end) =
        side * in.material.young * in.section.A * along * t.transpose();
    for (int i = 0; i < 3; ++i)
      point.gradient.block<3, 3>(3 * i, 3 * end) = side / L * t * across.row(i);
  }
}

}  // namespace

constinit const ElementKernel rod2_kernel{.family = ElementFamily::rod,
                                          .nodes = 2,
                                          .dofs_per_node = 3,
                                          .error = &error,
                                          .stiffness = &stiffness,
                                          .mass = &mass_of_translations<&scalar_mass>,
                                          .scalar_mass = &scalar_mass,
                                          .stressed_points = &stressed_points};

}  // namespace floatframe
