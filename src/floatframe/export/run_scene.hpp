#pragma once
// The bodies of a run at its recorded instants, deformed, for programs that draw them: the grids
// that `floatframe export --vtk` writes (docs/export.md), one by one and without files.
//
//   RunScene scene(model, StateHistory("out/vehicle/states.ffr"));
//   const VtkGrid& grid = scene.at(scene.nearest(0.5));
#include <memory>

#include "floatframe/formats/vtk/vtk_file.hpp"
#include "floatframe/history/state_history.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

class RunScene {
 public:
  /// `model` must outlive this. Throws InputError if the states are not of this model or without an
  /// instant, RunError if the model cannot start.
  RunScene(const Model& model, StateHistory history);
  ~RunScene();
  RunScene(const RunScene&) = delete;
  RunScene& operator=(const RunScene&) = delete;

  std::size_t instants() const noexcept;
  /// The recorded instant nearest to a time [s], of two the earlier.
  std::size_t nearest(double time) const;
  /// All recorded bodies at an instant, world axes, SI units; valid until the next call. Its cells
  /// are always the same. Throws InputError if there is no such instant.
  const VtkGrid& at(std::size_t instant);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace floatframe
