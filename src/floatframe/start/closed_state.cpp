#include "floatframe/start/closed_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/core/excerpt.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/formulation/relative.hpp"
#include "floatframe/loops/least_change.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/joint_measure.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/start/system_state.hpp"

namespace floatframe {
namespace {

/// A given value: of a joint or of a mode.
struct Target {
  int joint = -1, body = -1, component = 0;
  bool rate = false;
  double value = 0.0;
};

std::string name_of(const Model& model, const Target& x) {
  if (x.joint < 0)
    return fmt::format("mode {} of body '{}'", x.component + 1, model.bodies[x.body].name);
  const std::string& name = model.joints[x.joint].name;
  return joint_velocities(model.joints[x.joint].type) == 1
             ? fmt::format("joint '{}'", name)
             : fmt::format("joint '{}', coordinate {}", name, x.component + 1);
}

template <class Entities>
int place_in(const Entities& list, const char* what, const std::string& name) {
  std::vector<std::string> known;
  for (const auto& e : list) {
    if (e.name == name) return static_cast<int>(known.size());
    known.push_back(e.name);
  }
  throw InputError(ErrorCode::not_found, fmt::format("found no {} '{}'{}", what, excerpt(name),
                                                     did_you_mean(name, known)));
}

Target target_of(const Model& model, const GivenState& given) {
  const StateName& of = given.of;
  Target x{-1, -1, of.index, of.rate, given.value};
  int count = 0;
  if (of.kind == StateKind::joint) {
    x.joint = place_in(model.joints, "joint", of.name);
    count = joint_velocities(model.joints[x.joint].type);
  } else if (of.kind == StateKind::mode) {
    x.body = place_in(model.bodies, "body", of.name);
    count = model.bodies[x.body].modes();
  } else {
    throw InputError(ErrorCode::unsupported,
                     fmt::format("found a value of the {} '{}', expected one of a joint or a mode",
                                 state_kind_name(of.kind), excerpt(of.name)));
  }
  if (of.index < 0 || of.index >= count)
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("{} '{}': found coordinate {}, expected one of {}",
                                 x.joint < 0 ? "body" : "joint", of.name, of.index, count));
  if (!std::isfinite(given.value))
    throw InputError(ErrorCode::not_finite,
                     fmt::format("{}: found a number that is not finite", name_of(model, x)));
  return x;
}

/// The values of a model, which move to the given ones with its loops closed.
class ClosedState {
 public:
  ClosedState(const Model& model, InertiaMethod inertia, const SystemState& present)
      : values_(with_start_values(model, present)), f_(values_, inertia), t_(present.time) {
    f_.start(values_, t_, q_, v_);
  }

  void move_positions(std::span<const Target> targets);
  void move_rates(std::span<const Target> targets);
  void write(SystemState& state) const;

 private:
  double& value(const Target& x) {
    if (x.joint < 0)
      return (x.rate ? values_.amplitude_rates : values_.amplitudes)[x.body][x.component];
    Joint& joint = values_.joints[x.joint];
    return (x.rate ? joint.velocity : joint.position)[x.component];
  }
  double measured(const Target& x) const;
  bool in_tree(const Target& x) const {
    return x.joint < 0 || f_.tree().body_of_joint(x.joint) >= 0;
  }
  VecX weights(std::span<const Target> targets, bool elastic) const;
  SparseRowMatrix rows(std::span<const Target> cut);
  VecX gaps(std::span<const Target> cut);
  double close_positions(std::span<const Target> targets, std::span<const Target> cut);
  void measure();
  int increments(std::span<const Target> targets);
  [[noreturn]] void refuse(std::span<const Target> targets, std::span<const Target> cut,
                           const VecX& gap, bool rates) const;

