#pragma once
// What of an envelope is looked at first. A hot spot is a node that is hotter than all next to it:
// on the surface those it shares a triangle with, on beams the other end of an element. A node
// whose stress is not to be trusted does not hide the trusted ones beside it. Of the places of a
// node - sides, materials, points of a section - the worst speaks for it.
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

/// The `top` hottest that are to be trusted, and those among and above them that are not (again
/// `top` at most). Descending.
std::vector<HotSpot> hot_spots(const FlexibleBody& body, const StressEnvelope& envelope, int top);

/// The largest magnitude of a section force in a body and where it is.
struct SectionPeak {
  int component = 0;  ///< of N Vy Vz T My Mz
  int section = -1;   ///< of BodyStress::sections
  double value = 0.0, time = 0.0;
};
/// One of each component; none without beams.
std::vector<SectionPeak> section_peaks(const BodyStress& stress, const StressEnvelope& envelope);

/// "N", and its unit.
const char* section_force_name(int component) noexcept;
const char* section_force_unit(int component) noexcept;
const char* layer_name(StressPlace::Layer layer) noexcept;
/// Of a StressPlace or BeamSectionPlace: in a part its number in the finite-element file; of bars
/// its name, or "#" and its place among the nodes.
std::string stress_node_text(const FlexibleBody& body, int node, int number);

}  // namespace floatframe
