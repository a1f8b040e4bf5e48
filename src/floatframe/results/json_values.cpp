#include "floatframe/results/json_values.hpp"

#include <nlohmann/json.hpp>

namespace floatframe {

using Json = nlohmann::ordered_json;

std::string json_document(const Json& value) {
  return value.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json json_array(const VecX& v) {
  Json array = Json::array();
  for (Eigen::Index i = 0; i < v.size(); ++i) array.push_back(v[i]);
  return array;
}

Json json_rows(const MatX& m) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < m.rows(); ++i) rows.push_back(json_array(m.row(i).transpose()));
  return rows;
}

Json redundancy_json(const std::vector<RedundantDirection>& redundant) {
  Json array = Json::array();
  for (const RedundantDirection& r : redundant)
    array.push_back({{"constraint", r.owner}, {"direction", r.direction}});
  return array;
}

Json start_json(const StartReport& start) {
  Json changes = Json::array();
  for (const StartChange& c : start.changes)
    changes.push_back({{"owner", c.owner},
                       {"quantity", c.quantity},
                       {"rate", c.rate},
                       {"unit", c.unit},
                       {"given", c.given},
                       {"used", c.used}});
  return {{"notes", start.notes},
          {"changes", changes},
          {"redundant", redundancy_json(start.redundant)}};
}

}  // namespace floatframe
