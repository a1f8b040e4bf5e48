// Formulas of signals as elements of their own, and what the references of formulas stand for.
#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>

#include "floatframe/core/suggest.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/formulas/function_words.hpp"
#include "floatframe/model/curve_keys.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/model_builder.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

namespace {

SharedFormula formula_of(const Element& element) {
  const ElementDescription described{element.name, *element.keys, {}};
  for (const ElementKey& key : element_keys(element.type))
    if (key.kind == KeyKind::formula)
      if (const auto value = key_value(described, key)) return std::get<SharedFormula>(*value);
  return nullptr;
}

/// Finds what the references of one formula are.
class FormulaConnection {
 public:
  /// `key`: that of the entity with this origin, which holds the formula; `owner`: of the formula,
  /// in names of elements.
  FormulaConnection(ModelBuilder& builder, const Origin& origin, std::string path,
                    const std::string& key, std::string owner)
      : b_(builder),
        origin_(origin),
        path_(std::move(path)),
        owner_(std::move(owner)),
        mark_(origin.of(key)) {}
  virtual ~FormulaConnection() = default;

  std::vector<FormulaOperand> connect(const Formula& f) {
    std::vector<FormulaOperand> operands;
    mirror_ = f.mirror;
    for (const FormulaReference& r : f.references) {
      FormulaOperand x;
      if (r.is_time() || (r.delayed            ? delayed(delay_name(owner_, f, r), x)
                          : r.function.empty() ? named(r, x)
                                               : called(r, x)))
        operands.push_back(std::move(x));
    }
    return operands;
  }

 protected:
  /// The reference is this output.
  virtual void take(const Output& out, FormulaOperand& x) {
    x.kind = FormulaOperand::Kind::sample;
    x.output = out;
    x.output.factor = 1.0;
  }
  ModelBuilder& b_;

 private:
  bool connected(const Output& out, FormulaOperand& x) {
    const OutputOf of = output_kind(out.type).of;
    if (of == OutputOf::formula || of == OutputOf::crossing)
      return wrong(ErrorCode::unsupported, sentences::formula_of_a_formula(out.name));
    take(out, x);
    return reflected(out, x);
  }
  /// The value that the subsystem of the formula would have without its mirrors.
  bool reflected(const Output& out, FormulaOperand& x) const {
    const OutputKind& kind = output_kind(out.type);
    const Placement mirror{mirror_.P.asDiagonal(), mirror_.t};
    if (mirror.identity()) return true;
    if (kind.of == OutputOf::joint) {
      x.factor = mirrored_sign(b_.model.joints[out.joint].type, out.component, mirror);
      return true;
    }
    if (kind.reflects == Reflects::no) return true;
    const auto c = out.component - (std::ssize(kind.components.words) - 3);  // -1: a scalar
    const bool axial = kind.reflects == Reflects::axial;
    if (c >= 0) x.factor = mirror_.P[c] * (axial ? mirror.det() : 1.0);
    const bool of_origin = kind.reflects == Reflects::point
                               ? out.relative < 0
                               : kind.about_point && kind.of == OutputOf::mass && out.marker < 0;
    if (!of_origin || mirror_.t.isZero(0.0)) return true;
    if (axial || out.axes >= 0)
      return wrong(ErrorCode::unsupported, sentences::off_the_mirror(out.name));
    x.offset = -x.factor * mirror_.t[c];
    return true;
  }
  bool wrong(ErrorCode code, const std::string& sentence) const {
    b_.errors.add(code, mark_, path_ + ": " + sentence);
    return false;
  }

  /// An input, a measure or an output.
  bool named(const FormulaReference& r, FormulaOperand& x) {
    if (const auto input = b_.input_names.find(r.name)) {
      x.kind = FormulaOperand::Kind::input;
      x.index = *input;
      return true;
    }
    std::vector<std::string> known{"t"};
    for (const InputDescription& i : b_.d.inputs) known.push_back(i.name);
    for (const auto* list : {&b_.model.measures, &b_.model.outputs})
      for (const Output& o : *list)
        if (o.name == r.name) return connected(o, x);
    for (const auto* list : {&b_.d.measures, &b_.d.outputs})
      for (const OutputDescription& o : *list) {
        if (o.name == r.name) return false;  // it has an error
        known.push_back(o.name);
      }
    return wrong(ErrorCode::not_found,
                 sentences::formula_name(r.name) + did_you_mean(r.name, known));
  }

