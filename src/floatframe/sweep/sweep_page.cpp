#include "floatframe/sweep/sweep_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/model_file/model_fingerprint.hpp"
#include "floatframe/page/kept_run.hpp"
#include "floatframe/page/page_curves.hpp"
#include "floatframe/page/page_json.hpp"
#include "floatframe/page/page_writer.hpp"
#include "floatframe/results/results_reader.hpp"
#include "floatframe/sweep/sweep_run.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

bool is_complete(const SweepRow& row) { return row.status == "completed"; }

/// "tip.z max [m]" -> "tip.z max", "m".
std::pair<std::string, std::string> name_and_unit(const std::string& title) {
  const std::size_t at = title.rfind(" [");
  if (at == std::string::npos || !title.ends_with(']')) return {title, ""};
  return {title.substr(0, at), title.substr(at + 2, title.size() - at - 3)};
}

/// The name of a figure in the table, without its unit.
std::string figure_name(const SweepMeasure& m) {
  std::string words = m.statistic;
  std::replace(words.begin(), words.end(), '_', ' ');
  return m.output + ' ' + words;
}

/// Not a number if the row has no such figure.
double figure_of(const SweepRow& row, const std::string& name) {
  for (const auto& [title, value] : row.fields)
    if (name_and_unit(title).first == name) return std::strtod(value.c_str(), nullptr);
  return not_known;
}

/// The completed runs from best to worst; without a ranking by number.
std::vector<std::size_t> in_order(const std::optional<SweepRanking>& ranking,
                                  const std::vector<SweepRow>& rows) {
  std::vector<std::size_t> runs;
  std::vector<double> cost(rows.size(), 0.0);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (!is_complete(rows[k])) continue;
    if (ranking) {
      cost[k] = figure_of(rows[k], figure_name(ranking->measure));
      if (ranking->largest) cost[k] = -cost[k];
      if (!std::isfinite(cost[k])) continue;
    }
    runs.push_back(k);
  }
  std::stable_sort(runs.begin(), runs.end(),
                   [&](std::size_t a, std::size_t b) { return cost[a] < cost[b]; });
  return runs;
}

Json variables_json(const SweepPlan& plan) {
  Json out = Json::array();
  for (std::size_t k = 0; k < plan.names.size(); ++k) {
    Json values = Json::array();
    for (const auto& run : plan.runs) values.push_back(run[k]);
    out.push_back({{"name", plan.names[k]}, {"values", std::move(values)}});
  }
  return out;
}

/// All figures of the table by their titles, each with one number per run.
Json measures_json(const std::vector<SweepRow>& rows, PageBuffer& buffer) {
  std::vector<std::string> titles;
  std::map<std::string, std::vector<double>> columns;
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (const auto& [title, value] : rows[k].fields) {
      const auto [it, added] = columns.try_emplace(title, rows.size(), not_known);
      if (added) titles.push_back(title);
      it->second[k] = std::strtod(value.c_str(), nullptr);
    }
  Json out = Json::array();
  for (const std::string& title : titles) {
    const auto [name, unit] = name_and_unit(title);
    out.push_back({{"name", name},
                   {"unit", unit},
                   {"values", buffer.add(std::span<const double>(columns[title]), {rows.size()})}});
  }
  return out;
}

/// The kept results of a run; no columns if there are none, or none that can be read.
ResultTable kept_results(const std::string& folder) {
  ResultTable table;
  const std::string file = (std::filesystem::path(folder) / "results.csv").string();
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return table;
  try {
    ResultsReader in(file);
    while (in.next()) table.data.insert(table.data.end(), in.row().begin(), in.row().end());
    table.columns = in.columns();
  } catch (const InputError&) {
    table = {};
  }
  return table;
}

/// Curves over each other: the same outputs of many runs, thinned so that peaks are kept.
Json study_curves(const SweepOptions& options, const std::vector<std::size_t>& runs,
                  PageBuffer& buffer) {
  std::vector<std::string> names;
  Json channels = Json::array(), out = Json::array();
  for (const std::size_t run : runs) {
    const ResultTable table = kept_results(folder_of_run(options, run));
    if (table.rows() == 0 || table.columns.size() < 2) continue;
    const std::size_t width = table.columns.size();
    const std::size_t share = most_numbers_of_curves / runs.size();
    const PageCurves curves =
        page_curves(table.columns, table.rows(), std::min(share, 2000 * (width - 1)),
                    [&](std::size_t row, double* to) {
                      std::ranges::copy(std::span(table.data).subspan(row * width, width), to);
                    });
    Json which = Json::array();
    std::vector<float> values;
    for (std::size_t c = 1; c < width; ++c) {
      const Column& column = table.columns[c];
      const auto known = std::find(names.begin(), names.end(), column.name);
      which.push_back(known - names.begin());
      if (known == names.end()) {
        names.push_back(column.name);
        channels.push_back({{"name", column.name}, {"unit", column.unit}});
      }
      values.insert(values.end(), curves.values[c - 1].begin(), curves.values[c - 1].end());
    }
    out.push_back(
        {{"run", run},
         {"channels", std::move(which)},
         {"time", buffer.add(std::span<const double>(curves.time), {curves.time.size()})},
         {"values", buffer.add(std::span<const float>(values), {width - 1, curves.time.size()})}});
  }
  if (out.empty()) return nullptr;
  return {{"channels", std::move(channels)}, {"runs", std::move(out)}};
}

