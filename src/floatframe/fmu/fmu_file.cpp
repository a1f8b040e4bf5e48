#include "floatframe/fmu/fmu_file.hpp"

#include <fmt/format.h>

#include <array>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/library_path.hpp"
#include "floatframe/core/regular_file.hpp"
#include "floatframe/fmu/fmu_content.hpp"
#include "floatframe/fmu/fmu_icon.hpp"
#include "floatframe/fmu/fmu_page.hpp"
#include "floatframe/fmu/model_description.hpp"
#include "floatframe/formats/body_file/zip_store.hpp"
#include "floatframe/model/model_hash.hpp"
#include "floatframe/stepping/same_structure.hpp"

namespace floatframe {
namespace {

/// A platform: its runtime beside the library, and its folders and endings in FMUs.
struct FmuPlatform {
  const char *name, *file, *folder_2, *folder_3, *ending;
};
constexpr std::array<FmuPlatform, 2> fmu_platforms{
    {{"linux64", "linux64/floatframe_fmu.so", "linux64", "x86_64-linux", ".so"},
     {"win64", "win64/floatframe_fmu.dll", "win64", "x86_64-windows", ".dll"}}};

/// In the folder of a build, or where it is installed.
std::string runtime_path(const FmuPlatform& platform) {
  for (const char* folder : {"fmu/", "floatframe/fmu/"})
    if (const std::string path = module_path(std::string(folder) + platform.file); !path.empty())
      return path;
  return "";
}

/// Owns the contents of the members of an archive.
class FmuMembers {
 public:
  void add(std::string name, std::string content) {
    held_.emplace_back(std::move(name), std::move(content));
  }
  std::string archive() const {
    std::vector<ZipMember> members;
    for (const auto& [name, content] : held_) members.push_back({name, content, true});
    return zip_archive(members);
  }

 private:
  std::vector<std::pair<std::string, std::string>> held_;
};

/// Whether a parameter has no effect after the start, or is refused there: start values or an
/// option that holds for a whole run, as the step, follow from it. Found by other values of it.
bool is_fixed(const PackedModel& packed, std::size_t parameter, const Model& present) {
  std::vector<double> values;
  for (const PackedParameter& p : packed.parameters()) values.push_back(p.value);
  const double value = values[parameter];
  const std::string hash = model_hash(present);  // without start values
  bool same = true, built = false;
  for (const double other : {1.01 * value + 1e-6, 10.0 * value, 0.0}) {
    values[parameter] = other;
    try {
      const Model changed = packed.build(values);
      if (!option_complaint(present.simulation, changed.simulation).empty()) return true;
      same = same && model_hash(changed) == hash;
      built = true;
    } catch (const InputError&) {
      continue;  // no value of it
    }
  }
  return same && built;
}

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

std::vector<FmuBinary> fmu_binaries() {
  std::vector<FmuBinary> out;
  for (const FmuPlatform& platform : fmu_platforms) {
    const std::string path = runtime_path(platform);
    if (path.empty()) continue;
    out.push_back({platform.name, regular_file(path)});
  }
  if (out.empty() || out.front().platform != fmu_platforms.front().name)
    throw InputError(ErrorCode::unavailable,
                     fmt::format("found no {} beside {}, expected the runtime of FMUs: this "
                                 "program was built without it",
                                 fmu_platforms.front().file, library_path()));
  return out;
}

std::string fmu_archive(const PackedModel& packed, const std::vector<FmuBinary>& binaries,
                        const FmuOptions& options, FmuReport& report) {
  if (options.version != 2 && options.version != 3)
    throw InputError(ErrorCode::wrong_value,
                     fmt::format("version of FMI: found {}, expected 2 or 3", options.version));
  const bool third = options.version == 3;
  const Model present = packed.build();
  FmuContent content = fmu_content(present, packed.parameters(), packed.fingerprint());
  for (std::size_t i = 0; i < content.parameters.size(); ++i)
    content.parameters[i].fixed = is_fixed(packed, i, present);
  // The runtime finds a variable by the lower half of its reference.
  constexpr std::size_t most = 0x10000;
  for (const std::vector<FmuVariable>* list :
       {&content.inputs, &content.outputs, &content.parameters})
    if (list->size() > most)
      throw InputError(ErrorCode::too_large,
                       fmt::format("found {} inputs, outputs or parameters, expected at most {} of "
                                   "a kind in an FMU: --outputs chooses some",
                                   list->size(), most));
  std::string model = text_of(packed.to_bytes());
  report = {.model_bytes = model.size(),
            .inputs = content.inputs.size(),
            .outputs = content.outputs.size(),
            .parameters = content.parameters.size(),
            .platforms = {},
            .notes = content.notes};
  FmuMembers members;
  members.add("modelDescription.xml",
              third ? fmi3_model_description(content) : fmi2_model_description(content));
  for (const FmuPlatform& platform : fmu_platforms) {
    bool found = false;
    for (const FmuBinary& binary : binaries) {
      if (binary.platform != platform.name) continue;
      members.add(fmt::format("binaries/{}/{}{}", third ? platform.folder_3 : platform.folder_2,
                              content.identifier, platform.ending),
                  binary.content);
      report.platforms.push_back(platform.name);
      found = true;
    }
    if (!found)
      report.notes.push_back(
          fmt::format("no runtime for {}: this program was built without it", platform.name));
  }
  members.add("resources/model.ffm", std::move(model));
  members.add("documentation/index.html",
              fmu_page(content, options.version, options.notes, report.platforms));
  members.add("documentation/licenses/license.txt", fmu_licences());
  if (third) members.add("terminalsAndIcons/terminalsAndIcons.xml", fmi3_terminals(content));
  members.add(third ? "terminalsAndIcons/icon.png" : "model.png", fmu_icon());
  std::string archive = members.archive();
  report.bytes = archive.size();
  return archive;
}

FmuReport write_fmu(const std::string& path, const PackedModel& packed, const FmuOptions& options) {
  FmuReport report;
  write_file(path, fmu_archive(packed, fmu_binaries(), options, report));
  return report;
}

}  // namespace floatframe
