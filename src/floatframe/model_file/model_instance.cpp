#include "floatframe/model_file/model_instance.hpp"

#include "floatframe/core/enum_index.hpp"
#include "floatframe/description/sentences.hpp"

namespace floatframe {

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
  const auto& table = names[index_of(kind)];
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
  for (const auto& [name, active] : names[index_of(kind)])
    if (active) out.push_back(name);
  for (const auto& [name, target] : external)
    if (!target.empty()) out.push_back(name);
  for (const auto& [key, instance] : children)
    for (const std::string& n : instance->known(kind))
      if (n != ground_name) out.push_back(key + "." + n);
  return out;
}

std::string ModelInstance::no_entity(EntityKind kind, const std::string& name, bool off) const {
  const std::string word = entity_words[index_of(kind)];
  if (const auto e = external.find(name); e != external.end()) {
    if (e->second.empty()) return "";
    return "the external name '" + name + "' is not connected to a " + word;
  }
  if (refused_names.contains(name)) return "";
  if (off) return "the " + word + " '" + name + "' is switched off by its 'when'";
  return "unknown " + word + " '" + name + "'" +
         context.errors->suggestion(name, [&] { return known(kind); });
}

std::optional<std::string> ModelInstance::reference(EntityKind kind, const YamlValue& value) const {
  const std::string word = entity_words[index_of(kind)];
  const auto name = value.text(("the name of a " + word).c_str());
  if (!name) return std::nullopt;
  bool off = false;
  const auto full = resolve(kind, *name, &off);
  if (full) return full;
  const std::string complaint = no_entity(kind, *name, off);
  if (!complaint.empty()) value.error(ErrorCode::not_found, complaint);
  return std::nullopt;
}

std::optional<std::string> ModelInstance::moving_body(const std::string& name,
                                                      const YamlValue& entry) const {
  bool off = false;
  auto full = resolve(EntityKind::body, name, &off);
  if (full && *full != ground_name) return full;
  const std::string complaint =
      full ? sentences::ground_is_no_body() : no_entity(EntityKind::body, name, off);
  if (!complaint.empty())
    entry.entity_error(full ? ErrorCode::wrong_value : ErrorCode::not_found, complaint);
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
    value.not_known("unknown point '" + *name + "'", *name, [&] { return known_points(); });
    return std::nullopt;
  }
  if (!p->allFinite()) return std::nullopt;  // an invalid point
  return p;
}

}  // namespace floatframe
