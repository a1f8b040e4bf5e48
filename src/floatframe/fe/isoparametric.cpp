#include "floatframe/fe/isoparametric.hpp"

#include <Eigen/LU>

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

/// int B^T D B dV, with the axes of the material at each point.
void anisotropic_stiffness(const SampledRule& rule, const ElementInput& in, const Positions& P,
                           MatX& out) {
  out = MatX::Zero(P.size(), P.size());
  for (int q = 0; q < rule.size(); ++q) {
    double detJ = 0.0;
    const Strain B = strain_matrix(gradients(rule, q, P, detJ));
    const Mat6 D = rule.weight(q) * detJ * elasticity_at(in, P * rule.N.col(q));
    const Strain DB = D * B;
    out.noalias() += B.transpose() * DB;
  }
  out = (0.5 * (out + out.transpose())).eval();
}

}  // namespace

Positions positions(const ElementInput& in, int nodes) {
  Positions P(3, nodes);
  for (int a = 0; a < nodes; ++a) P.col(a) = in.p[a];
  return P;
}

ShapeGradients gradients(const SampledRule& rule, int q, const Positions& P, double& detJ) {
  const Mat3 J = P * rule.dN.middleCols<3>(3 * q);  // J(i, j) = dx_i / dxi_j
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
                                   const StressRule& stress) {
  IsoparametricElement element;
  element.nodes = nodes;
  for (std::size_t i = 0; i < 2; ++i) {
    element.stiffness[i] = sample(nodes, functions, stiffness[i]);
    element.mass[i] = sample(nodes, functions, mass[i]);
  }
  element.stress = sample(nodes, functions, stress.points);
  const int terms = static_cast<int>(stress.functions(Vec3::Zero()).size());
  MatX at_points(element.stress.size(), terms), at_nodes(nodes, terms);
  for (int q = 0; q < element.stress.size(); ++q) {
    at_points.row(q) = stress.functions(stress.points[q].xi);
  }
  for (int a = 0; a < nodes; ++a) {
    at_nodes.row(a) = stress.functions(stress.nodes[a]);
  }
  element.to_nodes = at_nodes * LeastNorm(at_points).pseudo_inverse();
  return element;
}

std::string error(const IsoparametricElement& element, const ElementInput& in) {
  const Positions P = positions(in, element.nodes);
  const double size = (P.colwise() - P.col(0)).colwise().norm().maxCoeff();
  const double limit = 1e-12 * size * size * size;
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
  if (in.material.elasticity) return anisotropic_stiffness(rule, in, P, out);
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

void scalar_mass(const IsoparametricElement& element, const ElementInput& in, MatX& out) {
  const SampledRule& rule = select(element.mass, in);
  const Mat3X J = positions(in, element.nodes) * rule.dN;
  VecX dm(rule.size());
  for (int q = 0; q < rule.size(); ++q) {
    dm(q) = in.material.density * rule.weight(q) * J.middleCols<3>(3 * q).determinant();
  }
  const MatX weighted = rule.N * dm.asDiagonal();
  out.noalias() = weighted * rule.N.transpose();
  out = (0.5 * (out + out.transpose())).eval();
}

void mass(const IsoparametricElement& element, const ElementInput& in, MatX& out) {
  MatX scalar;
  scalar_mass(element, in, scalar);
  expand(scalar, out);
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
  points.resize(element.stress.size());
  for (int q = 0; q < element.stress.size(); ++q) {
    double detJ = 0.0;
    const Gradients g = gradients(element.stress, q, P, detJ);
    const Mat6 weighted =
        element.stress.weight(q) * detJ * elasticity_at(in, P * element.stress.N.col(q));
    points[q].stress.noalias() = weighted * strain_matrix(g);
    set_gradient(g, points[q].gradient);
  }
}

}  // namespace floatframe::solid