  /// The value of an element, which has an error if there is none.
  bool delayed(const std::string& name, FormulaOperand& x) {
    return b_.element(ElementList::controllers, name) >= 0 && called({"controller", name, ""}, x);
  }

  /// A short form or the word of an output, and the entity that it is of.
  bool called(const FormulaReference& r, FormulaOperand& x) {
    OutputDescription o;
    o.entity = r.name;
    o.origin = origin_;
    std::string word = r.function;
    if (word == "angle") word = "joint_position";
    if (word == "rate" && b_.joint_names.find(r.name)) {
      if (b_.element(ElementList::forces, r.name) >= 0)
        return wrong(ErrorCode::exclusive, sentences::rate_of_two(r.name));
      word = "joint_velocity";
    }
    const auto type = std::find(std::begin(output_words), std::end(output_words), word);
    if (type == std::end(output_words)) {
      std::vector<std::string> known{"angle"};
      known.insert(known.end(), std::begin(output_words), std::end(output_words));
      for (std::string& name : function_names(false)) known.push_back(std::move(name));
      return wrong(ErrorCode::not_found,
                   sentences::formula_function(r.function) + did_you_mean(r.function, known));
    }
    o.type = output_types[type - std::begin(output_words)];
    o.name = r.function + "(" + r.name + ")";
    if (!entity(r, o) || !detail(r, o)) return false;
    const std::optional<Output> out = b_.output(o, path_);
    return out && connected(*out, x);
  }

  /// Whether the entity exists; bodies by the origin of their frame.
  bool entity(const FormulaReference& r, OutputDescription& o) const {
    using Of = OutputOf;
    const auto none = [&](const char* kind, const std::vector<std::string>& known) {
      return wrong(ErrorCode::not_found, sentences::no_such_entity(r.function, kind, r.name) +
                                             did_you_mean(r.name, known));
    };
    switch (output_kind(o.type).of) {
      case Of::joint:
        return b_.joint_names.find(r.name) || none("joint", b_.joint_names.names());
      case Of::force: {
        const int k = b_.element(ElementList::forces, r.name);
        if (k < 0) return none("force", names_of(ElementList::forces));
        const ElementType type = b_.model.elements[k].type;
        return element_has(type, output_kind(o.type).needs) ||
               wrong(ErrorCode::wrong_value,
                     sentences::load_without(element_type_name(type), r.function));
      }
      case Of::controller:
        return of_list(ElementList::controllers, r) ||
               none("controller", names_of(ElementList::controllers));
      case Of::rod:
        return of_list(ElementList::rods, r) || none("rod", names_of(ElementList::rods));
      case Of::coupling:
        return of_list(ElementList::couplings, r) ||
               none("coupling", names_of(ElementList::couplings));
      case Of::path: {
        const int k = b_.element(ElementList::constraints, r.name);
        if (k < 0) return none("constraint", names_of(ElementList::constraints));
        return has_path(*b_.model.elements[k].keys) ||
               wrong(ErrorCode::wrong_value, sentences::no_path(r.name));
      }
      case Of::motion:
        return (b_.joint_names.find(r.name) && of_list(ElementList::motions, r)) ||
               none("motion", names_of(ElementList::motions));
      case Of::mass:
        o.whole = r.name == "model";
        if (o.whole) return true;
        [[fallthrough]];
      case Of::point:
      case Of::body: {
        const auto body = b_.body_names.find(r.name);
        if (!body) return none("body", b_.body_names.names());
        o.at.body = r.name;
        o.at.point = b_.d.bodies[*body].X_WB.p;
        return true;
      }
      default:
        return wrong(ErrorCode::unsupported, sentences::named_measures_only(r.function));
    }
  }
  bool of_list(ElementList list, const FormulaReference& r) const {
    return b_.element(list, r.name) >= 0;
  }
  std::vector<std::string> names_of(ElementList list) const {
    return b_.element_names[index_of(list)].names();
  }

