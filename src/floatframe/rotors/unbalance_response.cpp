#include "floatframe/rotors/unbalance_response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/body/surface_points.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/json_text.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/core/work_progress.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/rotors/rotor_analysis.hpp"
#include "floatframe/rotors/rotor_symmetry.hpp"
#include "floatframe/rotors/turning_model.hpp"

namespace floatframe {
namespace {

/// The point of the axis at which an unbalance acts.
AxisForce axis_force(const Model& model, const Rotor& rotor, const Unbalance& u) {
  std::vector<std::string> names;
  const RotorBody* on = nullptr;
  for (const RotorBody& r : rotor.bodies) {
    names.push_back(model.bodies[r.body].name);
    if (names.back() == u.body) on = &r;
  }
  if (!on)
    throw InputError(ErrorCode::not_found,
                     fmt::format("unbalance: the rotor on joint '{}' has no body '{}'{}",
                                 rotor.name, excerpt(u.body), did_you_mean(u.body, names)));
  if (!std::isfinite(u.moment) || !std::isfinite(u.angle))
    throw InputError(
        ErrorCode::not_finite,
        fmt::format("unbalance on body '{}': found a number that is not finite", u.body));
  const FlexibleBody& body = *model.bodies[on->body].data;
  AxisForce force;
  force.body = on->body;
  force.size = std::polar(u.moment, u.angle);
  if (body.modes() == 0 && u.node.empty()) {
    const Vec3 c = body.invariants.centre_of_mass() - on->p_BP;
    force.p_BP = on->p_BP + on->axis * on->axis.dot(c);
    return force;
  }
  std::vector<std::string> nodes;
  for (const int k : on->on_axis) {
    const ModalNode& on_axis = body.nodes[k];
    if (is_surface_point(on_axis)) continue;
    const std::string& name = on_axis.name;
    if (!name.empty()) nodes.push_back(name);
    if (!name.empty() && name == u.node) force.node = k;
  }
  if (force.node < 0)
    throw InputError(
        ErrorCode::missing,
        fmt::format("unbalance on body '{}': found {}, expected BODY:NODE with a node on the axis "
                    "of the rotor{}",
                    u.body, u.node.empty() ? "no node" : "the node '" + excerpt(u.node) + "'",
                    nodes.empty() ? "; the body has none with a name"
                                  : ": " + fmt::format("{}", fmt::join(nodes, ", "))));
  return force;
}

std::vector<int> chosen_outputs(const Model& model, const std::vector<std::string>& names) {
  std::vector<std::string> known;
  std::vector<int> found;
  for (const Output& o : model.outputs) known.push_back(o.name);
  for (std::size_t k = 0; k < known.size() && names.empty(); ++k)
    found.push_back(static_cast<int>(k));
  for (const std::string& name : names) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end())
      throw InputError(ErrorCode::not_found,
                       fmt::format("unknown output '{}'{}", excerpt(name),
                                   known.empty() ? std::string("; the model has no outputs")
                                                 : did_you_mean(name, known)));
    found.push_back(static_cast<int>(at - known.begin()));
  }
  return found;
}

/// Omits those with `bad`, with a note.
void leave_out(const Model& model, std::vector<int>& outputs, const std::vector<char>& bad,
               const char* why, std::vector<std::string>& notes) {
  std::vector<int> left;
  std::string names;
  for (std::size_t k = 0; k < outputs.size(); ++k)
    if (bad[k])
      names += (names.empty() ? "" : ", ") + model.outputs[outputs[k]].name;
    else
      left.push_back(outputs[k]);
  if (!names.empty()) notes.push_back(fmt::format("left out, {}: {}", why, names));
  outputs = left;
}

std::vector<AxisForce> at_speed(std::vector<AxisForce> forces, double speed) {
  for (AxisForce& f : forces) f.size *= speed * speed;
  return forces;
}

