// Result columns.
#include <iterator>
#include <span>

#include "floatframe/core/suggest.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/model_file/linear_file.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {
namespace {

class OutputReader {
 public:
  /// Appends to `list`, whose key is `key`.
  OutputReader(const ModelInstance& self, ReadModel& model, const char* key,
               std::vector<OutputDescription>& list)
      : self_(self), model_(model), key_(key), list_(list) {}

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
    const bool known = quantity(kind, *s, *s->get(output_type_name(o.type)), o);
    const auto unit = s->get("unit");
    const bool in_unit = !unit || put(unit->text("a unit"), o.unit);
    if (frames(kind, *s, o) && in_unit && known)
      components(name, *s, o);
    else if (kind.components.key)
      s->get(kind.components.key);
    s->finish();
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
        return put(read_moving_body(self_, what), o.at.body);
      case OutputOf::mass:
        return mass(s, what, o);
      case OutputOf::flexible_point:
        return flexible_point(what, o);
      case OutputOf::state:
        return state(s, what, o);
      case OutputOf::joint:
        return joint(s, what, o);
      case OutputOf::mode:
        return mode(s, what, o);
      case OutputOf::force:
        return force(kind, s, what, o);
      case OutputOf::gauge:
        return read_gauge(self_, s, what, o);
      case OutputOf::reaction:
        return reaction(s, what, o);
      case OutputOf::formula:
      case OutputOf::crossing:
        o.formula = read_formula(self_, what);
        return o.formula != nullptr;
      case OutputOf::rod:
        return put(self_.reference(EntityKind::rod, what), o.entity);
      case OutputOf::coupling:
        return put(self_.reference(EntityKind::coupling, what), o.entity);
      case OutputOf::path:
        return put(self_.reference(EntityKind::constraint, what), o.entity);
      case OutputOf::controller:
        return controller(s, what, o);
      case OutputOf::motion:
        return put(self_.reference(EntityKind::joint, what), o.entity) && motion(s, o);
    }
    return false;
  }

  void add(const std::string& name, OutputDescription o) {
    o.name = self_.prefix + name;
    place(o, self_.world);
    ReadErrors& errors = *self_.context.errors;
    const bool exists = !model_.columns.insert(o.name).second;
    if (const auto complaint = sentences::column_taken(o.name, exists)) {
      errors.add(ErrorCode::duplicate, o.origin.mark, std::string(key_) + ": " + *complaint);
      return;
    }
    if (!errors.take_of("columns", 1, limits::entities, o.origin.mark, key_)) return;
    list_.push_back(std::move(o));
  }

  void not_one_quantity(YamlSection& s, int found) {
    for (const OutputType type : output_types)
      if (const char* key = output_kind(type).components.key) s.get(key);
    for (const char* key : {"mode", "coordinate", "number", "about", "in", "relative_to",
                            "direction", "inertia_loads", "output", "unit"})
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
    const auto [key, words, one] = output_kind(o.type).components;
    if (!key || (one && !s.has(key))) {
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

  /// An attachment point on a body, or the origin of the frame of a body.
  std::optional<AttachmentDescription> point(const YamlValue& what) {
    if (what.is_map()) {
      auto place_section = what.section();
      return place_section ? read_attachment(self_, model_, *place_section) : std::nullopt;
    }
    const auto body = read_moving_body(self_, what);
    const auto origin = body ? frame_origin(self_, model_, *body) : std::nullopt;
    if (!origin) return std::nullopt;
    AttachmentDescription at;
    at.body = *body;
    at.point = *origin;
    return at;
  }

  bool flexible_point(const YamlValue& what, OutputDescription& o) {
    if (!put(point(what), o.at)) return false;
    if (o.at.body != ground_name) return true;
    what.error(ErrorCode::wrong_value, sentences::ground_is_no_body());
    return false;
  }

  /// `model`, or a body; `about` a point.
  bool mass(YamlSection& s, const YamlValue& what, OutputDescription& o) {
    const auto about = output_kind(o.type).about_point ? s.get("about") : std::nullopt;
    o.about = about.has_value();
    const bool good = !about || put(point(*about), o.to);
    const auto name = what.text("the name of a body, or model");
    if (!name) return false;
    o.whole = *name == "model" && !self_.resolve(EntityKind::body, *name);
    return (o.whole || put(read_moving_body(self_, what), o.at.body)) && good;
  }

  bool state(YamlSection& s, const YamlValue& what, OutputDescription& o) {
    bool good = true;
    if (const auto number = s.get("number")) {
      const auto k = number->integer(1, 100, "the number of a state");
      good = put(k, o.component);
      --o.component;
    }
    const auto name = what.text("the name of a force element or of a controller");
    if (!name) return false;
    const bool controller =
        !self_.resolve(EntityKind::force, *name) && self_.resolve(EntityKind::controller, *name);
    const EntityKind kind = controller ? EntityKind::controller : EntityKind::force;
    return put(self_.reference(kind, what), o.entity) && good;
  }

  bool controller(YamlSection& s, const YamlValue& what, OutputDescription& o) {
    if (const auto value = s.get("output")) o.value = read_value_name(*value);
    return put(self_.reference(EntityKind::controller, what), o.entity);
  }

  /// The keys `relative_to` and `in` of a motion, after its subject.
  bool frames(const OutputKind& kind, YamlSection& s, OutputDescription& o) {
    const bool good = kind.frames != OutputFrames::relative_to_and_in ||
                      put_frame(s.get("relative_to"), o.relative);
    if (kind.frames == OutputFrames::none) return good;
    const auto in = s.get("in");
    if (in && !in->is_map())
      if (const auto name = in->text("the name of a body, world or child");
          name && (*name == "world" || *name == "child") &&
          !self_.resolve(EntityKind::body, *name)) {
        o.axes.emplace();
        if (*name == "world") return good;
        o.axes->body = o.at.body;
        if (o.whole)
          in->error(ErrorCode::wrong_value, "the model has no axes, expected world or a body");
        return good && !o.whole;
      }
    return put_frame(in, o.axes) && good;
  }

  /// The frame of a body by its name or {body}, or at a place {body, at}.
  bool put_frame(const std::optional<YamlValue>& value, std::optional<ReferenceDescription>& out) {
    if (!value) return true;
    ReferenceDescription x;
    auto s = value->is_map() ? value->section() : std::nullopt;
    x.place = s && (s->has("at") || s->has("node"));
    bool good;
    if (x.place) {
      good = put(read_attachment(self_, model_, *s), static_cast<AttachmentDescription&>(x));
    } else {
      const auto body = s ? s->require("body") : value;
      good = body && put(self_.reference(EntityKind::body, *body), x.body);
      if (s) s->finish();
    }
    if (good) out = x;
    return good;
  }

  bool two_points(const YamlValue& what, OutputDescription& o) {
    auto ends = what.section("two places, for example {from: body, to: body}");
    if (!ends) return false;
    const auto from = ends->require("from"), to = ends->require("to");
    ends->finish();
    const bool first = from && put(point(*from), o.at);
    return to && put(point(*to), o.to) && first;
  }

  bool force(const OutputKind& kind, YamlSection& s, const YamlValue& what, OutputDescription& o) {
    const auto value = kind.one_of_values ? s.get("output") : std::nullopt;
    if (value) o.value = read_value_name(*value);
    if (!put(self_.reference(EntityKind::force, what), o.entity)) return false;
    if (const auto type = model_.element_types.find(o.entity);
        type != model_.element_types.end() && !element_has(type->second, kind.needs))
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
      return number(*coordinate, n, o);
    } else if (n > 1) {
      s.error(ErrorCode::missing, "missing key 'coordinate'");
    }
    return n == 1;
  }

  static bool number(const YamlValue& coordinate, int n, OutputDescription& o) {
    const auto k = coordinate.integer(1, n, "the number of a coordinate");
    if (k) o.component = *k - 1;
    return k.has_value();
  }

  /// Of a joint with several driven coordinates the number of one.
  bool motion(YamlSection& s, OutputDescription& o) {
    for (const JointDescription& j : model_.description.joints) {
      if (j.name != o.entity || j.motions.empty()) continue;
      const auto coordinate = s.get("coordinate");
      o.component = j.motions[0].coordinate;
      if (coordinate) return number(*coordinate, joint_velocities(j.type), o);
      if (j.motions.size() > 1) s.error(ErrorCode::missing, "missing key 'coordinate'");
      return j.motions.size() == 1;
    }
    return true;
  }

  /// A joint by its name, {rod: name} or {constraint: name}; `about` a point, `in` some axes.
  bool reaction(YamlSection& s, const YamlValue& what, OutputDescription& o) {
    bool good = false;
    if (what.is_map()) {
      if (auto holder = what.section("a joint, {rod: name} or {constraint: name}")) {
        const auto constraint = holder->get("constraint");
        o.constraint = constraint.has_value();
        o.rod = !o.constraint;
        const auto value = constraint ? constraint : holder->require("rod");
        const EntityKind kind = o.rod ? EntityKind::rod : EntityKind::constraint;
        good = value && put(self_.reference(kind, *value), o.entity);
        holder->finish();
      }
    } else {
      good = put(self_.reference(EntityKind::joint, what), o.entity);
    }
    if (const auto about = s.get("about")) {
      o.about = true;
      good = put(point(*about), o.at) && good;
      if (!output_kind(o.type).about_point) {
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
    if ((!o.rod && !o.constraint) || o.in == OutputAxes::world) return true;
    in.error(ErrorCode::wrong_value, sentences::rod_has_no_axes());
    return false;
  }

  bool mode(YamlSection& s, const YamlValue& what, OutputDescription& o) {
    const auto body = read_moving_body(self_, what);
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
  const char* key_;
  std::vector<OutputDescription>& list_;
};

}  // namespace

void read_outputs(const ModelInstance& self, ReadModel& model) {
  if (!self.root) return;
  YamlSection root = *self.root;
  const auto read = [&](const char* key, std::vector<OutputDescription>& list) {
    if (const auto value = root.get(key)) OutputReader(self, model, key, list).read_all(*value);
  };
  read("outputs", model.description.outputs);
  read("measures", model.description.measures);
}

void read_added_outputs(const ModelInstance& root, ReadModel& model) {
  for (const std::string& text : model.options.outputs) {
    const YamlDocument document = parse_yaml("--add", text, *root.context.errors);
    if (document.root.line == 0) continue;  // parse error, already reported
    const ReadContext context{&document.file, &root.scope, root.context.errors};
    const YamlValue value(context, document.root, "outputs");
    OutputReader(root, model, "outputs", model.description.outputs).read_all(value);
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
