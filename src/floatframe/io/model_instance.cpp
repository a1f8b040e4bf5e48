#include "floatframe/io/model_instance.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>

#include "floatframe/core/printable.hpp"

namespace floatframe {
namespace {

constexpr int most_instances = 1000;

std::string joined(const std::vector<std::string>& words) {
  std::string s;
  for (const std::string& w : words) s += (s.empty() ? "" : ", ") + w;
  return s;
}

class Loader {
 public:
  Loader(ModelFiles& files, ReadFaults& faults) : files_(files), faults_(faults) {}

  std::unique_ptr<ModelInstance> open(const YamlDocument* document, ModelInstance* outer) {
    auto instance = std::make_unique<ModelInstance>();
    instance->document = document;
    instance->outer = outer;
    instance->context = {&document->file, &instance->scope, &faults_};
    return instance;
  }

  /// `given`: parameters set from outside (name, value, place).
  struct Given {
    std::string name;
    ParameterValue value;
    SourceMark mark;
    std::string subject;    // "subsystems.left.parameters" or "--set"
    std::string raw;        // as it was written on the command line: the value of a text
    std::string complaint;  // why it is neither a number nor true or false, though it looks so
  };

  /// "--set name=value". A text is taken as it is written; quotes around it may be there.
  std::optional<Given> override_value(const ParameterOverride& o, const std::string& path) {
    const SourceMark mark{path, 0, 0};
    const auto refuse = [&](const std::string& why) {
      faults_.add(mark, "--set " + o.name + "=" + o.value.substr(0, 100) + ": " + why);
      return std::nullopt;
    };
    if (o.value.size() > longest_text)
      return refuse("found a text of " + std::to_string(o.value.size()) +
                    " characters, expected at most " + std::to_string(longest_text));
    if (printable(o.value) != o.value)
      return refuse("expected UTF-8 text without control characters");
    Given given{o.name, {}, mark, "--set", {}, {}};
    const std::size_t n = o.value.size();
    if (n > 2 && (o.value[0] == '\'' || o.value[0] == '"') && o.value[n - 1] == o.value[0]) {
      given.raw = o.value.substr(1, n - 2);
      given.value = given.raw;
      return given;
    }
    if (o.value.find("${") != std::string::npos) {
      try {
        given.value = substitute_parameters(o.value, {});
      } catch (const ExpressionError& error) {
        return refuse(error.what());
      }
      return given;
    }
    const PlainScalar p = classify_plain_scalar(o.value);
    if (p.kind == PlainScalar::Kind::null) return refuse("found nothing, expected a value");
    given.raw = o.value;
    given.value = given.raw;
    if (p.kind == PlainScalar::Kind::number) given.value = p.number;
    if (p.kind == PlainScalar::Kind::boolean) given.value = p.boolean;
    given.complaint = p.complaint;
    return given;
  }

  void fill(ModelInstance& self, const std::vector<Given>& given, std::vector<std::string>& stack) {
    const YamlValue top(self.context, self.document->root, "");
    if (!top.is_map()) {
      faults_.add({self.document->file, self.document->root.line, self.document->root.column},
                  "found " + top.found() + ", expected a map of keys such as 'bodies'");
      return;
    }
    if (!faults_.take_of(
            "values in all files together (each counted as often as it is used)",
            self.document->values, limits::total_values,
            {self.document->file, self.document->root.line, self.document->root.column}, ""))
      return;
    if (!self.root) self.root.emplace(top);
    YamlSection& root = *self.root;
    if (const auto version = root.require("floatframe")) {
      const auto v = version->number(any_number(""));
      if (v && *v != 1.0)
        version->fault("found version " + number_text(*v) + ", this program reads version 1");
    }
    parameters(self, given);
    if (const auto points = root.get("points")) {
      const Vec3 wrong = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
      for (auto& [name, value] : points->named("a map of names to points [x, y, z]"))
        self.points.emplace(name, value.vector("m").value_or(wrong));
    }
    for (std::size_t k = 0; k < entity_keys.size(); ++k) collect_names(self, k);
    if (!faults_.exhausted()) subsystems(self, stack);
  }

