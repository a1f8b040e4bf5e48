#pragma once
// Inertia terms by preprocessing, paper equations (25)-(63): the mass matrix M and the
// velocity-dependent inertia force Qv of one body from its 16 constant integrals. Cost does not
// depend on the number of finite-element nodes.
//
//   deformed body   m_bar = m_u + S y                                                    (29)
//                   P_bar_ij = P_u_ij + S^j_(i) y + (S_d^i)_(j) y                        (33)
//                   (S_d^i)_(j) = S^i_(j) + y^T S^ij                                     (38)
//   absolute        qdot = (r0dot, udot, vdot, wdot, ydot), (25)-(45); A = [u v w] need not be
//                   orthonormal:
//                     M_ff = sum_ij (A^T A)_ij S^ij,  Qv_f = -2 sum_ij (A^T Adot)_ij S^ij ydot
//   relative        qdot = (sdot, omega, ydot), (46)-(63) in the cheaper local forms F_bar, F_d_bar
//                   of theory section 6; sdot is the velocity of the body's material point that
//                   passes through the origin from which r0 is measured
//
// With second-order displacements (SecondOrder: of rotating points, and with geometric stiffening
// of foreshortening) S and S^i depend on y, here and in all equations above:
//   S(y) = S + y^T S2,   S^i_(j)(y) = S^i_(j) + y^T S2i_ij
//   m_bar = m_u + (S + S(y)) y / 2,   P_bar likewise,   so d(m_bar) = S(y) dy
// and modal rates cause the additional acceleration e_j ydot^T h_j ydot, with the forces
//   -q, q_j = ydot^T S2_j ydot, and the moments -Q, Q_ij = ydot^T S2i_ij ydot.
// This Qv is exactly consistent with this M: energy and momenta are conserved. Centrifugal
// stiffening is in S2i: -omega x (omega x r) of S_d^i(y) in Qv.
//
// Convention of the relative terms: sddot is the acceleration of the *material* point at the
// origin,
//   sddot = r0ddot - omegadot x r0 - omega x (omega x r0).
// World axes for r0, A, omega, sdot; body axes for the integrals. SI units. All functions of step
// time: no heap, noexcept. Cost for k = nm: about 24 k^2 + 120 k flops.
#include "floatframe/body/inertia_invariants.hpp"
#include "floatframe/body/second_order.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

/// The integrals laid out for speed. Row 3i+j of the nine-row arrays belongs to the pair (i, j).
struct PreprocessingData {
  double m = 0.0;
  Vec3 m_u = Vec3::Zero();
  Mat3 P_u = Mat3::Zero();
  Mat3X S;  ///< 3 x nm
  MatX Si;  ///< 9 x nm: row 3i+j is row j of S^i
  /// 9nm x nm: row 9a+3i+j, column b: S^ij(b, a), so that Sij y stacks the rows y^T S^ij.
  MatX Sij;
  /// 6 x nm^2: S^11, S^22, S^33, S^12+S^21, S^13+S^31, S^23+S^32, entry (a, b) in column a+nm b.
  MatX Sij_sum;
  MatX M_ff;  ///< nm x nm: S^11 + S^22 + S^33, (40), (54)
  /// The same with the modes contiguous, `stride` numbers per row, zero beyond the last mode: the
  /// layout that the relative terms process in whole SIMD lanes.
  struct ByModes {
    int stride = 0;
    VecX S;         ///< 3 rows
    VecX Si;        ///< 9 rows: row 3i+j is row j of S^i
    MatX Sij;       ///< 9 rows in each column b: row 3i+j holds S^ij(b, a)
    MatX Sij_skew;  ///< 3 rows in each column b: S^12-S^21, S^13-S^31, S^23-S^32, entries (a, b)
  } by_modes;

  PreprocessingData() = default;
  explicit PreprocessingData(const InertiaInvariants& invariants);
  int modes() const noexcept { return static_cast<int>(S.cols()); }
};

/// Terms of the second-order displacements.
struct StiffeningData {
  MatX S2;     ///< 3nm x nm: row 3a+j, column b: S2_j(b, a)
  MatX S_ij;   ///< as PreprocessingData::Sij, of S^ij + S2i_ij
  MatX pairs;  ///< 12 x nm (nm+1)/2: S2_j, then S2i_ij in row 3+3i+j, of the pairs of modes a <= b
  /// As in PreprocessingData::ByModes.
  MatX S2_by_modes;    ///< 3 rows in each column b
  MatX S_ij_by_modes;  ///< 9 rows in each column b
  // Scratch.
  Mat3X S;         ///< S(y)
  VecX S_by_mode;  ///< 3 rows

  StiffeningData() = default;
  StiffeningData(const PreprocessingData& data, const SecondOrder& second_order);
};

/// q and Q: second-order forces due to modal rates.
struct RateForces {
  Vec3 q;
  Mat3 Q;  ///< column i: Q_ij
};
RateForces rate_forces(const StiffeningData& stiffening, int nm, const double* ydot) noexcept;

/// out += weight K_G for the acceleration a + G r of the material points in body axes, minus
/// gravity: the derivative of their inertia forces with respect to the amplitudes through h.
void add_stiffness(const SecondOrder& second_order, const Vec3& a, const Mat3& G, double weight,
                   MatX& out) noexcept;

/// Integrals over the deformed body, body axes.
struct DeformedInvariants {
  Vec3 m_bar = Vec3::Zero();  ///< static moment [kg m]
  Mat3 P_bar = Mat3::Zero();  ///< planar inertia tensor [kg m2]
  MatX S_d;                   ///< 9 x nm: row 3i+j is row j of S_d^i
};

struct PreprocessingWorkspace {
  DeformedInvariants deformed;
  VecX S_dot;  ///< 9nm: rows ydot^T S^ij
  VecX rows;   ///< 15 rows of `ByModes::stride` numbers
  PreprocessingWorkspace() = default;
  explicit PreprocessingWorkspace(int modes)
      : S_dot(VecX::Zero(9 * modes)), rows(VecX::Zero(15 * ((modes + 3) & ~3))) {
    deformed.S_d = MatX::Zero(9, modes);
  }
};

/// (29), (33), (38).
void deform(const PreprocessingData& data, const double* y, DeformedInvariants& deformed) noexcept;

/// M is (6+nm)^2, both halves written; Qv is 6+nm.
void relative_preprocessing(const PreprocessingData& data, const Vec3& r0, const Mat3& A,
                            const Vec3& omega, const double* y, const double* ydot,
                            PreprocessingWorkspace& work, MatX& M, VecX& Qv) noexcept;

/// M is (12+nm)^2, both halves written; Qv is 12+nm. Exact for any A and Adot.
void absolute_preprocessing(const PreprocessingData& data, const Mat3& A, const Mat3& Adot,
                            const double* y, const double* ydot, PreprocessingWorkspace& work,
                            MatX& M, VecX& Qv) noexcept;

/// The same with second-order displacements.
void relative_stiffened(const PreprocessingData& data, StiffeningData& stiffening, const Vec3& r0,
                        const Mat3& A, const Vec3& omega, const double* y, const double* ydot,
                        PreprocessingWorkspace& work, MatX& M, VecX& Qv) noexcept;
void absolute_stiffened(const PreprocessingData& data, StiffeningData& stiffening, const Mat3& A,
                        const Mat3& Adot, const double* y, const double* ydot,
                        PreprocessingWorkspace& work, MatX& M, VecX& Qv) noexcept;

}  // namespace floatframe
