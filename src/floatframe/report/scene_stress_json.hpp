#pragma once
// The stress of the bodies of a page, as JSON with its numbers in the buffer of the page
// (viewer/README.md).
#include <nlohmann/json.hpp>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/report/page_writer.hpp"
#include "floatframe/report/scene_frames.hpp"
#include "floatframe/report/scene_stress.hpp"

namespace floatframe {

class SceneStressWriter {
 public:
  using Json = nlohmann::ordered_json;
  SceneStressWriter(const Model& model, const SceneFrames& frames, PageBuffer& buffer)
      : model_(model), frames_(frames), buffer_(buffer) {}

  /// What bodies that look alike share.
  struct Shape {
    SceneStress stress;
    Json json;   ///< without the envelope, which is of one body
    Json loads;  ///< once a body needs them
    double loads_factor = 1.0;
  };
  Shape shape(const FlexibleBody& data);
  /// `first`: column of the amplitudes of the body.
  Json of(const FlexibleBody& data, Shape& shape, std::size_t first, std::size_t body);

  /// What stands behind the amplitudes of a frame: the load coefficients that are shown.
  void append_loads(std::size_t frame, std::vector<float>& row) const;

 private:
  void add_loads(const FlexibleBody& data, Shape& shape);

  struct LoadColumn {
    std::size_t column;  ///< of SceneFrames::loads
    double scale;        ///< so that it counts as an amplitude does
  };
  const Model& model_;
  const SceneFrames& frames_;
  PageBuffer& buffer_;
  std::vector<LoadColumn> columns_;
};

}  // namespace floatframe
