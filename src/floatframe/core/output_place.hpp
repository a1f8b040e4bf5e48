#pragma once
// Where that goes which is written under a name. Links are followed, so that none is ever replaced
// by a file, and what a process holds open (/dev/stdout, /dev/stderr, /dev/fd/N, /proc/N/fd/M) is
// written into, whatever stands behind it.
#include <string>

namespace floatframe {

struct OutputPlace {
  std::string path;      ///< behind all links; what is not there yet is to be made there
  bool is_open = false;  ///< an open file of some process: never replaced, never removed
  int descriptor = -1;   ///< of this process, if it is one of its own
};

/// Throws OutputError if links lead round in a circle.
OutputPlace output_place(const std::string& name);

/// True if the file can be made anew or replaced by a new one: a regular file, or nothing yet, and
/// none that a process holds open by this name. Throws OutputError as output_place does.
bool is_replaceable(const std::string& name);

}  // namespace floatframe
