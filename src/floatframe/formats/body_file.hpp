#pragma once
// The body file `.ffb`: a reduced part with everything that a simulation, a picture and a sceptic
// need. An uncompressed zip of `header.json` and `.npy` arrays (little-endian doubles and
// integers), so numpy.load reads it. SI units. docs/body-file.md names every member.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/reduction/part.hpp"

namespace floatframe {

struct Provenance {
  std::string source, source_hash;  ///< FE file as given, hash of its content (and its includes)
  std::string units;                ///< of the FE file
  std::vector<std::pair<std::string, std::string>> options;  ///< as on the command line
  std::string date, version;                                 ///< ISO 8601 UTC; of Floatframe
};

struct BodyFile {
  ReducedPart part;
  Provenance provenance;
};

/// Writes to a temporary name and renames.
void write_body_file(const std::filesystem::path& file, const BodyFile& content);
/// Throws InputError naming the member and what is wrong with it.
BodyFile read_body_file(const std::filesystem::path& file);

}  // namespace floatframe
