#include "floatframe/model/gauge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/system_motion.hpp"

namespace floatframe {
namespace {

/// eps = row . stress
Eigen::RowVector<double, 6> strain_row(const Vec3& d, const StressGroup& group) {
  assert(is_unit(d) && group.young > 0.0);
  Eigen::RowVector<double, 6> row;
  row << d(0) * d(0), d(1) * d(1), d(2) * d(2), 2.0 * d(0) * d(1), 2.0 * d(1) * d(2),
      2.0 * d(2) * d(0);
  row *= 1.0 + group.poisson;
  row.head<3>().array() -= group.poisson * d.squaredNorm();
  return row / group.young;
}

}  // namespace

void fill_rows(const FlexibleBody& body, Gauge& gauge) {
  assert(body.stress && (gauge.section >= 0) != (gauge.place >= 0));
  const BodyStress& stress = *body.stress;
  if (gauge.section >= 0) {
    const Eigen::Index row = 6 * static_cast<Eigen::Index>(gauge.section);
    gauge.modes = stress.section_modes.middleRows<6>(row);
    gauge.loads.resize(6, 0);
    if (gauge.inertia_loads && stress.section_loads.size() > 0)
      gauge.loads = stress.section_loads.middleRows<6>(row);
    return;
  }
  const Eigen::Index row = 6 * static_cast<Eigen::Index>(gauge.place);
  gauge.modes = stress.modes.middleRows<6>(row);
  gauge.loads.resize(6, 0);
  if (gauge.inertia_loads && stress.loads.size() > 0) gauge.loads = stress.loads.middleRows<6>(row);
  if (gauge.direction.isZero(0.0)) return;
  const auto strain = strain_row(gauge.direction, stress.groups[stress.places[gauge.place].group]);
  for (auto* m : {&gauge.modes, &gauge.loads}) {
    const Eigen::RowVectorXd values = strain * *m;
    m->setZero();
    m->row(0) = values;
  }
}

BodyLoadCoefficients body_load_coefficients(const SystemMotion& motion, int body) noexcept {
  const BodyKinematics& b = motion.body(body);
  const Vec3 a = b.R_WB.transpose() * (b.a_WB - motion.model.gravity);
  const Vec3 w = b.R_WB.transpose() * b.w_WB;
  const Vec3 alpha = b.R_WB.transpose() * b.alpha_WB;
  const Mat3 A = skew(alpha) + skew(w) * skew(w);
  BodyLoadCoefficients c;
  c.head<3>() = -a;
  for (int i = 0; i < 3; ++i) c.segment<3>(3 + 3 * i) = -A.col(i);
  return c;
}

Vec6 gauge_values(const SystemMotion& motion, const Gauge& gauge) noexcept {
  Vec6 out = Vec6::Zero();
  const BodyKinematics& b = motion.body(gauge.body);
  const auto nm = static_cast<int>(gauge.modes.cols());
  assert(nm == b.y.size());
  for (int k = 0; k < nm; ++k) out += gauge.modes.col(k) * b.y[k];
  if (gauge.loads.cols() == 0) return out;
  assert(gauge.loads.cols() == body_load_cases + nm);
  const BodyLoadCoefficients c = body_load_coefficients(motion, gauge.body);
  for (int k = 0; k < body_load_cases; ++k) out += gauge.loads.col(k) * c(k);
  for (int k = 0; k < nm; ++k) out -= gauge.loads.col(body_load_cases + k) * b.ydd[k];
  return out;
}

std::vector<std::string> doubtful_gauges(const Model& model, std::size_t first_output) {
  std::vector<std::string> out;
  for (std::size_t g = 0; g < model.gauges.size(); ++g) {
    const Gauge& gauge = model.gauges[g];
    const Body& body = model.bodies[gauge.body];
    if (gauge.place < 0 || !body.data->stress->places[gauge.place].doubtful) continue;
    const auto output = std::find_if(
        model.outputs.begin() + static_cast<std::ptrdiff_t>(first_output), model.outputs.end(),
        [&](const Output& o) { return o.gauge == static_cast<int>(g); });
    if (output == model.outputs.end()) continue;
    out.push_back(
        fmt::format("output '{}': body '{}' is held by a rigid spider there or next to it, stress "
                    "at that place is not to be trusted",
                    output->name, body.name));
  }
  return out;
}

double von_mises(const Vec6& s) noexcept {
  const double a = s(0) - s(1), b = s(1) - s(2), c = s(2) - s(0);
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * s.tail<3>().squaredNorm());
}

Vec3 principal_stresses(const Vec6& s) noexcept {
  const double mean = (s(0) + s(1) + s(2)) / 3.0;
  const Vec3 d = s.head<3>().array() - mean;
  const double p = std::sqrt((d.squaredNorm() + 2.0 * s.tail<3>().squaredNorm()) / 6.0);
  if (!(p > 0.0)) return Vec3::Constant(mean);
  // det((s - mean I) / p) / 2 = cos(3 phi)
  const Vec3 e = d / p;
  const double xy = s(3) / p, yz = s(4) / p, zx = s(5) / p;
  const double half_det = 0.5 * (e(0) * (e(1) * e(2) - yz * yz) - xy * (xy * e(2) - yz * zx) +
                                 zx * (xy * yz - e(1) * zx));
  const double phi = std::acos(std::clamp(half_det, -1.0, 1.0)) / 3.0;
  const double first = mean + 2.0 * p * std::cos(phi);
  const double third = mean + 2.0 * p * std::cos(phi + 2.0 * std::numbers::pi / 3.0);
  return {first, 3.0 * mean - first - third, third};
}

}  // namespace floatframe
