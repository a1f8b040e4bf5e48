#pragma once
// Sentences about entities of a model, equal ones merged: "body 'a' (and 3 more): ...".
#include <string>
#include <vector>

#include "floatframe/description/description.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

class HintList {
 public:
  /// `kind`: "body"; `sentence` continues after the name.
  void add(const std::string& kind, const std::string& name, std::string sentence);
  std::vector<std::string> texts() const;

 private:
  struct Hint {
    std::string subject, kind, sentence;
    int others = 0;
  };
  std::vector<Hint> hints_;
};

/// Numbers of bars outside of the range of any material, section or position: wrong units.
void hint_at_units(const ModelDescription& description, HintList& out);
/// Formulas of what is known only at the end of a step, or with corners and jumps. `located`:
/// steps end where that is possible.
void hint_at_formulas(const Model& model, bool located, HintList& out);
/// Paths along bodies of bars that sag less below a load than their bars do.
void hint_at_paths(const ModelDescription& description, const Model& model, HintList& out);
/// Points of a rigid body of a vehicle so far apart that they may be in mm.
void hint_at_points(const Model& model, HintList& out);
/// What of an OpenCRG file has no effect.
void hint_at_roads(const Model& model, HintList& out);
/// Cams whose lift has corners or nearly fills a turn, curves with corners, that cross themselves
/// or that their point is not drawn on.
void hint_at_curves(const Model& model, HintList& out);
/// The bending stiffnesses of the bars of all flexible bodies.
std::vector<BarBending> bar_bending(const ModelDescription& description, const Model& model);

}  // namespace floatframe
