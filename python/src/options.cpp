// Options of simulations and analyses by their names: keyword arguments of Python.
#include <cmath>

#include "bindings.hpp"

namespace floatframe::python {
namespace {

[[noreturn]] void refuse(const std::string& name, const nb::handle value, const char* expected) {
  std::string found;
  if (!nb::try_cast(nb::repr(value), found) || found.size() > 100 ||
      found.find('\n') != std::string::npos)
    found = type_of(value);
  throw InputError(ErrorCode::wrong_value, name + ": found " + found + ", expected " + expected);
}

void set_start(SimulationOptions& o, const std::string& name, const nb::handle value) {
  if (nb::isinstance<SystemState>(value) && nb::inst_ready(value)) {
    o.start = Start::state;
    o.state = std::make_shared<const SystemState>(nb::cast<const SystemState&>(value));
    return;
  }
  if (!nb::isinstance<nb::str>(value))
    refuse(name, value, "'given', 'equilibrium' or a floatframe.State");
  o.start = word_of<Start>("start", text(name, value),
                           {{"given", Start::given}, {"equilibrium", Start::equilibrium}});
}

using Setter = void (*)(SimulationOptions&, const std::string&, nb::handle);

template <std::optional<double> SimulationOptions::*member>
void set_number(SimulationOptions& o, const std::string& name, const nb::handle value) {
  o.*member = number(name, value);
}

const std::vector<std::pair<std::string, Setter>>& setters() {
  using O = SimulationOptions;
  static const std::vector<std::pair<std::string, Setter>> list{
      {"step", set_number<&O::step>},
      {"coordinates", [](O& o, const std::string& n,
                         nb::handle v) { o.coordinates = coordinates_of(text(n, v)); }},
      {"inertia",
       [](O& o, const std::string& n, nb::handle v) { o.inertia = inertia_of(text(n, v)); }},
      {"start", set_start},
      {"tolerance", set_number<&O::tolerance>},
      {"spectral_radius", set_number<&O::spectral_radius>},
      {"max_iterations",
       [](O& o, const std::string& n, nb::handle v) { o.max_iterations = whole(n, v); }},
      {"min_step", set_number<&O::min_step>},
      {"penalty", set_number<&O::penalty>},
      {"position_tolerance", set_number<&O::position_tolerance>},
      {"velocity_tolerance", set_number<&O::velocity_tolerance>},
      {"locate_edges",
       [](O& o, const std::string& n, nb::handle v) { o.locate_edges = flag(n, v); }},
      {"input", [](O& o, const std::string& n, nb::handle v) {
         o.input = word_of<InputUse>("input", text(n, v),
                                     {{"held", InputUse::held}, {"ramp", InputUse::ramp}});
       }}};
  return list;
}

/// True and False of Python or numpy.
bool is_truth(const nb::handle value) {
  return PyBool_Check(value.ptr()) ||
         std::string_view(Py_TYPE(value.ptr())->tp_name) == "numpy.bool" ||
         std::string_view(Py_TYPE(value.ptr())->tp_name) == "numpy.bool_";
}

}  // namespace

std::string type_of(const nb::handle value) {
  return nb::cast<std::string>(nb::borrow<nb::str>(value.type().attr("__name__")));
}

double number(const std::string& name, const nb::handle value) {
  double x = 0.0;
  if (is_truth(value) || !nb::try_cast(value, x)) refuse(name, value, "a number");
  return x;
}

int whole(const std::string& name, const nb::handle value) {
  int n = 0;
  if (is_truth(value) || !nb::try_cast(value, n)) refuse(name, value, "a whole number");
  return n;
}

bool flag(const std::string& name, const nb::handle value) {
  if (!is_truth(value)) refuse(name, value, "True or False");
  return PyObject_IsTrue(value.ptr()) == 1;
}

std::string text(const std::string& name, const nb::handle value) {
  std::string s;
  if (!nb::isinstance<nb::str>(value) || !nb::try_cast(value, s)) refuse(name, value, "a text");
  return s;
}

std::string path(const std::string& name, const nb::handle value) {
  nb::object given = nb::borrow(value);
  if (nb::hasattr(value, "__fspath__")) given = value.attr("__fspath__")();
  std::string s;
  if (!nb::isinstance<nb::str>(given) || !nb::try_cast(given, s) || s.empty() ||
      s.find('\0') != std::string::npos)
    refuse(name, value, "a path");
  return s;
}

Coordinates coordinates_of(const std::string& word) {
  return word_of<Coordinates>(
      "coordinates", word,
      {{"relative", Coordinates::relative}, {"absolute", Coordinates::absolute}});
}

InertiaMethod inertia_of(const std::string& word) {
  return word_of<InertiaMethod>(
      "inertia", word,
      {{"preprocessing", InertiaMethod::preprocessing}, {"projection", InertiaMethod::projection}});
}

SimulationOptions options_of(const Keywords& given) {
  SimulationOptions options;
  for (const auto& [key, value] : given) {
    const std::string name = nb::cast<std::string>(key);
    if (value.is_none()) continue;  // value of the model
    const auto& list = setters();
    const auto it =
        std::find_if(list.begin(), list.end(), [&](const auto& s) { return s.first == name; });
    if (it == list.end()) {
      std::string known;
      for (const auto& [word, set] : list) known += (known.empty() ? "" : ", ") + word;
      throw nb::type_error(("found the option '" + name + "', expected one of " + known).c_str());
    }
    it->second(options, name, value);
  }
  return options;
}

}  // namespace floatframe::python
