#pragma once
// From the content of Nastran bulk data to the model.
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "floatframe/decks/nastran/nastran_content.hpp"
#include "floatframe/decks/rigid_arms.hpp"
#include "floatframe/formats/fe_file.hpp"

namespace floatframe {

/// Equations in directions other than the basic axes. Those of one node are solved for
/// as many different basic directions of it, so that every equation has a dependent degree
/// of freedom.
class NastranEquations {
 public:
  using Dof = std::pair<int, int>;  ///< node and axis
  struct Row {
    std::map<Dof, double> factors;
    FeSource at;
    Dof pivot{};  ///< that it is solved for
  };
  /// `rotation`: the block that the equation determines. The order of its terms does not matter.
  void add(int node, bool rotation, const LinearEquation& equation);
  /// A component 0 to 5 of a node, along its axes e, follows another node r rigidly:
  ///   e.u = e.u_r + (arm x e).theta_r,   e.theta = e.theta_r.
  void follow(int node, int component, const Mat3& axes, int reference, const Vec3& arm,
              const FeSource& at);
  void flush(FeModel& model, TextSource& source);
  /// By node and block.
  const auto& blocks() const { return blocks_; }

 private:
  std::map<std::pair<int, bool>, std::vector<Row>> blocks_;
};

struct NastranBuild;
/// Location of a scalar point in the model.
struct NastranScalarPoint {
  int node = -1;
  int axis = 0;         ///< 0, or 3 if its springs are torsional
  bool sprung = false;  ///< a spring ends there
  int root = 0;         ///< link to another point joined by springs
  FeSource at;          ///< of its first reference
};

/// The scalar points used by springs and equations, by their numbers.
class NastranScalarPoints {
 public:
  void build(NastranBuild& build);
  /// Null if the number is not in use.
  const NastranScalarPoint* find(int id) const;
  /// Held by an SPC: it is the ground.
  bool held(int id) const { return held_.contains(id); }

 private:
  std::map<int, NastranScalarPoint> points_;
  NastranRanges held_;
};

struct NastranBuild {
  const NastranContent& content;
  TextSource& source;
  FeModel model;
  std::unordered_map<int, int> node_of;  ///< index of a node number
  std::map<int, int> orientation_of;     ///< index in FeModel::orientations of a system
  std::vector<char> turned;              ///< nodes whose displacements are in a turned system
  NastranEquations equations;            ///< added to the model at the end
  NastranScalarPoints scalars;

  NastranBuild(const NastranContent& c, TextSource& s) : content(c), source(s) {}
  /// Index of a node; an error and -1 if it is missing.
  int node(int id, const FeSource& at, const std::string& who);
  int node(int id, const NastranEntity& e) { return node(id, e.at, e.label()); }
  /// "CBAR 12: ..." at the location of the card.
  template <class... Values>
  void error(ErrorCode code, const NastranEntity& e, fmt::format_string<Values...> text,
             Values&&... values) {
    source.error(code, e.at, "{}: {}", e.label(),
                 fmt::format(text, std::forward<Values>(values)...));
  }
  /// The same; false.
  template <class... Values>
  bool fail(ErrorCode code, const NastranEntity& e, fmt::format_string<Values...> text,
            Values&&... values) {
    error(code, e, text, std::forward<Values>(values)...);
    return false;
  }
  /// Item referenced by an element by number; null with an error if it is missing.
  template <class Property>
  const Property* property(const std::map<int, Property>& all, int id, const char* card,
                           const NastranEntity& element) {
    const auto it = all.find(id);
    if (it != all.end()) return &it->second;
    error(ErrorCode::not_found, element, "property {} ({}) is not in the file", id, card);
    return nullptr;
  }
  /// The system in basic coordinates, x = origin + axes x_local; an error (once a system) and basic
  /// axes if it is missing.
  const Orientation& frame(int id, const FeSource& at);
  void note(const FeSource& at, const std::string& text);
  /// "3 CTRIA6 elements ..." at the first of them, if there is any.
  void note(const NastranCount& count, const std::string& text);
  /// Axes of the displacements of a node (CD) at its place; columns in basic axes.
  Mat3 axes(int node) const;
  /// Those of a system at the place of a node.
  Mat3 axes_of_system(int system, const FeSource& at, int node);
  std::unordered_map<int, Mat3> turned_axes;  ///< of the turned nodes
  /// In basic axes, from a node on; `turned`: the vector is in its system. False with an error.
  bool direction(const NastranDirection& given, int from, bool turned, const NastranEntity& e,
                 Vec3& out);
  /// A new node with a free number.
  int add_node(const Vec3& p, const FeSource& at, const std::string& who);
  std::vector<char> rotates;  ///< nodes that have rotations; empty until constraints are built
  /// Gives rotations to an otherwise unused node by a spider with a separate node.
  void give_rotations(int node, const NastranEntity& e);
  /// Counts members that a range names: a few bytes can name all nodes again and again. Throws if
  /// there are too many in all.
  void spend(std::size_t members, const FeSource& at);

