#include "floatframe/vehicle/manoeuvre_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "floatframe/core/text_table.hpp"
#include "floatframe/results/json_values.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

constexpr double to_deg = 180.0 / std::numbers::pi;

std::string time_text(const std::optional<double>& t) {
  return t ? fmt::format("{:.4f}", *t) : std::string("-");
}

Json optional_json(const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); }

struct NamedResponse {
  const char* name;
  const char* unit;
  const StepResponse* response;
  double factor;
};

}  // namespace

ManoeuvreReport manoeuvre_report(const std::string& model, const StepSteerResult& r) {
  const NamedResponse all[] = {{"yaw_rate", "deg/s", &r.yaw_rate, to_deg},
                               {"lateral_acceleration", "m/s2", &r.lateral_acceleration, 1.0},
                               {"sideslip", "deg", &r.sideslip, to_deg},
                               {"roll", "deg", &r.roll, to_deg}};
  TextTable table(
      {"response", "unit", "steady", "peak", "90 % after [s]", "peak after [s]", "overshoot [%]"},
      {1});
  Json responses = Json::object();
  for (const auto& [name, unit, y, factor] : all) {
    table.add({name, unit, fmt::format("{:.5g}", factor * y->steady),
               fmt::format("{:.5g}", factor * y->peak), time_text(y->response_time),
               fmt::format("{:.4f}", y->peak_time), fmt::format("{:.2f}", 100.0 * y->overshoot)});
    responses[name] = {{"unit", unit},
                       {"steady", factor * y->steady},
                       {"peak", factor * y->peak},
                       {"response_time_s", optional_json(y->response_time)},
                       {"peak_time_s", y->peak_time},
                       {"overshoot", y->overshoot}};
  }
  const bool reached = !r.asked || std::abs(r.lateral_acceleration.steady - *r.asked) <
                                       step_steer_miss * std::abs(*r.asked);
  std::string text = fmt::format(
      "{}: step steer of {:.4g} deg at the road wheels from {:.2f} km/h (ISO 7401)\n\n{}\n"
      "times from 50 % of the steering at {:.4f} s; TB {:.4g} s deg; speed at the end {:.2f} km/h\n"
      "before the steering: yaw rate below {:.2g} deg/s, speed within {:.2g} m/s\n",
      model, to_deg * r.steering, 3.6 * r.speed, table.text(2), r.t_50, r.tb, 3.6 * r.end_speed,
      to_deg * r.first_second_yaw_rate, r.first_second_drift);
  if (r.asked)
    text += fmt::format(
        "the angle is that of {:.4g} m/s2 of lateral acceleration, {} after {} "
        "{}\n",
        *r.asked, reached ? "found" : "not found", r.runs, r.runs == 1 ? "run" : "runs");
  if (r.unsteadiness > 0.01)
    text +=
        fmt::format("the yaw rate still changes by {:.2g} % at the end: steady values are means\n",
                    100.0 * r.unsteadiness);
  return {text, json_document({{"model", model},
                               {"manoeuvre", "step-steer"},
                               {"speed_m_s", r.speed},
                               {"end_speed_m_s", r.end_speed},
                               {"steering_deg", to_deg * r.steering},
                               {"asked_lateral_acceleration_m_s2", optional_json(r.asked)},
                               {"found", reached},
                               {"runs", r.runs},
                               {"t50_s", r.t_50},
                               {"responses", responses},
                               {"TB_s_deg", r.tb},
                               {"unsteadiness", r.unsteadiness},
                               {"first_second_yaw_rate_deg_s", to_deg * r.first_second_yaw_rate},
                               {"first_second_drift_m_s", r.first_second_drift}})};
}

