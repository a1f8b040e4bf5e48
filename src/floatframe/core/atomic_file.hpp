#pragma once
// Output files are written atomically: the content goes to a temporary file in the same folder,
// which is renamed when it is complete. SIGINT, SIGTERM, SIGHUP and SIGXCPU are blocked while a
// file is written, so no temporary file remains. Links are resolved first: their targets are
// replaced, never the links (output_place.hpp).
#include <string>
#include <string_view>

#include "floatframe/core/output_error.hpp"

namespace floatframe {

/// Creates the folder (and its parents) and checks that files can be created in it. Throws
/// OutputError.
void make_output_folder(const std::string& path);

/// Checks that `path` can be written, without changing an existing file. Never blocks: named pipes,
/// sockets, block devices and folders are rejected. Throws OutputError.
void check_writable(const std::string& path);

/// When data must be on the disk, so that a power failure leaves no empty file.
enum class Flush {
  now,
  later  ///< by `flush_files`: for many files that are valid only once a last one lists them
};

/// Replaces the file at `path` by `content` atomically. A terminal, a null device and any open file
/// of this process (/dev/stdout, /dev/stderr, /dev/fd/N) is written to directly; what
/// check_writable rejects is rejected. Throws OutputError.
void write_file(const std::string& path, std::string_view content, Flush flush = Flush::now);

/// Waits until the files of this folder are on the disk. Throws OutputError.
void flush_files(const std::string& folder);

/// Removes the regular file if it exists; for a link, its target.
void remove_file(const std::string& path);

/// True for names of temporary files of `write_file`: NAME.part-NUMBER-NUMBER.
bool is_temporary_name(std::string_view name) noexcept;

/// `name` as the name of a folder or file: letters and other visible characters of any script,
/// digits, '.', '-', '_' are kept, other ASCII and invisible characters become '_'; never empty,
/// never starting with a dot.
std::string file_name_from(std::string_view name);

}  // namespace floatframe
