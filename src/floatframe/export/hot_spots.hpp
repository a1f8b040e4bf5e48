#pragma once
// The critical nodes of an envelope. A hot spot is a node with a larger stress than all its
// neighbours: on the surface those that share a triangle, on beams the other end of an element. A
// node with doubtful stress does not hide reliable neighbours. Of the places of a node - sides,
// materials, points of a section - the largest stress is used.
#include <string>
#include <vector>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/export/stress_envelope.hpp"

namespace floatframe {

struct HotSpot {
  int place = -1;  ///< of BodyStress::places
  bool doubtful = false;
  double von_mises = 0.0, time = 0.0;
  Vec3 principal = Vec3::Zero();  ///< at that time, descending [Pa]
};

/// The `top` largest reliable ones, and the doubtful ones among and above them (again at most
/// `top`). Descending.
std::vector<HotSpot> hot_spots(const FlexibleBody& body, const StressEnvelope& envelope, int top);

/// The largest magnitude of a section force in a body and its location.
struct SectionPeak {
  int component = 0;  ///< of N Vy Vz T My Mz
  int section = -1;   ///< of BodyStress::sections
  double value = 0.0, time = 0.0;
};
/// One per component; none without beams.
std::vector<SectionPeak> section_peaks(const BodyStress& stress, const StressEnvelope& envelope);

/// "N", without its unit.
const char* section_force_name(int component) noexcept;
const char* section_force_unit(int component) noexcept;
const char* layer_name(StressPlace::Layer layer) noexcept;
/// Node of a StressPlace or BeamSectionPlace: for a part its number in the finite-element file; for
/// bars its name, or "#" and its index among the nodes.
std::string stress_node_text(const FlexibleBody& body, int node, int number);

}  // namespace floatframe
