// Modes: the natural vibrations of the whole model at the start of a run, with damping and
// participating bodies; as a table, and as a page with animated shapes.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/analyses/body_damping.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/linear/held_places.hpp"
#include "floatframe/linear/linear_system.hpp"
#include "floatframe/linear/operating_point.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/lowest_motions.hpp"
#include "floatframe/page/check_page.hpp"
#include "floatframe/page/modes_page.hpp"
#include "floatframe/results/json_values.hpp"
#include "floatframe/start/start_up.hpp"
#include "floatframe/start/system_state.hpp"

namespace floatframe {
namespace {

struct ModesOptions {
  std::string at;
  int number = 0;  ///< number of slowest motions; 0: all, or `default_number` for a large model
};
constexpr int default_number = 40;
constexpr std::size_t few_bodies = 100;  ///< for absolute coordinates

/// The largest shares, each at least 5 %, at most three.
std::string shares_text(const std::vector<EnergyShare>& shares) {
  std::string text;
  int shown = 0;
  for (const EnergyShare& s : largest_first(shares)) {
    if (s.part < 0.05 || shown == 3) break;
    text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", s.name, 100.0 * s.part);
    ++shown;
  }
  return text;
}

/// Kind of an eigenvalue lambda.
std::string kind_of(const LinearMode& m, double largest, const HeldPlaces& places) {
  if (std::abs(m.lambda) <= zero_part * largest) return places.holds(m) ? "held" : "rigid";
  const bool grows = m.lambda.real() > zero_part * std::abs(m.lambda);
  if (m.lambda.imag() <= zero_part * std::abs(m.lambda)) return grows ? "growth" : "decay";
  return grows ? "unstable" : "vibration";
}

bool is_still(const ShownMotion& m) { return m.kind == "rigid" || m.kind == "held"; }

std::vector<EnergyShare> kinetic_shares(const Model& model, const ModeParts& parts) {
  std::vector<EnergyShare> shares;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    shares.push_back({model.bodies[i].name, parts.kinetic[i]});
  return shares;
}

std::vector<EnergyShare> potential_shares(const Model& model, const ModeParts& parts) {
  std::vector<EnergyShare> shares;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (model.bodies[i].modes() > 0) shares.push_back({model.bodies[i].name, parts.bending[i]});
  for (std::size_t k = 0; k < model.elements.size(); ++k)
    if (model.elements[k].exerts()) shares.push_back({model.elements[k].name, parts.springs[k]});
  return shares;
}

std::string damping_text(double ratio) {
  return fmt::format("{:.4f}", std::abs(ratio) < 5e-5 ? 0.0 : ratio);
}

/// Unrestrained motions, one column of states each: the independent increments among the zero
/// modes, in which position and velocity have one each. In each motion one coordinate moves by one
/// that does not move in the others: for a free body, three translations and three rotations.
/// Places that friction holds are none.
MatX rigid_motions(const LinearSystem& system, const std::vector<ShownMotion>& modes) {
  const Eigen::Index nz = system.A.rows();
  MatX z(nz, 0);
  for (const ShownMotion& m : modes) {
    if (!is_still(m)) continue;
    const Eigen::Index at = z.cols();
    z.conservativeResize(Eigen::NoChange, at + 2);
    z.col(at) = m.mode.z.real();
    z.col(at + 1) = m.mode.z.imag();
  }
  if (z.cols() == 0) return z;
  const MatX x = system.x_of * z;
  const PivotedQr columns = pivoted_qr(x, 1e-6);
  MatX independent(nz, columns.rank);
  for (Eigen::Index k = 0; k < columns.rank; ++k) independent.col(k) = z.col(columns.pivots[k]);
  const MatX chosen = HeldPlaces(system).free(independent);
  const Eigen::Index count = chosen.cols();
  if (count == 0) return chosen;
  const MatX moved = system.x_of * chosen;
  MatX square(count, count);
  const PivotedQr rows = pivoted_qr(moved.transpose());
  std::vector<int> coordinates(rows.pivots.begin(), rows.pivots.begin() + count);
  std::sort(coordinates.begin(), coordinates.end());
  for (Eigen::Index k = 0; k < count; ++k)
    square.row(k) = moved.row(coordinates[static_cast<std::size_t>(k)]);
  return chosen * lu_solve(square, MatX::Identity(count, count));
}

bool lists_all(const LinearSystem& system, const std::vector<ShownMotion>& modes) {
  Eigen::Index states = 0;
  for (const ShownMotion& m : modes) states += m.mode.lambda.imag() > 0.0 ? 2 : 1;
  return system.fastest == 0.0 && states == system.A.rows();
}

std::string rigid_text(const Model& model, const LinearSystem& system, Eigen::Index count,
                       const std::vector<ShownMotion>& modes) {
  const auto held = std::ranges::count(modes, "held", &ShownMotion::kind);
  const std::string places =
      held == 0 ? ""
                : fmt::format(
                      "{} of zero without a motion: friction that sticks holds wherever it "
                      "is\n\n",
                      plural(held, "root"));
  if (count == 0) return places;
  std::string names;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (std::any_of(modes.begin(), modes.end(), [&](const ShownMotion& m) {
          return m.kind == "rigid" && m.moves[i].part >= 0.05;
        }))
      names += (names.empty() ? ": moves " : ", ") + model.bodies[i].name;
  const bool more = is_still(modes.back()) && !lists_all(system, modes);
  return fmt::format("{}{} that nothing holds (frequency 0){}\n\n", more ? "at least " : "",
                     plural(count, "rigid motion"), names) +
         places;
}

const std::vector<std::string> vibration_columns{"mode", "f [Hz]", "undamped [Hz]", "damping",
                                                 "",     "moves",  "is held by"};

std::vector<std::vector<std::string>> vibration_rows(const std::vector<ShownMotion>& modes) {
  std::vector<std::vector<std::string>> rows;
  for (const ShownMotion& m : modes) {
    if (is_still(m)) continue;
    const bool oscillates = m.kind == "vibration" || m.kind == "unstable";
    rows.push_back({std::to_string(m.number),
                    oscillates ? fmt::format("{:.5g}", m.mode.damped()) : "0",
                    fmt::format("{:.5g}", m.mode.frequency()), damping_text(m.mode.damping()),
                    m.kind, shares_text(m.moves), shares_text(m.held)});
  }
  return rows;
}

/// Empty if all motions are listed.
std::string slowest_text(const LinearSystem& system, const std::vector<ShownMotion>& modes) {
  if (lists_all(system, modes)) return "";
  return fmt::format("{}; --number N lists others",
                     modes.size() == 1 ? "the slowest motion"
                                       : fmt::format("the {} slowest motions", modes.size()));
}

std::string vibrations_text(const Model& model, const LinearSystem& system,
                            const std::vector<ShownMotion>& modes, Eigen::Index rigid) {
  TextTable table(vibration_columns, {4, 5, 6});
  for (const std::vector<std::string>& row : vibration_rows(modes)) table.add(row);
  std::string text = system.stiffening.empty() ? "" : system.stiffening + ".\n\n";
  text += fmt::format("{}: {} of freedom{}\n", model.name, plural(system.degrees, "degree"),
                      system.massless > 0 ? fmt::format(", {} without mass", system.massless) : "");
  if (const std::string slowest = slowest_text(system, modes); !slowest.empty())
    text += "Listed: " + slowest + ".\n";
  text += '\n';
  text += rigid_text(model, system, rigid, modes);
  text += table.text();
  text +=
      "\nvibration: decays while it swings, or not; unstable: grows while it swings; decay, "
      "growth: without swinging,\nundamped is the rate over 2 pi; rigid: nothing holds it. moves: "
      "part of the kinetic energy; is held by: part of the\npotential energy.\n";
  if (const std::string own = body_damping_text(model); !own.empty())
    text += own +
            "  free: nothing holds the body; mounted: its interfaces are held; frame held: what "
            "its body frame follows.\n  The column damping is what the vibrations of the model get "
            "of it. damping: {fraction: 0.02, reference: mounted} of a body gives its\n  mounted "
            "modes 2 %; with frequency: HZ of a vibration of the model, also this one where "
            "motions of the interfaces decide it.\n";
  for (const std::string& note : system.notes) text += "Note: " + note + ".\n";
  return text;
}

std::string vibrations_json(const Model& model, const LinearSystem& system,
                            const std::vector<ShownMotion>& modes, Eigen::Index rigid) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  const auto named = [](const std::vector<EnergyShare>& shares) {
    Json map = Json::object();
    for (const EnergyShare& s : shares) map[s.name] = s.part;
    return map;
  };
  for (const ShownMotion& m : modes)
    list.push_back({{"kind", m.kind},
                    {"real_1_s", m.mode.lambda.real()},
                    {"imaginary_1_s", m.mode.lambda.imag()},
                    {"frequency_Hz", m.mode.damped()},
                    {"undamped_frequency_Hz", m.mode.frequency()},
                    {"damping_ratio", m.mode.damping()},
                    {"kinetic_energy", named(m.moves)},
                    {"potential_energy", named(m.held)}});
  return json_document({{"model", model.name},
                        {"degrees_of_freedom", system.degrees},
                        {"without_mass", system.massless},
                        {"rigid_motions", rigid},
                        {"all_motions", lists_all(system, modes)},
                        {"largest_speed", system.speed},
                        {"largest_acceleration", system.acceleration},
                        {"stiffening_counted_in", system.stiffened},
                        {"notes", system.notes},
                        {"modes", list},
                        {"body_damping", body_damping_json(model)}});
}

std::vector<ShownMotion> motions_of(const Model& model, const LinearSystem& system, int most) {
  std::vector<LinearMode> found = linear_modes(system);
  double largest = system.fastest;
  for (const LinearMode& m : found) largest = std::max(largest, std::abs(m.lambda));
  if (most > 0 && found.size() > static_cast<std::size_t>(most))
    found.resize(static_cast<std::size_t>(most));
  const HeldPlaces places(system);
  std::vector<ShownMotion> modes;
  int number = 0;
  for (const LinearMode& m : found) {
    const ModeParts parts = mode_parts(model, system, m);
    ShownMotion shown{m, kind_of(m, largest, places), 0, kinetic_shares(model, parts),
                      potential_shares(model, parts)};
    if (!is_still(shown)) shown.number = ++number;
    modes.push_back(std::move(shown));
  }
  return modes;
}

// -- the page

SystemState linearised_state(const Model& model) {
  InitialisedModel start(model, model.simulation);
  JointFollower joints(start.model());
  kinematics_at(start.formulation(), start.state());
  SystemState state = system_state(start.formulation().motion(), joints);
  place_bodies(start.model(), start.inertia(), state);
  return state;
}

/// Rigid motions first, as they are when nothing else moves; then the modes of the table. The
/// participants of a rigid motion are the bodies with kinetic energy in it.
std::vector<ShownMotion> motions_to_draw(const Model& model, const LinearSystem& system,
                                         const std::vector<ShownMotion>& modes, const MatX& rigid) {
  std::vector<ShownMotion> out;
  const MatX going =
      rigid.cols() > 0 ? LeastNorm(system.v_of).solve(MatX(system.x_of * rigid)) : MatX();
  for (Eigen::Index k = 0; k < rigid.cols(); ++k) {
    const ModeParts parts = mode_parts(model, system, {0.0, going.col(k)});
    out.push_back({{0.0, rigid.col(k)}, "rigid", 0, kinetic_shares(model, parts), {}});
  }
  for (const ShownMotion& m : modes)
    if (!is_still(m)) out.push_back(m);
  return out;
}

std::string place_text(const std::string& at, double time) {
  if (at.empty() || at == "start") return "about the state that a run starts from";
  if (at == "equilibrium") return "about its equilibrium";
  return fmt::format("about the state that a run has at {:g} s", time);
}

std::string page_of_modes(const Model& model, const LinearSystem& system,
                          const std::vector<ShownMotion>& modes, const MatX& rigid,
                          const std::string& at) {
  require_page("--report");
  ModesPage page;
  page.state = linearised_state(model);
  page.sentences = {
      fmt::format("The natural vibrations of the model {}.", place_text(at, page.state.time)),
      "All modes are animated at the same slow rate with constant amplitude, whatever their "
      "frequency and damping; modes that do not oscillate are animated as if they did."};
  if (!system.stiffening.empty()) page.sentences.push_back(system.stiffening + ".");
  if (system.speed > 1e-6)
    page.sentences.push_back(
        "The model is moving in this state; the animation shows the perturbation about it.");
  if (const std::string slowest = slowest_text(system, modes); !slowest.empty())
    page.sentences.push_back("Shown: " + slowest + ".");
  for (const std::string& note : system.notes) {
    page.warnings.push_back(note + ".");
    char& first = page.warnings.back().front();
    if (first >= 'a' && first <= 'z') first = static_cast<char>(first - 'a' + 'A');
  }
  for (const ShownMotion& m : modes) {
    if (m.kind == "unstable")
      page.warnings.push_back(fmt::format("Mode {} ({:.4g} Hz) is unstable: its oscillation grows.",
                                          m.number, m.mode.damped()));
    if (m.kind == "growth")
      page.warnings.push_back(
          fmt::format("Mode {} grows without oscillating, by e in {:.4g} s: the state is unstable.",
                      m.number, 1.0 / m.mode.lambda.real()));
  }
  page.facts = {
      {"Linear system",
       {{"degrees of freedom", std::to_string(system.degrees)},
        {"without mass", std::to_string(system.massless)},
        {"rigid motions", std::to_string(rigid.cols())},
        {"largest speed of a coordinate", fmt::format("{:.3g}", system.speed)},
        {"largest acceleration of a coordinate", fmt::format("{:.3g}", system.acceleration)}}}};
  std::vector<std::string> columns = vibration_columns;
  columns[4] = "kind";
  page.tables = {{"Vibrations", columns, vibration_rows(modes),
                  "moves: part of the kinetic energy; is held by: part of the potential energy; "
                  "undamped: the size of the eigenvalue over 2 pi."}};
  for (PageTable& t : body_tables(model)) page.tables.push_back(std::move(t));
  return modes_page(model, system, motions_to_draw(model, system, modes, rigid), page);
}

/// In relative coordinates where absolute ones, 12 and more per body, would be too many.
Model with_fewer_coordinates(Model model) {
  if (model.bodies.size() > few_bodies) model.simulation.coordinates = Coordinates::relative;
  return model;
}

AnalysisReport report_modes(const Model& given, const ModesOptions& options) {
  const std::string& at = options.at;
  // The page shows the model that the linear system belongs to.
  const auto model = std::make_shared<const Model>(with_fewer_coordinates(
      counted_stiffening(counted_at_operating_point(given, at).model).model));
  const auto system = std::make_shared<const LinearSystem>(
      linear_system(*model, {}, options.number > 0 ? options.number : default_number));
  const std::vector<ShownMotion> modes = motions_of(*model, *system, options.number);
  const MatX rigid = rigid_motions(*system, modes);
  return {.text = vibrations_text(*model, *system, modes, rigid.cols()),
          .json = vibrations_json(*model, *system, modes, rigid.cols()),
          .files = {[=] { return page_of_modes(*model, *system, modes, rigid, at); }}};
}

}  // namespace

Analysis modes_analysis() {
  const auto options = std::make_shared<ModesOptions>();
  return {
      .name = "modes",
      .help =
          "Natural vibrations of the whole model: frequencies [Hz], damping ratios, who takes part",
      .options = {operating_point_option(options->at),
                  whole_option("--number", options->number, 1, 1000,
                               "List the N slowest motions (default: all, or 40 of a model of more "
                               "than 400 degrees of freedom)")},
      .json_help = "JSON on standard output (Hz, 1/s)",
      .files = {{"--report",
                 "Write a page that shows the model and moves it in each of its shapes (HTML)"}},
      .footer =
          "States in motion need relative coordinates.\n"
          "Exit codes: 0 done, 1 the start or the eigenvalues cannot be found, 2 bad input.",
      .run = [options](const Model& model) { return report_modes(model, *options); }};
}

}  // namespace floatframe
