#pragma once
// A motion as numbers for programs that calculate with it (docs/export.md): arrays of NumPy in one
// file (.npz), and one long table (.csv) with a row for each instant, body and named node.
#include <memory>

#include "floatframe/export/export_file.hpp"

namespace floatframe {

/// Members "time", "bodies" and for each body "NAME/position" and so on. Nothing is written before
/// `finish`.
/// `stress`: also that of all places of bodies that know it. Throws InputError if the file would be
/// larger than its format allows.
std::unique_ptr<ExportFile> numpy_archive(const ExportBodies& bodies, const std::string& path,
                                          bool stress);

std::unique_ptr<ExportFile> motion_table(const ExportBodies& bodies, const std::string& path);

}  // namespace floatframe
