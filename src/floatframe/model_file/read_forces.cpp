// Elements.
#include <algorithm>

#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/coupled_coordinates.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model_file/linear_file.hpp"
#include "floatframe/model_file/read_parts.hpp"
#include "floatframe/yaml/read_table.hpp"

namespace floatframe {
namespace {

/// The keys of one element, according to the table of its type.
class ElementReader {
 public:
  ElementReader(const ModelInstance& self, ReadModel& model, YamlSection& s, ElementDescription& f)
      : self_(self), model_(model), s_(s), f_(f), check_(f) {}

  /// `on`: the coordinate that it acts on, of which its keys say nothing.
  void read(const CoordinateTerm* on) {
    const ElementKind& kind = element_kind(f_.type());
    for (const ElementKey& key : kind.keys) {
      if (on && (key.kind == KeyKind::joint || key.kind == KeyKind::own_coordinate)) {
        set_key_value(f_, key,
                      key.kind == KeyKind::joint ? KeyValue(on->joint) : KeyValue(on->coordinate));
        continue;
      }
      const std::size_t before = self_.context.errors->size();
      if (const auto value = read(key)) set_key_value(f_, key, *value);
      if (self_.context.errors->size() != before) check_.wrong.insert(key.name);
    }
    check_.from_file = true;
    check_.error = [&](ErrorCode code, const std::string& key, const std::string& sentence) {
      const auto value = key.empty() ? std::nullopt : s_.get(key.c_str());
      value ? value->error(code, sentence) : s_.error(code, sentence);
    };
    check_.written = [&](const std::string& name) { return self_.written(name); };
    check_.joint_type = [&](const std::string& joint) { return joint_type(joint); };
    if (kind.validate) kind.validate(check_);
    if (kind.reverse && reversed()) kind.reverse(f_);
  }

 private:
  /// The sign of its coordinate changes in the mirrored file.
  bool reversed() const {
    for (const CoordinateTerm& of : check_.coordinates())
      if (const auto type = joint_type(of.joint))
        return mirrored_sign(*type, std::max(0, of.coordinate), self_.world) < 0.0;
    return false;
  }
  std::optional<JointType> joint_type(const std::string& joint) const {
    const auto it = model_.joints.find(joint);
    return it == model_.joints.end() ? std::nullopt : std::optional(it->second);
  }

  AxisUnits units(const ElementKey& key) const {
    if (key.axis == ElementAxis::none) return {"", "", "", "", ""};
    bool turning = key.axis != ElementAxis::along;
    if (key.axis == ElementAxis::coordinate) {
      const std::vector<CoordinateTerm> of = check_.coordinates();
      const auto type = of.empty() ? std::nullopt : joint_type(of[0].joint);
      turning = !type || joint_unit(*type, std::max(0, of[0].coordinate)) == JointUnit::rad;
    }
    return axis_units(turning);
  }

  /// The free value of a law that is written as a number.
  double free_value(const ElementKey& key) const {
    const auto free = element_kind(f_.type()).free_value;
    return free && check_.wrong.empty() ? free(check_, key) : 0.0;
  }

  std::optional<KeyValue> stop(const ElementKey& key, const YamlValue& value) const {
    auto stop = value.section("a map with length and stiffness");
    if (!stop) return std::nullopt;
    const double length = stop->required_number("length", any_number("m"), 0.0);
    const double stiffness = stop->required_number("stiffness", positive_number("N/m"), 1.0);
    stop->finish();
    const bool bump = key.kind == KeyKind::bump_stop;
    const ElementKey& spring = check_.key(key.of);
    set_key_value(f_, spring,
                  check_.law(spring.name) +
                      (bump ? ramp_below(length, stiffness) : ramp_above(length, stiffness)));
    return std::nullopt;
  }

  std::optional<KeyValue> direction(const YamlValue& value, bool as_given) const {
    const auto v = read_direction(value);
    if (!v) return std::nullopt;
    return KeyValue(as_given ? *v : Vec3(v->stableNormalized()));
  }

