// xdot = A x + B u, y = C x + D u, of the inputs u, with the values y: the first one is its force;
// sampled: x_k+1 = A x_k + B u_k.
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/linear_block.hpp"

namespace floatframe {

namespace {

template <class S>
void state_space_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  linear_block_law(in, out);
}

}  // namespace

FLOATFRAME_LAW(state_space)

namespace {

constexpr Eigen::Index most_block_states = 200;

constexpr ElementKey matrix_key(const char* name, const char* about, KeyMember member) {
  return {.name = name, .kind = KeyKind::matrix, .about = about, .member = member};
}
constexpr auto state_space_keys = with_sampling<StateSpaceBlock>(
    {{.name = "file",
      .kind = KeyKind::linear_file,
      .about = "with A, B, C, D and the names of inputs and outputs; or ..."},
     {.name = "inputs",
      .kind = KeyKind::signals,
      .about = "u; one need not be a list; of a file also a map of its inputs, others are 0",
      .required = true,
      .axis = ElementAxis::none,
      .member = described_by<&StateSpaceBlock::inputs>},
     matrix_key("A", "... n x n, of n states", described_by<&StateSpaceBlock::A>),
     matrix_key("B", "a row for each state, a column for each input; of one input also a list",
                described_by<&StateSpaceBlock::B>),
     matrix_key("C", "a row of n numbers for each value", described_by<&StateSpaceBlock::C>),
     matrix_key("D", "a row for each value, a number for each input; without it 0",
                described_by<&StateSpaceBlock::D>),
     {.name = "outputs",
      .kind = KeyKind::names,
      .about = "of the values, without them their numbers from 1",
      .member = described_by<&StateSpaceBlock::outputs>},
     block_start_key(described_by<&StateSpaceBlock::initial>)});

void state_space_validate(const ElementCheck& check) {
  validate_sampling(check);
  const auto& keys = std::get<StateSpaceBlock>(check.description().kind);
  const Eigen::Index n = keys.A.rows(), m = std::ssize(keys.inputs), p = keys.C.rows();
  if (check.wrong.contains("file")) return;
  const auto expect = [&](const char* key, Eigen::Index rows, Eigen::Index columns) {
    const MatX M = check.matrix(key);
    if (check.wrong.contains(key) || M.size() == 0) return;
    if (M.rows() != rows || M.cols() != columns)
      check.error(ErrorCode::wrong_count, key,
                  sentences::matrix_size(M.rows(), M.cols(), rows, columns));
  };
  if (m == 0 && !check.wrong.contains("inputs"))
    check.error(ErrorCode::missing, "inputs", sentences::no_signals());
  const bool none = keys.A.size() == 0 && keys.B.size() == 0 && keys.C.size() == 0;
  if (none && check.wrong.empty())
    return check.error(ErrorCode::incomplete, "", sentences::none_given({"file", "A"}));
  for (const char* key : {"A", "B", "C"})
    if (!check.wrong.contains(key) && check.matrix(key).size() == 0)
      check.error(ErrorCode::missing, "", std::string("missing key '") + key + "'");
  if (check.wrong.contains("A") || n == 0) return;
  if (n > most_block_states)
    check.error(ErrorCode::too_large, "A", sentences::too_many_states(n, most_block_states));
  expect("A", n, n);
  expect("C", p, n);
  if (!keys.outputs.empty() && std::ssize(keys.outputs) != p && !check.wrong.contains("C"))
    check.error(ErrorCode::wrong_count, "outputs",
                sentences::names_of_values(keys.outputs.size(), p));
  if (check.wrong.contains("inputs") || m == 0) return;
  const auto column = [&](const MatX& M, Eigen::Index rows) {
    return m == 1 && M.rows() == 1 && M.cols() == rows;
  };
  if (!column(keys.B, n)) expect("B", n, m);
  if (!column(keys.D, p)) expect("D", p, m);
}

std::vector<ElementValue> state_space_values(const ElementKeys& all) {
  const auto& keys = std::get<StateSpaceBlock>(all);
  std::vector<ElementValue> values;
  for (const std::string& name : keys.outputs) values.push_back({name, "-"});
  if (!values.empty() || keys.C.rows() < 2) return values;
  for (Eigen::Index k = 1; k <= keys.C.rows(); ++k) values.push_back({std::to_string(k), "-"});
  return values;
}

void state_space_states(Element& element) {
  const auto& keys = *std::get_if<StateSpaceBlock>(element.keys.get());
  const Eigen::Index n = keys.A.rows(), m = std::ssize(keys.inputs), p = keys.C.rows();
  take_linear_block(element,
                    {keys.A,
                     keys.B.reshaped(n, m),
                     keys.C,
                     keys.D.size() > 0 ? MatX(keys.D.reshaped(p, m)) : MatX(MatX::Zero(p, m)),
                     {}},
                    keys.initial, keys);
}

ElementExample state_space_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  StateSpaceBlock f;
  f.inputs = {x.linked_signal(numbers), x.signal(numbers), x.linked_signal(numbers)};
  f.A = MatX(2, 2);
  f.B = MatX(2, 3);
  f.C = MatX(2, 2);
  f.D = MatX(2, 3);
  for (MatX* M : {&f.A, &f.B, &f.C, &f.D})
    for (Eigen::Index i = 0; i < M->size(); ++i) (*M)(i) = numbers(-3.0, 3.0);
  if (regime == 1) f.period = 0.1, f.delay = 0.25;
  return block_example(std::move(x), std::move(f), numbers);
}

}  // namespace

constinit const ElementKind state_space_element = [] {
  auto kind = block_kind<StateSpaceBlock>(
      "a linear system with states, of several inputs and with several values", state_space_keys);
  kind.validate = state_space_validate;
  kind.states = state_space_states;
  kind.values = state_space_values;
  kind.start = start_linear_block;
  kind.sample = sample_linear_block;
  kind.dual = state_space_law<Dual>;
  kind.regimes = sampled_regimes;
  return kind;
}();

constinit const ExampleMaker state_space_examples = state_space_example;

}  // namespace floatframe
