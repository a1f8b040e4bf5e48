// Result columns.
#include <iterator>
#include <span>

#include "floatframe/core/suggest.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {
namespace {

class OutputReader {
 public:
  OutputReader(const ModelInstance& self, ReadModel& model) : self_(self), model_(model) {}

  void read_all(const YamlValue& outputs) {
    for (const auto& [name, value] : outputs.named("a map of column names to quantities", true))
      read(name, value);
  }

 private:
  void read(const std::string& name, const YamlValue& value) {
    if (const auto complaint = sentences::column_name(name)) {
      value.entity_error(ErrorCode::wrong_value, *complaint);
      return;
    }
    auto s = value.section("a quantity, for example {position: body, axis: z}");
    if (!s || !s->boolean("when", true)) return;
    OutputDescription o;
    int found = 0;
    for (const OutputType type : output_types)
      if (s->get(output_type_name(type))) ++found, o.type = type;
    if (found != 1) return not_one_quantity(*s, found);
    o.origin = s->origin();
    const OutputKind& kind = output_kind(o.type);
    if (quantity(kind, *s, *s->get(output_type_name(o.type)), o))
      components(name, *s, o);
    else if (kind.components.key)
      s->get(kind.components.key);
    s->finish();
  }

  /// Stores a value that was read in its member; false if nothing was read.
  template <class Read, class Place>
  static bool put(std::optional<Read> read, Place& place) {
    if (read) place = std::move(*read);
    return read.has_value();
  }

  /// The quantity of the output; false after an error.
  bool quantity(const OutputKind& kind, YamlSection& s, const YamlValue& what,
                OutputDescription& o) {
    switch (kind.of) {
      case OutputOf::point:
        return put(point(what), o.at);
      case OutputOf::two_points:
        return two_points(what, o);
      case OutputOf::body:
        return put(moving_body(what), o.at.body);
      case OutputOf::joint:
        return joint(s, what, o);
      case OutputOf::mode:
        return mode(s, what, o);
      case OutputOf::force:
        return force(kind, what, o);
      case OutputOf::gauge:
        return gauge(s, what, o);
      case OutputOf::reaction:
        return reaction(s, what, o);
      case OutputOf::rod:
        return put(self_.reference(EntityKind::rod, what), o.entity);
      case OutputOf::coupling:
        return put(self_.reference(EntityKind::coupling, what), o.entity);
      case OutputOf::controller:
        return put(self_.reference(EntityKind::controller, what), o.entity);
      case OutputOf::motion:
        return put(self_.reference(EntityKind::joint, what), o.entity);
    }
    return false;
  }

  void add(const std::string& name, OutputDescription o) {
    o.name = self_.prefix + name;
    place(o, self_.world);
    ReadErrors& errors = *self_.context.errors;
    const bool exists = !model_.columns.insert(o.name).second;
    if (const auto complaint = sentences::column_taken(o.name, exists)) {
      errors.add(ErrorCode::duplicate, o.origin.mark, "outputs: " + *complaint);
      return;
    }
    if (!errors.take_of("columns", 1, limits::entities, o.origin.mark, "outputs")) return;
    model_.description.outputs.push_back(std::move(o));
  }

  void not_one_quantity(YamlSection& s, int found) {
    for (const OutputType type : output_types)
      if (const char* key = output_kind(type).components.key) s.get(key);
    for (const char* key : {"mode", "coordinate", "about", "in", "direction", "inertia_loads"})
      s.get(key);
    s.finish();
    if (found == 0 && misspelt_quantity(s)) return;  // already reported
    s.error(ErrorCode::wrong_count, "found " + std::to_string(found) +
                                        " quantities, expected one of " +
                                        alternatives(output_words));
  }

  /// A key similar to a quantity: the error "unknown key" is sufficient.
  static bool misspelt_quantity(const YamlSection& s) {
    const std::vector<std::string> quantities(std::begin(output_words), std::end(output_words));
    for (const YamlEntry& e : s.value().node().entries)
      if (!s.was_asked(e.key) && nearest(e.key, quantities)) return true;
    return false;
  }

