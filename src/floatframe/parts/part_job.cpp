#include "floatframe/parts/part_job.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <set>

#include "floatframe/core/build_info.hpp"
#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/regular_file.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/parts/part_options.hpp"

namespace floatframe {
namespace {

void scale(NodeChoice& choice, std::optional<Vec3>& at, double length) {
  choice.point *= length;
  choice.radius *= length;
  choice.length *= length;
  choice.tolerance *= length;
  if (at) *at *= length;
}

/// The files of the model and the other files of the job, relative to the folder of the job's file,
/// each once, with their fingerprints.
std::vector<std::pair<std::string, std::string>> files_of(const PartJob& job,
                                                          const FeModel& model) {
  namespace fs = std::filesystem;
  std::vector<fs::path> paths{job.file};
  paths.insert(paths.end(), model.files.begin(), model.files.end());
  for (const fs::path& p : other_files(job)) paths.push_back(p);
  const fs::path folder = fs::absolute(job.file).lexically_normal().parent_path();
  std::vector<std::pair<std::string, std::string>> out;
  std::set<std::string> seen;
  for (const fs::path& p : paths) {
    const fs::path full = fs::absolute(p).lexically_normal();
    const std::string name = full.lexically_relative(folder).string();
    const std::string hash = file_hash(full);
    if (!hash.empty() && seen.insert(name).second) out.emplace_back(name, hash);
  }
  return out;
}

}  // namespace

UnitSystem unit_system(const std::string& name) {
  if (const auto units = find_unit_system(name)) return *units;
  const std::vector<std::string> known = unit_system_names();
  throw InputError(
      ErrorCode::not_found,
      fmt::format("unknown unit system '{}'{}; known are {}, or any <length>-<mass>-<time>", name,
                  did_you_mean(name, known), fmt::join(known, ", ")));
}

std::string file_hash(const std::filesystem::path& file) {
  try {
    RegularFile in(file);
    std::uint64_t count = 0;
    std::vector<char> piece(std::size_t{1} << 16);
    ContentHash hash;
    hash.add(in.size());
    while (const std::size_t got = in.read(piece.data(), piece.size())) {
      hash.append({piece.data(), got});
      count += got;
      if (count > largest_file_read) return "";
    }
    if (count == in.size()) return hash.text();
  } catch (const InputError&) {
    return "";
  }
  // Its size is no size: a file of /proc, or one that grew meanwhile.
  std::string content;
  return read_regular_file(file, largest_file_read, content).empty() ? content_hash(content) : "";
}

std::string date_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", utc);
}

std::vector<std::pair<std::string, std::string>> option_list(const PartJob& job) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const PartOption& option : part_options())
    for (std::string& text : option_texts(option, job))
      out.emplace_back(option.name, std::move(text));
  return out;
}

BodyFile reduce_part_file(const PartJob& job) {
  unit_system(job.units);
  const auto start = std::chrono::steady_clock::now();
  FeModel model = read_fe_file(job.file, job.read, job.format);
  const auto files = files_of(job, model);
  ContentHash hash;
  for (const auto& [name, content] : files) hash.add(name).add(content);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  if (job.options.progress) job.options.progress("read", seconds.count());
  BodyFile out = reduce_part_model(std::move(model), job);
  out.provenance.files = files;
  out.provenance.source_hash = hash.text();
  auto& stages = out.part.health.seconds;
  stages.insert(stages.begin(), {"read", seconds.count()});
  return out;
}

BodyFile reduce_part_model(FeModel model, const PartJob& job) {
  const UnitSystem units = unit_system(job.units);
  BodyFile out;
  Provenance& from = out.provenance;
  from.source = job.file.string();
  from.units = units.name;
  from.options = option_list(job);
  from.date = date_now();
  from.version = version();

  to_si(model, units);
  PartOptions options = job.options;
  for (InterfaceDescription& i : options.interfaces) scale(i.choice, i.at, units.length);
  for (MarkerDescription& m : options.markers) scale(m.choice, m.at, units.length);
  out.part = reduce_part(std::move(model), options);
  return out;
}

}  // namespace floatframe
