// Springs k_i in series with dampers c_i along the line between two points, side by side. The state
// z_i is the elongation of damper i, measured so that its spring is free of force at s = z_i:
//   f_i = k_i (s - z_i),  c_i zdot_i = f_i
//   wrench       f n on a, -f n on b, f = sum f_i
//   row          with z following (element_evaluation.hpp): k_i (1 - dz_i/ds) n n^T,
//                dz_i/ds = (k_i/c_i) / (w + k_i/c_i); and f/s (I - n n^T)
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/port_measures.hpp"

namespace floatframe {

namespace {

template <class S>
void maxwell_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  const MatX& branches = in.template keys<Maxwell>().branches;
  const LineMeasure<S> line = line_measure(in);
  const Eigen::Index count = branches.rows();
  double stiffness = 0.0;
  S force = 0.0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double k = branches(i, 0), c = branches(i, 1);
    const S stretch = line.length - in.state(i), f = k * stretch, flow = f / c;
    force += f;
    out.state_rates[i] = flow;
    out.energy += 0.5 * k * stretch * stretch;
    out.energy_rate += f * (line.rate - flow);
    out.damping += f * flow;
    if constexpr (std::is_same_v<S, double>) {
      out.state_slopes[i * count + i] = -k / c;
      stiffness += k * (1.0 - k / c * in.followed(-k / c));
    }
  }
  pull_along(line, force, stiffness, 0.0, out);
}

}  // namespace

FLOATFRAME_LAW(maxwell)

namespace {

constexpr const char* maxwell_columns[] = {"stiffness [N/m]", "damping [N s/m]"};
constexpr ElementKey maxwell_keys[] = {place_key("from", "one end", described_by<&Maxwell::a>),
                                       place_key("to", "the other end", described_by<&Maxwell::b>),
                                       {.name = "branches",
                                        .kind = KeyKind::table,
                                        .about = "of each branch: its spring and its damper",
                                        .required = true,
                                        .rule = positive_number(""),
                                        .words = maxwell_columns,
                                        .member = described_by<&Maxwell::branches>}};

void maxwell_states(Element& element) {
  element.states = std::get_if<Maxwell>(element.keys.get())->branches.rows();
}

void maxwell_start(const Ports& in, double* states) noexcept {
  const double length = line_measure(in).length;
  for (int i = 0; i < in.element.states; ++i) states[i] = length;
}

constexpr ElementRegime maxwell_regimes[] = {{.name = "anywhere"}, {.name = "short"}};

ElementExample maxwell_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  Maxwell m;
  m.branches.resize(3, 2);
  for (Eigen::Index i = 0; i < 3; ++i)
    m.branches.row(i) << numbers(50.0, 300.0), numbers(1.0, 30.0);
  MarkerState a = numbers.marker(), b = numbers.marker();
  if (regime == 1) b.r = a.r + 0.1 * numbers.direction();
  x.markers = {a, b};
  x.keys(m);
  for (int i = 0; i < 3; ++i) x.states.push_back((b.r - a.r).norm() + numbers(-0.2, 0.2));
  x.state_weight = numbers(0.5, 200.0);
  return x;
}

}  // namespace

constinit const ElementKind maxwell_element = {
    .about =
        "springs in series with dampers along the line between two points, side by side; tension "
        "is positive; free of force at a start",
    .keys = maxwell_keys,
    .blank = [] { return ElementKeys(Maxwell()); },
    .validate = validate_line,
    .build = build_line,
    .states = maxwell_states,
    .start = maxwell_start,
    .along_line = true,
    .dual = maxwell_law<Dual>,
    .picture = picture_of_line,
    .regimes = maxwell_regimes};

constinit const ExampleMaker maxwell_examples = maxwell_example;

}  // namespace floatframe
