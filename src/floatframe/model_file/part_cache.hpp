#pragma once
// Reduced parts of model files, kept as body files: a part is reduced again only if its files, its
// options or the program changed. Files of the cache are written atomically; what cannot be read
// (with a line that says so) or belongs to something else is replaced.
#include <filesystem>
#include <functional>
#include <string>

#include "floatframe/parts/part_job.hpp"

namespace floatframe {

/// Folder of the cache for a model file in `folder`: the environment variable FLOATFRAME_CACHE
/// (empty or "off": none); else `folder`/.floatframe-cache if it can be written; else
/// $XDG_CACHE_HOME/floatframe or ~/.cache/floatframe. Empty: nothing is kept.
std::filesystem::path part_cache_folder(const std::filesystem::path& folder);

/// Where the body of a job is kept: a name made of the contents of its files, of all its options
/// and of the program.
std::filesystem::path part_cache_file(const PartJob& job, const std::filesystem::path& cache);

/// The part from the cache, or reduced now and put there. `say` receives which. Throws InputError.
BodyFile cached_part(const PartJob& job, const std::filesystem::path& cache, const std::string& who,
                     const std::function<void(const std::string&)>& say);

}  // namespace floatframe
