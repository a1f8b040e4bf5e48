#pragma once
// The page of a run for the viewer (viewer/README.md): how it ended, warnings, curves, whether it
// can be trusted, facts and cost.
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/report/page_curves.hpp"
#include "floatframe/report/run_report.hpp"

namespace floatframe {

/// What the columns of results show, in the order of the outputs.
std::vector<ChannelSubject> channel_subjects(const Model& model);

nlohmann::ordered_json run_page(const Report& report, const PageCurves& curves, PageBuffer& buffer);

}  // namespace floatframe
