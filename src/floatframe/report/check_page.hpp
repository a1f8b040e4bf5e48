#pragma once
// The page of a model before it is run, for the viewer (viewer/README.md): its bodies, joints, axes
// and forces in the configuration that a run starts from.
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/model/system_state.hpp"
#include "floatframe/report/report_html.hpp"

namespace floatframe {

/// `start`: where a run of the model begins. Needs a program that was built with the viewer.
std::string check_page(const Model& model, const SystemState& start,
                       const std::vector<std::string>& notes, const std::vector<FactTable>& facts);

/// Why there is no page, in a sentence, of a program that was built without the viewer.
std::string page_is_missing(const std::string& option);

}  // namespace floatframe
