#pragma once
// Lists of names and values, and tables, as pages of the viewer take them.
#include <nlohmann/json_fwd.hpp>

#include "floatframe/report/run_report.hpp"

namespace floatframe {

nlohmann::ordered_json facts_json(const std::vector<FactTable>& facts);
nlohmann::ordered_json tables_json(const std::vector<PageTable>& tables);

}  // namespace floatframe
