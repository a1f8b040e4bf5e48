#pragma once
// Stress of what a page draws: of each vertex the stress of one place per modal amplitude, and the
// largest von Mises stress over the frames. A vertex at which several places meet - sides of a
// shell, materials, points of a section - shows the one that its modes load most. By the modes
// alone: what the own inertia of a body adds (body_stress.hpp) is left to gauges and
// `floatframe stress`.
#include <nlohmann/json_fwd.hpp>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/report/page_writer.hpp"
#include "floatframe/report/scene_frames.hpp"

namespace floatframe {

/// Above so many numbers of stress the fields of a body are left out of its page.
inline constexpr std::size_t most_numbers_of_stress = 12'000'000;

/// Per vertex and mode; none if the body knows no stress or has too much of it.
struct SceneStress {
  std::vector<int> places;   ///< of each vertex; -1: none
  double factor = 1.0;       ///< [Pa] of one unit in `modes`
  std::vector<float> modes;  ///< vertices x modes x 6: xx yy zz xy yz zx
  std::vector<std::uint32_t> doubtful;
  bool empty() const noexcept { return modes.empty(); }
};
SceneStress scene_stress(const FlexibleBody& body);

/// Of the vertices [Pa], and when [s]. `first`: column of the amplitudes of the body.
struct VertexEnvelope {
  std::vector<float> largest, when;
};
VertexEnvelope vertex_envelope(const FlexibleBody& body, const SceneStress& stress,
                               const SceneFrames& frames, std::size_t first, std::size_t columns);

}  // namespace floatframe
