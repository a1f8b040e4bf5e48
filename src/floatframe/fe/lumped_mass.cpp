#include "floatframe/fe/lumped_mass.hpp"

#include <algorithm>

namespace floatframe {
namespace {

bool has_mid_nodes(const ElementKernel& kernel) noexcept {
  if (kernel.family == ElementFamily::beam) return kernel.nodes > 2;
  if (kernel.family == ElementFamily::shell || kernel.family == ElementFamily::membrane)
    return kernel.nodes > 4;
  const std::size_t corners = kernel.shape.neighbours.size();
  return corners > 0 && static_cast<std::size_t>(kernel.nodes) > corners;
}

VecX masses_at_nodes(const ElementKernel& kernel, const ElementInput& in) {
  MatX M;
  kernel.scalar_mass(in, M);
  if (!has_mid_nodes(kernel)) return M.rowwise().sum();
  const double trace = M.trace();
  return trace > 0.0 ? VecX(M.diagonal() * (M.sum() / trace)) : VecX::Zero(M.rows());
}

/// Rotary inertia of a unit of mass at each node.
std::vector<Mat3> rotary(const ElementKernel& kernel, const ElementInput& in) {
  std::vector<Mat3> J(kernel.nodes, Mat3::Zero());
  if (kernel.family == ElementFamily::beam) {
    const BeamSection& s = in.section;
    const bool all = in.mass_form == MassForm::lumped;
    const Vec3 I(s.Iy + s.Iz, all ? s.Iy : 0.0, all ? s.Iz : 0.0);
    for (int a = 0; a < kernel.nodes; ++a) {
      ElementInput here = in;  // the axes at the node
      here.p[0] = in.p[std::max(a - 1, 0)];
      here.p[1] = in.p[std::min(a + 1, kernel.nodes - 1)];
      const Mat3 T = beam_axes(here);
      J[a] = T * (I / s.A).asDiagonal() * T.transpose();
    }
  }
  return J;
}

}  // namespace

bool quadratic(FeElementType type) noexcept { return has_mid_nodes(element_kernel(type)); }

void scalar_mass_matrix(const ElementKernel& kernel, const ElementInput& in, MatX& out) {
  if (in.mass_form == MassForm::consistent) return kernel.scalar_mass(in, out);
  out = masses_at_nodes(kernel, in).asDiagonal();
}

void mass_matrix(const ElementKernel& kernel, const ElementInput& in, bool section_inertia,
                 MatX& out) {
  if (in.mass_form == MassForm::consistent) return kernel.mass(in, section_inertia, out);
  const VecX m = masses_at_nodes(kernel, in);
  const int d = kernel.dofs_per_node;
  out = MatX::Zero(d * kernel.nodes, d * kernel.nodes);
  for (int a = 0; a < kernel.nodes; ++a) out.block<3, 3>(d * a, d * a).diagonal().setConstant(m(a));
  if (d == 3 || !section_inertia) return;
  if (kernel.family == ElementFamily::shell && in.mass_form == MassForm::lumped) {
    // Rotary inertia, and for shells offset from their nodes the static moment.
    MatX M, M_s;
    kernel.mass(in, true, M);
    kernel.scalar_mass(in, M_s);
    for (int a = 0; a < kernel.nodes; ++a) {
      if (!(M_s(a, a) > 0.0)) continue;
      const double share = m(a) / M_s(a, a);
      out.block<3, 6>(6 * a + 3, 6 * a) = share * M.block<3, 6>(6 * a + 3, 6 * a);
      out.block<3, 3>(6 * a, 6 * a + 3) = share * M.block<3, 3>(6 * a, 6 * a + 3);
    }
    return;
  }
  const std::vector<Mat3> J = rotary(kernel, in);
  for (int a = 0; a < kernel.nodes; ++a) out.block<3, 3>(6 * a + 3, 6 * a + 3) = m(a) * J[a];
}

}  // namespace floatframe
