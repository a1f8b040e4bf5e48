// Start and options of a run: `simulation` and `initial`.
#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/description/simulation_option.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/model_file/read_parts.hpp"
#include "floatframe/model_file/state_json.hpp"

namespace floatframe {
namespace {

/// {chassis: [0, 0, 0.05]}: translation [m], or translation and rotation vector [m, rad].
void read_offset(const ModelInstance& self, const YamlValue& value, SimulationDescription& d) {
  for (const auto& [name, v] : value.named("a map of bodies to offsets [x, y, z]", true)) {
    const auto body = self.moving_body(name, v);
    if (!body) continue;
    const char* what = "[x, y, z] [m], or [x, y, z, rx, ry, rz] with a rotation vector [m, rad]";
    if (v.is_list() && v.node().items.size() != 3 && v.node().items.size() != 6) {
      v.unexpected(what);
      continue;
    }
    const auto x = v.numbers(3, 6, any_number(""), what);
    if (!x) continue;
    StartOffset offset;
    offset.translation = Vec3((*x)[0], (*x)[1], (*x)[2]);
    if (x->size() == 6) offset.rotation = Vec3((*x)[3], (*x)[4], (*x)[5]);
    d.offset[*body] = offset;
  }
}

/// given, equilibrium, {equilibrium: true, offset: ...} or {state: file, offset: ...}
void read_start(const ModelInstance& self, const YamlValue& value, SimulationDescription& d) {
  if (!value.is_map()) {
    if (const auto w = value.word({"given", "equilibrium"})) d.start = static_cast<Start>(*w);
    return;
  }
  auto s = value.section();
  const auto equilibrium = s->get("equilibrium"), state = s->get("state");
  const auto offset = s->get("offset");
  if (offset) d.origin.keys.emplace("offset", offset->mark());
  s->finish();
  if (equilibrium && state) {
    state->error(ErrorCode::exclusive, "excludes 'equilibrium'; remove one of them");
    return;
  }
  if (!equilibrium && !state && !offset) {
    value.unexpected("given, equilibrium, or a map with equilibrium or state");
    return;
  }
  const auto on = equilibrium ? equilibrium->boolean() : std::nullopt;
  if (on) d.start = *on ? Start::equilibrium : Start::given;
  if (const auto file = state ? state->text("the name of a state file") : std::nullopt) {
    d.start = Start::state;
    try {
      d.state = std::make_shared<const SystemState>(read_state(sibling_path(self, *file)));
    } catch (const InputError& error) {
      for (const ErrorEntry& f : error.errors()) state->error(f.code, f.text(), f.count);
    }
  }
  if (!offset) return;
  if (!state && !on.value_or(false))
    offset->error(ErrorCode::incomplete, sentences::offset_alone());
  read_offset(self, *offset, d);
}

/// none, states, or {states: {every: n, bodies: [...], accelerations: true}}
void read_record(const ModelInstance& self, const YamlValue& value, RecordDescription& d) {
  using States = RecordDescription::States;
  if (!value.is_map()) {
    if (const auto w = value.word(rules::recorded))
      d.states = *w == 0 ? States::none : States::states;
    return;
  }
  auto s = value.section();
  const auto states = s->require("states");
  s->finish();
  auto options = states ? states->section("a map with every, bodies, accelerations") : std::nullopt;
  if (!options) return;
  d.states = States::states;
  if (const auto v = options->get("every")) d.every = v->integer(rules::every).value_or(0);
  if (const auto v = options->get("bodies"))
    for (const YamlValue& item : v->list("a list of bodies"))
      if (const auto name = item.text("the name of a body"))
        if (const auto body = self.moving_body(*name, item)) d.bodies.push_back(*body);
  d.accelerations = options->boolean("accelerations", d.accelerations);
  options->finish();
}

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
    // With a frequency limit for normal modes their number is known only after the reduction.
    model.description.bodies[it->second.index].origin.keys[key] = v.mark();
  }
}

}  // namespace

void read_simulation(const ModelInstance& self, ReadModel& model) {
  if (!self.root) return;
  YamlSection root = *self.root;
  const auto value = root.get("simulation");
  if (!value) return;
  auto section = value->section("a map with step, duration, ...");
  if (!section) return;
  YamlSection& s = *section;
  SimulationDescription& d = model.description.simulation;
  d.origin = s.origin();
  s.word("coordinates", rules::coordinates, d.coordinates);
  s.word("inertia", rules::inertia_methods, d.inertia);
  if (s.has("geometric_stiffening"))
    d.geometric_stiffening = s.boolean("geometric_stiffening", false);
  if (const auto v = s.get("start")) read_start(self, *v, d);
  s.vector("velocity", "m/s", d.velocity);
  if (const auto v = s.get("until")) d.until = read_formula(self, *v);
  for (const SimulationNumber& n : simulation_numbers())
    d.*n.at = s.number(n.name, n.rule, d.*n.at);
  if (const auto v = s.get("max_iterations"))
    d.max_iterations = v->integer(rules::max_iterations).value_or(d.max_iterations);
  d.locate_edges = s.boolean("locate_edges", d.locate_edges);
  s.word("input", rules::input_uses, d.input);
  if (const auto v = s.get("record")) read_record(self, *v, d.record);
  s.finish();
  if (d.start == Start::state && !d.state) return;  // the file could not be read
  validate_entity(s, d.origin, [&](const validation::Entity& group) { validate(d, group.errors); });
}

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
