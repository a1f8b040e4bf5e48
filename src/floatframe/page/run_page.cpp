#include "floatframe/page/run_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/description/system_state.hpp"
#include "floatframe/history/state_history.hpp"
#include "floatframe/page/html_text.hpp"
#include "floatframe/page/page_json.hpp"
#include "floatframe/page/page_trust.hpp"
#include "floatframe/page/scene_json.hpp"
#include "floatframe/results/verification_report.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/start/check.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

std::string joules(double value) { return fmt::format("{:.6g} J", value); }

/// Sentences on how the run ended.
std::vector<std::string> ending(const Report& report) {
  const RunSummary& s = report.result.summary;
  std::vector<std::string> out;
  if (s.status == "completed") {
    out.push_back(fmt::format(
        "{:g} s simulated in {:.3g} s of processor time{}.", s.duration, s.cpu,
        s.cpu > 0.0 ? fmt::format(", {:.3g} times real time", s.real_time_factor) : ""));
    if (!s.until.empty()) out.push_back("It " + until_text(s) + ".");
  } else if (s.strict) {
    out.push_back("This run counts as failed: " + s.message);
  } else if (report.result.table.columns.empty()) {
    out.push_back("This run could not start: " + s.message);
  } else {
    out.push_back(fmt::format("This run {}: the results are partial. They end at {:g} s.",
                              s.status == "interrupted" ? "was interrupted" : "failed",
                              report.rows_end.value_or(s.duration)));
    out.push_back(s.message);
  }
  for (const std::string& note : s.start.notes) out.push_back(note);
  return out;
}

Json energy_table(const EnergySummary& e) {
  Json rows = Json::array();
  const auto row = [&](const std::string& name, double start, double end) {
    rows.push_back({name, joules(start), joules(end), joules(end - start)});
  };
  row("kinetic", e.kinetic_start, e.kinetic_end);
  row("potential", e.potential_start, e.potential_end);
  row("elastic", e.elastic_start, e.elastic_end);
  row("total", e.total_start, e.total_end);
  if (e.balanced) {
    for (std::size_t k = 0; k < EnergyFlows::size(); ++k)
      if (e.work.value[k] != 0.0)
        rows.push_back(
            {"work of " + spaced_words(energy_flow_names[k]), "", "", joules(e.work.value[k])});
    rows.push_back(
        {"remainder: error and damping of the integration", "", "", joules(e.remainder)});
  }
  return {{"heading", "Energy"}, {"columns", {"energy", "start", "end", "change"}}, {"rows", rows}};
}

/// Empty for a run without steps.
Json page_tables(const Report& report) {
  Json out = tables_json(report.tables);
  const RunSummary& s = report.result.summary;
  if (!report.result.table.columns.empty()) out.push_back(energy_table(s.energy));
  return out;
}

Json trust_rows(const RunSummary& s) {
  Json rows = Json::array();
  const auto row = [&](const char* name, const std::string& value, bool good) {
    rows.push_back({name, value, good ? "ok" : "warn"});
  };
  row("largest violation of a position constraint after a step",
      fmt::format("{:.2g} m", s.max_position_violation), s.max_position_violation < 1e-6);
  row("largest violation of a velocity constraint after the projections",
      fmt::format("{:.2g} m/s", s.max_velocity_violation), s.max_velocity_violation < 1e-5);
  row("steps that had to be halved", fmt::format("{} extra of {}", s.substeps, s.steps),
      s.substeps * 20 <= s.steps);
  if (s.energy.balanced) {
    const double exchanged = s.energy.exchanged;
    const double part = exchanged > 0.0 ? std::abs(s.energy.largest_remainder) / exchanged : 0.0;
    row("largest remainder of the energy balance",
        fmt::format("{:.4g} J at {:.4g} s, {:.2g} % of the energy exchanged",
                    s.energy.largest_remainder, s.energy.largest_remainder_at, 100.0 * part),
        part < 0.05);
  }
  if (s.verification)
    row("error estimated from runs at shorter steps", verification_verdict(*s.verification),
        s.verification->sentences.empty());
  row("limits of the method that were left",
      s.warnings.empty() ? "none" : plural(static_cast<long>(s.warnings.size()), "warning"),
      s.warnings.empty());
  return rows;
}

Json speed_rows(const Report& report) {
  const RunSummary& s = report.result.summary;
  Json rows = Json::array();
  const double steps = static_cast<double>(std::max(s.steps, 1L));
  rows.push_back({"simulated", fmt::format("{:g} s", s.duration)});
  rows.push_back({"processor time", fmt::format("{:.4g} s", s.cpu)});
  if (s.cpu > 0.0) rows.push_back({"real-time factor", fmt::format("{:.4g}", s.real_time_factor)});
  rows.push_back({"steps", fmt::format("{} of {:g} s", s.steps, s.step)});
  const StepTimes& t = s.step_times;
  const auto milliseconds = [](double x) { return fmt::format("{:.3g} ms", 1e3 * x); };
  if (t.steps > 0) {
    rows.push_back({"step, median", milliseconds(t.median)});
    rows.push_back({"step, 99 % at most", milliseconds(t.percent_99)});
    rows.push_back({"step, longest",
                    fmt::format("{}, {:.2g} % of the time it simulates", milliseconds(t.largest),
                                s.step > 0.0 ? 100.0 * t.largest / s.step : 0.0)});
  }
  rows.push_back(
      {"Newton iterations per step",
       fmt::format("{:.2f}, {} in all", static_cast<double>(s.iterations) / steps, s.iterations)});
  rows.push_back({"factorisations per step",
                  fmt::format("{:.2f}, {} in all", static_cast<double>(s.factorizations) / steps,
                              s.factorizations)});
  rows.push_back({"program", "Floatframe " + report.software});
  rows.push_back({"processor", report.processor});
  return rows;
}

