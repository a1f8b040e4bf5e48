#include "floatframe/model_file/model_fingerprint.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

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
      } catch (const ExpressionError&) {  // a part that is switched off, or an error of its own
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

/// In quotes a text stays a text, whatever it looks like.
std::string quoted_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string scalar_text(const YamlNode& node, const ParameterScope& scope) {
  if (node.text.find("${") != std::string::npos) {
    try {
      const ParameterValue value = substitute_parameters(node.text, scope, false);
      const auto* text = std::get_if<std::string>(&value);
      return text ? quoted_text(*text) : value_text(value);
    } catch (const ExpressionError&) {  // a part that is switched off
      return quoted_text(node.text);
    }
  }
  const bool plain = !node.quoted && node.text.find('\n') == std::string::npos;
  return plain ? node.text : quoted_text(node.text);
}

bool is_plain_key(const std::string& key) {
  for (const char c : key)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '.') return false;
  return !key.empty() && std::isalpha(static_cast<unsigned char>(key[0]));
}

/// What stands after "key:" or "-": the rest of the line, or lines of their own below it.
void append_node(std::string& out, const YamlNode& node, const ParameterScope& scope,
                 std::size_t indent) {
  switch (node.kind) {
    case YamlNode::Kind::null:
      out += '\n';
      return;
    case YamlNode::Kind::scalar:
      out += ' ' + scalar_text(node, scope) + '\n';
      return;
    case YamlNode::Kind::sequence:
      out += node.items.empty() ? " []\n" : "\n";
      for (const YamlNode& item : node.items) {
        out += std::string(indent, ' ') + '-';
        append_node(out, item, scope, indent + 2);
      }
      return;
    case YamlNode::Kind::map:
      out += node.entries.empty() ? " {}\n" : "\n";
      for (const YamlEntry& entry : node.entries) {
        out += std::string(indent, ' ') +
               (is_plain_key(entry.key) ? entry.key : quoted_text(entry.key)) + ':';
        append_node(out, entry.value, scope, indent + 2);
      }
      return;
  }
}

void append_instance(std::string& out, const ModelInstance& self) {
  if (!self.prefix.empty()) out += "--- # " + self.prefix.substr(0, self.prefix.size() - 1);
  if (!self.prefix.empty()) out += " (" + self.document->file + ")\n";
  for (const YamlEntry& entry : self.document->root.entries) {
    if (entry.key == "parameters") continue;
    out += (is_plain_key(entry.key) ? entry.key : quoted_text(entry.key)) + ':';
    append_node(out, entry.value, self.scope, 2);
  }
  for (const auto& [name, child] : self.children) append_instance(out, *child);
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

std::string resolved_text(const ModelInstance& root) {
  std::string out;
  append_instance(out, root);
  return out;
}

}  // namespace floatframe
