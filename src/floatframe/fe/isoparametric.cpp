#include "floatframe/fe/isoparametric.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "floatframe/fe/solid_element.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe::solid {
namespace {

const SampledRule& select(const std::array<SampledRule, 2>& rules, const ElementInput& in) {
  return rules[in.integration == Integration::exact ? 0 : 1];
}

bool positive(const SampledRule& rule, const Positions& P, double limit) {
  const Mat3X J = P * rule.dN;
  for (int q = 0; q < rule.size(); ++q) {
    if (!(J.middleCols<3>(3 * q).determinant() > limit)) return false;
  }
  return true;
}

Mat3 jacobian(const SampledRule& rule, int q, const Positions& P) {
  return P * rule.dN.middleCols<3>(3 * q);  // J(i, j) = dx_i / dxi_j
}

/// int B^T D B dV, with the axes of the material at each point.
void anisotropic_stiffness(const IsoparametricElement& element, const SampledRule& rule,
                           const ElementInput& in, const Positions& P, MatX& out) {
  out = MatX::Zero(P.size(), P.size());
  each_point(element, rule, in, [&](const SampledRule& points, int q, const LayupPly* ply) {
    double detJ = 0.0;
    const Strain B = strain_matrix(gradients(points, q, P, detJ));
    const Mat6 D = points.weight(q) * detJ * elasticity_at(in, points, q, ply, P);
    const Strain DB = D * B;
    out.noalias() += B.transpose() * DB;
  });
  out = (0.5 * (out + out.transpose())).eval();
}

SampledRule at_nodes(const IsoparametricElement& element, int first, int count) {
  QuadratureRule places;
  for (int a = first; a < first + count; ++a) places.push_back({element.at[a], 1.0});
  return sample(element.nodes, element.functions, places);
}

/// Axis 1 of the layers is along the thickness at a node.
bool no_layer_axis(const IsoparametricElement& element, const ElementInput& in,
                   const Positions& P) {
  const bool needed = std::any_of(in.plies.begin(), in.plies.end(),
                                  [](const LayupPly& ply) { return ply.directional; });
  if (!needed || in.axes() == nullptr) return false;
  const SampledRule nodes = at_nodes(element, 0, element.nodes);
  for (int a = 0; a < nodes.size(); ++a)
    if (layer_axis(jacobian(nodes, a, P), in.axes(), P.col(a)).isZero(0.0)) return true;
  return false;
}

}  // namespace

Positions positions(const ElementInput& in, int nodes) {
  Positions P(3, nodes);
  for (int a = 0; a < nodes; ++a) P.col(a) = in.p[a];
  return P;
}

ShapeGradients gradients(const SampledRule& rule, int q, const Positions& P, double& detJ) {
  const Mat3 J = jacobian(rule, q, P);
  detJ = J.determinant();
  return J.inverse().transpose() * rule.dN.middleCols<3>(3 * q).transpose();
}

VecX trilinear(const Vec3& xi) {
  VecX f(8);
  f << 1.0, xi, xi(0) * xi(1), xi(1) * xi(2), xi(2) * xi(0), xi.prod();
  return f;
}

SampledRule sample(int nodes, ShapeFunctions functions, const QuadratureRule& rule) {
  const int nq = static_cast<int>(rule.size());
  SampledRule s;
  s.weight.resize(nq);
  s.N.resize(nodes, nq);
  s.dN.resize(nodes, 3 * nq);
  Shape N(nodes);
  ShapeGradients dN(3, nodes);
  for (int q = 0; q < nq; ++q) {
    const QuadraturePoint& point = rule[q];
    functions(point.xi, N, dN);
    s.weight(q) = point.weight;
    s.N.col(q) = N;
    s.dN.middleCols<3>(3 * q) = dN.transpose();
    s.points.push_back(point.xi);
  }
  return s;
}

IsoparametricElement isoparametric(int nodes, ShapeFunctions functions,
                                   const std::array<QuadratureRule, 2>& stiffness,
                                   const std::array<QuadratureRule, 2>& mass,
                                   const StressRule& stress, const QuadratureRule& check) {
  IsoparametricElement element;
  element.nodes = nodes;
  element.functions = functions;
  for (std::size_t i = 0; i < 2; ++i) {
    element.stiffness[i] = sample(nodes, functions, stiffness[i]);
    element.mass[i] = sample(nodes, functions, mass[i]);
  }
  element.stress = sample(nodes, functions, stress.points);
  const int terms = static_cast<int>(stress.functions(Vec3::Zero()).size());
  MatX at_points(element.stress.size(), terms), at_nodes(nodes, terms);
  for (int q = 0; q < element.stress.size(); ++q)
    at_points.row(q) = stress.functions(stress.points[q].xi);
  for (int a = 0; a < nodes; ++a) at_nodes.row(a) = stress.functions(stress.nodes[a]);
  element.to_nodes = at_nodes * LeastNorm(at_points).pseudo_inverse();
  element.at = stress.nodes;
  if (!check.empty()) element.check = sample(nodes, functions, check);
  return element;
}

SampledRule in_ply(const IsoparametricElement& element, const SampledRule& rule,
                   const LayupPly& ply) {
  const double half = 0.5 * (ply.top - ply.bottom), middle = 0.5 * (ply.top + ply.bottom);
  QuadratureRule squeezed;
  squeezed.reserve(rule.points.size());
  for (int q = 0; q < rule.size(); ++q) {
    const Vec3& xi = rule.points[q];
    squeezed.push_back({Vec3(xi(0), xi(1), middle + half * xi(2)), half * rule.weight(q)});
  }
  return sample(element.nodes, element.functions, squeezed);
}

