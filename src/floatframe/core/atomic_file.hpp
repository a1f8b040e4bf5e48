#pragma once
// Output files are written atomically: the content goes to a temporary file in the same folder,
// which is renamed when it is complete. SIGINT, SIGTERM, SIGHUP and SIGXCPU wait while a file is
// written, so no temporary file stays behind. Links are followed first: what they lead to is
// replaced, never they themselves (output_place.hpp).
#include <string>
#include <string_view>

#include "floatframe/core/output_error.hpp"

namespace floatframe {

/// Makes the folder (and those above it) and proves that files can be made in it. Throws
/// OutputError.
void make_output_folder(const std::string& path);

/// Proves that `path` can be written, without touching a file that is there. Never waits: a named
/// pipe is refused, as are sockets, block devices and folders. Throws OutputError.
void check_writable(const std::string& path);

/// When what was written must be on the disk, so that a power failure leaves no empty file.
enum class Flush {
  now,
  later  ///< by `flush_files`: of many files that count only when a last one names them
};

/// Replaces the file at `path` by `content` in one stroke. A terminal, a null device and what this
/// process holds open (/dev/stdout, /dev/stderr, /dev/fd/N: whatever that is) are written to
/// directly; what check_writable refuses is refused. Throws OutputError.
void write_file(const std::string& path, std::string_view content, Flush flush = Flush::now);

/// Waits until the files of this folder are on the disk. Throws OutputError.
void flush_files(const std::string& folder);

/// Removes the regular file if it is there; of a link what it leads to.
void remove_file(const std::string& path);

/// True for names of temporary files that `write_file` makes: NAME.part-NUMBER-NUMBER.
bool is_temporary_name(std::string_view name) noexcept;

/// `name` as the name of a folder or file: letters and other visible characters of any script,
/// digits, '.', '-', '_' stay, what else ASCII has and what nobody sees become '_'; never empty,
/// never starting with a dot.
std::string file_name_from(std::string_view name);

}  // namespace floatframe