  /// The rows of a matrix, with the given count of numbers each.
  static std::optional<KeyValue> rows_of(const std::vector<YamlValue>& rows, std::size_t columns) {
    const std::string what = std::to_string(columns) + " numbers";
    MatX M(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns));
    bool good = true;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto row = rows[i].numbers(columns, columns, any_number(""), what.c_str());
      if (row) M.row(static_cast<Eigen::Index>(i)) = VecX::Map(row->data(), M.cols()).transpose();
      good = good && row;
    }
    return good ? std::optional(KeyValue(std::move(M))) : std::nullopt;
  }

  /// 6 x 6 or 2 x 2
  static std::optional<KeyValue> matrix(const YamlValue& value) {
    const auto rows = value.list("6 rows of 6 numbers, or 2 rows of 2");
    if (!value.is_list()) return std::nullopt;
    if (rows.size() == 2 || rows.size() == 6) return rows_of(rows, rows.size());
    value.error(ErrorCode::wrong_count, sentences::force_matrix_rows(rows.size()));
    return std::nullopt;
  }

  static std::optional<KeyValue> speed_table(const YamlValue& value) {
    const auto rows = value.list("rows of 9 numbers: a speed, four stiffnesses, four dampings");
    return value.is_list() ? rows_of(rows, 9) : std::nullopt;
  }

  static std::optional<KeyValue> table(const YamlValue& value, const ElementKey& key) {
    const auto rows = value.list("rows of numbers");
    return value.is_list() ? rows_of(rows, key.words.size()) : std::nullopt;
  }

  static std::optional<KeyValue> matrix_of_any_size(const YamlValue& value, const ElementKey& key) {
    if (value.is_scalar()) {
      const auto x = value.number(key.rule);
      return x ? std::optional(KeyValue(MatX{{*x}})) : std::nullopt;
    }
    const auto rows = value.list("a number, a list of numbers, or rows of numbers");
    if (!value.is_list()) return std::nullopt;
    if (!rows.empty() && rows[0].is_list()) return rows_of(rows, rows[0].list().size());
    const auto row = value.numbers(1, rows.size(), key.rule, "a list of numbers");
    return row ? std::optional(KeyValue(MatX(MatX::Map(row->data(), 1, std::ssize(*row)))))
               : std::nullopt;
  }

  /// A list of signals, or one, or those of inputs of a file.
  std::optional<KeyValue> signals(const YamlValue& value) const {
    if (names_inputs(value, file_inputs_))
      return KeyValue(read_named_signals(self_, value, file_inputs_));
    std::vector<SignalDescription> all;
    const auto items = value.is_list() ? value.list() : std::vector<YamlValue>{value};
    for (const YamlValue& item : items)
      all.push_back(read_signal(self_, item, "", Interpolation::linear));
    if (!file_inputs_.empty() && all.size() != file_inputs_.size())
      value.error(ErrorCode::wrong_count, sentences::signals_of_file(all.size(), file_inputs_));
    return KeyValue(std::move(all));
  }

  /// Of the joint read before.
  std::optional<KeyValue> own_coordinate(const YamlValue& value) const {
    const std::vector<CoordinateTerm> of = check_.coordinates();
    const auto type = of.empty() ? std::nullopt : joint_type(of[0].joint);
    std::vector<std::string> words;
    for (int k = 0; type && k < joint_velocities(*type); ++k)
      words.push_back(joint_coordinate_key(*type, k));
    const auto k = words.empty() ? std::nullopt : value.word(words);
    return k ? std::optional(KeyValue(static_cast<int>(*k))) : std::nullopt;
  }

  /// The keys `joint` and `coordinate`.
  void take_coordinate(YamlSection& s, CoordinateTerm& term) const {
    if (const auto joint = s.require("joint"))
      term.joint = self_.reference(EntityKind::joint, *joint).value_or("");
    const auto word = s.get("coordinate");
    const auto type = joint_type(term.joint);
    if (!type || !word) return;
    std::vector<const char*> names;
    for (int k = 0; k < joint_velocities(*type); ++k)
      names.push_back(joint_coordinate_name(*type, k));
    if (const auto k = word->word(names)) term.coordinate = static_cast<int>(*k);
  }

