#include "floatframe/page/page_json.hpp"

#include <nlohmann/json.hpp>

namespace floatframe {

using Json = nlohmann::ordered_json;

Json empty_page(const char* kind, const std::string& title, const std::string& software,
                Json status, const std::string& subtitle) {
  Json page{{"schema", 1}, {"kind", kind}, {"title", title}, {"program", "Floatframe " + software}};
  if (!subtitle.empty()) page["subtitle"] = subtitle;
  page["status"] = std::move(status);
  page["facts"] = page["tables"] = Json::array();
  for (const char* key : {"curves", "trust", "speed", "scene"}) page[key] = nullptr;
  return page;
}

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
