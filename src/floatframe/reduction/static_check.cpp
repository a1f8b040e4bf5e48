#include "floatframe/reduction/static_check.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "floatframe/math/dense.hpp"
#include "floatframe/math/rigid_motion.hpp"

namespace floatframe {
namespace {

/// Displacements of interface `loaded` under unit loads on its dofs, interface `held` fixed, by
/// the full model from the stiffness of all boundary rows.
MatX by_stiffness(const MatX& K, const InterfacePlace& loaded, const InterfacePlace& held) {
  std::vector<Eigen::Index> free;
  std::vector<Eigen::Index> columns;
  for (Eigen::Index i = 0; i < K.rows(); ++i) {
    if (i >= held.first && i < held.first + 6) continue;
    if (i >= loaded.first && i < loaded.first + static_cast<Eigen::Index>(loaded.rows.size()))
      columns.push_back(static_cast<Eigen::Index>(free.size()));
    free.push_back(i);
  }
  const auto n = static_cast<Eigen::Index>(free.size());
  const MatX inverse = ldlt_solve(K(free, free), MatX::Identity(n, n));
  return inverse(columns, columns);
}

/// The rows of a rigid motion that an interface has.
MatX rigid_rows(const InterfacePlace& place) {
  const Mat6 R = rigid_motion_at(place.health.p);
  return R(place.axes, Eigen::all);
}

/// The same from the flexibility G with inertia relief: u = G f + R r, f in equilibrium.
MatX by_flexibility(const MatX& G, const InterfacePlace& loaded, const InterfacePlace& held) {
  const auto n = static_cast<Eigen::Index>(loaded.rows.size());
  const Mat6 R_h = rigid_motion_at(held.health.p);
  const MatX R_k = rigid_rows(loaded);
  const Eigen::PartialPivLU<Mat6> lu(R_h);
  const Eigen::PartialPivLU<Mat6> transposed(R_h.transpose());
  const MatX reaction = -transposed.solve(R_k.transpose());  // R_h^T reaction + R_k^T f = 0
  const MatX G_hk = G.block(held.first, loaded.first, 6, n);
  const MatX r = -lu.solve(G_hk + G.block<6, 6>(held.first, held.first) * reaction);
  return G.block(loaded.first, loaded.first, n, n) +
         G.block(loaded.first, held.first, n, 6) * reaction + R_k * r;
}

/// The same of the reduced body: rigid motion and modes with the held node at rest.
MatX by_modes(const FlexibleBody& body, std::size_t loaded, std::size_t held,
              const std::vector<int>& axes) {
  const auto rows_of = [&](std::size_t k) {
    MatX X(6, body.modes());
    X.topRows(3) = body.nodes[k].X;
    X.bottomRows(3) = body.nodes[k].X_theta;
    return X;
  };
  const Mat6 R_h = rigid_motion_at(body.nodes[held].p), R_k = rigid_motion_at(body.nodes[loaded].p);
  const MatX all = rows_of(loaded) - R_k * R_h.partialPivLu().solve(rows_of(held));
  const MatX E = all(axes, Eigen::all);
  return E * ldlt_solve(body.K, E.transpose());
}

MatX boundary_flexibility(const FreeStructure& structure, const Eigenpairs& elastic,
                          const std::vector<InterfacePlace>& interfaces, int n) {
  std::vector<int> rows;
  for (const InterfacePlace& place : interfaces)
    rows.insert(rows.end(), place.rows.begin(), place.rows.end());
  MatX F = MatX::Zero(n, static_cast<Eigen::Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) F(rows[k], static_cast<Eigen::Index>(k)) = 1.0;
  const MatX u = structure.relieved_response(F, elastic);
  return u(rows, Eigen::all);
}

}  // namespace

Statics statics_of(const ModeBasis& basis, const std::optional<FreeStructure>& structure,
                   const Eigenpairs& elastic, const std::vector<InterfacePlace>& interfaces,
                   int n) {
  if (structure) return {{}, boundary_flexibility(*structure, elastic, interfaces, n)};
  const auto nb = static_cast<Eigen::Index>(basis.first_normal);
  return {basis.K.topLeftCorner(nb, nb), {}};
}

void check_statics(const std::vector<InterfacePlace>& interfaces, const FlexibleBody& body,
                   const MatX& boundary_stiffness, const MatX& boundary_flexibility,
                   HealthReport& health) {
  std::vector<std::size_t> holding;
  for (std::size_t k = 0; k < interfaces.size(); ++k)
    if (interfaces[k].holds()) holding.push_back(k);
  if (interfaces.size() < 2 || holding.empty() || body.modes() == 0) {
    health.static_support = interfaces.empty()      ? "not checked: no interface"
                            : interfaces.size() < 2 ? "not checked: one interface only"
                            : holding.empty()
                                ? "not checked: no interface has all six degrees of freedom"
                                : "not checked: no modes";
    return;
  }
  if (boundary_stiffness.size() == 0 && boundary_flexibility.size() == 0) {
    health.static_support = "not checked";
    return;
  }
  const std::size_t first = holding[0];
  const bool two = holding.size() > 1;
  health.static_support = fmt::format("'{}'", interfaces[first].name);
  if (two) {
    health.static_support += fmt::format(", for its own loads '{}'", interfaces[holding[1]].name);
  } else {
    health.static_support += ", which is not loaded itself";
  }
  double size = 0.0;  // to compare rotations with displacements
  for (const InterfacePlace& place : interfaces)
    size = std::max(size, (place.health.p - interfaces[first].health.p).norm());
  for (std::size_t k = 0; k < interfaces.size(); ++k) {
    if (k == first && !two) continue;
    const std::size_t held = k == first ? holding[1] : first;
    const InterfacePlace& loaded = interfaces[k];
    MatX full = boundary_stiffness.size() > 0
                    ? by_stiffness(boundary_stiffness, loaded, interfaces[held])
                    : by_flexibility(boundary_flexibility, loaded, interfaces[held]);
    MatX error = by_modes(body, k, held, loaded.axes) - full;
    for (std::size_t i = 0; i < loaded.axes.size(); ++i) {
      if (loaded.axes[i] < 3) continue;
      full.row(static_cast<Eigen::Index>(i)) *= size;
      error.row(static_cast<Eigen::Index>(i)) *= size;
    }
    double worst = 0.0;
    for (Eigen::Index j = 0; j < full.cols(); ++j) {
      const double largest = full.col(j).cwiseAbs().maxCoeff();
      if (largest > 0.0) worst = std::max(worst, error.col(j).cwiseAbs().maxCoeff() / largest);
    }
    health.interfaces[k].static_error = worst;
  }
}

}  // namespace floatframe