  /// A joint, or {joint, coordinate}; its factor is the sign of the mirrored one.
  std::optional<KeyValue> coordinate(const YamlValue& value, ElementAxis what) const {
    CoordinateTerm term;
    if (value.is_scalar()) {
      term.joint = self_.reference(EntityKind::joint, value).value_or("");
    } else {
      auto s = value.section("a joint, or {joint, coordinate}");
      if (!s) return std::nullopt;
      take_coordinate(*s, term);
      s->finish();
    }
    if (const auto type = joint_type(term.joint))
      if (const int k = coupled_component(*type, term.coordinate, what); k >= 0)
        term.factor = mirrored_sign(*type, k, self_.world);
    return term.joint.empty() ? std::nullopt : std::optional(KeyValue(std::move(term)));
  }

  static std::optional<KeyValue> numbers(const YamlValue& value, const ElementKey& key) {
    const std::string what = "a list of " + std::to_string(key.words.size()) + " numbers";
    const auto row = value.numbers(key.words.size(), key.words.size(), key.rule, what.c_str());
    return row ? std::optional(KeyValue(MatX(MatX::Map(row->data(), 1, std::ssize(*row)))))
               : std::nullopt;
  }

  /// Factors of a mirrored file are those of the mirrored joints.
  std::optional<KeyValue> terms(const YamlValue& value) const {
    std::vector<CoordinateTerm> all;
    for (const YamlValue& item : value.list("a list of terms {joint, coordinate, factor}")) {
      auto s = item.section("a term {joint, coordinate, factor}");
      if (!s) continue;
      CoordinateTerm term;
      take_coordinate(*s, term);
      term.factor = s->number("factor", any_number(""), 1.0);
      s->finish();
      if (const auto type = joint_type(term.joint))
        term.factor *= mirrored_sign(*type, std::max(0, term.coordinate), self_.world);
      all.push_back(std::move(term));
    }
    return value.is_list() ? std::optional(KeyValue(std::move(all))) : std::nullopt;
  }

  static std::optional<KeyValue> word(const YamlValue& value, const ElementKey& key) {
    const auto k = value.word(key.words);
    return k ? std::optional(KeyValue(static_cast<int>(*k))) : std::nullopt;
  }

  /// Relative to the model file.
  std::optional<KeyValue> file(const YamlValue& value) const {
    const auto name = value.text("the name of a file");
    return name ? std::optional(KeyValue(sibling_path(self_, *name))) : std::nullopt;
  }

  std::optional<KeyValue> place_of(const YamlValue& value) const {
    auto section = value.section("a place {body, at}");
    return section ? read_attachment(self_, model_, *section) : std::nullopt;
  }

  std::optional<KeyValue> read(const ElementKey& key) {
    using K = KeyKind;
    if (key.kind == K::own_place) return read_attachment(self_, model_, s_, AttachedBy::own_keys);
    const auto value = key.required ? s_.require(key.name) : s_.get(key.name);
    if (!value) return std::nullopt;
    const AxisUnits u = units(key);
    switch (key.kind) {
      case K::own_place:
      case K::place:
        return place_of(*value);
      case K::joint:
        return self_.reference(EntityKind::joint, *value);
      case K::own_coordinate:
        return own_coordinate(*value);
      case K::road:
        return self_.reference(EntityKind::road, *value);
      case K::direction:
      case K::vector:
        return direction(*value, key.kind == K::vector);
      case K::number:
        return value->number(key.rule);
      case K::word:
        return word(*value, key);
      case K::flag:
        return value->boolean();
      case K::spring:
        return read_law(*value, free_value(key), {u.displacement, u.force, u.stiffness});
      case K::damper:
        return read_law(*value, 0.0, {u.rate, u.force, u.damping});
      case K::bump_stop:
      case K::rebound_stop:
        return stop(key, *value);
      case K::function:  // `validate` refuses its name unless a program gives the function
        return read_force_function(self_, *value);
      case K::points:
        return read_number_rows(*value, key.words, key.rule);
      case K::shape:
      case K::formula: {
        const bool shape = key.kind == K::shape;
        SharedFormula f = shape ? read_shape(self_, *value) : read_formula(self_, *value);
        return f ? std::optional(KeyValue(std::move(f))) : std::nullopt;
      }
      case K::stiffness_matrix:
      case K::damping_matrix:
        return matrix(*value);
      case K::speed_table:
        return speed_table(*value);
      case K::table:
        return table(*value, key);
      case K::matrix:
        return matrix_of_any_size(*value, key);
      case K::signals:
        return signals(*value);
      case K::names: {
        auto names = read_names(*value);
        return names ? std::optional(KeyValue(std::move(*names))) : std::nullopt;
      }
      case K::linear_file:
        file_inputs_ = take_linear_file(self_, *value, s_, f_);
        return std::nullopt;
      case K::file:
        return file(*value);
      case K::motion:
        return read_motion(self_, *value, u.displacement, Interpolation::cubic);
      case K::terms:
        return terms(*value);
      case K::coordinate:
        return coordinate(*value, key.axis);
      case K::numbers:
        return numbers(*value, key);
      case K::load:
        return read_signal(self_, *value, u.force, Interpolation::linear);
      case K::target:
        return read_signal(self_, *value, u.displacement, Interpolation::cubic);
      case K::target_rate:
        return read_signal(self_, *value, u.rate, Interpolation::linear);
    }
    return std::nullopt;
  }