 private:
  int largest_id_ = 0;
  std::uint64_t spent_ = 0;
  Orientation make_frame(int id, const FeSource& at);
  Orientation through(const std::array<Vec3, 3>& points, const NastranSystem& system);
  /// Position of a node of a system, before it is in the model.
  Vec3 place_of(int id, const NastranSystem& system);
  std::unordered_map<int, int> grid_of_;
  std::map<int, Orientation> frames_;
  std::set<int> open_;  // systems being built, to detect cycles
};

void build_nastran_nodes(NastranBuild& build);
/// Directions of a system at a place: cylinder radial, around, along; sphere radial, along the
/// meridian (theta), around (phi). On the axis the angle around is zero.
Mat3 nastran_axes_at(const Orientation& f, const Vec3& p);
/// CONM1 and CMASS of nodes: one per node.
std::vector<NastranMass> nastran_rigid_masses(NastranBuild& build);
/// Masses of scalar points are errors, except of those that are held.
void check_nastran_scalar_masses(NastranBuild& build);
void build_nastran_springs(NastranBuild& build);
/// GJ/L of rods; after what gives rotations to nodes.
void build_nastran_torsion(NastranBuild& build);
/// Equations with scalar points. Each is solved for one of them; those without any become
/// equations of nodes.
void build_nastran_scalar_equations(NastranBuild& build,
                                    const std::vector<const NastranEquation*>& equations);
/// Lumped or consistent.
void nastran_mass_forms(NastranBuild& build);
void build_nastran_elements(NastranBuild& build, const FeReadOptions& options);
/// `material`: index of one by its number.
ShellSection nastran_shell_section(NastranBuild& build, const NastranElement& e,
                                   const NastranProperty& p,
                                   const std::function<int(int)>& material);
/// Notes of shells that are read as others.
void note_nastran_shells(NastranBuild& build);
/// Axes of the material of an element whose section and material are known.
void orient_nastran_shell(NastranBuild& build, const NastranElement& e, FeElement& result);
void orient_nastran_solid(NastranBuild& build, const NastranProperty& p, FeElement& result);
/// Materials of the model by their numbers.
class NastranMaterials {
 public:
  explicit NastranMaterials(NastranBuild& build) : b_(build), c_(build.content) {}
  /// Index of a material; one with nonstructural mass (per volume) is a separate material.
  int index(const NastranProperty& p, double nonstructural) {
    return index(p, nonstructural, p.material, true);
  }
  int index(const NastranProperty& p, double nonstructural, int id, bool weighs);
  /// The same as another without density.
  int massless(int material);
  /// G of a material over that from its E and NU: bars twist and shear with the G of the card, for
  /// any E and NU, and no other property of a bar depends on it.
  double own_shear(int id);

