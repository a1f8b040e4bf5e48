#pragma once
// A motion as a series of .vtu files with a .pvd (docs/export.md): a grid for each instant with all
// bodies, deformed, in world axes.
#include <memory>
#include <string>

#include "floatframe/export/export_file.hpp"

namespace floatframe {

/// Makes the folder. Files of an earlier series there are replaced or removed, its .pvd first and
/// the new one written last: what it names is there. Throws OutputError.
std::unique_ptr<ExportFile> vtk_series(const ExportBodies& bodies, const std::string& folder);

/// True for the names of the files of a series: those that another one replaces or removes.
bool is_file_of_series(const std::string& name);

}  // namespace floatframe
