#include "floatframe/reduction/part_second_order.hpp"

#include <cmath>

#include "floatframe/fe/stress_stiffness.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

constexpr Eigen::Index body_cases = 12;

/// Unit loads of all cases, with what the body reference carries.
MatX balanced_loads(const FeSystem& system, const UnitCases& cases) {
  const std::size_t places = cases.interfaces.size() + cases.markers.size();
  MatX F(system.size(), body_cases + 6 * static_cast<Eigen::Index>(places));
  F.leftCols<body_cases>() = cases.loads;
  Eigen::Index column = body_cases;
  const auto add = [&](const SparseRows& rows) {
    F.middleCols<3>(column) = MatX(SparseMatrix(rows.transpose()));
    column += 3;
  };
  for (const InterfacePlace& place : cases.interfaces) {
    add(system.T.middleRows(3 * place.node, 3));
    add(system.T_theta.middleRows(3 * place.node, 3));
  }
  for (const MarkerPlace& marker : cases.markers) {
    add(marker.translation);
    add(marker.rotation);
  }
  const Mat6 BR = cases.B * cases.R;
  F -= cases.B.transpose() * lu_solve(BR.transpose(), MatX(cases.R.transpose() * F));
  return F;
}

/// The static displacements of the boundary under loads that balance: the stiffness is singular in
/// the rigid motions, which are added as springs that such loads do not move.
MatX boundary_response(const MatX& K, const MatX& R, const MatX& f) {
  const VecX s =
      K.diagonal().unaryExpr([](double k) { return k > 0.0 ? 1.0 / std::sqrt(k) : 1.0; });
  const PivotedQr rigid = pivoted_qr(s.cwiseInverse().asDiagonal() * R, 1e-10);
  const MatX Q = rigid.Q.leftCols(rigid.rank);
  MatX A = s.asDiagonal() * K * s.asDiagonal();
  A += Q * Q.transpose();
  return s.asDiagonal() * ldlt_solve(A, s.asDiagonal() * f);
}

}  // namespace

MatX body_loads(const PointModel& points) {
  const Eigen::Index n = points.p.cols();
  // Masses of the points with 1, r_u1, r_u2, r_u3.
  MatX fields(n, 4);
  fields.col(0).setOnes();
  fields.rightCols<3>() = points.p.transpose();
  const MatX weights = points.M_s * fields;
  MatX at_points = MatX::Zero(3 * n, body_cases);
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index field = 0; field < 4; ++field)
      for (Eigen::Index j = 0; j < 3; ++j) at_points(3 * k + j, 3 * field + j) = weights(k, field);
  return points.T.transpose() * at_points;
}

MatX momentum_rows(const MatX& loads) {
  MatX B(6, loads.rows());
  B.topRows<3>() = loads.leftCols<3>().transpose();
  const auto column = [&](Eigen::Index i, Eigen::Index j) { return loads.col(3 + 3 * i + j); };
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Index j = (i + 1) % 3, k = (i + 2) % 3;
    B.row(3 + i) = (column(j, k) - column(k, j)).transpose();
  }
  return B;
}

MatX held_response(const FeSystem& system, const UnitCases& cases, const FixedInterface& fixed,
                   const ModeBasis& basis) {
  const MatX F = balanced_loads(system, cases);
  std::vector<int> rows;
  for (const InterfacePlace& place : cases.interfaces)
    rows.insert(rows.end(), place.rows.begin(), place.rows.end());
  const auto nb = static_cast<Eigen::Index>(rows.size());
  const auto X_c = basis.X.leftCols(nb);
  const MatX f = X_c.transpose() * F;
  const MatX u = boundary_response(basis.K.topLeftCorner(nb, nb), cases.R(rows, Eigen::all), f);
  MatX w = fixed.inner_response(F);
  w.noalias() += X_c * u;
  return w;
}

MatX free_response(const FeSystem& system, const UnitCases& cases, const FreeStructure& structure,
                   const Eigenpairs& elastic) {
  return structure.relieved_response(balanced_loads(system, cases), elastic);
}

std::shared_ptr<const SecondOrder> part_second_order(const FeModel& model, const FeSystem& system,
                                                     const MatX& X, const MatX& response,
                                                     std::size_t nodes, Integration integration) {
  const NodalShapes modes{system.T * X, system.T_theta * X};
  const NodalShapes cases{system.T * response, system.T_theta * response};
  const MatX K = stress_stiffness(model, modes, cases, integration);
  const auto h = [&](std::size_t column) {
    return MatX(-symmetric_of(K.col(static_cast<Eigen::Index>(column))));
  };
  auto out = std::make_shared<SecondOrder>();
  for (std::size_t j = 0; j < 3; ++j) {
    out->S2[j] = h(j);
    for (std::size_t i = 0; i < 3; ++i) out->S2i[i][j] = h(3 + 3 * i + j);
  }
  for (std::size_t k = 0; k < nodes; ++k) {
    SecondOrderNode& node = out->nodes.emplace_back();
    node.node = static_cast<int>(k);
    for (std::size_t j = 0; j < 3; ++j) {
      node.h[j] = h(body_cases + 6 * k + j);
      node.theta[j] = h(body_cases + 6 * k + 3 + j);
    }
  }
  return out;
}

}  // namespace floatframe
