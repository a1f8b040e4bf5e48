// The module floatframe._core: the public C++ interface for Python. Convenience functions -
// defaults, tables, pictures - are in the Python sources of the package.
#include "bindings.hpp"

NB_MODULE(_core, m) {
  using namespace floatframe::python;
  m.doc() = "The C++ library of Floatframe; use `floatframe`.";
  nb::set_leak_warnings(false);  // for interpreters that end while views exist
  bind_errors(m);
  bind_version(m);
  bind_model(m);
  bind_states(m);
  bind_run(m);
  bind_simulation(m);
  bind_analyses(m);
  bind_linear(m);
  bind_body(m);
  bind_mesh(m);
  bind_part(m);
  bind_road(m);
  bind_fmu(m);
  bind_scene(m);
  bind_threads();
}
