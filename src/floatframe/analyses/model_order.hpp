#pragma once
// How many modes each flexible body needs for a frequency range, as text and JSON: what
// `advise --below` prints.
#include "floatframe/analyses/analysis.hpp"
#include "floatframe/simulation/model_order.hpp"

namespace floatframe {

AnalysisReport report_model_order(const Model& model, const ModelOrderOptions& options);

}  // namespace floatframe
