#pragma once
// Checks of the meaning of a description from any source: the reader of model files, which has
// already checked words and types, or a C++ program, whose data may be arbitrary. Each sentence
// begins with the path that the entity would have in a model file. After these checks no code needs
// to check sizes, signs, enumerators or NaN again. What depends on the kind of a joint, element or
// output is checked in model/validate_model.hpp.
#include <set>
#include <string>
#include <vector>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/description/description.hpp"
#include "floatframe/description/name_index.hpp"

namespace floatframe {

/// The group `simulation`.
void validate(const SimulationDescription& simulation, ErrorList& errors);
/// Throws InputError with every error of the group.
void require_valid(const SimulationDescription& simulation);
/// The same, and the number of steps is within the limit for a run.
void require_valid_run(const SimulationDescription& simulation);
/// Position for a sentence about the step and the duration together: the option of the command line
/// that gave one of them, else the step, the duration or the group in the file.
SourceMark mark_of_time_settings(const SimulationDescription& simulation);

namespace validation {

/// Names that entities refer to.
struct Names {
  NameIndex bodies, joints, forces, roads, inputs, rods, constraints, couplings, controllers;
};

/// One entity: adds "path.key: sentence" at the position of the key, if known.
struct Entity {
  ErrorList& errors;
  const Origin& origin;
  std::string path;

  void error(ErrorCode code, const std::string& key, const std::string& sentence) const;
  /// "path: sentence"
  void error(ErrorCode code, const std::string& sentence) const;
  void complain(ErrorCode code, const std::string& key,
                const std::optional<std::string>& complaint) const {
    if (complaint) error(code, key, *complaint);
  }
  /// Each returns true if the value is valid.
  bool number(const std::string& key, double x, const NumberRule& rule) const;
  bool whole(const std::string& key, int x, const WholeNumberRule& rule) const;
  template <class Enum, std::size_t n>
  bool word(const std::string& key, Enum value, const char* const (&words)[n]) const {
    const auto complaint = word_complaint(static_cast<int>(value), words);
    complain(ErrorCode::wrong_value, key, complaint);
    return !complaint;
  }
  bool vector(const std::string& key, const Vec3& v, const char* unit) const;
  bool list(const std::string& key, const std::vector<double>& v) const;
  bool direction(const std::string& key, const Vec3& v) const;
  bool rotation(const std::string& key, const Mat3& R) const;
  bool reference(const std::string& key, const char* kind, const std::string& name,
                 const NameIndex& known) const;
  /// A point on a body; also on the ground if `ground`.
  bool place(const std::string& key, const AttachmentDescription& at, const Names& names,
             bool ground = true) const;
  bool pieces(const std::string& key, const PiecewisePolynomial& f, bool may_jump = false) const;
  /// `may_jump`: a jump of the value is allowed, too, as for a load.
  void function(const std::string& key, const TimeFunction& f, bool may_jump = false) const;
  void signal(const std::string& key, const SignalDescription& s, const Names& names) const;
};

/// A name of letters, digits, _ and -, with dots between the names of subsystems; used once.
void name(const char* kind, const std::string& name, std::set<std::string>& taken,
          const Entity& entity);

// Checks of one entity independent of the others: `validate` makes them for every description, and
// the reader of model files for each entity it has read.
void input(const InputDescription& input, const Entity& entity);
/// Mass properties of a rigid body, keys of the group `rigid`.
void rigid(const RigidDescription& rigid, const Entity& body);

void bodies(const ModelDescription& d, ErrorList& errors);
void flexible(const FlexibleDescription& f, const Entity& body);
void flexible(const FlexibleBody& f, const Entity& body);
void roads(const ModelDescription& d, ErrorList& errors);
void inputs(const ModelDescription& d, ErrorList& errors);
void vehicle(const ModelDescription& d, const Names& names, ErrorList& errors);
void amplitudes(const ModelDescription& d, const Names& names, ErrorList& errors);

}  // namespace validation
}  // namespace floatframe
