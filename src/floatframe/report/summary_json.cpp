#include "floatframe/report/summary_json.hpp"

#include <nlohmann/json.hpp>

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

/// Text from files may hold bytes that are not UTF-8: they are replaced, never an error.
std::string dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json array_of(const VecX& v) {
  Json array = Json::array();
  for (Eigen::Index i = 0; i < v.size(); ++i) array.push_back(v[i]);
  return array;
}

Json coordinate_counts(const CoordinateCounts& c) {
  return {{"rigid", c.rigid},
          {"elastic", c.elastic},
          {"total", c.total},
          {"constraints", c.constraints}};
}

Json energy(double kinetic, double potential, double elastic, double total) {
  return {{"kinetic_J", kinetic},
          {"potential_J", potential},
          {"elastic_J", elastic},
          {"total_J", total}};
}

/// The last value of a parameter is the one that counts.
Json settings(const std::vector<std::string>& list) {
  Json json = Json::object();
  for (const std::string& setting : list) {
    const std::size_t equal = setting.find('=');
    json[setting.substr(0, equal)] = setting.substr(equal + 1);
  }
  return json;
}

/// Null for a run that kept none.
Json balance(const EnergySummary& e) {
  if (!e.balanced) return nullptr;
  Json work = Json::object();
  for (std::size_t k = 0; k < EnergyFlows::size(); ++k)
    work[std::string(energy_flow_names[k]) + "_J"] = e.work.value[k];
  work["total_J"] = e.work.total();
  return {{"work", work},
          {"remainder_J", e.remainder},
          {"largest_remainder_J", e.largest_remainder},
          {"largest_remainder_at_s", e.largest_remainder_at},
          {"exchanged_J", e.exchanged}};
}

Json redundant_directions(const std::vector<RedundantDirection>& redundant) {
  Json array = Json::array();
  for (const RedundantDirection& r : redundant)
    array.push_back({{"constraint", r.owner}, {"direction", r.direction}});
  return array;
}

Json start(const StartReport& s) {
  Json changes = Json::array();
  for (const StartChange& c : s.changes)
    changes.push_back({{"owner", c.owner},
                       {"quantity", c.quantity},
                       {"rate", c.rate},
                       {"unit", c.unit},
                       {"given", c.given},
                       {"used", c.used}});
  return {
      {"notes", s.notes}, {"changes", changes}, {"redundant", redundant_directions(s.redundant)}};
}

Json measured(const RunSummary& s) {
  const EnergySummary& e = s.energy;
  return {{"duration_s", s.duration},
          {"steps", s.steps},
          {"substeps", s.substeps},
          {"iterations", s.iterations},
          {"factorizations", s.factorizations},
          {"cpu_s", s.cpu},
          {"real_time_factor", s.real_time_factor},
          {"max_position_violation", s.max_position_violation},
          {"max_velocity_violation", s.max_velocity_violation},
          {"energy",
           {{"start", energy(e.kinetic_start, e.potential_start, e.elastic_start, e.total_start)},
            {"end", energy(e.kinetic_end, e.potential_end, e.elastic_end, e.total_end)},
            {"balance", balance(e)}}},
          {"warnings", sentences(s.warnings)},
          {"start", start(s.start)}};
}

}  // namespace

std::string summary_json(const RunSummary& s) {
  Json json = Json::object();
  // What nobody measured is left out: a model that could not be read, a run that never began, or
  // one of a study that was stopped or died.
  const bool began = s.status != "failed" || s.steps > 0 || s.cpu > 0.0;
  if (began || !s.model.empty())
    json.update({{"model", s.model},
                 {"coordinates", s.coordinates},
                 {"inertia", s.inertia},
                 {"step_s", s.step}});
  if (began) json.update(measured(s));
  json.update({{"status", s.status}, {"message", s.message}});
  if (!s.files.empty()) {
    json["settings"] = settings(s.settings);
    json["files"] = s.files;
  }
  return dump(json);
}

std::string counts_json(const ModelCounts& c) {
  const Json json = {{"bodies", c.bodies},
                     {"flexible_bodies", c.flexible_bodies},
                     {"joints", c.joints},
                     {"cut_joints", c.cut_joints},
                     {"relative", coordinate_counts(c.relative)},
                     {"absolute", coordinate_counts(c.absolute)},
                     {"degrees_of_freedom", c.degrees_of_freedom},
                     {"redundant_constraints", c.redundant_constraints},
                     {"cut_joint_names", c.cut_joint_names},
                     {"start", start(c.start)}};
  return dump(json);
}

std::string statics_json(const std::string& model, const StaticsResult& statics,
                         const std::vector<RangeWarning>& warnings) {
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
                      {"force", array_of(j.force)},
                      {"torque", array_of(j.torque)},
                      {"unique", j.unique()},
                      {"unique_force", j.unique_force},
                      {"unique_torque", j.unique_torque}});
  }
  for (const StaticsBody& b : statics.bodies) {
    bodies.push_back({{"name", b.name},
                      {"position", array_of(b.position)},
                      {"roll_pitch_yaw", array_of(b.roll_pitch_yaw)},
                      {"amplitudes", array_of(b.amplitudes)}});
  }
  const Json json = {{"model", model},
                     {"iterations", statics.iterations},
                     {"residual", statics.residual},
                     {"forces", forces},
                     {"joints", joints},
                     {"bodies", bodies},
                     {"redundant", redundant_directions(statics.redundant)},
                     {"warnings", sentences(warnings)}};
  return dump(json);
}

}  // namespace floatframe
