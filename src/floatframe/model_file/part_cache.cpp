#include "floatframe/model_file/part_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/library_path.hpp"
#include "floatframe/parts/kept_part.hpp"
#include "floatframe/parts/part_options.hpp"

namespace floatframe {
namespace {

namespace fs = std::filesystem;

/// Size and time of the program file: another build may give different results.
std::string program_stamp() {
  static const std::string stamp = [] {
    std::error_code error;
    const fs::path file = library_path();
    const auto size = fs::file_size(file, error);
    const auto time = fs::last_write_time(file, error);
    return fmt::format("{} {} {}", version(), size, time.time_since_epoch().count());
  }();
  return stamp;
}

/// The body file if it belongs to this job and all files that it was made from are unchanged.
/// `damage`: the reason if the file exists but cannot be read.
std::optional<BodyFile> fresh(const fs::path& file, const PartJob& job, std::string& damage) {
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  try {
    BodyFile found = kept_part(file);
    const Provenance& from = found.provenance;
    if (from.version != version() || from.options != option_list(job) || from.files.empty())
      return std::nullopt;
    const fs::path folder = fs::absolute(job.file).lexically_normal().parent_path();
    for (const auto& [name, hash] : from.files)
      if (file_hash(folder / name) != hash) return std::nullopt;
    return found;
  } catch (const InputError& found) {  // damaged, or of another kind
    damage = found.errors().front().text();
    return std::nullopt;
  }
}

bool can_be_written(const fs::path& folder) { return ::access(folder.c_str(), W_OK | X_OK) == 0; }

}  // namespace

fs::path part_cache_file(const PartJob& job, const fs::path& cache) {
  ContentHash key;
  key.add(program_stamp()).add(file_hash(job.file)).add(job.file.filename().string());
  for (const auto& [option, value] : option_list(job)) key.add(option).add(value);
  for (const fs::path& p : other_files(job)) key.add(file_hash(p));
  // An optional file, listed in the origin of a body only if it existed.
  if (const fs::path damping = damping_beside(job.file); !damping.empty())
    key.add(file_hash(damping));
  return cache / fmt::format("{}-{}.ffb", file_name_from(job.file.stem().string()),
                             key.text().substr(0, 16));
}

fs::path part_cache_folder(const fs::path& folder) {
  if (const char* given = std::getenv("FLOATFRAME_CACHE"))
    return std::string(given) == "off" ? fs::path() : fs::path(given);
  const fs::path beside = folder / ".floatframe-cache";
  std::error_code error;
  if (can_be_written(fs::exists(beside, error) ? beside : folder)) return beside;
  const char* xdg = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  if (xdg && *xdg) return fs::path(xdg) / "floatframe";
  if (home && *home) return fs::path(home) / ".cache" / "floatframe";
  return {};
}

BodyFile cached_part(const PartJob& job, const fs::path& cache, const std::string& who,
                     const std::function<void(const std::string&)>& say) {
  const auto report = [&](const std::string& line) {
    if (say) say(who + ": " + line);
  };
  const std::string source = job.file.string();
  const fs::path file = cache.empty() ? fs::path() : part_cache_file(job, cache);
  std::string damage;
  if (!file.empty())
    if (auto found = fresh(file, job, damage)) {
      const std::size_t warnings = found->part.health.warnings.size();
      report(fmt::format("'{}' with {} modes from the cache, {}{}", source,
                         found->part.body.modes(), file.string(),
                         warnings > 0 ? fmt::format(" ({} warning{} in its health report)",
                                                    warnings, warnings == 1 ? "" : "s")
                                      : ""));
      return std::move(*found);
    }
  if (!damage.empty()) report("what was kept cannot be read: " + damage);
  report(fmt::format("reducing '{}' ...", source));
  const auto start = std::chrono::steady_clock::now();
  BodyFile made = reduce_part_file(job);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::string kept = "not kept";
  if (!file.empty()) {
    try {
      make_output_folder(cache.string());
      keep_part(file, made);
      kept = "kept in " + file.string();
    } catch (const OutputError& error) {
      kept += fmt::format(" ({})", error.what());
    }
  }
  report(fmt::format("'{}' reduced to {} modes in {:.1f} s, {}", source, made.part.body.modes(),
                     seconds.count(), kept));
  for (const std::string& warning : made.part.health.warnings) report("warning: " + warning);
  return made;
}

}  // namespace floatframe
