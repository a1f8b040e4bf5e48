#include "floatframe/sweep/sweep_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/folder_lock.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/history/history_content.hpp"
#include "floatframe/results/results_csv.hpp"
#include "floatframe/results/summary_json.hpp"
#include "floatframe/run/range_warnings.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/sweep/sweep_journal.hpp"

namespace floatframe {
namespace {

/// A journal line contains one sentence: the first of several errors.
std::string first_error(const InputError& error) {
  std::string text = error.errors().front().text();
  if (error.count() > 1) text += fmt::format(" (and {} more)", error.count() - 1);
  return text;
}

/// Removes temporary files of a process that died while it wrote them.
void remove_torn_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> torn;
  std::error_code ignored;
  for (std::filesystem::directory_iterator it(folder, ignored), end; !ignored && it != end;
       it.increment(ignored))
    if (is_temporary_name(it->path().filename().string())) torn.push_back(it->path());
  for (const auto& file : torn) remove_file(file.string());
}

/// Locks the folder while it is written: a single run may be using it.
class RunFolder {
 public:
  explicit RunFolder(const std::string& folder) {
    make_output_folder(folder);
    try {
      lock_.emplace(folder);
    } catch (const InputError& error) {
      throw OutputError(error.what());
    }
  }

 private:
  std::optional<FolderLock> lock_;
};

/// The states of a run, if its model file records them (`record: states`). Like its rows, they are
/// kept in memory until the run has ended.
class SweepStates {
 public:
  /// Connects `options` to this object if states are recorded; the arguments must outlive the run.
  void take_from(RunOptions& options, const Model& model, const SimulationDescription& simulation,
                 const HistoryOrigin& origin) {
    if (simulation.record.states != RecordDescription::States::states) return;
    options.states = [&](const StateLayout& layout, std::span<const double> numbers) {
      if (!content_) content_ = history_content(model, simulation, layout, origin);
      numbers_.insert(numbers_.end(), numbers.begin(), numbers.end());
    };
  }

  /// Replaces an existing file. Throws OutputError.
  void write(const std::filesystem::path& file, const RunSummary& summary) const {
    if (!content_) return remove_file(file.string());
    StatesFile out(file.string(), *content_, false);
    out.append(numbers_);
    out.finish(summary.status == "completed" || summary.strict ? "completed" : summary.status,
               summary.message);
  }

 private:
  std::optional<HistoryContent> content_;
  std::vector<double> numbers_;
};

void keep_files(const std::filesystem::path& folder, const RunResult& result,
                const SweepStates& states) {
  const RunFolder held(folder.string());
  remove_torn_files(folder);
  const std::string table = (folder / "results.csv").string();
  if (result.table.columns.empty())
    remove_file(table);
  else
    write_file(table, results_csv(result.table));
  states.write(folder / "states.ffr", result.summary);
  write_file((folder / "summary.json").string(), summary_json(result.summary));
}

/// Origin written to the states of a run.
HistoryOrigin origin_of(const SweepOptions& options, std::size_t run, const PreparedRun& prepared) {
  HistoryOrigin o = history_origin(options.model, folder_of_run(options, run));
  for (const std::string& setting : settings_of(options, run))
    if (!setting.starts_with("simulation.")) o.settings.push_back(setting);  // in the header
  if (prepared.files) o.files = relative_to_model(options.model, *prepared.files);
  return o;
}

}  // namespace

std::string folder_of_run(const SweepOptions& options, std::size_t run) {
  const std::size_t digits = std::to_string(options.plan.runs.size()).size();
  const auto name = fmt::format("{:0{}}", run + 1, digits);
  return (std::filesystem::path(options.folder) / "runs" / name).string();
}

std::vector<std::string> settings_of(const SweepOptions& options, std::size_t run) {
  std::vector<std::string> settings;
  for (const SweepSetting& s : options.fixed) settings.push_back(s.name + '=' + s.value);
  for (std::size_t k = 0; k < options.plan.names.size(); ++k)
    settings.push_back(options.plan.names[k] + '=' + options.plan.runs[run][k]);
  return settings;
}

SweepRunner::SweepRunner(const SweepOptions& options, const std::atomic<bool>& stop)
    : options_(options),
      stop_(stop),
      reader_(options.model, options_.text, options_.fixed, options_.plan),
      pool_(8) {}

