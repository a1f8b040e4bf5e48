// Statics: the static equilibrium with the forces in all force elements and joints and
// the poses of bodies.
#include "floatframe/start/statics.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/model/element_outputs.hpp"
#include "floatframe/model_file/state_json.hpp"
#include "floatframe/results/json_values.hpp"
#include "floatframe/results/notes_text.hpp"
#include "floatframe/run/range_watch.hpp"

namespace floatframe {
namespace {

/// Fixed decimals; values that round to zero have no sign.
std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

/// Marks a value that is not unique with a star.
std::string starred(const std::string& text, bool unique) { return unique ? text : text + "*"; }

std::string forces_text(const Model& model, const StaticsResult& statics) {
  TextTable table({"force element", "type", "force", "", "measure", ""}, {1, 3, 5});
  for (std::size_t k = 0; k < statics.forces.size(); ++k) {
    const StaticsForce& f = statics.forces[k];
    const Element& element = model.elements[k];
    const bool measured = element_has(element.type, ElementQuantity::length);
    table.add({f.name, f.type, starred(fixed(f.force, 4), f.unique),
               element_output_unit(element, ElementQuantity::force),
               measured ? fixed(f.length, 9) : "",
               element_output_unit(element, ElementQuantity::length)});
  }
  return table.empty() ? "" : "\n" + table.text();
}

std::string joints_text(const StaticsResult& statics) {
  TextTable table(
      {"joint", "type", "Fx [N]", "Fy [N]", "Fz [N]", "Mx [N m]", "My [N m]", "Mz [N m]"}, {1});
  for (const StaticsJoint& j : statics.joints) {
    std::vector<std::string> row{j.name, j.type};
    for (std::size_t i = 0; i < 3; ++i)
      row.push_back(starred(fixed(j.force[static_cast<Eigen::Index>(i)], 4), j.unique_force[i]));
    for (std::size_t i = 0; i < 3; ++i)
      row.push_back(starred(fixed(j.torque[static_cast<Eigen::Index>(i)], 4), j.unique_torque[i]));
    table.add(std::move(row));
  }
  return table.empty() ? "" : "\n" + table.text();
}

std::string poses_text(const StaticsResult& statics) {
  TextTable table({"body", "x [m]", "y [m]", "z [m]", "roll [rad]", "pitch [rad]", "yaw [rad]"});
  for (const StaticsBody& b : statics.bodies) {
    std::vector<std::string> row{b.name};
    for (int i = 0; i < 3; ++i) row.push_back(fixed(b.position[i], 10));
    for (int i = 0; i < 3; ++i) row.push_back(fixed(b.roll_pitch_yaw[i], 10));
    table.add(std::move(row));
  }
  return table.empty() ? "" : "\n" + table.text();
}

std::string amplitudes_text(const StaticsResult& statics) {
  TextTable table({"flexible body", "modal amplitudes"}, {1});
  for (const StaticsBody& b : statics.bodies) {
    if (b.amplitudes.size() == 0) continue;
    std::string amplitudes;
    for (const double a : b.amplitudes) amplitudes += fmt::format("{:>14.6e}", a);
    table.add({b.name, amplitudes});
  }
  return table.empty() ? "" : "\n" + table.text();
}

std::string redundancy_note(const StaticsResult& statics) {
  if (statics.redundant.empty()) return "";
  return fmt::format(
      "* Not unique: {} redundant ({}).\n  These are the reactions of least norm (forces, and "
      "torques divided by the length of the child).\n",
      statics.redundant.size() == 1 ? "1 constraint is"
                                    : fmt::format("{} constraints are", statics.redundant.size()),
      redundancy_text(statics.redundant));
}

std::string statics_json(const Model& model, const StaticsResult& statics,
                         const std::vector<std::string>& warnings) {
  using Json = nlohmann::ordered_json;
  Json forces = Json::array(), joints = Json::array(), bodies = Json::array();
  for (const StaticsForce& f : statics.forces) {
    forces.push_back({{"name", f.name},
                      {"type", f.type},
                      {"force", f.force},
                      {"length", f.length},
                      {"unique", f.unique}});
  }
  for (const StaticsJoint& j : statics.joints) {
    joints.push_back({{"name", j.name},
                      {"type", j.type},
                      {"force", json_array(j.force)},
                      {"torque", json_array(j.torque)},
                      {"unique", j.unique()},
                      {"unique_force", j.unique_force},
                      {"unique_torque", j.unique_torque}});
  }
  for (const StaticsBody& b : statics.bodies) {
    bodies.push_back({{"name", b.name},
                      {"position", json_array(b.position)},
                      {"roll_pitch_yaw", json_array(b.roll_pitch_yaw)},
                      {"amplitudes", json_array(b.amplitudes)}});
  }
  return json_document({{"model", model.name},
                        {"iterations", statics.iterations},
                        {"residual", statics.residual},
                        {"forces", forces},
                        {"joints", joints},
                        {"bodies", bodies},
                        {"redundant", redundancy_json(statics.redundant)},
                        {"notes", statics.notes},
                        {"warnings", warnings}});
}

AnalysisReport report_statics(const Model& model) {
  const StaticsResult s = statics(model);
  // Range warnings of the equilibrium.
  const std::vector<std::string> warnings = sentences(equilibrium_warnings(model, s.bodies));
  return {
      .text = fmt::format("{}: static equilibrium after {}, largest unbalanced force {:.2g} N\n",
                          model.name, plural(s.iterations, "iteration"), s.residual) +
              forces_text(model, s) + joints_text(s) + poses_text(s) + amplitudes_text(s) +
              "\nForces: tension is positive, tyres: vertical force on the wheel, motions: on the "
              "child. Joints: on "
              "the child, world axes, about the\njoint's point. Bodies: origin of the body "
              "frame; angles from the design pose.\n" +
              redundancy_note(s) + notes_text(s.notes),
      .json = statics_json(model, s, warnings),
      .files = {[state = s.state] { return state_json(*state); }},
      .warnings = warnings};
}

}  // namespace

Analysis statics_analysis() {
  return {
      .name = "statics",
      .help = "Find the static equilibrium; show forces [N], torques [N m] and poses [m, rad]",
      .json_help = "JSON on standard output (N, N m, m, rad)",
      .files = {{"--write-state", "Write the equilibrium as a state, for start: {state: FILE}"}},
      .strict = "equilibrium",
      .footer = "Exit codes: 0 found, 1 no equilibrium or, with --strict, warnings, 2 bad input.",
      .run = report_statics};
}

}  // namespace floatframe
