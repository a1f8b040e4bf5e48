#pragma once
// The body file `.ffb`: a reduced part with all data for simulation, display and
// verification. An uncompressed zip of `header.json` and `.npy` arrays (little-endian doubles and
// integers), so numpy.load reads it. SI units. docs/body-file.md describes every member.
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "floatframe/reduction/part.hpp"

namespace floatframe {

struct Provenance {
  std::string source, source_hash;  ///< FE file as given, hash of its content (and its includes)
  std::string units;                ///< of the FE file
  std::vector<std::pair<std::string, std::string>> options;  ///< as on the command line
  std::string date, version;                                 ///< ISO 8601 UTC; of Floatframe
  /// Every file that was read, relative to the folder of `source`, and the hash of its content.
  std::vector<std::pair<std::string, std::string>> files;
};

struct BodyFile {
  ReducedPart part;
  Provenance provenance;
};

/// Version of the format that is written; newer ones are rejected.
inline constexpr int body_file_version = 1;
inline constexpr const char* body_file_units = "SI (m, kg, s, rad)";

/// Writes to a temporary name and renames. Equal contents give equal bytes. Throws OutputError.
void write_body_file(const std::filesystem::path& file, const BodyFile& content);
/// Throws InputError with every error: file, member, value found and value expected.
BodyFile read_body_file(const std::filesystem::path& file);

/// The same with the bytes of the file; `name` is for the messages.
std::string body_file_bytes(const BodyFile& content);
BodyFile read_body_bytes(std::string_view bytes, const std::string& name);

/// Frequency of each mode alone, sqrt(K_kk / M_kk) / 2 pi [Hz]; not finite without mass.
VecX mode_frequencies(const FlexibleBody& body);

/// At most three points of the surface that move rigidly with a marker in all modes (its own node,
/// nodes of a rigid interface); none without modes.
std::vector<int> surface_points_that_follow(const ReducedPart& part, const ModalNode& node);
/// Largest component by which a point of the surface leaves the rigid motion of a marker.
double distance_from_rigid(const ReducedPart& part, const ModalNode& node, int point);

/// Does a file begin with the signature of an archive?
bool is_body_file(const std::filesystem::path& file);

}  // namespace floatframe
