#pragma once
// A finite-element model from one program's file to another's, in the units of the file: a deck to
// compute with, a mesh to look at what was understood.
#include <filesystem>
#include <string>

#include "floatframe/parts/part_job.hpp"

namespace floatframe {

struct ConvertedMesh {
  std::string bytes;    ///< of the file to be written
  std::string summary;  ///< what was read and written, with the notes of both; lines
  /// Of the file that was read, and those that it includes.
  std::vector<std::string> files;
};

/// The ending of `out`, which is not written here, says the format: .inp, .msh or .vtu. `modes` of
/// the vibration step of a deck; 0: no step. Throws InputError.
ConvertedMesh convert_mesh_file(const PartJob& job, const std::filesystem::path& out, int modes);

/// The same, written to `out`, at once or not at all; the summary. Throws OutputError where it
/// cannot be written, InputError where it would replace a file that was read.
std::string save_converted_mesh(const PartJob& job, const std::string& out, int modes);

}  // namespace floatframe
