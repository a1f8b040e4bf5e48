// Changes to the start values of the user.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/joint_measure.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/start/initial_state.hpp"

namespace floatframe {

namespace {

/// Smaller changes are the rounding of numbers written by hand.
constexpr double noticeable = 1e-6;

std::string quantity(JointType type, std::size_t component) {
  if (joint_has_one_coordinate(type)) return joint_coordinate_name(type, 0);
  return fmt::format("coordinate {}", component + 1);
}

std::string sentence(const StartChange& c, const char* what_changed) {
  const std::string unit = c.unit.empty() ? "" : " " + c.unit;
  const bool counted = c.quantity.find(' ') != std::string::npos;  // "amplitude 3"
  return fmt::format("{}: {} changed {}{}{} from the {:.6g}{} given to {:.6g}{} (by {:.3g}{})",
                     c.owner, what_changed, c.rate ? "the rate of " : "", counted ? "" : "the ",
                     c.quantity, c.given, unit, c.used, unit, c.used - c.given, unit);
}

class Changes {
 public:
  explicit Changes(StartReport& report) : report_(report) {}

  void joint(const Model& model, const Joint& j, bool rate, const std::vector<double>& given,
             const SystemMotion& motion) {
    const MarkerState& F = motion.marker(j.frame_F);
    const MarkerState& M = motion.marker(j.frame_M);
    for (std::size_t k = 0; k < given.size(); ++k) {
      const int component = static_cast<int>(k);
      double wanted = given[k];
      // Free joints to the ground have the velocity of the simulation added to theirs.
      if (rate && joint_is_free(j.type) && j.parent < 0 && k < 3)
        wanted += model.simulation.velocity[component];
      const double used =
          rate ? joint_velocity(j, F, M, component) : joint_position(j, F, M, component, wanted);
      if (!(std::abs(used - wanted) > noticeable * (1.0 + std::abs(wanted)))) continue;
      if (!rate && same_rotation(j, given, k, F, M)) continue;
      report_.changes.push_back({"joint '" + j.name + "'", quantity(j.type, k), rate,
                                 joint_unit_name(j.type, component, rate), wanted, used});
    }
  }

  void amplitudes(const std::string& body, bool rate, const VecX& given, const VecX& used) {
    const double size = given.lpNorm<Eigen::Infinity>();
    for (Eigen::Index k = 0; k < given.size(); ++k)
      if (std::abs(used[k] - given[k]) > noticeable * (size > 0.0 ? size : 1e-3))
        report_.changes.push_back({"body '" + body + "'", fmt::format("amplitude {}", k + 1), rate,
                                   "", given[k], used[k]});
  }

 private:
  /// A rotation of half a turn has two rotation vectors.
  static bool same_rotation(const Joint& j, const std::vector<double>& given, std::size_t k,
                            const MarkerState& F, const MarkerState& M) {
    const int first = quaternion_offset(j.type);
    if (first < 0 || static_cast<int>(k) < first) return false;
    const Vec3 theta(given.data() + first);
    const Mat3 difference = rotation_exp(theta).transpose() * (F.R.transpose() * M.R);
    return quaternion_log(Eigen::Quaterniond(difference)).norm() < noticeable;
  }

  StartReport& report_;
};

/// Springs whose ends are made coincident (within 1e-9 m) by start values.
void report_coinciding_ends(const SystemMotion& motion, StartReport& report) {
  for (const Element& force : motion.model.elements)
    if (element_kind(force.type).along_line && force.coordinates.empty() &&
        (motion.marker(force.markers[1]).r - motion.marker(force.markers[0]).r).norm() < 1e-9)
      report.notes.push_back(fmt::format(
          "the ends of force '{}' coincide at the start: it has no direction there, and acts along "
          "x until they part",
          force.name));
}

/// True if the body extends from the node of the marker in a sliding direction of the joint.
bool slides_along(const Body& body, const Marker& marker, int slides) {
  const Vec3 from = body.data->nodes[marker.node].p, axis = marker.X_NM.R.col(2);
  return std::any_of(body.data->nodes.begin(), body.data->nodes.end(), [&](const ModalNode& n) {
    const Vec3 d = n.p - from;
    const double along = std::abs(d.dot(axis)), length = d.norm();
    // Of two directions: the axis is their normal.
    return length > 0.0 && (slides == 1 ? along > 0.9 * length : along < 0.4 * length);
  });
}

/// Whether what slides at this marker goes along a flexible body, from one of its nodes.
bool goes_along(const Model& model, const Marker& marker, int slides) {
  return marker.body >= 0 && marker.node >= 0 && marker.rotates &&
         slides_along(model.bodies[marker.body], marker, slides);
}

/// Joints and lines that slide along a flexible body, at one of its nodes.
void report_rigid_tangents(const Model& model, StartReport& report) {
  const auto note = [&](const std::string& what, const Marker& marker) {
    report.notes.push_back(fmt::format(
        "{} slides along the straight tangent of body '{}' at one of its nodes, not along the bent "
        "body: away from there it moves as that node does; a constraint of type 'slide_along' "
        "follows the bent body",
        what, model.bodies[marker.body].name));
  };
  for (const Joint& j : model.joints) {
    int slides = 0;
    for (const JointCoordinate& c : joint_kind(j.type).coordinates.all())
      slides += c.unit == JointUnit::m;
    if (slides == 0 || slides > 2) continue;
    for (const int frame : {j.frame_F, j.frame_M}) {
      if (!goes_along(model, model.markers[frame], slides)) continue;
      note("joint '" + j.name + "'", model.markers[frame]);
      break;
    }
  }
  for (const Element& e : model.elements)
    if (element_kind(e.type).on_line && goes_along(model, model.markers[e.markers[0]], 1))
      note("constraint '" + e.name + "'", model.markers[e.markers[0]]);
}

}  // namespace

std::vector<double> joint_coordinates_in_range(const Joint& joint,
                                               const std::vector<double>& values) {
  std::vector<double> out = values;
  const int first = quaternion_offset(joint.type);
  if (first < 0 || out.size() < static_cast<std::size_t>(first) + 3) return out;
  Eigen::Map<Vec3> theta(out.data() + first);
  if (theta.norm() > 3.141592653589793) theta = quaternion_log(quaternion_exp(theta));
  return out;
}

void report_changes(const SystemMotion& motion, Start start, StartReport& report) {
  const Model& model = motion.model;
  const bool balanced = start == Start::equilibrium;
  Changes changes(report);
  // An equilibrium is expected to change the given positions, except those that must be kept.
  for (const Joint& j : model.joints)
    if (!balanced || j.keep)
      changes.joint(model, j, false, joint_coordinates_in_range(j, j.position), motion);
  for (std::size_t i = 0; i < model.bodies.size() && !balanced; ++i) {
    const VecX& given = model.amplitudes[i];
    if (given.size() > 0)
      changes.amplitudes(model.bodies[i].name, false, given, motion.bodies[i].y);
  }
  const std::size_t positions = report.changes.size();
  for (const Joint& j : model.joints) changes.joint(model, j, true, j.velocity, motion);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const VecX& given = model.amplitude_rates[i];
    if (given.size() > 0)
      changes.amplitudes(model.bodies[i].name, true, given, motion.bodies[i].yd);
  }
  for (std::size_t k = 0; k < report.changes.size(); ++k)
    report.notes.push_back(
        sentence(report.changes[k],
                 balanced && k < positions
                     ? "keep: true holds no position where the start is an equilibrium, which"
                     : "closing the loops"));
  report_coinciding_ends(motion, report);
  report_rigid_tangents(model, report);
}

}  // namespace floatframe