  const ModelInstance& self_;
  ReadModel& model_;
  YamlSection& s_;
  ElementDescription& f_;
  ElementCheck check_;
  std::vector<std::string> file_inputs_;
};

}  // namespace

ElementDescription read_element(const ModelInstance& self, const std::string& name, YamlSection& s,
                                ElementType type, ReadModel& model, const CoordinateTerm* on) {
  ElementDescription e;
  e.name = self.prefix + name;
  e.origin = s.origin();
  e.kind = element_kind(type).blank();
  ElementReader(self, model, s, e).read(on);
  s.finish();
  place(e, self.world);
  return e;
}

// Lists of one type, which no key names.

namespace {

/// Of a list with one type, which no key names.
ElementType only_type(ElementList list) { return types_of(list).front(); }

}  // namespace

void read_rods(const ModelInstance& self, ReadModel& model) {
  for (auto& [name, s] : active_entities(self, EntityKind::rod))
    model.description.rods.push_back(
        read_element(self, name, s, only_type(ElementList::rods), model));
}

namespace {

/// Of a list whose entities name their types; in `couplings` the first one needs no name.
void read_typed(const ModelInstance& self, ReadModel& model, ElementList list, EntityKind kind,
                std::vector<ElementDescription>& out) {
  const std::vector<ElementType> types = types_of(list);
  std::vector<const char*> words;
  for (const ElementType type : types) words.push_back(element_type_name(type));
  for (auto& [name, s] : active_entities(self, kind)) {
    const bool optional = list == ElementList::couplings;
    const auto value = optional ? s.get("type") : s.require("type");
    const auto type = value      ? value->word(words)
                      : optional ? std::optional<std::size_t>(0)
                                 : std::nullopt;
    if (!type) continue;
    out.push_back(read_element(self, name, s, types[*type], model));
  }
}

}  // namespace

void read_constraints(const ModelInstance& self, ReadModel& model) {
  read_typed(self, model, ElementList::constraints, EntityKind::constraint,
             model.description.constraints);
}

void read_forces(const ModelInstance& self, ReadModel& model) {
  std::vector<ElementDescription>& forces = model.description.forces;
  const std::size_t before = forces.size();
  read_typed(self, model, ElementList::forces, EntityKind::force, forces);
  for (std::size_t k = before; k < forces.size(); ++k)
    model.element_types.emplace(forces[k].name, forces[k].type());
}

void read_couplings(const ModelInstance& self, ReadModel& model) {
  read_typed(self, model, ElementList::couplings, EntityKind::coupling,
             model.description.couplings);
}

void read_controllers(const ModelInstance& self, ReadModel& model) {
  read_typed(self, model, ElementList::controllers, EntityKind::controller,
             model.description.controllers);
}

}  // namespace floatframe