  /// One component, all of them, or a scalar quantity.
  void components(const std::string& name, YamlSection& s, OutputDescription o) {
    const auto [key, words] = output_kind(o.type).components;
    if (!key) {
      add(name, o);
      return;
    }
    if (const auto v = s.get(key)) {
      if (const auto w = v->word(words)) {
        o.component = static_cast<int>(*w);
        add(name, o);
      }
      return;
    }
    for (std::size_t k = 0; k < words.size(); ++k) {
      o.component = static_cast<int>(k);
      add(name + "." + words[k], o);
    }
  }

  std::optional<std::string> moving_body(const YamlValue& value) {
    const auto body = self_.reference(EntityKind::body, value);
    if (body && *body == ground_name) {
      value.error(ErrorCode::wrong_value, sentences::ground_is_no_body());
      return std::nullopt;
    }
    return body;
  }

  /// An attachment point on a body, or the origin of the frame of a body.
  std::optional<AttachmentDescription> point(const YamlValue& what) {
    if (what.is_map()) {
      auto place_section = what.section();
      return place_section ? read_attachment(self_, model_, *place_section) : std::nullopt;
    }
    const auto body = moving_body(what);
    const auto origin = body ? frame_origin(self_, model_, *body) : std::nullopt;
    if (!origin) return std::nullopt;
    AttachmentDescription at;
    at.body = *body;
    at.point = *origin;
    return at;
  }

  bool two_points(const YamlValue& what, OutputDescription& o) {
    auto ends = what.section("two places, for example {from: body, to: body}");
    if (!ends) return false;
    const auto from = ends->require("from"), to = ends->require("to");
    ends->finish();
    const bool first = from && put(point(*from), o.at);
    return to && put(point(*to), o.to) && first;
  }

  bool force(const OutputKind& kind, const YamlValue& what, OutputDescription& o) {
    if (!put(self_.reference(EntityKind::force, what), o.entity)) return false;
    const auto type = model_.element_types.find(o.entity);
    if (type != model_.element_types.end() && !element_has(type->second, kind.needs))
      what.error(ErrorCode::wrong_value, sentences::load_without(element_type_name(type->second),
                                                                 output_type_name(o.type)));
    return true;
  }

  bool joint(YamlSection& s, const YamlValue& what, OutputDescription& o) {
    const bool known = put(self_.reference(EntityKind::joint, what), o.entity);
    const auto coordinate = s.get("coordinate");
    const auto it = model_.joints.find(o.entity);
    if (!known || it == model_.joints.end()) return false;
    const int n = joint_velocities(it->second);
    if (n == 0) {
      what.error(ErrorCode::wrong_value, sentences::weld_does_not_move());
    } else if (coordinate) {
      const auto k = coordinate->integer(1, n, "the number of a coordinate");
      if (k) o.component = *k - 1;
      return k.has_value();
    } else if (n > 1) {
      s.error(ErrorCode::missing, "missing key 'coordinate'");
    }
    return n == 1;
  }

  /// A joint by its name, a rod as {rod: name}; `about` a point, `in` some axes.
  bool reaction(YamlSection& s, const YamlValue& what, OutputDescription& o) {
    bool good = false;
    if (what.is_map()) {
      o.rod = true;
      if (auto rod = what.section("a joint, or {rod: name}")) {
        const auto value = rod->require("rod");
        good = value && put(self_.reference(EntityKind::rod, *value), o.entity);
        rod->finish();
      }
    } else {
      good = put(self_.reference(EntityKind::joint, what), o.entity);
    }
    if (const auto about = s.get("about")) {
      o.about = true;
      good = put(point(*about), o.at) && good;
      if (o.type != OutputType::joint_torque) {
        about->error(ErrorCode::incomplete, sentences::force_without_point());
        good = false;
      }
    }
    const auto in = s.get("in");
    return (!in || axes(*in, o)) && good;
  }

  bool axes(const YamlValue& in, OutputDescription& o) {
    if (in.is_map()) {
      o.in = OutputAxes::place;
      return put(point(in), o.to);
    }
    const auto word = in.word(std::span(rules::reaction_axes).first(index_of(OutputAxes::place)));
    if (!word) return false;
    o.in = static_cast<OutputAxes>(*word);
    if (!o.rod || o.in == OutputAxes::world) return true;
    in.error(ErrorCode::wrong_value, sentences::rod_has_no_axes());
    return false;
  }

