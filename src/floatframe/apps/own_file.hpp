#pragma once
// Files written by this program, which it may replace. A file is recognised by its beginning, an
// archive by its comment; no list is kept, so that copies are recognised as well.
#include <string>

namespace floatframe {

/// True if there is no file, if it is empty, if writing does not replace it (a device, an open file
/// such as /dev/stdout), or if this program wrote it: results and other tables, states,
/// checkpoints, pages, pictures, JSON of its commands, bodies, meshes. False for model files and
/// for files that cannot be read.
bool is_own_file(const std::string& path);

/// The same for results.csv of a run's folder: a table of results next to a summary or states of
/// this program. Other programs also write tables that begin with the time.
bool is_own_results(const std::string& path);

}  // namespace floatframe