 private:
  void parameters(ModelInstance& self, const std::vector<Given>& given) {
    std::multimap<std::string, std::size_t> by_name;  // in the order given
    for (std::size_t i = 0; i < given.size(); ++i) by_name.emplace(given[i].name, i);
    std::vector<bool> used(given.size(), false);
    std::vector<std::string> known;
    if (const auto list = self.root->get("parameters")) {
      const auto declared = list->named("a map of names to values");
      std::set<std::string> hiding;  // not declared yet, but will hide a constant
      for (const auto& [name, value] : declared) {
        known.push_back(name);
        if (is_constant_name(name)) hiding.insert(name);
      }
      for (const auto& [name, value] : declared) {
        if (!is_identifier(name) || is_reserved_name(name)) {
          faults_.add(
              value.entity_mark(),
              value.path() +
                  (is_reserved_name(name)
                       ? ": the name is used by the expression language"
                       : ": found a hyphen, expected letters, digits and _ in a parameter name"));
          continue;
        }
        for (const std::string& later : hiding)
          if (value.is_scalar() && mentions(value.node().text, later))
            value.fault("found " + value.found() + ", but the parameter '" + later +
                        "', which takes the place of the constant, is declared later; expected it "
                        "before its uses");
        hiding.erase(name);
        auto v = value.parameter();
        for (auto [it, end] = by_name.equal_range(name); it != end; ++it) {
          const Given& g = given[it->second];
          used[it->second] = true;
          if (v && v->index() == 2 && !g.raw.empty())
            v = g.raw;
          else if (!g.complaint.empty())
            faults_.add(g.mark, g.subject + " " + name + "=" + g.raw + ": found " + g.raw + " (" +
                                    g.complaint + ")");
          else if (v && v->index() != g.value.index())
            faults_.add(g.mark, g.subject + "." + name + ": found " + shown(g.value) +
                                    ", expected " + type_name(*v));
          else
            v = g.value;
        }
        // A parameter that is wrong still exists, so that its uses are not faults too.
        if (v && v->index() == 2 &&
            !faults_.take_of("characters in the texts of all parameters",
                             std::get<std::string>(*v).size(), limits::parameter_text, value.mark(),
                             value.path()))
          v = std::string("?");
        self.scope.emplace(name, v.value_or(1.0));
      }
    }
    for (std::size_t i = 0; i < given.size(); ++i)
      if (!used[i])
        faults_.add(given[i].mark, given[i].subject + ": unknown parameter '" + given[i].name +
                                       "'" +
                                       faults_.suggestion(given[i].name, [&] { return known; }));
  }

  /// True if an expression in `text` uses `name`.
  static bool mentions(std::string_view text, std::string_view name) {
    const auto part_of_name = [&](std::size_t k) {
      return k < text.size() && is_identifier(std::string("_") + text[k]);
    };
    for (std::size_t open = text.find("${"); open != std::string_view::npos;
         open = text.find("${", open)) {
      const std::size_t close = std::min(text.find('}', open), text.size());
      for (std::size_t k = text.find(name, open); k < close; k = text.find(name, k + 1))
        if (!part_of_name(k - 1) && !part_of_name(k + name.size())) return true;
      open = close;
    }
    return false;
  }

  static std::string shown(const ParameterValue& v) {
    std::string text = value_text(v);
    if (v.index() == 2) {
      text.insert(text.begin(), '\'');
      text += '\'';
    }
    return text;
  }

  void collect_names(ModelInstance& self, std::size_t kind) {
    const auto list = self.root->get(entity_keys[kind]);
    if (!list) return;
    for (auto& [name, value] : list->named("a map of names")) {
      bool active = true;
      if (value.is_map())
        for (const YamlEntry& e : value.node().entries)
          if (e.key == "when")
            active = YamlValue(self.context, e, value.path() + ".when").boolean().value_or(true);
      if (kind == 0 && name == ground_name) {
        faults_.add(value.entity_mark(),
                    value.path() + ": the name 'ground' is taken by the ground");
        continue;
      }
      if (active && !faults_.take_of(entity_keys[kind], 1, limits::entities, value.entity_mark(),
                                     value.path()))
        active = false;
      self.names[kind].emplace(name, active);
    }
  }

