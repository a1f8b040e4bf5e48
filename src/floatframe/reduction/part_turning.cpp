#include "floatframe/reduction/part_turning.hpp"

#include <algorithm>

#include "floatframe/fe/pair_products.hpp"

namespace floatframe {
namespace {

constexpr Eigen::Index mass_loads = 12;  // rho e_j, rho r_ui e_j

}  // namespace

MatX weighted_fields(const PointModel& points) {
  MatX fields(points.p.cols(), 4);
  fields.col(0).setOnes();
  fields.rightCols<3>() = points.p.transpose();
  return points.M_s * fields;
}

SecondOrder integrals_of(const MatX& packed) {
  SecondOrder out;
  for (Eigen::Index j = 0; j < 3; ++j) {
    const auto to = static_cast<std::size_t>(j);
    out.S2[to] = symmetric_of(packed.col(j));
    for (Eigen::Index i = 0; i < 3; ++i)
      out.S2i[static_cast<std::size_t>(i)][to] = symmetric_of(packed.col(3 + 3 * i + j));
  }
  return out;
}

void add_integrals(const SecondOrder& from, SecondOrder& to) {
  for (std::size_t j = 0; j < 3; ++j) {
    to.S2[j] += from.S2[j];
    for (std::size_t i = 0; i < 3; ++i) to.S2i[i][j] += from.S2i[i][j];
  }
}

Vec6 turning_form(const Mat3& Q) {
  // theta (theta . arm) - arm theta . theta
  const double trace = Q.trace();
  Vec6 out;
  out << Q(0, 0) - trace, Q(1, 1) - trace, Q(2, 2) - trace, 0.5 * (Q(0, 1) + Q(1, 0)),
      0.5 * (Q(1, 2) + Q(2, 1)), 0.5 * (Q(2, 0) + Q(0, 2));
  return out;
}

SecondOrder turning_of(const PointModel& points, std::span<const PointArm> arms, const MatX& X) {
  const MatX weights = weighted_fields(points);
  // int arm dm and int arm r_ui dm of what each rotation carries.
  const Eigen::Index rotations = points.rotations.rows() / 3;
  Mat3X moments = Mat3X::Zero(3, 4 * rotations);
  for (const PointArm& a : arms)
    moments.middleCols<4>(4 * a.rotation) += a.arm * weights.row(a.point);

  PairProducts products(X.cols(), mass_loads);
  constexpr Eigen::Index batch = 256;
  MatX s(6, mass_loads);
  for (Eigen::Index first = 0; first < rotations; first += batch) {
    const Eigen::Index count = std::min(batch, rotations - first);
    const MatX turned = points.rotations.middleRows(3 * first, 3 * count) * X;
    for (Eigen::Index r = 0; r < count; ++r) {
      const auto A = moments.middleCols<4>(4 * (first + r));
      if (A.isZero(0.0)) continue;
      for (Eigen::Index field = 0; field < 4; ++field)
        for (Eigen::Index j = 0; j < 3; ++j)
          s.col(3 * field + j) = turning_form(Vec3::Unit(j) * A.col(field).transpose());
      products.add(turned.middleRows(3 * r, 3), s);
    }
  }
  return integrals_of(products.take());
}

std::shared_ptr<const SecondOrder> part_turning(const PointModel& points, const MatX& X,
                                                const std::optional<SecondOrder>& twist) {
  if (points.arms.empty() && !twist) return nullptr;
  auto out = std::make_shared<SecondOrder>(turning_of(points, points.arms, X));
  if (twist) add_integrals(*twist, *out);
  return out;
}

std::shared_ptr<const ProjectionData> projection_of(const PointModel& points, const MatX& X,
                                                    const std::optional<SecondOrder>& twist) {
  auto data = std::make_shared<ProjectionData>();
  data->p = points.p;
  data->X = points.T * X;
  data->M_s = points.M_s;
  if (!points.arms.empty()) data->rotations = points.rotations * X;
  for (const PointArm& a : points.arms) data->turning.push_back({a.point, a.rotation, a.arm});
  if (twist) data->twist = std::make_shared<const SecondOrder>(*twist);
  return data;
}

}  // namespace floatframe
