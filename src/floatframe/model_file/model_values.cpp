#include "floatframe/model_file/model_values.hpp"

#include <charconv>

#include "floatframe/formulas/syntax_tree.hpp"
#include "floatframe/yaml/yaml_tree.hpp"

namespace floatframe {
namespace {

using Kind = ModelValue::Kind;

/// An unquoted scalar, as the reader of model files takes it.
void read_scalar(const std::string& text, ModelValue& out) {
  out.kind = Kind::text;
  out.text = text;
  if (text.find("${") != std::string::npos) return;
  const PlainScalar scalar = classify_plain_scalar(text);
  if (scalar.kind == PlainScalar::Kind::null) out.kind = Kind::nothing;
  if (scalar.kind == PlainScalar::Kind::boolean) out.kind = Kind::truth;
  out.truth = scalar.boolean;
  if (scalar.kind != PlainScalar::Kind::number) return;
  out.number = scalar.number;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, out.whole);
  out.kind = error == std::errc() && rest == end ? Kind::whole : Kind::number;
}

ModelValue value_of_node(const YamlNode& node) {
  ModelValue out;
  if (node.kind == YamlNode::Kind::scalar && node.quoted) {
    out.kind = Kind::text;
    out.text = node.text;
  } else if (node.kind == YamlNode::Kind::scalar) {
    read_scalar(node.text, out);
  } else if (node.kind == YamlNode::Kind::sequence) {
    out.kind = Kind::list;
    for (const YamlNode& item : node.items) out.items.push_back(value_of_node(item));
  } else if (node.kind == YamlNode::Kind::map) {
    out.kind = Kind::map;
    for (const YamlEntry& entry : node.entries) {
      out.keys.push_back(entry.key);
      out.items.push_back(value_of_node(entry.value));
    }
  }
  return out;
}

}  // namespace

ModelValue model_values(const std::string& text, const std::string& file) {
  ReadErrors errors;
  const YamlDocument document = parse_yaml(file, text, errors);
  if (!errors.empty()) throw InputError(errors.take());
  return value_of_node(document.root);
}

}  // namespace floatframe
