// 4-node tetrahedron, constant strain. Nodes 1-3 counter-clockwise seen from node 4: the volume
// V = (p2-p1) . ((p3-p1) x (p4-p1)) / 6 is positive. With J = [p2-p1  p3-p1  p4-p1] the gradients
// of the shape functions 2-4 are the rows of J^-1, that of 1 is minus their sum;
//   K = V B^T D B,  scalar mass rho V/20 (1 1^T + I), with one point (ccx) rho V/16 1 1^T
#include <Eigen/LU>

#include "floatframe/fe/solid_element.hpp"
#include "floatframe/fe/solid_shapes.hpp"

namespace floatframe {
namespace {

Mat3 edges(const ElementInput& in) {
  Mat3 J;
  for (int i = 0; i < 3; ++i) J.col(i) = in.p[i + 1] - in.p[0];
  return J;
}

std::string error(const ElementInput& in) {
  const Mat3 J = edges(in);
  const double size = J.colwise().norm().maxCoeff();
  // For a flat element round-off remains, about 1e-16 of the cube of its size.
  if (!(J.determinant() > 1e-12 * size * size * size)) {
    return "is inverted or flat (its volume is not positive)";
  }
  return {};
}

solid::Gradients gradients(const ElementInput& in) {
  const Mat3 inverse = edges(in).inverse();
  solid::Gradients g(3, 4);
  for (int i = 0; i < 3; ++i) g.col(i + 1) = inverse.row(i).transpose();
  g.col(0) = -(g.col(1) + g.col(2) + g.col(3));
  return g;
}

solid::Strain strains(const ElementInput& in) { return solid::strain_matrix(gradients(in)); }

Mat6 elasticity(const ElementInput& in) {
  return elasticity_at(in, 0.25 * (in.p[0] + in.p[1] + in.p[2] + in.p[3]));
}

void stiffness(const ElementInput& in, MatX& out) {
  const solid::Strain B = strains(in);
  out = B.transpose() * elasticity(in) * B * (edges(in).determinant() / 6.0);
}

void scalar_mass(const ElementInput& in, MatX& out) {
  const double m = in.material.density * edges(in).determinant() / 6.0;
  out = in.integration == Integration::ccx  // one point
            ? MatX(MatX::Constant(4, 4, m / 16.0))
            : MatX(m / 20.0 * (MatX::Ones(4, 4) + MatX::Identity(4, 4)));
}

void nodal_strains(const ElementInput& in, MatX& B) { B = strains(in).replicate(4, 1); }

void stressed_points(const ElementInput& in, std::vector<StressedPoint>& points) {
  const double volume = edges(in).determinant() / 6.0;
  points.resize(1);
  points[0].stress = volume * elasticity(in) * strains(in);
  solid::set_gradient(gradients(in), points[0].gradient);
}

}  // namespace

constinit const ElementKernel tet4_kernel{.family = ElementFamily::solid,
                                          .nodes = 4,
                                          .dofs_per_node = 3,
                                          .error = &error,
                                          .stiffness = &stiffness,
                                          .mass = &mass_of_translations<&scalar_mass>,
                                          .scalar_mass = &scalar_mass,
                                          .nodal_strains = &nodal_strains,
                                          .stressed_points = &stressed_points,
                                          .shape = shape::tet4};

}  // namespace floatframe