SweepCase SweepRunner::read(std::size_t run) {
  SweepCase c = reader_.read(run);
  for (const auto& [file, hash] : c.fingerprint.files)
    if (files_.emplace(file, hash).first->second != hash)
      throw RunError(ErrorCode::mismatch,
                     fmt::format("'{}' was changed while the study was running", file));
  return c;
}

SweepCase SweepRunner::read_checked(std::size_t run) {
  SweepCase c = read(run);
  std::vector<std::string> names;
  for (const OutputDescription& o : c.description.outputs) names.push_back(o.name);
  const auto require = [&](const char* option, const SweepMeasure& m) {
    if (std::find(names.begin(), names.end(), m.output) == names.end())
      throw InputError(ErrorCode::not_found,
                       fmt::format("{}: {} has no output '{}'{}", option, options_.model, m.output,
                                   did_you_mean(m.output, names)));
  };
  for (const SweepMeasure& m : options_.measures) require("--measure", m);
  if (options_.ranking)
    require(options_.ranking->largest ? "--maximize" : "--minimize", options_.ranking->measure);
  return c;
}

PreparedRun SweepRunner::prepared_from(const SweepCase& c) {
  PreparedRun p;
  p.fingerprint.model = c.fingerprint.model;
  p.fingerprint.simulation = c.fingerprint.simulation;
  p.simulation = c.description.simulation;
  if (options_.keep_results) {
    if (!last_files_ || *last_files_ != c.fingerprint.files)
      last_files_ = std::make_shared<const PreparedRun::Files>(c.fingerprint.files);
    p.files = last_files_;
  }
  return p;
}

PreparedRun SweepRunner::prepare(std::size_t run) { return prepared_from(read_checked(run)); }

void SweepRunner::check(std::size_t run) { prepared_.insert_or_assign(run, prepare(run)); }

std::shared_ptr<const Model> SweepRunner::model(std::size_t run, const PreparedRun& prepared) {
  return pool_.get(prepared.fingerprint, prepared.simulation,
                   [&] { return read(run).description; });
}

std::string SweepRunner::line(std::size_t run, std::atomic<double>& progress) {
  if (stop_.load(std::memory_order_relaxed)) throw RunCancelled{};
  RunResult result;
  SweepRow row;
  PreparedRun prepared;
  SweepStates states;
  try {
    std::shared_ptr<const Model> shared;
    if (auto known = prepared_.extract(run); !known.empty()) {
      prepared = std::move(known.mapped());
      shared = model(run, prepared);
    } else {
      // Checked by another worker: read again, to build from it.
      SweepCase c = read_checked(run);
      prepared = prepared_from(c);
      shared = pool_.get(prepared.fingerprint, prepared.simulation,
                         [&] { return std::move(c.description); });
    }
    RunOptions options;
    options.progress = [&](double fraction) {
      if (stop_.load(std::memory_order_relaxed)) throw RunCancelled{};
      progress.store(fraction, std::memory_order_relaxed);
    };
    const HistoryOrigin origin = origin_of(options_, run, prepared);
    if (options_.keep_results) states.take_from(options, *shared, prepared.simulation, origin);
    try {
      result = floatframe::run(*shared, prepared.simulation, options);
      row = sweep_row(result, options_.measures);
      if (options_.strict) {
        make_strict(row);
        make_strict(result.summary);
      }
    } catch (const RunError& error) {
      row = failed_row(error.what());
      result.summary = failed_summary(shared->name, prepared.simulation, error.what());
    }
  } catch (const InputError& error) {
    row = failed_row(first_error(error));
    result.summary.status = "failed";
    result.summary.message = row.message;
  }
  if (options_.keep_results) {
    result.summary.settings = settings_of(options_, run);
    if (prepared.files) result.summary.files = *prepared.files;
    keep_files(folder_of_run(options_, run), result, states);
  }
  return encode_row(run, row);
}

std::string SweepRunner::files_of_first_run() const {
  ContentHash hash;
  for (const auto& [file, content] : reader_.read(0).fingerprint.files) hash.add(content);
  return hash.text();
}

std::string lost_line(const SweepOptions& options, std::size_t run, const std::string& reason) {
  if (options.keep_results) {
    RunResult result;
    result.summary.status = "failed";
    result.summary.message = reason;
    result.summary.settings = settings_of(options, run);
    keep_files(folder_of_run(options, run), result, {});
  }
  return encode_row(run, failed_row(reason));
}

}  // namespace floatframe
