#pragma once
// Parts common to all pages of the viewer (viewer/README.md): head, lists of names and values,
// tables.
#include <nlohmann/json_fwd.hpp>

#include "floatframe/page/run_report.hpp"

namespace floatframe {

/// A page of a kind with its head and status only. Pages of runs have a subtitle.
nlohmann::ordered_json empty_page(const char* kind, const std::string& title,
                                  const std::string& software, nlohmann::ordered_json status,
                                  const std::string& subtitle = "");

nlohmann::ordered_json facts_json(const std::vector<FactTable>& facts);
nlohmann::ordered_json tables_json(const std::vector<PageTable>& tables);

}  // namespace floatframe
