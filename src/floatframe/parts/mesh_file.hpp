#pragma once
// Converts a finite-element model to the file of another program, in the units of the file: a deck
// to compute with, or a mesh to inspect how the file was interpreted.
#include <filesystem>
#include <string>

#include "floatframe/parts/part_job.hpp"

namespace floatframe {

struct ConvertedMesh {
  std::string bytes;    ///< of the file to be written
  std::string summary;  ///< what was read and written, with the notes of both; several lines
  /// The input file and the files that it includes.
  std::vector<std::string> files;
};

/// The extension of `out`, which is not written here, gives the format: .inp, .msh or .vtu.
/// `modes`: of the vibration step of a deck; 0: no step. Throws InputError.
ConvertedMesh convert_mesh_file(const PartJob& job, const std::filesystem::path& out, int modes);

/// The same, written to `out` atomically; returns the summary. Throws OutputError if it cannot be
/// written, InputError if it would replace an input file.
std::string save_converted_mesh(const PartJob& job, const std::string& out, int modes);

}  // namespace floatframe
