// Models in one file and FMUs.
#include <nanobind/stl/tuple.h>

#include "bindings.hpp"

namespace floatframe::python {
namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

PackedModel pack_file(const std::string& file, const Settings& settings,
                      const std::vector<std::string>& outputs, std::vector<std::string>& fixed) {
  std::vector<ParameterOverride> overrides;
  for (const auto& [name, value] : settings) overrides.push_back({name, value});
  ModelPacking packing;
  packing.change = [&](ModelDescription& description) {
    if (!outputs.empty()) keep_outputs(description, outputs);
  };
  return pack_model(file, overrides, packing, &fixed);
}

}  // namespace

void bind_fmu(nb::module_& m) {
  m.def(
      "write_fmu",
      [](const std::string& file, const Settings& settings, const std::vector<std::string>& outputs,
         int version, const std::string& out) {
        std::vector<std::string> fixed;
        FmuReport report;
        {
          Unlocked released;
          const PackedModel packed = settings.empty() && outputs.empty() && is_packed_file(file)
                                         ? read_packed_model(file)
                                         : pack_file(file, settings, outputs, fixed);
          report = write_fmu(out, packed, {version, fixed});
        }
        std::vector<std::string> notes = report.notes;
        notes.insert(notes.end(), fixed.begin(), fixed.end());
        return std::make_tuple(report.bytes, report.inputs, report.outputs, report.parameters,
                               report.platforms, notes);
      },
      nb::arg("file"), nb::arg("settings"), nb::arg("outputs"), nb::arg("version"), nb::arg("out"));
}

}  // namespace floatframe::python
