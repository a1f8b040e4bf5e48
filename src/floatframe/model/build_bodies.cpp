// Bodies, rigid and flexible, and the data that depend on their markers.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "floatframe/body/check_invariants.hpp"
#include "floatframe/body/mirrored.hpp"
#include "floatframe/body/modal_mass.hpp"
#include "floatframe/body/with_modes.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/model_builder.hpp"

namespace floatframe {

namespace {

/// Twists at the origin of the body, in its axes, that a joint to the ground allows.
Mat6X rigid_motions(const Joint& joint, const Body& body, const Marker& M) {
  JointMotion motion;
  const double drawn[6] = {};
  double q[7] = {};
  joint_configuration(joint.type, drawn, q);
  joint_motion(joint.type, {Vec3::UnitZ(), joint.axis_2}, q, motion);
  const Vec3 p_BM = M.node < 0 ? M.X_NM.p : Vec3(body.data->nodes[M.node].p + M.X_NM.p);
  Mat6X free = motion.H.leftCols(joint_velocities(joint.type));
  for (Eigen::Index k = 0; k < free.cols(); ++k) {
    const Vec3 w = M.X_NM.R * free.col(k).tail<3>();
    free.col(k).head<3>() = M.X_NM.R * free.col(k).head<3>() - w.cross(p_BM);
    free.col(k).tail<3>() = w;
  }
  return free;
}

/// For modes without inertia: static modes that rotate the end of a bar about its axis.
const char* remedy(const BodyDescription& body) {
  const auto* bars = std::get_if<FlexibleDescription>(&body.kind);
  const bool turns = bars && !bars->section_inertia && !bars->analytic && !bars->basis &&
                     std::any_of(bars->interfaces.begin(), bars->interfaces.end(),
                                 [](const NodeDofs& dof) { return (dof.mask & 56u) != 0; });
  if (!turns) return " or more elements";
  if (bars->mass_model == MassModel::isoparametric)
    return ", more elements, or mass_model: hermite with section_inertia: true (without it turns "
           "of bars about their axes have no inertia)";
  return ", more elements, or section_inertia: true (without it turns of bars about their axes "
         "have no inertia)";
}

}  // namespace

void ModelBuilder::stiffening(const BodyDescription& b, Body& body) {
  if (b.geometric_stiffening.value_or(false) && std::holds_alternative<RigidDescription>(b.kind))
    errors.add(ErrorCode::wrong_value, b.origin.of("geometric_stiffening"),
               "bodies." + b.name +
                   ".geometric_stiffening: found true on a rigid body, expected it on a flexible "
                   "one (or false)");
  const std::optional<bool> given =
      b.geometric_stiffening ? b.geometric_stiffening : d.simulation.geometric_stiffening;
  body.geometric_stiffening = body.modes() > 0 && given.value_or(false);
  body.stiffening_given = given.has_value();
  if (!body.geometric_stiffening || body.data->second_order) return;
  errors.add(ErrorCode::contradiction,
             b.geometric_stiffening ? b.origin.of("geometric_stiffening")
                                    : d.simulation.origin.of("geometric_stiffening"),
             "bodies." + b.name +
                 ".geometric_stiffening: found true, but the displacements of second order of its "
                 "modes are not known, expected false for this body (or a part of bars or a "
                 "reduction that computes them)");
}

void ModelBuilder::bodies(const ReduceBody& reduce) {
  for (const BodyDescription& b : d.bodies) {
    Body body;
    body.name = b.name;
    body.X_WB = b.X_WB;
    if (const auto* rigid = std::get_if<RigidDescription>(&b.kind)) {
      FlexibleBody data;
      data.invariants = InertiaInvariants::rigid(rigid->mass, rigid->p_BC, rigid->J_C);
      data.K = data.D = MatX::Zero(0, 0);
      data.shape = rigid->shape;
      body.data = std::make_shared<const FlexibleBody>(std::move(data));
    } else if (const auto* given = std::get_if<FlexibleBody>(&b.kind)) {
      if (given->modes() > 0)
        for (const InvariantError& f : check_invariants(*given, InvariantSource::parameters))
          errors.add(ErrorCode::wrong_value, b.origin.of("flexible"),
                     "bodies." + b.name + ": " + f.quantity + ": " + f.sentence);
      body.data = std::make_shared<const FlexibleBody>(
          b.mirror == Mat3::Identity() ? *given : mirrored(*given, b.mirror));
    } else {
      const bool stiffens =
          b.geometric_stiffening.value_or(d.simulation.geometric_stiffening.value_or(false));
      body.data = reduce(b, stiffens, errors);
    }
    if (!body.data) body.data = std::make_shared<const FlexibleBody>();
    if (b.rigid) body.data = std::make_shared<const FlexibleBody>(with_modes(*body.data, {}));
    stiffening(b, body);
    model.bodies.push_back(std::move(body));
  }
}

void ModelBuilder::modal_masses() {
  // Of the joints of a body to the ground the first with the fewest degrees of freedom.
  std::vector<const Joint*> on_ground(model.bodies.size(), nullptr);
  for (const Joint& j : model.joints) {
    if (j.parent != ground_index) continue;
    const Joint*& tightest = on_ground[j.child];
    if (joint_velocities(j.type) < (tightest ? joint_velocities(tightest->type) : 6)) tightest = &j;
  }
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Body& b = model.bodies[i];
    if (b.modes() == 0) continue;
    // Any motion, unless a joint to the ground restricts it.
    const Joint* joint = on_ground[i];
    const Mat6X free =
        joint ? rigid_motions(*joint, b, marker(joint->frame_M)) : Mat6X(Mat6::Identity());
    const double own = relative_modal_mass(b.data->invariants, free, b.data->K);
    if (own > least_modal_mass) continue;
    std::ostringstream s;
    s << "bodies." << b.name << ": found " << b.modes()
      << " modes of which a combination moves no mass (relative modal mass " << own
      << "), expected fewer modes" << remedy(d.bodies[i]);
    errors.add(ErrorCode::wrong_value, d.bodies[i].origin.of("flexible"), s.str());
  }
}

