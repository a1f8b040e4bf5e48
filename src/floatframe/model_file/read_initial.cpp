// Initial modal amplitudes and their rates.
#include "floatframe/model/sentences.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {
namespace {

void read_amplitudes(const ModelInstance& self, ReadModel& model, const YamlValue& value,
                     const char* key, std::map<std::string, VecX>& out) {
  for (const auto& [name, v] : value.named("a map of bodies to lists of modal amplitudes", true)) {
    const auto body = self.moving_body(name, v);
    if (!body) continue;
    const auto it = model.bodies.find(*body);
    if (it == model.bodies.end() || !it->second.valid) continue;
    if (!it->second.flexible) {
      v.entity_error(ErrorCode::wrong_value,
                     sentences::rigid_body_has_no_modes(!it->second.named_nodes.empty()));
      continue;
    }
    const int n = it->second.modes;
    const std::size_t most = n < 0 ? 10000 : n;
    const std::string what = "a list of " + std::to_string(n) + " amplitudes, one per mode";
    const auto a = v.numbers(n < 0 ? 1 : most, most, any_number(""),
                             n < 0 ? "a list of amplitudes" : what.c_str());
    if (!a) continue;
    out[*body] = Eigen::Map<const VecX>(a->data(), static_cast<Eigen::Index>(a->size()));
    // With normal modes below a frequency their number is known only when the body is reduced.
    model.description.bodies[it->second.index].origin.keys[key] = v.mark();
  }
}

}  // namespace

void read_initial(const ModelInstance& self, ReadModel& model) {
  if (!self.root) return;
  YamlSection root = *self.root;
  const auto value = root.get("initial");
  if (!value) return;
  auto s = value->section("a map with amplitudes and amplitude_rates");
  if (!s) return;
  if (const auto v = s->get("amplitudes"))
    read_amplitudes(self, model, *v, "initial.amplitudes", model.description.amplitudes);
  if (const auto v = s->get("amplitude_rates"))
    read_amplitudes(self, model, *v, "initial.amplitude_rates", model.description.amplitude_rates);
  s->finish();
}

}  // namespace floatframe
