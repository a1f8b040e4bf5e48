// Bodies of a run at its recorded instants, for pictures; the states of a run as bytes.
#include <nanobind/stl/tuple.h>

#include "bindings.hpp"

namespace floatframe::python {
namespace {

/// Numbers copied into memory that the array owns: shape (n,), or (n, columns).
template <class T>
nb::object copied(const std::vector<T>& v, std::size_t columns) {
  auto kept = std::make_unique<std::vector<T>>(v);
  T* numbers = kept->data();
  nb::capsule owner(kept.get(), [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  kept.release();
  const std::array<std::size_t, 2> shape{v.size() / columns, columns};
  return nb::cast(nb::ndarray<nb::numpy, T>(numbers, columns > 1 ? 2 : 1, shape.data(), owner));
}

Keywords arrays_of(const std::vector<VtkArray>& arrays) {
  Keywords out;
  for (const VtkArray& a : arrays)
    out[a.name.c_str()] = std::visit(
        [&](const auto& values) { return copied(values, std::size_t(a.components)); }, a.values);
  return out;
}

/// A scene with the model that it draws.
struct Scene {
  Scene(std::shared_ptr<LoadedModel> of, const std::string& bytes, const std::string& name)
      : model(std::move(of)), scene(*model, StateHistory::of_bytes(bytes, name)) {}
  std::shared_ptr<LoadedModel> model;
  RunScene scene;
};

/// Points, arrays of points, connectivity, ends and types of the cells, arrays of cells, texts.
std::tuple<nb::object, Keywords, nb::object, nb::object, nb::object, Keywords, Keywords, double>
grid_at(Scene& s, std::size_t instant) {
  const VtkGrid* grid = nullptr;
  {
    Unlocked released;
    grid = &s.scene.at(instant);
  }
  Keywords texts;
  for (const auto& [name, words] : grid->texts) texts[name.c_str()] = words;
  return std::make_tuple(copied(grid->points, 3), arrays_of(grid->point_data),
                         copied(grid->connectivity, 1), copied(grid->offsets, 1),
                         copied(grid->types, 1), arrays_of(grid->cell_data), texts, grid->time);
}

}  // namespace

void bind_scene(nb::module_& m) {
  m.def("states_of_run",
        [](const LoadedModel& model, const KeptRun& run, const std::string& model_file) {
          KeptRun named = run;
          named.model_file = model_file;
          named.source = model.source;
          std::string bytes;
          {
            Unlocked released;
            bytes = states_of_run(model, named);
          }
          return nb::bytes(bytes.data(), bytes.size());
        });
  nb::class_<Scene>(m, "Scene")
      .def(
          "__init__",
          [](Scene* self, const std::shared_ptr<LoadedModel>& model, const nb::bytes& states,
             const std::string& name) {
            const std::string bytes(states.c_str(), states.size());
            Unlocked released;
            new (self) Scene(model, bytes, name);
          },
          nb::arg("model"), nb::arg("states"), nb::arg("name"))
      .def_prop_ro("instants", [](const Scene& s) { return s.scene.instants(); })
      .def("nearest", [](const Scene& s, double time) { return s.scene.nearest(time); })
      .def("at", grid_at);
  m.def("states_origin", [](const nb::bytes& states, const std::string& name) {
    const auto history = StateHistory::of_bytes(std::string(states.c_str(), states.size()), name);
    const HistoryOrigin& o = history.header().origin;
    return std::make_tuple(o.model_file, o.from_here, o.settings);
  });
}

}  // namespace floatframe::python
