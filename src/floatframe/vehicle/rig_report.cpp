#include "floatframe/vehicle/rig_report.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/folder_lock.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/results/json_values.hpp"
#include "floatframe/results/results_csv.hpp"

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

/// "input [m]" of the steering input.
std::string input_heading(const std::string& unit) {
  return unit.empty() ? "input" : "input [" + unit + "]";
}

std::string axle_text(const ShownSweep& sweep, std::size_t k, const std::string& unit) {
  TextTable table({"left [mm]", "right [mm]", input_heading(unit), "toe left [deg]",
                   "toe right [deg]", "camber left [deg]", "camber right [deg]", "track [mm]",
                   "rate left [N/mm]", "rate right [N/mm]"});
  const auto rate = [](const RigWheel& w) {
    return w.rate ? rig_number(1e-3 * *w.rate, 3) : std::string("-");
  };
  for (const RigPoint& p : sweep.points) {
    const RigAxle& a = p.axles[k];
    table.add({rig_number(1e3 * a.left.height, 2), rig_number(1e3 * a.right.height, 2),
               fmt::format("{:.4g}", p.input + 0.0), rig_number(rig_deg * a.left.toe, 4),
               rig_number(rig_deg * a.right.toe, 4), rig_number(rig_deg * a.left.camber, 4),
               rig_number(rig_deg * a.right.camber, 4), rig_number(1e3 * a.track, 3), rate(a.left),
               rate(a.right)});
  }
  return table.text(2);
}

std::string sweep_text(const ShownSweep& sweep, const RigFigures& f) {
  std::string out;
  for (std::size_t k = 0; k < f.axles.size(); ++k)
    out += sweep.moves(k) ? fmt::format("\n{}, {}\n{}", f.axles[k], sweep.name,
                                        axle_text(sweep, k, f.input_unit))
                          : fmt::format("\n{}, {}: the steering input does not move it\n",
                                        f.axles[k], sweep.name);
  return out;
}

std::string compliance_text(const RigFigures& f) {
  const char* const loads[] = {"lateral force, per kN", "brake force, per kN",
                               "aligning moment, per 100 N m"};
  std::string out;
  for (std::size_t k = 0; k < f.axles.size(); ++k) {
    TextTable table({"load of both wheels", "toe left [deg]", "toe right [deg]",
                     "camber left [deg]", "camber right [deg]", "x left [mm]", "x right [mm]",
                     "y left [mm]", "y right [mm]"});
    for (const RigCompliance& c : f.compliance) {
      const RigWheel &l = c.axles[k].left, &r = c.axles[k].right;
      table.add({loads[int(c.load)], rig_number(rig_deg * l.toe, 4), rig_number(rig_deg * r.toe, 4),
                 rig_number(rig_deg * l.camber, 4), rig_number(rig_deg * r.camber, 4),
                 rig_number(1e3 * l.x, 4), rig_number(1e3 * r.x, 4), rig_number(1e3 * l.y, 4),
                 rig_number(1e3 * r.y, 4)});
    }
    out +=
        fmt::format("\n{}, compliance at the height of the design\n{}", f.axles[k], table.text(2));
  }
  return out;
}

RigJson compliance_json(const RigFigures& f) {
  const char* const units[] = {"kN", "kN", "100 N m"};
  const auto wheel = [](const RigWheel& w) {
    return RigJson{{"x_m", w.x},
                   {"y_m", w.y},
                   {"steer_deg", rig_deg * w.steer},
                   {"toe_deg", rig_deg * w.toe},
                   {"camber_deg", rig_deg * w.camber}};
  };
  RigJson out = RigJson::object();
  for (const RigCompliance& c : f.compliance) {
    RigJson load = {{"per", units[int(c.load)]}};
    for (std::size_t k = 0; k < f.axles.size(); ++k)
      load[f.axles[k]] = {{"left", wheel(c.axles[k].left)}, {"right", wheel(c.axles[k].right)}};
    out[rig_load_words[int(c.load)]] = std::move(load);
  }
  return out;
}

constexpr const char* rig_legend =
    "left, right: travel of the wheel centre from the design, + is bump (the wheel goes up)\n"
    "toe: + is toe-in; camber: + where the top leans outwards; track: of the lowest points\n"
    "x, y: of the wheel centre, + is forward, to the left; lateral force + to the left, brake "
    "force backwards,\n"
    "aligning moment + about the axis upwards, all at the contact points\n";

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
  std::string text = fmt::format("{}: suspension on the rig, chassis held\n{}", model, rig_legend);
  for (const ShownSweep* sweep : {&travel, &roll, &steer})
    if (!sweep->points.empty()) text += sweep_text(*sweep, f);
  text += dead_steering(steer, f.axles);
  if (!f.compliance.empty()) text += compliance_text(f);
  return {text, json_document({{"model", model},
                               {"rig", "k-and-c"},
                               {"input_unit", f.input_unit},
                               {"travel", sweep_json(travel, f.axles)},
                               {"roll", sweep_json(roll, f.axles)},
                               {"steer", sweep_json(steer, f.axles)},
                               {"compliance", compliance_json(f)}})};
}

namespace {

/// Travel and input, then each axle; of wheels that do not move what they are.
ResultTable sweep_table(const std::vector<RigPoint>& points, const RigFigures& f) {
  ResultTable table;
  table.columns = {{"travel", "m"}, {"input", f.input_unit}};
  const bool rates = points.front().axles.front().left.rate.has_value();
  for (const std::string& axle : f.axles) {
    table.columns.push_back({axle + ".track", "m"});
    for (const char* side : {".left.", ".right."}) {
      for (const auto& [name, unit] :
           {std::pair{"height", "m"}, std::pair{"x", "m"}, std::pair{"y", "m"},
            std::pair{"steer", "rad"}, std::pair{"toe", "rad"}, std::pair{"camber", "rad"},
            std::pair{"force", "N"}})
        table.columns.push_back({axle + side + name, unit});
      if (rates) table.columns.push_back({axle + side + "rate", "N/m"});
    }
  }
  for (const RigPoint& p : points) {
    table.data.insert(table.data.end(), {p.travel, p.input});
    for (const RigAxle& a : p.axles) {
      table.data.push_back(a.track);
      for (const RigWheel* w : {&a.left, &a.right}) {
        table.data.insert(table.data.end(),
                          {w->height, w->x, w->y, w->steer, w->toe, w->camber, w->force});
        if (rates) table.data.push_back(w->rate.value_or(0.0));
      }
    }
  }
  return table;
}

}  // namespace

void save_rig(const RigFigures& f, const ManoeuvreReport& report, const std::string& folder) {
  make_output_folder(folder);
  FolderLock lock(folder);
  const auto path = [&](const char* name) {
    return (std::filesystem::path(folder) / name).string();
  };
  write_file(path("travel.csv"), results_csv(sweep_table(f.travel, f)));
  write_file(path("roll.csv"), results_csv(sweep_table(f.roll, f)));
  remove_file(path("steer.csv"));
  if (!f.steer.empty()) write_file(path("steer.csv"), results_csv(sweep_table(f.steer, f)));
  write_file(path("summary.json"), report.json);
}

}  // namespace floatframe
