#pragma once
// Scalar points of Nastran bulk data (SPOINT, or named by CELAS3 and CELAS4): one degree of freedom
// without a place. In the model each that a spring or an equation uses is a node of its own, of
// which the component ux is used, or rx where its springs turn. Springs condense it
// (fe/springs.hpp), or it depends on nodes by an equation; its place only says where it is shown.
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

struct NastranBuild;

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

}  // namespace floatframe
