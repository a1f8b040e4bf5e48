#include "floatframe/model_file/model_fingerprint.hpp"

#include <filesystem>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/model_file/model_instance.hpp"

namespace floatframe {
namespace {

void add(ContentHash& hash, const YamlNode& node, const ParameterScope& scope) {
  hash.add(static_cast<std::uint64_t>(node.kind));
  switch (node.kind) {
    case YamlNode::Kind::null:
      return;
    case YamlNode::Kind::scalar:
      hash.add(static_cast<std::uint64_t>(node.quoted));
      if (node.text.find("${") == std::string::npos) {
        hash.add(node.text);
        return;
      }
      try {
        const ParameterValue value = substitute_parameters(node.text, scope, false);
        hash.add(static_cast<std::uint64_t>(value.index())).add(value_text(value));
      } catch (const ExpressionError&) {  // a disabled entity, or an error reported elsewhere
        hash.add(node.text);
      }
      return;
    case YamlNode::Kind::sequence:
      hash.add(static_cast<std::uint64_t>(node.items.size()));
      for (const YamlNode& item : node.items) add(hash, item, scope);
      return;
    case YamlNode::Kind::map:
      hash.add(static_cast<std::uint64_t>(node.entries.size()));
      for (const YamlEntry& entry : node.entries) {
        hash.add(entry.key);
        add(hash, entry.value, scope);
      }
      return;
  }
}

void add(ContentHash& model, ContentHash& simulation, const ModelInstance& self) {
  model.add(self.prefix).add(self.document->file);
  for (const YamlEntry& entry : self.document->root.entries) {
    if (entry.key == "parameters") continue;
    ContentHash& hash = entry.key == "simulation" ? simulation : model;
    hash.add(entry.key);
    add(hash, entry.value, self.scope);
  }
  for (const auto& [name, child] : self.children) add(model, simulation, *child);
}

}  // namespace

std::map<std::string, std::string> relative_to_model(
    const std::string& model, const std::map<std::string, std::string>& files) {
  std::map<std::string, std::string> out;
  const auto folder = std::filesystem::path(model).parent_path();
  for (const auto& [file, hash] : files) {
    const std::string relative =
        folder.empty() ? "" : std::filesystem::path(file).lexically_relative(folder).string();
    out.emplace(relative.empty() ? file : relative, hash);
  }
  return out;
}

void fingerprint(const ModelInstance& root, ModelFingerprint& out) {
  ContentHash model, simulation;
  add(model, simulation, root);
  out.model = model.text();
  out.simulation = simulation.text();
}

}  // namespace floatframe
