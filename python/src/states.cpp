// States: those from which a simulation continues bit for bit (bytes), and those by the names of
// joints and bodies (JSON).
#include "bindings.hpp"

namespace floatframe::python {
namespace {

nb::bytes bytes_of(const SimulationState& state) {
  const std::vector<std::byte> bytes = state.to_bytes();
  return nb::bytes(bytes.data(), bytes.size());
}

SimulationState from_bytes(const nb::object& given) {
  if (!nb::isinstance<nb::bytes>(given))
    throw InputError(ErrorCode::wrong_value,
                     "data: found " + type_of(given) + ", expected bytes of a saved state");
  const auto bytes = nb::borrow<nb::bytes>(given);
  return SimulationState::from_bytes(
      {reinterpret_cast<const std::byte*>(bytes.c_str()), bytes.size()});
}

RealArray array3(const Vec3& v) { return array_of(VecX(v)); }

Arrays body(const SystemState::Body& b) {
  nb::dict d;
  d["position"] = array3(b.position);
  d["orientation"] = array_of(VecX(b.orientation));
  d["velocity"] = array3(b.velocity);
  d["angular_velocity"] = array3(b.angular_velocity);
  d["amplitudes"] = array_of(b.amplitudes);
  d["amplitude_rates"] = array_of(b.amplitude_rates);
  return d;
}

ArraysByName bodies(const SystemState& s) {
  nb::dict d;
  for (const auto& b : s.bodies) d[b.name.c_str()] = body(b);
  return d;
}

ArraysByName joints(const SystemState& s) {
  nb::dict d;
  for (const auto& j : s.joints) {
    nb::dict values;
    values["position"] = array_of(j.position);
    values["velocity"] = array_of(j.velocity);
    d[j.name.c_str()] = values;
  }
  return d;
}

ArraysByName elements(const SystemState& s) {
  nb::dict d;
  for (const auto& e : s.elements) {
    nb::dict values;
    values["states"] = array_of(e.states);
    d[e.name.c_str()] = values;
  }
  return d;
}

}  // namespace

void bind_states(nb::module_& m) {
  nb::class_<SimulationState>(
      m, "SimulationState",
      "Complete state for the next steps of a simulation, bit for bit. May be pickled and copied.")
      .def_prop_ro("time", &SimulationState::time, "[s]")
      .def("to_bytes", bytes_of)
      .def_static("from_bytes", from_bytes, nb::arg("data"),
                  nb::sig("def from_bytes(data: bytes) -> SimulationState"))
      .def("__getstate__", bytes_of)
      .def("__setstate__", [](SimulationState& self, const nb::object& data) {
        new (&self) SimulationState(from_bytes(data));
      });
  nb::class_<SystemState>(
      m, "State",
      "State of a model at one instant, by the names of its joints and bodies. Runs in either "
      "coordinates start from it (`start=`), not with the same bits.")
      .def_static(
          "load", [](const nb::object& file) { return read_state(path("path", file)); },
          nb::sig("def load(path: str | os.PathLike[str]) -> State"), nb::arg("path"),
          "A file of `floatframe run --write-state`, or of `to_json`.")
      .def("to_json", [](const SystemState& s) { return state_json(s); })
      .def(
          "__reduce__",
          [](const SystemState& s) {
            return nb::make_tuple(nb::module_::import_("floatframe.run").attr("state_again"),
                                  nb::make_tuple(state_json(s)));
          },
          nb::sig("def __reduce__(self) -> tuple[object, tuple[str]]"))
      .def("__copy__", [](const SystemState& s) { return s; })
      .def("__deepcopy__", [](const SystemState& s, const nb::object&) { return s; })
      .def_ro("time", &SystemState::time, "[s]")
      .def_ro("model", &SystemState::model, "Name of the model it belongs to.")
      .def_prop_ro(
          "joints", joints,
          "By joint: `position` and `velocity` of its coordinates [m] or [rad], as in model files.")
      .def_prop_ro("elements", elements, "By element: its `states`; only of those that have some.")
      .def_prop_ro("bodies", bodies,
                   "By body: `position` of its origin (3,) [m], `orientation` (4,) as a quaternion "
                   "(w, x, y, z), `velocity` (3,) [m/s], `angular_velocity` (3,) [rad/s], all in "
                   "world axes; `amplitudes`, `amplitude_rates` (modes,).");
}

}  // namespace floatframe::python
