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

RigJson wheel_json(const RigWheel& w) {
  return {{"height_m", w.height},
          {"x_m", w.x},
          {"y_m", w.y},
          {"steer_deg", rig_deg * w.steer},
          {"toe_deg", rig_deg * w.toe},
          {"camber_deg", rig_deg * w.camber},
          {"force_N", w.force},
          {"rate_N_m", w.rate}};
}

RigJson sweep_json(const std::vector<RigPoint>& points, const std::vector<std::string>& axles) {
  RigJson out = RigJson::array();
  for (const RigPoint& p : points) {
    RigJson point = {{"travel_m", p.travel}, {"input", p.input}};
    for (std::size_t k = 0; k < axles.size(); ++k) {
      const RigAxle& a = p.axles[k];
      point[axles[k]] = {
          {"track_m", a.track}, {"left", wheel_json(a.left)}, {"right", wheel_json(a.right)}};
    }
    out.push_back(std::move(point));
  }
  return out;
}

std::string sweep_text(const char* name, const std::vector<RigPoint>& points,
                       const std::vector<std::string>& axles) {
  std::string out;
  for (std::size_t k = 0; k < axles.size(); ++k) {
    TextTable table({"left [mm]", "right [mm]", "input", "toe left [deg]", "toe right [deg]",
                     "camber left [deg]", "camber right [deg]", "track [mm]", "rate left [N/mm]",
                     "rate right [N/mm]"});
    for (const RigPoint& p : points) {
      const RigAxle& a = p.axles[k];
      const auto number = [](double x) { return fmt::format("{:.4f}", x); };
      table.add({fmt::format("{:.2f}", 1e3 * a.left.height),
                 fmt::format("{:.2f}", 1e3 * a.right.height), fmt::format("{:.4g}", p.input),
                 number(rig_deg * a.left.toe), number(rig_deg * a.right.toe),
                 number(rig_deg * a.left.camber), number(rig_deg * a.right.camber),
                 fmt::format("{:.3f}", 1e3 * a.track), fmt::format("{:.3f}", 1e-3 * a.left.rate),
                 fmt::format("{:.3f}", 1e-3 * a.right.rate)});
    }
    out += fmt::format("\n{}, {}\n{}", axles[k], name, table.text(2));
  }
  return out;
}

}  // namespace

ManoeuvreReport rig_report(const std::string& model, const RigFigures& f) {
  std::string text = fmt::format("{}: suspension on the rig, chassis held\n", model);
  text += sweep_text("parallel travel", f.travel, f.axles);
  text += sweep_text("roll", f.roll, f.axles);
  text += sweep_text("steer", f.steer, f.axles);
  return {text, json_document({{"model", model},
                               {"rig", "k-and-c"},
                               {"travel", sweep_json(f.travel, f.axles)},
                               {"roll", sweep_json(f.roll, f.axles)},
                               {"steer", sweep_json(f.steer, f.axles)}})};
}

}  // namespace floatframe
