// Load time of the absolute formulation.
#include "floatframe/formulation/absolute.hpp"

#include <numeric>

#include "floatframe/formulation/equations_of_motion.hpp"

namespace floatframe {

static_assert(EquationsOfMotion<AbsoluteFormulation>);

namespace {

std::vector<int> all_joints(const Model& model) {
  std::vector<int> joints(model.joints.size());
  std::iota(joints.begin(), joints.end(), 0);
  return joints;
}

/// Of the undeformed bodies at rest.
std::vector<BodyTerms> terms_at_rest(const AbsoluteKinematics& kinematics, InertiaMethod method) {
  std::vector<BodyTerms> terms(kinematics.bodies().size());
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const AbsoluteBody& b = kinematics.bodies()[i];
    BodyTerms& t = terms[i];
    t.inertia = BodyInertia(kinematics.model().bodies[i], method);
    t.M = MatX::Zero(12 + b.nm, 12 + b.nm);
    t.Qv = VecX::Zero(12 + b.nm);
    t.inertia.absolute(b.A, b.Adot, b.y.data(), b.yd.data(), t.M, t.Qv);
  }
  return terms;
}

}  // namespace

AbsoluteFormulation::AbsoluteFormulation(const Model& model, InertiaMethod method)
    : Formulation(model, all_joints(model)),
      kinematics_(model_, constraint_set_),
      terms_(terms_at_rest(kinematics_, method)),
      tangent_(kinematics_, constraint_set_, element_set_, terms_) {
  omega2_ = work_ = VecX::Zero(velocities());
  const double* accelerations = kinematics_.accelerations().data();
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const AbsoluteBody& b = kinematics_.bodies()[i];
    omega2_.segment(b.offset + 12, b.nm) =
        terms_[i].inertia.own_frequencies_squared(model_.bodies[i].data->K);
    if (terms_[i].M.isZero(0.0)) omega2_.segment<12>(b.offset).setConstant(no_inertia);
    show_body(b.A, b.w_WB, b.y, b.yd, accelerations + b.offset + 12);
  }
  for (const AbsoluteMarker& m : kinematics_.markers()) show_marker(m.s, m);
  connect_elements();
}

void AbsoluteFormulation::start_from(RelativeFormulation& tree, const VecX& tree_q,
                                     const VecX& tree_v, VecX& q, VecX& v) {
  q = v = VecX::Zero(velocities());
  assert(tree_q.size() == tree.configurations() && tree_v.size() == tree.velocities());
  tree.positions(0.0, tree_q);
  tree.velocities(tree_v);
  tree.forces();
  const SystemMotion& motion = tree.motion();
  element_set_.set_angles(tree.spring_angles());
  for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
    const AbsoluteBody& b = kinematics_.bodies()[i];
    const BodyKinematics& from = motion.bodies[i];
    const Mat3 Adot = skew(from.w_WB) * from.R_WB;
    q.segment<3>(b.offset) = from.p_WB;
    v.segment<3>(b.offset) = from.v_WB;
    for (int c = 0; c < 3; ++c) {
      q.segment<3>(b.axis(c)) = from.R_WB.col(c);
      v.segment<3>(b.axis(c)) = Adot.col(c);
    }
    q.segment(b.offset + 12, b.nm) = from.y;
    v.segment(b.offset + 12, b.nm) = from.yd;
    for (int p = 0; p < b.points; ++p) {
      const int marker = b.point_marker[p];
      q.segment<3>(b.point(p)) = motion.place(marker);
      v.segment<3>(b.point(p)) = motion.marker(marker).v;
    }
  }
}

}  // namespace floatframe
