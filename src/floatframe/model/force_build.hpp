#pragma once
// Builds a force element of the model from its description. Load time only.
#include "floatframe/model/force_keys.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

struct ModelBuilder;

class ForceBuild : public ForceView {
 public:
  ForceBuild(ModelBuilder& builder, const ForceDescription& force);
  Force force;

  /// A marker at a place, with the design orientation R; -1 after an error, which is reported.
  /// `oriented`: its orientation matters.
  int marker(const std::string& key, bool oriented, const Mat3& R = Mat3::Identity()) const;
  /// The function of time and the input that drive the element.
  void actuate(const std::string& key);
  /// The keys `spring`, `damper` and `actuator`.
  void spring_damper_actuator();
  bool has_ends() const noexcept { return force.a >= 0 && force.b >= 0; }
  /// The keys `body`, `direction`, `magnitude` and `follows` of an applied load.
  bool load(bool oriented);
  Signal built_signal(const std::string& key) const;
  int road(const std::string& key) const;
  /// nullptr if the element itself has an error.
  const Joint* joint(const std::string& key) const;
  /// Of length 1.
  Vec3 unit_direction(const std::string& key) const;

 private:
  ModelBuilder& builder_;
};

}  // namespace floatframe
