#pragma once
// Which files are of this program: those it may replace. A file is known by how it begins, archives
// by their comment; nothing is kept elsewhere, so that copies count as well.
#include <string>

namespace floatframe {

/// True if nothing is there, or nothing in it, or nothing that would be replaced (a device, an open
/// file such as /dev/stdout), or what this program writes: results and other tables, states,
/// checkpoints, pages, pictures, JSON of its commands, bodies, meshes. Model files are never of
/// this program. A file that cannot be read is not.
bool is_own_file(const std::string& path);

/// The same for results.csv of a run's folder: a table of results beside a summary or states of
/// this program. Other programs write tables that begin with the time as well.
bool is_own_results(const std::string& path);

}  // namespace floatframe
