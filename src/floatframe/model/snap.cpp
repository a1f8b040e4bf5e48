#include "floatframe/model/snap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/alignment.hpp"
#include "floatframe/model/joint_motion.hpp"

namespace floatframe {
namespace {

/// Larger deviations are intended [rad; relative to the size].
constexpr double widest_angle = 0.1, widest_distance = 0.03;
/// Deviations below the first value, too small for the thresholds of the mobility test, are scaled
/// to the second value for the test.
constexpr double min_test_deviation = 1e-4, scaled_deviation = 1e-3;
/// Above it dense linear algebra takes too long: such loops are not changed.
constexpr std::size_t most_bodies = 100;

/// The rotation vector from one frame to another, in its axes [rad].
Vec3 turn_between(const Mat3& from, const Mat3& to) {
  return quaternion_log(Eigen::Quaterniond(from.transpose() * to));
}

/// "'a', 'b' and 'c'", "'a', 'b', 'c', 'd' and 3 more"
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 6;
  const std::size_t shown = names.size() > most ? most - 1 : names.size();
  std::string text;
  for (std::size_t k = 0; k < shown; ++k)
    text += (k == 0 ? "'" : k + 1 == names.size() ? " and '" : ", '") + names[k] + "'";
  if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

/// One block of loops with its approximate relations.
class Snapping {
 public:
  Snapping(const Model& model, const LoopBlock& block)
      : model_(model), block_(block), alignment_(model, block) {
    for (const int b : block.bodies) bends_ = bends_ || model.bodies[b].modes() > 0;
  }

  /// The relations within tolerance that together give the loops finite degrees of freedom; only
  /// those needed for them. Empty: there are none.
  std::vector<Relation> freeing(double angle, double distance) const {
    std::vector<Relation> relations = alignment_.relations(angle, distance * alignment_.size());
    if (relations.empty() || !fits()) return {};
    const std::vector<JointPlace> exact = alignment_.aligned(relations);
    const double miss = farthest(exact);
    const double scale = miss > 0.0 && miss < min_test_deviation ? scaled_deviation / miss : 1.0;
    const int gained = freedoms(exact, exact, scale);
    if (gained == 0) return {};
    for (int k = std::ssize(relations); k-- > 0 && relations.size() > 1;) {
      std::vector<Relation> others = relations;
      others.erase(std::next(others.begin(), k));
      if (freedoms(alignment_.aligned(others), exact, scale) >= gained)
        relations = std::move(others);
    }
    return relations;
  }

  /// Some relation holds within tolerance but not exactly.
  bool any(double angle, double distance) const {
    return !alignment_.relations(angle, distance * alignment_.size()).empty();
  }

  /// The loops have no more degrees of freedom than the mobility count: nothing is locked.
  bool counted() const {
    int rows = 0;
    for (const int j : block_.joints) rows += 6 - joint_velocities(model_.joints[j].type);
    return 6 * std::ssize(block_.bodies) - (block_.grounded ? 0 : 6) - rows -
               std::ssize(block_.elements) >
           0;
  }

  std::vector<JointPlace> aligned(const std::vector<Relation>& relations) const {
    return alignment_.aligned(relations);
  }

  std::string snapped(const Relation& r, const std::vector<JointPlace>& places) const {
    const bool distance = by_distance(r);
    const int worst = *std::max_element(r.axes.begin(), r.axes.end(), [&](int a, int b) {
      return alignment_.moved(places, a, distance) < alignment_.moved(places, b, distance);
    });
    const double most = alignment_.moved(places, worst, distance);
    const std::vector<std::string> names = names_of(r.axes);
    return fmt::format(
        "the {} of joint{} {} {} made exactly {}: by up to {:.3g} {}{}, because as "
        "drawn the loop is locked (snap: false keeps it so)",
        names.size() == 1 ? "axis" : "axes", names.size() == 1 ? "" : "s", listed(names),
        names.size() == 1 ? "is" : "are", what(r), most, distance ? "m" : "rad",
        names.size() == 1 ? "" : fmt::format(" (joint '{}')", name_of(worst)));
  }

