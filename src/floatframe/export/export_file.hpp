#pragma once
// A motion in a file of another program (docs/export.md): receives the instants in sequence and is
// written when it is complete.
#include <memory>
#include <string>
#include <vector>

#include "floatframe/model/system_motion.hpp"

namespace floatframe {

/// Exported bodies of the model, in ascending order, and the number of instants.
struct ExportBodies {
  const Model* model = nullptr;
  std::vector<int> bodies;
  std::size_t instants = 0;  ///< number of instants that will be added
  /// The i-th body.
  const Body& body(std::size_t i) const {
    return model->bodies[static_cast<std::size_t>(bodies[i])];
  }
};

class ExportFile {
 public:
  virtual ~ExportFile() = default;
  /// Adds the next instant. Throws OutputError if data cannot be written meanwhile.
  virtual void add(const SystemMotion& motion) = 0;
  /// Writes the file; returns a short description of it. Throws OutputError, or InputError if it
  /// would be larger than its format allows.
  virtual std::string finish() = 0;
};

// `finish` writes each file; only the grids of a series are written earlier.

/// A glTF 2.0 scene in one file (.glb), y up: a node for each body with its translation and
/// rotation animated, its modes as morph targets with animated weights (docs/export.md). glTF
/// stores floats: a target is a mode times the largest amplitude of the motion, in metres
/// (morph_targets), and a scene far from the origin of the world gets a local origin. Deformation
/// y^T h y (geometric stiffening) is exact too: a target for each product of two amplitudes with a
/// visible displacement.
std::unique_ptr<ExportFile> glb_scene(const ExportBodies& bodies, const std::string& path);

/// Arrays of NumPy (.npz): members "time", "bodies" and for each body "NAME/position" and so on.
/// `stress`: also that of all places of bodies with stress data. Throws InputError if the file
/// would be larger than its format allows.
std::unique_ptr<ExportFile> numpy_archive(const ExportBodies& bodies, const std::string& path,
                                          bool stress);

/// One long table (.csv) with a row for each instant, body and named node.
std::unique_ptr<ExportFile> motion_table(const ExportBodies& bodies, const std::string& path);

/// A series of .vtu files with a .pvd: a grid for each instant with all bodies, deformed, in world
/// axes. Creates the folder. Files of an earlier series are replaced or removed, the .pvd first;
/// the new one is written last, when all files that it names exist. Throws OutputError.
std::unique_ptr<ExportFile> vtk_series(const ExportBodies& bodies, const std::string& folder);
/// True for names of files of a series, which another series replaces or removes.
bool is_file_of_series(const std::string& name);

}  // namespace floatframe
