#include "floatframe/fe/body_loads.hpp"

#include <algorithm>

#include "floatframe/fe/lumped_mass.hpp"

namespace floatframe {
namespace {

/// Displacement and rotation of the fields at p, 3 x 12 each. `axis`: that of a beam, else zero.
void fields_at(const Vec3& p, const Vec3& axis, Mat3X& u, Mat3X& theta) {
  u = Mat3X::Zero(3, linear_load_cases);
  theta = Mat3X::Zero(3, linear_load_cases);
  u.leftCols<3>().setIdentity();
  const bool beam = !axis.isZero(0.0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int column = 3 + 3 * i + j;
      u(j, column) = p(i);
      const Vec3 half_curl = 0.5 * Vec3::Unit(i).cross(Vec3::Unit(j));
      theta.col(column) = half_curl;
      if (beam)
        theta.col(column) = axis.cross(axis(i) * Vec3::Unit(j)) + axis * axis.dot(half_curl);
    }
}

}  // namespace

void linear_fields(const ElementInput& input, int nodes, int dofs_per_node, bool beam,
                   MatX& fields) {
  fields.resize(dofs_per_node * nodes, linear_load_cases);
  Mat3X u, theta;
  for (int a = 0; a < nodes; ++a) {
    Vec3 axis = Vec3::Zero();
    if (beam) {
      const int from = std::max(a - 1, 0), to = std::min(a + 1, nodes - 1);
      axis = (input.p[to] - input.p[from]).normalized();
    }
    fields_at(input.p[a], axis, u, theta);
    fields.middleRows<3>(dofs_per_node * a) = u;
    if (dofs_per_node == 6) fields.middleRows<3>(6 * a + 3) = theta;
  }
}

void element_mass(const ElementKernel& kernel, const ElementInput& input, ElementMass mass,
                  MatX& M) {
  if (mass != ElementMass::linear)
    return mass_matrix(kernel, input, mass == ElementMass::section_inertia, M);
  MatX scalar;
  scalar_mass_matrix(kernel, input, scalar);
  expand_scalar_mass(scalar, kernel.dofs_per_node, M);
}

NodalShapes linear_loads(const FeModel& model, ElementMass mass, Integration integration) {
  NodalShapes out;
  out.U = MatX::Zero(3 * model.nodes(), linear_load_cases);
  out.Theta = MatX::Zero(3 * model.nodes(), linear_load_cases);
  MatX M, fields;
  for (const FeElement& e : model.elements) {
    const ElementKernel& kernel = element_kernel(e.type);
    const ElementInput input = gather(model, e, integration);
    const int d = kernel.dofs_per_node;
    linear_fields(input, kernel.nodes, d, kernel.family == ElementFamily::beam, fields);
    element_mass(kernel, input, mass, M);
    const MatX f = M * fields;
    for (int a = 0; a < kernel.nodes; ++a) {
      const Eigen::Index row = 3 * static_cast<Eigen::Index>(e.nodes[a]);
      out.U.middleRows<3>(row) += f.middleRows<3>(d * a);
      if (d == 6) out.Theta.middleRows<3>(row) += f.middleRows<3>(6 * a + 3);
    }
  }
  Mat3X u, theta;
  for (const PointMass& m : model.masses) {
    fields_at(model.positions[m.node], Vec3::Zero(), u, theta);
    out.U.middleRows<3>(3 * m.node) += m.mass * u;
    out.Theta.middleRows<3>(3 * m.node) += m.J * theta;
  }
  return out;
}

}  // namespace floatframe
