#include "floatframe/report/page_json.hpp"

#include <nlohmann/json.hpp>

namespace floatframe {

using Json = nlohmann::ordered_json;

Json facts_json(const std::vector<FactTable>& facts) {
  Json out = Json::array();
  for (const FactTable& table : facts) {
    Json rows = Json::array();
    for (const auto& row : table.rows) rows.push_back({row[0], row[1]});
    out.push_back({{"heading", table.title}, {"rows", std::move(rows)}});
  }
  return out;
}

Json tables_json(const std::vector<PageTable>& tables) {
  Json out = Json::array();
  for (const PageTable& t : tables)
    out.push_back({{"heading", t.heading},
                   {"columns", t.columns},
                   {"rows", t.rows},
                   {"note", t.note.empty() ? Json() : Json(t.note)}});
  return out;
}

}  // namespace floatframe
