#pragma once
// Number of modes that each flexible body needs for a frequency range, as text and JSON: the output
// of `advise --below`.
#include "floatframe/advice/model_order.hpp"
#include "floatframe/analyses/analysis.hpp"

namespace floatframe {

AnalysisReport report_model_order(const Model& model, const ModelOrderOptions& options);

}  // namespace floatframe
