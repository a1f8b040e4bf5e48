#pragma once
// The loop of a paced run; see realtime.hpp for its behaviour. The constructor
// allocates all memory: `run` does not allocate, lock, print or throw.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "floatframe/realtime/clocks.hpp"
#include "floatframe/realtime/input_watch.hpp"
#include "floatframe/realtime/realtime.hpp"
#include "floatframe/realtime/realtime_rules.hpp"
#include "floatframe/realtime/signal_log.hpp"
#include "floatframe/run/motion_watch.hpp"
#include "floatframe/stepping/stepper.hpp"

namespace floatframe {

class RealTimeRunner {
 public:
  /// Steps the time grid of `model`; `report` is filled by `run`.
  RealTimeRunner(Stepper& model, const RealTimeOptions& options, SignalPort* port,
                 RealTimeReport& report)
      : f_(model.formulation()),
        steps_(model),
        options_(options),
        port_(port),
        inputs_(model.model()),
        row_(model.model().outputs.size() + 1, 0.0),
        report_(report) {}

  /// Checks the start and every step whose end state is already evaluated, else two steps of every
  /// `watch_every`. The results are read after `run`.
  void watched_by(MotionWatch& watch) noexcept { watch_ = &watch; }
  const InputBuffer& inputs() const noexcept { return inputs_; }
  /// Time and outputs at the current state.
  std::span<const double> sample() noexcept {
    steps_.sample(row_.data());
    return row_;
  }

  enum class End { completed, stopped, failed, no_inputs, silent };

  End run() noexcept {
    const rusage before = usage();
    const End end = loop();
    const rusage after = usage();
    report_.preemptions = after.ru_nivcsw - before.ru_nivcsw;
    report_.page_faults = after.ru_minflt - before.ru_minflt + after.ru_majflt - before.ru_majflt;
    report_.StepCounters::operator=(steps_.counters());
    report_.time = steps_.state().t;
    return end;
  }

 private:
  /// Evaluating the end of a step again costs a few per cent of a step. The number is not a
  /// multiple of a vibration period of four or five steps.
  static constexpr long watch_every = 17;

  static rusage usage() noexcept {
    rusage u{};
    getrusage(RUSAGE_THREAD, &u);
    return u;
  }
  bool stopped() const noexcept {
    return options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed);
  }

  End loop() noexcept {
    const long steps = steps_.grid().steps();
    const double h = 1e9 * std::min(steps_.grid().step(), realtime_rules::longest_step);
    const auto period = static_cast<Nanoseconds>(h);
    InputWatch watch(options_, steps_.grid().step(),
                     port_ != nullptr && port_->gives_inputs() && inputs_.size() > 0, report_);
    f_.set_inputs(inputs_.values());
    send(0, steps == 0);
    watch_start();
    const Nanoseconds start = wall_clock();
    base_ = start;
    End end = End::completed;
    for (long k = 0; k < steps; ++k) {
      Nanoseconds due = base_;
      if (stopped() || (options_.paced && !reach(k, h, due))) {
        end = End::stopped;
        break;
      }
      if (port_ != nullptr && !port_->wait()) {
        end = End::no_inputs;
        break;
      }
      const Nanoseconds wall_begin = wall_clock(), cpu_begin = thread_cpu_clock();
      if (!take_inputs(watch)) {
        end = End::silent;
        break;
      }
      const long iterations = steps_.counters().iterations;
      const PlannedStep planned = steps_.grid().next();
      const bool good = steps_.advance(planned);
      if (good) {
        const bool sampled = send(static_cast<std::uint64_t>(k) + 1, k + 1 == steps);
        watch_step(k, sampled, planned.whole);
      }
      const Nanoseconds cpu = thread_cpu_clock() - cpu_begin;
      const Nanoseconds wall_end = wall_clock();
      count(cpu, wall_end - wall_begin, period, steps_.counters().iterations - iterations);
      if (options_.paced && wall_end > due + period) ++report_.late_steps;
      if (options_.progress != nullptr)
        options_.progress->store(steps_.state().t, std::memory_order_relaxed);
      if (!good) {
        end = End::failed;
        break;
      }
    }
    report_.wall = 1e-9 * static_cast<double>(wall_clock() - start);
    watch.finish(steps_.state().t);
    if (end != End::completed) send(static_cast<std::uint64_t>(steps_.counters().steps), true);
    return end;
  }

