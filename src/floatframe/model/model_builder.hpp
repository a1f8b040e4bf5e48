#pragma once
// The stages of build_model, which share names, markers and the list of errors; each stage is in
// the file of its subject (build_*.cpp).
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "floatframe/description/name_index.hpp"
#include "floatframe/model/build_stages.hpp"
#include "floatframe/model/element_keys.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

/// The description has been checked by `validate`: only errors that appear when bodies are reduced
/// remain.
struct ModelBuilder {
  static constexpr int ground_index = -1;

  const ModelDescription& d;
  const NameIndex body_names, road_names, input_names;
  NameIndex joint_names;                        ///< of those that are built
  NameIndex element_names[element_list_count];  ///< of each ElementList
  /// Body, node, rotation with the node, position and orientation of each marker on a body.
  std::map<std::array<double, 15>, int> marker_places;
  Model model;
  ErrorList errors;
  std::set<std::string> wrong_gauges;  ///< locations and their errors

  explicit ModelBuilder(const ModelDescription& description)
      : d(description),
        body_names(description.bodies),
        road_names(description.roads),
        input_names(description.inputs) {}

  void bodies(const ReduceBody& reduce);
  void stiffening(const BodyDescription& b, Body& body);
  void roads();
  void inputs();
  void joints();
  /// Bodies without a path of joints from the ground get a free joint to it (the first in file
  /// order each time).
  void free_joints();
  /// Rods, couplings and motions, which are known before axes are made exact.
  void holding_elements();
  /// Builds them and controllers, and puts both first.
  void forces();
  /// A formula of a signal, as an element: its name, and where it is written.
  struct InnerFormula {
    ElementDescription element;
    std::string path;
  };
  std::vector<InnerFormula> formulas;
  /// What formulas delay, as elements of their own.
  void delays_apart();
  void delays_apart(const Formula& f, const std::string& owner, const InnerFormula& inner);
  std::optional<std::pair<std::string, std::string>> measured_by(const FormulaReference& r) const;
  /// The formula of a key as a part of the law of its element (local_formula.hpp); null: it reads
  /// more than that may.
  SharedFormula as_local(const ElementDescription& e, const ElementKey& key,
                         const Formula& f) const;
  /// The element without the formulas of its signals, which become elements of their own unless
  /// they are parts of its law.
  ElementDescription with_formulas_apart(const ElementDescription& e, ElementList list);
  /// What the references of formulas stand for.
  void connect_formulas();
  /// Results of elements that are signals of others.
  void link_signals();
  /// False after an error.
  bool add_element(const ElementDescription& e);
  void outputs();
  void output_list(const std::string& list, const std::vector<OutputDescription>& described,
                   std::vector<Output>& built);
  /// Nothing, with an error, if something that it refers to is missing.
  std::optional<Output> output(const OutputDescription& o, const std::string& who);
  /// What an output refers to: false, with an error, if something of it is missing.
  bool subject(const OutputDescription& o, Output& out, const std::string& who);
  bool mass(const OutputDescription& o, Output& out, const std::string& who);
  /// The frame that it is relative to and its axes.
  bool frames(const OutputDescription& o, Output& out, const std::string& who);
  /// One of the values of its element.
  bool value_of_element(const OutputDescription& o, Output& out, const std::string& what);
  /// The unit that the user wants.
  bool unit(const OutputDescription& o, Output& out, const std::string& who);
  /// Its component is one of `n` numbers, of a mode or of a state.
  bool has_number(const OutputDescription& o, const char* what, int n, const std::string& who);
  /// Index of an element by its name, -1 if it is not built.
  int element(ElementList list, const std::string& name) const;
  /// Data of a reaction: false if something it refers to is missing.
  bool reaction(const OutputDescription& o, Output& out, const std::string& who);
  /// Location of a stress: false, with an error, if there is none.
  bool gauge(const OutputDescription& o, Output& out, const std::string& who);
  /// Rejects bodies whose modes have no inertia.
  void modal_masses();
  /// Lengths and masses that scale the equations; start values of the modes.
  void finish();

  /// `ground_index` for the ground.
  int body_index(const std::string& name) const;
  /// A marker at a design point; -1 and an error if the body has no such node. `oriented`: the
  /// orientation of the marker matters, so the rotation of the node is included. The error refers
  /// to "who.at" or to "who.node_key".
  int add_marker(const AttachmentDescription& at, const Mat3& R_design, bool oriented,
                 const SourceMark& mark, const std::string& who, const char* node_key = "node");
  /// The frame of a body, which no mode moves, with the axes of the world in the design
  /// configuration; -1: of the ground.
  int body_frame(const std::string& body);
  /// Joints, elements and outputs share equal markers.
  int shared_marker(const Marker& m);
  const Marker& marker(int index) const { return model.markers[index]; }
  /// World position of a marker in the design configuration.
  Vec3 design_point(int marker) const;
};

/// v / |v|, also where |v|^2 overflows.
inline Vec3 unit_vector(const Vec3& v) {
  const double square = v.squaredNorm();  // overflows, or underflows for tiny components
  return std::isfinite(square) && square > 1e-280 ? v.normalized()
                                                  : (v / v.cwiseAbs().maxCoeff()).normalized();
}

/// Of the element of a delay in the formula of `owner`; no name of the user has a slash.
std::string delay_name(const std::string& owner, const Formula& f, const FormulaReference& r);

}  // namespace floatframe
