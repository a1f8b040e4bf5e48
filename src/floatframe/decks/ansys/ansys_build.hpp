#pragma once
// From the content of an ANSYS deck to the model.
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/decks/ansys/ansys_content.hpp"
#include "floatframe/decks/rigid_arms.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

/// A section of beams in the axes of its principal moments.
struct AnsysBeam {
  BeamSection section;
  double turn = 0.0;                ///< of y towards z [rad]
  double mass = 0.0;                ///< in addition to the material [mass/length]
  double arm_y = 0.0, arm_z = 0.0;  ///< of the centroid from the node, before the rotation
};

struct AnsysBuild {
  TextSource& source;
  AnsysContent& content;
  const FeReadOptions& options;
  FeModel& model;
  std::vector<int> index = {};  ///< in the model, of each element of the deck; -1: none

  /// Index of a node; an error and -1 if it is missing.
  int node(int id, const FeSource& at, const std::string& who);
  /// The nodes of an element as indices, in the order of the deck, -1 for 0 and missing ones;
  /// false with an error.
  bool nodes_of(const AnsysElement& e, std::vector<int>& nodes);
  /// "element 12 (SOLID185)"
  std::string label(const AnsysElement& e) const;
  /// The type of an element; null with an error, once per type.
  const AnsysType* type(const AnsysElement& e);
  /// The definition so far without an error; null where undefined.
  std::pair<const AnsysType*, const AnsysLibraryElement*> known(const AnsysElement& e) const;
  /// Null if they are not in the file, `needed_real` with an error.
  const AnsysReal* real(const AnsysElement& e) const;
  const AnsysReal* needed_real(const AnsysElement& e);
  /// The section of an element if it is of a kind (SHEL, BEAM, ...), else null.
  const AnsysSection* section(const AnsysElement& e, const char* kind) const;
  /// Index of a material by its number, with additional mass per volume.
  int material(int id, const AnsysElement& e, double more_density = 0.0);
  /// Material of a layer, 0: of the element; null and an error if there is no such material.
  std::optional<int> layer_material(double number, const AnsysElement& e, const FeSource& at);
  /// Axes of a coordinate system; none for the global rectangular one. An error if it is not read.
  std::optional<Orientation> system(int id, const FeSource& at, const std::string& who);
  /// Index in FeModel::orientations; -1: body axes.
  int orientation(int id, const FeSource& at, const std::string& who);
  /// Axes of the nodal system of a node; columns in body axes.
  Mat3 nodal_axes(int node) const;
  /// Errors give false, for functions that return whether they built the item.
  template <class... Args>
  bool error(ErrorCode code, const AnsysElement& e, fmt::format_string<Args...> text,
             Args&&... args) {
    source.error(code, e.at, "{}: {}", label(e), fmt::format(text, std::forward<Args>(args)...));
    return false;
  }
  /// An error common to elements of one type: `report_shared` reports it with the first of them.
  template <class... Args>
  bool shared_error(ErrorCode code, const AnsysElement& e, fmt::format_string<Args...> text,
                    Args&&... args) {
    const std::string said_of_type = fmt::format(text, std::forward<Args>(args)...);
    const auto [it, fresh] = shared.try_emplace({e.type, said_of_type}, Shared{e, code});
    if (!fresh) ++it->second.others;
    return false;
  }
  void report_shared();
  /// An error of a property of many elements; equal ones are reported once.
  template <class... Args>
  bool error_once(ErrorCode code, const FeSource& at, fmt::format_string<Args...> text,
                  Args&&... args) {
    const std::string message = fmt::format(text, std::forward<Args>(args)...);
    if (said_once.insert(fmt::format("{}:{}: {}", at.file, at.line, message)).second)
      source.error(code, at, message);
    return false;
  }
  template <class... Args>
  void note(const FeSource& at, fmt::format_string<Args...> text, Args&&... args) {
    source.note(model, at, text, std::forward<Args>(args)...);
  }
  /// Of the whole file.
  template <class... Args>
  void file_note(fmt::format_string<Args...> text, Args&&... args) {
    source.note(model, {0, 0}, text, std::forward<Args>(args)...);
  }

  std::map<std::pair<int, double>, int> materials = {};
  std::map<int, int> orientations = {};
  std::map<std::pair<int, int>, int> layups = {};  ///< by section and material; -1: with an error
  std::map<int, std::optional<AnsysBeam>> beams = {};  ///< by section; none: with an error
  int solved_sections = 0;                             ///< shapes whose torsion has been computed
  RigidArms arms = {};                                 ///< of beams offset from their nodes
  std::vector<char> rotates = {};                      ///< for masses: `nodes_with_rotations`
  int largest_node = 0;                                ///< of `add_generated_node`
  std::vector<int> said = {};                          ///< types with an error
  struct Shared {
    AnsysElement first;
    ErrorCode code;
    long others = 0;
  };
  std::map<std::pair<int, std::string>, Shared> shared = {};  ///< by type and text
  std::set<std::string> said_once = {};
};

/// Solids, shells, beams, rods.
void build_ansys_elements(AnsysBuild& build);
// Elements of those families, false with an error; `nodes`: indices in the order of the deck.
void build_ansys_shell(AnsysBuild& build, const AnsysElement& e, const AnsysType& type,
                       FeElement& element);
/// Of solids.
bool ansys_has_layers(const AnsysBuild& build, const AnsysElement& e, const AnsysType& type);
bool build_ansys_layers(AnsysBuild& build, const AnsysElement& e, const AnsysType& type,
                        FeElement& element);
/// BEAM and PIPE sections; none with an error.
std::optional<AnsysBeam> ansys_beam_section(AnsysBuild& build, const AnsysSection& section,
                                            const AnsysElement& e);
/// Empty if all values of a beam are finite, else the invalid ones.
std::string ansys_beam_misfit(const AnsysBeam& beam);
/// COMBIN14, MATRIX27, MPC184, CERIG, then MASS21.
void build_ansys_springs(AnsysBuild& build);
void build_ansys_rigid(AnsysBuild& build);
void build_ansys_masses(AnsysBuild& build);
/// A point mass of an element; inertia of a node without rotations is ignored, with a note.
bool add_ansys_mass(AnsysBuild& build, const AnsysElement& e, PointMass mass);
/// MATRIX27
bool build_ansys_matrix(AnsysBuild& build, const AnsysElement& e, const AnsysType& type,
                        const std::vector<int>& nodes);
void build_ansys_contact(AnsysBuild& build);
void build_ansys_equations(AnsysBuild& build);
void build_ansys_supports(AnsysBuild& build);
void build_ansys_components(AnsysBuild& build);

inline constexpr double ansys_degree = std::numbers::pi / 180.0;  ///< [rad]
/// R_z(a) R_x(b) R_y(c), angles in degrees: of nodes and coordinate systems.
Mat3 ansys_rotation(const Vec3& angles);

}  // namespace floatframe
