#include "floatframe/loops/loop_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "floatframe/math/union_find.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/joint_measure.hpp"

namespace floatframe {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double largest_turn = 0.05, largest_move = 0.01;  // of an increment; [rad], of the size

double whole_turns(double angle) { return turn * std::round(angle / turn); }

}  // namespace

/// Differences between the start of a path, s = 0, and its end, s = 1.
struct LoopPath::Stage {
  LoopEquations equations;
  std::vector<char> counts = {};   ///< constraints that hold on this path
  VecX open = {};                  ///< of constraints at s = 0
  std::vector<Vec3> from = {};     ///< of each value; of rotations the vector of R R_given^T
  std::vector<double> turns = {};  ///< 2 pi scale of constraints on angles, else 0
  int increments = 1;
  VecX x_before = {};  ///< last increment, for s_before
  double s_before = 0.0;
  bool leaves_motions = false;  ///< constraints and values do not determine all
  Eigen::Index rank = 0;        ///< the largest so far

  VecX residual(const RelativeFormulation& f, double s) const {
    VecX r = f.constraint_values() - (1.0 - s) * open;
    for (Eigen::Index i = 0; i < r.size(); ++i)
      if (turns[i] > 0.0) r[i] = std::remainder(r[i], turns[i]);
    return r;
  }
  VecX off(const RelativeFormulation& f, double s) const;
};

namespace {

Mat3 relative_rotation(const RelativeFormulation& f, const Joint& joint) {
  return f.marker(joint.frame_F).R.transpose() * f.marker(joint.frame_M).R;
}

Vec3 rotation_log(const Mat3& R) { return quaternion_log(Eigen::Quaterniond(R)); }

/// Start of a value.
Vec3 present(const RelativeFormulation& f, const LoopValue& v) {
  if (v.count == 3)
    return rotation_log(relative_rotation(f, f.model().joints[v.joint]) *
                        rotation_exp(v.given).transpose());
  return {measured(f, v, v.angle ? whole_turns(v.given[0]) : 0.0), 0.0, 0.0};
}

}  // namespace

VecX LoopPath::Stage::off(const RelativeFormulation& f, double s) const {
  VecX off(std::accumulate(equations.values().begin(), equations.values().end(), 0,
                           [](int n, const LoopValue& v) { return n + v.count; }));
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < equations.values().size(); ++i) {
    const LoopValue& v = equations.values()[i];
    if (v.count == 3) {
      const Joint& joint = f.model().joints[v.joint];
      const Mat3 wanted = rotation_exp((1.0 - s) * from[i]) * rotation_exp(v.given);
      off.segment<3>(row) = rotation_log(relative_rotation(f, joint) * wanted.transpose());
    } else {
      const double wanted = from[i][0] + s * (v.given[0] - from[i][0]);
      off[row] = measured(f, v, wanted) - wanted;
    }
    row += v.count;
  }
  return off;
}

LoopPath::LoopPath(RelativeFormulation& f, double t)
    : f_(f),
      t_(t),
      angles_(f.spring_angles().begin(), f.spring_angles().end()),
      members_(loop_members(f)) {}

void LoopPath::measure_size() {
  f_.positions(t_, drawn());
  Eigen::AlignedBox3d box;
  for (std::size_t j = 0; j < f_.model().joints.size(); ++j)
    if (members_.joint[j]) box.extend(f_.marker(f_.model().joints[j].frame_M).r);
  for (const Element& e : f_.model().elements)
    if (e.links())
      for (const int marker : e.markers) box.extend(f_.marker(marker).r);
  size_ = box.isEmpty() ? 0.0 : box.diagonal().norm();
  for (std::size_t i = 0; i < members_.body.size(); ++i)
    if (members_.body[i]) size_ = std::max(size_, f_.model().bodies[i].length);
}