  void subsystems(ModelInstance& self, std::vector<std::string>& stack) {
    const auto list = self.root->get("subsystems");
    if (!list) return;
    for (auto& [name, value] : list->named("a map of names")) {
      auto section = value.section();
      if (!section) continue;
      if (const auto when = section->get("when"))
        if (!when->boolean().value_or(true)) continue;
      const auto file_value = section->require("file");
      std::vector<Given> given;
      if (const auto p = section->get("parameters"))
        for (auto& [key, v] : p->named("a map of names to values"))
          if (const auto x = v.parameter())
            given.push_back({key, *x, v.entity_mark(), p->path(), {}, {}});
      Placement placement;
      if (const auto p = section->get("position"))
        if (const auto v = p->vector("m")) placement = translation(*v);
      if (const auto m = section->get("mirror")) placement = mirrors(*m) * placement;
      std::vector<std::pair<std::string, YamlValue>> connections;
      if (const auto c = section->get("connect"))
        connections = c->named("a map of external names to names");
      section->finish();
      if (faults_.exhausted()) return;
      if (!file_value) continue;
      const auto file = file_value->text("the name of a subsystem file");
      if (!file) continue;
      if (++instances_ > most_instances) {
        if (instances_ == most_instances + 1)
          file_value->fault("found more than " + std::to_string(most_instances) +
                            " subsystems, expected fewer");
        continue;
      }
      const std::string full = (std::filesystem::path(self.document->file).parent_path() / *file)
                                   .lexically_normal()
                                   .string();
      std::error_code ignored;
      const std::string canonical = std::filesystem::weakly_canonical(full, ignored).string();
      bool recursive = false;
      for (const std::string& s : stack) recursive = recursive || s == canonical;
      if (recursive) {
        file_value->fault("'" + full + "' includes itself");
        continue;
      }
      const YamlDocument* document = files_.load(full, file_value->mark(), file_value->path());
      if (!document) continue;
      auto child = open(document, &self);
      child->prefix = self.prefix + name + ".";
      child->placement = placement;
      child->world = self.world * placement;
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
        faults_.add(value.entity_mark(), value.path() + ": '" + child.document->file +
                                             "' has no external name '" + name + "'" +
                                             faults_.suggestion(name, [&] { return order; }));
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
        value.fault("'" + *target + "' is switched off by its 'when'");
      else if (!exists)
        value.fault("unknown name '" + *target + "'" + faults_.suggestion(*target, known));
      child.external.emplace(name, exists ? *target : "");
    }
    std::vector<std::string> missing;
    for (const std::string& name : order)
      if (!given.count(name)) missing.push_back(name);
    for (const std::string& name : missing) child.external.emplace(name, "");
    if (!missing.empty())
      section.fault("'" + child.document->file + "' needs " + joined(missing) +
                    ", expected it in 'connect'");
  }

  ModelFiles& files_;
  ReadFaults& faults_;
  int instances_ = 0;
};

}  // namespace

ModelInstance* ModelInstance::child(const std::string& name) const {
  for (const auto& [key, instance] : children)
    if (key == name) return instance.get();
  return nullptr;
}

std::optional<std::string> ModelInstance::resolve(EntityKind kind, const std::string& name,
                                                  bool* off) const {
  if (kind == EntityKind::body && name == ground_name) return name;
  const auto e = external.find(name);
  if (e != external.end()) {
    if (!outer || e->second.empty()) return std::nullopt;
    return outer->resolve(kind, e->second, off);
  }
  const auto& table = names[static_cast<std::size_t>(kind)];
  if (const auto it = table.find(name); it != table.end()) {
    if (it->second) return prefix + name;
    if (off) *off = true;
    return std::nullopt;
  }
  const std::size_t dot = name.find('.');
  if (dot != std::string::npos)
    if (const ModelInstance* c = child(name.substr(0, dot)))
      return c->resolve(kind, name.substr(dot + 1), off);
  return std::nullopt;
}

std::vector<std::string> ModelInstance::known(EntityKind kind) const {
  std::vector<std::string> out;
  if (kind == EntityKind::body) out.emplace_back(ground_name);
  for (const auto& [name, active] : names[static_cast<std::size_t>(kind)])
    if (active) out.push_back(name);
  for (const auto& [name, target] : external)
    if (!target.empty()) out.push_back(name);
  for (const auto& [key, instance] : children)
    for (const std::string& n : instance->known(kind))
      if (n != ground_name) out.push_back(key + "." + n);
  return out;
}

std::optional<std::string> ModelInstance::reference(EntityKind kind, const YamlValue& value) const {
  const std::string word = entity_words[static_cast<std::size_t>(kind)];
  const auto name = value.text(("the name of a " + word).c_str());
  if (!name) return std::nullopt;
  bool off = false;
  const auto full = resolve(kind, *name, &off);
  if (full) return full;
  const auto e = external.find(*name);
  if (e != external.end()) {
    if (!e->second.empty())
      value.fault("the external name '" + *name + "' is not connected to a " + word);
    return std::nullopt;  // the missing connection is a fault already
  }
  if (off)
    value.fault("the " + word + " '" + *name + "' is switched off by its 'when'");
  else
    value.fault("unknown " + word + " '" + *name + "'" +
                context.faults->suggestion(*name, [&] { return known(kind); }));
  return std::nullopt;
}

std::string ModelInstance::written(const std::string& full) const {
  return full.compare(0, prefix.size(), prefix) == 0 ? full.substr(prefix.size()) : full;
}

std::optional<Vec3> ModelInstance::point(const std::string& name) const {
  if (const auto it = points.find(name); it != points.end()) return it->second;
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) return std::nullopt;
  const ModelInstance* c = child(name.substr(0, dot));
  if (!c) return std::nullopt;
  const auto p = c->point(name.substr(dot + 1));
  if (!p) return std::nullopt;
  return c->placement.point(*p);
}