Mat6 elasticity_at(const ElementInput& in, const SampledRule& rule, int q, const LayupPly* ply,
                   const Positions& P) {
  const Vec3 p = P * rule.N.col(q);
  if (ply == nullptr) return floatframe::elasticity_at(in, p);
  return ply_elasticity(*ply, jacobian(rule, q, P), in.axes(), p);
}

std::string error(const IsoparametricElement& element, const ElementInput& in) {
  const Positions P = positions(in, element.nodes);
  const double size = (P.colwise() - P.col(0)).colwise().norm().maxCoeff();
  const double limit = 1e-12 * size * size * size;
  if (!in.plies.empty() && no_layer_axis(element, in, P))
    return "has plies, and axis 1 of its orientation is along its thickness";
  if (element.check.size() > 0) {
    if (positive(element.check, P, limit)) return {};
    return "is inverted or flat (its Jacobian is not positive at every corner)";
  }
  if (!positive(select(element.stiffness, in), P, limit) ||
      !positive(select(element.mass, in), P, limit)) {
    return "is inverted or flat (its Jacobian is not positive at every integration point)";
  }
  return {};
}

void stiffness(const IsoparametricElement& element, const ElementInput& in, MatX& out) {
  const SampledRule& rule = select(element.stiffness, in);
  const int n = element.nodes, nq = rule.size();
  const Positions P = positions(in, n);
  if (in.material.elasticity || !in.plies.empty())
    return anisotropic_stiffness(element, rule, in, P, out);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 60, 27> g(3 * n, nq),
      weighted(3 * n, nq);
  for (int q = 0; q < nq; ++q) {
    double detJ = 0.0;
    const ShapeGradients dN = gradients(rule, q, P, detJ);
    g.col(q) = Eigen::Map<const VecX>(dN.data(), 3 * n);
    weighted.col(q) = (rule.weight(q) * detJ) * g.col(q);
  }
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 60, 60> H(3 * n, 3 * n);
  H.noalias() = g * weighted.transpose();
  const double mu = in.material.shear();
  const double lambda = 2.0 * mu * in.material.poisson / (1.0 - 2.0 * in.material.poisson);
  out.resize(3 * n, 3 * n);
  for (int b = 0; b < n; ++b) {
    for (int a = 0; a <= b; ++a) {
      Mat3 h = H.block<3, 3>(3 * a, 3 * b);
      if (a == b) h = (0.5 * (h + h.transpose())).eval();
      Mat3 k = lambda * h + mu * h.transpose();
      k.diagonal().array() += mu * h.trace();
      out.block<3, 3>(3 * a, 3 * b) = k;
      if (a < b) out.block<3, 3>(3 * b, 3 * a) = k.transpose();
    }
  }
}

namespace {

void ply_masses(const IsoparametricElement& element, const SampledRule& rule,
                const ElementInput& in, MatX& out) {
  const Positions P = positions(in, element.nodes);
  out = MatX::Zero(element.nodes, element.nodes);
  for (const LayupPly& ply : in.plies) {
    if (ply.density == 0.0) continue;
    const SampledRule points = in_ply(element, rule, ply);
    for (int q = 0; q < points.size(); ++q) {
      const VecX N = points.N.col(q);
      const double dm = ply.density * points.weight(q) * jacobian(points, q, P).determinant();
      out.noalias() += (dm * N) * N.transpose();
    }
  }
  out = (0.5 * (out + out.transpose())).eval();
}

}  // namespace

void scalar_mass(const IsoparametricElement& element, const ElementInput& in, MatX& out) {
  const SampledRule& rule = select(element.mass, in);
  if (!in.plies.empty()) return ply_masses(element, rule, in, out);
  const Mat3X J = positions(in, element.nodes) * rule.dN;
  VecX dm(rule.size());
  for (int q = 0; q < rule.size(); ++q) {
    dm(q) = in.material.density * rule.weight(q) * J.middleCols<3>(3 * q).determinant();
  }
  const MatX weighted = rule.N * dm.asDiagonal();
  out.noalias() = weighted * rule.N.transpose();
  out = (0.5 * (out + out.transpose())).eval();
}

void nodal_strains(const IsoparametricElement& element, const ElementInput& in, MatX& B) {
  const Positions P = positions(in, element.nodes);
  B = MatX::Zero(6 * element.nodes, 3 * element.nodes);
  for (int q = 0; q < element.stress.size(); ++q) {
    double detJ = 0.0;
    const Strain at_point = strain_matrix(gradients(element.stress, q, P, detJ));
    for (int a = 0; a < element.nodes; ++a) {
      B.middleRows<6>(6 * a) += element.to_nodes(a, q) * at_point;
    }
  }
}

void stressed_points(const IsoparametricElement& element, const ElementInput& in,
                     std::vector<StressedPoint>& points) {
  const Positions P = positions(in, element.nodes);
  points.clear();
  each_point(element, element.stress, in, [&](const SampledRule& rule, int q, const LayupPly* ply) {
    double detJ = 0.0;
    const Gradients g = gradients(rule, q, P, detJ);
    const Mat6 weighted = rule.weight(q) * detJ * elasticity_at(in, rule, q, ply, P);
    StressedPoint& point = points.emplace_back();
    point.stress.noalias() = weighted * strain_matrix(g);
    set_gradient(g, point.gradient);
  });
}

NodalPly nodal_ply(const IsoparametricElement& element, const ElementInput& in, int node) {
  const int k = ply_at(in.plies, element.at[node](2));
  const Positions P = positions(in, element.nodes);
  return {k, elasticity_at(in, at_nodes(element, node, 1), 0, &in.plies[k], P)};
}

}  // namespace floatframe::solid
