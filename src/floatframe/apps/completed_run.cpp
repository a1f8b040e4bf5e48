#include "floatframe/apps/completed_run.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "floatframe/core/regular_file.hpp"
#include "floatframe/report/summary_json.hpp"

namespace floatframe {
namespace {

using SummaryJson = nlohmann::json;

std::vector<SummaryJson> contents(const SummaryJson& summary) {
  std::vector<SummaryJson> all;
  if (const auto files = summary.find("files"); files != summary.end())
    for (const SummaryJson& fingerprint : *files) all.push_back(fingerprint);
  std::sort(all.begin(), all.end());
  return all;
}

bool same_duration(const SummaryJson& found, double asked) {
  return found.is_number() && std::abs(found.get<double>() - asked) <= 1e-9 * asked;
}

}  // namespace

EarlierRun earlier_run(const std::string& summary, const RunSummary& asked) {
  std::string text;
  if (!read_regular_file(summary, largest_file_read, text).empty()) return EarlierRun::incomplete;
  const SummaryJson found = SummaryJson::parse(text, nullptr, false);
  if (!found.is_object() || found.value("status", SummaryJson()) != "completed")
    return EarlierRun::incomplete;
  const SummaryJson own = SummaryJson::parse(summary_json(asked));
  for (const char* key : {"model", "coordinates", "inertia", "step_s", "settings"})
    if (found.value(key, SummaryJson()) != own.value(key, SummaryJson())) return EarlierRun::other;
  return same_duration(found.value("duration_s", SummaryJson()), asked.duration) &&
                 contents(found) == contents(own)
             ? EarlierRun::completed
             : EarlierRun::other;
}

}  // namespace floatframe
