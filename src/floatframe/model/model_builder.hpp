#pragma once
// The work of build_model in stages that share names, markers and the list of faults; each stage in
// the file of its subject (build_*.cpp).
#include <cmath>
#include <string>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// What is described has been checked by `validate`: faults are left to what shows only when bodies
/// are reduced.
struct ModelBuilder {
  static constexpr int ground_index = -1;
  static constexpr int unknown = -2;

  const ModelDescription& d;
  Model model;
  Faults faults;

  explicit ModelBuilder(const ModelDescription& description) : d(description) {}

  void bodies();
  void roads();
  void inputs();
  void joints();
  /// Bodies that no joint leads to from the ground hang from it by a free joint (the first in file
  /// order each time).
  void free_joints();
  void rods();
  void forces();
  void outputs();
  /// Refuses bodies whose modes have no inertia of their own.
  void modal_masses();
  /// Lengths and masses that scale the equations; start values of the modes.
  void finish();

  /// `ground_index`, or `unknown` and a fault.
  int body_index(const std::string& name, const SourceMark& mark, const std::string& who);
  /// A marker at a design point; -1 and a fault if the body or node does not exist. `oriented`: the
  /// marker's orientation matters, so the rotation of the node enters.
  int add_marker(const AttachmentDescription& at, const Mat3& R_design, bool oriented,
                 const SourceMark& mark, const std::string& who);
  /// Index of an input; -1 for no name.
  int input_index(const std::string& name) const;
  const Marker& marker(int index) const { return model.markers[static_cast<std::size_t>(index)]; }
  /// World place of a marker in the design configuration.
  Vec3 design_point(int marker) const;
};

/// v / |v|, also where |v|^2 overflows.
inline Vec3 unit_vector(const Vec3& v) {
  return std::isfinite(v.squaredNorm()) ? v.normalized() : v.stableNormalized();
}

/// "[1, 2, 3]"
std::string point_text(const Vec3& p);

}  // namespace floatframe
