// floatframe statics: the static equilibrium with the forces in all force elements and joints and
// the poses of bodies.
#include <fmt/format.h>

#include <cmath>

#include "floatframe/apps/commands.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/model/force_outputs.hpp"
#include "floatframe/model/inertia_choice.hpp"
#include "floatframe/model_file/model_fingerprint.hpp"
#include "floatframe/model_file/state_json.hpp"
#include "floatframe/report/summary_json.hpp"
#include "floatframe/simulation/range_watch.hpp"
#include "floatframe/simulation/simulation.hpp"

namespace floatframe {
namespace {

/// Fixed decimals; what rounds to zero has no sign.
std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

/// A value that is not unique has a star.
std::string starred(const std::string& text, bool unique) { return unique ? text : text + "*"; }

std::string forces_text(const Model& model, const StaticsResult& statics) {
  TextTable table({"force element", "type", "force", "", "measure", ""}, {1, 3, 5});
  for (std::size_t k = 0; k < statics.forces.size(); ++k) {
    const StaticsForce& f = statics.forces[k];
    const Force& element = model.forces[k];
    const bool measured = force_has(element.type, ForceQuantity::length);
    table.add({f.name, f.type, starred(fixed(f.force, 4), f.unique),
               force_output_unit(element, ForceQuantity::force), measured ? fixed(f.length, 9) : "",
               force_output_unit(element, ForceQuantity::length)});
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

std::string bodies_text(const StaticsResult& statics) {
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

/// Says them; the exit code.
int warn(const std::vector<RangeWarning>& warnings, bool strict) {
  for (const RangeWarning& warning : warnings) say("warning: " + warning.sentence);
  if (warnings.empty() || !strict) return 0;
  say(fmt::format("the equilibrium counts as failed: {} under --strict",
                  plural(static_cast<long>(warnings.size()), "warning counts as an error",
                         "warnings count as errors")));
  return 1;
}

struct StaticsArguments {
  ModelArguments model;
  std::string write_state;
  bool json = false, strict = false;
};

int show_statics(const StaticsArguments& a) {
  ModelFingerprint used;
  const ModelDescription description = read_model(a.model, false, &used);
  require_writable({{"--write-state", a.write_state}}, files_of(used));
  check_inertia_method(description, description.simulation.inertia);
  const Model model = build_model(description);
  const StaticsResult result = statics(model);
  if (!a.write_state.empty()) write_file(a.write_state, state_json(*result.state));
  const std::vector<RangeWarning> warnings = equilibrium_warnings(model, result.bodies);
  if (a.json) {
    print(statics_json(description.name, result, warnings));
    return warn(warnings, a.strict);
  }
  print(fmt::format("{}: static equilibrium after {}, largest unbalanced force {:.2g} N\n",
                    description.name, plural(result.iterations, "iteration"), result.residual) +
        forces_text(model, result) + joints_text(result) + bodies_text(result) +
        amplitudes_text(result) +
        "\nForces: tension is positive, tyres: vertical force on the wheel. Joints: on the child, "
        "world axes, about "
        "the\njoint's point. Bodies: origin of the body frame; angles from the design pose.\n" +
        redundancy_note(result));
  return warn(warnings, a.strict);
}

}  // namespace

Command statics_command() {
  const auto a = std::make_shared<StaticsArguments>();
  return {
      .name = "statics",
      .help = "Find the static equilibrium; show forces [N], torques [N m] and poses [m, rad]",
      .options = joined(model_options(a->model),
                        {flag("--json", a->json, "JSON on standard output (N, N m, m, rad)"),
                         text_option("--write-state", a->write_state, "FILE",
                                     "Write the equilibrium as a state, for start: {state: FILE}"),
                         flag("--strict", a->strict, "Warnings count as errors: exit code 1")}),
      .footer = "Exit codes: 0 found, 1 no equilibrium or, with --strict, warnings, 2 bad input.",
      .run = [a] { return show_statics(*a); }};
}

}  // namespace floatframe
