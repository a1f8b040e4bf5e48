#pragma once
// The parts of the model reader, one subject per file. Each reads one key of a model file from one
// instance, in the coordinates of that file, transforms the result to the world and appends it to
// the description.
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "floatframe/description/road_spectrum.hpp"
#include "floatframe/description/validate.hpp"
#include "floatframe/math/piecewise_build.hpp"
#include "floatframe/model_file/model_instance.hpp"

namespace floatframe {

struct ModalDamping;
struct PartJob;

/// The data of a body already read that joints, forces and outputs need.
struct KnownBody {
  Vec3 origin = Vec3::Zero();  ///< of the body frame, world [m]
  bool flexible = false;       ///< has modes; a rigid part has only its named nodes
  bool valid = true;           ///< its nodes are known (no error in its bars or its file)
  std::vector<Vec3> nodes;     ///< world design positions [m]
  std::map<std::string, std::size_t> named_nodes;
  int modes = 0;          ///< -1: depends on a frequency limit
  std::size_t index = 0;  ///< in the description
};

struct ReadModel {
  ModelDescription description;
  std::map<std::string, KnownBody> bodies;           ///< by full name
  std::map<std::string, JointType> joints;           ///< by full name
  std::map<std::string, ElementType> element_types;  ///< by full name
  std::set<std::string> columns;                     ///< names of outputs
  ReadOptions options;
};

void read_bodies(const ModelInstance& self, ReadModel& model);
void read_joints(const ModelInstance& self, ReadModel& model);
void read_rods(const ModelInstance& self, ReadModel& model);
void read_constraints(const ModelInstance& self, ReadModel& model);
void read_couplings(const ModelInstance& self, ReadModel& model);
void read_controllers(const ModelInstance& self, ReadModel& model);
void read_roads(const ModelInstance& self, ReadModel& model);
/// class or roughness, start, length, seed.
RoadSpectrum read_spectrum_keys(YamlSection& section);
/// Heights over x and y, and friction, of a road; null: it has none of these keys.
std::shared_ptr<const RoadSurface> read_surface(const ModelInstance& self, YamlSection& road);
void read_inputs(const ModelInstance& self, ReadModel& model);
/// Of the model file itself; after all that it names.
void read_vehicle(const ModelInstance& self, ReadModel& model);
void read_forces(const ModelInstance& self, ReadModel& model);
void read_initial(const ModelInstance& self, ReadModel& model);
void read_outputs(const ModelInstance& self, ReadModel& model);
/// Additional outputs of the options, with the names of the model file.
void read_added_outputs(const ModelInstance& root, ReadModel& model);
void read_simulation(const ModelInstance& self, ReadModel& model);
/// x, y, z of every rigid body.
void default_outputs(ReadModel& model);

/// An element from the section of its keys. `on`: the coordinate that it acts on, if it is one that
/// a key of a joint describes.
ElementDescription read_element(const ModelInstance& self, const std::string& name,
                                YamlSection& section, ElementType type, ReadModel& model,
                                const CoordinateTerm* on = nullptr);
/// The elements that keys of a joint describe.
void read_joint_elements(const ModelInstance& self, const std::string& joint, JointType type,
                         YamlSection& section, ReadModel& model);
/// Their names, as written in the file of the joint, from its keys there.
std::vector<std::string> joint_element_names(const std::string& joint, const YamlNode& keys);
/// The keys of such elements.
std::vector<const char*> joint_element_keys();

/// A body, not the ground.
std::optional<std::string> read_moving_body(const ModelInstance& self, const YamlValue& value);
/// {body, node: name or number} or {body, at: point}, with `layer`, `material`, `toward` and
/// `along` where there are several places; false after an error. `what` is a value of `s`.
bool read_gauge(const ModelInstance& self, YamlSection& s, const YamlValue& what,
                OutputDescription& o);
/// Stores a value that was read in its member; false if nothing was read.
template <class Read, class Place>
bool put(std::optional<Read> read, Place& place) {
  if (read) place = std::move(*read);
  return read.has_value();
}

/// A flexible body as described: bars, or a part that is already reduced.
struct FlexibleRead {
  FlexibleDescription description;
  std::optional<FlexibleBody> body;  ///< from a file: replaces the description
  bool valid = false;
  Vec3 first_point = Vec3::Zero();  ///< of the first bar
  std::vector<Vec3> nodes;          ///< coordinates of this file; of `body`: of the part
  std::map<std::string, std::size_t> named_nodes;
  int modes = 0;  ///< -1: depends on a frequency limit
};
/// A group of bars.
FlexibleRead read_flexible(const ModelInstance& self, YamlSection section);
/// Directions of a node: all, or a list of x, y, z, rx, ry, rz; from 0, in the order of the file.
std::vector<unsigned> read_dofs(const YamlValue& value);
/// The key `damping` of bars and parts.
ModalDamping read_damping(const YamlValue& value);
/// The key `bars` of such a group: bars, points, nodes.
void read_bars(const ModelInstance& self, YamlSection& section, FlexibleRead& out);
/// The value of `flexible` or `part`: a group of bars, a group with a finite-element file, the name
/// of a body file. `body` is for messages.
FlexibleRead read_part(const ModelInstance& self, const ReadModel& model, const std::string& body,
                       const YamlValue& value);
/// A group with a finite-element file as a job. nullopt and errors if it is invalid.
std::optional<PartJob> read_part_job(const ModelInstance& self, YamlSection section);
/// align: {marker: point}: the rigid motion of the part that maps its markers to the points of this
/// file, in the least-squares sense. nullopt and errors at markers with a distance from their
/// points.
std::optional<Pose> read_alignment(const ModelInstance& self, const YamlValue& value,
                                   double tolerance, const FlexibleBody& part);
/// Errors of a file keep their location; others get that of the value that names the file.
void add_errors(const YamlValue& value, const InputError& error);
/// A rotation vector, a unit quaternion or {roll, pitch, yaw}.
Mat3 read_orientation(const YamlValue& value, double* largest_angle = nullptr);
/// The key `geometry` of a body: solids and files as triangles in its frame. nullptr and errors if
/// they cannot be shown.
std::shared_ptr<const BodyShape> read_body_geometry(const ModelInstance& self,
                                                    const YamlValue& value);
/// `file` as written in a file of the model: relative to the folder of that file.
std::string sibling_path(const ModelInstance& self, const std::string& file);

/// Enabled entities of a kind, as sections whose key `when` has been read.
std::vector<std::pair<std::string, YamlSection>> active_entities(const ModelInstance& self,
                                                                 EntityKind kind);

/// Reports the errors that `check` (of model/validate.hpp) finds in an entity, at the locations of
/// its keys. Values that could not be read must be replaced by valid ones in the entity before, so
/// that no error is reported twice.
void validate_entity(const YamlSection& section, const Origin& origin,
                     const std::function<void(const validation::Entity&)>& check);

/// A direction: [x, y, z] of any length but zero, or x, y, z, -x, -y, -z. Returned as given (not
/// normalised).
std::optional<Vec3> read_direction(const YamlValue& value);

enum class AttachedBy {
  map,      ///< a separate map, which is read completely
  own_keys  ///< keys of the entity; it has a moving body
};
/// {body: name, at: point} or {body: name, node: name}; without either it is the origin of the body
/// frame. Points of flexible bodies are checked to be nodes. Coordinates of this file.
std::optional<AttachmentDescription> read_attachment(const ModelInstance& self,
                                                     const ReadModel& model, YamlSection& section,
                                                     AttachedBy by = AttachedBy::map);
/// Origin of the frame of a body in coordinates of this file; nullopt for the ground. On a flexible
/// body it need not be a node: a marker there moves with the frame itself.
std::optional<Vec3> frame_origin(const ModelInstance& self, const ReadModel& model,
                                 const std::string& body);
/// Error at `value` if a flexible body has no node at `point` (coordinates of this file).
bool check_node(const ModelInstance& self, const ReadModel& model, const std::string& body,
                const Vec3& point, const YamlValue& value);

/// A law f(x): a number k: k (x - free); {linear: {stiffness, free, preload}}; {polynomial: [c0,
/// c1, ...], about: x0}; {piecewise: [...]}; {table: [...], interpolation: ...}. `free` is the
/// default of the free value.
struct LawUnits {
  const char* x = "m";
  const char* f = "N";
  const char* slope = "N/m";
};
PiecewisePolynomial read_law(const YamlValue& value, double free, const LawUnits& units);
/// A formula with the parameters and names of this file; nullptr after an error.
SharedFormula read_formula(const ModelInstance& self, const YamlValue& value);
/// A formula of one variable: names are not those of the model.
SharedFormula read_shape(const ModelInstance& self, const YamlValue& value);
/// The same of x and y.
SharedFormula read_height(const ModelInstance& self, const YamlValue& value);
/// {formula: ...} of x, v and t, or the name of a function that a program is to give.
std::optional<ForceFunction> read_force_function(const ModelInstance& self, const YamlValue& value);
/// The section `tables`.
void read_tables(ModelInstance& self);
/// A function of time: a number is a constant, tables hold their end values, `sine` may be added.
/// For the motion of a joint, which has no jumps.
TimeFunction read_motion(const ModelInstance& self, const YamlValue& value, const char* unit,
                         Interpolation table);
/// The same with jumps (two points of a table with the same time), or {input: name}, or both in one
/// map, which are added.
SignalDescription read_signal(const ModelInstance& self, const YamlValue& value, const char* unit,
                              Interpolation table);

}  // namespace floatframe
