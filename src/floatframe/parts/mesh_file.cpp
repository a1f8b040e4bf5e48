#include "floatframe/parts/mesh_file.hpp"

#include <fmt/format.h>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/output_files.hpp"
#include "floatframe/core/plural.hpp"
#include "floatframe/formats/written/mesh_writer.hpp"

namespace floatframe {

ConvertedMesh convert_mesh_file(const PartJob& job, const std::filesystem::path& out, int modes) {
  const MeshFormat& format = mesh_format_of(out);
  const FeModel model = read_fe_file(job.file, job.read, job.format);
  if (model.elements.empty())
    throw InputError(ErrorCode::missing, {job.file.string(), 0, 0},
                     "the model has no elements, expected a mesh (matrices have none)");
  WrittenMesh written = format.write(model, {modes});
  ConvertedMesh converted;
  converted.bytes = std::move(written.bytes);
  converted.summary =
      fmt::format("{}: {}, {}, as a {}\n", out.string(), plural(model.nodes(), "node"),
                  plural(static_cast<long>(model.elements.size()), "element"), format.description);
  const auto add = [&](const char* title, const std::vector<std::string>& notes) {
    if (notes.empty()) return;
    converted.summary += fmt::format("\n  {}\n", title);
    for (const std::string& note : notes) converted.summary += fmt::format("    {}\n", note);
  };
  add("read with these notes", model.notes);
  add("written with these notes", written.notes);
  converted.files = model.files;
  return converted;
}

std::string save_converted_mesh(const PartJob& job, const std::string& out, int modes) {
  const ConvertedMesh converted = convert_mesh_file(job, out, modes);
  require_distinct({{"OUT", out}}, converted.files);
  write_file(out, converted.bytes);
  return converted.summary;
}

}  // namespace floatframe
