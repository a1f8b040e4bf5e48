#include "floatframe/start/system_state.hpp"

#include <fmt/format.h>

#include <cmath>

#include "floatframe/core/excerpt.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/loops/redundancy.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/joint_measure.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/start/start_offset.hpp"

namespace floatframe {
namespace {

/// One sentence about a state that is not one of this model.
[[noreturn]] void refuse(ErrorCode code, const Model& model, const SystemState& state,
                         const std::string& what) {
  throw InputError(code, {state.file, 0, 0},
                   fmt::format("{} (the state was taken of model '{}', the model is '{}')", what,
                               excerpt(state.model), model.name));
}

template <class Entity, class Entities>
void same_names(const Model& model, const SystemState& state, const char* kind,
                const std::vector<Entity>& kept, const Entities& wanted) {
  std::vector<std::string> names;
  for (const auto& w : wanted) names.push_back(w.name);
  for (const Entity& e : kept) {
    int found = 0;
    for (const std::string& n : names) found += n == e.name ? 1 : 0;
    if (found == 0)
      refuse(ErrorCode::not_found, model, state,
             fmt::format("found {} '{}' in the state, which the model does not have{}", kind,
                         excerpt(e.name), did_you_mean(e.name, names)));
  }
  for (const std::string& n : names) {
    int found = 0;
    for (const Entity& e : kept) found += e.name == n ? 1 : 0;
    if (found != 1)
      refuse(ErrorCode::duplicate, model, state,
             fmt::format("found {} '{}' {} in the state, expected it once", kind, n,
                         found == 0 ? "nowhere" : "twice"));
  }
}

template <class Entity>
const Entity& named(const std::vector<Entity>& list, const std::string& name) {
  for (const Entity& e : list)
    if (e.name == name) return e;
  return list.front();  // checked by `same_names`
}

bool finite(const std::vector<double>& v) {
  for (const double x : v)
    if (!std::isfinite(x)) return false;
  return true;
}

/// A step must change the time, with enough digits for functions of time.
void check_time(const SystemState& state, double step) {
  constexpr double digits = 1e-9;
  if (step >= digits * std::abs(state.time)) return;
  throw InputError(
      ErrorCode::out_of_range, {state.file, 0, 0},
      fmt::format("found the time {:g} s, at which steps of {:g} s get lost in rounding, expected "
                  "at most {:g} s: steps of at least {:g} of the time",
                  state.time, step, step / digits, digits));
}

/// Compares poses and velocities of the bodies with those stored in the state.
void compare_bodies(const SystemMotion& motion, const SystemState& state) {
  for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
    const BodyKinematics& m = motion.bodies[i];
    const SystemState::Body& b = named(state.bodies, motion.model.bodies[i].name);
    const Eigen::Quaterniond kept(b.orientation[0], b.orientation[1], b.orientation[2],
                                  b.orientation[3]);
    const double away = (m.p_WB - b.position).norm();
    const double turned = (m.R_WB - kept.normalized().toRotationMatrix()).cwiseAbs().maxCoeff();
    const double v = (m.v_WB - b.velocity).norm();
    const double w = (m.w_WB - b.angular_velocity).norm();
    constexpr double close = 1e-6;
    if (!(away <= close * (1.0 + b.position.norm())) || !(turned <= close) ||
        !(v <= close * (1.0 + b.velocity.norm())) ||
        !(w <= close * (1.0 + b.angular_velocity.norm())))
      refuse(
          ErrorCode::contradiction, motion.model, state,
          fmt::format("the joints of the state put body '{}' {:.3g} m, {:.3g} rad, {:.3g} m/s and "
                      "{:.3g} rad/s away from where the state has it, expected no difference",
                      b.name, away, turned, v, w));
  }
}

/// Those of the elements that have some.
void take_states(const SystemState& state, Model& model) {
  auto kept = state.elements.begin();
  for (Element& e : model.elements) {
    const int count = e.states + e.kept;
    if (count == 0) continue;
    if (kept == state.elements.end() || kept->name != e.name || kept->states.size() != count)
      refuse(ErrorCode::wrong_count, model, state,
             fmt::format("found other states of elements, expected {} of '{}'", count, e.name));
    if (!kept->states.allFinite())
      refuse(ErrorCode::not_finite, model, state,
             fmt::format("found numbers that are not finite at element '{}'", e.name));
    e.start_states = kept->states;
    ++kept;
  }
  if (kept != state.elements.end())
    refuse(ErrorCode::not_found, model, state,
           fmt::format("found states of '{}', which the model does not have", excerpt(kept->name)));
}

}  // namespace

