// The value of a formula of the motion, of inputs, of results of other elements and of the time
// (formulas/formula.hpp). What it refers to is found when the model is built (build_formulas.cpp).
// Its switches are its branches (formula_branches.hpp).
#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/formula_branches.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

namespace {

double measured_value(const MeasurePorts<double>& in) noexcept {
  return output_kind(in.output.type).value(in);
}
Dual measured_value(const MeasurePorts<Dual>& in) noexcept {
  return output_kind(in.output.type).dual(in);
}

template <class S>
S mirrored_value(const FormulaOperand& x, const S& value) noexcept {
  return x.factor == 1.0 && x.offset == 0.0 ? value : S(x.factor * value + x.offset);
}

template <class S>
S operand_value(const PortsOf<S>& in, const FormulaOperand& x) noexcept {
  switch (x.kind) {
    case FormulaOperand::Kind::time:
      return in.t;
    case FormulaOperand::Kind::input:
      return in.input(x.index);
    case FormulaOperand::Kind::link:
      return in.links[in.element.signals[x.index].link];
    case FormulaOperand::Kind::sample:
      return mirrored_value(x, in.state(in.element.states + x.index));
    case FormulaOperand::Kind::measure:
      break;
  }
  const auto at = [&](int k) { return x.ports[k] < 0 ? nullptr : &in.marker(x.ports[k]); };
  const double reference = x.angle < 0 ? 0.0 : in.angles[x.angle];
  return mirrored_value(x, measured_value(MeasurePorts<S>{in.model, x.output, at(0), at(1), at(2),
                                                          at(3), in.origin, reference}));
}

template <class S>
S formula_value(const PortsOf<S>& in, FormulaSwitches& switches, FormulaFault& fault) noexcept {
  const Formula& f = *in.template keys<FormulaValue>().formula;
  return evaluate_formula<S>(
      f, [&](int i) { return operand_value(in, in.element.operands[i]); }, switches, fault);
}

template <class S>
void formula_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  FormulaSwitches switches = switches_of_branch(in.branch);
  FormulaFault fault;
  out.force = formula_value(in, switches, fault);
}

BranchSide formula_side(const Ports& in) noexcept {
  return formula_branch_side(in.branch, [&](FormulaSwitches& switches, FormulaFault& fault) {
    formula_value(in, switches, fault);
  });
}

std::string formula_complaint(const Ports& in) {
  FormulaSwitches switches = switches_of_branch(in.branch);
  FormulaFault fault;
  formula_value(in, switches, fault);
  return fault_text(*in.keys<FormulaValue>().formula, fault);
}

}  // namespace

FLOATFRAME_LAW(formula)

namespace {

constexpr ElementKey formula_keys[] = {
    {.name = "formula",
     .kind = KeyKind::formula,
     .about = "of measures, inputs, results of elements and the time `t`",
     .required = true,
     .member = described_by<&FormulaValue::formula>}};

constexpr ElementRegime formula_regimes[] = {
    {.name = "measures", .conservative = false, .acts = false},
    {.name = "switches", .conservative = false, .acts = false}};

ElementExample formula_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  FormulaValue keys;
  keys.formula = formula(regime == 0 ? "3 * sin(z) * vx ^ 2 + d / (2 + u) + t * s + rate"
                                     : "if(z < vx, clip(z * d, -1e3, 1e3), u * abs(z) + s * d) + "
                                       "max(vx, rate, t)");
  x.t = numbers(0.0, 1.0);
  for (int k = 0; k < 3; ++k) x.markers.push_back(numbers.marker());
  x.inputs = {numbers(1.0, 3.0)};
  x.model.inputs.emplace_back().name = "u";
  x.links.push_back(numbers(-2.0, 2.0));
  x.keys(keys);
  x.element.signals.emplace_back().link = 0;
  const auto operand = [](FormulaOperand::Kind kind) {
    FormulaOperand m;
    m.kind = kind;
    m.index = 0;
    return m;
  };
  // The n-th measure of points, of two points or of bodies.
  const auto measure = [&](OutputOf of, int n, int component, std::array<int, 4> ports) {
    FormulaOperand m = operand(FormulaOperand::Kind::measure);
    m.ports = ports;
    for (const OutputType type : output_types)
      if (output_kind(type).of == of && output_kind(type).value && n-- == 0) m.output.type = type;
    m.output.component = component;
    m.output.marker = ports[0];
    m.output.to = ports[1];
    m.output.relative = ports[2];
    m.output.axes = ports[3];
    return m;
  };
  for (const FormulaReference& r : keys.formula->references)
    x.element.operands.push_back(r.name == "z"    ? measure(OutputOf::point, 0, 2, {0, -1, 1, 2})
                                 : r.name == "vx" ? measure(OutputOf::point, 1, 0, {1, -1, 0, 0})
                                 : r.name == "d"
                                     ? measure(OutputOf::two_points, 0, 0, {0, 2, -1, -1})
                                 : r.name == "rate" ? measure(OutputOf::body, 1, 1, {2, -1, -1, 0})
                                 : r.name == "u"    ? operand(FormulaOperand::Kind::input)
                                 : r.name == "s"    ? operand(FormulaOperand::Kind::link)
                                                    : operand(FormulaOperand::Kind::time));
  return x;
}

}  // namespace

constinit const ElementKind formula_element = {.about = "the value of a formula",
                                               .keys = formula_keys,
                                               .list = ElementList::controllers,
                                               .energy = EnergyCategory::loads,
                                               .axis = ElementAxis::none,
                                               .measured = false,
                                               .blank = [] { return ElementKeys(FormulaValue()); },
                                               .build = [](ElementBuild&) { return true; },
                                               .complaint = formula_complaint,
                                               .dual = formula_law<Dual>,
                                               .side = formula_side,
                                               .regimes = formula_regimes};

constinit const ExampleMaker formula_examples = formula_example;

}  // namespace floatframe
