// A paced run as JSON, for programs.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "floatframe/apps/realtime_output.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/realtime/signal_log.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

Json histogram_json(const Histogram& h) {
  Json bins = Json::array();
  for (std::size_t k = 0; k < Histogram::bins; ++k)
    if (h.count(k) > 0)
      bins.push_back({1e6 * Histogram::lower(k), 1e6 * Histogram::upper(k), h.count(k)});
  return {{"count", h.count()},
          {"min_us", 1e6 * h.min()},
          {"mean_us", 1e6 * h.mean()},
          {"p50_us", 1e6 * h.percentile(0.5)},
          {"p99_us", 1e6 * h.percentile(0.99)},
          {"p999_us", 1e6 * h.percentile(0.999)},
          {"max_us", 1e6 * h.max()},
          {"bins_us", bins}};
}

Json packets_json(const UdpPort& port) {
  const UdpCounts c = port.counts();
  Json others = Json::array();
  for (const OtherSender& o : port.other_senders())
    others.push_back({{"address", o.address.text()}, {"packets", o.packets}});
  return {{"received", c.received},
          {"used", c.used},
          {"superseded", c.superseded},
          {"stale", c.stale},
          {"mismatched", c.mismatched},
          {"foreign", c.foreign},
          {"of_other_senders", c.other},
          {"sent", c.sent},
          {"repeated", c.repeated},
          {"send_errors", c.send_errors},
          {"largest_age_steps", c.largest_age},
          {"heard", port.peer().known() ? Json(port.peer().text()) : Json(nullptr)},
          {"other_senders", others}};
}

Json silences_json(const RealTimeReport& r) {
  Json list = Json::array();
  const auto listed = std::min(static_cast<std::size_t>(r.input_timeouts), r.silences.size());
  for (std::size_t k = 0; k < listed; ++k)
    list.push_back({{"from_s", r.silences[k].from},
                    {"to_s", r.silences[k].to},
                    {"came_again", r.silences[k].ended}});
  return list;
}

}  // namespace

std::string realtime_json(const RealTimeReport& r, const RealTimeOptions& options,
                          const Model& model, const UdpPort* port) {
  Json json = {{"status", r.status},
               {"message", r.message},
               {"model", r.model},
               {"coordinates", r.coordinates},
               {"inertia", r.inertia},
               {"step_s", r.step},
               {"time_s", r.time},
               {"wall_s", r.wall},
               {"paced", r.paced},
               {"real_time_priority", r.priority},
               {"memory_locked", r.memory_locked},
               {"refusals", r.refusals},
               {"notes", r.start.notes},
               {"warnings", sentences(r.warnings)},
               {"steps", r.steps},
               {"substeps", r.substeps},
               {"iterations", r.iterations},
               {"factorizations", r.factorizations},
               {"cut_short", r.cut_short},
               {"max_position_violation_m", r.max_position_violation},
               {"max_velocity_violation_m_per_s", r.max_velocity_violation},
               {"overruns", {{"program", r.program_overruns}, {"host", r.host_overruns}}},
               {"late_steps", r.late_steps},
               {"slips", r.slips},
               {"slipped_s", r.slipped},
               {"preemptions", r.preemptions},
               {"page_faults", r.page_faults},
               {"stolen_s", r.stolen},
               {"worst_cpu_at_s", r.worst_cpu_at},
               {"worst_cpu_iterations", r.worst_cpu_iterations},
               {"largest_cpu_share", r.cpu.max() / r.step},
               {"steps_above_30_percent", r.cpu.count_above(0.3 * r.step)},
               {"cpu", histogram_json(r.cpu)},
               {"wall_clock", histogram_json(r.elapsed)},
               {"wake_up", histogram_json(r.wake)}};
  if (port != nullptr) json["packets"] = packets_json(*port);
  if (options.log != nullptr)
    json["log"] = {{"rows", options.log->rows()}, {"lost", options.log->lost()}};
  json["by_iterations"] = Json::array();
  for (std::size_t k = 0; k < r.by_iterations.size(); ++k) {
    const StepsOfWork& work = r.by_iterations[k];
    if (work.steps > 0)
      json["by_iterations"].push_back(
          {{"iterations", k},
           {"steps", work.steps},
           {"cpu_mean_us", 1e6 * work.cpu_sum / static_cast<double>(work.steps)},
           {"cpu_max_us", 1e6 * work.cpu_max}});
  }
  json["input_timeouts"] = r.input_timeouts;
  json["silences"] = silences_json(r);
  Json inputs = Json::object(), outputs = Json::object();
  for (std::size_t i = 0; i < r.inputs.size(); ++i)
    inputs[model.inputs[i].name] = {
        {"value", r.inputs[i]}, {"refused", r.refused_inputs[i]}, {"clamped", r.clamped_inputs[i]}};
  for (std::size_t i = 0; i < r.outputs.size(); ++i) outputs[model.outputs[i].name] = r.outputs[i];
  json["inputs"] = inputs;
  json["outputs"] = outputs;
  json["build"] = build_description();
  json["processor"] = processor_name();
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace floatframe
