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

namespace floatframe {
namespace {

using Options = std::vector<std::pair<std::string, std::string>>;

std::string comma_text(const Vec3& v) { return fmt::format("{},{},{}", v.x(), v.y(), v.z()); }

std::string place_text(const NodeChoice& choice, const std::optional<Vec3>& at) {
  return choice_text(choice) + (at ? ",at=" + comma_text(*at) : "");
}

void scale(NodeChoice& choice, std::optional<Vec3>& at, double length) {
  choice.point *= length;
  choice.radius *= length;
  choice.length *= length;
  choice.tolerance *= length;
  if (at) *at *= length;
}

/// The files of the model and the others that the job names, relative to the folder of the job's
/// file, each once, with their fingerprints.
std::vector<std::pair<std::string, std::string>> files_of(const PartJob& job,
                                                          const FeModel& model) {
  namespace fs = std::filesystem;
  std::vector<fs::path> paths{job.file};
  paths.insert(paths.end(), model.files.begin(), model.files.end());
  for (const fs::path& p : {job.read.nodes, job.read.mass, job.read.dofs})
    if (!p.empty()) paths.push_back(p);
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

const char* word(ModeMethod method) noexcept {
  switch (method) {
    case ModeMethod::free_free:
      return "free_free";
    case ModeMethod::craig_chang:
      return "craig_chang";
    case ModeMethod::craig_bampton:
      break;
  }
  return "craig_bampton";
}

std::string dofs_text(unsigned mask) {
  if ((mask & 63u) == 63u) return "all";
  std::string moves, turns;
  for (unsigned k = 0; k < 3; ++k) {
    if (mask & (1u << k)) moves += "xyz"[k];
    if (mask & (8u << k)) turns += "xyz"[k];
  }
  if (turns.empty()) return moves;
  return moves + (moves.empty() ? "r" : "+r") + turns;
}

std::string choice_text(const NodeChoice& c) {
  std::string text;
  switch (c.by) {
    case NodeChoice::By::set:
      return "set:" + c.set;
    case NodeChoice::By::node:
      return fmt::format("node:{}", c.number);
    case NodeChoice::By::nearest:
      return "nearest:" + comma_text(c.point);
    case NodeChoice::By::plane:
      text = fmt::format("plane:{},normal={}", comma_text(c.point), comma_text(c.axis));
      break;
    case NodeChoice::By::cylinder:
      text = fmt::format("cylinder:{},axis={},radius={}", comma_text(c.point), comma_text(c.axis),
                         c.radius);
      if (c.length > 0.0) text += fmt::format(",length={}", c.length);
      break;
    case NodeChoice::By::sphere:
      text = fmt::format("sphere:{},radius={}", comma_text(c.point), c.radius);
      break;
  }
  if (c.tolerance > 0.0) text += fmt::format(",tolerance={}", c.tolerance);
  return text;
}

UnitSystem unit_system(const std::string& name) {
  if (const auto units = find_unit_system(name)) return *units;
  const std::vector<std::string> known = unit_system_names();
  throw InputError(
      fmt::format("unknown unit system '{}'{}; known are {}, or any "
                  "<length>-<mass>-<time>",
                  name, did_you_mean(name, known), fmt::join(known, ", ")));
}

std::string file_hash(const std::filesystem::path& file) {
  std::string content;
  return read_regular_file(file, largest_file_read, content).empty() ? content_hash(content) : "";
}

std::string date_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", utc);
}

Options option_list(const PartJob& job) {
  const PartOptions& o = job.options;
  Options out{{"units", job.units}};
  const auto add = [&](const char* name, const std::string& value) {
    out.emplace_back(name, value);
  };
  if (!job.format.empty()) add("format", job.format);
  if (job.read.dialect != DeckDialect::by_content) add("dialect", word(job.read.dialect));
  if (job.read.material)
    add("material", fmt::format("{},{},{}", job.read.material->young, job.read.material->poisson,
                                job.read.material->density));
  if (!job.read.nodes.empty()) add("nodes", job.read.nodes.filename().string());
  if (!job.read.mass.empty()) add("mass", job.read.mass.filename().string());
  if (!job.read.dofs.empty()) add("dofs", job.read.dofs.filename().string());
  for (const InterfaceDescription& i : o.interfaces)
    add("interface", fmt::format("{}={}{}{}", i.name, place_text(i.choice, i.at),
                                 i.kind == Spider::Kind::mean ? ",type=mean" : "",
                                 i.mask == 63u ? "" : ",dofs=" + dofs_text(i.mask)));
  for (const MarkerDescription& m : o.markers)
    add("marker",
        fmt::format("{}={}{}", m.name, place_text(m.choice, m.at), m.residual ? ",residual" : ""));
  add("method", word(o.method));
  if (o.modes) add("modes", std::to_string(*o.modes));
  if (o.max_frequency > 0.0) add("fmax", fmt::format("{}", o.max_frequency));
  if (o.effective_mass > 0.0) add("effective-mass", fmt::format("{}", o.effective_mass));
  add("reference", o.reference.kind == BodyReference::Kind::node      ? "node:" + o.reference.node
                   : o.reference.kind == BodyReference::Kind::buckens ? "buckens"
                                                                      : "mean_axis");
  add("integration", o.integration == Integration::ccx ? "ccx" : "exact");
  if (o.damping_ratio > 0.0) add("damping", fmt::format("{}", o.damping_ratio));
  if (!o.check_free_modes) add("no-free-check", "true");
  if (!o.stresses) add("no-stress", "true");
  if (o.keep_projection) add("projection", "true");
  return out;
}

BodyFile reduce_part_file(const PartJob& job) {
  const UnitSystem units = unit_system(job.units);
  const auto start = std::chrono::steady_clock::now();
  FeModel model = read_fe_file(job.file, job.read, job.format);
  BodyFile out;
  Provenance& from = out.provenance;
  from.source = job.file.string();
  from.files = files_of(job, model);
  ContentHash hash;
  for (const auto& [name, content] : from.files) hash.add(name).add(content);
  from.source_hash = hash.text();
  from.units = units.name;
  from.options = option_list(job);
  from.date = date_now();
  from.version = version();

  to_si(model, units);
  PartOptions options = job.options;
  for (InterfaceDescription& i : options.interfaces) scale(i.choice, i.at, units.length);
  for (MarkerDescription& m : options.markers) scale(m.choice, m.at, units.length);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  if (options.progress) options.progress("read", seconds.count());
  out.part = reduce_part(std::move(model), options);
  auto& stages = out.part.health.seconds;
  stages.insert(stages.begin(), {"read", seconds.count()});
  return out;
}

}  // namespace floatframe
