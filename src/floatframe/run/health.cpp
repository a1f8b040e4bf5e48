#include "floatframe/run/health.hpp"

namespace floatframe {

std::vector<HealthColumn> health_columns(const Model& model, const RangeWatch& range) {
  std::vector<HealthColumn> out{{"position_violation", "m", "constraints"},
                                {"velocity_violation", "m/s", "constraints"},
                                {"steps", "", "effort"},
                                {"substeps", "", "effort"},
                                {"iterations", "", "effort"},
                                {"factorizations", "", "effort"}};
  for (const char* name : {"kinetic", "gravity", "springs", "tyres", "elastic"})
    out.push_back({name, "J", "energy"});
  for (const char* flow : energy_flow_names)
    out.push_back({std::string("work_of_") + flow, "J", "energy"});
  out.push_back({"remainder", "J", "energy"});
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Body& body = model.bodies[i];
    if (body.modes() == 0) continue;
    const double size = range.bodies()[i].size();
    out.push_back({body.name + ".displacement", "m", "range", body.name, size});
    out.push_back({body.name + ".largest_mode", "m", "range", body.name, size});
  }
  return out;
}

}  // namespace floatframe
