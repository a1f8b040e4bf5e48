#include "floatframe/sweep/sweep_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/io/results_csv.hpp"
#include "floatframe/io/summary_json.hpp"
#include "floatframe/simulation/simulation.hpp"
#include "floatframe/sweep/sweep_journal.hpp"

namespace floatframe {
namespace {

/// A journal line holds one sentence: of several faults the first.
std::string first_fault(const InputError& error) {
  std::string text = error.faults().front().text();
  if (error.faults().size() > 1) text += fmt::format(" (and {} more)", error.faults().size() - 1);
  return text;
}

}  // namespace

SweepRunner::SweepRunner(const SweepOptions& options, const std::atomic<bool>& stop)
    : options_(options),
      stop_(stop),
      reader_(options.model, options_.fixed, options_.plan),
      pool_(static_cast<std::size_t>(8 + 2 * options.threads)),
      prepared_(options.plan.runs.size()) {}

SweepCase SweepRunner::read(std::size_t run) {
  SweepCase c = reader_.read(run);
  const std::lock_guard lock(mutex_);
  for (const auto& [file, hash] : c.fingerprint.files)
    if (files_.emplace(file, hash).first->second != hash)
      throw RunError(fmt::format("'{}' was changed while the study was running", file));
  return c;
}

PreparedRun SweepRunner::prepare(std::size_t run) {
  const SweepCase c = read(run);
  for (const SweepMeasure& m : options_.measures) {
    std::vector<std::string> names;
    for (const OutputDescription& o : c.description.outputs) names.push_back(o.name);
    if (std::find(names.begin(), names.end(), m.output) == names.end())
      throw InputError(fmt::format("--measure: {} has no output '{}'{}", options_.model, m.output,
                                   did_you_mean(m.output, names)));
  }
  PreparedRun p;
  p.fingerprint.model = c.fingerprint.model;
  p.fingerprint.simulation = c.fingerprint.simulation;
  p.simulation = c.description.simulation;
  return p;
}

void SweepRunner::keep(std::size_t run, PreparedRun prepared) {
  prepared_[run] = std::move(prepared);
}

std::shared_ptr<const Model> SweepRunner::model(std::size_t run, const PreparedRun& prepared) {
  return pool_.get(prepared.fingerprint, prepared.simulation,
                   [&] { return read(run).description; });
}

std::string SweepRunner::folder_of(std::size_t run) const {
  const std::size_t digits = std::to_string(options_.plan.runs.size()).size();
  return (std::filesystem::path(options_.folder) / "runs" / fmt::format("{:0{}}", run + 1, digits))
      .string();
}

std::string SweepRunner::line(std::size_t run, std::atomic<double>& progress) {
  if (stop_.load(std::memory_order_relaxed)) throw RunGivenUp{};
  RunResult result;
  SweepRow row;
  try {
    const PreparedRun prepared = prepared_[run] ? *prepared_[run] : prepare(run);
    const std::shared_ptr<const Model> shared = model(run, prepared);
    RunOptions options;
    options.progress = [&](double fraction) {
      if (stop_.load(std::memory_order_relaxed)) throw RunGivenUp{};
      progress.store(fraction, std::memory_order_relaxed);
    };
    try {
      result = floatframe::run(*shared, prepared.simulation, options);
      row = sweep_row(result, options_.measures);
    } catch (const RunError& error) {
      row = failed_row(error.what());
      result.summary.model = shared->name;
      result.summary.status = "failed";
      result.summary.message = error.what();
    }
  } catch (const InputError& error) {
    row = failed_row(first_fault(error));
    result.summary.status = "failed";
    result.summary.message = row.message;
  }
  if (options_.keep_results) {
    const std::string folder = folder_of(run);
    make_output_folder(folder);
    const auto path = [&](const char* name) {
      return (std::filesystem::path(folder) / name).string();
    };
    if (result.table.columns.empty())
      remove_file(path("results.csv"));
    else
      write_file(path("results.csv"), results_csv(result.table));
    write_file(path("summary.json"), summary_json(result.summary));
  }
  return encode_row(run, row);
}

std::string SweepRunner::files_of_first_run() const {
  ContentHash hash;
  for (const auto& [file, content] : reader_.read(0).fingerprint.files) hash.add(content);
  return hash.text();
}

std::map<std::string, std::string> SweepRunner::files() const {
  const std::lock_guard lock(mutex_);
  return files_;
}

}  // namespace floatframe
