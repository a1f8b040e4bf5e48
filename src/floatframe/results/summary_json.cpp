#include "floatframe/results/summary_json.hpp"

#include <nlohmann/json.hpp>

#include "floatframe/results/json_values.hpp"
#include "floatframe/results/verification_report.hpp"
#include "floatframe/run/run.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

Json energy(double kinetic, double potential, double elastic, double total) {
  return {{"kinetic_J", kinetic},
          {"potential_J", potential},
          {"elastic_J", elastic},
          {"total_J", total}};
}

/// The last value of a repeated parameter applies.
Json settings(const std::vector<std::string>& list) {
  Json json = Json::object();
  for (const std::string& setting : list) {
    const std::size_t equal = setting.find('=');
    json[setting.substr(0, equal)] = setting.substr(equal + 1);
  }
  return json;
}

/// Null for a run without an energy balance.
Json balance(const EnergySummary& e) {
  if (!e.balanced) return nullptr;
  Json work = Json::object();
  for (std::size_t k = 0; k < EnergyFlows::size(); ++k)
    work[std::string(energy_flow_names[k]) + "_J"] = e.work.value[k];
  work["total_J"] = e.work.total();
  return {{"work", work},
          {"remainder_J", e.remainder},
          {"largest_remainder_J", e.largest_remainder},
          {"largest_remainder_at_s", e.largest_remainder_at},
          {"exchanged_J", e.exchanged},
          {"present_J", e.present}};
}

/// Null for a run without edge detection.
Json edges(const RunSummary& s) {
  if (!s.locates_edges) return nullptr;
  return {{"located", s.edges}, {"steps_with_too_many", s.edges_passed}};
}

Json until(const RunSummary& s) {
  return {{"formula", s.until},
          {"reached", s.crossed_at.has_value()},
          {"time_s", s.crossed_at ? Json(*s.crossed_at) : Json()},
          {"sentence", until_text(s)}};
}

/// Null without a step.
Json step_times(const StepTimes& t) {
  if (t.steps == 0) return nullptr;
  return {{"median_s", t.median},
          {"percent_99_s", t.percent_99},
          {"largest_s", t.largest},
          {"edges_s", t.edges},
          {"counts", t.counts}};
}

Json measured(const RunSummary& s) {
  const EnergySummary& e = s.energy;
  return {{"duration_s", s.duration},
          {"steps", s.steps},
          {"substeps", s.substeps},
          {"iterations", s.iterations},
          {"factorizations", s.factorizations},
          {"edges", edges(s)},
          {"corners", s.corners},
          {"cpu_s", s.cpu},
          {"real_time_factor", s.real_time_factor},
          {"step_times", step_times(s.step_times)},
          {"max_position_violation", s.max_position_violation},
          {"max_velocity_violation", s.max_velocity_violation},
          {"energy",
           {{"start", energy(e.kinetic_start, e.potential_start, e.elastic_start, e.total_start)},
            {"end", energy(e.kinetic_end, e.potential_end, e.elastic_end, e.total_end)},
            {"balance", balance(e)}}},
          {"warnings", sentences(s.warnings)},
          {"start", start_json(s.start)}};
}

}  // namespace

std::string summary_json(const RunSummary& s) {
  Json json = Json::object();
  // Omits figures that were not measured: a model that could not be read, a run that never began or
  // has not ended yet, or a run of a study that was stopped or died.
  const bool ended = s.status != "running";
  const bool began = ended && (s.status != "failed" || s.steps > 0 || s.cpu > 0.0);
  if (began || !s.model.empty())
    json.update({{"model", s.model},
                 {"coordinates", s.coordinates},
                 {"inertia", s.inertia},
                 {"step_s", s.step}});
  if (began) json.update(measured(s));
  if (began && !s.until.empty()) json["until"] = until(s);
  if (began && s.max_load_contraction > 0.0) json["load_contraction"] = s.max_load_contraction;
  if (s.verification) json["verification"] = verification_json(*s.verification);
  json.update({{"status", s.status}, {"message", s.message}});
  if (!s.files.empty()) {
    json["settings"] = settings(s.settings);
    json["files"] = s.files;
  }
  return json_document(json);
}

}  // namespace floatframe
