// floatframe statics: the static equilibrium with the forces in all force elements and joints and
// the poses of bodies.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "floatframe/apps/command.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/io/model_fingerprint.hpp"
#include "floatframe/io/state_json.hpp"
#include "floatframe/io/summary_json.hpp"
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

bool is_torsional(const Model& model, const std::string& name) {
  return std::any_of(model.forces.begin(), model.forces.end(), [&](const Force& f) {
    return f.name == name && (f.rotational || f.type == ForceType::torque);
  });
}

/// A value that is not unique has a star.
std::string starred(const std::string& text, bool unique) { return unique ? text : text + "*"; }

std::string forces_text(const Model& model, const StaticsResult& statics) {
  TextTable table({"force element", "type", "force", "", "measure", ""}, {1, 3, 5});
  for (const StaticsForce& f : statics.forces) {
    const bool torsional = is_torsional(model, f.name);
    table.add({f.name, f.type, starred(fixed(f.force, 4), f.unique), torsional ? "N m" : "N",
               fixed(f.length, 9), torsional ? "rad" : "m"});
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
int warn(const std::vector<std::string>& warnings, bool strict) {
  for (const std::string& warning : warnings) say("warning: " + warning);
  if (warnings.empty() || !strict) return 0;
  say(fmt::format("the equilibrium counts as failed: {} under --strict",
                  plural(static_cast<long>(warnings.size()), "warning counts as an error",
                         "warnings count as errors")));
  return 1;
}

int show_statics(const ModelArguments& arguments, bool json, bool strict,
                 const std::string& write_state) {
  ModelFingerprint used;
  const ModelDescription description = read_model(arguments, false, &used);
  require_writable({{"--write-state", write_state}}, files_of(used));
  const Model model = build_model(description);
  const StaticsResult result = statics(model);
  if (!write_state.empty()) write_file(write_state, state_json(*result.state));
  const std::vector<std::string> warnings = equilibrium_warnings(model, result.bodies);
  if (json) {
    print(statics_json(description.name, result, warnings));
    return warn(warnings, strict);
  }
  print(fmt::format("{}: static equilibrium after {}, largest unbalanced force {:.2g} N\n",
                    description.name, plural(result.iterations, "iteration"), result.residual) +
        forces_text(model, result) + joints_text(result) + bodies_text(result) +
        amplitudes_text(result) +
        "\nForces: tension is positive, tyres: vertical force on the wheel. Joints: on the child, "
        "world axes, about "
        "the\njoint's point. Bodies: origin of the body frame; angles from the design pose.\n" +
        redundancy_note(result));
  return warn(warnings, strict);
}

}  // namespace

void add_statics_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ModelArguments>();
  auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand(
      "statics", "Find the static equilibrium; show forces [N], torques [N m] and poses [m, rad]");
  add_model_arguments(*command, *arguments);
  command->add_flag("--json", *json, "JSON on standard output (N, N m, m, rad)");
  auto state = std::make_shared<std::string>();
  command
      ->add_option("--write-state", *state,
                   "Write the equilibrium as a state, for start: {state: FILE}")
      ->type_name("FILE");
  auto strict = std::make_shared<bool>(false);
  command->add_flag("--strict", *strict, "Warnings count as errors: exit code 1");
  command->footer(
      "Exit codes: 0 found, 1 no equilibrium or, with --strict, warnings, 2 bad input.");
  command->callback([arguments, json, strict, state, &action] {
    action = [arguments, json, strict, state] {
      return show_statics(*arguments, *json, *strict, *state);
    };
  });
}

}  // namespace floatframe