bool LoopPath::starts_as_drawn() const {
  const Model& model = f_.model();
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const Joint& joint = model.joints[j];
    if (!members_.joint[j]) continue;
    for (int k = 0; k < joint_velocities(joint.type); ++k)
      if (const TimeFunction* motion = model.motion_of(joint, k))
        if (evaluate(*motion, t_).f != 0.0) return false;
    for (const double x : joint.position)
      if (x != 0.0) return false;
  }
  for (std::size_t i = 0; i < members_.body.size(); ++i)
    if (members_.body[i] && !model.amplitudes[i].isZero(0.0)) return false;
  return true;
}

bool LoopPath::closes(const VecX& q) {
  f_.set_spring_angles(angles_);
  kinematics_at(f_, t_, q, VecX::Zero(f_.velocities()));
  return largest(f_.constraint_values()) < 1e-10;
}

bool LoopPath::all_given() const {
  // Bodies in loops that are fixed to each other by values; ground: 0.
  const std::vector<Joint>& joints = f_.model().joints;
  UnionFind groups(static_cast<int>(members_.body.size()) + 1);
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (members_.joint[j] && (!joints[j].position.empty() || joints[j].motion >= 0 ||
                              joint_velocities(joints[j].type) == 0))
      groups.join(joints[j].child + 1, joints[j].parent + 1);
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (members_.joint[j] && groups.root(joints[j].child + 1) != groups.root(joints[j].parent + 1))
      return false;
  return true;
}

VecX LoopPath::drawn() const {
  Model model = f_.model();
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (!members_.joint[j]) continue;
    Joint& joint = model.joints[j];
    for (int k = 0; k < joint_velocities(joint.type); ++k)
      if (const TimeFunction* motion = model.motion_of(joint, k)) {
        joint.position.resize(joint_velocities(joint.type), 0.0);
        joint.position[k] = evaluate(*motion, t_).f;
      }
    joint.motion = -1;
    joint.motions.clear();
    const JointKind& kind = joint_kind(joint.type);
    for (int k = 0; k < std::ssize(joint.position); ++k) {
      const bool turns =
          kind.rotation_vector < 0 && kind.coordinates.all()[k].unit == JointUnit::rad;
      joint.position[k] = turns ? whole_turns(joint.position[k]) : 0.0;
    }
  }
  VecX q, v;
  for (std::size_t i = 0; i < members_.body.size(); ++i)
    if (members_.body[i]) model.amplitudes[i].setZero();
  f_.tree().start(model, t_, q, v);
  return q;
}

LoopPath::Stage LoopPath::begin(const VecX& q, std::vector<LoopValue> values, bool motions,
                                LoopMoves moves, bool keeps) {
  if (size_ == 0.0) measure_size();
  const ConstraintSet& set = f_.constraint_set();
  const VecX rest = VecX::Zero(f_.velocities());
  f_.set_spring_angles(angles_);
  kinematics_at(f_, t_, q, rest);
  Stage s{LoopEquations(f_, members_, std::move(values), moves, keeps)};
  s.open = f_.constraint_values();
  s.x_before = rest;
  double parts = 1.0;
  for (std::size_t k = 0; k < set.parts().size(); ++k) {
    const ConstraintPart& p = set.parts()[k];
    if (p.continues) continue;
    const bool angle = constraint_kind(p.type).angle, counts = p.motion == nullptr || motions;
    for (int r = 0; r < p.rows(); ++r) {
      s.counts.push_back(counts);
      s.turns.push_back(angle ? turn * p.scale : 0.0);
    }
    auto open = s.open.segment(set.offset(k), p.rows());
    if (!counts) open.setZero();
    const double most = largest(open);
    parts = std::max(parts, angle ? most / p.scale / largest_turn : most / size_ / largest_move);
  }
  for (const LoopValue& v : s.equations.values()) {
    const Vec3 here = present(f_, v);
    s.from.push_back(here);
    if (v.joint < 0) continue;
    const double way = v.count == 3 ? here.norm() : std::abs(here[0] - v.given[0]);
    parts = std::max(parts, v.angle ? way / largest_turn : way / size_ / largest_move);
  }
  s.increments = static_cast<int>(std::ceil(std::min(parts, 2000.0) - 1e-6));
  return s;
}

