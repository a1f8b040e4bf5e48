#include "floatframe/inertia/projection.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "floatframe/core/debug_only.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

constexpr int padded(int columns) { return (columns + 3) / 4 * 4; }

// The two coordinate sets: the rigid columns of B at a node with local position p (body
// axes) and the acceleration for zero second derivatives. `rows` has three rows of length
// `stride`.

struct RelativeCoordinates {
  static constexpr int rigid = 6;
  const Vec3& r0;
  const Mat3& A;
  const Vec3& omega;
  Vec3 w;  ///< omega in body axes

  RelativeCoordinates(const Vec3& r0_in, const Mat3& A_in, const Vec3& omega_in) noexcept
      : r0(r0_in), A(A_in), omega(omega_in), w(A_in.transpose() * omega_in) {}

  void translation(const Vec3& p, double* rows, int stride) const noexcept {
    const Vec3 r = r0 + A * p;
    double* x = rows;
    double* y = rows + stride;
    double* z = rows + 2 * stride;
    x[0] = 1.0, x[1] = 0.0, x[2] = 0.0, x[3] = 0.0, x[4] = r.z(), x[5] = -r.y();  // (11)
    y[0] = 0.0, y[1] = 1.0, y[2] = 0.0, y[3] = -r.z(), y[4] = 0.0, y[5] = r.x();
    z[0] = 0.0, z[1] = 0.0, z[2] = 1.0, z[3] = r.y(), z[4] = -r.x(), z[5] = 0.0;
  }
  Vec3 bias(const Vec3& p, const Vec3& pdot) const noexcept {
    const Vec3 r = r0 + A * p;
    const Vec3 relative = A * pdot;
    return omega.cross(omega.cross(r) + 2.0 * relative);  // (56)
  }
  void rotation(double* rows, int stride) const noexcept {  // A^T omega
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        rows[i * stride + j] = 0.0;
        rows[i * stride + 3 + j] = A(j, i);
      }
    }
  }
};

struct AbsoluteCoordinates {
  static constexpr int rigid = 12;
  const Mat3& A;
  const Mat3& Adot;
  Vec3 w;  ///< angular velocity in body axes, from the skew part of A^T Adot

  AbsoluteCoordinates(const Mat3& A_in, const Mat3& Adot_in) noexcept : A(A_in), Adot(Adot_in) {
    const Mat3 H = A.transpose() * Adot;
    w = 0.5 * Vec3(H(2, 1) - H(1, 2), H(0, 2) - H(2, 0), H(1, 0) - H(0, 1));
  }

  void translation(const Vec3& p, double* rows, int stride) const noexcept {
    for (int i = 0; i < 3; ++i) {
      double* row = rows + i * stride;
      for (int j = 0; j < 12; ++j) row[j] = 0.0;
      row[i] = 1.0, row[3 + i] = p.x(), row[6 + i] = p.y(), row[9 + i] = p.z();  // (7)
    }
  }
  Vec3 bias(const Vec3&, const Vec3& pdot) const noexcept { return 2.0 * (Adot * pdot); }  // (42)
  void rotation(double* rows, int stride) const noexcept {
    // w1 = (w.vdot - v.wdot)/2, w2 = (u.wdot - w.udot)/2, w3 = (v.udot - u.vdot)/2
    double* x = rows;
    double* y = rows + stride;
    double* z = rows + 2 * stride;
    for (int j = 0; j < 3; ++j) {
      x[j] = y[j] = z[j] = 0.0;
      x[3 + j] = 0.0, x[6 + j] = 0.5 * A(j, 2), x[9 + j] = -0.5 * A(j, 1);
      y[3 + j] = -0.5 * A(j, 2), y[6 + j] = 0.0, y[9 + j] = 0.5 * A(j, 0);
      z[3 + j] = 0.5 * A(j, 1), z[6 + j] = -0.5 * A(j, 0), z[9 + j] = 0.0;
    }
  }
};

/// upper += B^T MB for six rows at a time; columns to the left of the diagonal (rounded down to
/// four) are skipped.
void accumulate(const double* B, const double* MB, int rows, int nq, int stride,
                double* upper) noexcept {
  assert(rows % 3 == 0 && stride % 4 == 0 && nq < stride);
  int r = 0;
  for (; r + 2 < rows; r += 3) {
    const double* b0 = B + static_cast<std::ptrdiff_t>(r) * stride;
    const double* b1 = b0 + stride;
    const double* b2 = b1 + stride;
    const double* m0 = MB + static_cast<std::ptrdiff_t>(r) * stride;
    const double* m1 = m0 + stride;
    const double* m2 = m1 + stride;
    for (int i = 0; i < nq; ++i) {
      const double c0 = b0[i], c1 = b1[i], c2 = b2[i];
      double* out = upper + static_cast<std::ptrdiff_t>(i) * stride;
      for (int j = i / 4 * 4; j < stride; j += 4) {
        for (int l = j; l < j + 4; ++l) out[l] += c0 * m0[l] + c1 * m1[l] + c2 * m2[l];
      }
    }
  }
}

