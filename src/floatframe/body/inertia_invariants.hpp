#pragma once
// The 16 constant inertia integrals of a flexible body, paper equations (19), (22)-(24).
//   m        = int dm                                   mass [kg]
//   m_u      = int r_u dm                    (3)        static moment, undeformed [kg m]
//   P_u(i,j) = int r_ui r_uj dm              (3x3)      planar inertia tensor, undeformed [kg m2]
//   S        = int X dm                      (3 x nm)
//   Si[i]    = int r_ui X dm                 (3 x nm)   row k is int r_ui X_k dm
//   Sij[i][j]= int X_i^T X_j dm              (nm x nm)  Sij[j][i] = Sij[i][j]^T
// r_u: undeformed position, X: mode shapes, both in the body frame. A rigid body has nm = 0.
#include <array>

#include "floatframe/math/types.hpp"

namespace floatframe {

struct InertiaInvariants {
  double m = 0.0;
  Vec3 m_u = Vec3::Zero();
  Mat3 P_u = Mat3::Zero();
  Mat3X S;
  std::array<Mat3X, 3> Si;
  std::array<std::array<MatX, 3>, 3> Sij;

  int modes() const noexcept { return static_cast<int>(S.cols()); }

  /// All integrals zero, for nm modes.
  static InertiaInvariants zero(int nm) {
    InertiaInvariants v;
    v.S = Mat3X::Zero(3, nm);
    for (int i = 0; i < 3; ++i) {
      v.Si[i] = Mat3X::Zero(3, nm);
      for (int j = 0; j < 3; ++j) v.Sij[i][j] = MatX::Zero(nm, nm);
    }
    return v;
  }

  /// Rigid body: mass [kg], centre of mass in the body frame [m], inertia tensor about it in body
  /// axes [kg m2].
  static InertiaInvariants rigid(double mass, const Vec3& p_BC, const Mat3& J_C) {
    InertiaInvariants v = zero(0);
    v.m = mass;
    v.m_u = mass * p_BC;
    v.P_u = 0.5 * J_C.trace() * Mat3::Identity() - J_C + mass * p_BC * p_BC.transpose();  // (21)
    return v;
  }

  /// Centre of mass of the undeformed body [m].
  Vec3 centre_of_mass() const { return m > 0.0 ? Vec3(m_u / m) : Vec3::Zero().eval(); }
  /// Inertia tensor of the undeformed body about the body-frame origin [kg m2].  J = tr(P) I - P
  /// (21)
  Mat3 inertia_about_origin() const { return P_u.trace() * Mat3::Identity() - P_u; }
  /// Inertia tensor of the undeformed body about its centre of mass [kg m2].
  Mat3 inertia_about_centre() const {
    const Vec3 c = centre_of_mass();
    const Mat3 P_c = P_u - m * c * c.transpose();
    return P_c.trace() * Mat3::Identity() - P_c;
  }
};

}  // namespace floatframe