/// Edges in ms; null without a step.
Json step_times_json(const StepTimes& t) {
  if (t.steps == 0) return nullptr;
  Json edges = Json::array();
  for (const double e : t.edges) edges.push_back(1e3 * e);
  return {{"edges", edges},
          {"counts", t.counts},
          {"median", 1e3 * t.median},
          {"percent_99", 1e3 * t.percent_99},
          {"largest", 1e3 * t.largest}};
}

std::string subject_of(const Model& model, const Output& o) {
  if (o.joint >= 0) return model.joints[o.joint].name;
  if (o.element >= 0) return model.elements[o.element].name;
  if (o.body >= 0) return model.bodies[o.body].name;
  if (o.marker >= 0 && model.markers[o.marker].body >= 0)
    return model.bodies[model.markers[o.marker].body].name;
  return {};
}

std::string start_fact(const SimulationDescription& s) {
  if (s.start == Start::given) return "as given";
  const std::string from =
      s.start == Start::equilibrium
          ? std::string("static equilibrium")
          : fmt::format("state at {:g} s from {}", s.state->time, s.state->file);
  return from + (s.offset.empty() ? "" : ", with offsets");
}

}  // namespace

std::vector<ChannelSubject> channel_subjects(const Model& model) {
  std::vector<ChannelSubject> out;
  for (const Output& o : model.outputs)
    out.push_back({subject_of(model, o), spaced_words(output_type_name(o.type))});
  return out;
}

void add_states(Json& page, const Model& model, const std::string& states_file,
                const SimulationDescription* options, PageBuffer& buffer) {
  const StateHistory states(states_file);
  SceneFrames frames = scene_frames(model, states);
  if (options) add_replayed_values(model, states, *options, frames);
  page["scene"] = scene_json(model, frames, buffer);
  add_trust_curves(states, page["trust"], buffer);
}

Json run_page(const Report& report, const PageCurves& curves, PageBuffer& buffer) {
  const RunSummary& s = report.result.summary;
  const bool began = !report.result.table.columns.empty();
  Json page = empty_page("run", s.model, report.software,
                         {{"state", s.strict ? "failed" : s.status},
                          {"sentences", ending(report)},
                          {"warnings", sentences(s.warnings)}},
                         fmt::format("{} coordinates, inertia terms by {}, step {:g} s",
                                     s.coordinates, s.inertia, s.step));
  page["facts"] = facts_json(report.facts);
  page["tables"] = page_tables(report);
  page["curves"] = curves_json(curves, report.subjects, buffer);
  page["trust"] = {{"channels", Json::array()}, {"rows", began ? trust_rows(s) : Json::array()}};
  if (s.verification) add_verification(*s.verification, page["trust"]);
  page["speed"] = {{"rows", began ? speed_rows(report) : Json::array()},
                   {"step_times", step_times_json(s.step_times)}};
  return page;
}

void describe_model(const Model& model, Report& report) {
  FactTable facts{"Model", {}};
  report.tables = body_tables(model);
  try {
    const ModelCounts c = check(model);
    const auto coordinates = [](const CoordinateCounts& k) {
      return fmt::format("{} rigid + {} elastic = {}, {}", k.rigid, k.elastic, k.total,
                         plural(k.constraints, "constraint"));
    };
    facts.rows = {{"bodies", fmt::format("{}, {} flexible", c.bodies, c.flexible_bodies)},
                  {"joints", fmt::format("{}, {} cut", c.joints, c.cut_joints)},
                  {"relative coordinates", coordinates(c.relative)},
                  {"absolute coordinates", coordinates(c.absolute)},
                  {"degrees of freedom", std::to_string(c.degrees_of_freedom)}};
    for (PageTable& t : coordinate_tables(model, c)) report.tables.push_back(std::move(t));
  } catch (const RunError& error) {
    facts.rows = {{"coordinates", fmt::format("not counted: {}", error.what())}};
  }
  report.facts.push_back(std::move(facts));
}

FactTable setting_facts(const std::string& model_file, const std::vector<std::string>& settings,
                        const SimulationDescription& s) {
  FactTable facts{"Settings",
                  {{"model file", model_file.empty() ? "none" : model_file},
                   {"coordinates", rules::coordinates[index_of(s.coordinates)]},
                   {"inertia terms", rules::inertia_methods[index_of(s.inertia)]},
                   {"step", fmt::format("{:g} s", s.step)},
                   {"duration requested", fmt::format("{:g} s", s.duration)},
                   {"start", start_fact(s)},
                   {"spectral radius at infinity", fmt::format("{:g}", s.spectral_radius)},
                   {"Newton tolerance", fmt::format("{:g}", s.tolerance)},
                   {"Newton iterations at most", std::to_string(s.max_iterations)}}};
  if (s.locate_edges) facts.rows.push_back({"edges", "located within the steps"});
  for (const std::string& setting : settings) {
    facts.rows.push_back({"parameter set", setting});
  }
  return facts;
}

}  // namespace floatframe
