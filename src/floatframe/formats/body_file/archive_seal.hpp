#pragma once
// A seal on an archive for internal use by a program: a fingerprint of all its bytes, in the
// comment at its end. The checksums of the members detect damage; the seal also detects archives
// that were written by another program, or changed and repacked.
#include <string>
#include <string_view>

namespace floatframe {

/// The archive (of `zip_archive`) with its seal. It remains a normal archive.
std::string sealed_archive(std::string archive);

/// True if the bytes are those that were sealed.
bool is_sealed_archive(std::string_view archive);

}  // namespace floatframe
