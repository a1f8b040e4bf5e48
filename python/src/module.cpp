// The module floatframe._core: Python's view of the public C++ interface. What is pleasant about
// the package - defaults, tables, pictures - is in Python beside it.
#include "bindings.hpp"

NB_MODULE(_core, m) {
  using namespace floatframe::python;
  m.doc() = "The C++ library of Floatframe; use `floatframe`.";
  nb::set_leak_warnings(false);  // of interpreters that end while views are alive
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
  bind_threads();
}