/// Runs a completed run of the study once more, with its states, and writes its files and its page.
void open_run(SweepRunner& runner, const SweepOptions& options, std::size_t run,
              const std::string& folder, const std::atomic<bool>& stop) {
  const PreparedRun prepared = runner.prepare(run);
  const std::shared_ptr<const Model> model = runner.model(run, prepared);
  RunOptions watched;
  watched.progress = [&](double) {
    if (stop.load(std::memory_order_relaxed)) throw RunCancelled{};
  };
  KeptRun kept = run_and_keep(*model, prepared.simulation, watched);
  kept.model_file = options.model;
  kept.settings = settings_of(options, run);
  if (prepared.files)
    kept.source = {*prepared.files, relative_to_model(options.model, *prepared.files), ""};
  save_run(*model, kept, folder);
}

/// As the address of a link: all but letters, digits and a few signs by their codes.
std::string address_of(const std::filesystem::path& file, const std::filesystem::path& from) {
  std::error_code ignored;
  const std::filesystem::path whole = std::filesystem::absolute(from, ignored).parent_path();
  const std::string text =
      std::filesystem::absolute(file, ignored).lexically_relative(whole).generic_string();
  std::string out;
  for (const char c : text) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                       std::string_view("/._-").find(c) != std::string_view::npos;
    out += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

/// {"best": {"run", "address"}, "worst": ...}
Json pages_json(const SweepOptions& options, const RankedRuns& ranked,
                const std::atomic<bool>& stop) {
  SweepRunner runner(options, stop);
  Json pages = Json::object();
  for (const auto& [name, run] : {std::pair{"best", ranked.best}, {"worst", ranked.worst}}) {
    const std::filesystem::path folder = std::filesystem::path(options.folder) / name;
    open_run(runner, options, run, folder.string(), stop);
    pages[name] = {{"run", run}, {"address", address_of(folder / "report.html", options.report)}};
  }
  return pages;
}

FactTable study_facts(const SweepOptions& o) {
  FactTable facts{"Study", {{"model file", o.model}}};
  for (const SweepSetting& s : o.fixed) facts.rows.push_back({s.name, s.value});
  for (const std::string& name : o.plan.names) facts.rows.push_back({name, "varied"});
  facts.rows.push_back({"table", (std::filesystem::path(o.folder) / "sweep.csv").string()});
  return facts;
}

Json status_json(const SweepReport& report) {
  const std::string runs = plural(static_cast<long>(report.runs), "run");
  Json warnings = Json::array();
  if (report.failed > 0)
    warnings.push_back(fmt::format("{} of {} failed, the first is run {}: {}", report.failed, runs,
                                   report.first_failed, report.first_message));
  if (report.warned > 0)
    warnings.push_back(fmt::format("{} of {} left the range of the method.", report.warned, runs));
  for (const SweepWarnings& w : report.warnings)
    warnings.push_back(fmt::format("Run {}{}: {}", w.first,
                                   w.runs > 1 ? fmt::format(" (and {} more)", w.runs - 1) : "",
                                   w.sentence));
  return {{"state", report.failed > 0 ? "failed" : "completed"},
          {"sentences", {fmt::format("A study of {}.", runs)}},
          {"warnings", std::move(warnings)}};
}

}  // namespace

std::optional<RankedRuns> ranked_runs(const std::optional<SweepRanking>& ranking,
                                      const std::vector<SweepRow>& rows) {
  if (!ranking) return std::nullopt;
  const std::vector<std::size_t> runs = in_order(ranking, rows);
  if (runs.empty()) return std::nullopt;
  return RankedRuns{runs.front(), runs.back()};
}

std::vector<std::size_t> evenly_chosen(const std::vector<std::size_t>& runs, std::size_t count) {
  if (runs.size() <= count || count < 2) return runs;
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < count; ++k)
    chosen.push_back(runs[k * (runs.size() - 1) / (count - 1)]);
  return chosen;
}

void write_sweep_page(const SweepOptions& options, const std::vector<SweepRow>& rows,
                      const std::atomic<bool>& stop, const SweepReport& report) {
  PageBuffer buffer;
  Json states = Json::array(), messages = Json::array();
  for (const SweepRow& row : rows) {
    states.push_back(row.status);
    messages.push_back(row.message);
  }
  const std::vector<std::size_t> complete = in_order(options.ranking, rows);
  const std::vector<std::size_t> shown = evenly_chosen(complete, most_runs_with_curves);
  Json study{{"variables", variables_json(options.plan)},
             {"states", std::move(states)},
             {"messages", std::move(messages)},
             {"measures", measures_json(rows, buffer)}};
  study["curves"] = study_curves(options, shown, buffer);
  study["runs_without_curves"] = complete.size() - shown.size();
  study["ranking"] = nullptr;
  study["pages"] = nullptr;
  if (options.ranking)
    study["ranking"] = {{"measure", figure_name(options.ranking->measure)},
                        {"largest", options.ranking->largest}};
  if (const auto ranked = ranked_runs(options.ranking, rows))
    study["pages"] = pages_json(options, *ranked, stop);
  Json page = empty_page("sweep", std::filesystem::path(options.model).stem().string(),
                         build_description(), status_json(report));
  page["facts"] = facts_json({study_facts(options)});
  page["study"] = std::move(study);
  write_file(options.report, page_html(page_template(), page, buffer));
}

}  // namespace floatframe
