// Bearing: a shaft held in a housing by full matrices of stiffness and damping, cross terms and
// parts that are not symmetric (oil films, seals) included. Marker a (`from`, the housing) carries
// the axes e_1..3 = columns of R_a, marker b (`to`, the shaft) the unit vector n = R_b z, which is
// e_3 in the design configuration: the shaft may turn about it without end.
//   displacements  s_i = e_i.d - d0_i,  d = r_b - r_a, i = 1..3            (axis_measure.hpp)
//   tilts          s_4 = -e_2.n,  s_5 = e_1.n: the rotations about e_1, e_2, sines for large ones
//   spin           rate s_6' = e_3.(w_b - w_a) alone
//   forces         f = K s + C s',  6 each; row and column 6 of K are zero
//   wrench         Q = -sum f_i g_i, g_i the gradients of s_i (of s_6' in the rates)
//   energy         U = 1/2 s^T K_s s of the symmetric part K_s; all else, s'^T C s' + s'^T K_a s,
//                  counts as damping power, which may be negative: K_a drives whirl
// With a table over the spin W = s_6' (bearing_table.hpp) K and C are those of the present W, and
// the energy is that of its first row.
// Derivatives, with u = w_b - w_a and phi = e.n, e fixed in a, n in b:
//   gradient   h = n x e in pi_b, -h in pi_a             phi' = h.u
//   curvature  dh = (n e^T - (n.e) I) dpi_b + ((n.e) I - e n^T) dpi_a
//   of s_6'    h = e_3,  dh = -skew(e_3) dpi_a
//   stiffness  sum_ij g_i (K_ij g_j + C_ij ds_j'/d(motion))^T + sum_i f_i dg_i/d(motion)
//   damping    sum_ij g_i C_ij g_j^T
//   of a table sum_i g_i (dK/dW s + dC/dW s')_i times dW, in the rates and in the motion
// Rows of the step: directions t_r in which the symmetric parts of K and C are both diagonal where
// neither drives (their sum is not indefinite), else the eigenvectors of K_s with what C has there.
// Mirrored: axis and axis_2 are polar and e_2 = e_3 x e_1, so for an odd number of planes s_2, s_4
// and s_6 change their signs: K -> E K E, C -> E C E, E = diag(1, -1, 1, -1, 1, -1).
#include <cmath>

#include "floatframe/math/dense.hpp"
#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/bearing_table.hpp"
#include "floatframe/model/force_kind.hpp"
#include "floatframe/model/sentences.hpp"

namespace floatframe {

namespace {

/// e.n with its gradient.
AxisMeasure tilt(const Vec3& e, const MarkerState& a, const MarkerState& b) noexcept {
  const Vec3 n = b.R.col(2), h = n.cross(e);
  return {e.dot(n), h.dot(b.w - a.w), {Vec3::Zero(), -h, Vec3::Zero(), h}};
}

struct BearingMeasures {
  AxisMeasure m[6];
  Vec6 s, rate;

