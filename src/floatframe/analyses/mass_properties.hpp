#pragma once
// Mass properties of a whole model at the start of a run: mass, centre of mass, inertia about it.
//
// Body i, with its deformation at the start, has the mass m_i, its centre of mass at c_i and the
// planar inertia tensor P_i about that point. The whole model has
//   m = sum m_i,   c = sum m_i c_i / m,                                                       (1)
//   P = sum P_i + m_i (c_i - c)(c_i - c)^T,   J = tr(P) I - P.                                (2)
// m_i, c_i and P_i are the dynamic ones: from the mass matrix for the velocity v of the origin of
// the body frame and the angular velocity omega, by the inertia method of the options,
//       [ skew(s_i)         J_i     ]    J_i: inertia tensor about it
// With preprocessing these are m_bar (29) and P_bar (33) of the paper. Symbols: p_WC position of a
// centre of mass, all in world axes, SI units; the off-diagonal terms of J are the negative
// products of inertia. Rods, springs and roads have no mass. Accelerations are not needed.
#include <string>
#include <vector>

#include "floatframe/loops/start_report.hpp"
#include "floatframe/math/types.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/stepping/stepping.hpp"

namespace floatframe {

struct BodyMass {
  std::string name;
  double mass = 0.0;            ///< [kg]
  Vec3 centre = Vec3::Zero();   ///< centre of mass, world [m]
  Mat3 inertia = Mat3::Zero();  ///< about it, world axes [kg m2]
};

struct ModelMass {
  double time = 0.0;                      ///< time of the configuration [s]
  double mass = 0.0;                      ///< [kg]
  Vec3 centre = Vec3::Zero();             ///< centre of mass, world [m]
  Mat3 inertia = Mat3::Zero();            ///< about it, world axes [kg m2]
  Vec3 principal_moments = Vec3::Zero();  ///< ascending [kg m2]
  /// One per column, right-handed; the largest component of the first two is positive.
  Mat3 principal_axes = Mat3::Identity();
  std::vector<BodyMass> bodies;  ///< in the order of the model
  StartReport start;             ///< report on the start values
};

/// At the start given by the options, as `linearize`. Throws InputError for invalid options, for a
/// state of another model and for a model without mass, RunError if the start cannot be found.
ModelMass mass_properties(const Model& model, const SimulationOptions& options = {});

}  // namespace floatframe
