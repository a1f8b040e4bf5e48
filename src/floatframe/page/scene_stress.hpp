#pragma once
// Stress in the scene of a page: for each vertex the stress of one place per modal amplitude, and
// the largest von Mises stress over the frames. A vertex shared by several places - sides of a
// shell, materials - shows the place that its modes load most; its largest value is that of all. If
// the frames have load coefficients (add_replayed_values) and these are significant, their stress
// is included. The writer puts it into the JSON of the page, with its numbers in the buffer
// (viewer/README.md).
#include <nlohmann/json.hpp>
#include <vector>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/page/page_writer.hpp"
#include "floatframe/page/scene_frames.hpp"

namespace floatframe {

/// Limit of stress numbers; beyond it the fields of a body are omitted from its page.
inline constexpr std::size_t most_numbers_of_stress = 12'000'000;

/// Per vertex and mode; empty if the body has no stress data or too much of it.
struct SceneStress {
  std::vector<int> places;                   ///< of each vertex, the place shown; -1: none
  std::vector<std::vector<int>> all_places;  ///< of each vertex, all places
  bool several = false;                      ///< some vertex has more than one
  std::size_t left_out = 0;                  ///< omitted numbers, if they are too many
  double factor = 1.0;                       ///< [Pa] of one unit in `modes`
  std::vector<float> modes;                  ///< vertices x modes x 6: xx yy zz xy yz zx
  std::vector<std::uint32_t> doubtful;
  bool empty() const noexcept { return modes.empty(); }
};
SceneStress scene_stress(const FlexibleBody& body);

/// Index of the place in [first, end) nearest to p; -1: there is none.
int nearest_place(const BodyStress& stress, int first, int end, const Vec3& p);

/// Stress per vertex and load coefficient, and its unit [Pa].
struct SceneLoads {
  double factor = 1.0;
  std::vector<float> loads;  ///< vertices x 12 x 6
};
SceneLoads scene_loads(const FlexibleBody& body, const SceneStress& stress);

/// Largest stress of the vertices [Pa], and its instant [s].
struct VertexEnvelope {
  std::vector<float> largest, when;
};
struct VertexEnvelopes {
  VertexEnvelope by_modes;
  VertexEnvelope with_loads;  ///< modes and loads; empty without load coefficients
};
/// `first`, `columns`: column of the body's amplitudes, number of all columns; `first_load`: column
/// of its load coefficients, -1: none.
VertexEnvelopes vertex_envelopes(const FlexibleBody& body, const SceneStress& stress,
                                 const SceneFrames& frames, std::size_t first, std::size_t columns,
                                 int first_load);

class SceneStressWriter {
 public:
  using Json = nlohmann::ordered_json;
  SceneStressWriter(const Model& model, const SceneFrames& frames, PageBuffer& buffer)
      : model_(model), frames_(frames), buffer_(buffer) {}

  /// Data shared by bodies of the same appearance.
  struct Shape {
    SceneStress stress;
    Json json;   ///< without the envelope, which belongs to a single body
    Json loads;  ///< once used by a body
    double loads_factor = 1.0;
  };
  Shape shape(const FlexibleBody& data);
  /// `first`: column of the amplitudes of the body.
  Json of(const FlexibleBody& data, Shape& shape, std::size_t first, std::size_t body);

  /// Appends to the amplitudes of a frame the load coefficients of the stress shown.
  void append_loads(std::size_t frame, std::vector<float>& row) const;

 private:
  void add_loads(const FlexibleBody& data, Shape& shape);

  struct LoadColumn {
    std::size_t column;  ///< of SceneFrames::loads
    double scale;        ///< scales it to the weight of an amplitude
  };
  const Model& model_;
  const SceneFrames& frames_;
  PageBuffer& buffer_;
  std::vector<LoadColumn> columns_;
};

}  // namespace floatframe
