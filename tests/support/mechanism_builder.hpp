#pragma once
// How a random mechanism is put together: bodies one by one, each with the places where joints and
// forces may attach. Used by random_mechanism.cpp only.
#include <string>
#include <utility>
#include <vector>

#include "support/random_mechanism.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {

class MechanismBuilder {
 public:
  explicit MechanismBuilder(unsigned seed);

  Random random;
  Mechanism m;
  ModelDescription& d = m.description;
  /// Mass models that the inertia methods of this mechanism admit.
  std::vector<MassModel> mass_models;

  bool chance(double probability) { return random(0.0, 1.0) < probability; }
  /// 0 .. count - 1
  int pick(int count) {
    const int k = static_cast<int>(random(0.0, static_cast<double>(count)));
    return k < count ? k : count - 1;
  }
  Vec3 direction();
  int bodies() const { return static_cast<int>(d.bodies.size()); }
  const std::string& name(int body) const;
  double mass(int body) const { return body < 0 ? 1.0 : masses_[body]; }

  /// A body that has a place at the world point `at`; its index.
  int add_body(const Vec3& at);
  /// A body with places at two points of the world.
  int add_link(const Vec3& from, const Vec3& to);
  int add_rigid(const Vec3& at);

  /// Somewhere on a body (a node of a flexible one) or, with -1, near the origin on the ground.
  AttachmentDescription somewhere(int body);
  /// At a point of the world, which must be a node of a flexible body.
  AttachmentDescription at(int body, const Vec3& point) const;
  bool is_flexible(int body) const { return body >= 0 && !nodes_[body].empty(); }

  /// A joint between places at one point; start values, a drive or a cut may be added.
  JointDescription& add_joint(JointType type, const AttachmentDescription& parent,
                              const AttachmentDescription& child);
  /// A body on a random joint to body `parent`, and whatever comes after it: start values, drives.
  void add_branch(int parent);
  /// A joint or rod between two bodies that are there already. False if they cannot meet.
  bool close_somewhere();
  void planar_loop();
  void spatial_loop();
  void start_values(JointDescription& j, double position, double velocity);

  // Forces (mechanism_forces.cpp).
  void add_maxwell();
  PiecewisePolynomial spring_law(double stiffness, double free);
  PiecewisePolynomial damper_law(double damping);
  TimeFunction time_function(double scale);
  TimeFunction motion();
  SignalDescription signal(double scale);
  void add_force();
  void add_outputs();

 private:
  using Nodes = std::vector<std::pair<std::string, Vec3>>;  ///< names and places in the body frame
  void add_given(BodyDescription& b, Nodes& nodes);
  FlexibleDescription bar_frame(double length, bool straight, Nodes& nodes);
  int add_bars(const Vec3& at, const Vec3* to);
  int add_known(BodyDescription b, Nodes nodes, double mass);
  void add_tyre(ElementDescription& f);

  std::vector<Nodes> nodes_;  ///< of flexible bodies; empty for rigid ones
  std::vector<double> masses_;
  int joint_count_ = 0;
};

}  // namespace floatframe::test
