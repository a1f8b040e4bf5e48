#pragma once
// One reduction as a user asks for it, on the command line or in a model file: which file, in which
// units, with which options; and the body file that comes of it.
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
/// The same for a model that a program has made, in the units of the job, whose file is only the
/// name that the body shows as its source; how to read is ignored.
BodyFile reduce_part_model(FeModel model, const PartJob& job);

/// Everything that decides the result except the contents of files, as (option, value) in the words
/// of the command line: equal lists and equal files give equal bodies.
std::vector<std::pair<std::string, std::string>> option_list(const PartJob& job);

/// The unit system; InputError (without a place) that names those known, with did-you-mean.
UnitSystem unit_system(const std::string& name);

/// Fingerprint of a file's content; empty if it cannot be read.
std::string file_hash(const std::filesystem::path& file);
/// "2026-01-02T03:04:05Z"
std::string date_now();

}  // namespace floatframe
