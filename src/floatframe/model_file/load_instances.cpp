#include "floatframe/model_file/load_instances.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/enum_index.hpp"
#include "floatframe/model_file/instance_parameters.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {
namespace {

constexpr int most_instances = 1000;

class Loader {
 public:
  Loader(ModelFiles& files, ReadErrors& errors) : files_(files), errors_(errors) {}

  std::unique_ptr<ModelInstance> open(const YamlDocument* document, ModelInstance* outer) {
    auto instance = std::make_unique<ModelInstance>();
    instance->document = document;
    instance->outer = outer;
    instance->context = {&document->file, &instance->scope, &errors_, &files_.tables};
    return instance;
  }

  void fill(ModelInstance& self, const std::vector<GivenParameter>& given,
            std::vector<std::string>& stack) {
    const YamlValue top(self.context, self.document->root, "");
    if (!top.is_map()) {
      errors_.add(ErrorCode::wrong_value,
                  {self.document->file, self.document->root.line, self.document->root.column},
                  "found " + top.found() + ", expected a map of keys such as 'bodies'");
      return;
    }
    if (!errors_.take_of(
            "values in all files together (each counted as often as it is used)",
            self.document->values, limits::total_values,
            {self.document->file, self.document->root.line, self.document->root.column}, ""))
      return;
    if (!self.root) self.root.emplace(top);
    YamlSection& root = *self.root;
    if (const auto version = root.require("floatframe")) {
      const auto v = version->number(any_number(""));
      if (v && *v != 1.0)
        version->error(ErrorCode::mismatch,
                       "found version " + number_text(*v) + ", this program reads version 1");
    }
    read_parameters(self, given);
    if (const auto points = root.get("points")) {
      const Vec3 wrong = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
      for (auto& [name, value] : points->named("a map of names to points [x, y, z]"))
        self.points.emplace(name, value.vector("m").value_or(wrong));
    }
    read_tables(self);
    for (std::size_t k = 0; k < entity_keys.size(); ++k) collect_names(self, k);
    if (!errors_.exhausted()) subsystems(self, stack);
  }

 private:
  void collect_names(ModelInstance& self, std::size_t kind) {
    const auto list = self.root->get(entity_keys[kind]);
    if (!list) return;
    if (list->is_map())
      for (const YamlEntry& e : list->node().entries)
        if (!is_identifier(e.key, true)) self.refused_names.insert(e.key);
    for (auto& [name, value] : list->named("a map of names")) {
      bool active = true;
      if (value.is_map())
        for (const YamlEntry& e : value.node().entries)
          if (e.key == "when")
            active = YamlValue(self.context, e, value.path() + ".when").boolean().value_or(true);
      if (kind == 0 && name == ground_name) {
        value.entity_error(ErrorCode::duplicate, "the name 'ground' is taken by the ground");
        continue;
      }
      if (active && !errors_.take_of(entity_keys[kind], 1, limits::entities, value.entity_mark(),
                                     value.path()))
        active = false;
      self.names[kind].emplace(name, active);
      if (kind == index_of(EntityKind::joint) && value.is_map())
        for (const std::string& element : joint_element_names(name, value.node()))
          self.names[index_of(EntityKind::force)].emplace(element, active);
    }
  }

  void subsystems(ModelInstance& self, std::vector<std::string>& stack) {
    const auto list = self.root->get("subsystems");
    if (!list) return;
    for (auto& [name, value] : list->named("a map of names")) {
      auto section = value.section();
      if (!section) continue;
      if (!section->boolean("when", true)) continue;
      const auto file_value = section->require("file");
      std::vector<GivenParameter> given;
      if (const auto p = section->get("parameters"))
        for (auto& [key, v] : p->named("a map of names to values"))
          if (const auto x = v.parameter())
            given.push_back(
                {key,
                 *x,
                 v.entity_mark(),
                 p->path(),
                 {},
                 {},
                 v.node().text,
                 v.node().text.find("${") == std::string::npos ? nullptr : &self.scope});
      Placement placement;
      if (const auto p = section->get("position"))
        if (const auto v = p->vector("m")) placement = translation(*v);
      const Vec3 shift = self.shift + placement.t;
      if (const auto m = section->get("mirror")) placement = mirrors(*m) * placement;
      std::vector<std::pair<std::string, YamlValue>> connections;
      if (const auto c = section->get("connect"))
        connections = c->named("a map of external names to names");
      section->finish();
      if (errors_.exhausted()) return;
      if (!file_value) continue;
      const auto file = file_value->text("the name of a subsystem file");
      if (!file) continue;
      if (++instances_ > most_instances) {
        if (instances_ == most_instances + 1)
          file_value->error(
              ErrorCode::too_large,
              "found more than " + std::to_string(most_instances) + " subsystems, expected fewer");
        continue;
      }
      const std::string full = sibling_path(self, *file);
      std::error_code ignored;
      const std::string canonical = std::filesystem::weakly_canonical(full, ignored).string();
      if (std::find(stack.begin(), stack.end(), canonical) != stack.end()) {
        file_value->error(ErrorCode::cycle, "'" + full + "' includes itself");
        continue;
      }
      const YamlDocument* document = files_.load(full, file_value->mark(), file_value->path());
      if (!document) continue;
      auto child = open(document, &self);
      child->prefix = self.prefix + name + ".";
      child->placement = placement;
      child->world = self.world * placement;
      child->shift = shift;
      connect(self, *child, connections, *section);
      stack.push_back(canonical);
      fill(*child, given, stack);
      stack.pop_back();
      self.children.emplace_back(name, std::move(child));
    }
  }

