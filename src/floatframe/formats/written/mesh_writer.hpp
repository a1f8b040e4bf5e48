#pragma once
// Finite-element models written for other programs, to inspect the result of a reader and to
// compute with it. Numbers are those of the model, in its units. A new format is one file and one
// entry in the list.
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

struct MeshWriteOptions {
  int modes = 20;  ///< of the vibration step of a deck; 0: no step
};

struct WrittenMesh {
  std::string bytes;
  std::vector<std::string> notes;  ///< one sentence each: data without equivalent in the format
};

struct MeshFormat {
  const char* name;         ///< "calculix"
  const char* description;  ///< "CalculiX deck (.inp)"
  const char* ending;       ///< ".inp"
  /// Throws InputError if what the format cannot hold would make it another model.
  WrittenMesh (*write)(const FeModel& model, const MeshWriteOptions& options);
};

std::span<const MeshFormat> mesh_formats();

/// By the ending of the file. Throws InputError with the known ones.
const MeshFormat& mesh_format_of(const std::filesystem::path& file);

}  // namespace floatframe
