#pragma once
// Cache of reduced parts of model files, as body files: a part is reduced again only if its files,
// its options or the program changed. Files of the cache are written atomically; unreadable files
// (with a message) and files of another origin are replaced.
#include <filesystem>
#include <functional>
#include <string>

#include "floatframe/parts/part_job.hpp"

namespace floatframe {

/// Folder of the cache for a model file in `folder`: the environment variable FLOATFRAME_CACHE
/// (empty or "off": none); else `folder`/.floatframe-cache if it is writable; else
/// $XDG_CACHE_HOME/floatframe or ~/.cache/floatframe. Empty: no cache.
std::filesystem::path part_cache_folder(const std::filesystem::path& folder);

/// Path of the body of a job in the cache: the name depends on the contents of its files, on all
/// its options and on the program.
std::filesystem::path part_cache_file(const PartJob& job, const std::filesystem::path& cache);

/// The part from the cache, or reduced and stored now; `say` reports which. Throws InputError.
BodyFile cached_part(const PartJob& job, const std::filesystem::path& cache, const std::string& who,
                     const std::function<void(const std::string&)>& say);

}  // namespace floatframe
