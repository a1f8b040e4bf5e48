// floatframe realtime: steps a model with the wall clock and exchanges inputs and outputs by UDP.
#include <fmt/format.h>

#include <cstring>
#include <memory>

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/realtime_output.hpp"
#include "floatframe/apps/realtime_progress.hpp"
#include "floatframe/apps/stop_signal.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/description/inertia_choice.hpp"
#include "floatframe/model_file/model_fingerprint.hpp"
#include "floatframe/realtime/realtime_rules.hpp"
#include "floatframe/realtime/signal_log.hpp"
#include "floatframe/run/run.hpp"

namespace floatframe {
namespace {

struct RealTimeArguments {
  ModelArguments model;
  std::string coordinates, inertia, step, duration, budget, max_lag, timeout, input_timeout, report,
      log;
  std::string input = "none", output = "none", listen, send, peer, fallback;
  int iterations = 0, priority = 0;
  bool endless = false, lock_step = false, no_pace = false, lock_memory = false, strict = false;
  bool layout = false, json = false, quiet = false, overwrite = false;
};

constexpr const char* default_send = "127.0.0.1:47101";
constexpr std::uint16_t default_input_port = 47100;

RealTimeOptions realtime_options(const RealTimeArguments& arguments) {
  RealTimeOptions options;
  options.paced = !arguments.no_pace;
  options.endless = arguments.endless;
  options.fixed_iterations = arguments.iterations;
  if (!arguments.budget.empty())
    options.time_budget = positive_number("--budget", arguments.budget);
  if (!arguments.max_lag.empty())
    options.max_lag = option_number("--max-lag", arguments.max_lag, realtime_rules::max_lag);
  if (!arguments.input_timeout.empty())
    options.input_timeout =
        option_number("--input-timeout", arguments.input_timeout, realtime_rules::input_timeout);
  options.fallback = arguments.fallback == "initial" ? SilenceFallback::initial
                     : arguments.fallback == "stop"  ? SilenceFallback::stop
                                                     : SilenceFallback::hold;
  options.priority = arguments.priority;
  options.lock_memory = arguments.lock_memory;
  options.strict = arguments.strict;
  options.stop = &StopSignal::flag();
  return options;
}

/// Only the local address that reaches the peer: other networks are not listened to.
UdpAddress listen_address(const RealTimeArguments& arguments, const UdpPortOptions& options) {
  if (!arguments.listen.empty()) return parse_udp_address(arguments.listen, "--listen");
  UdpAddress address = options.outputs        ? local_address_towards(options.send, "--send")
                       : options.peer.known() ? local_address_towards(options.peer, "--peer")
                                              : parse_udp_address("127.0.0.1:0", "--listen");
  address.set_port(options.inputs ? default_input_port : 0);
  return address;
}

/// Rejects an option without the one that it belongs to, since it would have no effect.
void require_pair(const char* option, const std::string& value, bool paired, const char* other) {
  if (!value.empty() && !paired)
    throw InputError(ErrorCode::incomplete,
                     fmt::format("{}: found without {}, expected both", option, other));
}

std::unique_ptr<UdpPort> open_port(const RealTimeArguments& arguments, const Model& model) {
  UdpPortOptions options;
  options.inputs = arguments.input == "udp";
  options.outputs = arguments.output == "udp";
  options.lock_step = arguments.lock_step;
  options.stop = &StopSignal::flag();
  if (!arguments.timeout.empty())
    options.timeout = option_number("--timeout", arguments.timeout, realtime_rules::timeout);
  if (options.lock_step && !(options.inputs && options.outputs))
    throw InputError(ErrorCode::incomplete,
                     "--lockstep: found without --input udp and --output udp, expected both");
  require_pair("--listen", arguments.listen, options.inputs || options.outputs,
               "--input udp or --output udp");
  require_pair("--send", arguments.send, options.outputs, "--output udp");
  require_pair("--peer", arguments.peer, options.inputs, "--input udp");
  require_pair("--timeout", arguments.timeout, options.lock_step, "--lockstep");
  require_pair("--input-timeout", arguments.input_timeout, options.inputs, "--input udp");
  require_pair("--fallback", arguments.fallback, options.inputs, "--input udp");
  if (!options.inputs && !options.outputs) return nullptr;
  if (options.inputs && model.inputs.empty())
    throw InputError(
        ErrorCode::missing,
        fmt::format("--input udp: found no inputs in the model '{}', expected a section 'inputs'",
                    model.name));
  options.send =
      parse_udp_address(arguments.send.empty() ? default_send : arguments.send, "--send");
  if (options.outputs && options.send.port() == 0)
    throw InputError(
        ErrorCode::out_of_range,
        fmt::format("--send: found '{}', expected a port from 1 to 65535", arguments.send));
  // Accept packets from --peer; without it, from the first sender.
  if (!arguments.peer.empty())
    options.peer = parse_udp_peer(arguments.peer, "--peer");
  else if (options.outputs && !arguments.send.empty())
    options.peer = options.send;
  options.listen = listen_address(arguments, options);
  if (options.outputs && options.listen.family() != options.send.family())
    throw InputError(
        ErrorCode::exclusive,
        fmt::format("--listen: found {} with --send {}, expected both IPv4 or both IPv6",
                    options.listen.text(), options.send.text()));
  // A socket bound to the IPv6 wildcard address receives IPv4 as well.
  if (options.inputs && options.peer.known() && options.peer.family() != options.listen.family() &&
      !options.listen.text().starts_with("[::]"))
    throw InputError(ErrorCode::exclusive,
                     fmt::format("--peer: found {}, which cannot send packets to {}, expected "
                                 "both IPv4 or both IPv6",
                                 options.peer.text(), options.listen.text()));
  return std::make_unique<UdpPort>(model, options);
}

std::string port_line(const RealTimeArguments& arguments, const UdpPort& port) {
  std::string text;
  if (arguments.input == "udp")
    text += fmt::format("listening at {} to {}", port.local().text(),
                        port.peer().known() ? port.peer().text() : "the first sender");
  if (arguments.output == "udp")
    text += fmt::format("{}sending to {}", text.empty() ? "" : ", ",
                        arguments.send.empty() ? default_send : arguments.send);
  return text + "\n";
}

int run_paced(const RealTimeArguments& arguments) {
  if (arguments.endless && !arguments.duration.empty())
    throw InputError(ErrorCode::exclusive, "--duration: excludes --endless; remove one of them");
  if (arguments.json && !arguments.layout)
    throw InputError(ErrorCode::incomplete,
                     "--json: found without --layout; a run writes JSON with --report FILE");
  ModelFingerprint used;
  ModelDescription description = read_model(arguments.model, false, &used);
  set_formulation(description.simulation, arguments.coordinates, arguments.inertia);
  set_time_options(description.simulation, arguments.step, arguments.duration);
  check_inertia_method(description, description.simulation.inertia);
  const Model model = build_model(description);
  if (arguments.layout) {
    print(arguments.json ? layout_json(model) : layout_text(model));
    return 0;
  }
  RealTimeOptions options = realtime_options(arguments);
  require_valid(options, description.simulation);
  // The log is opened at the start and may be a pipe with a reader.
  require_distinct({{"--log", arguments.log}, {"--report", arguments.report}}, files_of(used));
  require_writable({{"--report", arguments.report}}, {}, arguments.overwrite);
  if (!arguments.log.empty() && !arguments.overwrite) require_own({"--log", arguments.log});
  const StopSignal stop_signal;
  const std::unique_ptr<UdpPort> port = open_port(arguments, model);
  if (port && !arguments.quiet) print(port_line(arguments, *port));

  std::unique_ptr<SignalLog> log;
  if (!arguments.log.empty()) {
    try {
      log = std::make_unique<SignalLog>(model, arguments.log, arguments.no_pace);
    } catch (const OutputError& error) {
      throw InputError(ErrorCode::unreadable, fmt::format("--log: {}", error.what()));
    }
    options.log = log.get();
  }
  RealTimeReport report;
  {
    RealTimeProgress progress(
        arguments.quiet || arguments.endless ? 0.0 : description.simulation.duration,
        port && port->gives_inputs(), options.fallback);
    options.progress = &progress.time;
    options.silent_since = &progress.silent_since;
    report = run_real_time(model, description.simulation, options, port.get());
  }
  if (log) log->finish();
  if (!arguments.report.empty())
    write_file(arguments.report, realtime_json(report, options, model, port.get()));
  if (!arguments.quiet) print(realtime_text(report, options, model, port.get()));
  for (const RangeWarning& warning : report.warnings) say("warning: " + warning.sentence);
  if (report.status == "failed") say("the run failed: " + report.message);
  const bool log_failed = log && log->error() != 0;
  if (log_failed)
    say(fmt::format("'{}' is incomplete: {}", arguments.log, std::strerror(log->error())));
  return report.status == "failed" || log_failed ? 1 : 0;
}

std::vector<Option> options_of(RealTimeArguments& a) {
  const auto seconds = [](const char* name, std::string& value, const char* help) {
    return text_option(name, value, "SECONDS", help);
  };
  return {
      coordinates_option(a.coordinates),
      inertia_option(a.inertia),
      seconds("--step", a.step, "Time step [s]; default: that of the model file"),
      seconds("--duration", a.duration, "Time to run [s]; default: that of the model file"),
      flag("--endless", a.endless, "Run until Ctrl-C instead"),
      word_option("--input", a.input, {"udp", "none"},
                  "Where inputs come from: udp or none (default)"),
      word_option("--output", a.output, {"udp", "none"},
                  "Where outputs go to: udp or none (default)"),
      text_option(
          "--listen", a.listen, "HOST:PORT",
          "Local address for inputs; default: port 47100 of the address that the peer reaches"),
      text_option("--send", a.send, "HOST:PORT",
                  "Where outputs go to, and the only sender accepted; default: 127.0.0.1:47101"),
      text_option("--peer", a.peer, "HOST[:PORT]",
                  "The only sender accepted; default: that of --send, or else the first to send"),
      flag("--lockstep", a.lock_step,
           "Wait before each step for the inputs that answer the last outputs"),
      seconds("--timeout", a.timeout, "Longest wait of --lockstep; default: 5"),
      seconds("--input-timeout", a.input_timeout,
              "Report if no inputs arrive for so long; default: 1; 0: never"),
      word_option("--fallback", a.fallback, {"hold", "initial", "stop"},
                  "Inputs from then on: hold the last values (default), initial values, or stop"),
      whole_option("--iterations", a.iterations, 1, realtime_rules::fixed_iterations.high,
                   "Fixed number of Newton iterations per step; default: to convergence"),
      seconds("--budget", a.budget,
              "No Newton iteration starts later than this after the start of a step"),
      seconds("--max-lag", a.max_lag,
              "Late steps catch up to this lag, then the clock is moved; default: 0.1"),
      whole_option("--priority", a.priority, 1, realtime_rules::priority.high,
                   "Real-time priority (SCHED_FIFO)", "1-99"),
      flag("--lock-memory", a.lock_memory, "Keep all memory of the program resident"),
      flag("--strict", a.strict, "Fail if the priority or the locked memory is not granted"),
      flag("--no-pace", a.no_pace, "As fast as possible, without the wall clock"),
      text_option("--report", a.report, "FILE",
                  "Write figures and histograms to this file as JSON"),
      text_option("--log", a.log, "FILE",
                  "Write inputs and outputs of every step to this CSV file"),
      overwrite_option(a.overwrite),
      flag("--layout", a.layout, "Only print names and order of the values in the packets"),
      flag("--json", a.json, "With --layout: as JSON"),
      flag("--quiet", a.quiet,
           "No progress, no summary; errors and missing inputs are still shown")};
}

}  // namespace

Command realtime_command() {
  const auto a = std::make_shared<RealTimeArguments>();
  return {
      .name = "realtime",
      .help = "Run a model in step with the wall clock; exchange inputs and outputs by UDP",
      .options = joined(model_options(a->model), options_of(*a)),
      .footer =
          "Ctrl-C ends the run with its summary. The packets are described in docs/realtime.md.\n"
          "Exit codes: 0 done or stopped, 1 failed, 2 bad input.",
      .run = [a] { return run_paced(*a); }};
}

}  // namespace floatframe
