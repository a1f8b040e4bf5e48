// Simulations stepped by Python. A simulation belongs to one thread at a time: while it steps,
// without the lock of the interpreter, calls from other threads and from its own callbacks are
// rejected.
#include <nanobind/stl/tuple.h>

#include <floatframe/history.hpp>
#include <set>
#include <thread>
#include <unordered_map>

#include "step_callback.hpp"

namespace floatframe::python {
namespace {

/// A force law: the value of an input as a function of the time and of some outputs.
struct Law {
  std::ptrdiff_t input = 0;
  std::vector<std::size_t> outputs;
  nb::object function;
};

struct Stepper {
  Stepper(const Model& model, const SimulationOptions& options, bool watch)
      : simulation(model, options), watched(watch) {
    const auto number = [](std::vector<std::string>&& names, auto& index) {
      for (std::size_t k = 0; k < names.size(); ++k) index.emplace(names[k], k);
      return std::move(names);
    };
    input_names = number(simulation.input_names(), input_index);
    output_names = number(simulation.output_names(), output_index);
    if (watch) recording.emplace(simulation, RecordingOptions{.rows = false});
  }

  Simulation simulation;
  bool watched;
  std::optional<Recording> recording;  ///< watches alone, or records too
  bool records = false;
  std::set<RangeLimit> told;  ///< limits that a warning was given of
  std::int64_t made = 0,
               next_look = 100;  ///< steps since the beginning, and until warnings are due
  std::vector<std::string> input_names, output_names;
  std::unordered_map<std::string, std::size_t> input_index, output_index;
  std::atomic<bool> busy{false};
  std::thread::id worker;
  std::shared_ptr<StepCallback> on_step;
  std::vector<Law> laws;
  std::exception_ptr failed;

