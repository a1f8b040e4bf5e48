#pragma once
// Resolves the name of an output file. Links are followed, so that no link is replaced by a file,
// and open files of a process (/dev/stdout, /dev/stderr, /dev/fd/N, /proc/N/fd/M) are written to
// directly, whatever their type.
#include <string>

namespace floatframe {

struct OutputPlace {
  std::string path;      ///< with all links resolved; a new file is created there
  bool is_open = false;  ///< an open file of some process: never replaced, never removed
  int descriptor = -1;   ///< if it is a descriptor of this process
};

/// Throws OutputError for circular links.
OutputPlace output_place(const std::string& name);

/// True if the file can be created or replaced: a regular file or none yet, and not an open file of
/// a process. Throws OutputError as output_place does.
bool is_replaceable(const std::string& name);

}  // namespace floatframe
