// floatframe vehicle: manoeuvres of a vehicle and their figures.
#include <cmath>
#include <initializer_list>
#include <memory>
#include <numbers>
#include <utility>

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/progress_bar.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/number_rule.hpp"
#include "floatframe/core/thread_clock.hpp"
#include "floatframe/description/inertia_choice.hpp"
#include "floatframe/model_file/model_fingerprint.hpp"
#include "floatframe/page/kept_run.hpp"
#include "floatframe/vehicle/manoeuvre_report.hpp"
#include "floatframe/vehicle/rig_report.hpp"

namespace floatframe {
namespace {

struct VehicleArguments {
  ModelArguments model;
  std::string manoeuvre, rig, travel, speed, radius, angle, torque, acceleration;
  std::string step, coordinates, inertia, out;
  bool right = false, json = false;
};

/// "80km/h" or "22.2m/s" [m/s].
double speed_of(const std::string& text) {
  std::string number = text.empty() ? "80km/h" : text;
  double factor = 0.0;
  for (const auto& [unit, size] : {std::pair{"km/h", 1.0 / 3.6}, std::pair{"m/s", 1.0}})
    if (number.ends_with(unit)) {
      number.resize(number.size() - std::string(unit).size());
      factor = size;
      break;
    }
  while (number.ends_with(' ')) number.pop_back();
  try {
    const double size = option_number("--speed", number, positive_number("m/s"));
    if (factor > 0.0) return factor * size;
  } catch (const InputError&) {
    throw InputError(
        ErrorCode::out_of_range,
        "--speed: found '" + text + "', expected a positive number with km/h or m/s, as 80km/h");
  }
  throw InputError(ErrorCode::wrong_value, "--speed: found '" + text + "', expected a unit: " +
                                               number + "km/h or " + number + "m/s");
}

/// An option that the manoeuvre does not read would say something that is not so.
void require_own_options(const VehicleArguments& a) {
  const bool rig = !a.rig.empty();
  const std::string what = rig ? "--rig " + a.rig : "--manoeuvre " + a.manoeuvre;
  const auto only = [&](const char* option, bool given, std::initializer_list<const char*> of) {
    if (!given) return;
    std::string expected;
    for (const char* m : of) {
      if (!rig && a.manoeuvre == m) return;
      expected += (expected.empty() ? "" : " or ") + std::string(m);
    }
    throw InputError(ErrorCode::exclusive, std::string(option) + ": found it with " + what +
                                               ", expected it with " + expected);
  };
  const auto all = {"steady-circle", "step-steer", "double-lane-change", "straight-stop"};
  only("--radius", !a.radius.empty(), {"steady-circle"});
  only("--angle", !a.angle.empty(), {"step-steer"});
  only("--lateral-acceleration", !a.acceleration.empty(), {"step-steer"});
  if (!a.acceleration.empty() && !a.angle.empty())
    throw InputError(ErrorCode::exclusive,
                     "--lateral-acceleration: found it with --angle, expected one of both");
  only("--torque", !a.torque.empty(), {"straight-stop"});
  only("--right", a.right, {"steady-circle", "step-steer"});
  only("--speed", rig && !a.speed.empty(), all);
  if (!rig && !a.travel.empty())
    throw InputError(ErrorCode::exclusive,
                     "--travel: found it with " + what + ", expected it with --rig k-and-c");
}

SteadyCircleOptions circle_options(const VehicleArguments& a, double speed) {
  SteadyCircleOptions o{.speed = speed, .right = a.right};
  if (!a.radius.empty()) o.radius = option_number("--radius", a.radius, positive_number("m"));
  return o;
}

StepSteerOptions step_options(const VehicleArguments& a, double speed) {
  StepSteerOptions o{.speed = speed};
  NumberRule rule = positive_number("deg");
  rule.what = "a positive number up to 40";
  rule.high = 40.0;
  if (!a.angle.empty())
    o.angle = option_number("--angle", a.angle, rule) * std::numbers::pi / 180.0;
  if (!a.acceleration.empty())
    o.lateral_acceleration =
        option_number("--lateral-acceleration", a.acceleration, positive_number("m/s2"));
  if (a.right) o.angle = -o.angle;
  if (a.right && o.lateral_acceleration) *o.lateral_acceleration *= -1.0;
  return o;
}

/// Without --torque, all that the brakes can do.
StraightStopOptions stop_options(const VehicleArguments& a, const VehicleRun& run, double speed) {
  StraightStopOptions o{.speed = speed};
  o.torque = run.highest_braking() * run.wheel_radius();
  if (!a.torque.empty()) o.torque = option_number("--torque", a.torque, positive_number("N m"));
  if (!std::isfinite(o.torque))
    throw InputError(ErrorCode::missing,
                     "--torque: found none, expected the torque of all brakes "
                     "[N m], since the brake input has no limit");
  return o;
}

/// Of the trimmed start.
double start_speed(const VehicleArguments& a, double speed) {
  return a.manoeuvre == "steady-circle" ? first_speed(circle_options(a, speed)) : speed;
}

ManoeuvreReport drive(VehicleRun& run, const VehicleArguments& a, double speed) {
  const std::string& model = run.model().name;
  if (a.manoeuvre == "step-steer")
    return manoeuvre_report(model, step_steer(run, step_options(a, speed)));
  if (a.manoeuvre == "steady-circle")
    return manoeuvre_report(model, steady_circle(run, circle_options(a, speed)));
  if (a.manoeuvre == "straight-stop")
    return manoeuvre_report(model, straight_stop(run, stop_options(a, run, speed)));
  return manoeuvre_report(model, lane_change(run, speed));
}

/// results.csv, report.html and summary.json, of the record; `taken` by the manoeuvre.
void save_record(VehicleRun& run, const VehicleArguments& a, const ModelFingerprint& used,
                 Nanoseconds taken) {
  if (a.out.empty()) return;
  KeptRun kept;
  kept.options = run.options();
  kept.result.table = std::move(run.table);
  RunSummary& summary = kept.result.summary;
  StepCounters& counters = summary;
  counters = run.counters();
  summary.model = run.model().name;
  summary.coordinates = word(run.options().coordinates);
  summary.inertia = word(run.options().inertia);
  summary.step = run.options().step;
  summary.duration = run.now().time;
  summary.cpu = 1e-9 * taken;
  summary.real_time_factor = summary.cpu > 0.0 ? summary.duration / summary.cpu : 0.0;
  summary.start = run.start_report();
  kept.model_file = a.model.path;
  kept.settings = a.model.settings;
  kept.source.files = used.files;
  save_run(run.model(), kept, a.out);
}

int put_on_rig(const VehicleArguments& a, const ModelDescription& description) {
  RigOptions options;
  if (!a.travel.empty()) options.travel = option_number("--travel", a.travel, positive_number("m"));
  const RigFigures figures = suspension_figures(description, options);
  const ManoeuvreReport report = rig_report(description.name, figures);
  if (!a.out.empty()) save_rig(figures, report, a.out);
  print(a.json ? report.json : report.text);
  return exit_code::done;
}

int drive_vehicle(const VehicleArguments& a) {
  require_own_options(a);
  const double speed = speed_of(a.speed);
  ModelFingerprint used;
  ModelDescription description = read_model(a.model, false, &used);
  set_time_options(description.simulation, a.step, "");
  set_formulation(description.simulation, a.coordinates, a.inertia);
  check_inertia_method(description, description.simulation.inertia);
  if (!a.rig.empty()) return put_on_rig(a, description);
  const VehicleNeeds needs{.steering = true,
                           .drive = true,
                           .brake = a.manoeuvre == "straight-stop",
                           .width = a.manoeuvre == "double-lane-change",
                           .patches = a.manoeuvre == "straight-stop"};
  VehicleRun run(vehicle_setup(std::move(description), a.manoeuvre, needs, start_speed(a, speed)));
  const Nanoseconds before = thread_cpu_clock();
  const ManoeuvreReport report = [&] {
    const ListenToProgress listen(progress_on_terminal(true));
    return drive(run, a, speed);
  }();
  save_record(run, a, used, thread_cpu_clock() - before);
  print(a.json ? report.json : report.text);
  return exit_code::done;
}

}  // namespace

Command vehicle_command() {
  const auto a = std::make_shared<VehicleArguments>();
  a->manoeuvre = "step-steer";
  return {
      .name = "vehicle",
      .help = "Drive a manoeuvre with the model of a vehicle, and print its figures",
      .options = joined(
          model_options(a->model),
          {word_option("--manoeuvre", a->manoeuvre,
                       {"steady-circle", "step-steer", "double-lane-change", "straight-stop"},
                       "Figures of ISO 4138 (constant radius), ISO 7401, ISO 3888-2 or UN R13-H "
                       "(default step-steer)"),
           word_option(
               "--rig", a->rig, {"k-and-c"},
               "Instead: toe, camber, track and wheel rate over travel, roll and steer, and "
               "compliance under forces of the tyres"),
           text_option("--travel", a->travel, "METRES",
                       "Largest travel on the rig, up and down (default 0.06)"),
           text_option(
               "--speed", a->speed, "SPEED",
               "With its unit, km/h or m/s (default 80km/h): of the last point of a circle, "
               "else at the start"),
           text_option("--radius", a->radius, "METRES", "Of the circle (default 100)"),
           text_option("--angle", a->angle, "DEGREES",
                       "Of the step at the road wheels, up to 40 (default 1)"),
           text_option("--lateral-acceleration", a->acceleration, "M/S2",
                       "Steady one of the step, in place of --angle"),
           text_option("--torque", a->torque, "NM",
                       "Of all brakes in a straight stop (default: the limit of the brake input)"),
           flag("--right", a->right, "Circle or step to the right instead of to the left"),
           text_option("--step", a->step, "SECONDS", "Time step, otherwise that of the model"),
           coordinates_option(a->coordinates), inertia_option(a->inertia),
           flag("--json", a->json, "JSON on standard output"),
           text_option("-o,--out", a->out, "FOLDER",
                       "Also write results.csv, report.html and summary.json there; on the rig "
                       "travel.csv, roll.csv, steer.csv and summary.json")}),
      .footer =
          "The model needs the section `vehicle` (docs/vehicle.md) and a flat road. It starts "
          "trimmed:\n"
          "driven straight on until nothing changes, which is time zero.\n"
          "Exit codes: 0 done, 1 the start or the manoeuvre fails, 2 bad input.",
      .run = [a] { return drive_vehicle(*a); }};
}

}  // namespace floatframe
