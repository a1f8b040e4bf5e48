#include "floatframe/model_file/model_reader.hpp"

#include <algorithm>
#include <bit>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <tuple>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model_file/load_instances.hpp"
#include "floatframe/model_file/pack_model.hpp"
#include "floatframe/model_file/read_parts.hpp"
#include "floatframe/model_file/resolved_text.hpp"

namespace floatframe {
namespace {

const char* const top_keys[] = {"floatframe", "parameters",  "points",    "bodies",   "joints",
                                "rods",       "constraints", "couplings", "forces",   "controllers",
                                "roads",      "inputs",      "outputs",   "measures", "initial",
                                "subsystems", "external"};

/// Keys allowed only in the model file itself.
constexpr const char* whole_keys[] = {"gravity", "snap", "simulation", "vehicle"};

/// snap: false, or {angle: 3e-3, distance: 1e-3}
void read_snap(const YamlValue& value, SnapDescription& snap) {
  if (!value.is_map()) {
    snap.on = value.boolean().value_or(snap.on);
    return;
  }
  auto s = value.section();
  snap.angle = s->number("angle", rules::snap_angle, snap.angle);
  snap.distance = s->number("distance", rules::snap_distance, snap.distance);
  s->finish();
}

/// All instances, outer ones first.
void every(const ModelInstance& self, const std::function<void(const ModelInstance&)>& action) {
  action(self);
  for (const auto& [name, child] : self.children) every(*child, action);
}

void check_keys(const ModelInstance& self) {
  if (!self.root) return;
  YamlSection root = *self.root;
  for (const char* key : top_keys) root.get(key);
  root.get("name");
  if (!self.outer) {
    for (const char* key : whole_keys) root.get(key);
  } else {
    for (const char* key : whole_keys)
      if (const auto v = root.get(key))
        self.context.errors->add(
            ErrorCode::wrong_value, v->entity_mark(),
            std::string(key) + ": found in a subsystem file, expected it in the model file only");
  }
  root.finish();
}

void read_top(const ModelInstance& self, const std::string& path, ReadModel& model) {
  model.description.name = std::filesystem::path(path).stem().string();
  if (!self.root) return;
  YamlSection root = *self.root;
  if (const auto v = root.get("name"))
    if (const auto name = v->text("the name of the model")) {
      const auto complaint = sentences::model_name(*name);
      if (complaint)
        v->error(ErrorCode::wrong_value, "found " + v->found() + ", " + *complaint);
      else
        model.description.name = *name;
    }
  root.vector("gravity", "m/s2", model.description.gravity);
  if (const auto v = root.get("snap")) read_snap(*v, model.description.snap);
  if (!root.has("bodies") && self.children.empty() && !root.has("subsystems"))
    root.error(ErrorCode::missing, "missing key 'bodies'");
}

/// Errors by file (in the order of loading), line and column, each once.
std::vector<ErrorEntry> sorted(std::vector<ErrorEntry> errors, const ModelFiles& files) {
  std::set<std::tuple<std::string, int, int, std::string>> seen;
  std::erase_if(errors, [&](const ErrorEntry& f) {
    return !seen.insert({f.mark.file, f.mark.line, f.mark.column, f.message}).second;
  });
  std::stable_sort(errors.begin(), errors.end(), [&](const ErrorEntry& a, const ErrorEntry& b) {
    return std::make_tuple(files.order(a.mark.file), a.mark.line, a.mark.column) <
           std::make_tuple(files.order(b.mark.file), b.mark.line, b.mark.column);
  });
  return errors;
}

}  // namespace

namespace {

/// A model file that is packed already: its description with these values of its parameters.
ModelDescription packed_description(const std::string& path,
                                    const std::vector<ParameterOverride>& overrides,
                                    ModelFingerprint* used, const ReadOptions& options) {
  const PackedModel model = read_packed_model(path);
  if (used) {
    for (const PackedParameter& p : model.parameters()) used->parameters.push_back(p.name);
    used->files[path] = model.fingerprint();
  }
  if (!options.outputs.empty())
    throw InputError(ErrorCode::unsupported, {path, 0, 0},
                     "found a packed model and further outputs, expected those that were packed");
  const std::vector<double> values = packed_values(model, overrides);
  if (used) {
    ContentHash hash;
    hash.add(std::string_view(model.fingerprint()));
    for (const double x : values) hash.add(std::bit_cast<std::uint64_t>(x));
    used->model = used->simulation = hash.text();
  }
  return model.description(values);
}

}  // namespace

std::vector<std::string> model_parameters(const std::string& path) {
  if (is_packed_file(path)) {
    const PackedModel model = read_packed_model(path);
    std::vector<std::string> known;
    for (const PackedParameter& p : model.parameters()) known.push_back(p.name);
    return known;
  }
  ReadErrors errors;
  ModelFiles files(errors);
  std::vector<std::string> names;
  if (const auto root = load_instances(path, {}, files, errors))
    for (const auto& [name, value] : root->scope) names.push_back(name);
  return names;
}

ModelDescription read_model(const std::string& path,
                            const std::vector<ParameterOverride>& overrides, ModelFingerprint* used,
                            const ReadOptions& options) {
  if (!options.text && is_packed_file(path))
    return packed_description(path, overrides, used, options);
  std::optional<FilesRead> record;
  if (used) record.emplace(used->files);
  ReadErrors errors;
  ModelFiles files(errors, options.parsed.get());
  if (options.text) files.give(path, *options.text);
  ReadModel model;
  model.options = options;
  const auto root = load_instances(path, overrides, files, errors);
  if (errors.exhausted()) throw InputError(sorted(errors.take(), files));
  if (root && used) {
    for (const auto& [name, value] : root->scope) used->parameters.push_back(name);
    fingerprint(*root, *used);
    if (options.keep_text) used->text = resolved_text(*root);
  }
  if (root && root->root) {
    read_top(*root, path, model);
    every(*root, check_keys);
    for (const auto part :
         {read_bodies, read_joints, read_rods, read_constraints, read_couplings, read_roads,
          read_inputs, read_forces, read_controllers, read_initial, read_outputs})
      every(*root, [&](const ModelInstance& self) { part(self, model); });
    read_simulation(*root, model);
    read_vehicle(*root, model);
    if (model.description.outputs.empty()) default_outputs(model);
    read_added_outputs(*root, model);
    if (errors.empty() && model.description.bodies.empty())
      errors.add(ErrorCode::missing, {path, 1, 1},
                 "bodies: found none, expected at least one body");
  }
  if (!errors.empty()) throw InputError(sorted(errors.take(), files));
  return std::move(model.description);
}

}  // namespace floatframe
