#include "floatframe/fe/isoparametric.hpp"

#include <Eigen/LU>

#include "floatframe/fe/solid_element.hpp"

namespace floatframe::solid {
namespace {

using Positions = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 20>;

Positions positions(const ElementInput& in, int nodes) {
  Positions P(3, nodes);
  for (int a = 0; a < nodes; ++a) P.col(a) = in.p[static_cast<std::size_t>(a)];
  return P;
}

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

}  // namespace

SampledRule sample(int nodes, ShapeFunctions functions, const QuadratureRule& rule) {
  const int nq = static_cast<int>(rule.size());
  SampledRule s;
  s.weight.resize(nq);
  s.N.resize(nodes, nq);
  s.dN.resize(nodes, 3 * nq);
  Shape N(nodes);
  ShapeGradients dN(3, nodes);
  for (int q = 0; q < nq; ++q) {
    const QuadraturePoint& point = rule[static_cast<std::size_t>(q)];
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
                                   const std::array<QuadratureRule, 2>& mass) {
  IsoparametricElement element;
  element.nodes = nodes;
  element.functions = functions;
  for (std::size_t i = 0; i < 2; ++i) {
    element.stiffness[i] = sample(nodes, functions, stiffness[i]);
    element.mass[i] = sample(nodes, functions, mass[i]);
  }
  return element;
}

std::string fault(const IsoparametricElement& element, const ElementInput& in) {
  const Positions P = positions(in, element.nodes);
  const double size = (P.colwise() - P.col(0)).colwise().norm().maxCoeff();
  const double limit = 1e-12 * size * size * size;
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
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 60, 27> g(3 * n, nq),
      weighted(3 * n, nq);
  for (int q = 0; q < nq; ++q) {
    const Mat3 J = P * rule.dN.middleCols<3>(3 * q);  // J(i, j) = dx_i / dxi_j
    const Mat3 inverse = J.inverse().transpose();
    for (int a = 0; a < n; ++a) {
      g.block<3, 1>(3 * a, q).noalias() = inverse * rule.dN.block<1, 3>(a, 3 * q).transpose();
    }
    weighted.col(q) = (rule.weight(q) * J.determinant()) * g.col(q);
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

}  // namespace floatframe::solid