bool LoopPath::follow(VecX& q, LoopMoves moves, bool keeps) {
  reached_ = 0.0;
  Stage lengths = begin(q, {}, false, moves, keeps);
  drawn_closes_ = !(largest(lengths.open) > 1e-13 * size_) || lead(lengths, q);
  return drawn_closes_ && correct(q, moves, keeps);
}

bool LoopPath::correct(VecX& q, LoopMoves moves, bool keeps) {
  reached_ = 0.0;
  Stage values = begin(q, loop_values(f_, members_, false), true, moves, keeps);
  return lead(values, q);
}

bool LoopPath::lead(Stage& stage, VecX& q) {
  // From a distant start the nearest configuration may be on another branch: then all increments
  // are smaller.
  const VecX q_start = q;
  for (int attempt = 0; attempt < 3; ++attempt, stage.increments *= 4) {
    q = q_start;
    f_.set_spring_angles(angles_);
    stage.s_before = 0.0;
    if (lead_in_increments(stage, q)) return true;
    if (!stage.leaves_motions) break;
  }
  return false;
}

bool LoopPath::lead_in_increments(Stage& stage, VecX& q) {
  VecX q_new = q;
  for (int k = 0; k < stage.increments; ++k) {
    kinematics_at(f_, t_, q, VecX::Zero(f_.velocities()));
    stage.equations.begin_here();
    // Parts of an increment also move the bodies as little as possible from its beginning: the
    // result does not depend on them.
    double part = 1.0;
    for (double done = 0.0; done < 1.0;) {
      const double next = done + part > 1.0 - 1e-9 ? 1.0 : done + part;
      const auto share = [&](double x) { return (k + x) / stage.increments; };
      if (increment(stage, q, share(done), share(next), q_new)) {
        q = q_new;
        done = next;
        reached_ = share(done);
        part = std::min(2.0 * part, 1.0);
      } else {
        part *= 0.5;
        if (part < 1.0 / 256.0) return false;
      }
    }
  }
  return true;
}

bool LoopPath::increment(Stage& stage, const VecX& q, double from, double to, VecX& q_new) {
  LoopEquations& equations = stage.equations;
  const VecX rest = VecX::Zero(f_.velocities());
  const auto evaluate_at = [&](const VecX& there) {
    kinematics_at(f_, t_, there, rest);
    equations.evaluate(stage.residual(f_, to), stage.counts, stage.off(f_, to), rest);
  };
  evaluate_at(q);
  const VecX d_before = equations.displacement();
  const VecX along =
      stage.s_before > 0.0 ? VecX((to - from) / stage.s_before * stage.x_before) : rest;
  LoopEquations::Step step = equations.step(along, nullptr);
  const Eigen::Index rank = std::max(stage.rank, step.rank);
  const VecX predicted = equations.moved(step.x);
  VecX x = step.x, q_next = q;
  f_.retract(q, x, q_new);
  bool closed = false;
  double least = std::numeric_limits<double>::infinity();
  for (int pass = 0, idle = 0; pass < 100 && !closed; ++pass) {
    evaluate_at(q_new);
    const VecX d = equations.displacement();
    // In singular positions instantaneously free motions are continued as before.
    step = equations.step(rest, nullptr);
    if (step.rank >= rank && step.free > 0) step = equations.step(rest, &d);
    stage.leaves_motions = step.free > 0;
    if (!(largest(step.x) < 1.0)) return false;
    const double size = equations.moved(step.x).norm() / equations.scale();
    idle = size < 0.9 * least ? 0 : idle + 1;
    least = std::min(least, size);
    // At a singular position coordinates are only accurate to the root of rounding; elsewhere
    // passes end when they no longer improve.
    closed = equations.violation() < 1e-12 * size_ &&
             (size < 1e-13 || (size < 1e-8 && idle > 5) ||
              (step.free == 0 && equations.violation() < 1e-14 * size_));
    if (!closed && idle > 10) return false;
    f_.retract(q_new, step.x, q_next);
    f_.tree().advance(x, step.x);
    q_new = q_next;
  }
  if (!closed) return false;
  const VecX d = equations.displacement() - d_before;
  if ((d - predicted).norm() > 0.5 * predicted.norm() + 1e-7 * equations.scale()) return false;
  stage.rank = rank;
  stage.x_before = x;
  stage.s_before = to - from;
  return true;
}

