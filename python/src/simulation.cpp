// Simulations stepped by Python. A simulation belongs to one thread at a time: while it steps,
// without the lock of the interpreter, calls from other threads and from its own callbacks are
// rejected.
#include <thread>
#include <unordered_map>

#include "bindings.hpp"

namespace floatframe::python {
namespace {

using Line = nb::ndarray<nb::numpy, double, nb::ndim<1>>;

/// A force law: the value of an input as a function of the time and of some outputs.
struct Law {
  std::ptrdiff_t input = 0;
  std::vector<std::size_t> outputs;
  nb::object function;
};

struct Stepper {
  Stepper(const Model& model, const SimulationOptions& options) : simulation(model, options) {
    const auto number = [](std::vector<std::string>&& names, auto& index) {
      for (std::size_t k = 0; k < names.size(); ++k) index.emplace(names[k], k);
      return std::move(names);
    };
    input_names = number(simulation.input_names(), input_index);
    output_names = number(simulation.output_names(), output_index);
  }

  Simulation simulation;
  std::vector<std::string> input_names, output_names;
  std::unordered_map<std::string, std::size_t> input_index, output_index;
  std::atomic<bool> busy{false};
  std::thread::id worker;
  nb::object on_step;
  std::vector<Law> laws;
  /// Arguments of on_step: outputs and inputs. Arrays are views of numbers that live as long as the
  /// simulation and the last view, whatever is done to the arrays.
  std::shared_ptr<std::vector<double>> seen_numbers, changed_numbers;
  nb::object seen, changed;
  std::exception_ptr failed;

