#include "floatframe/apps/realtime_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "floatframe/apps/command.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/realtime/signal_log.hpp"
#include "floatframe/results/json_values.hpp"
#include "floatframe/results/notes_text.hpp"

namespace floatframe {
namespace {

/// 12.3 us, 4.56 ms, 7.8 s
std::string duration_text(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.1f} us", 1e6 * seconds);
  if (seconds < 1.0) return fmt::format("{:.2f} ms", 1e3 * seconds);
  return fmt::format("{:.2f} s", seconds);
}

std::string percentiles(const Histogram& h) {
  if (h.count() == 0) return "none";
  return fmt::format("mean {}, 99 % within {}, 99.9 % within {}, largest {}",
                     duration_text(h.mean()), duration_text(h.percentile(0.99)),
                     duration_text(h.percentile(0.999)), duration_text(h.max()));
}

/// Rows of half an octave; the bars grow with the logarithm of the count, since the few slow steps
/// that matter would not be visible otherwise.
std::string histogram_text(const Histogram& h) {
  constexpr std::size_t row = Histogram::parts / 2;
  std::string text;
  const double scale = 40.0 / std::log2(static_cast<double>(h.count()) + 1.0);
  std::size_t first = Histogram::bins, last = 0;
  for (std::size_t k = 0; k < Histogram::bins; ++k)
    if (h.count(k) > 0) {
      first = std::min(first, k);
      last = k;
    }
  for (std::size_t k = first / row * row; k <= last; k += row) {
    std::uint64_t n = 0;
    for (std::size_t i = k; i < k + row; ++i) n += h.count(i);
    const std::size_t bar = scale * std::log2(static_cast<double>(n) + 1.0);
    text += fmt::format("  {:>9} to {:>9}  {:>9}  {}\n", duration_text(Histogram::lower(k)),
                        duration_text(Histogram::upper(k + row - 1)), n, std::string(bar, '#'));
  }
  return text;
}

/// Iterations and processor time: the share of computation and the share of machine noise.
std::string iterations_text(const RealTimeReport& r) {
  TextTable table({"Newton iterations", "steps", "mean", "largest"});
  const std::size_t n = r.by_iterations.size();
  for (std::size_t k = 0; k < n; ++k) {
    const StepsOfWork& work = r.by_iterations[k];
    if (work.steps > 0)
      table.add({std::to_string(k) + (k + 1 == n ? " and more" : ""), std::to_string(work.steps),
                 duration_text(work.cpu_sum / static_cast<double>(work.steps)),
                 duration_text(work.cpu_max)});
  }
  return table.empty() ? "" : "\nprocessor time by Newton iterations of the step\n" + table.text(2);
}

std::string silence_text(const RealTimeReport& r, SilenceFallback fallback, double timeout) {
  if (r.input_timeouts == 0) return "";
  if (!r.inputs_came) return "  no inputs received\n";
  std::string text = fmt::format(
      "  inputs missing      {} for more than {:g} s ({}):", plural(r.input_timeouts, "time"),
      timeout,
      fallback == SilenceFallback::hold      ? "last values held"
      : fallback == SilenceFallback::initial ? "back to the initial values"
                                             : "the run stops");
  const auto listed = std::min(static_cast<std::size_t>(r.input_timeouts), r.silences.size());
  for (std::size_t k = 0; k < listed; ++k) {
    const Silence& s = r.silences[k];
    text += fmt::format("{} after t = {:.6g} s {}", k == 0 ? "" : ",", s.from,
                        s.ended ? fmt::format("for {:.3g} s", s.to - s.from) : "to the end");
  }
  return text + (static_cast<long>(listed) < r.input_timeouts ? ", ...\n" : "\n");
}

std::string senders_text(const UdpPort& port) {
  std::string text;
  if (port.gives_inputs())
    text += fmt::format("  partner             {}\n",
                        port.peer().known() ? port.peer().text() : "nobody");
  long listed = 0;
  for (const OtherSender& o : port.other_senders()) {
    text += fmt::format("{}{} ({})", listed == 0 ? "  not accepted        " : ", ",
                        o.address.text(), plural(o.packets, "packet"));
    listed += o.packets;
  }
  const long others = port.counts().other;
  if (others > listed) text += fmt::format(" and others ({})", plural(others - listed, "packet"));
  return listed == 0 ? text : text + "; --peer names the partner\n";
}

std::string port_text(const RealTimeReport& r, const RealTimeOptions& options, const Model& model,
                      const UdpPort& port) {
  const UdpCounts c = port.counts();
  std::string text;
  if (port.gives_inputs())
    text += fmt::format(
        "  inputs              {} received, {} used, {} overtaken by newer ones, {} stale, {} of "
        "another layout, {} foreign, {} of other senders\n",
        plural(c.received, "packet"), c.used, c.superseded, c.stale, c.mismatched, c.foreign,
        c.other);
  text += senders_text(port);
  if (port.wants_outputs())
    text += fmt::format("  outputs             {} sent, {} repeated, {} failed{}\n",
                        plural(c.sent, "packet"), c.repeated, c.send_errors,
                        port.send_error() != 0
                            ? fmt::format(" (the last: {})", std::strerror(port.send_error()))
                            : "");
  for (std::size_t i = 0; i < r.refused_inputs.size(); ++i) {
    const Input& input = model.inputs[i];
    if (r.refused_inputs[i] > 0)
      text += fmt::format(
          "  input '{}'  {} refused: not finite{}\n", input.name,
          plural(r.refused_inputs[i], "value"),
          input.clamp ? "" : fmt::format(" or not from {:g} to {:g}", input.low, input.high));
    if (r.clamped_inputs[i] > 0)
      text += fmt::format("  input '{}'  {} clamped to {:g} ... {:g}\n", input.name,
                          plural(r.clamped_inputs[i], "value"), input.low, input.high);
  }
  return text + silence_text(r, options.fallback, options.input_timeout);
}

std::string log_text(const RealTimeOptions& options) {
  if (options.log == nullptr) return "";
  const SignalLog& log = *options.log;
  std::string text = fmt::format("  log                 {}", plural(log.rows(), "row"));
  if (log.lost() > 0) text += fmt::format(", {} lost", log.lost());
  return text + "\n";
}

using Json = nlohmann::ordered_json;

std::string hash_text(const SignalLayout& layout) {
  return fmt::format("0x{:016x}", layout.hash());
}

std::string limit(double x) { return std::isfinite(x) ? fmt::format("{:g}", x) : ""; }

Json limit_json(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json direction_json(const SignalLayout& layout) {
  return {{"layout", hash_text(layout)}, {"bytes", packet_size(layout.signals.size())}};
}

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

std::string realtime_text(const RealTimeReport& r, const RealTimeOptions& options,
                          const Model& model, const UdpPort* port) {
  std::string text = fmt::format(
      "{}: {:g} s {}, {:.3f} s of wall clock\n"
      "  {} coordinates, inertia terms by {}, step {:g} s\n"
      "  steps               {}, {} by halving, {} cut short, {:.2f} Newton iterations per step\n"
      "  processor time      {}\n"
      "  wall clock          {}\n",
      r.model, r.time, r.paced ? "in step with the wall clock" : "as fast as possible", r.wall,
      r.coordinates, r.inertia, r.step, r.steps, r.substeps, r.cut_short,
      r.steps > 0 ? static_cast<double>(r.iterations) / static_cast<double>(r.steps) : 0.0,
      percentiles(r.cpu), percentiles(r.elapsed));
  text += fmt::format(
      "  share of the step   largest {:.1f} %, at t = {:g} s with {}; {} above 30 %\n",
      100.0 * r.cpu.max() / r.step, r.worst_cpu_at, plural(r.worst_cpu_iterations, "iteration"),
      plural(static_cast<long>(r.cpu.count_above(0.3 * r.step)), "step"));
  if (r.paced) {
    text += fmt::format(
        "  wake-up of the host {}\n"
        "  overruns            {} by the program, {} by the host; {} finished late\n"
        "  clock moved         {}, {} in all\n",
        percentiles(r.wake), r.program_overruns, r.host_overruns, plural(r.late_steps, "step"),
        plural(r.slips, "time"), duration_text(r.slipped));
    text += fmt::format("  stepping thread     {}, memory {}, {}, {}\n",
                        r.priority ? "real-time priority" : "normal priority",
                        r.memory_locked ? "locked" : "not locked",
                        plural(r.preemptions, "preemption"), plural(r.page_faults, "page fault"));
    if (r.stolen > 0.0)
      text += fmt::format("  virtual machine     {} taken by its host, of all processors\n",
                          duration_text(r.stolen));
  }
  if (port != nullptr) text += port_text(r, options, model, *port);
  text += log_text(options);
  text += notes_text(r.start.notes);
  for (const std::string& refusal : r.refusals) text += "  note: " + refusal + "\n";
  if (r.cpu.count() > 0)
    text +=
        "\nprocessor time per step, number of steps (bars: logarithm)\n" + histogram_text(r.cpu);
  text += iterations_text(r);
  if (r.wake.count() > 0)
    text += "\nwake-up latency of the host, number of sleeps\n" + histogram_text(r.wake);
  return text;
}

std::string layout_text(const Model& model) {
  const SignalLayout in = input_layout(model), out = output_layout(model);
  std::string text = fmt::format("inputs of {}: kind 1, layout {}, {} bytes per packet\n",
                                 model.name, hash_text(in), packet_size(in.signals.size()));
  TextTable inputs({"offset", "name", "unit", "initial", "min", "max"}, {1, 2});
  for (std::size_t i = 0; i < model.inputs.size(); ++i) {
    const Input& x = model.inputs[i];
    inputs.add({std::to_string(packet_size(i)), x.name, x.unit, fmt::format("{:g}", x.initial),
                limit(x.low), limit(x.high)});
  }
  text += inputs.empty() ? "  none\n" : inputs.text(2);
  text += fmt::format("\noutputs of {}: kind 2, layout {}, {} bytes per packet\n", model.name,
                      hash_text(out), packet_size(out.signals.size()));
  TextTable outputs({"offset", "name", "unit"}, {1, 2});
  for (std::size_t i = 0; i < out.signals.size(); ++i)
    outputs.add({std::to_string(packet_size(i)), out.signals[i].name, out.signals[i].unit});
  return text + (outputs.empty() ? "  none\n" : outputs.text(2));
}

std::string layout_json(const Model& model) {
  const SignalLayout in = input_layout(model), out = output_layout(model);
  Json inputs = direction_json(in), outputs = direction_json(out);
  inputs["signals"] = outputs["signals"] = Json::array();
  for (std::size_t i = 0; i < model.inputs.size(); ++i) {
    const Input& x = model.inputs[i];
    inputs["signals"].push_back({{"name", x.name},
                                 {"unit", x.unit},
                                 {"offset", packet_size(i)},
                                 {"initial", x.initial},
                                 {"min", limit_json(x.low)},
                                 {"max", limit_json(x.high)},
                                 {"clamp", x.clamp}});
  }
  for (std::size_t i = 0; i < out.signals.size(); ++i)
    outputs["signals"].push_back(
        {{"name", out.signals[i].name}, {"unit", out.signals[i].unit}, {"offset", packet_size(i)}});
  return json_document({{"model", model.name}, {"inputs", inputs}, {"outputs", outputs}});
}

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
  return json_document(json);
}

}  // namespace floatframe
