#pragma once
// Sentences about entities of a model, the same one said once: "body 'a' (and 3 more): ...".
#include <string>
#include <vector>

#include "floatframe/model/description.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

class HintList {
 public:
  /// `kind`: "body"; `sentence` goes on after the name.
  void add(const std::string& kind, const std::string& name, std::string sentence);
  std::vector<std::string> texts() const;

 private:
  struct Hint {
    std::string subject, kind, sentence;
    int others = 0;
  };
  std::vector<Hint> hints_;
};

/// Numbers of bars that no material, section or place has: other units.
void hint_at_units(const ModelDescription& description, HintList& out);
/// How the bars of all bodies that bend are stiff.
std::vector<BarBending> bar_bending(const ModelDescription& description, const Model& model);

}  // namespace floatframe
