#pragma once
// From a body's description (bars, sections, interfaces) to its reduced FlexibleBody: finite
// elements, reduction, mirroring. Bodies with equal descriptions in their own template frame are
// reduced once.
#include <memory>
#include <vector>

#include "floatframe/fe/fe_model.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

/// In the local axes of a bar.
BeamSection bar_section(const SectionDescription& section);

/// The finite elements of a body of bars, as it was before it is mirrored. Throws InputError.
FeModel bar_model(const BodyDescription& body);

class FlexibleBuilder {
 public:
  /// Adds errors (with the entity's marks) and returns null if the body cannot be built.
  /// `stiffens`: with geometric stiffening.
  std::shared_ptr<const FlexibleBody> build(const BodyDescription& body, bool stiffens,
                                            ErrorList& errors);
  std::size_t reduced() const noexcept { return known_.size(); }

 private:
  struct Known {
    std::string key;  ///< all numbers that decide the reduction
    std::shared_ptr<const FlexibleBody> body;
  };
  std::vector<Known> known_;
};

/// As `build_model` of one description (model.hpp): bodies that `flexible` has already reduced are
/// not reduced again.
Model build_model(const ModelDescription& description, FlexibleBuilder& flexible);

}  // namespace floatframe
