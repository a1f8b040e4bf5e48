// Models as linear systems: matrices, modes, responses.
#include <array>

#include "results.hpp"

namespace floatframe::python {
namespace {

void bind_linearization(nb::module_& m) {
  nb::class_<Linearization> c(m, "Linearization",
                              "M xddot + C xdot + K x + J^T dlambda = -r, J x = 0, near a state.");
  array(c, "M", &Linearization::M, "Mass, shape (nv, nv).");
  array(c, "C", &Linearization::C, "Damping and gyroscopic terms, shape (nv, nv).");
  array(c, "K", &Linearization::K, "Stiffness, shape (nv, nv).");
  array(c, "J", &Linearization::J, "Constraint Jacobian, shape (nc, nv).");
  array(c, "r", &Linearization::r, "Unbalanced forces, shape (nv,).");
  value(c, "coordinates", &Linearization::coordinates, "nv words: \"joint 'crank'\".");
  value(c, "constraints", &Linearization::constraints, "nc words: \"joint 'guide'\".");
  value(c, "state", &Linearization::state, "Where.");
  value(c, "start", &Linearization::start, "Report on the start values.");
  value(c, "stiffened", &Linearization::stiffened,
        "Bodies with geometric stiffening included by default.");
  m.def("linearize", [](const Model& model, const Keywords& given) {
    const SimulationOptions options = options_of(given);
    Unlocked released;
    return linearize(model, options);
  });
}

void bind_system(nb::module_& m) {
  nb::class_<LinearSystem> c(m, "LinearSystem", "zdot = A z, one z per degree of freedom.");
  array(c, "A", &LinearSystem::A, "Shape (nz, nz) [1/s].");
  array(c, "x_of", &LinearSystem::x_of, "Increments of the coordinates of z, shape (nv, nz).");
  array(c, "v_of", &LinearSystem::v_of, "Their velocities, shape (nv, nz).");
  array(c, "a_of", &LinearSystem::a_of, "Their accelerations, shape (nv, nz).");
  value(c, "states", &LinearSystem::states, "nz words: \"rate of joint 'crank'\".");
  value(c, "degrees", &LinearSystem::degrees, "Of freedom.");
  value(c, "massless", &LinearSystem::massless, "Of these.");
  value(c, "notes", &LinearSystem::notes, "Limits of validity.");
  value(c, "stiffened", &LinearSystem::stiffened,
        "Bodies with geometric stiffening included by default.");
  m.def("linear_system", [](const Model& model, const Keywords& given) {
    const SimulationOptions options = options_of(given);
    Unlocked released;
    return linear_system(model, options);
  });
}

/// A mode with its participating bodies.
struct Mode {
  LinearMode mode;
  ModeParts parts;
  std::vector<std::string> bodies, forces;
};

Numbers shares(const std::vector<std::string>& names, const std::vector<double>& parts) {
  nb::dict d;
  for (std::size_t k = 0; k < std::min(names.size(), parts.size()); ++k)
    d[names[k].c_str()] = parts[k];
  return d;
}

std::vector<Mode> modes_of(const Model& model, int number, const Keywords& given) {
  const SimulationOptions options = options_of(given);
  Unlocked released;
  const LinearSystem system = linear_system(model, options, number);
  std::vector<std::string> bodies, forces;
  for (const Body& b : model.bodies) bodies.push_back(b.name);
  for (const Element& f : model.elements)
    if (f.acts) forces.push_back(f.name);
  std::vector<Mode> modes;
  for (LinearMode& mode : linear_modes(system)) {
    if (number > 0 && std::ssize(modes) == number) break;
    ModeParts parts = mode_parts(model, system, mode);
    modes.push_back({std::move(mode), std::move(parts), bodies, forces});
  }
  return modes;
}

void bind_modes(nb::module_& m) {
  nb::class_<Mode>(m, "Mode", "One motion e^(eigenvalue t) of a linear system.")
      .def_prop_ro(
          "eigenvalue", [](const Mode& x) { return x.mode.lambda; },
          "[1/s]; of a pair the one with Im > 0.")
      .def_prop_ro(
          "frequency", [](const Mode& x) { return x.mode.frequency(); }, "Undamped [Hz].")
      .def_prop_ro(
          "damped", [](const Mode& x) { return x.mode.damped(); }, "Damped frequency [Hz].")
      .def_prop_ro(
          "damping", [](const Mode& x) { return x.mode.damping(); }, "Ratio; 1: critical.")
      .def_prop_ro(
          "z",
          [](const nb::handle self) { return view_of(nb::cast<const Mode&>(self).mode.z, self); },
          nb::rv_policy::reference, "In the states of the system, |z| = 1, shape (nz,).")
      .def_prop_ro(
          "kinetic", [](const Mode& x) { return shares(x.bodies, x.parts.kinetic); },
          "Share of each body in the kinetic energy.")
      .def_prop_ro(
          "bending", [](const Mode& x) { return shares(x.bodies, x.parts.bending); },
          "Share of each body in the potential energy.")
      .def_prop_ro(
          "springs", [](const Mode& x) { return shares(x.forces, x.parts.springs); },
          "Share of each force element in the potential energy.")
      .def("__repr__", [](const Mode& x) {
        return "<floatframe.Mode " + std::to_string(x.mode.damped()) + " Hz, damping " +
               std::to_string(x.mode.damping()) + ">";
      });
  m.def("modes", modes_of);
}

std::vector<std::string> names_of(const std::vector<LinearInput>& inputs) {
  std::vector<std::string> names;
  for (const LinearInput& i : inputs) names.push_back(i.name);
  return names;
}
std::vector<std::string> names_of(const std::vector<Column>& columns) {
  std::vector<std::string> names;
  for (const Column& c : columns) names.push_back(c.name);
  return names;
}

/// A list of floatframe.states.StateName.
StateNames names_of(const std::vector<StateName>& states) {
  const nb::object type = nb::module_::import_("floatframe.states").attr("StateName");
  nb::list list;
  for (const StateName& s : states)
    list.append(type(state_kind_name(s.kind), s.name, s.index, s.rate));
  return nb::borrow<StateNames>(list);
}

using Frequencies = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

std::vector<double> finite(const Frequencies& given) {
  std::vector<double> list(given.data(), given.data() + given.size());
  for (const double f : list)
    if (!std::isfinite(f))
      throw InputError(ErrorCode::not_finite, "frequencies: found a number that is not finite");
  return list;
}

/// G at each frequency, shape (frequencies, outputs, inputs).
ComplexArray response(const LinearModel& linear, const Frequencies& given) {
  const std::vector<double> frequencies = finite(given);
  const std::size_t ny = linear.outputs.size(), nu = linear.inputs.size();
  auto kept = std::make_unique<std::complex<double>[]>(frequencies.size() * ny * nu);
  std::complex<double>* g = kept.get();
  {
    Unlocked released;
    const FrequencyResponse of(linear);
    for (std::size_t k = 0; k < frequencies.size(); ++k) {
      const Eigen::MatrixXcd at = of.at_frequency(frequencies[k]);
      for (std::size_t i = 0; i < ny; ++i)
        for (std::size_t j = 0; j < nu; ++j)
          g[(k * ny + i) * nu + j] = at(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
  nb::capsule owner(g, [](void* p) noexcept { delete[] static_cast<std::complex<double>*>(p); });
  kept.release();
  return nb::borrow<ComplexArray>(
      nb::cast(nb::ndarray<nb::numpy, std::complex<double>, nb::ndim<3>>(
          g, {frequencies.size(), ny, nu}, owner)));
}

void bind_ports(nb::module_& m) {
  nb::class_<StateSpace> space(m, "StateSpace", "zdot = A z + B u, y = C z + D u, in changes.");
  array(space, "A", &StateSpace::A, "Shape (nz, nz).");
  array(space, "B", &StateSpace::B, "Shape (nz, inputs).");
  array(space, "C", &StateSpace::C, "Shape (outputs, nz).");
  array(space, "D", &StateSpace::D, "Shape (outputs, inputs).");
  value(space, "states", &StateSpace::states, "nz words.");
  space.def_prop_ro("inputs", [](const StateSpace& s) { return names_of(s.inputs); });
  space.def_prop_ro("outputs", [](const StateSpace& s) { return names_of(s.outputs); });
  nb::class_<LinearModel> c(m, "LinearModel", "A linear system between inputs and outputs.");
  value(c, "system", &LinearModel::system, "");
  c.def_prop_ro("inputs", [](const LinearModel& l) { return names_of(l.inputs); });
  c.def_prop_ro("outputs", [](const LinearModel& l) { return names_of(l.outputs); });
  c.def_prop_ro(
      "A", [](const LinearModel& l) { return array_of(state_space(l).A); },
      "Of state_space(), shape (nz, nz).");
  c.def_prop_ro(
      "B", [](const LinearModel& l) { return array_of(state_space(l).B); }, "Shape (nz, inputs).");
  c.def_prop_ro(
      "C", [](const LinearModel& l) { return array_of(state_space(l).C); }, "Shape (outputs, nz).");
  c.def_prop_ro(
      "D", [](const LinearModel& l) { return array_of(state_space(l).D); },
      "Shape (outputs, inputs).");
  c.def_prop_ro(
      "states", [](const LinearModel& l) { return names_of(state_space(l).names); },
      "The states z by their names, in the order of A.");
  c.def_prop_ro(
      "state", [](const LinearModel& l) { return *l.state; }, "Where it was linearised.");
  c.def_prop_ro(
      "notes", [](const LinearModel& l) { return l.system.notes; }, "Limits of validity.");
  c.def(
      "__iter__",
      [](const LinearModel& l) {
        const StateSpace s = state_space(l);
        return nb::iter(nb::make_tuple(array_of(s.A), array_of(s.B), array_of(s.C), array_of(s.D)));
      },
      nb::sig(
          "def __iter__(self) -> collections.abc.Iterator[numpy.typing.NDArray[numpy.float64]]"),
      "A, B, C, D, as control.ss takes them.");
  value(c, "time", &LinearModel::time, "Where it was linearised [s].");
  array(c, "input_values", &LinearModel::input_values, "Inputs there, shape (inputs,).");
  array(c, "output_values", &LinearModel::output_values, "Outputs there, shape (outputs,).");
  c.def("state_space", &state_space, "A, B, C, D; inputs that enter by derivatives as states.");
  c.def("response", response, nb::arg("frequencies"),
        "G at frequencies [Hz] of shape (n,), shape (n, outputs, inputs), complex.");
  m.def("linear_inputs", [](const Model& model) { return names_of(linear_inputs(model)); });
  m.def("linear_model", [](const Model& model, const std::vector<std::string>& inputs,
                           const std::vector<std::string>& outputs, const Keywords& given) {
    const SimulationOptions options = options_of(given);
    Unlocked released;
    return linear_model(model, {inputs, outputs}, options);
  });
}

void bind_road_response(nb::module_& m) {
  nb::class_<OutputSpectrum> spectrum(m, "OutputSpectrum", "An output on a random road.");
  spectrum.def_prop_ro("name", [](const OutputSpectrum& s) { return s.output.name; });
  spectrum.def_prop_ro("unit", [](const OutputSpectrum& s) { return s.output.unit; });
  numbers(spectrum, "density", &OutputSpectrum::density, "One-sided [unit^2/Hz].");
  value(spectrum, "rms", &OutputSpectrum::rms, "In the band, about the mean.");
  nb::class_<RoadResponse> c(m, "RoadResponse", "Response of a model to a random road.");
  numbers(c, "frequencies", &RoadResponse::frequencies, "[Hz]");
  value(c, "outputs", &RoadResponse::outputs, "");
  value(c, "road", &RoadResponse::road, "Effective height in the band [m].");
  value(c, "notes", &RoadResponse::notes, "");
  m.def("road_response",
        [](const Model& model, const std::vector<std::string>& outputs, const Frequencies& given,
           double speed, double roughness, double waviness, const std::array<double, 2>& band,
           const Keywords& options_given) {
          const std::vector<double> frequencies = finite(given);
          const SimulationOptions options = options_of(options_given);
          Unlocked released;
          return road_response(model, outputs, frequencies,
                               {roughness, waviness, speed, band[0], band[1]}, options);
        });
}

}  // namespace

void bind_linear(nb::module_& m) {
  bind_linearization(m);
  bind_system(m);
  bind_modes(m);
  bind_ports(m);
  bind_road_response(m);
}

}  // namespace floatframe::python
