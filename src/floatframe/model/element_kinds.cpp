// Dispatch of the elements: data for load time, direct calls for step time.
#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/local_formula.hpp"
#include "floatframe/model/port_measures.hpp"

namespace floatframe {

namespace {

#define FLOATFRAME_KIND(name, Keys) &name##_element,
constexpr const ElementKind* element_list[] = {FLOATFRAME_ELEMENTS(FLOATFRAME_KIND)};
#undef FLOATFRAME_KIND

/// Calls f<type> for the element's type: a chain of comparisons with direct calls, up to the match.
template <std::size_t... I>
void evaluate_of(std::index_sequence<I...>, const Ports& in, Efforts& out) noexcept {
  (void)((in.element.type == static_cast<ElementType>(I) &&
          (efforts_of<static_cast<ElementType>(I)>(in, out), true)) ||
         ...);
}

using Types = std::make_index_sequence<std::size(element_types)>;

bool is_law(const ElementKey& key) noexcept {
  return key.kind == KeyKind::spring || key.kind == KeyKind::damper;
}
bool is_signal(const ElementKey& key) noexcept {
  return key.kind == KeyKind::load || key.kind == KeyKind::target ||
         key.kind == KeyKind::target_rate || key.kind == KeyKind::motion;
}
/// Of each of its ports.
std::vector<std::optional<SignalDescription>> signals_of(const ElementView& view,
                                                         const ElementKey& key) {
  if (is_signal(key)) return {view.signal(key.name)};
  if (key.kind != KeyKind::signals) return {};
  const auto all = std::get<std::vector<SignalDescription>>(*key_value(view.description(), key));
  return {all.begin(), all.end()};
}

}  // namespace

const ElementKind& element_kind(ElementType type) noexcept { return *element_list[index_of(type)]; }

EnergyCategory energy_category(ElementType type) noexcept { return element_kind(type).energy; }

std::vector<ElementType> types_of(ElementList list) {
  std::vector<ElementType> types;
  for (const ElementType type : element_types)
    if (element_kind(type).list == list) types.push_back(type);
  return types;
}

bool is_bearing(ElementType type) noexcept { return element_kind(type).bears; }

bool calls_program(ElementType type) noexcept {
  const std::span<const ElementKey> keys = element_keys(type);
  return std::any_of(keys.begin(), keys.end(),
                     [](const ElementKey& key) { return key.kind == KeyKind::function; });
}

bool ends_at_half_turn(const Element& element) noexcept {
  const auto ends = element_kind(element.type).ends_at_half_turn;
  return ends != nullptr && ends(element);
}

bool element_has(ElementType type, ElementQuantity quantity) noexcept {
  return quantity == ElementQuantity::force || element_kind(type).measured;
}

const char* element_output_unit(const Element& element, ElementQuantity quantity) noexcept {
  if (!element_has(element.type, quantity)) return "";
  const ElementAxis axis = element_kind(element.type).axis;
  if (axis == ElementAxis::none) return "-";
  const AxisUnits units = axis_units(axis == ElementAxis::about ||
                                     (axis == ElementAxis::coordinate && element.rotational));
  const char* of[] = {units.force, units.displacement, units.rate};
  return of[index_of(quantity)];
}

std::vector<ElementValue> values_of_element(const ElementKeys& keys) {
  const auto values = element_list[keys.index()]->values;
  return values ? values(keys) : std::vector<ElementValue>();
}
const char* value_unit(const Element& element, int value) {
  if (value == 0) return element_output_unit(element, ElementQuantity::force);
  return values_of_element(*element.keys)[value].unit;
}
std::vector<std::string> value_names(const ElementKeys& keys) {
  std::vector<std::string> names;
  for (ElementValue& value : values_of_element(keys)) names.push_back(std::move(value.name));
  return names;
}
int value_index(const std::vector<std::string>& names, const std::string& word) noexcept {
  const auto named = std::find(names.begin(), names.end(), word);
  if (word.empty() || named != names.end()) return word.empty() ? 0 : named - names.begin();
  int number = 0;
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool whole = failed == std::errc() && end == word.data() + word.size();
  return whole && number >= 1 && number <= std::max<int>(1, std::ssize(names)) ? number - 1 : -1;
}

ElementQuantity quantity_of(SignalSource source) noexcept {
  return source == SignalSource::length ? ElementQuantity::length
         : source == SignalSource::rate ? ElementQuantity::rate
                                        : ElementQuantity::force;
}

std::vector<std::optional<SignalDescription>> signal_values(const ElementDescription& element) {
  std::vector<std::optional<SignalDescription>> values;
  const ElementView view(element);
  for (const ElementKey& key : element_keys(element.type()))
    for (auto& signal : signals_of(view, key)) values.push_back(std::move(signal));
  return values;
}

int link_count(const Element& element) noexcept {
  int count = 0;
  for (const Signal& signal : element.signals) count += signal.link >= 0;
  return count;
}

std::vector<ElementSignal> signals_of(const Element& element) {
  std::vector<ElementSignal> out;
  const ElementDescription described{element.name, *element.keys, {}};
  std::size_t port = 0;
  for (const ElementKey& key : element_keys(element.type)) {
    std::size_t n = is_signal(key) || key.kind == KeyKind::signals
                        ? signals_of(ElementView(described), key).size()
                        : 0;
    if (n == 0) continue;
    const bool load = key.kind == KeyKind::load || key.kind == KeyKind::signals;
    const ElementQuantity quantity = load                               ? ElementQuantity::force
                                     : key.kind == KeyKind::target_rate ? ElementQuantity::rate
                                                                        : ElementQuantity::length;
    std::string what = key.name;
    std::replace(what.begin(), what.end(), '_', ' ');
    for (; n > 0; --n)
      if (const Signal& signal = element.signals[port++]; signal.given)
        out.push_back({&signal, what, !load, element_output_unit(element, quantity)});
  }
  return out;
}

int state_count(const Model& model) noexcept {
  int count = 0;
  for (const Element& e : model.elements) count += e.states;
  return count;
}

const char* symbol_name(Picture::Symbol symbol) noexcept {
  constexpr const char* names[] = {"none",  "bar",    "spring",  "ring",    "wheel",
                                   "force", "torque", "bearing", "bushing", "coupling"};
  return names[index_of(symbol)];
}

Picture picture_of(const Element& element) {
  const auto picture = element_kind(element.type).picture;
  return picture ? picture(element) : Picture();
}

std::vector<Stroke> strokes_of(const Model& model, const Element& element) {
  const auto strokes = element_kind(element.type).strokes;
  return strokes ? strokes(model, element) : std::vector<Stroke>();
}

bool is_wheel_of(const Model& model, const Element& element, int body) {
  const Picture picture = picture_of(element);
  return picture.symbol == Picture::Symbol::wheel && model.markers[picture.a].body == body;
}

const char* lifted_by(ElementType type) noexcept {
  const char* lifted = element_kind(type).lifted;
  return lifted ? lifted : "";
}

void lift(Element& element, const TimeFunction& height) {
  element.signals.back() = {.function = height, .given = true};
}

void take_keys(Element& element, const Model& model) {
  const ElementDescription d{element.name, *element.keys, {}};
  const ElementView values(d);
  element.type = d.type();
  element.laws.clear();
  element.signals.clear();
  const ElementKind& kind = element_kind(element.type);
  const bool gives_way = kind.gives_way == nullptr || kind.gives_way(*element.keys);
  element.acts = kind.dual != nullptr && gives_way;
  element.holds = kind.rows != nullptr && !(kind.gives_way && gives_way);
  element.reads = kind.list == ElementList::controllers;
  element.driven = calls_program(element.type);
  element.target_jumps = false;
  bool rate = false;
  for (const ElementKey& key : element_keys(element.type)) {
    if (is_law(key)) element.laws.push_back(values.law(key.name));
    for (const std::optional<SignalDescription>& s : signals_of(values, key)) {
      Signal signal;
      signal.given = s.has_value();
      if (s) {
        signal.function = *s;
        for (std::size_t k = 0; k < model.inputs.size(); ++k)
          if (model.inputs[k].name == s->input) signal.input = static_cast<int>(k);
      }
      if (const SharedFormula& f = signal.function.formula; f && !f->is_of_time()) {
        signal.local = local_formula(model, element.name + "/" + key.name, f);
        signal.function.formula = nullptr;
      }
      signal.differentiated = key.kind == KeyKind::target;
      element.driven = element.driven || signal.given;
      if (s && key.kind == KeyKind::target)
        element.target_jumps =
            signal.input >= 0 || s->source != SignalSource::none || !s->pieces.breaks().empty();
      rate = rate || (s && key.kind == KeyKind::target_rate);
      element.signals.push_back(std::move(signal));
    }
  }
  element.switched = std::ranges::any_of(
      element.signals, [](const Signal& s) { return s.local && s.local->formula->switches > 0; });
  element.values = value_names(*element.keys);
  element.states = element.kept = 0;
  if (const auto states = element_kind(element.type).states) states(element);
  for (Signal& signal : element.signals)
    signal.differentiated = signal.differentiated && signal.given && !rate;
  if (element_kind(element.type).lifted) element.signals.emplace_back();
}

template <class S>
SignalValue<S> PortsOf<S>::given_signal(const Signal& signal) const noexcept {
  const PiecewisePolynomial::Value value = evaluate(signal.function, t);
  SignalValue<S> out{value.f, value.df, value.ddf};
  if (signal.input >= 0) out.f += input(signal.input);
  if (signal.link >= 0) out.f += links[signal.link];
  return out;
}
template struct PortsOf<double>;
template struct PortsOf<Dual>;

void evaluate_element(const Ports& in, Efforts& out) noexcept {
  assert(out.markers() == in.element.markers.size());
  out.clear();
  evaluate_of(Types{}, in, out);
}

bool has_branches(const Element& element) noexcept {
  if (element_kind(element.type).side == nullptr || !element.acts) return false;
  if (const auto* keys = std::get_if<FormulaValue>(element.keys.get()))
    return keys->formula->switches > 0;
  if (element.switched) return true;
  if (const auto* keys = std::get_if<ForceLaw>(element.keys.get()))
    return keys->law.formula() && keys->law.formula()->switches > 0;
  return element.laws.empty() ||
         std::any_of(element.laws.begin(), element.laws.end(),
                     [](const PiecewisePolynomial& law) { return !law.edges().empty(); });
}

BranchSide branch_side(const Ports& in) noexcept { return element_kind(in.element.type).side(in); }

Mat3 element_axes(const ElementView& values) {
  const Vec3 z = values.direction("axis").stableNormalized(),
             v = values.direction("axis_2").stableNormalized();
  Mat3 R;
  R.col(2) = z;
  R.col(0) = (v - z.dot(v) * z).normalized();
  R.col(1) = z.cross(R.col(0));
  return R;
}

void validate_framed(const ElementCheck& check) {
  check.two_bodies("from", "to");
  if (!check.wrong.contains("axis") && !check.wrong.contains("axis_2"))
    if (const auto complaint =
            sentences::second_axis(check.direction("axis"), check.direction("axis_2")))
      check.error(ErrorCode::geometry, "axis_2", *complaint);
  check.some_law();
}

void validate_coordinate(const ElementCheck& check) {
  if (!check.good("joint")) return;
  const std::string joint = check.text("joint");
  const auto type = check.joint_type(joint);
  if (type && !joint_has_one_coordinate(*type))
    check.error(ErrorCode::wrong_value, "joint",
                "found '" + check.written(joint) + "', expected a " + joints_of_one_coordinate() +
                    " joint");
}

bool build_coordinate(ElementBuild& build) {
  return build.connect_coordinate(build.text("joint")) != nullptr;
}

Picture picture_of_coordinate(const Element& element) {
  return {.symbol = Picture::Symbol::ring,
          .a = element.markers[0],
          .b = element.markers[1],
          .axis = Vec3::UnitZ(),
          .axis_of = element.markers[0]};
}

void validate_line(const ElementCheck& check) {
  if (!check.two_bodies("from", "to")) return;
  const AttachmentDescription a = check.place("from"), b = check.place("to");
  if (!check.from_file && (a.node || b.node)) return;
  if (const auto complaint = sentences::spring_ends(a.point, b.point))
    check.error(ErrorCode::out_of_range, "", *complaint);
}

void validate_target(const ElementCheck& check) {
  if (check.given("spring") || check.given("damper")) return;
  for (const char* key : {"target", "target_rate"})
    if (check.given(key)) check.error(ErrorCode::incomplete, key, sentences::target_without_law());
}

bool build_line(ElementBuild& build) {
  const bool from = build.connect("from", false), to = build.connect("to", false);
  return from && to;
}

Picture picture_of_line(const Element& element) {
  return {.symbol = Picture::Symbol::spring, .a = element.markers[0], .b = element.markers[1]};
}

Picture picture_of_load(const Element& element, Picture::Symbol symbol, const AppliedLoad& load) {
  const int at = element.markers[0];
  return {.symbol = symbol, .a = at, .axis = load.direction, .axis_of = load.follows ? at : -1};
}

StretchSide stretch_side(const PiecewisePolynomial& f, std::size_t k, double x) noexcept {
  const std::vector<double>& edges = f.edges();
  constexpr double nowhere = -std::numeric_limits<double>::max();
  k = std::min(k, edges.size());
  const double left = k > 0 ? edges[k - 1] - x : nowhere;
  const double right = k < edges.size() ? x - edges[k] : nowhere;
  if (left > right) return {left, k - 1};
  return {right, std::min(k + 1, edges.size())};
}

BranchSide spring_side(const Ports& in, double x, double rate) noexcept {
  const PiecewisePolynomial &spring = in.element.laws[0], &damper = in.element.laws[1];
  if (in.branch == free_branch)
    return {-1.0, SpringBranch::of(spring.stretch_index(x), damper.stretch_index(rate))};
  const SpringBranch held{in.branch};
  const StretchSide s = stretch_side(spring, held.spring(), x);
  const StretchSide d = stretch_side(damper, held.damper(), rate);
  if (s.beyond > d.beyond) return {s.beyond, SpringBranch::of(s.next, held.damper())};
  return {d.beyond, SpringBranch::of(held.spring(), d.next)};
}

}  // namespace floatframe
