#pragma once
// Scalar points of Nastran bulk data (SPOINT, or named by CELAS3 and CELAS4): one degree of freedom
// without a place. In the model each that a spring or an equation uses is a node of its own, of
// which the component ux is used, or rx where its springs turn. Springs condense it
// (fe/springs.hpp), or it depends on nodes by an equation; its place only says where it is shown.
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// Numbers as ranges: a few bytes can name very many.
class NastranRanges {
 public:
  void add(int first, int last) { ranges_.emplace_back(first, last); }
  /// Sorts and joins; before any question.
  void finish();
  bool contains(int id) const { return overlaps(id, id); }
  bool overlaps(int first, int last) const;

 private:
  std::vector<std::pair<int, int>> ranges_;
};

/// CMASS3, CMASS4, and CMASS1, CMASS2 without components.
struct NastranScalarMass {
  const char* card = "";
  int id = 0, property = 0;
  std::array<int, 2> points{};  ///< 0: the ground
  double mass = 1.0;            ///< CMASS1, CMASS3: times that of the property
  FeSource at;
};

struct NastranContent;
struct NastranBuild;
class NastranFields;
struct NastranEquation;
void read_nastran_scalar_points(NastranFields&, NastranContent&);   ///< SPOINT
void read_nastran_scalar_spring(NastranFields&, NastranContent&);   ///< CELAS3, CELAS4
void read_nastran_mass_of_points(NastranFields&, NastranContent&);  ///< CMASS3, CMASS4

/// Where a scalar point is in the model.
struct NastranScalarPoint {
  int node = -1;
  int axis = 0;         ///< 0, or 3 if its springs turn
  bool sprung = false;  ///< a spring ends there
};

/// The scalar points that springs and equations use, by their numbers.
class NastranScalarPoints {
 public:
  void build(NastranBuild& build);
  /// Null if the number is none that is in use.
  const NastranScalarPoint* find(int id) const;
  /// An SPC holds it: it is the ground.
  bool held(int id) const { return held_.contains(id); }

 private:
  std::map<int, NastranScalarPoint> points_;
  NastranRanges held_;
};

/// Equations with scalar points. Each is solved for one of them; what is left without any is an
/// equation of nodes.
void build_nastran_scalar_equations(NastranBuild& build,
                                    const std::vector<const NastranEquation*>& equations);
/// Masses of scalar points are errors, but of those that are held.
void check_nastran_scalar_masses(NastranBuild& build);

}  // namespace floatframe
