#pragma once
// The page of a run for the viewer (viewer/README.md): how it ended, warnings, curves, accuracy,
// facts and cost.
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/page/page_curves.hpp"
#include "floatframe/page/run_report.hpp"

namespace floatframe {

/// The subjects of the result columns, in the order of the outputs.
std::vector<ChannelSubject> channel_subjects(const Model& model);

/// Adds the content of the states to the page of a run: scene and trust curves. Throws InputError.
void add_states(nlohmann::ordered_json& page, const Model& model, const std::string& states_file,
                const SimulationDescription* options, PageBuffer& buffer);

/// Adds the facts and the tables of the model.
void describe_model(const Model& model, Report& report);
/// `settings` of parameters: "name=value".
FactTable setting_facts(const std::string& model_file, const std::vector<std::string>& settings,
                        const SimulationDescription& simulation);

nlohmann::ordered_json run_page(const Report& report, const PageCurves& curves, PageBuffer& buffer);

}  // namespace floatframe
