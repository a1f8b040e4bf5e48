#include "floatframe/reduction/part_second_order.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/springs.hpp"
#include "floatframe/fe/stress_stiffness.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/reduction/part_turning.hpp"

namespace floatframe {
namespace {

constexpr Eigen::Index body_cases = 12;

/// Unit loads of all cases, with the reactions of the body reference.
MatX balanced_loads(const PlacedPart& part, const MatX& loads, const MatX& B) {
  const FeSystem& system = part.system;
  const std::size_t places = part.interfaces.size() + part.markers.size();
  MatX F(system.size(), body_cases + 6 * static_cast<Eigen::Index>(places));
  F.leftCols<body_cases>() = loads;
  Eigen::Index column = body_cases;
  const auto add = [&](const SparseRows& rows) {
    F.middleCols<3>(column) = MatX(SparseMatrix(rows.transpose()));
    column += 3;
  };
  for (const InterfacePlace& place : part.interfaces) {
    add(system.T.middleRows(3 * place.node, 3));
    add(system.T_theta.middleRows(3 * place.node, 3));
  }
  for (const MarkerPlace& marker : part.markers) {
    add(marker.translation);
    add(marker.rotation);
  }
  const Mat6 BR = B * part.R;
  F -= B.transpose() * lu_solve(BR.transpose(), MatX(part.R.transpose() * F));
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
  const MatX weights = weighted_fields(points);
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

MatX held_response(const PlacedPart& part, const MatX& loads, const MatX& B,
                   const FixedInterface& fixed, const ModeBasis& basis) {
  const MatX F = balanced_loads(part, loads, B);
  std::vector<int> rows;
  for (const InterfacePlace& place : part.interfaces)
    rows.insert(rows.end(), place.rows.begin(), place.rows.end());
  const auto nb = static_cast<Eigen::Index>(rows.size());
  const auto X_c = basis.X.leftCols(nb);
  const MatX f = X_c.transpose() * F;
  const MatX u = boundary_response(basis.K.topLeftCorner(nb, nb), part.R(rows, Eigen::all), f);
  MatX w = fixed.inner_response(F);
  w.noalias() += X_c * u;
  return w;
}

MatX free_response(const PlacedPart& part, const MatX& loads, const MatX& B,
                   const FreeStructure& structure, const Eigenpairs& elastic) {
  return structure.relieved_response(balanced_loads(part, loads, B), elastic);
}

namespace {

/// Forces of elements and springs on the nodes that are fixed to others, less the forces of the
/// cases there: three rows per node, one column per case.
class ForcesOnFollowers {
 public:
  ForcesOnFollowers(const FeModel& model, const std::vector<PointArm>& followers)
      : model_(model), place_(model.positions.size(), -1) {
    for (const PointArm& f : followers)
      if (place_[f.point] < 0) place_[f.point] = count_++;
  }

  void add_elements(const NodalShapes& cases, Integration integration) {
    F_ = MatX::Zero(3 * count_, cases.U.cols());
    MatX K, w;
    for (const FeElement& e : model_.elements) {
      const ElementKernel& kernel = element_kernel(e.type);
      const auto nodes = std::span(e.nodes).first(static_cast<std::size_t>(kernel.nodes));
      if (std::none_of(nodes.begin(), nodes.end(), [&](int k) { return place_[k] >= 0; })) continue;
      kernel.stiffness(gather(model_, e, integration), K);
      element_displacements(e, kernel, cases, w);
      for (int a = 0; a < kernel.nodes; ++a)
        if (const int to = place_[e.nodes[a]]; to >= 0)
          F_.middleRows<3>(3 * to) += K.middleRows<3>(kernel.dofs_per_node * a) * w;
    }
    if (!model_.springs.empty()) add_springs(cases);
  }
  void subtract_markers(const std::vector<MarkerPlace>& markers, Eigen::Index column) {
    for (const MarkerPlace& marker : markers) {
      subtract(marker.by_translations, column);
      subtract(marker.turn_by_translations, column + 3);
      column += 6;
    }
  }
  auto of(int node) const { return F_.middleRows<3>(3 * static_cast<Eigen::Index>(place_[node])); }

 private:
  void add_springs(const NodalShapes& cases) {
    for (const SpringBlock& block : spring_system(model_, dof_table(model_)).blocks) {
      const auto n = static_cast<Eigen::Index>(block.dofs.size());
      MatX w(n, cases.U.cols());
      for (Eigen::Index i = 0; i < n; ++i) {
        const Dof& dof = block.dofs[static_cast<std::size_t>(i)];
        w.row(i) = (dof.axis < 3 ? cases.U : cases.Theta).row(3 * dof.node + dof.axis % 3);
      }
      const MatX f = block.K * w;
      for (Eigen::Index i = 0; i < n; ++i) {
        const Dof& dof = block.dofs[static_cast<std::size_t>(i)];
        if (dof.axis < 3 && place_[dof.node] >= 0)
          F_.row(3 * place_[dof.node] + dof.axis) += f.row(i);
      }
    }
  }
  void subtract(const SparseRows& rows, Eigen::Index column) {
    for (Eigen::Index j = 0; j < rows.rows(); ++j)
      for (SparseRows::InnerIterator it(rows, j); it; ++it)
        if (const int to = place_[it.col() / 3]; to >= 0)
          F_(3 * to + it.col() % 3, column + j) -= it.value();
  }

  const FeModel& model_;
  std::vector<int> place_;
  int count_ = 0;
  MatX F_;
};

/// Adds sum (F_i - f_i) . (theta x (theta x arm)) of all cases to the stress stiffness.
void add_followers(const FeModel& model, const PointModel& points, const MatX& X,
                   const NodalShapes& cases, const std::vector<MarkerPlace>& markers,
                   Eigen::Index first_marker, Integration integration, MatX& K) {
  if (points.followers.empty()) return;
  ForcesOnFollowers forces(model, points.followers);
  forces.add_elements(cases, integration);
  forces.subtract_markers(markers, first_marker);
  const Eigen::Index nc = cases.U.cols();
  std::map<int, MatX> of_rotations;
  for (const PointArm& f : points.followers) {
    MatX& s = of_rotations.try_emplace(f.rotation, MatX::Zero(6, nc)).first->second;
    const auto F = forces.of(f.point);
    for (Eigen::Index c = 0; c < nc; ++c)
      s.col(c) += turning_form(Vec3(F.col(c)) * f.arm.transpose());
  }
  PairProducts products(X.cols(), nc);
  for (const auto& [rotation, s] : of_rotations)
    products.add(points.rotations.middleRows(3 * rotation, 3) * X, s);
  K += products.take();
}

/// h of a column of the stress stiffness.
MatX second_order_matrix(const MatX& K, std::size_t column) {
  return -symmetric_of(K.col(static_cast<Eigen::Index>(column)));
}

}  // namespace

PartSecondOrder part_second_order(const PlacedPart& part, const PointModel& points, const MatX& X,
                                  const MatX& response) {
  const auto& [model, system, R, interfaces, markers, options] = part;
  PartSecondOrder out;
  StressStiffness K;
  {
    const NodalShapes modes{system.T * X, system.T_theta * X};
    const NodalShapes cases{system.T * response, system.T_theta * response};
    K = shares_of_stress_stiffness(model, modes, cases, options.integration);
    const auto first_marker = body_cases + 6 * static_cast<Eigen::Index>(interfaces.size());
    add_followers(model, points, X, cases, markers, first_marker, options.integration, K.direct);
  }
  auto stiffening = std::make_shared<SecondOrder>(integrals_of(-K.direct.leftCols<body_cases>()));
  if (!points.strained_arms.empty()) {
    add_integrals(turning_of(points, points.strained_arms, X), *stiffening);
  }
  if (K.twist.size() > 0) {
    out.twist = integrals_of(-K.twist.leftCols<body_cases>());
    K.direct += K.twist;
  }
  for (std::size_t k = 0; k < interfaces.size() + markers.size(); ++k) {
    SecondOrderNode& node = stiffening->nodes.emplace_back();
    node.node = static_cast<int>(k);
    for (std::size_t j = 0; j < 3; ++j) {
      node.h[j] = second_order_matrix(K.direct, body_cases + 6 * k + j);
      node.theta[j] = second_order_matrix(K.direct, body_cases + 6 * k + 3 + j);
    }
  }
  out.stiffening = std::move(stiffening);
  return out;
}

}  // namespace floatframe
