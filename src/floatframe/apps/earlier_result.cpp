#include "floatframe/apps/earlier_result.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "floatframe/apps/run_files.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/output_place.hpp"
#include "floatframe/core/regular_file.hpp"
#include "floatframe/results/summary_json.hpp"

namespace floatframe {
namespace {

constexpr std::array<const char*, 4> kept_names{"results.csv", "states.ffr", "report.html",
                                                "summary.json"};

void move_file(const std::string& from, const std::string& to) {
  std::error_code error;
  if (!std::filesystem::exists(from, error) || !is_replaceable(from)) return;
  const std::string place = output_place(from).path;
  std::filesystem::rename(place, to, error);
  if (error == std::errc::cross_device_link) {
    error.clear();
    std::filesystem::copy_file(place, to, std::filesystem::copy_options::overwrite_existing, error);
    if (!error) std::filesystem::remove(place, error);
  }
  if (error)
    throw OutputError("the file '" + from + "' cannot be set aside to '" + to +
                      "': " + error.message());
}

using SummaryJson = nlohmann::json;

std::vector<SummaryJson> contents(const SummaryJson& summary) {
  std::vector<SummaryJson> all;
  if (const auto files = summary.find("files"); files != summary.end())
    for (const SummaryJson& fingerprint : *files) all.push_back(fingerprint);
  std::sort(all.begin(), all.end());
  return all;
}

bool same_duration(const SummaryJson& found, double requested) {
  return found.is_number() && std::abs(found.get<double>() - requested) <= 1e-9 * requested;
}

/// It ended before the requested duration, where its formula crosses zero.
bool ended_before(const SummaryJson& found, double requested) {
  const auto until = found.find("until");
  return until != found.end() && until->is_object() && until->value("reached", false) &&
         found.value("duration_s", 0.0) <= requested;
}

}  // namespace

std::string previous_folder(const RunPaths& paths) {
  return (std::filesystem::path(paths.folder) / "previous").string();
}

bool holds_completed_run(const RunPaths& paths) {
  std::string text;
  if (!read_regular_file(paths.summary, largest_file_read, text).empty()) return false;
  const auto found = nlohmann::json::parse(text, nullptr, false);
  return found.is_object() && found.value("status", nlohmann::json()) == "completed";
}

void set_aside(const RunPaths& paths) {
  const std::filesystem::path folder(previous_folder(paths));
  // The results are moved first: if they are missing, an earlier call was killed midway.
  if (std::filesystem::exists(paths.results)) remove_set_aside(paths);
  make_output_folder(folder.string());
  for (const char* name : kept_names)
    move_file((std::filesystem::path(paths.folder) / name).string(), (folder / name).string());
}

void remove_set_aside(const RunPaths& paths) noexcept {
  const std::filesystem::path folder(previous_folder(paths));
  std::error_code ignored;
  // The summary last: it identifies the other files as written by this program.
  for (const char* name : kept_names) std::filesystem::remove(folder / name, ignored);
  std::filesystem::remove(folder, ignored);  // only if empty
}

EarlierRun earlier_run(const std::string& summary, const RunSummary& requested) {
  std::string text;
  if (!read_regular_file(summary, largest_file_read, text).empty()) return EarlierRun::incomplete;
  const SummaryJson found = SummaryJson::parse(text, nullptr, false);
  if (!found.is_object() || found.value("status", SummaryJson()) != "completed")
    return EarlierRun::incomplete;
  const SummaryJson own = SummaryJson::parse(summary_json(requested));
  for (const char* key : {"model", "coordinates", "inertia", "step_s", "settings"})
    if (found.value(key, SummaryJson()) != own.value(key, SummaryJson())) return EarlierRun::other;
  return (same_duration(found.value("duration_s", SummaryJson()), requested.duration) ||
          ended_before(found, requested.duration)) &&
                 contents(found) == contents(own)
             ? EarlierRun::completed
             : EarlierRun::other;
}

}  // namespace floatframe
