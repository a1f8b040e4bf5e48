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
// Rows of the step: directions t_r in which the symmetric parts of K and C are both diagonal where
// neither drives (their sum is not indefinite), else the eigenvectors of K_s with what C has there.
// Mirrored: axis and axis_2 are polar and e_2 = e_3 x e_1, so for an odd number of planes s_2, s_4
// and s_6 change their signs: K -> E K E, C -> E C E, E = diag(1, -1, 1, -1, 1, -1).
#include <cmath>

#include "floatframe/description/sentences.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/bearing_table.hpp"
#include "floatframe/model/element_kind.hpp"

namespace floatframe {

namespace {

template <class S>
struct BearingMeasures {
  using V = Eigen::Matrix<S, 3, 1>;
  AxisMeasure<S> m[6];
  S s[6], rate[6];

  explicit BearingMeasures(const PortsOf<S>& in) noexcept {
    const auto &a = in.marker(0), &b = in.marker(1);
    const V zero = V::Zero(), n = b.R.col(2), e = a.R.col(2), u = b.w - a.w;
    for (int i = 0; i < 3; ++i) m[i] = axis_measure(V(a.R.col(i)), a, b);
    const auto tilt = [&](const V& axis) -> AxisMeasure<S> {  // axis.n
      const V h = n.cross(axis);
      return {axis.dot(n), h.dot(u), {{zero, -h}, {zero, h}}};
    };
    m[3] = tilt(-a.R.col(1));
    m[4] = tilt(a.R.col(0));
    m[5] = {0.0, e.dot(u), {{zero, -e}, {zero, e}}};
    const Vec3& d0 = in.template data<BearingData>().d0;
    for (int i = 0; i < 6; ++i) {
      s[i] = i < 3 ? S(m[i].s - d0[i]) : m[i].s;
      rate[i] = m[i].rate;
    }
  }
};

template <class S>
void bearing_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const BearingMeasures<S> x(in);
  const BearingData& data = in.template data<BearingData>();
  const BearingCorner corner(data, value_of(x.rate[5]));
  const auto& first = data.speeds;
  S f[6];
  out.energy = 0.0;
  for (int i = 0; i < 6; ++i) {
    S kept = 0.0;  // by the symmetric part of the stiffness
    f[i] = 0.0;
    for (int j = 0; j < 6; ++j) {
      double k = data.K(i, j), kept_k = 0.5 * (data.K(i, j) + data.K(j, i));
      S K = k, C = data.C(i, j);
      if (i < 2 && j < 2 && !first.empty()) {
        K = chained(k + corner.K(i, j), corner.dK(i, j), x.rate[5]);
        C = chained(data.C(i, j) + corner.C(i, j), corner.dC(i, j), x.rate[5]);
        kept_k = 0.5 * (data.K(i, j) + first[0].K(i, j) + data.K(j, i) + first[0].K(j, i));
      }
      f[i] += K * x.s[j] + C * x.rate[j];
      kept += kept_k * x.s[j];
    }
    out.add_pair(-f[i], x.m[i].g);
    out.energy += 0.5 * kept * x.s[i];
    out.energy_rate += kept * x.rate[i];
    out.damping += f[i] * x.rate[i];
  }
  out.damping -= out.energy_rate;
  if constexpr (std::is_same_v<S, double>)
    for (int i = 0; i < 6; ++i) {
      Wrench* row = out.add_row(corner.rows->k[i], corner.rows->c[i]);
      const Mat6& T = corner.rows->T;
      const auto& m = x.m;  // displacements push at the points, tilts and spin only turn
      row[0].F = T(0, i) * m[0].g.a.F + T(1, i) * m[1].g.a.F + T(2, i) * m[2].g.a.F;
      row[0].T = T(0, i) * m[0].g.a.T + T(1, i) * m[1].g.a.T + T(2, i) * m[2].g.a.T +
                 T(3, i) * m[3].g.a.T + T(4, i) * m[4].g.a.T + T(5, i) * m[5].g.a.T;
      row[1].F = -row[0].F;
      row[1].T = T(3, i) * m[3].g.b.T + T(4, i) * m[4].g.b.T + T(5, i) * m[5].g.b.T;
    }
  const V force(f[0], f[1], f[2]), s(x.s[0], x.s[1], x.s[2]);
  out.force = force.norm();
  out.length = s.norm();
  out.rate = out.length > 0.0 ? S(s.dot(V(x.rate[0], x.rate[1], x.rate[2])) / out.length) : S(0.0);
}

}  // namespace

FLOATFRAME_LAW(bearing)

