#pragma once
// Common parts of isoparametric solid elements. Displacement u = sum_a N_a(xi) u_a, geometry with
// the same functions; H = int g g^T dV of the stacked gradients g_a = dN_a/dx gives
//   K_ab = lambda H_ab + mu (H_ab^T + tr(H_ab) I),   M_ab = int rho N_a N_b dV I;
// for anisotropic materials K = int B^T D B dV, with the material axes at each point. For an
// element of plies (fe/layup.hpp) all are sums of integrals over the plies.
#include <array>
#include <string>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/quadrature.hpp"

namespace floatframe::solid {

using Shape = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 20, 1>;
using ShapeGradients = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 20>;

/// Values and derivatives with respect to xi of all shape functions.
using ShapeFunctions = void (*)(const Vec3& xi, Shape& N, ShapeGradients& dN);

/// Shape functions at the points of a rule.
struct SampledRule {
  VecX weight;               ///< nq
  MatX N;                    ///< nodes x nq
  MatX dN;                   ///< nodes x 3 nq: columns 3 q + i = dN/dxi_i at point q
  std::vector<Vec3> points;  ///< nq
  int size() const noexcept { return static_cast<int>(weight.size()); }
};
SampledRule sample(int nodes, ShapeFunctions functions, const QuadratureRule& rule);

/// Sampling points of the strains and extrapolation to the nodes: a least-squares fit of a few
/// smooth functions.
struct StressRule {
  QuadratureRule points;
  std::vector<Vec3> nodes;  ///< local coordinates of the nodes
  VecX (*functions)(const Vec3& xi) = nullptr;
};
/// 1, x, y, z, xy, yz, zx, xyz
VecX trilinear(const Vec3& xi);

struct IsoparametricElement {
  int nodes = 0;
  ShapeFunctions functions = nullptr;
  /// Indexed by Integration.
  std::array<SampledRule, 2> stiffness, mass;
  SampledRule stress;
  MatX to_nodes;         ///< nodes x stress points
  std::vector<Vec3> at;  ///< local coordinates of the nodes
  SampledRule check;     ///< where the Jacobian must be positive; empty: at the integration points
};
IsoparametricElement isoparametric(int nodes, ShapeFunctions functions,
                                   const std::array<QuadratureRule, 2>& stiffness,
                                   const std::array<QuadratureRule, 2>& mass,
                                   const StressRule& stress, const QuadratureRule& check = {});

using Positions = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 20>;
Positions positions(const ElementInput& in, int nodes);

/// dN/dx of all shape functions at point q, 3 x nodes; `detJ` as well.
ShapeGradients gradients(const SampledRule& rule, int q, const Positions& P, double& detJ);

/// The points of a rule in a ply.
SampledRule in_ply(const IsoparametricElement& element, const SampledRule& rule,
                   const LayupPly& ply);

/// Calls `use(rule, q, ply)` for the points of a rule: of an element of plies in each of them, else
/// with `ply` null.
template <class Use>
void each_point(const IsoparametricElement& element, const SampledRule& rule,
                const ElementInput& in, Use use) {
  for (const LayupPly& ply : in.plies) {
    const SampledRule points = in_ply(element, rule, ply);
    for (int q = 0; q < points.size(); ++q) use(points, q, &ply);
  }
  if (!in.plies.empty()) return;
  for (int q = 0; q < rule.size(); ++q) use(rule, q, nullptr);
}
/// Elasticity at point q, in body axes.
Mat6 elasticity_at(const ElementInput& in, const SampledRule& rule, int q, const LayupPly* ply,
                   const Positions& P);

std::string error(const IsoparametricElement& element, const ElementInput& in);
void stiffness(const IsoparametricElement& element, const ElementInput& in, MatX& out);
void scalar_mass(const IsoparametricElement& element, const ElementInput& in, MatX& out);
/// Strains at the nodes (6 rows per node) from the displacements of the nodes.
void nodal_strains(const IsoparametricElement& element, const ElementInput& in, MatX& B);
/// At the points where stresses are taken.
void stressed_points(const IsoparametricElement& element, const ElementInput& in,
                     std::vector<StressedPoint>& points);
NodalPly nodal_ply(const IsoparametricElement& element, const ElementInput& in, int node);

template <const IsoparametricElement& (*element)()>
void scalar_mass(const ElementInput& in, MatX& out) {
  scalar_mass(element(), in, out);
}

/// The entry of the list for an isoparametric element.
template <const IsoparametricElement& (*element)()>
constexpr ElementKernel kernel(int nodes, const ElementShape& shape) {
  return {.family = ElementFamily::solid,
          .nodes = nodes,
          .dofs_per_node = 3,
          .error = [](const ElementInput& in) { return error(element(), in); },
          .stiffness = [](const ElementInput& in, MatX& out) { stiffness(element(), in, out); },
          .mass = &mass_of_translations<&scalar_mass<element>>,
          .scalar_mass = &scalar_mass<element>,
          .nodal_strains = [](const ElementInput& in, MatX& B) { nodal_strains(element(), in, B); },
          .stressed_points =
              [](const ElementInput& in, std::vector<StressedPoint>& points) {
                stressed_points(element(), in, points);
              },
          .shape = shape};
}

/// The same with plies.
template <const IsoparametricElement& (*element)()>
constexpr ElementKernel layered(ElementKernel kernel) {
  kernel.nodal_ply = [](const ElementInput& in, int node) {
    return nodal_ply(element(), in, node);
  };
  return kernel;
}

}  // namespace floatframe::solid