 private:
  Material elastic(int id, const NastranMaterial& m);
  NastranBuild& b_;
  const NastranContent& c_;
  std::map<std::tuple<int, double, bool>, int> indices_;
  std::map<int, int> massless_;
  std::set<int> checked_, unfit_for_bars_;
  std::set<std::tuple<int, int, int>> checked_properties_;  // file, line and material
  // Properties by line with an invalid negative nonstructural mass that was reported.
  std::set<std::pair<int, int>> noted_, negative_;
};
/// A piece of a tapered beam.
struct NastranPiece {
  double to = 1.0;  ///< its end, of the length
  BeamSection section;
  double turn = 0.0;
  double nonstructural = 0.0;
};
/// For the tapered properties of a file, up to the limit of a file.
std::map<int, std::vector<NastranPiece>> nastran_tapers(NastranBuild& build);
/// Is it a bar with zeros among I1, I2 and J that can be a rod with springs? Null: plain ends.
bool is_weak_nastran_bar(const NastranProperty& p, const NastranBarEnds* ends);
std::string weak_nastran_bar_note(const NastranProperty& p);
/// Springs that bend as the beam does; the rod has its material and reference vector.
void add_nastran_bending(NastranBuild& build, const FeElement& rod, const BeamSection& section,
                         double shear_modulus, const NastranEntity& bar);
/// Columns x along the bar, y in the plane of x and v; zero where there is no direction.
Mat3 nastran_bar_axes(const Vec3& along, const Vec3& v);
/// The same; false with an error of the bar where there is no direction.
bool find_nastran_bar_axes(NastranBuild& build, const NastranEntity& bar, const Vec3& along,
                           const Vec3& v, Mat3& T);
/// Orientation and ends of bars. `finish` ties the ends to their nodes.
class NastranBars {
 public:
  explicit NastranBars(NastranBuild& build) : b_(build) {}
  /// The element has its nodes, and is a rod if it does not bend; `turn`: of the principal axes of
  /// its section; `bends`: across both axes.
  bool place(const NastranElement& e, double turn, bool bends, FeElement& element);
  void finish();

 private:
  struct Tie {
    int fresh = -1, node = -1;
    Vec3 arm = Vec3::Zero();
    Mat3 axes = Mat3::Identity();
    unsigned mask = 63u;  ///< tied components, in the axes
    FeSource at;
  };
  void tie(const Tie& t, bool rotates);
  NastranBuild& b_;
  std::vector<Tie> ties_;
  std::map<std::array<double, 4>, int> offset_nodes_;
  std::vector<BeamOnNodes> bars_;  ///< that are no rods
  std::map<int, int> spiders_;
};
/// RBE1, RBAR and RTRPLT whose independent components are of several nodes, RROD.
void build_nastran_rigids(NastranBuild& build);
void give_nastran_rigid_rotations(NastranBuild& build);
/// An RBE3 that is no mean spider of displacements; after all other constraints.
void build_nastran_mean(NastranBuild& build, const NastranSpider& s);
/// Adds the part of a node's displacement (`first` 0) or rotation (3) along an axis.
void add_nastran_direction(LinearEquation& equation, int node, int first, const Vec3& axis,
                           double factor);
/// Adds a term of an MPC in basic axes and returns its node; an error and -1 if it has none.
int add_nastran_term(NastranBuild& build, const NastranEquation& e,
                     const NastranEquation::Term& term, LinearEquation& equation);
void build_nastran_constraints(NastranBuild& build);
void build_nastran_supports(NastranBuild& build);
/// The set selected by the case control, or those joined by an ADD card of its number; an error
/// if it selects two, or if a joined one is not `there`. `what`: MPC, SPC.
std::set<int> selected_nastran_sets(NastranBuild& build,
                                    const std::vector<std::pair<int, FeSource>>& selected,
                                    const std::map<int, std::vector<int>>& added,
                                    const std::set<int>& there, const char* what);
void build_nastran_sets(NastranBuild& build, bool only_nodes);

/// Numbers with their index, to look up ranges.
class NastranNumbers {
 public:
  explicit NastranNumbers(std::vector<std::pair<int, int>> number_and_index);
  /// Appends the indices from `first` to `last`; false if there are none.
  bool append(int first, int last, std::vector<int>& indices) const;

 private:
  std::vector<std::pair<int, int>> sorted_;
};

}  // namespace floatframe
