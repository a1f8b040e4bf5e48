// Masses of scalar points, and CONM1 and CMASS1, 2: matrices of mass of nodes. Those of a rigid
// body with the mass m, its centre at c from the node and J about the node are
//   [ m 1          -m skew(c) ]
//   [ m skew(c)     J         ]
// Others, such as a mass in one direction only, have no meaning in a part that moves freely.
#include <cmath>

#include "floatframe/decks/nastran/nastran_build.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {

namespace {

Mat6 in_basic_axes(NastranBuild& build, const NastranMassMatrix& m, int node) {
  Mat6 T = Mat6::Zero();
  T.topLeftCorner<3, 3>() = T.bottomRightCorner<3, 3>() =
      m.system < 0 ? build.axes(node) : build.axes_of_system(m.system, m.at, node);
  return T * m.M * T.transpose();
}

/// `sum`: of all cards of a node, in basic axes; the first gives its name.
bool rigid_body(NastranBuild& build, const NastranMassMatrix& sum, NastranMass& out) {
  const Mat3 A = sum.M.topLeftCorner<3, 3>(), B = sum.M.topRightCorner<3, 3>();
  const double m = A.trace() / 3.0, size = std::abs(m) + A.norm();
  const Vec3 moment(0.5 * (B(1, 2) - B(2, 1)), 0.5 * (B(2, 0) - B(0, 2)),
                    0.5 * (B(0, 1) - B(1, 0)));
  if ((A - m * Mat3::Identity()).norm() > 1e-6 * size)
    return build.fail(
        ErrorCode::unsupported, sum,
        "node {} has the masses {:g}, {:g} and {:g} along x, y and z; a part that moves freely has "
        "one mass in all directions (CONM2)",
        sum.node, A(0, 0), A(1, 1), A(2, 2));
  if ((B + skew(moment)).norm() > 1e-6 * B.norm() || (m == 0.0 && B.norm() > 0.0) || m < 0.0)
    return build.fail(ErrorCode::unsupported, sum,
                      "the mass matrix of node {} is not that of a rigid body; give CONM2",
                      sum.node);
  NastranEntity& entity = out;
  entity = sum;
  out.node = sum.node;
  out.mass = m;
  if (m > 0.0) out.offset = moment / m;
  const Mat3 S = skew(out.offset), about_node = sum.M.bottomRightCorner<3, 3>();
  out.J = about_node + m * S * S;  // about the centre
  if (out.J.norm() < 1e-9 * about_node.norm()) out.J.setZero();
  return true;
}

}  // namespace

std::vector<NastranMass> nastran_rigid_masses(NastranBuild& build) {
  std::map<int, NastranMassMatrix> sums;
  const NastranContent& c = build.content;
  for (const NastranMassMatrix& given : c.mass_matrices) {
    NastranMassMatrix m = given;
    const int node = build.node(m.node, m);
    if (node < 0) continue;
    if (m.property > 0) {
      const auto* const p = build.property(c.pmass, m.property, "PMASS", m);
      if (p == nullptr) continue;
      m.M *= p->value;
    }
    m.M = in_basic_axes(build, m, node);
    const auto [it, fresh] = sums.try_emplace(node, m);
    if (!fresh) it->second.M += m.M;
  }
  std::vector<NastranMass> out;
  for (const auto& [node, sum] : sums) {
    NastranMass mass;
    if (rigid_body(build, sum, mass)) out.push_back(std::move(mass));
  }
  return out;
}

void check_nastran_scalar_masses(NastranBuild& build) {
  const NastranContent& c = build.content;
  NastranCount held;
  for (const NastranScalarElement& m : c.scalar_masses) {
    double mass = m.value.value_or(1.0);
    if (m.property > 0) {
      const auto* const p = build.property(c.pmass, m.property, "PMASS", m);
      if (p == nullptr) continue;
      mass *= p->value;
    }
    int point = 0;
    for (const int id : m.nodes) {
      if (id == 0) continue;
      if (!c.scalar_points.contains(id)) {
        build.error(ErrorCode::missing, m,
                    "the component of node {} is missing, expected one of 1 to 6", id);
        mass = 0.0;
      } else if (point == 0 && !build.scalars.held(id)) {
        point = id;
      }
    }
    if (mass == 0.0) continue;
    if (point == 0) {
      held.add(m.at);
      continue;
    }
    build.error(
        ErrorCode::unsupported, m,
        "the mass {:g} of scalar point {} has no place, so it has none in the inertia of a part "
        "that moves; make the point a node (GRID) where the mass is, with CONM2, on CELAS2 in one "
        "component and tied to the part by MPC in the others",
        mass, point);
  }
  build.note(held, "masses of scalar points that are held (SPC) or of the ground are left out");
}

// The default of Nastran is lumped mass: at the nodes without rotary inertia, except bars about
// their own axis, unless PARAM COUPMASS is positive.
void nastran_mass_forms(NastranBuild& build) {
  if (build.content.properties.empty() || build.content.coupled_mass) return;
  for (FeElement& e : build.model.elements) e.mass_form = MassForm::lumped_without_rotation;
}

}  // namespace floatframe