  /// Throws if the simulation is stepping.
  Simulation& idle() {
    if (!busy) return simulation;
    throw std::runtime_error(
        worker == std::this_thread::get_id()
            ? "the simulation was called by its own callback, which may use its arguments only"
            : "the simulation is stepping in another thread; it belongs to one thread at a time");
  }
};

std::size_t index_in(const std::unordered_map<std::string, std::size_t>& index,
                     const std::vector<std::string>& names, const char* what,
                     const std::string& name) {
  if (const auto it = index.find(name); it != index.end()) return it->second;
  std::string known;
  for (const std::string& n : names) known += (known.empty() ? "" : ", ") + n;
  throw UnknownName(ErrorCode::not_found, "found no " + std::string(what) + " '" + name +
                                              "', expected one of " +
                                              (known.empty() ? "none" : known));
}

std::size_t input_of(const Stepper& s, const nb::handle name) {
  return index_in(s.input_index, s.input_names, "input", text("input", name));
}
std::size_t output_of(const Stepper& s, const nb::handle name) {
  return index_in(s.output_index, s.output_names, "output", text("output", name));
}

using Kept = std::shared_ptr<std::vector<double>>;

nb::object view_of(const Kept& numbers) {
  auto kept = std::make_unique<Kept>(numbers);
  nb::capsule owner(kept.get(), [](void* p) noexcept { delete static_cast<Kept*>(p); });
  kept.release();
  return nb::cast(Line(numbers->data(), {numbers->size()}, owner));
}

/// Replaces the view if the user has modified the array object.
void keep_view(nb::object& array, const Kept& numbers) {
  Line line;
  if (!nb::try_cast(array, line) || line.data() != numbers->data() ||
      line.shape(0) != numbers->size())
    array = view_of(numbers);
}

void call_on_step(Stepper& s, double time, std::span<const double> outputs,
                  std::span<double> inputs) {
  std::copy(outputs.begin(), outputs.end(), s.seen_numbers->begin());
  std::copy(inputs.begin(), inputs.end(), s.changed_numbers->begin());
  keep_view(s.seen, s.seen_numbers);
  keep_view(s.changed, s.changed_numbers);
  s.on_step(time, s.seen, s.changed);
  std::copy_n(s.changed_numbers->begin(), inputs.size(), inputs.begin());
}

void call_law(const Stepper& s, const Law& law, double time, std::span<const double> outputs,
              std::span<double> inputs) {
  nb::list arguments;
  arguments.append(time);
  for (const std::size_t k : law.outputs) arguments.append(outputs[k]);
  const nb::object value = law.function(*arguments);
  double x = 0.0;
  if (!nb::try_cast(value, x))
    throw InputError(ErrorCode::out_of_range,
                     "the law of the input '" + s.input_names[static_cast<std::size_t>(law.input)] +
                         "' gave " + type_of(value) + ", expected a number");
  inputs[static_cast<std::size_t>(law.input)] = x;
}

/// The function called by the library before each step while there are callbacks.
void set_callback(Stepper& s) {
  if (!s.on_step.is_valid() && s.laws.empty()) {
    s.simulation.on_force({});
    return;
  }
  s.simulation.on_force(
      [&s](double time, std::span<const double> outputs, std::span<double> inputs) {
        Locked lock;
        try {
          if (s.on_step.is_valid()) call_on_step(s, time, outputs, inputs);
          for (const Law& law : s.laws) call_law(s, law, time, outputs, inputs);
        } catch (...) {
          s.failed = std::current_exception();
          throw;
        }
      });
}

void on_step(Stepper& s, const nb::object& function) {
  s.idle();
  if (!function.is_none() && !PyCallable_Check(function.ptr()))
    throw InputError(ErrorCode::wrong_value,
                     "on_step: found " + type_of(function) +
                         ", expected a function of (time, outputs, inputs), or None");
  s.on_step = function.is_none() ? nb::object() : function;
  s.seen_numbers = std::make_shared<std::vector<double>>(s.output_names.size());
  s.changed_numbers = std::make_shared<std::vector<double>>(s.input_names.size());
  s.seen = view_of(s.seen_numbers);
  s.changed = view_of(s.changed_numbers);
  set_callback(s);
}

void add_law(Stepper& s, const nb::object& input, const nb::object& function, const nb::list& of) {
  s.idle();
  Law law{static_cast<std::ptrdiff_t>(input_of(s, input)), {}, function};
  for (const nb::handle name : of) law.outputs.push_back(output_of(s, name));
  if (!function.is_none() && !PyCallable_Check(function.ptr()))
    throw InputError(
        ErrorCode::wrong_value,
        "law: found " + type_of(function) + ", expected a function of (time, *outputs), or None");
  std::erase_if(s.laws, [&](const Law& l) { return l.input == law.input; });
  if (!function.is_none()) s.laws.push_back(std::move(law));
  set_callback(s);
}

/// Report of a step, with its status as a word.
struct Report {
  StepReport step;
  std::string where;
};

Report step(Stepper& s, const nb::object& given) {
  s.idle();
  std::optional<double> size;
  if (!given.is_none()) size = number("size", given);
  s.failed = nullptr;
  s.worker = std::this_thread::get_id();
  s.busy = true;
  StepReport report;
  {
    Unlocked released;
    report = size ? s.simulation.step(*size) : s.simulation.step();
  }
  s.busy = false;
  if (report) return {report, ""};
  if (s.failed) std::rethrow_exception(std::exchange(s.failed, nullptr));
  const nb::object type = nb::module_::import_("floatframe.errors").attr("StepError");
  const nb::object error = type(s.simulation.failure(), step_status_name(report.status),
                                std::string(report.where), report.time);
  set_cause(error, s.simulation.thrown());
  PyErr_SetObject(type.ptr(), error.ptr());
  throw nb::python_error();
}

// Lets Python's collector find cycles of callbacks that hold their simulation.
int traverse(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (!nb::inst_ready(self)) return 0;
  const Stepper* s = nb::inst_ptr<Stepper>(self);
  Py_VISIT(s->on_step.ptr());
  for (const Law& law : s->laws) Py_VISIT(law.function.ptr());
  return 0;
}
int clear(PyObject* self) {
  if (!nb::inst_ready(self)) return 0;
  Stepper* s = nb::inst_ptr<Stepper>(self);
  s->simulation.on_force({});
  s->on_step.reset();
  s->laws.clear();
  return 0;
}
PyType_Slot slots[] = {{Py_tp_traverse, reinterpret_cast<void*>(traverse)},
                       {Py_tp_clear, reinterpret_cast<void*>(clear)},
                       {0, nullptr}};

Numbers counters(Stepper& s) {
  const StepCounters c = s.idle().counters();
  nb::dict d;
  d["steps"] = c.steps;
  d["substeps"] = c.substeps;
  d["iterations"] = c.iterations;
  d["factorizations"] = c.factorizations;
  d["edges"] = c.edges;
  d["edges_passed"] = c.edges_passed;
  d["corners"] = c.corners;
  d["max_position_violation"] = c.max_position_violation;
  d["max_velocity_violation"] = c.max_velocity_violation;
  return d;
}

std::vector<double> copied(std::span<const double> numbers) {
  return {numbers.begin(), numbers.end()};
}

void bind_reports(nb::module_& m) {
  nb::class_<Report>(m, "StepReport", "Cost of a step and its constraint violations.")
      .def_prop_ro(
          "time", [](const Report& r) { return r.step.time; }, "End of the step [s].")
      .def_prop_ro(
          "iterations", [](const Report& r) { return r.step.iterations; }, "Newton iterations.")
      .def_prop_ro("factorizations", [](const Report& r) { return r.step.factorizations; })
      .def_prop_ro(
          "substeps", [](const Report& r) { return r.step.substeps; },
          "Number of substeps; 0: not divided.")
      .def_prop_ro(
          "position_violation", [](const Report& r) { return r.step.position_violation; }, "[m]")
      .def_prop_ro(
          "velocity_violation", [](const Report& r) { return r.step.velocity_violation; }, "[m/s]");
}

}  // namespace

void bind_simulation(nb::module_& m) {
  bind_reports(m);
  nb::class_<Stepper>(m, "Simulation", nb::type_slots(slots))
      .def(
          "__init__",
          [](Stepper* self, const Model& model, const Keywords& given) {
            const SimulationOptions options = options_of(given);
            Unlocked released;
            new (self) Stepper(model, options);
          },
          nb::arg("model"), nb::arg("options"))
      .def("step", step, nb::arg("size") = nb::none(),
           nb::sig("def step(self, size: float | None = None) -> StepReport"),
           "One step of the size of the options, or of `size` [s]. Raises StepError if it fails: "
           "time and outputs stay those of the last good step, and further steps fail until "
           "`restore`. Exceptions of callbacks pass through.")
      .def_prop_ro("time", [](Stepper& s) { return s.idle().time(); })
      .def_prop_ro("step_size", [](Stepper& s) { return s.simulation.options().step; })
      .def_prop_ro("counters", counters)
      .def_prop_ro("notes", [](Stepper& s) { return s.simulation.start_report().notes; })
      .def_ro("input_names", &Stepper::input_names)
      .def_ro("output_names", &Stepper::output_names)
      .def("input",
           [](Stepper& s, const nb::object& n) { return s.idle().inputs()[input_of(s, n)]; })
      .def("set_input",
           [](Stepper& s, const nb::object& n, const nb::object& given) {
             Simulation& simulation = s.idle();
             const std::size_t input = input_of(s, n);
             double value = 0.0;
             if (!PyFloat_CheckExact(given.ptr()))
               value = number("input '" + s.input_names[input] + "'", given);
             else
               value = PyFloat_AS_DOUBLE(given.ptr());
             simulation.set_input(static_cast<std::ptrdiff_t>(input), value);
           })
      .def("output",
           [](Stepper& s, const nb::object& n) { return s.idle().outputs()[output_of(s, n)]; })
      .def("inputs_array", [](Stepper& s) { return array_of(copied(s.idle().inputs())); })
      .def("outputs_array", [](Stepper& s) { return array_of(copied(s.idle().outputs())); })
      .def("set_on_step", on_step, nb::arg("function").none())
      .def("set_law", add_law, nb::arg("input"), nb::arg("function").none(), nb::arg("of"),
           nb::sig("def set_law(self, input: str, function: object | None, of: list[str]) -> None"))
      .def(
          "save", [](Stepper& s) { return s.idle().save(); },
          "Complete state for the next steps; may be pickled.")
      .def(
          "restore",
          [](Stepper& s, const nb::object& state) {
            if (!nb::isinstance<SimulationState>(state) || !nb::inst_ready(state))
              throw InputError(
                  ErrorCode::wrong_value,
                  "state: found " + type_of(state) + ", expected a floatframe.SimulationState");
            s.idle().restore(nb::cast<const SimulationState&>(state));
          },
          nb::arg("state"), nb::sig("def restore(self, state: SimulationState) -> None"),
          "Sets a state of this simulation or of another one of the same model and "
          "options: the same steps follow, bit for bit. Raises InputError, and changes nothing, "
          "for any other state.")
      .def(
          "state", [](Stepper& s) { return s.idle().state(); },
          "State of the model, by the names of joints and bodies.");
}

}  // namespace floatframe::python
