#pragma once
// One use of a model or subsystem file: its tree, parameters, points, names and placement in the
// world. A model file is the root; every entry of `subsystems` is a child. Names of an instance
// have its prefix ("front_left.") in the model; inside its file they have none. Names not defined
// in an instance are reached by `external` names (connected to names of the outer file) or,
// downwards, by dotted names of its subsystems.
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "floatframe/formulas/formula.hpp"
#include "floatframe/model_file/mirror.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/yaml/yaml_value.hpp"

namespace floatframe {

enum class EntityKind { body, joint, rod, constraint, coupling, force, controller, road, input };
inline constexpr std::array<const char*, 9> entity_words{
    "body", "joint", "rod", "constraint", "coupling", "force", "controller", "road", "input"};
inline constexpr std::array<const char*, 9> entity_keys{"bodies",      "joints",    "rods",
                                                        "constraints", "couplings", "forces",
                                                        "controllers", "roads",     "inputs"};

struct ModelInstance {
  ReadContext context;
  const YamlDocument* document = nullptr;
  ModelInstance* outer = nullptr;
  std::string prefix;  ///< "" or "front_left."
  ParameterScope scope;
  Placement placement;        ///< coordinates of this file -> coordinates of the outer file
  Placement world;            ///< coordinates of this file -> world
  Vec3 shift = Vec3::Zero();  ///< of the world coordinates, if nothing were mirrored
  FormulaTables tables;       ///< of the formulas in this file
  std::map<std::string, Vec3> points;  ///< coordinates of this file [m]
  /// Names defined in this file; false: switched off by `when`.
  std::array<std::map<std::string, bool>, entity_words.size()> names;
  std::set<std::string> refused_names;          ///< names of entities already reported as errors
  std::map<std::string, std::string> external;  ///< external name -> outer name
  std::vector<std::pair<std::string, std::unique_ptr<ModelInstance>>> children;
  std::optional<YamlSection> root;

  ModelInstance* child(const std::string& name) const;

  /// Full name of an entity written as `name` in this file; nullopt if there is none. `off`: set
  /// for a disabled one.
  std::optional<std::string> resolve(EntityKind kind, const std::string& name,
                                     bool* off = nullptr) const;
  /// As above, with an error at `value`. `bodies` include the ground.
  std::optional<std::string> reference(EntityKind kind, const YamlValue& value) const;
  /// The same for a body, not the ground, whose name is the key of `entry`.
  std::optional<std::string> moving_body(const std::string& name, const YamlValue& entry) const;
  /// A point of the world in coordinates of this file: P is its own inverse.
  Vec3 local(const Vec3& p) const { return world.P * (p - world.t); }
  /// A full name as written in this file.
  std::string written(const std::string& full) const;
  /// All names of a kind that can be written in this file.
  std::vector<std::string> known(EntityKind kind) const;

  /// Design coordinates in this file of a named point, also of one of a subsystem
  /// ("front_left.hub").
  std::optional<Vec3> point(const std::string& name) const;
  std::vector<std::string> known_points() const;
  /// A point written as a name or as [x, y, z].
  std::optional<Vec3> read_point(const YamlValue& value) const;

 private:
  /// Reason why there is no entity of that name; empty if it was already reported.
  std::string no_entity(EntityKind kind, const std::string& name, bool off) const;
};

}  // namespace floatframe
