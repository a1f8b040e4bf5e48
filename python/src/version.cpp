// Version and build.
#include "bindings.hpp"

namespace floatframe::python {

void bind_version(nb::module_& m) {
  m.def("version", &version);
  m.def("build_info", []() -> Keywords {
    nb::dict info;
    info["version"] = version();
    info["build"] = build_description();
    info["instruction_set"] = instruction_set();
    info["processor"] = processor_name();
    info["mumps"] = mumps_available();
    return info;
  });
}

}  // namespace floatframe::python
