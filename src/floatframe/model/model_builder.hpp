#pragma once
// The work of build_model in stages that share names, markers and the list of errors; each stage in
// the file of its subject (build_*.cpp).
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "floatframe/model/model.hpp"
#include "floatframe/model/name_index.hpp"

namespace floatframe {

class FlexibleBuilder;

/// What is described has been checked by `validate`: errors are left to what shows only when bodies
/// are reduced.
struct ModelBuilder {
  static constexpr int ground_index = -1;

  const ModelDescription& d;
  const NameIndex body_names, road_names, input_names;
  NameIndex joint_names, force_names, rod_names;  ///< of those that are built
  /// Body, node, whether it turns with the node, place and orientation of each marker on a body.
  std::map<std::array<double, 15>, int> marker_places;
  Model model;
  ErrorList errors;
  std::set<std::string> wrong_gauges;  ///< places and what is wrong with them

  explicit ModelBuilder(const ModelDescription& description)
      : d(description),
        body_names(description.bodies),
        road_names(description.roads),
        input_names(description.inputs) {}

  void bodies(FlexibleBuilder& flexible);
  void stiffening(const BodyDescription& b, Body& body);
  void roads();
  void inputs();
  void joints();
  /// Bodies that no joint leads to from the ground hang from it by a free joint (the first in file
  /// order each time).
  void free_joints();
  void rods();
  void forces();
  void outputs();
  /// What a joint or rod transmits: false if something it refers to is missing.
  bool reaction(const OutputDescription& o, Output& out, const std::string& who);
  /// Where stress is taken: false, and an error, if there is none.
  bool gauge(const OutputDescription& o, Output& out, const std::string& who);
  /// Refuses bodies whose modes have no inertia of their own.
  void modal_masses();
  /// Lengths and masses that scale the equations; start values of the modes.
  void finish();

  /// `ground_index` for the ground.
  int body_index(const std::string& name) const;
  /// A marker at a design point; -1 and an error if the body has no such node. `oriented`: the
  /// marker's orientation matters, so the rotation of the node enters. The error is one of "who.at"
  /// or of "who.node_key".
  int add_marker(const AttachmentDescription& at, const Mat3& R_design, bool oriented,
                 const SourceMark& mark, const std::string& who, const char* node_key = "node");
  const Marker& marker(int index) const { return model.markers[index]; }
  /// World place of a marker in the design configuration.
  Vec3 design_point(int marker) const;
};

/// v / |v|, also where |v|^2 overflows.
inline Vec3 unit_vector(const Vec3& v) {
  const double square = v.squaredNorm();  // overflows, or is zero of tiny components
  return std::isfinite(square) && square > 1e-280 ? v.normalized()
                                                  : (v / v.cwiseAbs().maxCoeff()).normalized();
}

}  // namespace floatframe
