#include "floatframe/model_file/resolved_text.hpp"

#include <nlohmann/json.hpp>

#include "floatframe/model_file/model_instance.hpp"

namespace floatframe {
namespace {

/// In quotes a text stays a text, whatever its form.
std::string quoted_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string scalar_text(const YamlNode& node, const ParameterScope& scope) {
  if (node.text.find("${") != std::string::npos) {
    try {
      const ParameterValue value = substitute_parameters(node.text, scope, false);
      const auto* text = std::get_if<std::string>(&value);
      return text ? quoted_text(*text) : value_text(value);
    } catch (const ExpressionError&) {  // a disabled entity
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

/// The text after "key:" or "-": the rest of the line, or indented lines below it.
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

std::string resolved_text(const ModelInstance& root) {
  std::string out;
  append_instance(out, root);
  return out;
}

}  // namespace floatframe