void ModelBuilder::finish() {
  double mass = 0.0;
  int heavy = 0;
  std::vector<double> reach(model.bodies.size(), 0.0);  // of markers without a node
  for (const Marker& m : model.markers)
    if (m.body >= 0 && m.node < 0) {
      double& r = reach[m.body];
      r = std::max(r, m.X_NM.p.norm());
    }
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    Body& b = model.bodies[i];
    const InertiaInvariants& v = b.data->invariants;
    if (v.m > 0.0) {
      mass += v.m;
      ++heavy;
    }
    double length = reach[i];
    for (const ModalNode& n : b.data->nodes) length = std::max(length, n.p.norm());
    if (v.m > 0.0) length = std::max(length, std::sqrt(std::max(v.P_u.trace(), 0.0) / v.m));
    b.length = length > 0.0 ? length : 1.0;
    const auto amplitudes = [&](const char* key, const std::map<std::string, VecX>& given,
                                std::vector<VecX>& out) {
      const auto it = given.find(b.name);
      out.push_back(it == given.end() ? VecX() : it->second);
      if (it != given.end() && it->second.size() != b.modes())
        errors.add(ErrorCode::wrong_count, d.bodies[i].origin.of(key),
                   std::string(key) + "." + b.name + ": found a list of " +
                       std::to_string(it->second.size()) + ", expected a list of " +
                       std::to_string(b.modes()) + " amplitudes, one per mode");
    };
    amplitudes("initial.amplitudes", d.amplitudes, model.amplitudes);
    amplitudes("initial.amplitude_rates", d.amplitude_rates, model.amplitude_rates);
  }
  model.mean_mass = heavy > 0 ? mass / heavy : 1.0;
}

}  // namespace floatframe