namespace {

constexpr ElementKey bearing_keys[] = {
    place_key("from", "on the housing, which carries the axes", described_by<&Bearing::from>),
    place_key("to", "on the shaft, which may turn about its axis without end",
              described_by<&Bearing::to>),
    {.name = "axis",
     .kind = KeyKind::direction,
     .about = "of the shaft, e₃",
     .member = described_by<&Bearing::axis>},
    axis_2_key(described_by<&Bearing::axis_2>),
    {.name = "stiffness",
     .kind = KeyKind::stiffness_matrix,
     .about = "displacements along e₁, e₂, e₃ and tilts about e₁, e₂ to forces and moments; 2 x 2: "
              "along e₁, e₂ alone",
     .member = described_by<&Bearing::stiffness>},
    {.name = "damping",
     .kind = KeyKind::damping_matrix,
     .about = "the same of their rates, the sixth that of the spin about e₃",
     .member = described_by<&Bearing::damping>},
    {.name = "speed_table",
     .kind = KeyKind::speed_table,
     .about = "stiffness and damping along e₁, e₂ over the spin of the shaft about e₃, added to "
              "the others: rows [speed, k₁₁, k₁₂, k₂₁, k₂₂, c₁₁, c₁₂, c₂₁, c₂₂]",
     .member = described_by<&Bearing::speed_table>}};

/// 6 x 6, a 2 x 2 matrix in its corner.
Mat6 whole(const MatX& given) {
  Mat6 M = Mat6::Zero();
  M.topLeftCorner(given.rows(), given.cols()) = given;
  return M;
}

void bearing_validate(const ElementCheck& check) {
  validate_framed(check);
  if (check.given("stiffness") && check.good("stiffness"))
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

BearingRows rows_of_step(const Mat6& K, const Mat6& C) {
  const Mat6 K_s = 0.5 * (K + K.transpose()), C_s = 0.5 * (C + C.transpose());
  BearingRows rows;
  if (both_diagonal(K_s, C_s, rows.T, rows.k, rows.c)) return rows;
  const SymmetricEigen own = symmetric_eigen(K_s);
  rows.T = own.vectors;
  rows.k = own.values;
  rows.c = (rows.T.transpose() * C_s * rows.T).diagonal().cwiseMax(0.0);
  return rows;
}

std::shared_ptr<const BearingData> bearing_data(const Bearing& bearing, const Vec3& d0) {
  BearingData x{whole(bearing.stiffness), whole(bearing.damping), d0, {}, {}};
  x.rows = rows_of_step(x.K, x.C);
  const MatX& table = bearing.speed_table;
  for (Eigen::Index i = 0; i < table.rows(); ++i) {
    BearingSpeed at;
    at.spin = table(i, 0);
    at.K << table(i, 1), table(i, 2), table(i, 3), table(i, 4);
    at.C << table(i, 5), table(i, 6), table(i, 7), table(i, 8);
    Mat6 K = x.K, C = x.C;
    K.topLeftCorner<2, 2>() += at.K;
    C.topLeftCorner<2, 2>() += at.C;
    at.rows = rows_of_step(K, C);
    x.speeds.push_back(std::move(at));
  }
  return std::make_shared<const BearingData>(std::move(x));
}

bool bearing_build(ElementBuild& b) {
  const Mat3 R = element_axes(b);
  const Vec3 d0 = R.transpose() * (b.place("to").point - b.place("from").point);
  b.element.data = bearing_data(b.keys<Bearing>(), d0);
  const bool from = b.connect("from", true, R), to = b.connect("to", true, R);
  return from && to;
}

Picture bearing_picture(const Element& element) {
  return {.symbol = Picture::Symbol::bearing,
          .a = element.markers[0],
          .b = element.markers[1],
          .axis = Vec3::UnitZ(),
          .axis_of = element.markers[0]};
}

void bearing_mirror(ElementDescription& force, const Placement& x) {
  if (x.det() > 0.0) return;
  const ElementView values(force);
  for (const char* name : {"stiffness", "damping"}) {
    MatX M = values.matrix(name);
    for (Eigen::Index i = 0; i < M.rows(); ++i)
      for (Eigen::Index j = 0; j < M.cols(); ++j)
        if ((i + j) % 2 == 1) M(i, j) = -M(i, j);
    set_key_value(force, values.key(name), M);
  }
  set_key_value(force, values.key("speed_table"),
                mirrored_bearing_table(values.matrix("speed_table")));
}

constexpr const char* turning = "the turning of the axes with the housing and of the shaft's axis";
constexpr ElementRegime bearing_regimes[] = {
    {.name = "symmetric", .rows_leave_out = turning},
    {.name = "cross_coupled", .rows_leave_out = turning, .conservative = false},
    {.name = "plane", .rows_leave_out = turning},
    {.name = "over_speed", .rows_leave_out = turning, .conservative = false},
};

ElementExample bearing_example(std::size_t regime, ExampleNumbers& numbers) {
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
  ElementExample x;
  Bearing bearing;
  bearing.stiffness = K;
  bearing.damping = C;
  bearing.speed_table = table;
  x.keys(bearing);
  const Vec3 d0(numbers(-0.1, 0.1), numbers(-0.1, 0.1), numbers(-0.1, 0.1));
  x.element.data = bearing_data(bearing, d0);
  x.markers = {numbers.marker(), numbers.marker()};
  x.markers[1].R = x.markers[0].R * rotation_exp(numbers.vector(0.3)) *
                   rotation_exp(numbers(-3.0, 3.0) * Vec3::UnitZ());
  return x;
}

}  // namespace

constinit const ElementKind bearing_element = {
    .about =
        "a shaft in a housing, held by full matrices of stiffness and damping with their cross "
        "terms, symmetric or not; the shaft may turn about its axis. Displacements count from the "
        "design configuration, along axes fixed in the body of `from`; tilts are those of the "
        "shaft's axis. Results: size of the force, distance from the design position and its rate",
    .keys = bearing_keys,
    .blank = [] { return ElementKeys(Bearing()); },
    .validate = bearing_validate,
    .build = bearing_build,
    .mirror = bearing_mirror,
    .bears = true,
    .dual = bearing_law<Dual>,
    .picture = bearing_picture,
    .regimes = bearing_regimes};

constinit const ExampleMaker bearing_examples = bearing_example;

}  // namespace floatframe
