#pragma once
// What the report of a run says of its model and its settings.
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/report/run_report.hpp"

namespace floatframe {

/// Adds the facts and the tables of the model.
void describe_model(const Model& model, Report& report);

/// `settings` of parameters: "name=value".
FactTable setting_facts(const std::string& model_file, const std::vector<std::string>& settings,
                        const SimulationDescription& simulation);

}  // namespace floatframe
