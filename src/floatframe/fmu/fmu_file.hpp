#pragma once
// An FMU for co-simulation (FMI 2.0 or 3.0) of a packed model: a zip archive of its description,
// documentation, a picture, the packed model and a runtime for each platform that steps it. The
// runtimes were built with the library and lie beside it, so that no compiler is needed. Equal
// models give equal files.
#include <cstddef>
#include <string>
#include <vector>

#include "floatframe/packed/packed_model.hpp"

namespace floatframe {

struct FmuOptions {
  int version = 2;                   ///< of the standard: 2 or 3
  std::vector<std::string> notes{};  ///< about the model, for its documentation
};

/// A runtime: the content of a shared library.
struct FmuBinary {
  std::string platform;  ///< "linux64" or "win64"
  std::string content;
};

struct FmuReport {
  std::size_t bytes = 0;  ///< of the file
  std::size_t model_bytes = 0;
  std::size_t inputs = 0, outputs = 0, parameters = 0;
  std::vector<std::string> platforms;
  std::vector<std::string> notes;  ///< of names that had to change and platforms that are missing
};

/// The runtimes beside the library, that of Linux first. InputError of code `unavailable`: there is
/// none for Linux.
std::vector<FmuBinary> fmu_binaries();

/// The bytes of an FMU. InputError: another version of the standard, or too large for the format.
std::string fmu_archive(const PackedModel& packed, const std::vector<FmuBinary>& binaries,
                        const FmuOptions& options, FmuReport& report);

/// Writes an FMU with `fmu_binaries`, atomically. InputError: as these; OutputError: it cannot be
/// written.
FmuReport write_fmu(const std::string& path, const PackedModel& packed,
                    const FmuOptions& options = {});

}  // namespace floatframe