Model with_start_values(const Model& model, const SystemState& state) {
  same_names(model, state, "joint", state.joints, model.joints);
  same_names(model, state, "body", state.bodies, model.bodies);
  if (!std::isfinite(state.time))
    refuse(ErrorCode::not_finite, model, state, "found a time that is not finite");
  Model out = model;
  out.simulation.velocity.setZero();  // the state holds all velocities
  for (Joint& j : out.joints) {
    const SystemState::Joint& kept = named(state.joints, j.name);
    const std::size_t n = joint_velocities(j.type);
    if (kept.type != j.type || kept.position.size() != n || kept.velocity.size() != n)
      refuse(ErrorCode::wrong_count, model, state,
             fmt::format("found joint '{}' of another type or with {} coordinates and {} "
                         "velocities in the state, expected {} for a {} joint",
                         j.name, kept.position.size(), kept.velocity.size(), n,
                         joint_type_name(j.type)));
    if (!finite(kept.position) || !finite(kept.velocity))
      refuse(ErrorCode::not_finite, model, state,
             fmt::format("found numbers that are not finite at joint '{}'", j.name));
    j.position = kept.position;
    j.velocity = kept.velocity;
    j.keep = false;  // all values are given, to the tolerances of the run
  }
  for (std::size_t i = 0; i < out.bodies.size(); ++i) {
    const SystemState::Body& kept = named(state.bodies, out.bodies[i].name);
    const int modes = out.bodies[i].modes();
    if (kept.amplitudes.size() != modes || kept.amplitude_rates.size() != modes)
      refuse(ErrorCode::wrong_count, model, state,
             fmt::format("found {} amplitudes and {} rates of body '{}' in the state, expected {}",
                         kept.amplitudes.size(), kept.amplitude_rates.size(), out.bodies[i].name,
                         modes));
    if (!kept.amplitudes.allFinite() || !kept.amplitude_rates.allFinite())
      refuse(ErrorCode::not_finite, model, state,
             fmt::format("found numbers that are not finite at body '{}'", out.bodies[i].name));
    out.amplitudes[i] = kept.amplitudes;
    out.amplitude_rates[i] = kept.amplitude_rates;
  }
  take_states(state, out);
  return out;
}

std::optional<Model> started_model(const Model& model, const SimulationDescription& o) {
  if (o.start != Start::state || !o.state) return std::nullopt;
  return with_start_values(model, *o.state);
}

State start_state(RelativeFormulation& f, const SimulationDescription& o, StartReport* report) {
  State state;
  if (o.start == Start::state && o.state) {
    const Model values = with_start_values(f.model(), *o.state);
    check_time(*o.state, o.step);
    state.t = o.state->time;
    f.start(values, state.t, state.q, state.v);
    kinematics_at(f, state);
    compare_bodies(f.motion(), *o.state);
    close_loops(f, state.q, state.v, true, state.t, false);
    set_element_states(f, state);
    if (report != nullptr) report_redundancy(f, state, *report);
  } else {
    state = relative_start(f, o.start, report);
  }
  if (o.offset.empty() || o.start == Start::given) return state;
  apply_offsets(f, o.offset, state.t, state.q);
  close_loops(f, state.q, state.v, true, state.t, false);
  set_element_states(f, state, StateStart::sampled);
  return state;
}

JointFollower::JointFollower(const Model& model) {
  for (const Joint& j : model.joints) {
    const std::size_t n = joint_velocities(j.type);
    SystemState::Joint s{j.name, j.type, j.position, std::vector<double>(n, 0.0)};
    s.position.resize(n, 0.0);
    joints_.push_back(std::move(s));
  }
}

void JointFollower::follow(const SystemMotion& motion) {
  const std::vector<Joint>& joints = motion.model.joints;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    SystemState::Joint& j = joints_[k];
    const MarkerState& F = motion.marker(joints[k].frame_F);
    const MarkerState& M = motion.marker(joints[k].frame_M);
    for (std::size_t i = 0; i < j.position.size(); ++i) {
      const int component = static_cast<int>(i);
      const double rate = joint_velocity(joints[k], F, M, component);
      const double expected =
          started_ ? j.position[i] + 0.5 * (motion.t - time_) * (j.velocity[i] + rate)
                   : motion.start_position(k, component);
      j.position[i] = joint_position(joints[k], F, M, component, expected);
      j.velocity[i] = rate;
    }
  }
  time_ = motion.t;
  started_ = true;
}

std::size_t JointFollower::size() const noexcept {
  std::size_t n = 0;
  for (const SystemState::Joint& j : joints_) n += j.position.size() + j.velocity.size();
  return n;
}

std::vector<double> JointFollower::numbers() const {
  std::vector<double> all;
  for (const SystemState::Joint& j : joints_) {
    all.insert(all.end(), j.position.begin(), j.position.end());
    all.insert(all.end(), j.velocity.begin(), j.velocity.end());
  }
  return all;
}

void JointFollower::restore(std::span<const double> numbers, double t) noexcept {
  auto from = numbers.begin();
  for (SystemState::Joint& j : joints_)
    for (std::vector<double>* values : {&j.position, &j.velocity})
      for (double& x : *values) x = *from++;
  time_ = t;
  started_ = true;
}

void place_bodies(const Model& model, InertiaMethod inertia, SystemState& state) {
  const Model values = with_start_values(model, state);
  RelativeFormulation f(values, inertia);
  VecX q, v;
  f.start(values, state.time, q, v);
  kinematics_at(f, state.time, q, v);
  const SystemMotion& motion = f.motion();
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    const BodyKinematics& m = motion.bodies[i];
    SystemState::Body& b = state.bodies[i];
    b.position = m.p_WB;
    const Eigen::Quaterniond r(m.R_WB);
    b.orientation = {r.w(), r.x(), r.y(), r.z()};
    b.velocity = m.v_WB;
    b.angular_velocity = m.w_WB;
  }
}

SystemState system_state(const SystemMotion& motion, JointFollower& joints) {
  joints.follow(motion);
  SystemState s;
  s.model = motion.model.name;
  s.time = motion.t;
  s.joints = joints.joints();
  for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
    SystemState::Body b;
    b.name = motion.model.bodies[i].name;
    b.amplitudes = motion.bodies[i].y;
    b.amplitude_rates = motion.bodies[i].yd;
    s.bodies.push_back(std::move(b));
  }
  for (std::size_t k = 0; k < motion.model.elements.size(); ++k) {
    const Element& e = motion.model.elements[k];
    if (e.states + e.kept > 0)
      s.elements.push_back({e.name, Eigen::Map<const VecX>(motion.states[k], e.states + e.kept)});
  }
  return s;
}

}  // namespace floatframe
