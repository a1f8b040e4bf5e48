#include "floatframe/vehicle/rig_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "floatframe/core/text_table.hpp"
#include "floatframe/results/json_values.hpp"

namespace floatframe {
namespace {

using RigJson = nlohmann::ordered_json;

constexpr double rig_deg = 180.0 / std::numbers::pi;

/// Null where a figure means nothing.
RigJson shown(bool means, double x) { return means ? RigJson(x + 0.0) : RigJson(nullptr); }

RigJson wheel_json(const RigWheel& w, bool moves) {
  return {{"height_m", w.height + 0.0},
          {"x_m", shown(moves, w.x)},
          {"y_m", shown(moves, w.y)},
          {"steer_deg", shown(moves, rig_deg * w.steer)},
          {"toe_deg", shown(moves, rig_deg * w.toe)},
          {"camber_deg", shown(moves, rig_deg * w.camber)},
          {"force_N", w.force},
          {"rate_N_m", shown(w.rate.has_value(), w.rate.value_or(0.0))}};
}

/// A sweep that steers does not move every axle.
struct ShownSweep {
  const char* name;
  const std::vector<RigPoint>& points;
  bool steers = false;
  bool moves(std::size_t axle) const { return !steers || !stands_still(points, axle); }
};

RigJson sweep_json(const ShownSweep& sweep, const std::vector<std::string>& axles) {
  RigJson out = RigJson::array();
  for (const RigPoint& p : sweep.points) {
    RigJson point = {{"travel_m", p.travel + 0.0}, {"input", p.input + 0.0}};
    for (std::size_t k = 0; k < axles.size(); ++k) {
      const RigAxle& a = p.axles[k];
      const bool moves = sweep.moves(k);
      point[axles[k]] = {{"track_m", shown(moves, a.track)},
                         {"left", wheel_json(a.left, moves)},
                         {"right", wheel_json(a.right, moves)}};
    }
    out.push_back(std::move(point));
  }
  return out;
}

/// With so many digits, and never as "-0.00".
std::string rig_number(double x, int digits) {
  const std::string text = fmt::format("{:.{}f}", x, digits);
  return text.find_first_not_of("-0.") == std::string::npos ? fmt::format("{:.{}f}", 0.0, digits)
                                                            : text;
}

std::string sweep_text(const ShownSweep& sweep, const std::vector<std::string>& axles) {
  std::string out;
  for (std::size_t k = 0; k < axles.size(); ++k) {
    TextTable table({"left [mm]", "right [mm]", "input", "toe left [deg]", "toe right [deg]",
                     "camber left [deg]", "camber right [deg]", "track [mm]", "rate left [N/mm]",
                     "rate right [N/mm]"});
    const bool moves = sweep.moves(k);
    const auto number = [&](double x, int digits) {
      return moves ? rig_number(x, digits) : std::string("-");
    };
    const auto rate = [](const RigWheel& w) {
      return w.rate ? rig_number(1e-3 * *w.rate, 3) : std::string("-");
    };
    for (const RigPoint& p : sweep.points) {
      const RigAxle& a = p.axles[k];
      table.add({rig_number(1e3 * a.left.height, 2), rig_number(1e3 * a.right.height, 2),
                 fmt::format("{:.4g}", p.input + 0.0), number(rig_deg * a.left.toe, 4),
                 number(rig_deg * a.right.toe, 4), number(rig_deg * a.left.camber, 4),
                 number(rig_deg * a.right.camber, 4), number(1e3 * a.track, 3), rate(a.left),
                 rate(a.right)});
    }
    out += fmt::format("\n{}, {}\n{}", axles[k], sweep.name, table.text(2));
  }
  return out;
}

/// A steering input that moves no axle at all.
std::string dead_steering(const ShownSweep& sweep, const std::vector<std::string>& axles) {
  if (sweep.points.empty()) return {};
  for (std::size_t k = 0; k < axles.size(); ++k)
    if (sweep.moves(k)) return {};
  return "\nthe steering input turns no wheel\n";
}

}  // namespace

ManoeuvreReport rig_report(const std::string& model, const RigFigures& f) {
  const ShownSweep travel{"parallel travel", f.travel}, roll{"roll", f.roll},
      steer{"steer", f.steer, true};
  std::string text = fmt::format("{}: suspension on the rig, chassis held\n", model);
  for (const ShownSweep* sweep : {&travel, &roll, &steer})
    if (!sweep->points.empty()) text += sweep_text(*sweep, f.axles);
  text += dead_steering(steer, f.axles);
  return {text, json_document({{"model", model},
                               {"rig", "k-and-c"},
                               {"travel", sweep_json(travel, f.axles)},
                               {"roll", sweep_json(roll, f.axles)},
                               {"steer", sweep_json(steer, f.axles)}})};
}

}  // namespace floatframe
