#include "floatframe/simulation/system_state.hpp"

#include <fmt/format.h>

#include <cmath>

#include "floatframe/core/json_text.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/redundancy.hpp"
#include "floatframe/simulation/simulation.hpp"

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

/// Compares poses and velocities of f with those stored in the state.
void compare_bodies(const RelativeFormulation& f, const SystemState& state) {
  for (std::size_t i = 0; i < f.model().bodies.size(); ++i) {
    const int k = static_cast<int>(i);
    const SystemState::Body& b = named(state.bodies, f.model().bodies[i].name);
    const Eigen::Quaterniond kept(b.orientation[0], b.orientation[1], b.orientation[2],
                                  b.orientation[3]);
    const double away = (f.body_position(k) - b.position).norm();
    const double turned =
        (f.body_rotation(k) - kept.normalized().toRotationMatrix()).cwiseAbs().maxCoeff();
    const double v = (f.body_velocity(k) - b.velocity).norm();
    const double w = (f.body_angular_velocity(k) - b.angular_velocity).norm();
    constexpr double close = 1e-6;
    if (!(away <= close * (1.0 + b.position.norm())) || !(turned <= close) ||
        !(v <= close * (1.0 + b.velocity.norm())) ||
        !(w <= close * (1.0 + b.angular_velocity.norm())))
      refuse(
          ErrorCode::contradiction, f.model(), state,
          fmt::format("the joints of the state put body '{}' {:.3g} m, {:.3g} rad, {:.3g} m/s and "
                      "{:.3g} rad/s away from where the state has it, expected no difference",
                      b.name, away, turned, v, w));
  }
}

/// Remaining offsets: three rows per body for the position and, if `turning`, three for the
/// orientation.
class OffsetGoal {
 public:
  OffsetGoal(RelativeFormulation& f, const std::map<std::string, StartOffset>& offsets) : f_(f) {
    for (const auto& [name, offset] : offsets) {
      Target t;
      t.body = -1;
      for (std::size_t i = 0; i < f.model().bodies.size(); ++i)
        if (f.model().bodies[i].name == name) t.body = static_cast<int>(i);
      if (t.body < 0) {
        std::vector<std::string> known;
        for (const Body& b : f.model().bodies) known.push_back(b.name);
        throw InputError(ErrorCode::not_found, "simulation.start.offset." + name +
                                                   ": unknown body '" + name + "'" +
                                                   did_you_mean(name, known));
      }
      t.position = f.body_position(t.body) + offset.translation;
      t.rotation = rotation_exp(offset.rotation.value_or(Vec3::Zero())) * f.body_rotation(t.body);
      t.must_turn = offset.rotation.has_value();
      targets_.push_back(t);
    }
  }

  int rows(bool hold) const {
    int n = 0;
    for (const Target& t : targets_) n += hold || t.must_turn ? 6 : 3;
    return n;
  }
  /// At the present positions of f.
  VecX missing(bool hold) const {
    VecX out(rows(hold));
    Eigen::Index at = 0;
    for (const Target& t : targets_) {
      out.segment<3>(at) = t.position - f_.body_position(t.body);
      at += 3;
      if (!hold && !t.must_turn) continue;
      const Mat3 turn = t.rotation * f_.body_rotation(t.body).transpose();
      out.segment<3>(at) = quaternion_log(Eigen::Quaterniond(turn));
      at += 3;
    }
    return out;
  }
  /// Velocities of the bodies for each velocity coordinate.
  MatX jacobian(bool hold) {
    MatX J(rows(hold), f_.velocities());
    for (int j = 0; j < f_.velocities(); ++j) {
      f_.velocities(VecX::Unit(f_.velocities(), j));
      Eigen::Index at = 0;
      for (const Target& t : targets_) {
        J.block<3, 1>(at, j) = f_.body_velocity(t.body);
        at += 3;
        if (!hold && !t.must_turn) continue;
        J.block<3, 1>(at, j) = f_.body_angular_velocity(t.body);
        at += 3;
      }
    }
    return J;
  }
  const std::string& first() const { return f_.model().bodies[targets_.front().body].name; }

 private:
  struct Target {
    int body = -1;
    Vec3 position = Vec3::Zero();
    Mat3 rotation = Mat3::Identity();
    bool must_turn = false;
  };
  RelativeFormulation& f_;
  std::vector<Target> targets_;
};

/// Least change of the rigid coordinates that moves the bodies to their positions with loops
/// closed. Returns the remaining error [m, rad].
double move_bodies(RelativeFormulation& f, OffsetGoal& goal, double t, bool hold, VecX& q) {
  const VecX rest = VecX::Zero(f.velocities());
  const int nc = f.constraints(), n = goal.rows(hold);
  VecX q1 = q;
  double left = 0.0;
  const std::vector<bool> elastic = f.tree().elastic_coordinates();
  for (int pass = 0; pass < 60; ++pass) {
    kinematics_at(f, t, q, rest);
    VecX b(nc + n);
    b << -f.constraint_values(), goal.missing(hold);
    left = b.lpNorm<Eigen::Infinity>();
    if (left < 1e-12) break;
    MatX J(nc + n, f.velocities());
    J.topRows(nc) = f.constraint_jacobian();
    J.bottomRows(n) = goal.jacobian(hold);
    for (int j = 0; j < f.velocities(); ++j)
      if (elastic[j]) J.col(j).setZero();
    VecX x = LeastNorm(J, 1e-9).solve(b);
    const double size = x.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(size)) break;
    if (size > 0.2) x *= 0.2 / size;
    f.retract(q, x, q1);
    q = q1;
    if (size < 1e-15) break;
  }
  kinematics_at(f, t, q, rest);
  return left;
}

/// Moves the named bodies, by the least change of the rigid coordinates that keeps loops closed, at
/// time t. A body keeps its orientation if its joints allow it. Throws InputError for an unknown
/// body, RunError if the joints prevent a body from moving there.
void apply_offsets(RelativeFormulation& f, const std::map<std::string, StartOffset>& offsets,
                   double t, VecX& q) {
  kinematics_at(f, t, q, VecX::Zero(f.velocities()));
  OffsetGoal goal(f, offsets);
  const VecX from = q;
  // With its present orientation; a joint that prevents this rotates it.
  constexpr double met = 1e-9;
  if (move_bodies(f, goal, t, true, q) < met) return;
  q = from;
  const double left = move_bodies(f, goal, t, false, q);
  if (left < met) return;
  throw RunError(
      ErrorCode::not_assembled,
      fmt::format("the offset at the start is not possible: with loops closed body '{}'{} stays "
                  "{:.3g} (m or rad) away from its place; its joints do not let it move there",
                  goal.first(), offsets.size() > 1 ? " or another one" : "", left));
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
    compare_bodies(f, *o.state);
    close_loops(f, state.q, state.v, true, state.t, false);
    if (report != nullptr) report_redundancy(f, state, *report);
  } else {
    state = relative_start(f, o.start, report);
  }
  if (o.offset.empty() || o.start == Start::given) return state;
  apply_offsets(f, o.offset, state.t, state.q);
  close_loops(f, state.q, state.v, true, state.t, false);
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
  for (std::size_t i = 0; i < state.bodies.size(); ++i) {
    const int k = static_cast<int>(i);
    SystemState::Body& b = state.bodies[i];
    b.position = f.body_position(k);
    const Eigen::Quaterniond r(f.body_rotation(k));
    b.orientation = {r.w(), r.x(), r.y(), r.z()};
    b.velocity = f.body_velocity(k);
    b.angular_velocity = f.body_angular_velocity(k);
  }
}

}  // namespace floatframe