  bool in_callback() const { return busy && worker == std::this_thread::get_id(); }
  /// Throws if the simulation is stepping.
  Simulation& idle() {
    if (!busy) return simulation;
    throw std::runtime_error(
        in_callback()
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
  if (!s.on_step && s.laws.empty()) {
    s.simulation.on_force({});
    return;
  }
  s.simulation.on_force(
      [&s](double time, std::span<const double> outputs, std::span<double> inputs) {
        Locked lock;
        try {
          if (s.on_step) (*s.on_step)(time, outputs, inputs);
          for (const Law& law : s.laws) call_law(s, law, time, outputs, inputs);
        } catch (...) {
          s.failed = std::current_exception();
          throw;
        }
      });
}

void on_step(Stepper& s, const nb::object& function, const nb::object& period) {
  s.idle();
  s.on_step = function.is_none()
                  ? nullptr
                  : std::make_shared<StepCallback>(function, s.input_names, s.output_names.size(),
                                                   period_of(period));
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

using LimitAndSentence = std::vector<std::pair<std::string, std::string>>;

LimitAndSentence warnings(Stepper& s) {
  s.idle();
  LimitAndSentence list;
  if (s.recording)
    for (const RangeWarning& w : s.recording->warnings())
      list.emplace_back(range_limit_names[static_cast<std::size_t>(w.limit)], w.sentence);
  return list;
}

/// Gives a warning of each limit once, now and then: finding its sentence costs more than a step.
void look(Stepper& s) {
  s.next_look = s.made + std::max<std::int64_t>(100, s.made / 4);
  for (const RangeWarning& w : s.recording->warnings())
    if (s.told.insert(w.limit).second)
      nb::module_::import_("floatframe.errors")
          .attr("tell")(w.sentence, range_limit_names[static_cast<std::size_t>(w.limit)]);
}

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
  if (report) {
    if (++s.made >= s.next_look && s.recording) look(s);
    return {report, ""};
  }
  if (s.failed) std::rethrow_exception(std::exchange(s.failed, nullptr));
  const nb::object type = nb::module_::import_("floatframe.errors").attr("StepError");
  const nb::object error = type(s.simulation.failure(), step_status_name(report.status),
                                std::string(report.where), report.time);
  set_cause(error, s.simulation.thrown());
  if (s.recording) look(s);
  PyErr_SetObject(type.ptr(), error.ptr());
  throw nb::python_error();
}

// Lets Python's collector find cycles of callbacks that hold their simulation.
int traverse(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (!nb::inst_ready(self)) return 0;
  const Stepper* s = nb::inst_ptr<Stepper>(self);
  if (s->on_step) Py_VISIT(s->on_step->function().ptr());
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

/// While a call without the lock of the interpreter uses the simulation, others are rejected.
struct Busy {
  explicit Busy(Stepper& s) : stepper(s) {
    s.idle();
    s.worker = {};
    s.busy = true;
  }
  ~Busy() { stepper.busy = false; }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;
  Stepper& stepper;
};

using Named = std::tuple<std::string, std::string, int, bool>;

StateName state_name(const Named& given) {
  const auto& [kind, name, index, rate] = given;
  return {word_of<StateKind>("kind", kind,
                             {{"joint", StateKind::joint},
                              {"mode", StateKind::mode},
                              {"element", StateKind::element},
                              {"body", StateKind::body},
                              {"input", StateKind::input},
                              {"combination", StateKind::combination}}),
          name, index, rate};
}

RealArray state_values(Stepper& s, const std::vector<Named>& given) {
  if (!s.in_callback()) s.idle();
  std::vector<StateName> names;
  for (const Named& name : given) names.push_back(state_name(name));
  return array_of(s.simulation.state_values(names));
}

void set_state(Stepper& s, const std::vector<std::pair<Named, double>>& given) {
  std::vector<GivenState> values;
  for (const auto& [name, value] : given) values.push_back({state_name(name), value});
  const Busy busy(s);
  Unlocked released;
  s.simulation.set_state(values);
}

void change_model(Stepper& s, const Model& model) {
  const Busy busy(s);
  Unlocked released;
  s.simulation.change_model(model);
}

LinearModel linear(Stepper& s, const std::vector<std::string>& inputs,
                   const std::vector<std::string>& outputs) {
  const Busy busy(s);
  Unlocked released;
  return linear_model(s.simulation, {inputs, outputs});
}

/// Ends the recording; with `every`, begins another one.
void record(Stepper& s, std::optional<std::int64_t> every, std::int64_t keep) {
  s.idle();
  s.recording.reset();
  s.records = false;
  if (every) {
    s.recording.emplace(s.simulation, RecordingOptions{.every = *every, .keep = std::size_t(keep)});
    s.records = true;
  } else if (s.watched) {
    s.recording.emplace(s.simulation, RecordingOptions{.rows = false});
  }
}

std::shared_ptr<KeptRun> recorded(Stepper& s, const LoadedModel& model, const std::string& file,
                                  const std::vector<std::string>& settings) {
  s.idle();
  if (!s.records) throw InputError(ErrorCode::missing, "found a simulation that is not recorded");
  auto kept = std::make_shared<KeptRun>(keep_recording(*s.recording));
  kept->model_file = file;
  kept->settings = settings;
  kept->source = model.source;
  return kept;
}

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
          [](Stepper* self, const Model& model, const Keywords& given, bool watch) {
            const SimulationOptions options = options_of(given);
            Unlocked released;
            new (self) Stepper(model, options, watch);
          },
          nb::arg("model"), nb::arg("options"), nb::arg("watch") = true)
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
      .def("set_on_step", on_step, nb::arg("function").none(), nb::arg("period").none())
      .def("set_law", add_law, nb::arg("input"), nb::arg("function").none(), nb::arg("of"),
           nb::sig("def set_law(self, input: str, function: object | None, of: list[str]) -> None"))
      .def("warning_list", warnings)
      .def("state_values", state_values, nb::arg("names"))
      .def("set_state", set_state, nb::arg("values"))
      .def("change_model", change_model, nb::arg("model"))
      .def("linear", linear, nb::arg("inputs"), nb::arg("outputs"))
      .def("begin_recording", record, nb::arg("every").none(), nb::arg("keep"))
      .def("recorded", recorded, nb::arg("model"), nb::arg("model_file"), nb::arg("settings"))
      .def_prop_ro("instants",
                   [](Stepper& s) { return s.records ? s.recording->instants() : std::size_t(0); })
      .def(
          "reset", [](Stepper& s) { s.idle().reset(); },
          "Returns to the start: its time, state, inputs and counters. A few microseconds.")
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
