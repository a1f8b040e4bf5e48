// Valid but unusual features: angles in degrees, a rigid body without inertia that can rotate, a
// body clamped at a node without a joint. Units of bars: bar_hints.cpp.
#include "floatframe/model/model_hints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "floatframe/fe/node_dof_names.hpp"
#include "floatframe/math/union_find.hpp"
#include "floatframe/model/element_outputs.hpp"
#include "floatframe/model/hint_list.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/joint_motion.hpp"

namespace floatframe {

namespace {
constexpr std::size_t most_hints = 200;  // more are not useful, and each is compared with all
}

void HintList::add(const std::string& kind, const std::string& name, std::string sentence) {
  for (Hint& h : hints_)
    if (h.kind == kind && h.sentence == sentence) {
      ++h.others;
      return;
    }
  if (hints_.size() == most_hints) return;
  hints_.push_back({name, kind, std::move(sentence), 0});
}

std::vector<std::string> HintList::texts() const {
  std::vector<std::string> out;
  for (const Hint& h : hints_)
    out.push_back(fmt::format("{} '{}'{}: {}", h.kind, h.subject,
                              h.others > 0 ? fmt::format(" (and {} more)", h.others) : "",
                              h.sentence));
  return out;
}

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

/// "... of 30 rad is 4.8 turns; angles are in radians (30 degrees are 0.5236 rad)"
std::string turns_text(const std::string& what, double angle) {
  return fmt::format(
      "{} of {:.4g} rad is {:.3g} turns; angles are in radians ({:.4g} degrees are "
      "{:.4g} rad)",
      what, angle, std::abs(angle) / full_turn, angle, angle * std::numbers::pi / 180.0);
}

/// A full turn rounded to a few digits does not count as more than a turn.
bool beyond_a_turn(double angle) { return std::abs(angle) > 1.001 * full_turn; }

/// Monotonic without rest: a motor that accelerates or rotates uniformly.
bool goes_on(const std::vector<double>& values) {
  const double sense = values.back() - values.front();
  for (std::size_t k = 1; k < values.size(); ++k)
    if (!((values[k] - values[k - 1]) * sense > 0.0)) return false;
  return true;
}

/// Integer multiples of 5 of which one is more than a turn: a table in degrees. Tables that count
/// turns have other numbers; a continuing rotation needs stronger evidence: multiples of 15 of at
/// most two turns.
bool looks_like_degrees(const std::vector<double>& values) {
  const bool on = values.size() > 2 && goes_on(values);
  const double unit = on ? 15.0 : 5.0;
  double most = 0.0;
  for (const double x : values) {
    if (!(std::abs(x - unit * std::round(x / unit)) < 1e-9 * (1.0 + std::abs(x)))) return false;
    most = std::max(most, std::abs(x));
  }
  return most > full_turn && (!on || most <= 720.0);
}

void hint_at_angle_of_time(const std::string& kind, const std::string& name,
                           const std::string& what, const TimeFunction& f, HintList& out) {
  const PiecewisePolynomial& p = f.pieces;
  std::vector<double> values;
  for (const double b : p.breaks()) values.push_back(p(b).f);
  const bool constant = values.empty() && p(0.0).df == 0.0 && p(0.0).ddf == 0.0;
  double amplitude = 0.0;
  for (const SineTerm& s : f.sines) amplitude = std::max(amplitude, std::abs(s.amplitude));
  if (beyond_a_turn(amplitude))
    out.add(kind, name, turns_text("the amplitude of " + what, amplitude));
  else if (constant && beyond_a_turn(p(0.0).f))
    out.add(kind, name, turns_text(what, p(0.0).f));
  else if (looks_like_degrees(values)) {
    const double most = *std::max_element(
        values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    out.add(kind, name, turns_text("an entry of " + what, most));
  }
}

/// A law whose entries are all beyond a turn, on both sides of zero or on one.
void hint_at_law_of_angle(const Element& force, const PiecewisePolynomial& law, HintList& out) {
  double least = 0.0;
  for (const double b : law.breaks())
    if (b != 0.0) least = least == 0.0 || std::abs(b) < std::abs(least) ? b : least;
  if (beyond_a_turn(least))
    out.add("force", force.name, turns_text("the nearest entry of its spring", least));
}

void hint_at_angles(const ModelDescription& description, const Model& model, HintList& out) {
  for (const BodyDescription& body : description.bodies)
    if (beyond_a_turn(body.largest_angle))
      out.add("body", body.name, turns_text("an angle of its orientation", body.largest_angle));
  for (const Joint& joint : model.joints) {
    if (joint.automatic) continue;
    const auto turns = [&](int component) {
      return std::string(joint_unit_name(joint.type, component)) == "rad";
    };
    for (std::size_t k = 0; k < joint.position.size(); ++k)
      if (turns(static_cast<int>(k)) && beyond_a_turn(joint.position[k])) {
        out.add("joint", joint.name, turns_text("its position", joint.position[k]));
        break;
      }
    for (int k = 0; k < joint_velocities(joint.type); ++k)
      if (const TimeFunction* motion = model.motion_of(joint, k); motion && turns(k))
        hint_at_angle_of_time("joint", joint.name, "its motion", *motion, out);
  }
  for (const Element& e : model.elements) {
    if (!e.counts_turns()) continue;
    if (!e.laws.empty()) hint_at_law_of_angle(e, e.laws[0], out);
    for (const ElementSignal& s : signals_of(e))
      if (std::string(s.unit) == "rad")
        hint_at_angle_of_time("force", e.name, "its " + s.what, s.signal->function, out);
  }
  for (const auto& [body, offset] : description.simulation.offset)
    if (offset.rotation && beyond_a_turn(offset.rotation->norm()))
      out.add("body", body, turns_text("its start offset", offset.rotation->norm()));
}

bool joint_turns(const Joint& j) {
  JointMotion motion;
  const double drawn[6] = {};
  double q[7] = {};
  joint_configuration(j.type, drawn, q);
  joint_motion(j.type, {Vec3::UnitZ(), j.axis_2}, q, motion);
  return !motion.H.bottomRows<3>().leftCols(joint_velocities(j.type)).isZero(0.0);
}

/// Groups of bodies that rotate together, by the number of one of them; those that joints keep from
/// rotating have the number of the ground, which is that of the bodies.
std::vector<int> bodies_turning_together(const Model& model) {
  const int ground = std::ssize(model.bodies);
  UnionFind together(ground + 1);
  const auto first = [&](int body) { return together.root(body < 0 ? ground : body); };
  for (const Joint& j : model.joints) {
    if (joint_turns(j)) continue;
    const int a = first(j.parent), b = first(j.child);
    together.join(std::min(a, b), std::max(a, b));  // the ground represents its group
  }
  std::vector<int> out;
  for (int i = 0; i < ground; ++i) out.push_back(first(i));
  return out;
}

/// Single point masses that can rotate. Explicit zeros are intended, and so is a mass welded to a
/// body with inertia.
void hint_at_inertia(const ModelDescription& description, const Model& model, HintList& out) {
  const std::vector<int> together = bodies_turning_together(model);
  std::vector<bool> has_inertia(model.bodies.size() + 1, false);
  const auto missing = [&](std::size_t i) {
    const auto* rigid = std::get_if<RigidDescription>(&description.bodies[i].kind);
    return rigid != nullptr && rigid->mass > 0.0 && rigid->J_C.isZero(0.0);
  };
  has_inertia.back() = true;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (!missing(i) && model.bodies[i].data->invariants.m > 0.0) has_inertia[together[i]] = true;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const BodyDescription& body = description.bodies[i];
    if (!missing(i) || has_inertia[together[i]] || body.origin.keys.contains("inertia")) continue;
    out.add("body", body.name,
            "it has no inertia: the key 'inertia' is missing, and the body can turn; "
            "inertia: [Ixx, Iyy, Izz] [kg m2], zeros for a point mass");
  }
}

std::string dofs_text(unsigned mask) {
  std::string text;
  for (unsigned k = 0; k < 6; ++k)
    if (mask >> k & 1u) text += (text.empty() ? "" : ", ") + std::string(node_dof_words[k]);
  return text;
}

/// For one body: names of the nodes of joints, rods or forces, whether a joint constrains it, and
/// whether one constrains its frame, and thereby everything that is clamped.
struct HeldNodes {
  std::set<std::string> names;
  bool by_joint = false, frame = false;
};

/// For a hinge that represents several bearings: the nodes on its axis of the body of its
/// marker.
void add_nodes_on_axis(const Model& model, int marker, std::vector<HeldNodes>& held) {
  const Marker& m = model.markers[marker];
  if (m.body < 0) return;
  const std::vector<ModalNode>& nodes = model.bodies[m.body].data->nodes;
  const Vec3 origin = m.node < 0 ? m.X_NM.p : Vec3(nodes[m.node].p + m.X_NM.p);
  for (const ModalNode& n : nodes)
    if ((n.p - origin).cross(m.X_NM.R.col(2)).norm() < 1e-6 * (1.0 + n.p.norm()))
      held[m.body].names.insert(n.name);
}

bool turns_about_one_axis(JointType type) {
  int axes = 0;
  for (int k = 0; k < joint_kind(type).coordinates.count(); ++k)
    axes += joint_unit(type, k) == JointUnit::rad ? 1 : 0;
  return axes == 1;
}

std::vector<HeldNodes> held_nodes(const Model& model) {
  std::vector<HeldNodes> held(model.bodies.size());
  const auto use = [&](int marker, bool joint) {
    if (marker < 0) return;
    const Marker& m = model.markers[marker];
    if (m.body < 0) return;
    HeldNodes& h = held[m.body];
    h.by_joint = h.by_joint || joint;
    h.frame = h.frame || (joint && m.node < 0);
    if (m.node < 0) return;
    const FlexibleBody& body = *model.bodies[m.body].data;
    h.names.insert(body.nodes[m.node].name);
  };
  for (const Joint& j : model.joints) {
    if (joint_is_free(j.type)) continue;
    use(j.frame_F, true);
    use(j.frame_M, true);
    if (!turns_about_one_axis(j.type)) continue;
    add_nodes_on_axis(model, j.frame_F, held);
    add_nodes_on_axis(model, j.frame_M, held);
  }
  for (const Element& e : model.elements)
    for (const int marker : e.markers) use(marker, false);
  return held;
}

void hint_at_clamps(const ModelDescription& description, const Model& model, HintList& out) {
  const std::vector<HeldNodes> held = held_nodes(model);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const BodyDescription& body = description.bodies[i];
    const auto* frame = std::get_if<FlexibleDescription>(&body.kind);
    // A floating body is clamped somewhere.
    if (frame == nullptr || model.bodies[i].modes() == 0 || !held[i].by_joint || held[i].frame)
      continue;
    std::map<std::string, unsigned> loose;  // nodes and their degrees of freedom
    for (const NodeDofs& clamp : frame->clamped)
      if (!held[i].names.contains(clamp.node)) loose[clamp.node] |= clamp.mask;
    for (const auto& [node, mask] : loose)
      out.add(
          "body", body.name,
          fmt::format("it is clamped at '{}' ({}), where no joint, rod or force acts: the modes "
                      "are those of a body that is held there, and nothing holds it",
                      node, dofs_text(mask)));
  }
}

}  // namespace

ModelHints model_hints(const ModelDescription& description, const Model& model) {
  HintList hints;
  hint_at_units(description, hints);
  hint_at_angles(description, model, hints);
  hint_at_inertia(description, model, hints);
  hint_at_clamps(description, model, hints);
  hint_at_formulas(model, description.simulation.locate_edges, hints);
  hint_at_paths(description, model, hints);
  hint_at_curves(model, hints);
  hint_at_points(model, hints);
  hint_at_roads(model, hints);
  return {hints.texts(), {}, bar_bending(description, model)};
}

}  // namespace floatframe
