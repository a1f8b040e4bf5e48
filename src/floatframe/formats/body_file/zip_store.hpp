#pragma once
// Zip archives whose members are stored without compression, so that a reader may use the bytes in
// place, or compressed for other programs. Times are fixed: equal members give equal bytes. Below
// 4 GB and 65535 members (no zip64).
#include <string>
#include <string_view>
#include <vector>

namespace floatframe {

struct ZipMember {
  std::string name;
  std::string_view content;
  bool compressed = false;  ///< by Deflate, where that makes it smaller
};

/// The bytes of an archive. Throws InputError if it would be too large for the format.
std::string zip_archive(const std::vector<ZipMember>& members);

/// The members of an archive, views into `bytes`, in the order of its directory. Checks sizes and
/// CRC-32. Throws InputError marked with `file`: not a zip archive, truncated, compressed,
/// encrypted, a name that comes twice, a wrong checksum.
std::vector<ZipMember> read_zip(std::string_view bytes, const std::string& file);

}  // namespace floatframe
