// Modes: the natural vibrations of the whole model where a run of it starts, with damping and who
// takes part.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/report/json_values.hpp"
#include "floatframe/simulation/linear_system.hpp"
#include "floatframe/simulation/operating_point.hpp"

namespace floatframe {
namespace {

/// Below this part of the largest |lambda| a frequency is zero.
constexpr double zero_part = 1e-7;

struct Share {
  std::string name;
  double part;
};

/// The largest shares, at least 5 %, three at most.
std::string shares_text(std::vector<Share> shares) {
  std::stable_sort(shares.begin(), shares.end(),
                   [](const Share& a, const Share& b) { return a.part > b.part; });
  std::string text;
  int shown = 0;
  for (const Share& s : shares) {
    if (s.part < 0.05 || shown == 3) break;
    text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", s.name, 100.0 * s.part);
    ++shown;
  }
  return text;
}

struct FoundMode {
  LinearMode mode;
  ModeParts parts;
  std::string kind;  ///< "vibration", "rigid", "decay", "growth", "unstable"
};

/// What a lambda is.
std::string kind_of(const LinearMode& m, double largest) {
  if (std::abs(m.lambda) <= zero_part * largest) return "rigid";
  const bool grows = m.lambda.real() > zero_part * std::abs(m.lambda);
  if (m.lambda.imag() <= zero_part * std::abs(m.lambda)) return grows ? "growth" : "decay";
  return grows ? "unstable" : "vibration";
}

std::vector<Share> kinetic_shares(const Model& model, const ModeParts& parts) {
  std::vector<Share> shares;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    shares.push_back({model.bodies[i].name, parts.kinetic[i]});
  return shares;
}

std::vector<Share> potential_shares(const Model& model, const ModeParts& parts) {
  std::vector<Share> shares;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (model.bodies[i].modes() > 0) shares.push_back({model.bodies[i].name, parts.bending[i]});
  for (std::size_t k = 0; k < model.forces.size(); ++k)
    shares.push_back({model.forces[k].name, parts.springs[k]});
  return shares;
}

std::string damping_text(double ratio) {
  return fmt::format("{:.4f}", std::abs(ratio) < 5e-5 ? 0.0 : ratio);
}

/// Motions that nothing holds: the independent increments among the modes of zero. Place and speed
/// of each have a lambda of zero, so that there are more of these.
int rigid_motions(const LinearSystem& system, const std::vector<FoundMode>& modes) {
  MatX shapes(system.x_of.rows(), 0);
  for (const FoundMode& m : modes) {
    if (m.kind != "rigid") continue;
    const Eigen::Index at = shapes.cols();
    shapes.conservativeResize(Eigen::NoChange, at + 2);
    shapes.col(at) = system.x_of * m.mode.z.real();
    shapes.col(at + 1) = system.x_of * m.mode.z.imag();
  }
  return shapes.cols() > 0 ? static_cast<int>(pivoted_rank(shapes, 1e-6)) : 0;
}

std::string rigid_text(const Model& model, int count, const std::vector<FoundMode>& modes) {
  if (count == 0) return "";
  std::string names;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (std::any_of(modes.begin(), modes.end(), [&](const FoundMode& m) {
          return m.kind == "rigid" && m.parts.kinetic[i] >= 0.05;
        }))
      names += (names.empty() ? ": moves " : ", ") + model.bodies[i].name;
  return fmt::format("{} that nothing holds (frequency 0){}\n\n", plural(count, "rigid motion"),
                     names);
}

std::string vibrations_text(const Model& model, const LinearSystem& system,
                            const std::vector<FoundMode>& modes) {
  TextTable table({"mode", "f [Hz]", "undamped [Hz]", "damping", "", "moves", "is held by"},
                  {4, 5, 6});
  int number = 0;
  for (const FoundMode& m : modes) {
    if (m.kind == "rigid") continue;
    const bool oscillates = m.kind == "vibration" || m.kind == "unstable";
    table.add({std::to_string(++number), oscillates ? fmt::format("{:.5g}", m.mode.damped()) : "0",
               fmt::format("{:.5g}", m.mode.frequency()), damping_text(m.mode.damping()), m.kind,
               shares_text(kinetic_shares(model, m.parts)),
               shares_text(potential_shares(model, m.parts))});
  }
  std::string text =
      fmt::format("{}: {} of freedom{}\n\n", model.name, plural(system.degrees, "degree"),
                  system.massless > 0 ? fmt::format(", {} without mass", system.massless) : "");
  text += rigid_text(model, rigid_motions(system, modes), modes);
  text += table.text();
  text +=
      "\nvibration: decays while it swings, or not; unstable: grows while it swings; decay, "
      "growth: "
      "without swinging,\nundamped is the rate over 2 pi; rigid: nothing holds it. moves: part of "
      "the "
      "kinetic energy; is held by: part of the\npotential energy.\n";
  for (const std::string& note : system.notes) text += "Note: " + note + ".\n";
  return text;
}

std::string vibrations_json(const Model& model, const LinearSystem& system,
                            const std::vector<FoundMode>& modes) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  const auto named = [](const std::vector<Share>& shares) {
    Json map = Json::object();
    for (const Share& s : shares) map[s.name] = s.part;
    return map;
  };
  for (const FoundMode& m : modes)
    list.push_back({{"kind", m.kind},
                    {"real_1_s", m.mode.lambda.real()},
                    {"imaginary_1_s", m.mode.lambda.imag()},
                    {"frequency_Hz", m.mode.damped()},
                    {"undamped_frequency_Hz", m.mode.frequency()},
                    {"damping_ratio", m.mode.damping()},
                    {"kinetic_energy", named(kinetic_shares(model, m.parts))},
                    {"potential_energy", named(potential_shares(model, m.parts))}});
  return json_document({{"model", model.name},
                        {"degrees_of_freedom", system.degrees},
                        {"without_mass", system.massless},
                        {"rigid_motions", rigid_motions(system, modes)},
                        {"largest_speed", system.speed},
                        {"largest_acceleration", system.acceleration},
                        {"notes", system.notes},
                        {"modes", list}});
}

AnalysisReport report_modes(const Model& given, const std::string& at) {
  const Model model = at_operating_point(given, at);
  const LinearSystem system = linear_system(model);
  const std::vector<LinearMode> found = linear_modes(system);
  double largest = 0.0;
  for (const LinearMode& m : found) largest = std::max(largest, std::abs(m.lambda));
  std::vector<FoundMode> modes;
  for (const LinearMode& m : found) {
    modes.push_back({m, mode_parts(model, system, m), kind_of(m, largest)});
  }
  return {.text = vibrations_text(model, system, modes),
          .json = vibrations_json(model, system, modes)};
}

}  // namespace

Analysis modes_analysis() {
  const auto at = std::make_shared<std::string>();
  return {.name = "modes",
          .help =
              "Natural vibrations of the whole model: frequencies [Hz], damping ratios, who takes "
              "part",
          .options = {operating_point_option(*at)},
          .json_help = "JSON on standard output (Hz, 1/s)",
          .footer =
              "States in motion need relative coordinates.\n"
              "Exit codes: 0 done, 1 the start or the eigenvalues cannot be found, 2 bad input.",
          .run = [at](const Model& model) { return report_modes(model, *at); }};
}

}  // namespace floatframe
