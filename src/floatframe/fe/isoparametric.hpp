#pragma once
// What the isoparametric solid elements share. Displacement u = sum_a N_a(xi) u_a, geometry with
// the same functions; H = int g g^T dV of the stacked gradients g_a = dN_a/dx gives
//   K_ab = lambda H_ab + mu (H_ab^T + tr(H_ab) I),   M_ab = int rho N_a N_b dV I.
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

struct IsoparametricElement {
  int nodes = 0;
  ShapeFunctions functions = nullptr;
  /// Indexed by Integration.
  std::array<SampledRule, 2> stiffness, mass;
};
IsoparametricElement isoparametric(int nodes, ShapeFunctions functions,
                                   const std::array<QuadratureRule, 2>& stiffness,
                                   const std::array<QuadratureRule, 2>& mass);

std::string fault(const IsoparametricElement& element, const ElementInput& in);
void stiffness(const IsoparametricElement& element, const ElementInput& in, MatX& out);
void scalar_mass(const IsoparametricElement& element, const ElementInput& in, MatX& out);
void mass(const IsoparametricElement& element, const ElementInput& in, MatX& out);

}  // namespace floatframe::solid
