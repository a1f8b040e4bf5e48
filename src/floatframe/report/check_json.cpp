#include "floatframe/report/check_json.hpp"

#include <nlohmann/json.hpp>

#include "floatframe/report/summary_json.hpp"

namespace floatframe {

std::string check_json(const ModelCounts& counts, const Model& model) {
  using Json = nlohmann::ordered_json;
  Json json = Json::parse(counts_json(counts));
  Json& list = json["flexible"] = Json::array();
  for (const Body& body : model.bodies) {
    if (body.modes() == 0) continue;
    Json frequencies = Json::array();
    for (const double f : body.data->fixed_interface_frequencies) frequencies.push_back(f);
    list.push_back({{"name", body.name},
                    {"modes", body.modes()},
                    {"mass_kg", body.data->invariants.m},
                    {"nodes", body.data->nodes.size()},
                    {"mode_names", body.data->mode_names},
                    {"frequencies_Hz", frequencies}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace floatframe