  std::vector<std::string> values_of_force(const std::string& name) const {
    const int k = b_.element(ElementList::forces, name);
    return k < 0 ? std::vector<std::string>() : b_.model.elements[k].values;
  }

  /// The second argument: a component, or the number of a coordinate from 1.
  bool detail(const FormulaReference& r, OutputDescription& o) const {
    const OutputComponents& components = output_kind(o.type).components;
    if (components.key) {
      const auto& words = components.words;
      const auto at = std::find(words.begin(), words.end(), r.detail);
      o.component = at - words.begin();
      if (at != words.end()) return true;
      return wrong(ErrorCode::wrong_value,
                   sentences::formula_component(r.function, r.detail, words));
    }
    const OutputKind& kind = output_kind(o.type);
    if (kind.one_of_values &&
        (kind.of == OutputOf::controller || !values_of_force(r.name).empty())) {
      o.value = r.detail;
      return true;
    }
    const bool joint = output_kind(o.type).of == OutputOf::joint;
    if (!joint)
      return r.detail.empty() || wrong(ErrorCode::wrong_count, sentences::one_argument(r.function));
    const Joint& j = b_.model.joints[b_.joint_names.index(r.name)];
    const int n = joint_velocities(j.type);
    int number = n == 1 && r.detail.empty() ? 1 : 0;
    std::from_chars(r.detail.data(), r.detail.data() + r.detail.size(), number);
    o.component = number - 1;
    return (number >= 1 && number <= n) ||
           wrong(ErrorCode::out_of_range, sentences::formula_coordinate(r.name, r.detail, n));
  }

  const Origin& origin_;
  std::string path_, owner_;
  SourceMark mark_;
  FormulaMirror mirror_;
};

/// Of an element, within an iteration: measures by its markers, results by signals.
class ElementConnection final : public FormulaConnection {
 public:
  ElementConnection(ModelBuilder& builder, int element, const Origin& origin,
                    const std::string& path, const std::string& key)
      : FormulaConnection(builder, origin, path, key, builder.model.elements[element].name),
        element_(element) {}

 private:
  Element& element() const { return b_.model.elements[element_]; }
  void take(const Output& out, FormulaOperand& x) override {
    const OutputKind& kind = output_kind(out.type);
    if (kind.is_signal) return link(out, kind.needs, x);
    FormulaConnection::take(out, x);
    x.kind = FormulaOperand::Kind::measure;
    if (!kind.value) {
      x.kind = FormulaOperand::Kind::sample;
      x.index = element().kept++;
    } else if (kind.of == OutputOf::joint) {
      coordinate(out, x);
    } else {
      markers(measure_markers(b_.model, out), x);
    }
  }
  void link(const Output& out, ElementQuantity quantity, FormulaOperand& x) {
    Element& e = element();
    x.kind = FormulaOperand::Kind::link;
    x.index = std::ssize(e.signals);
    Signal& signal = e.signals.emplace_back();
    signal.link = std::ssize(b_.model.links);
    signal.given = true;
    b_.model.links.push_back({out.element, element_, x.index, quantity, 1.0, out.component});
  }
  int port_of(int marker) {
    std::vector<int>& ports = element().markers;
    const auto at = std::find(ports.begin(), ports.end(), marker);
    const auto port = at - ports.begin();
    if (at == ports.end()) ports.push_back(marker);
    return port;
  }
  void markers(const std::array<int, 4>& all, FormulaOperand& x) {
    for (std::size_t k = 0; k < all.size(); ++k)
      if (all[k] >= 0) x.ports[k] = port_of(all[k]);
  }
  /// The two markers of a joint; turns of an angle about the axis that they share are counted.
  void coordinate(const Output& out, FormulaOperand& x) {
    Element& e = element();
    const Joint& joint = b_.model.joints[out.joint];
    const std::array<int, 2> frames{joint.frame_F, joint.frame_M};
    const auto known =
        std::search(e.markers.begin(), e.markers.end(), frames.begin(), frames.end());
    const int port = known - e.markers.begin();
    if (known == e.markers.end()) e.markers.insert(e.markers.end(), frames.begin(), frames.end());
    x.ports = {port, port + 1, -1, -1};
    const auto axis = coordinate_axis(joint.type, joint.axis_2, out.component);
    if (!axis || !axis->turns) return;
    const auto counted = std::ranges::find_if(e.coordinates, [&](const CoordinatePort& c) {
      return c.joint == out.joint && c.component == out.component;
    });
    x.angle = counted - e.coordinates.begin();
    if (counted == e.coordinates.end())
      e.coordinates.push_back({out.joint, out.component, port, true});
  }

