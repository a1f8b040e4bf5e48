#pragma once
// A motion in a file of another program (docs/export.md): it takes the instants one after the other
// and is written when it is complete.
#include <memory>
#include <string>
#include <vector>

#include "floatframe/model/output_view.hpp"

namespace floatframe {

/// What is exported: bodies of the model, ascending, at so many instants.
struct ExportBodies {
  const Model* model = nullptr;
  std::vector<int> bodies;
  std::size_t instants = 0;  ///< how many will be added
  /// The i-th of them.
  const Body& body(std::size_t i) const {
    return model->bodies[static_cast<std::size_t>(bodies[i])];
  }
};

class ExportFile {
 public:
  virtual ~ExportFile() = default;
  /// The next instant. Throws OutputError if what is written meanwhile cannot be.
  virtual void add(const OutputView& view) = 0;
  /// Writes the file; what was written, in a few words. Throws OutputError, or InputError if it
  /// would be larger than its format allows.
  virtual std::string finish() = 0;
};

// Each file is written by `finish`, and nothing before, but for the grids of a series.

/// A glTF 2.0 scene in one file (.glb), y up: a node for each body with its translation and
/// rotation animated, its modes as morph targets with animated weights (docs/export.md). glTF holds
/// floats: a target is a mode times the largest amplitude of the motion, in metres (morph_targets),
/// and a scene far from the origin of the world has one of its own. What bends as y^T h y
/// (geometric stiffening) is exact too: a target for each product of two amplitudes that moves a
/// point visibly.
std::unique_ptr<ExportFile> glb_scene(const ExportBodies& bodies, const std::string& path);

/// Arrays of NumPy (.npz): members "time", "bodies" and for each body "NAME/position" and so on.
/// `stress`: also that of all places of bodies that know it. Throws InputError if the file would be
/// larger than its format allows.
std::unique_ptr<ExportFile> numpy_archive(const ExportBodies& bodies, const std::string& path,
                                          bool stress);

/// One long table (.csv) with a row for each instant, body and named node.
std::unique_ptr<ExportFile> motion_table(const ExportBodies& bodies, const std::string& path);

/// A series of .vtu files with a .pvd: a grid for each instant with all bodies, deformed, in world
/// axes. Makes the folder. Files of an earlier series there are replaced or removed, its .pvd first
/// and the new one written last: what it names is there. Throws OutputError.
std::unique_ptr<ExportFile> vtk_series(const ExportBodies& bodies, const std::string& folder);
/// True for the names of the files of a series: those that another one replaces or removes.
bool is_file_of_series(const std::string& name);

}  // namespace floatframe