ManoeuvreReport manoeuvre_report(const std::string& model, const SteadyCircleResult& r) {
  TextTable table({"v [km/h]", "R [m]", "a_y [m/s2]", "steering [deg]", "sideslip [deg]",
                   "roll [deg]", "front slip [deg]", "rear slip [deg]", "understeer",
                   "sideslip grad.", "roll grad."});
  Json points = Json::array();
  for (std::size_t k = 0; k < r.points.size(); ++k) {
    const CirclePoint& p = r.points[k];
    const CircleFigures& f = r.figures[k];
    const auto number = [](double x) { return fmt::format("{:.4f}", x); };
    table.add({fmt::format("{:.2f}", 3.6 * p.speed), fmt::format("{:.3f}", p.radius()),
               number(p.lateral_acceleration), number(to_deg * p.steering),
               number(to_deg * p.sideslip), number(to_deg * p.roll), number(to_deg * f.front_slip),
               number(to_deg * f.rear_slip), number(to_deg * f.understeer_gradient),
               number(to_deg * f.sideslip_gradient), number(to_deg * f.roll_gradient)});
    points.push_back({{"speed_m_s", p.speed},
                      {"radius_m", p.radius()},
                      {"lateral_acceleration_m_s2", p.lateral_acceleration},
                      {"steering_deg", to_deg * p.steering},
                      {"ackermann_deg", to_deg * f.ackermann},
                      {"sideslip_deg", to_deg * p.sideslip},
                      {"roll_deg", to_deg * p.roll},
                      {"front_slip_deg", to_deg * f.front_slip},
                      {"rear_slip_deg", to_deg * f.rear_slip},
                      {"steering_gradient_deg_s2_m", to_deg * f.steering_gradient},
                      {"understeer_gradient_deg_s2_m", to_deg * f.understeer_gradient},
                      {"sideslip_gradient_deg_s2_m", to_deg * f.sideslip_gradient},
                      {"roll_gradient_deg_s2_m", to_deg * f.roll_gradient},
                      {"characteristic_speed_m_s", optional_json(f.characteristic)},
                      {"critical_speed_m_s", optional_json(f.critical)}});
  }
  std::string text = fmt::format(
      "{}: steady circle (ISO 4138, constant radius); steering at the road wheels, gradients in "
      "deg/(m/s2)\n\n{}",
      model, table.text(2));
  if (!r.ended.empty()) text += r.ended + "\n";
  return {text, json_document({{"model", model},
                               {"manoeuvre", "steady-circle"},
                               {"points", points},
                               {"ended", r.ended}})};
}

ManoeuvreReport manoeuvre_report(const std::string& model, const LaneChangeResult& r) {
  TextTable table({"section", "from [m]", "to [m]", "right [m]", "left [m]", "clearance [m]"});
  Json gates = Json::array();
  for (std::size_t k = 0; k < r.gates.size(); ++k) {
    const LaneGate& g = r.gates[k];
    table.add({fmt::format("{}", g.section), fmt::format("{:g}", g.begin),
               fmt::format("{:g}", g.end), fmt::format("{:.3f}", g.right),
               fmt::format("{:.3f}", g.left), fmt::format("{:.3f}", r.clearance[k])});
    gates.push_back({{"section", g.section},
                     {"begin_m", g.begin},
                     {"end_m", g.end},
                     {"right_m", g.right},
                     {"left_m", g.left},
                     {"clearance_m", r.clearance[k]}});
  }
  const std::string text = fmt::format(
      "{}: double lane change (ISO 3888-2), {}\n\n{}\n"
      "speed {:.2f} km/h at the entry, {:.2f} km/h at the end\n"
      "largest lateral acceleration {:.3f} m/s2, yaw rate {:.3f} deg/s, sideslip {:.3f} deg, "
      "steering {:.3f} deg\n",
      model, r.passed ? "passed" : "not passed: cones fall where the clearance is negative",
      table.text(2), 3.6 * r.entry_speed, 3.6 * r.exit_speed, r.largest_lateral_acceleration,
      to_deg * r.largest_yaw_rate, to_deg * r.largest_sideslip, to_deg * r.largest_steering);
  return {text,
          json_document({{"model", model},
                         {"manoeuvre", "double-lane-change"},
                         {"passed", r.passed},
                         {"entry_speed_m_s", r.entry_speed},
                         {"exit_speed_m_s", r.exit_speed},
                         {"gates", gates},
                         {"largest_lateral_acceleration_m_s2", r.largest_lateral_acceleration},
                         {"largest_yaw_rate_deg_s", to_deg * r.largest_yaw_rate},
                         {"largest_sideslip_deg", to_deg * r.largest_sideslip},
                         {"largest_steering_deg", to_deg * r.largest_steering}})};
}

ManoeuvreReport manoeuvre_report(const std::string& model, const StraightStopResult& r) {
  const std::string text = fmt::format(
      "{}: straight stop from {:.2f} km/h with a brake torque of {:.5g} N m, steering held\n\n"
      "  stopping distance            {:.3f} m in {:.3f} s\n"
      "  mean deceleration (MFDD)     {:.4f} m/s2 (UN R13-H, from 80 % to 10 % of the speed)\n"
      "  largest offset, yaw angle    {:.4f} m, {:.4f} deg\n",
      model, 3.6 * r.speed, r.torque, r.distance, r.duration, r.deceleration, r.offset,
      to_deg * r.turned);
  return {text, json_document({{"model", model},
                               {"manoeuvre", "straight-stop"},
                               {"speed_m_s", r.speed},
                               {"torque_N_m", r.torque},
                               {"distance_m", r.distance},
                               {"duration_s", r.duration},
                               {"mfdd_m_s2", r.deceleration},
                               {"largest_offset_m", r.offset},
                               {"largest_yaw_deg", to_deg * r.turned}})};
}

}  // namespace floatframe