/// out[0..columns) += factor * in
inline void axpy(double factor, const double* in, int columns, double* out) noexcept {
  for (int j = 0; j < columns; ++j) out[j] += factor * in[j];
}

/// The rows of B of one node, with its bias in column nq; p its position in body axes, (5).
template <class Coordinates>
inline void rows_of_node(const Coordinates& coordinates, bool six, const double* X, int nm,
                         const Vec3& p, const Vec3& pdot, const double* ydot, int stride,
                         double* B) noexcept {
  constexpr int rigid = Coordinates::rigid;
  const int nq = rigid + nm;
  const Mat3& A = coordinates.A;
  coordinates.translation(p, B, stride);
  Vec3 bias = coordinates.bias(p, pdot);
  if (six) {
    const Mat3 At = A.transpose();
    for (int j = 0; j < rigid; ++j) {
      const Vec3 column = At * Vec3(B[j], B[stride + j], B[2 * stride + j]);
      for (int i = 0; i < 3; ++i) B[i * stride + j] = column(i);
    }
    for (int a = 0; a < nm; ++a) {
      // A^T A X, which is X for an orthonormal A.
      const Vec3 column = At * (A * Vec3(X[3 * a], X[3 * a + 1], X[3 * a + 2]));
      for (int i = 0; i < 3; ++i) B[i * stride + rigid + a] = column(i);
    }
    bias = At * bias;
    double* R = B + 3 * stride;
    const double* X_theta = X + 3 * nm;
    coordinates.rotation(R, stride);
    Vec3 rate = Vec3::Zero();
    for (int a = 0; a < nm; ++a) {
      for (int i = 0; i < 3; ++i) {
        R[i * stride + rigid + a] = X_theta[3 * a + i];
        rate(i) += ydot[a] * X_theta[3 * a + i];
      }
    }
    const Vec3 rotation_bias = coordinates.w.cross(rate);
    for (int i = 0; i < 3; ++i) {
      R[i * stride + nq] = rotation_bias(i);
      for (int j = nq + 1; j < stride; ++j) R[i * stride + j] = 0.0;
    }
  } else {
    for (int a = 0; a < nm; ++a) {
      const Vec3 column = A * Vec3(X[3 * a], X[3 * a + 1], X[3 * a + 2]);
      for (int i = 0; i < 3; ++i) B[i * stride + rigid + a] = column(i);
    }
  }
  for (int i = 0; i < 3; ++i) {
    B[i * stride + nq] = bias(i);
    for (int j = nq + 1; j < stride; ++j) B[i * stride + j] = 0.0;
  }
}

/// Writes X + e_j y^T h_j of a node to `moved` and adds its second-order displacement to p; returns
/// the acceleration due to modal rates, body axes.
inline Vec3 stiffen(const double* X, const double* h, int nm, const double* y, const double* ydot,
                    double* moved, Vec3& p) noexcept {
  Vec3 own = Vec3::Zero();
  for (int a = 0; a < nm; ++a) {
    Vec3 more = Vec3::Zero(), rate = Vec3::Zero();
    for (int b = 0; b < nm; ++b) {
      const Vec3 h_ab(h[0], h[1], h[2]);
      more += y[b] * h_ab;
      rate += ydot[b] * h_ab;
      h += 3;
    }
    for (int i = 0; i < 3; ++i) moved[3 * a + i] = X[3 * a + i] + more(i);
    p += 0.5 * y[a] * more;
    own += ydot[a] * rate;
  }
  return own;
}