  explicit BearingMeasures(const ForceInput& in) noexcept {
    const Mat3& R = in.a.R;
    for (int i = 0; i < 3; ++i) m[i] = axis_measure(R.col(i), in.a, in.b);
    m[3] = tilt(-R.col(1), in.a, in.b);
    m[4] = tilt(R.col(0), in.a, in.b);
    const Vec3 e = R.col(2);
    m[5] = {0.0, e.dot(in.b.w - in.a.w), {Vec3::Zero(), -e, Vec3::Zero(), e}};
    for (int i = 0; i < 6; ++i) {
      s[i] =
          m[i].s - (i < 3 ? in.force.numbers[static_cast<std::size_t>(bearing_at::d0 + i)] : 0.0);
      rate[i] = m[i].rate;
    }
  }
};

/// For the first row of a table.
double first_spin(const Force& f) noexcept { return f.numbers[bearing_numbers + 1]; }

void add_scaled(double f, const WrenchRow& g, WrenchRow& w) noexcept {
  w.Fa += f * g.Fa;
  w.Ta += f * g.Ta;
  w.Fb += f * g.Fb;
  w.Tb += f * g.Tb;
}

}  // namespace

template <>
void force_of<ForceType::bearing>(const ForceInput& in, ForceState& out) noexcept {
  const BearingMeasures x(in);
  const BearingLaw law(in.force, x.rate[5]);
  const auto T = bearing_matrix(in.force, law.T);
  Vec6 f, kept;
  const auto K = in.force.numbers.size() == bearing_numbers
                     ? law.K
                     : BearingLaw(in.force, first_spin(in.force)).K;
  for (int i = 0; i < 6; ++i) {
    f[i] = kept[i] = 0.0;
    for (int j = 0; j < 6; ++j) {
      f[i] += law.K(i, j) * x.s[j] + law.C(i, j) * x.rate[j];
      kept[i] += 0.5 * (K(i, j) + K(j, i)) * x.s[j];
    }
  }
  out.row_count = 6;
  for (int i = 0; i < 6; ++i) {
    add_scaled(-f[i], x.m[i].g, out.wrench);
    TangentRow& row = out.rows[i];
    row.g = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    for (int j = 0; j < 6; ++j) add_scaled(T(j, i), x.m[j].g, row.g);
    row.k = in.force.numbers[static_cast<std::size_t>(law.k + i)];
    row.c = in.force.numbers[static_cast<std::size_t>(law.c + i)];
  }
  out.energy = 0.5 * kept.dot(x.s);
  out.energy_rate = kept.dot(x.rate);
  out.damping = f.dot(x.rate) - out.energy_rate;
  out.force = f.head<3>().norm();
  out.length = x.s.head<3>().norm();
  out.rate = out.length > 0.0 ? x.s.head<3>().dot(x.rate.head<3>()) / out.length : 0.0;
}

namespace {

/// f dh of the tilt about e added to K, and dphi'/d(motion) at fixed rates.
Vec12 add_tilt(const Vec3& e, const MarkerState& a, const MarkerState& b, double f,
               Mat12& K) noexcept {
  using namespace part_of;
  const Vec3 n = b.R.col(2), u = b.w - a.w;
  const double c = n.dot(e);
  const Mat3 of_b = n * e.transpose() - c * Mat3::Identity();
  const Mat3 of_a = c * Mat3::Identity() - e * n.transpose();
  K.block<3, 3>(pi_b, pi_b) += f * of_b;
  K.block<3, 3>(pi_b, pi_a) += f * of_a;
  K.block<3, 3>(pi_a, pi_b) -= f * of_b;
  K.block<3, 3>(pi_a, pi_a) -= f * of_a;
  Vec12 rate = Vec12::Zero();
  rate.segment<3>(pi_b) = of_b.transpose() * u;
  rate.segment<3>(pi_a) = of_a.transpose() * u;
  return rate;
}

}  // namespace

template <>
void force_tangent_of<ForceType::bearing>(const ForceInput& in, ForceTangent& out) noexcept {
  using namespace part_of;
  const BearingMeasures x(in);
  const BearingLaw law(in.force, x.rate[5]);
  const Mat6 &K = law.K, &C = law.C;
  const Vec6 f = K * x.s + C * x.rate;
  Eigen::Matrix<double, 12, 6> g, g_rate;  // of the measures, and of their rates in the motion
  for (int i = 0; i < 6; ++i) g.col(i) = stacked(x.m[i].g);
  for (int i = 0; i < 3; ++i) {
    g_rate.col(i) = axis_rate_gradient(in.a.R.col(i), in.a, in.b);
    add_axis_curvature(in.a.R.col(i), in.a, in.b, f[i], out.K);
  }
  g_rate.col(3) = add_tilt(-in.a.R.col(1), in.a, in.b, f[3], out.K);
  g_rate.col(4) = add_tilt(in.a.R.col(0), in.a, in.b, f[4], out.K);
  const Vec3 e = in.a.R.col(2);
  const Mat3 E = f[5] * skew(e);
  out.K.block<3, 3>(pi_b, pi_a) -= E;
  out.K.block<3, 3>(pi_a, pi_a) += E;
  g_rate.col(5).setZero();
  g_rate.col(5).segment<3>(pi_a) = e.cross(in.b.w - in.a.w);
  out.K += g * (K * g.transpose() + C * g_rate.transpose());
  out.C += g * C * g.transpose();
  const Eigen::Vector2d of_spin = law.dK * x.s.head<2>() + law.dC * x.rate.head<2>();
  out.K += g.leftCols<2>() * of_spin * g_rate.col(5).transpose();
  out.C += g.leftCols<2>() * of_spin * g.col(5).transpose();
}

namespace {

constexpr ForceKey bearing_keys[] = {
    place_key("from", "on the housing, which carries the axes"),
    place_key("to", "on the shaft, which may turn about its axis without end"),
    {.name = "axis", .kind = ForceKeyKind::direction, .about = "of the shaft, e₃"},
    axis_2_key,
    {.name = "stiffness",
     .kind = ForceKeyKind::stiffness_matrix,
     .about = "displacements along e₁, e₂, e₃ and tilts about e₁, e₂ to forces and moments; 2 x 2: "
              "along e₁, e₂ alone"},
    {.name = "damping",
     .kind = ForceKeyKind::damping_matrix,
     .about = "the same of their rates, the sixth that of the spin about e₃"},
    {.name = "speed_table",
     .kind = ForceKeyKind::speed_table,
     .about = "stiffness and damping along e₁, e₂ over the spin of the shaft about e₃, added to "
              "the others: rows [speed, k₁₁, k₁₂, k₂₁, k₂₂, c₁₁, c₁₂, c₂₁, c₂₂]"}};

/// 6 x 6, a 2 x 2 matrix in its corner.
Mat6 whole(const MatX& given) {
  Mat6 M = Mat6::Zero();
  M.topLeftCorner(given.rows(), given.cols()) = given;
  return M;
}

void bearing_validate(const ForceCheck& check) {
  validate_framed(check);
  if (check.good("stiffness"))
    if (const auto complaint = sentences::bearing_stiffness(check.matrix("stiffness")))
      check.error(ErrorCode::out_of_range, "stiffness", *complaint);
}

/// Directions in which A and B are both diagonal, and their diagonals there:
/// A = sum k_r t_r t_r^T, B = sum c_r t_r t_r^T; false if there are none.
bool both_diagonal(const Mat6& A, const Mat6& B, Mat6& T, Vec6& k, Vec6& c) {
  // Measures with different units: rows and columns scaled by the sum's diagonal.
  const double a = A.cwiseAbs().maxCoeff(), b = B.cwiseAbs().maxCoeff();
  Mat6 P = Mat6::Zero();
  if (a > 0.0) P += A / a;
  if (b > 0.0) P += B / b;
  Vec6 d;
  for (int i = 0; i < 6; ++i) d[i] = P(i, i) > 0.0 ? std::sqrt(P(i, i)) : 1.0;
  const Vec6 inverse = d.cwiseInverse();
  P = inverse.asDiagonal() * P * inverse.asDiagonal();
  const SymmetricEigen sum = symmetric_eigen(P);
  constexpr double none = 1e-12;
  if (!sum.found || sum.values[0] < -none) return false;
  Mat6 to = Mat6::Zero(), back = Mat6::Zero();  // P = back back^T on its range, to = back^-T
  for (int i = 0; i < 6; ++i) {
    const double p = sum.values[i];
    if (p <= none) continue;
    to.col(i) = inverse.asDiagonal() * sum.vectors.col(i) / std::sqrt(p);
    back.col(i) = d.asDiagonal() * sum.vectors.col(i) * std::sqrt(p);
  }
  const SymmetricEigen own = symmetric_eigen(MatX(to.transpose() * A * to));
  if (!own.found) return false;
  T = back * own.vectors;
  k = own.values;
  c = (own.vectors.transpose() * (to.transpose() * B * to) * own.vectors).diagonal();
  // Directions in the null space of the sum must be in that of both parts.
  const double left = (T * k.asDiagonal() * T.transpose() - A).cwiseAbs().maxCoeff();
  return left <= 1e-9 * a;
}

/// T, k, c for the tangent of the step.
void add_tangent(const Mat6& K, const Mat6& C, std::vector<double>& x) {
  const Mat6 K_s = 0.5 * (K + K.transpose()), C_s = 0.5 * (C + C.transpose());
  Mat6 T;
  Vec6 k, c;
  if (!both_diagonal(K_s, C_s, T, k, c)) {
    const SymmetricEigen own = symmetric_eigen(K_s);
    T = own.vectors;
    k = own.values;
    c = (T.transpose() * C_s * T).diagonal().cwiseMax(0.0);
  }
  x.insert(x.end(), T.data(), T.data() + 36);
  x.insert(x.end(), k.data(), k.data() + 6);
  x.insert(x.end(), c.data(), c.data() + 6);
}

/// Force::numbers of a bearing.
std::vector<double> bearing_values(const Mat6& K, const Mat6& C, const Vec3& d0,
                                   const MatX& table) {
  std::vector<double> x;
  x.reserve(bearing_numbers);
  x.insert(x.end(), K.data(), K.data() + 36);
  x.insert(x.end(), C.data(), C.data() + 36);
  x.insert(x.end(), d0.data(), d0.data() + 3);
  add_tangent(K, C, x);
  if (table.rows() > 0) x.push_back(static_cast<double>(table.rows()));
  for (Eigen::Index i = 0; i < table.rows(); ++i) {
    Mat6 K_i = K, C_i = C;
    for (int k = 0; k < 9; ++k) x.push_back(table(i, k));
    for (int k = 0; k < 4; ++k) {
      K_i(k / 2, k % 2) += table(i, 1 + k);
      C_i(k / 2, k % 2) += table(i, 5 + k);
    }
    add_tangent(K_i, C_i, x);
  }
  return x;
}

bool bearing_build(ForceBuild& b) {
  const Mat3 R = element_axes(b);
  b.force.a = b.marker("from", true, R);
  b.force.b = b.marker("to", true, R);
  const Vec3 d0 = R.transpose() * (b.place("to").point - b.place("from").point);
  b.force.numbers = bearing_values(whole(b.matrix("stiffness")), whole(b.matrix("damping")), d0,
                                   b.matrix("speed_table"));
  return b.has_ends();
}

void bearing_mirror(ForceDescription& force, const Placement& x) {
  if (x.det() > 0.0) return;
  const ForceView values(force);
  for (const char* name : {"stiffness", "damping"}) {
    if (!values.has(name)) continue;
    MatX M = values.matrix(name);
    for (Eigen::Index i = 0; i < M.rows(); ++i)
      for (Eigen::Index j = 0; j < M.cols(); ++j)
        if ((i + j) % 2 == 1) M(i, j) = -M(i, j);
    set_force_value(force, values.key(name), M);
  }
  if (values.has("speed_table"))
    set_force_value(force, values.key("speed_table"),
                    mirrored_bearing_table(values.matrix("speed_table")));
}

constexpr const char* turning = "the turning of the axes with the housing and of the shaft's axis";
constexpr ForceRegime bearing_regimes[] = {
    {.name = "symmetric", .rows_leave_out = turning},
    {.name = "cross_coupled", .rows_leave_out = turning, .conservative = false},
    {.name = "plane", .rows_leave_out = turning},
    {.name = "over_speed", .rows_leave_out = turning, .conservative = false},
};

ForceExample bearing_example(std::size_t regime, ExampleNumbers& numbers) {
  const auto definite = [&](int rows, double size) {
    MatX B(rows, rows);
    for (Eigen::Index i = 0; i < B.size(); ++i) B(i) = numbers(-1.0, 1.0);
    return MatX(size * (B * B.transpose() + 0.5 * MatX::Identity(rows, rows)));
  };
  Mat6 K = Mat6::Zero(), C = Mat6::Zero();
  if (regime == 2) {
    K.topLeftCorner<2, 2>() = definite(2, 20.0);
    C.topLeftCorner<2, 2>() = definite(2, 3.0);
  } else {
    K.topLeftCorner<5, 5>() = definite(5, 20.0);
    C = definite(6, 3.0);
  }
  if (regime == 1) {
    K(0, 1) += 15.0;
    K(1, 0) -= 15.0;
    K(3, 0) += 4.0;
    C(0, 4) -= 2.0;
    C(5, 2) += 1.0;
  }
  MatX table(regime == 3 ? 3 : 0, 9);
  for (Eigen::Index i = 0; i < table.rows(); ++i) {
    table(i, 0) = -3.0 + 3.0 * static_cast<double>(i) + numbers(-0.5, 0.5);
    for (int k = 1; k < 9; ++k) table(i, k) = numbers(-20.0, 20.0);
  }
  ForceExample x;
  x.force.type = ForceType::bearing;
  const Vec3 d0(numbers(-0.1, 0.1), numbers(-0.1, 0.1), numbers(-0.1, 0.1));
  x.force.numbers = bearing_values(K, C, d0, table);
  x.a = numbers.marker();
  x.b = numbers.marker();
  x.b.R =
      x.a.R * rotation_exp(numbers.vector(0.3)) * rotation_exp(numbers(-3.0, 3.0) * Vec3::UnitZ());
  return x;
}

}  // namespace

constinit const ForceKind bearing_element = {
    .about =
        "a shaft in a housing, held by full matrices of stiffness and damping with their cross "
        "terms, symmetric or not; the shaft may turn about its axis. Displacements count from the "
        "design configuration, along axes fixed in the body of `from`; tilts are those of the "
        "shaft's axis. Results: size of the force, distance from the design position and its rate",
    .keys = bearing_keys,
    .validate = bearing_validate,
    .build = bearing_build,
    .mirror = bearing_mirror,
    .regimes = bearing_regimes,
    .example = bearing_example};

}  // namespace floatframe