/// Outputs that rotate with the rotor differ from angle to angle; norms that are zero at rest have
/// no slope.
void keep_outputs(TurningModel& turning, const std::vector<AxisForce>& forces, double speed,
                  std::vector<int>& outputs, std::vector<std::string>& notes) {
  const Model& model = turning.model();
  std::vector<char> bad;
  for (const int k : outputs)
    bad.push_back(output_kind(model.outputs[k].type).needs_of_motion.reactions);
  leave_out(model, outputs, bad, "since they need reactions", notes);
  if (speed == 0.0) return;
  const TurningResponse a = turning.response(speed, at_speed(forces, speed), outputs),
                        b = turning.response(speed, at_speed(forces, speed), outputs, 0.7);
  std::vector<char> rough, turns;
  double largest = 0.0;
  for (Eigen::Index k = 0; k < a.amplitudes.size(); ++k)
    largest = std::max(largest, std::abs(a.amplitudes[k]));
  for (Eigen::Index k = 0; k < a.amplitudes.size(); ++k) {
    const double size = std::max(std::abs(a.amplitudes[k]), std::abs(b.amplitudes[k]));
    rough.push_back(!a.smooth[k]);
    const bool other = std::abs(a.amplitudes[k] - b.amplitudes[k]) > 1e-2 * size + 1e-9 * largest,
               moved = std::abs(a.means[k] - b.means[k]) > 1e-6 * (1.0 + std::abs(a.means[k]));
    turns.push_back(!rough.back() && (other || moved));
  }
  std::vector<int> smooth = outputs;
  leave_out(model, smooth, rough, "since they are sizes that are zero in the steady state", notes);
  std::vector<char> left;
  for (std::size_t k = 0; k < rough.size(); ++k)
    if (!rough[k]) left.push_back(turns[k]);
  outputs = smooth;
  leave_out(model, outputs, left, "since they turn with the rotor", notes);
}

}  // namespace

UnbalanceResponse unbalance_response(const Model& model, const UnbalanceOptions& o) {
  UnbalanceResponse r;
  r.speeds = rotor_speeds(o.joint, o.from, o.to, o.step);
  if (o.unbalances.empty())
    throw InputError(
        ErrorCode::out_of_range,
        fmt::format("rotor on joint '{}': no unbalance is given, expected at least one", o.joint));
  std::vector<int> outputs = chosen_outputs(model, o.outputs);
  const CountedStiffening counted = stiffened_rotor(built(model), o.joint);
  r.stiffened = counted.bodies;
  r.stiffening = counted.sentence;
  TurningModel turning(counted.model, o.joint, o.axis);
  std::vector<AxisForce> forces;
  for (const Unbalance& u : o.unbalances)
    forces.push_back(axis_force(turning.model(), turning.rotor(), u));
  require_symmetry(turning.model(), turning.rotor(), turning.dependence_on_angle(r.speeds.back()));
  keep_outputs(turning, forces, r.speeds.back(), outputs, r.notes);
  for (const int k : outputs) {
    const Output& output = model.outputs[k];
    r.curves.push_back({{output.name, output.unit}, {}, {}});
  }
  for (std::size_t s = 0; s < r.speeds.size(); ++s) {
    tell_progress("speeds", 1.0 * s / r.speeds.size());
    const ListenToProgress ignores([](const char*, double) {});  // works within a speed
    const double speed = r.speeds[s];
    // At standstill nothing rotates, and the rotation is not restrained.
    const TurningResponse y =
        turning.response(speed == 0.0 ? 1e-3 * o.step : speed, at_speed(forces, speed), outputs);
    for (std::size_t k = 0; k < r.curves.size(); ++k) {
      r.curves[k].amplitudes.push_back(y.amplitudes[k]);
      r.curves[k].means.push_back(y.means[k]);
    }
  }
  for (const std::string& note : turning.notes()) r.notes.push_back(note);
  const double fastest = std::max(std::abs(r.speeds.front()), std::abs(r.speeds.back()));
  for (std::string& note : stiffening_notes(turning.model(), turning.rotor(), fastest))
    r.notes.push_back(std::move(note));
  return r;
}

}  // namespace floatframe