/// Updates column a of `moved` and p for a rotating point; returns its acceleration.
inline Vec3 turn(const ProjectionData& data, const ProjectionData::TurningPoint& point, int nm,
                 const double* y, const double* ydot, double* moved, Vec3& p) noexcept {
  const Eigen::Index row = 3 * static_cast<Eigen::Index>(point.rotation);
  const Vec3& arm = point.arm;
  Vec3 theta = Vec3::Zero(), rate = Vec3::Zero();
  for (int a = 0; a < nm; ++a) {
    const Vec3 column = data.rotations.col(a).segment<3>(row);
    theta += y[a] * column;
    rate += ydot[a] * column;
  }
  assert(point.rotation >= 0 && row + 3 <= data.rotations.rows());
  const Vec3 turned = theta.cross(arm);
  for (int a = 0; a < nm; ++a) {
    const Vec3 column = data.rotations.col(a).segment<3>(row);
    const Vec3 more = 0.5 * (column.cross(turned) + theta.cross(column.cross(arm)));
    for (int i = 0; i < 3; ++i) moved[3 * a + i] += more(i);
  }
  p += 0.5 * theta.cross(turned);
  return rate.cross(rate.cross(arm));
}

/// upper += B^T M B, node by node.
inline void add_products(const ProjectionData& data, int nq, int stride, ProjectionWorkspace& work,
                         double* upper) noexcept {
  const bool six = data.six_dof();
  const int rows = six ? 6 : 3;
  const auto& mass = six ? data.M_6 : data.M_s;
  assert(mass.isCompressed() && mass.rows() == data.nodes() * (six ? 6 : 1));
  const auto* outer = mass.outerIndexPtr();
  const auto* inner = mass.innerIndexPtr();
  const double* value = mass.valuePtr();
  double* MB = work.MB.data();
  const int n = data.nodes();
  for (int k = 0; k < n; ++k) {
    std::fill_n(MB, rows * stride, 0.0);
    if (six) {
      for (int i = 0; i < 6; ++i) {
        for (int e = outer[6 * k + i]; e < outer[6 * k + i + 1]; ++e) {
          axpy(value[e], work.B.data() + static_cast<std::ptrdiff_t>(inner[e]) * stride, stride,
               MB + i * stride);
        }
      }
    } else {
      for (int e = outer[k]; e < outer[k + 1]; ++e) {
        axpy(value[e], work.B.data() + static_cast<std::ptrdiff_t>(inner[e]) * 3 * stride,
             3 * stride, MB);
      }
    }
    accumulate(work.B.data() + static_cast<std::ptrdiff_t>(k) * rows * stride, MB, rows, nq, stride,
               upper);
  }
}

template <class Coordinates>
void project(const ProjectionData& data, const Coordinates& coordinates, const double* y,
             const double* ydot, ProjectionWorkspace& work, MatX& M, VecX& Qv) noexcept {
  constexpr int rigid = Coordinates::rigid;
  const int n = data.nodes();
  const int nm = work.modes;
  const int nq = rigid + nm;
  const int stride = padded(nq + 1);
  const bool six = data.six_dof();
  const int rows = six ? 6 : 3;
  const bool stiffened = !work.h.empty();
  const bool bent = !work.moved.empty();
  const ProjectionData::TurningPoint* turning = data.turning.data();
  const ProjectionData::TurningPoint* const end = turning + data.turning.size();
  assert(((y && ydot) || nm == 0) && std::ssize(work.X) == n * rows * nm);
  assert(M.rows() == nq && M.cols() == nq && Qv.size() == nq && stride <= work.stride);
  assert(!stiffened || std::ssize(work.h) == n * 3 * nm * nm);
  FLOATFRAME_DEBUG(poison(M));
  FLOATFRAME_DEBUG(poison(Qv));

  for (int k = 0; k < n; ++k) {
    const double* X = work.X.data() + static_cast<std::ptrdiff_t>(k) * rows * nm;
    double* B = work.B.data() + static_cast<std::ptrdiff_t>(k) * rows * stride;
    Vec3 p = data.p.col(k);
    Vec3 pdot = Vec3::Zero(), own = Vec3::Zero();
    for (int a = 0; a < nm; ++a) p += y[a] * Vec3(X[3 * a], X[3 * a + 1], X[3 * a + 2]);  // (5)
    if (bent) {
      double* moved = work.moved.data();
      std::copy_n(X, rows * nm, moved);
      if (stiffened)
        own = stiffen(X, work.h.data() + static_cast<std::ptrdiff_t>(k) * 3 * nm * nm, nm, y, ydot,
                      moved, p);
      for (; turning != end && turning->point == k; ++turning)
        own += turn(data, *turning, nm, y, ydot, moved, p);
      X = moved;
    }
    for (int a = 0; a < nm; ++a) pdot += ydot[a] * Vec3(X[3 * a], X[3 * a + 1], X[3 * a + 2]);
    rows_of_node(coordinates, six, X, nm, p, pdot, ydot, stride, B);
    if (!bent) continue;
    const Vec3 bias =
        six ? Vec3(coordinates.A.transpose() * (coordinates.A * own)) : Vec3(coordinates.A * own);
    for (int i = 0; i < 3; ++i) B[i * stride + nq] += bias(i);
  }

  assert(turning == end);  // ascending, so that all have been met
  double* upper = work.upper.data();
  std::fill_n(upper, static_cast<std::ptrdiff_t>(nq) * stride, 0.0);
  add_products(data, nq, stride, work, upper);
  for (int i = 0; i < nq; ++i) {
    const double* row = upper + static_cast<std::ptrdiff_t>(i) * stride;
    for (int j = i; j < nq; ++j) M(i, j) = M(j, i) = row[j];  // (13)
    Qv(i) = -row[nq];                                         // (15)
  }
}

}  // namespace

