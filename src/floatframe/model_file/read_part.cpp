// Parts of flexible bodies: bars written in the model file, finite-element files that are reduced
// when the model is loaded, and files of reduced parts.
#include <filesystem>
#include <iterator>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/body/surface_points.hpp"
#include "floatframe/formats/sid/sid_file.hpp"
#include "floatframe/model_file/part_cache.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {
namespace {

/// The data of a part from a file that joints, forces and outputs need.
FlexibleRead known_part(FlexibleBody body) {
  FlexibleRead out;
  for (std::size_t k = 0; k < body.nodes.size(); ++k) {
    out.nodes.push_back(body.nodes[k].p);
    if (!body.nodes[k].name.empty() && !is_surface_point(body.nodes[k]))
      out.named_nodes.emplace(body.nodes[k].name, k);
  }
  out.modes = body.modes();
  out.valid = true;
  out.body = std::move(body);
  return out;
}

/// Includes the points of the surface, to which nothing can be attached.
FlexibleRead known_part(ReducedPart part) {
  std::vector<ModalNode> points =
      surface_points(part.body, part.surface_positions, part.surface_modes);
  BodyShape shape;
  shape.positions = std::move(part.surface_positions);
  shape.modes = std::move(part.surface_modes);
  shape.triangles = std::move(part.surface.triangles);
  shape.lines = std::move(part.surface.lines);
  shape.nodes = std::move(part.surface.nodes);
  part.body.shape = std::make_shared<const BodyShape>(std::move(shape));
  FlexibleRead out = known_part(std::move(part.body));
  out.body->nodes.insert(out.body->nodes.end(), std::make_move_iterator(points.begin()),
                         std::make_move_iterator(points.end()));
  return out;
}

FlexibleRead from_body_file(const ModelInstance& self, const ReadModel& model,
                            const std::string& who, const YamlValue& value) {
  const auto name = value.text("bars, a finite-element file or the name of a body file");
  if (!name) return {};
  const std::string file = sibling_path(self, *name);
  try {
    if (is_body_file(file) || std::filesystem::path(file).extension() == ".ffb") {
      BodyFile content = read_body_file(file);
      note_file_read(file, file_hash(file));
      const std::size_t warnings = content.part.health.warnings.size();
      if (warnings > 0 && model.options.say)
        model.options.say(who + ": the health report of '" + file + "' has " +
                          std::to_string(warnings) + (warnings == 1 ? " warning" : " warnings") +
                          " (floatframe info shows it)");
      return known_part(std::move(content.part));
    }
    SidBody sid = read_sid(file);
    note_file_read(file, file_hash(file));
    if (model.options.say)
      for (const std::string& note : sid.notes) model.options.say(who + ": " + note);
    return known_part(std::move(sid.body));
  } catch (const InputError& error) {
    add_errors(value, error);
    return {};
  }
}

FlexibleRead from_job(const ModelInstance& self, const ReadModel& model, const std::string& who,
                      const YamlValue& value) {
  auto section = value.section();
  const std::size_t before = self.context.errors->size();
  const auto job = read_part_job(self, *section);
  // A model with errors need not wait for reductions.
  if (!job || before > 0) return {};
  const std::filesystem::path folder = std::filesystem::path(self.document->file).parent_path();
  try {
    BodyFile content =
        cached_part(*job, part_cache_folder(folder.empty() ? "." : folder), who, model.options.say);
    for (const auto& [name, hash] : content.provenance.files)
      note_file_read((job->file.parent_path() / name).string(), hash);
    return known_part(std::move(content.part));
  } catch (const InputError& error) {
    add_errors(value, error);
    return {};
  }
}

}  // namespace

void add_errors(const YamlValue& value, const InputError& error) {
  for (const ErrorEntry& entry : error.errors()) {
    if (entry.mark.line > 0)
      value.context().errors->add(entry);
    else
      value.error(entry.code, entry.text(), entry.count);
  }
}

std::string sibling_path(const ModelInstance& self, const std::string& file) {
  return (std::filesystem::path(self.document->file).parent_path() / file)
      .lexically_normal()
      .string();
}

FlexibleRead read_part(const ModelInstance& self, const ReadModel& model, const std::string& body,
                       const YamlValue& value) {
  const std::string who = "bodies." + body;
  if (value.is_scalar()) return from_body_file(self, model, who, value);
  const auto group = value.section("a map with material, bars and modes, or with a file");
  if (!group) return {};
  if (group->has("file")) return from_job(self, model, who, value);
  if (!group->has("bars") && !group->has("material")) {
    group->error(ErrorCode::missing, "found neither 'bars' nor 'file', expected one of them");
    return {};
  }
  return read_flexible(self, *group);
}

}  // namespace floatframe