  Placement mirrors(const YamlValue& value) {
    Placement x;
    for (const YamlValue& item : value.list("a list of planes {normal: x, at: 0}")) {
      auto plane = item.section("a plane {normal: x, at: 0}");
      if (!plane) continue;
      const auto normal = plane->require("normal");
      const auto axis = normal ? normal->word({"x", "y", "z"}) : std::nullopt;
      const double at = plane->number("at", any_number("m"), 0.0);
      plane->finish();
      if (axis) x = reflection(static_cast<int>(*axis), at) * x;
    }
    return x;
  }

  void connect(ModelInstance& self, ModelInstance& child,
               const std::vector<std::pair<std::string, YamlValue>>& connections,
               const YamlSection& section) {
    std::set<std::string> wanted;
    std::vector<std::string> order;
    const YamlValue top(child.context, child.document->root, "");
    if (top.is_map()) child.root.emplace(top);
    if (child.root)
      if (const auto e = child.root->get("external"))
        for (const YamlValue& item : e->list("a list of names"))
          if (const auto n = item.text("a name")) {
            if (n->size() > limits::name_length)
              item.unexpected("a name of at most " + std::to_string(limits::name_length) +
                              " characters");
            else if (wanted.insert(*n).second)
              order.push_back(*n);
          }
    std::set<std::string> given;
    for (const auto& [name, value] : connections) {
      const auto target = value.text("the name of a body or road");
      if (!wanted.count(name)) {
        value.entity_error(ErrorCode::not_found,
                           "'" + child.document->file + "' has no external name '" + name + "'" +
                               errors_.suggestion(name, [&] { return order; }));
        continue;
      }
      given.insert(name);
      if (!target) {
        child.external.emplace(name, "");
        continue;
      }
      bool exists = false, off = false;
      for (std::size_t k = 0; k < entity_words.size(); ++k)
        exists = exists || self.resolve(static_cast<EntityKind>(k), *target, &off);
      const auto known = [&] {
        std::vector<std::string> out;
        for (std::size_t k = 0; k < entity_words.size(); ++k)
          for (std::string& n : self.known(static_cast<EntityKind>(k))) out.push_back(std::move(n));
        return out;
      };
      if (!exists && off)
        value.error(ErrorCode::not_found, "'" + *target + "' is switched off by its 'when'");
      else if (!exists)
        value.not_known("unknown name '" + *target + "'", *target, known);
      child.external.emplace(name, exists ? *target : "");
    }
    std::string missing;
    for (const std::string& name : order) {
      if (given.contains(name)) continue;
      missing += (missing.empty() ? "" : ", ") + name;
      child.external.emplace(name, "");
    }
    if (!missing.empty())
      section.error(ErrorCode::incomplete, "'" + child.document->file + "' needs " + missing +
                                               ", expected it in 'connect'");
  }

  ModelFiles& files_;
  ReadErrors& errors_;
  int instances_ = 0;
};

}  // namespace

const YamlDocument* ModelFiles::load(const std::string& file, const SourceMark& where,
                                     const std::string& subject) {
  for (const auto& [name, document] : documents_)
    if (name == file) return document.get();
  std::string text;
  if (!read_text_file(file, text, errors_, where, subject)) return nullptr;
  return parse(file, text);
}

const YamlDocument* ModelFiles::parse(const std::string& file, const std::string& text) {
  const std::size_t before = errors_.size();
  auto document = parsed_ ? parsed_->get(file, text, errors_)
                          : std::make_shared<const YamlDocument>(parse_yaml(file, text, errors_));
  // The file could not be parsed: avoids further errors about missing keys.
  if (errors_.size() > before && document->root.line == 0) document.reset();
  documents_.emplace_back(file, std::move(document));
  return documents_.back().second.get();
}

void ModelFiles::give(const std::string& file, const std::string& text) {
  note_file_read(file, content_hash(text));
  parse(file, text);
}

std::size_t ModelFiles::order(const std::string& file) const {
  for (std::size_t i = 0; i < documents_.size(); ++i)
    if (documents_[i].first == file) return i;
  return documents_.size();
}

std::unique_ptr<ModelInstance> load_instances(const std::string& path,
                                              const std::vector<ParameterOverride>& overrides,
                                              ModelFiles& files, ReadErrors& errors) {
  const YamlDocument* document = files.load(path, {}, "");
  if (!document) return nullptr;
  Loader loader(files, errors);
  auto root = loader.open(document, nullptr);
  std::vector<GivenParameter> given;
  for (const ParameterOverride& o : overrides)
    if (auto value = read_override(o, path, errors)) given.push_back(std::move(*value));
  std::error_code ignored;
  std::vector<std::string> stack{std::filesystem::weakly_canonical(path, ignored).string()};
  const YamlValue top(root->context, document->root, "");
  if (top.is_map()) {
    root->root.emplace(top);
    if (const auto e = root->root->get("external")) {
      errors.add(ErrorCode::wrong_value, e->entity_mark(),
                 "external: this file is a subsystem, expected it to be used by a model file that "
                 "connects its external names");
      if (e->is_list())
        for (const YamlValue& item : e->list())
          if (item.is_scalar()) root->external.emplace(item.node().text, "");
    }
  }
  loader.fill(*root, given, stack);
  return root;
}

}  // namespace floatframe