VecX LoopPath::gap(VecX& q) {
  Stage values = begin(q, loop_values(f_, members_, false), true, LoopMoves::joints, true);
  const VecX rest = VecX::Zero(f_.velocities());
  VecX q_new = q;
  for (int pass = 0; pass < 100; ++pass) {
    kinematics_at(f_, t_, q, rest);
    values.equations.evaluate(values.residual(f_, 1.0), values.counts, values.off(f_, 1.0), rest);
    VecX x = values.equations.nearest();
    const double size = largest(x);
    if (!std::isfinite(size) || size < 1e-9) break;
    if (size > 0.2) x *= 0.2 / size;
    f_.retract(q, x, q_new);
    q = q_new;
  }
  kinematics_at(f_, t_, q, rest);
  return f_.constraint_values();
}

bool LoopPath::contradictory(const VecX& q) {
  const VecX rest = VecX::Zero(f_.velocities());
  const std::vector<LoopValue> values = loop_values(f_, members_, false);
  Eigen::Index rank[2] = {}, count = 0;
  for (const LoopValue& v : values) count += v.count;
  for (const LoopMoves moves : {LoopMoves::modes, LoopMoves::values}) {
    Stage s = begin(q, values, true, moves, false);
    s.equations.evaluate(s.open, s.counts, s.off(f_, 0.0), rest);
    rank[moves == LoopMoves::values] = s.equations.step(rest, nullptr).rank;
  }
  return rank[0] < rank[1] + count;
}

bool LoopPath::closed(const VecX& q) {
  f_.positions(t_, q);
  const Stage values = begin(q, loop_values(f_, members_, false), true, LoopMoves::joints, true);
  return largest(values.open) < 1e-10 && largest(values.off(f_, 1.0)) < 1e-10;
}

bool LoopPath::near(const VecX& from, const VecX& to) {
  std::vector<Mat3> R;
  std::vector<Vec3> p;
  const VecX rest = VecX::Zero(f_.velocities());
  kinematics_at(f_, t_, from, rest);
  for (const BodyKinematics& b : f_.motion().bodies) {
    R.push_back(b.R_WB);
    p.push_back(b.p_WB);
  }
  kinematics_at(f_, t_, to, rest);
  const std::vector<BodyKinematics>& moved = f_.motion().bodies;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (rotation_log(R[i].transpose() * moved[i].R_WB).norm() > largest_turn ||
        (moved[i].p_WB - p[i]).norm() > largest_move * size_)
      return false;
  return true;
}

bool LoopPath::upright(const VecX& q) {
  f_.positions(t_, q);
  for (const int j : f_.tree().topology().cut_joints) {
    const Joint& joint = f_.model().joints[j];
    double position[6] = {}, configuration[7] = {};
    for (int k = 0; k < joint_velocities(joint.type); ++k)
      position[k] =
          joint_position(joint, f_.marker(joint.frame_F), f_.marker(joint.frame_M), k, 0.0);
    joint_configuration(joint.type, position, configuration);
    JointMotion m;
    joint_motion(joint.type, {Vec3::UnitZ(), joint.axis_2}, configuration, m);
    if ((m.R_FM.transpose() * relative_rotation(f_, joint)).trace() < 1.0) return false;
  }
  return true;
}

}  // namespace floatframe