  Model values_;
  RelativeFormulation f_;
  double t_;
  VecX q_, v_;
};

double ClosedState::measured(const Target& x) const {
  if (x.joint < 0) {
    const TreeBody& b = f_.tree().body(x.body);
    return (x.rate ? b.yd : b.y)[x.component];
  }
  const Joint& joint = values_.joints[x.joint];
  const MarkerState &F = f_.marker(joint.frame_F), &M = f_.marker(joint.frame_M);
  return x.rate ? joint_velocity(joint, F, M, x.component)
                : joint_position(joint, F, M, x.component, x.value);
}

/// Of the coordinates that may change: none that is given, modes only where joints do not suffice.
VecX ClosedState::weights(std::span<const Target> targets, bool elastic) const {
  VecX w = VecX::Ones(f_.velocities());
  for (const TreeBody& b : f_.tree().bodies())
    w.segment(b.iy, b.nm).setConstant(elastic ? 1e-4 : 0.0);
  for (const Target& x : targets) {
    if (!in_tree(x)) continue;
    const TreeBody& b = f_.tree().body(x.joint < 0 ? x.body : f_.tree().body_of_joint(x.joint));
    // A reversed joint that is given in part is given as it is: its coordinates mix.
    if (x.joint >= 0 && (b.reversed || joint_kind(b.type).rotation_vector >= 0))
      w.segment(b.iv, b.nj).setZero();
    else
      w[(x.joint < 0 ? b.iy : b.iv) + x.component] = 0.0;
  }
  return w;
}

/// Of the constraints, then of given values of joints that are cut: their rates at unit velocities.
SparseRowMatrix ClosedState::rows(std::span<const Target> cut) {
  if (cut.empty()) return f_.constraint_rows();
  MatX J(f_.constraints() + std::ssize(cut), f_.velocities());
  J.topRows(f_.constraints()) = MatX(f_.constraint_rows());
  const auto measure_all = [&](Eigen::Index column) {
    for (Eigen::Index k = 0; k < std::ssize(cut); ++k) {
      Target rate = cut[k];
      rate.rate = true;
      J(f_.constraints() + k, column) = measured(rate);
    }
  };
  for (Eigen::Index k = 0; k < f_.velocities(); ++k) {
    f_.velocities(VecX::Unit(f_.velocities(), k));
    measure_all(k);
  }
  f_.velocities(v_);
  return J.sparseView();
}

VecX ClosedState::gaps(std::span<const Target> cut) {
  VecX r(f_.constraints() + std::ssize(cut));
  r.head(f_.constraints()) = f_.constraint_values();
  Eigen::Index row = f_.constraints();
  for (const Target& x : cut) r[row++] = measured(x) - x.value;
  return r;
}

/// (1) from `q_`, which has the given values; the largest gap that is left.
double ClosedState::close_positions(std::span<const Target> targets, std::span<const Target> cut) {
  kinematics_at(f_, t_, q_, v_);
  if (f_.constraints() == 0 && cut.empty()) return 0.0;
  constexpr double closed = 1e-11;
  const VecX begin = q_;
  double gap = 0.0;
  for (const bool elastic : {false, true}) {
    const VecX w = weights(targets, elastic);
    q_ = begin;
    for (int pass = 0; pass < 50; ++pass) {
      kinematics_at(f_, t_, q_, v_);
      const VecX r = gaps(cut);
      gap = largest(r);
      if (!(gap > 1e-14)) break;
      VecX x = least_change(rows(cut), w, -r), q1 = q_;
      const double size = largest(x);
      if (!std::isfinite(size) || size < 1e-15) break;
      if (size > 0.2) x *= 0.2 / size;
      f_.retract(q_, x, q1);
      q_ = q1;
    }
    kinematics_at(f_, t_, q_, v_);
    gap = largest(gaps(cut));
    if (gap < closed) break;
  }
  return gap;
}

/// All values at the present motion; turns are counted from the last ones.
void ClosedState::measure() {
  for (int k = 0; k < std::ssize(values_.joints); ++k)
    for (int i = 0; i < std::ssize(values_.joints[k].position); ++i)
      for (const bool rate : {false, true}) {
        Target x{k, -1, i, rate};
        x.value = value(x);
        value(x) = measured(x);
      }
  for (int i = 0; i < f_.tree().body_count(); ++i) {
    values_.amplitudes[i] = f_.tree().body(i).y;
    values_.amplitude_rates[i] = f_.tree().body(i).yd;
  }
}

/// Of at most 0.1 rad, or a twentieth of the shortest body. Without loops: one.
int ClosedState::increments(std::span<const Target> targets) {
  if (f_.constraints() == 0) return 1;
  double length = 1e300, most = 0.0;
  for (const Body& b : values_.bodies)
    if (b.length > 0.0) length = std::min(length, b.length);
  for (const Target& x : targets) {
    const bool angle =
        x.joint >= 0 &&
        joint_kind(values_.joints[x.joint].type).coordinates.all()[x.component].unit ==
            JointUnit::rad;
    most = std::max(most, std::abs(x.value - value(x)) / (angle ? 0.1 : 0.05 * length));
  }
  return std::clamp(static_cast<int>(std::ceil(std::min(most, 1e4))), 1, 2000);
}

void ClosedState::refuse(std::span<const Target> targets, std::span<const Target> cut,
                         const VecX& gap, bool rates) const {
  Eigen::Index row = 0;
  gap.cwiseAbs().maxCoeff(&row);
  const std::string who = row < f_.constraints()
                              ? f_.constraint_set().owner_of_row(static_cast<int>(row))
                              : name_of(values_, cut[row - f_.constraints()]);
  std::string with;
  for (const Target& x : targets)
    with += fmt::format("{}{} at {:.6g}", with.empty() ? "" : ", ", name_of(values_, x), x.value);
  throw RunError(
      ErrorCode::not_assembled,
      fmt::format("the {} cannot be set: {} {} {:.3g} {} with {}; nothing was changed",
                  rates ? "velocities" : "positions", who, rates ? "opens at" : "has a gap of",
                  std::abs(gap[row]), rates ? "m/s or rad/s" : "m or rad", with));
}

void ClosedState::move_positions(std::span<const Target> targets) {
  if (targets.empty()) return;
  std::vector<Target> now(targets.begin(), targets.end()), cut;
  std::vector<double> begin;
  for (const Target& x : targets) begin.push_back(value(x));
  const int count = increments(targets);
  for (int k = 1; k <= count; ++k) {
    cut.clear();
    for (std::size_t i = 0; i < now.size(); ++i) {
      now[i].value =
          k == count ? targets[i].value : begin[i] + (targets[i].value - begin[i]) * k / count;
      value(now[i]) = now[i].value;
      if (!in_tree(now[i])) cut.push_back(now[i]);
    }
    f_.start(values_, t_, q_, v_);
    if (const double gap = close_positions(now, cut); !(gap < 1e-10))
      refuse(now, cut, gaps(cut), false);
    measure();
  }
  kinematics_at(f_, t_, q_, v_);
  for (const Target& x : targets)
    if (const double off = measured(x) - x.value;
        !(std::abs(off) < 1e-9 * (1.0 + std::abs(x.value))))
      throw RunError(ErrorCode::not_assembled,
                     fmt::format("{} cannot be set to {:.6g}: it is off by {:.3g}; its motion is "
                                 "prescribed, or it is no rotation vector of at most half a turn",
                                 name_of(values_, x), x.value, off));
}

void ClosedState::move_rates(std::span<const Target> targets) {
  std::vector<Target> cut;
  for (const Target& x : targets) {
    value(x) = x.value;
    if (!in_tree(x)) cut.push_back(x);
  }
  f_.start(values_, t_, q_, v_);
  const VecX begin = v_;
  VecX gap, rates(f_.constraints());
  for (const bool elastic : {false, true}) {
    v_ = begin;
    for (int pass = 0; pass < 4; ++pass) {
      kinematics_at(f_, t_, q_, v_);
      f_.constraint_rates(rates);
      gap.resize(rates.size() + std::ssize(cut));
      gap.head(rates.size()) = rates;
      for (Eigen::Index k = 0; k < std::ssize(cut); ++k)
        gap[rates.size() + k] = measured(cut[k]) - cut[k].value;
      if (gap.size() == 0 || pass == 3 || largest(gap) < 1e-14) break;
      v_ += least_change(rows(cut), weights(targets, elastic), -gap);
    }
    if (largest(gap) < 1e-9 * (1.0 + largest(v_))) break;
  }
  if (!(largest(gap) < 1e-8 * (1.0 + largest(v_)))) refuse(targets, cut, gap, true);
  kinematics_at(f_, t_, q_, v_);
  for (const Target& x : targets)
    if (const double off = measured(x) - x.value;
        !(std::abs(off) < 1e-7 * (1.0 + std::abs(x.value))))
      throw RunError(ErrorCode::not_assembled,
                     fmt::format("the rate of {} cannot be set to {:.6g}: it is off by {:.3g}; its "
                                 "motion is prescribed",
                                 name_of(values_, x), x.value, off));
  measure();
}

void ClosedState::write(SystemState& state) const {
  for (SystemState::Joint& kept : state.joints)
    for (const Joint& joint : values_.joints)
      if (joint.name == kept.name) {
        kept.position = joint.position;
        kept.velocity = joint.velocity;
      }
  for (SystemState::Body& kept : state.bodies)
    for (std::size_t i = 0; i < values_.bodies.size(); ++i)
      if (values_.bodies[i].name == kept.name) {
        kept.amplitudes = values_.amplitudes[i];
        kept.amplitude_rates = values_.amplitude_rates[i];
      }
}

}  // namespace

SystemState closed_state(const Model& model, InertiaMethod inertia, const SystemState& present,
                         std::span<const GivenState> given) {
  std::vector<Target> positions, rates;
  for (const GivenState& g : given) {
    Target x = target_of(model, g);
    (x.rate ? rates : positions).push_back(x);
  }
  ClosedState values(model, inertia, present);
  values.move_positions(positions);
  values.move_rates(rates);
  SystemState state = present;
  values.write(state);
  place_bodies(model, inertia, state);
  return state;
}

}  // namespace floatframe
