#pragma once
// Inertia terms by projection of the finite-element mass matrix, paper equations (12)-(15):
//   M = B*^T M* B*,   Qv = -B*^T M* Bdot* qdot,
// where B* stacks the velocity maps of the finite-element nodes, rdot = B qdot of a node at r. Two
// forms of M*:
//
//   isoparametric   three rows per node, M* = M_s (x) I_3, the same in every frame
//     absolute      B = [I  r1 I  r2 I  r3 I  A X]                                         (7)
//                   Bdot qdot = 2 Adot X ydot                                              (42)
//     relative      B = [I  -skew(r)  A X]                                                 (11)
//                   Bdot qdot = omega x (omega x r) + 2 omega x (A X ydot)
//   six_dof         six rows per node in body axes, (A^T rdot, A^T omega + X_theta ydot), with the
//                   constant M* of the beams. Its rotations do not represent the field of
//                   centripetal accelerations exactly (theory, section 7).
//
// With geometric stiffening a node is at p + X y + 1/2 sum_j e_j y^T h_j y (body/second_order.hpp):
// X + e_j y^T h_j replaces X, and A e_j ydot^T h_j ydot is added to Bdot qdot. Nothing is
// neglected: M is that of these displacements, including its modal block.
//
// A point on a rotating arm (ProjectionData::turning) always has the additional displacement 1/2
// theta x (theta x arm), theta = Theta y: column a of X gets 1/2 (theta_a x (theta x arm) + theta x
// (theta_a x arm)), and Bdot qdot A thetadot x (thetadot x arm). ProjectionData::twist adds the
// terms of S2 and S2i in preprocessing.hpp through its integrals.
//
// (r1, r2, r3) is the deformed position of the node in body axes. The relative terms use the
// material-point acceleration of s, as preprocessing.hpp. With nm = 0 the body is rigid. Cost is
// linear in the number of nodes n: about 3 n nq^2 multiplications, nq = 6 + nm or 12 + nm. Step
// time: no heap, noexcept.
#include <optional>
#include <vector>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

struct ProjectionWorkspace {
  int modes = 0;
  int stride = 0;          ///< columns stored: nq, one for Bdot qdot, padded to a multiple of four
  std::vector<double> B;   ///< rows of all nodes, row major, last used column Bdot qdot
  std::vector<double> MB;  ///< six rows of M* B
  std::vector<double> upper;  ///< nq rows of B^T M* [B, Bdot qdot]
  std::vector<double> X;      ///< per node 3 x nm column major (six_dof: then 3 x nm of rotations)
  std::vector<double> h;      ///< per node, mode and mode 3 numbers; empty: no stiffening
  std::vector<double> moved;  ///< X of a node with its second order
  /// The terms of ProjectionData::twist.
  struct Twist {
    PreprocessingData none;  ///< all integrals zero
    StiffeningData second_order;
    PreprocessingWorkspace work;
    MatX M_relative, M_absolute;
    VecX Qv_relative, Qv_absolute;
    explicit Twist(const SecondOrder& of_beams);
  };
  std::optional<Twist> twist;

  ProjectionWorkspace() = default;
  /// Large enough for both coordinate sets. `stiffening`: with the h of the data.
  explicit ProjectionWorkspace(const ProjectionData& data, bool stiffening = false);
};

/// M is (6+nm)^2, both halves written; Qv is 6+nm.
void relative_projection(const ProjectionData& data, const Vec3& r0, const Mat3& A,
                         const Vec3& omega, const double* y, const double* ydot,
                         ProjectionWorkspace& work, MatX& M, VecX& Qv) noexcept;

/// M is (12+nm)^2, both halves written; Qv is 12+nm.
void absolute_projection(const ProjectionData& data, const Mat3& A, const Mat3& Adot,
                         const double* y, const double* ydot, ProjectionWorkspace& work, MatX& M,
                         VecX& Qv) noexcept;

}  // namespace floatframe