  LockedLoops locked(const std::vector<Relation>& relations) const {
    std::string text;
    for (const Relation& r : relations) text += (text.empty() ? "" : "; ") + missed(r);
    LockedLoops found;
    const Eigen::Index free = rigid_motions().cols();
    found.sentence = free == 0
                         ? fmt::format("0 degrees of freedom: {}, so that the loop is locked", text)
                         : fmt::format(
                               "{}: the loops of joints {} have {} degree{} of freedom, and more "
                               "without that",
                               text, listed(all_names()), free, free == 1 ? "" : "s");
    for (const int j : block_.joints) {
      const TimeFunction* motion = model_.motion_of(model_.joints[j]);
      found.driven =
          found.driven || (free == 0 && motion && changes(*motion, model_.simulation.duration));
    }
    return found;
  }

  const Alignment& alignment() const noexcept { return alignment_; }

 private:
  static bool by_distance(const Relation& r) {
    return r.kind == Relation::Kind::one_line || r.kind == Relation::Kind::one_point;
  }
  static const char* what(const Relation& r) {
    switch (r.kind) {
      case Relation::Kind::parallel:
        return "parallel";
      case Relation::Kind::perpendicular:
        return "perpendicular to other axes of the loop";
      case Relation::Kind::coplanar:
        return "coplanar";
      case Relation::Kind::one_line:
        return "those of one line";
      case Relation::Kind::one_point:
        return "such that they meet in one point";
    }
    return "";
  }
  std::string name_of(int axis) const {
    return model_.joints[block_.joints[alignment_.axes()[axis].joint]].name;
  }
  std::vector<std::string> names_of(const std::vector<int>& axes) const {
    std::vector<std::string> names;
    for (const int k : axes)
      if (names.empty() || names.back() != name_of(k)) names.push_back(name_of(k));
    return names;
  }
  std::vector<std::string> all_names() const {
    std::vector<std::string> names;
    for (const int j : block_.joints) names.push_back(model_.joints[j].name);
    return names;
  }

  /// "joint 'd' is 1 degree out of line with 'a', 'b' and 'c'": the one without which the others
  /// agree best.
  std::string missed(const Relation& r) const {
    const bool distance = by_distance(r);
    const auto of_others = [&](int axis) {
      std::vector<int> others = r.axes;
      std::erase(others, axis);
      return others;
    };
    int worst = r.axes.back();
    double least = std::numeric_limits<double>::infinity();
    for (const int k : r.axes) {
      Relation rest = r;
      rest.axes = of_others(k);
      if (rest.axes.size() < 2) break;
      const std::vector<JointPlace> places = alignment_.aligned({rest});
      double off = 0.0;
      for (const int m : rest.axes) off = std::max(off, alignment_.moved(places, m, distance));
      if (off < least) {
        least = off;
        worst = k;
      }
    }
    const bool alone = r.kind == Relation::Kind::perpendicular;
    const double off = alone ? alignment_.moved(alignment_.aligned({r}), worst, false)
                             : alignment_.miss(r, worst, of_others(worst));
    const std::string degrees = fmt::format("{:.3g}", off * 180.0 / std::numbers::pi);
    const std::string by = distance         ? fmt::format("{:.3g} m", off)
                           : degrees == "1" ? "1 degree"
                                            : degrees + " degrees";
    return fmt::format("joint '{}' is {} out of line with {}", name_of(worst), by,
                       alone ? "the other axes" : listed(names_of(of_others(worst))));
  }

  MatX rigid_motions() const {
    return LoopMobility(model_, block_, alignment_.drawn(), alignment_.size(), false).motions();
  }

  /// In the drawn configuration everything is in position.
  bool fits() const {
    const auto& [places, size] = std::pair(alignment_.drawn(), alignment_.size());
    return LoopMobility(model_, block_, places, size, false).misfit() < 1e-9;
  }

  /// Largest deviation of a position [rad; relative to the size].
  double farthest(const std::vector<JointPlace>& exact) const {
    double most = 0.0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
      const JointPlace& at = alignment_.drawn()[k];
      most =
          std::max({most, (at.p - exact[k].p).norm() / alignment_.size(),
                    turn_between(exact[k].R, at.R).norm(), (at.axis_2 - exact[k].axis_2).norm()});
    }
    return most;
  }

  /// The positions, with deviations from the exact ones multiplied by a factor.
  static std::vector<JointPlace> exaggerated(std::vector<JointPlace> places,
                                             const std::vector<JointPlace>& exact, double scale) {
    if (scale == 1.0) return places;
    for (std::size_t k = 0; k < places.size(); ++k) {
      JointPlace& at = places[k];
      const JointPlace& from = exact[k];
      at.p = from.p + scale * (at.p - from.p);
      at.R = from.R * rotation_exp(scale * turn_between(from.R, at.R));
      at.axis_2 = (from.axis_2 + scale * (at.axis_2 - from.axis_2)).normalized();
    }
    return places;
  }

