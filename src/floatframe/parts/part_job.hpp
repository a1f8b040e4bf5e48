#pragma once
// One reduction as requested on the command line or in a model file: file, units and options; and
// the resulting body file.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/fe/unit_system.hpp"
#include "floatframe/formats/body_file/body_file.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "floatframe/reduction/part.hpp"

namespace floatframe {

struct PartJob {
  std::filesystem::path file;
  std::string format;  ///< empty: recognised
  std::string units;   ///< name of a unit system
  FeReadOptions read;
  /// Lengths of interfaces and markers are in the units of the file.
  PartOptions options;
};

/// Reads the file, converts it to SI units and reduces it. Throws InputError.
BodyFile reduce_part_file(const PartJob& job);
/// The same for a model made by a program, in the units of the job, whose file is only the name of
/// the source in the body; reading options are ignored.
BodyFile reduce_part_model(FeModel model, const PartJob& job);

/// Everything that affects the result except the contents of files, as (option, value) in the
/// notation of the command line: equal lists and equal files give equal bodies.
std::vector<std::pair<std::string, std::string>> option_list(const PartJob& job);

/// The unit system; InputError (without a location) with the known names and a suggestion.
UnitSystem unit_system(const std::string& name);

/// Fingerprint of a file's content; empty if it cannot be read.
std::string file_hash(const std::filesystem::path& file);
/// "2026-01-02T03:04:05Z"
std::string date_now();

}  // namespace floatframe
