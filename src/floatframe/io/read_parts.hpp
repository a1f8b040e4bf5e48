#pragma once
// The parts of the model reader, one subject a file. Each reads one key of a model file from one
// instance, in the coordinates of that file, places the result in the world and appends it to the
// description.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/io/model_instance.hpp"
#include "floatframe/math/piecewise_build.hpp"

namespace floatframe {

/// What joints, forces and outputs need to know of a body that has been read.
struct KnownBody {
  Vec3 origin = Vec3::Zero();  ///< of the body frame, world [m]
  bool flexible = false;
  bool sound = true;        ///< its nodes are known (no fault in its bars)
  std::vector<Vec3> nodes;  ///< world design positions [m]
  std::map<std::string, std::size_t> named_nodes;
  int modes = 0;  ///< -1: decided by a frequency limit
};

struct ReadModel {
  ModelDescription description;
  std::map<std::string, KnownBody> bodies;         ///< by full name
  std::map<std::string, JointType> joints;         ///< by full name
  std::map<std::string, std::string> force_types;  ///< by full name
};

void read_bodies(const ModelInstance& self, ReadModel& model);
void read_joints(const ModelInstance& self, ReadModel& model);
void read_rods(const ModelInstance& self, ReadModel& model);
void read_roads(const ModelInstance& self, ReadModel& model);
void read_inputs(const ModelInstance& self, ReadModel& model);
void read_forces(const ModelInstance& self, ReadModel& model);
void read_initial(const ModelInstance& self, ReadModel& model);
void read_outputs(const ModelInstance& self, ReadModel& model);
void read_simulation(const ModelInstance& self, ReadModel& model);
/// x, y, z of every rigid body.
void default_outputs(ReadModel& model);

/// The flexible group of a body; `position` and the node list are its results besides the
/// description.
struct FlexibleRead {
  FlexibleDescription description;
  bool sound = false;
  Vec3 first_point = Vec3::Zero();
  std::vector<Vec3> nodes;
  std::map<std::string, std::size_t> named_nodes;
  int modes = 0;
};
FlexibleRead read_flexible(const ModelInstance& self, YamlSection section);

/// Entities of a kind that are not switched off, as sections with `when` already asked for.
std::vector<std::pair<std::string, YamlSection>> active_entities(const ModelInstance& self,
                                                                 EntityKind kind);

/// A direction: [x, y, z] of any length but zero, or x, y, z, -x, -y, -z. Returned as given (not
/// normalised).
std::optional<Vec3> read_direction(const YamlValue& value);

/// {body: name, at: point} or {body: name, node: name}; `at` may be left out for a rigid body: its
/// frame origin. Points of flexible bodies are checked to be nodes. Coordinates of this file.
std::optional<AttachmentDescription> read_attachment(const ModelInstance& self,
                                                     const ReadModel& model, YamlSection section);
/// Fault at `value` if a flexible body has no node at `point` (coordinates of this file).
bool check_node(const ModelInstance& self, const ReadModel& model, const std::string& body,
                const Vec3& point, const YamlValue& value);
/// Fault at `value` if the body has no node of that name.
bool check_named_node(const ModelInstance& self, const ReadModel& model, const std::string& body,
                      const std::string& node, const YamlValue& value);

/// A law f(x): a number k: k (x - free); {linear: {stiffness, free, preload}}; {polynomial: [c0,
/// c1, ...], about: x0}; {piecewise: [...]}; {table: [...], interpolation: ...}. `free` is the
/// default of the free value.
struct LawUnits {
  const char* x = "m";
  const char* f = "N";
  const char* slope = "N/m";
};
PiecewisePolynomial read_law(const YamlValue& value, double free, const LawUnits& units);
/// A function of time: a number is a constant, tables hold their end values, `sine` may be added.
TimeFunction read_time_function(const YamlValue& value, const char* unit, Interpolation table);
/// The same, or {input: name}, or both in one map: then they add up.
SignalDescription read_signal(const ModelInstance& self, const YamlValue& value, const char* unit,
                              Interpolation table);

}  // namespace floatframe