std::vector<std::string> ModelInstance::known_points() const {
  std::vector<std::string> out;
  for (const auto& [name, p] : points) out.push_back(name);
  for (const auto& [key, instance] : children)
    for (const std::string& n : instance->known_points()) out.push_back(key + "." + n);
  return out;
}

std::optional<Vec3> ModelInstance::read_point(const YamlValue& value) const {
  if (value.is_list()) return value.vector("m");
  const auto name = value.text("the name of a point or [x, y, z]");
  if (!name) return std::nullopt;
  const auto p = point(*name);
  if (!p) {
    value.fault("unknown point '" + *name + "'" +
                context.faults->suggestion(*name, [&] { return known_points(); }));
    return std::nullopt;
  }
  if (!p->allFinite()) return std::nullopt;  // a point that is wrong itself
  return p;
}

const YamlDocument* ModelFiles::load(const std::string& file, const SourceMark& where,
                                     const std::string& subject) {
  for (const auto& [name, document] : documents_)
    if (name == file) return document.get();
  std::string text;
  if (!read_text_file(file, text, faults_, where, subject)) return nullptr;
  const std::size_t before = faults_.size();
  auto document = std::make_unique<YamlDocument>(parse_yaml(file, text, faults_));
  // Nothing was understood: no second fault about missing keys.
  if (faults_.size() > before && document->root.line == 0) document.reset();
  documents_.emplace_back(file, std::move(document));
  return documents_.back().second.get();
}

std::size_t ModelFiles::order(const std::string& file) const {
  for (std::size_t i = 0; i < documents_.size(); ++i)
    if (documents_[i].first == file) return i;
  return documents_.size();
}

std::unique_ptr<ModelInstance> load_instances(const std::string& path,
                                              const std::vector<ParameterOverride>& overrides,
                                              ModelFiles& files, ReadFaults& faults) {
  const YamlDocument* document = files.load(path, {}, "");
  if (!document) return nullptr;
  Loader loader(files, faults);
  auto root = loader.open(document, nullptr);
  std::vector<Loader::Given> given;
  for (const ParameterOverride& o : overrides)
    if (auto value = loader.override_value(o, path)) given.push_back(std::move(*value));
  std::error_code ignored;
  std::vector<std::string> stack{std::filesystem::weakly_canonical(path, ignored).string()};
  const YamlValue top(root->context, document->root, "");
  if (top.is_map()) {
    root->root.emplace(top);
    if (const auto e = root->root->get("external")) {
      faults.add(e->entity_mark(),
                 "external: this file is a subsystem, expected it to be used by a model file that "
                 "connects its "
                 "external names");
      if (e->is_list())
        for (const YamlValue& item : e->list())
          if (item.is_scalar()) root->external.emplace(item.node().text, "");
    }
  }
  loader.fill(*root, given, stack);
  return root;
}

}  // namespace floatframe