  /// Additional finite degrees of freedom of the loops with these positions compared with the drawn
  /// ones; `scale`: factor of the deviations of both from the exact ones.
  int freedoms(const std::vector<JointPlace>& moved_places, const std::vector<JointPlace>& exact,
               double scale) const {
    const double size = alignment_.size();
    const std::vector<JointPlace> places = exaggerated(moved_places, exact, scale);
    const std::vector<JointPlace> as_drawn = exaggerated(alignment_.drawn(), exact, scale);
    if (bends_) {
      const LoopMobility drawn(model_, block_, as_drawn, size, true);
      const LoopMobility moved(model_, block_, places, size, true);
      if (moved.motions().cols() <= drawn.motions().cols()) return 0;
    }
    LoopMobility moved(model_, block_, places, size, false);
    if (scale != 1.0) {
      LoopMobility drawn_loops(model_, block_, as_drawn, size, false);
      constexpr double fine = 1e-8;
      const MatX none = MatX::Zero(moved.columns(), 0);
      return std::max(0, moved.lasting(none, fine, true) - drawn_loops.lasting(none, fine, true));
    }
    const MatX drawn = rigid_motions();
    if (moved.motions().cols() <= drawn.cols()) return 0;
    const int before = drawn.cols();
    return std::max(0, moved.lasting(drawn) - before);
  }

  const Model& model_;
  const LoopBlock& block_;
  Alignment alignment_;
  bool bends_ = false;
};

/// A separate marker for each moved frame: forces and other joints keep theirs.
void move_frames(Model& model, int index, const JointPlace& from, const JointPlace& to) {
  Joint& joint = model.joints[index];
  for (int* frame : {&joint.frame_F, &joint.frame_M}) {
    Marker m = model.markers[*frame];
    const Mat3 R_WB = m.body < 0 ? Mat3::Identity().eval() : model.bodies[m.body].X_WB.R;
    m.X_NM.p += R_WB.transpose() * (to.p - from.p);
    m.X_NM.R = R_WB.transpose() * to.R;
    *frame = std::ssize(model.markers);
    model.markers.push_back(m);
  }
  joint.axis_2 = to.axis_2;
  std::vector<int> motions = joint.motions;
  motions.push_back(joint.motion);
  for (const int motion : motions)
    if (motion >= 0) model.elements[motion].markers = {joint.frame_F, joint.frame_M};
}

}  // namespace

std::vector<std::string> snap_joints(Model& model, const SnapDescription& snap,
                                     std::vector<LockedLoops>& locked) {
  std::vector<std::string> notes;
  for (const LoopBlock& block : loop_blocks(model)) {
    if (block.joints.empty()) continue;
    const Snapping loops(model, block);
    if (block.bodies.size() > most_bodies) {
      if (snap.on && loops.any(snap.angle, snap.distance))
        notes.push_back(fmt::format(
            "axes of the loop of joint '{}' are nearly parallel or meet nearly, and stay as they "
            "are: loops of more than {} bodies are not looked at",
            model.joints[block.joints[0]].name, most_bodies));
      continue;
    }
    const std::vector<Relation> relations =
        snap.on ? loops.freeing(snap.angle, snap.distance) : std::vector<Relation>{};
    if (relations.empty()) {
      if (loops.counted()) continue;
      const std::vector<Relation> missed = loops.freeing(std::max(snap.angle, widest_angle),
                                                         std::max(snap.distance, widest_distance));
      if (!missed.empty()) locked.push_back(loops.locked(missed));
      continue;
    }
    const std::vector<JointPlace> places = loops.aligned(relations);
    for (const Relation& r : relations) notes.push_back(loops.snapped(r, places));
    for (std::size_t k = 0; k < places.size(); ++k) {
      const JointPlace& from = loops.alignment().drawn()[k];
      const JointPlace& to = places[k];
      if (from.p != to.p || from.R != to.R || from.axis_2 != to.axis_2)
        move_frames(model, block.joints[k], from, to);
    }
  }
  return notes;
}

}  // namespace floatframe