  /// {body, node: name or number} or {body, at: point}, with `layer`, `material`, `toward` and
  /// `along` where there are several places.
  bool gauge(YamlSection& s, const YamlValue& what, OutputDescription& o) {
    const bool strain = o.type == OutputType::strain;
    const auto direction = strain ? s.require("direction") : std::nullopt;
    const auto loads = s.get("inertia_loads");
    bool good = place_of_gauge(what, o);
    good = direction_of(direction, o.gauge.direction) && good && (direction || !strain);
    return (!loads || put(loads->boolean(), o.gauge.inertia_loads)) && good;
  }

  bool place_of_gauge(const YamlValue& what, OutputDescription& o) {
    auto place = what.section("a place, for example {body: arm, node: 1204}");
    if (!place) return false;
    const auto body = place->require("body");
    const auto node = place->get("node"), at = place->get("at"), layer = place->get("layer"),
               toward = place->get("toward"), along = place->get("along"),
               material = place->get("material");
    place->finish();
    bool good = body && put(moving_body(*body), o.at.body);
    if (node.has_value() == at.has_value()) {
      place->error(node ? ErrorCode::exclusive : ErrorCode::missing,
                   node ? "'node' and 'at' exclude each other; remove one of them"
                        : "missing key 'node' or 'at'");
      good = false;
    } else {
      good = (at ? put(self_.read_point(*at), o.at.point) : node_of_gauge(*node, o)) && good;
    }
    if (layer) {
      const auto word = layer->word(rules::shell_layers);
      good = word && good;
      if (word) o.gauge.layer = static_cast<GaugeDescription::Layer>(*word + 1);
    }
    if (material) good = put(material->text("the name of a material"), o.gauge.material) && good;
    good = direction_of(along, o.gauge.along) && good;
    return direction_of(toward, o.gauge.toward) && good;
  }

  static bool direction_of(const std::optional<YamlValue>& value, Vec3& out) {
    return !value || put(read_direction(*value), out);
  }

  /// A whole number is a node number in the finite-element file.
  static bool node_of_gauge(const YamlValue& value, OutputDescription& o) {
    if (value.looks_like_number())
      return put(value.integer(1, 2147483647, "the number of a node"), o.gauge.node);
    return put(value.text("the number or the name of a node"), o.at.node);
  }

  bool mode(YamlSection& s, const YamlValue& what, OutputDescription& o) {
    const auto body = moving_body(what);
    const auto number = s.require("mode");
    if (!body || !number) return false;
    o.at.body = *body;
    const auto it = model_.bodies.find(*body);
    if (it == model_.bodies.end() || !it->second.valid) return false;
    if (!it->second.flexible) {
      what.error(ErrorCode::wrong_value,
                 sentences::rigid_body_has_no_modes(!it->second.named_nodes.empty()));
      return false;
    }
    const auto k =
        number->integer(1, it->second.modes < 0 ? 10000 : it->second.modes, "the number of a mode");
    if (k) o.component = *k - 1;
    return k.has_value();
  }

  const ModelInstance& self_;
  ReadModel& model_;
};

}  // namespace

void read_outputs(const ModelInstance& self, ReadModel& model) {
  if (!self.root) return;
  YamlSection root = *self.root;
  const auto value = root.get("outputs");
  if (!value) return;
  OutputReader(self, model).read_all(*value);
}

void read_added_outputs(const ModelInstance& root, ReadModel& model) {
  for (const std::string& text : model.options.outputs) {
    const YamlDocument document = parse_yaml("--add", text, *root.context.errors);
    if (document.root.line == 0) continue;  // parse error, already reported
    const ReadContext context{&document.file, &root.scope, root.context.errors};
    const YamlValue value(context, document.root, "outputs");
    OutputReader(root, model).read_all(value);
  }
}

void default_outputs(ReadModel& model) {
  for (const BodyDescription& b : model.description.bodies) {
    if (!b.rigid && !std::holds_alternative<RigidDescription>(b.kind)) continue;
    for (int k = 0; k < 3; ++k) {
      OutputDescription o;
      o.name = b.name + "." + "xyz"[k];
      o.type = OutputType::position;
      o.at.body = b.name;
      o.at.point = b.X_WB.p;
      o.component = k;
      o.origin.mark = b.origin.mark;
      model.columns.insert(o.name);
      model.description.outputs.push_back(std::move(o));
    }
  }
}

}  // namespace floatframe
