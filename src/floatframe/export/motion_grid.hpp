#pragma once
// All bodies of a model at an instant as one grid in world axes: their pictures, deformed, with
// displacement, deformation, velocity and, where it is known, stress (docs/export.md).
#include <vector>

#include "floatframe/export/body_picture.hpp"
#include "floatframe/export/export_file.hpp"
#include "floatframe/export/stress_field.hpp"
#include "floatframe/formats/vtk/vtk_file.hpp"

namespace floatframe {

class MotionGrid {
 public:
  explicit MotionGrid(const ExportBodies& bodies);

  /// The grid at an instant; valid until the next call. Its cells are always the same.
  const VtkGrid& at(const SystemMotion& motion);
  std::size_t points() const noexcept { return points_; }
  std::size_t bodies() const noexcept { return pictures_.size(); }

 private:
  void add_cells(const BodyPicture& picture, int body);
  void add_arrays();
  void place(std::size_t i, const BodyInstant& m, std::size_t first);
  void stress(std::size_t i, const BodyInstant& m, std::size_t first);

  ExportBodies bodies_;
  std::vector<BodyPicture> pictures_;
  std::vector<StressField> fields_;
  VtkGrid grid_;
  std::size_t points_ = 0;
  std::vector<std::int32_t> point_body_, point_node_, cell_body_, cell_drawn_;
  PictureMotion moved_;
};

}  // namespace floatframe
