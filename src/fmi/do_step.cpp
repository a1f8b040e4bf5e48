// The steps of an instance.
//
// The importer asks for a step of size H from its own time T. The instance is at t, which may
// differ from T by what rounding has summed up. With the inner step h:
//   - H = n h within 1e-9 h, and t = T within 1e-3 h: n inner steps, whatever the sums of the
//     importer are, so that the times stay those of the model;
//   - else: whole inner steps up to T + H, and a last one shortened to what is left. If that is
//     less than h/2, it and the one before are equal: a step that is much shorter than its
//     neighbours disturbs the accelerations of generalised-alpha by the square of their ratio, and
//     a master repeats it with each step.
#include <chrono>
#include <cmath>

#include "fmi/instance.hpp"

namespace floatframe::fmi {
namespace {

constexpr double step_tolerance = 1e-9;   // of the inner step
constexpr double clock_tolerance = 1e-3;  // of the inner step
constexpr double longest_step = 1e6;      // [s]

/// Of a time, in units of its last place.
double rounding(double time) { return 4.0 * 2.220446049250313e-16 * std::fabs(time); }

}  // namespace

Status Instance::do_step(double at, double size, StepReport& report) noexcept {
  using clock = std::chrono::steady_clock;
  const clock::time_point begin = clock::now();
  report = {false, time()};
  Status status = check_step(at, size);
  if (status == Status::error) return status;
  status = advance(plan(at - time(), size), at + size, report);
  report.time = time();
  count_step(std::chrono::duration<double>(clock::now() - begin).count(), size);
  return status;
}

Status Instance::check_step(double at, double size) noexcept {
  if (!std::isfinite(at))
    return fail("found the communication point %g, expected the time %.17g", at, time());
  if (!(size > 0.0) || size > longest_step)
    return fail("found the step size %g s, expected a positive one of at most %g s", size,
                longest_step);
  const double h = f_.step_size(simulation_);
  if (std::fabs(at - time()) > 0.5 * h)
    return fail("found the communication point %.17g, expected the time %.17g", at, time());
  if (at + size > run_.stop + clock_tolerance * h + rounding(run_.stop))
    return fail("found a step to %.12g s, expected none beyond the stop time %.12g s", at + size,
                run_.stop);
  return Status::ok;
}

Instance::Plan Instance::plan(double offset, double size) const noexcept {
  const double h = f_.step_size(simulation_);
  const double tolerance = step_tolerance * h + rounding(time());
  const double whole = std::round(size / h);
  if (whole > 0.0 && std::fabs(whole * h - size) <= tolerance &&
      std::fabs(offset) <= clock_tolerance * h)
    return {std::int64_t(whole), 0, 0.0};
  const double gap = offset + size;
  if (!(gap > tolerance)) return {};
  const double count = std::floor((gap + tolerance) / h);
  const double rest = gap - count * h;
  if (!(rest > tolerance)) return {std::int64_t(count), 0, 0.0};
  if (count > 0.0 && rest < 0.5 * h) return {std::int64_t(count) - 1, 2, 0.5 * (h + rest)};
  return {std::int64_t(count), 1, rest};
}

Status Instance::advance(Plan plan, double target, StepReport& report) noexcept {
  Status status = Status::ok;
  while (!plan.is_over()) {
    const bool is_whole = plan.whole > 0;
    const floatframe_status found =
        is_whole ? f_.step(simulation_) : f_.step_by(simulation_, plan.size);
    if (found != FLOATFRAME_OK && found != FLOATFRAME_WARNING)
      return fail("%s", f_.message(simulation_));
    if (found == FLOATFRAME_WARNING) {
      status = Status::warning;
      log_.write(status, Category::warning, "%s: %s", function_, f_.message(simulation_));
    }
    --(is_whole ? plan.whole : plan.shorter);
    if (update_ != nullptr && update(plan, target, report) == Status::error) return Status::error;
  }
  return status;
}

/// Calls the importer after an inner step; it may ask for the end of the step now or at a time to
/// come. Whatever it has called wrongly in between ends the run.
Status Instance::update(Plan& plan, double target, StepReport& report) noexcept {
  const char* const function = function_;
  const double now = time();
  const bool can_return = early_return_ && !plan.is_over();
  bool wants_return = false;
  double wanted = now;
  state_ = State::intermediate;
  update_(environment_, now, false, true, true, can_return, &wants_return, &wanted);
  function_ = function;
  if (state_ != State::intermediate) return Status::error;
  state_ = State::stepping;
  if (!can_return || !wants_return || wanted >= target) return Status::ok;
  plan = this->plan(0.0, wanted > now ? wanted - now : 0.0);
  report.early = true;
  return Status::ok;
}

void Instance::count_step(double seconds, double size) noexcept {
  const double share = seconds / size;
  if (share > run_.largest_share) run_.largest_share = share;
  if (!(share > 1.0)) return;
  run_.overruns += 1.0;
  // The first, and whenever their number has doubled: what is said takes time, too.
  int exponent = 0;
  if (std::frexp(run_.overruns, &exponent) != 0.5) return;
  log_.write(Status::ok, Category::overrun,
             "%s: the step of %g s took %g s; %.0f such steps so far", function_, size, seconds,
             run_.overruns);
}

}  // namespace floatframe::fmi
