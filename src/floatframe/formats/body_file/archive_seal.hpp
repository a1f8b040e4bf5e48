#pragma once
// A seal on an archive that a program keeps for itself: a fingerprint of all its bytes, in the
// comment at its end. The checksums of the members tell what is damaged; the seal also tells what
// was written by something else, or changed and packed again.
#include <string>
#include <string_view>

namespace floatframe {

/// The archive (of `zip_archive`) with its seal. It stays an archive like any other.
std::string sealed_archive(std::string archive);

/// True if the bytes are those that were sealed.
bool is_sealed_archive(std::string_view archive);

}  // namespace floatframe
