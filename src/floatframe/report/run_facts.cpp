#include "floatframe/report/run_facts.hpp"

#include <fmt/format.h>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/model/rules.hpp"
#include "floatframe/model/system_state.hpp"
#include "floatframe/report/run_page.hpp"
#include "floatframe/simulation/simulation.hpp"

namespace floatframe {

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

namespace {

std::string start_fact(const SimulationDescription& s) {
  if (s.start == Start::given) return "as given";
  const std::string from =
      s.start == Start::equilibrium
          ? std::string("static equilibrium")
          : fmt::format("state at {:g} s from {}", s.state->time, s.state->file);
  return from + (s.offset.empty() ? "" : ", with offsets");
}

}  // namespace

FactTable setting_facts(const std::string& model_file, const std::vector<std::string>& settings,
                        const SimulationDescription& s) {
  FactTable facts{"Settings",
                  {{"model file", model_file.empty() ? "none" : model_file},
                   {"coordinates", rules::coordinates[index_of(s.coordinates)]},
                   {"inertia terms", rules::inertia_methods[index_of(s.inertia)]},
                   {"step", fmt::format("{:g} s", s.step)},
                   {"duration asked", fmt::format("{:g} s", s.duration)},
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