  /// Sleeps until step k is due or, if the model is too far behind, moves the clock. False:
  /// stopped.
  bool reach(long k, double h, Nanoseconds& due) noexcept {
    due = base_ + std::llround(static_cast<double>(k) * h);
    const Nanoseconds lag = wall_clock() - due;
    if (lag < 0) {
      // A signal ends the sleep early: it either stops the run or is ignored.
      while (!sleep_until(due) && !stopped()) {
      }
      if (stopped()) return false;
      report_.wake.add(wall_clock() - due);
    } else if (lag > static_cast<Nanoseconds>(1e9 * options_.max_lag)) {
      base_ += lag;
      due += lag;
      ++report_.slips;
      report_.slipped += 1e-9 * static_cast<double>(lag);
    }
    return true;
  }

  /// Applies received inputs, or the fallback. False: the fallback ends the run.
  bool take_inputs(InputWatch& watch) noexcept {
    if (port_ != nullptr && port_->receive(inputs_)) {
      watch.received(steps_.state().t);
      f_.set_inputs(inputs_.values());
    } else if (watch.missed()) {
      if (options_.fallback == SilenceFallback::stop && report_.inputs_came) return false;
      if (options_.fallback == SilenceFallback::initial) {
        inputs_.reset();
        f_.set_inputs(inputs_.values());
      }
    }
    return true;
  }

  void count(Nanoseconds cpu, Nanoseconds elapsed, Nanoseconds period, long iterations) noexcept {
    const double seconds = 1e-9 * static_cast<double>(cpu);
    if (seconds > report_.cpu.max()) {
      report_.worst_cpu_at = steps_.state().t;
      report_.worst_cpu_iterations = iterations;
    }
    const auto most = static_cast<long>(report_.by_iterations.size()) - 1;
    StepsOfWork& work = report_.by_iterations[std::min(iterations, most)];
    ++work.steps;
    work.cpu_sum += seconds;
    work.cpu_max = std::max(work.cpu_max, seconds);
    report_.cpu.add(cpu);
    report_.elapsed.add(elapsed);
    if (cpu > period)
      ++report_.program_overruns;
    else if (elapsed > period)
      ++report_.host_overruns;
  }

  void watch_start() noexcept {
    if (watch_ == nullptr) return;
    evaluate();
    const SystemMotion& motion = f_.motion();
    watch_->look(motion);
    watch_->start(motion);
  }

  /// Called after the outputs are sent, off the critical path. Phases are those of one step.
  void watch_step(long step, bool evaluated, bool full) noexcept {
    if (watch_ == nullptr) return;
    // A step with constraints leaves the positions and velocities of its end evaluated.
    const bool held = evaluated || f_.constraints() > 0;
    const long turn = held ? 1 : step % watch_every;
    if (turn > 1) return;
    if (!held) evaluate();
    const SystemMotion& motion = f_.motion();
    watch_->look(motion);
    if (turn == 0)
      watch_->start(motion);
    else if (full)
      watch_->follow(motion);
  }

  void evaluate() noexcept {
    const State& state = steps_.state();
    f_.positions(state.t, state.q);
    f_.velocities(state.v);
  }

  /// Outputs to the port and, once per state, inputs and outputs to the log. True: sampled.
  bool send(std::uint64_t step, bool last) noexcept {
    const bool wanted = port_ != nullptr && port_->wants_outputs();
    const bool logged = options_.log != nullptr && step == next_logged_;
    if (!wanted && !logged) return false;
    steps_.sample(row_.data());
    const std::span<const double> outputs = std::span<const double>(row_).subspan(1);
    if (wanted) port_->send(step, row_[0], outputs, last);
    if (!logged) return true;
    options_.log->push(row_[0], inputs_.values(), outputs);
    ++next_logged_;
    return true;
  }

  Formulation& f_;
  Stepper& steps_;
  RealTimeOptions options_;
  SignalPort* port_;
  InputBuffer inputs_;
  std::vector<double> row_;
  RealTimeReport& report_;
  Nanoseconds base_ = 0;  ///< due time of step 0
  std::uint64_t next_logged_ = 0;
  MotionWatch* watch_ = nullptr;
};

}  // namespace floatframe
