#include "floatframe/start/unique_loads.hpp"

#include "floatframe/loops/run_error.hpp"

namespace floatframe {

namespace {

/// Of multipliers of length 1 that balance each other, relative.
constexpr double unique_up_to = 1e-7;

/// What is not unique of a load; empty: nothing.
std::string open_part(const Model& model, const ConstraintAnalysis& analysis, const MatX& balanced,
                      const LoadPort& port, const Vec3& e) {
  MatX force = MatX::Zero(3, balanced.cols()), torque = force;
  for (std::size_t k = 0; k < analysis.parts().size(); ++k) {
    const ConstraintPart& p = analysis.parts()[k];
    if (p.counted_by() != port.joint) continue;
    for (int r = 0; r < p.rows(); ++r) {
      const WrenchRow& g = analysis.row(k, r).gradient;
      force -= g.b.F * balanced.row(analysis.row_of(k) + r);
      torque -= g.b.T * balanced.row(analysis.row_of(k) + r);
    }
  }
  const Mat3 across = Mat3::Identity() - e * e.transpose();
  const double length = model.bodies[model.joints[port.joint].child].length;
  if (port.across > 0.0 && (across * force).norm() > unique_up_to) return "force across the axis";
  if (port.along > 0.0 && (e.transpose() * force).norm() > unique_up_to)
    return "force along the axis";
  if (port.across > 0.0 && port.length > 0.0 && (across * torque).norm() > unique_up_to * length)
    return "moment across the axis";
  return "";
}

}  // namespace

void require_unique_loads(RelativeFormulation& tree, const VecX& q) {
  const LoadReaders& readers = tree.load_readers();
  if (readers.count() == 0) return;
  const Model& model = tree.model();
  const ConstraintAnalysis analysis(tree, q);
  const MatX balanced = analysis.balanced();
  if (balanced.cols() == 0) return;
  kinematics_at(tree, 0.0, q, VecX::Zero(tree.velocities()));
  for (int i = 0; i < readers.count(); ++i) {
    const Element& element = model.elements[readers.element(i)];
    const Joint& joint = model.joints[element.load.joint];
    const Vec3 e = tree.marker(joint.frame_F).R.col(2);
    const std::string open = open_part(model, analysis, balanced, element.load, e);
    if (open.empty()) continue;
    throw RunError(ErrorCode::unsupported,
                   element_name(element) + " needs the reaction of joint '" + joint.name +
                       "', whose " + open +
                       " is not unique, since constraints are redundant; let another joint of the "
                       "loop, a spherical or cylindrical one, leave that free, or give the force "
                       "as its 'normal'");
  }
}

}  // namespace floatframe