  int element_;
};

}  // namespace

ElementDescription ModelBuilder::with_formulas_apart(const ElementDescription& e,
                                                     ElementList list) {
  ElementDescription out = e;
  const auto apart = [&](SignalDescription& signal, const ElementKey& of, const std::string& key) {
    if (!signal.formula || signal.formula->is_of_time()) return;
    if (const SharedFormula local = as_local(e, of, *signal.formula)) {
      signal.formula = local;
      return;
    }
    const std::string path = std::string(element_list_name(list)) + "." + e.name + "." + key;
    const std::string name = e.name + "/" + key;  // no name of the user has a slash
    formulas.push_back({{name, FormulaValue{signal.formula}, e.origin}, path + ".formula"});
    signal.formula = nullptr;
    signal.source = SignalSource::controller;
    signal.element = name;
    signal.factor = 1.0;
  };
  for (const ElementKey& key : element_keys(e.type())) {
    auto value = key_value(e, key);
    if (!value) continue;
    if (auto* signal = std::get_if<SignalDescription>(&*value)) {
      apart(*signal, key, key.name);
    } else if (auto* signals = std::get_if<std::vector<SignalDescription>>(&*value)) {
      for (std::size_t k = 0; k < signals->size(); ++k)
        apart((*signals)[k], key, key.name + ("[" + std::to_string(k + 1) + "]"));
    } else {
      continue;
    }
    set_key_value(out, key, *value);
  }
  return out;
}

void ModelBuilder::connect_formulas() {
  std::map<std::string, std::pair<const Origin*, std::string>> written;  // of controllers
  for (const ElementDescription& e : d.controllers)
    written[e.name] = {&e.origin, "controllers." + e.name + ".formula"};
  for (const InnerFormula& inner : formulas)
    written[inner.element.name] = {&inner.element.origin, inner.path};
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const SharedFormula f = formula_of(model.elements[k]);
    if (!f) continue;
    const auto& [origin, path] = written.at(model.elements[k].name);
    const std::string& name = model.elements[k].name;
    const auto slash = name.find('/');  // of an inner formula: its key, which may have a number
    const std::string key =
        slash == std::string::npos
            ? "formula"
            : name.substr(slash + 1, name.find_first_of("[/", slash + 1) - slash - 1);
    model.elements[k].operands = ElementConnection(*this, k, *origin, path, key).connect(*f);
  }
  const auto connected = [&](const SharedFormula& f, const Origin& origin, const std::string& path,
                             const std::string& key, const std::string& owner) {
    return std::make_shared<OutputFormula>(
        OutputFormula{f, FormulaConnection(*this, origin, path, key, owner).connect(*f)});
  };
  if (const SharedFormula& until = d.simulation.until) {
    model.until.emplace().name = "until";
    const Origin& at = d.simulation.origin;
    model.until->formula = connected(until, at, "simulation.until", "until", "simulation");
  }
  const auto outputs_of = [&](std::vector<Output>& built,
                              const std::vector<OutputDescription>& described,
                              const std::string& list) {
    std::map<std::string, const OutputDescription*> with_formula;
    for (const OutputDescription& o : described)
      if (o.formula) with_formula[o.name] = &o;
    for (Output& out : built) {
      const auto it = with_formula.find(out.name);
      if (it == with_formula.end()) continue;
      const OutputDescription& o = *it->second;
      const char* key = output_type_name(o.type);
      out.formula = connected(o.formula, o.origin, list + o.name + "." + key, key, list + o.name);
    }
  };
  outputs_of(model.outputs, d.outputs, "outputs.");
  outputs_of(model.measures, d.measures, "measures.");
}

}  // namespace floatframe
