// Model files and built models.

#include "bindings.hpp"

namespace floatframe::python {
namespace {

std::vector<ParameterOverride> overrides(
    const std::vector<std::pair<std::string, std::string>>& parameters) {
  std::vector<ParameterOverride> list;
  for (const auto& [name, value] : parameters) list.push_back({name, value});
  return list;
}

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

std::vector<std::pair<std::string, std::string>> units_of(const Model& model) {
  std::vector<std::pair<std::string, std::string>> units;
  for (const Output& o : model.outputs) units.emplace_back(o.name, o.unit);
  return units;
}

/// A model with its source.
LoadedModel loaded(const std::function<ModelDescription(ModelSource&)>& read) {
  ModelSource source;
  LoadedModel out;
  static_cast<Model&>(out) = build_model(read(source));
  out.source = std::move(source);
  return out;
}

/// Plain Python data; a key without a value is None.
nb::object python_of(const ModelValue& v) {
  switch (v.kind) {
    case ModelValue::Kind::nothing:
      return nb::none();
    case ModelValue::Kind::truth:
      return nb::bool_(v.truth);
    case ModelValue::Kind::whole:
      return nb::int_(v.whole);
    case ModelValue::Kind::number:
      return nb::float_(v.number);
    case ModelValue::Kind::text:
      return nb::str(v.text.c_str(), v.text.size());
    case ModelValue::Kind::list: {
      nb::list list;
      for (const ModelValue& item : v.items) list.append(python_of(item));
      return list;
    }
    case ModelValue::Kind::map: {
      nb::dict map;
      for (std::size_t k = 0; k < v.items.size(); ++k)
        map[nb::str(v.keys[k].c_str(), v.keys[k].size())] = python_of(v.items[k]);
      return map;
    }
  }
  return nb::none();
}

}  // namespace

void bind_model(nb::module_& m) {
  nb::class_<Model>(m, "Model")
      .def_ro("name", &Model::name)
      .def_prop_ro("bodies", [](const Model& model) { return names_of(model.bodies); })
      .def_prop_ro("joints", [](const Model& model) { return names_of(model.joints); })
      .def_prop_ro("forces",
                   [](const Model& model) {
                     std::vector<std::string> names;
                     for (const Element& e : model.elements)
                       if (e.acts) names.push_back(e.name);
                     return names;
                   })
      .def_prop_ro("inputs", [](const Model& model) { return names_of(model.inputs); })
      .def_prop_ro("outputs", [](const Model& model) { return names_of(model.outputs); })
      .def_prop_ro("output_units", units_of)
      .def_prop_ro("step", [](const Model& model) { return model.simulation.step; })
      .def_prop_ro("duration", [](const Model& model) { return model.simulation.duration; });
  nb::class_<LoadedModel, Model>(m, "LoadedModel")
      .def_prop_ro("files", [](const LoadedModel& model) {
        std::vector<std::string> files;
        for (const auto& [file, hash] : model.source.files) files.push_back(file);
        return files;
      });
  m.def(
      "read_model",
      [](const std::string& text, const std::string& path,
         const std::vector<std::pair<std::string, std::string>>& given, const Keywords& functions) {
        const std::vector<ParameterOverride> parameters = overrides(given);
        std::map<std::string, ForceFunction> laws;
        for (const auto& [name, function] : functions)
          laws.emplace(nb::cast<std::string>(name), law_of(nb::borrow(function)));
        Unlocked released;
        return loaded([&](ModelSource& source) {
          ModelDescription d = read_description(text, path, parameters, &source);
          for (ElementDescription& e : d.forces)
            if (const auto law = laws.find(e.name); law != laws.end())
              if (auto* keys = std::get_if<ForceLaw>(&e.kind)) keys->law = law->second;
          return d;
        });
      },
      nb::arg("text"), nb::arg("path"), nb::arg("parameters"), nb::arg("functions"));
  m.def(
      "model_values",
      [](const std::string& text, const std::string& file) {
        return python_of(model_values(text, file));
      },
      nb::arg("text"), nb::arg("file"));
  m.def(
      "load_model",
      [](const std::string& path, const std::vector<std::pair<std::string, std::string>>& given) {
        const std::vector<ParameterOverride> parameters = overrides(given);
        Unlocked released;
        return loaded(
            [&](ModelSource& source) { return load_description(path, parameters, &source); });
      },
      nb::arg("path"), nb::arg("parameters"));
}

}  // namespace floatframe::python