ProjectionWorkspace::ProjectionWorkspace(const ProjectionData& data, bool stiffening)
    : modes(static_cast<int>(data.X.cols())), stride(padded(13 + modes)) {
  const std::size_t n = data.nodes();
  const std::size_t rows = data.six_dof() ? 6 : 3;
  const std::size_t nm = modes;
  const std::size_t width = stride;
  assert(data.X.rows() == 3 * data.nodes());
  assert(!data.six_dof() || (data.X_theta.rows() == data.X.rows() && data.X_theta.cols() == modes));
  assert(!stiffening || data.h.rows() == modes * data.X.rows());
  B.assign(n * rows * width, 0.0);
  MB.assign(rows * width, 0.0);
  upper.assign((12 + nm) * width, 0.0);
  X.resize(n * rows * nm);
  for (std::size_t k = 0; k < n; ++k) {
    double* x = X.data() + k * rows * nm;
    for (int a = 0; a < modes; ++a) {
      for (int i = 0; i < 3; ++i) {
        *x++ = data.X(static_cast<Eigen::Index>(3 * k) + i, a);
      }
    }
    if (rows == 6) {
      for (int a = 0; a < modes; ++a) {
        for (int i = 0; i < 3; ++i) *x++ = data.X_theta(static_cast<Eigen::Index>(3 * k) + i, a);
      }
    }
  }
  if (data.twist) twist.emplace(*data.twist);
  if (stiffening || !data.turning.empty()) moved.resize(rows * nm);
  if (!stiffening) return;
  h.reserve(n * 3 * nm * nm);
  for (Eigen::Index k = 0; k < data.nodes(); ++k)
    for (int a = 0; a < modes; ++a)
      for (int b = 0; b < modes; ++b)
        for (int j = 0; j < 3; ++j) h.push_back(data.h(modes * (3 * k + j) + a, b));
}

ProjectionWorkspace::Twist::Twist(const SecondOrder& of_beams) {
  const int nm = static_cast<int>(of_beams.S2[0].rows());
  assert(of_beams.S2[0].cols() == nm && of_beams.S2i[0][0].rows() == nm);
  none = PreprocessingData(InertiaInvariants::zero(nm));
  second_order = StiffeningData(none, of_beams);
  work = PreprocessingWorkspace(nm);
  M_relative = MatX::Zero(6 + nm, 6 + nm);
  M_absolute = MatX::Zero(12 + nm, 12 + nm);
  Qv_relative = VecX::Zero(6 + nm);
  Qv_absolute = VecX::Zero(12 + nm);
}

void relative_projection(const ProjectionData& data, const Vec3& r0, const Mat3& A,
                         const Vec3& omega, const double* y, const double* ydot,
                         ProjectionWorkspace& work, MatX& M, VecX& Qv) noexcept {
  assert(is_rotation(A));
  project(data, RelativeCoordinates(r0, A, omega), y, ydot, work, M, Qv);
  if (!work.twist) return;
  ProjectionWorkspace::Twist& t = *work.twist;
  relative_stiffened(t.none, t.second_order, r0, A, omega, y, ydot, t.work, t.M_relative,
                     t.Qv_relative);
  M += t.M_relative;
  Qv += t.Qv_relative;
}

void absolute_projection(const ProjectionData& data, const Mat3& A, const Mat3& Adot,
                         const double* y, const double* ydot, ProjectionWorkspace& work, MatX& M,
                         VecX& Qv) noexcept {
  project(data, AbsoluteCoordinates(A, Adot), y, ydot, work, M, Qv);
  if (!work.twist) return;
  ProjectionWorkspace::Twist& t = *work.twist;
  absolute_stiffened(t.none, t.second_order, A, Adot, y, ydot, t.work, t.M_absolute, t.Qv_absolute);
  M += t.M_absolute;
  Qv += t.Qv_absolute;
}

}  // namespace floatframe
