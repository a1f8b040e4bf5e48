// xdot = A x + B u, y = C x + D u, of the inputs u; sampled: x_k+1 = A x_k + B u_k.
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

constexpr ElementKey matrix_key(const char* name, const char* about, KeyMember member,
                                bool required = true) {
  return {.name = name,
          .kind = KeyKind::matrix,
          .about = about,
          .required = required,
          .member = member};
}
constexpr auto state_space_keys = with_sampling<StateSpaceBlock>(
    {{.name = "inputs",
      .kind = KeyKind::signals,
      .about = "u; one need not be a list",
      .required = true,
      .axis = ElementAxis::none,
      .member = described_by<&StateSpaceBlock::inputs>},
     matrix_key("A", "n x n, of n states", described_by<&StateSpaceBlock::A>),
     matrix_key("B", "a row for each state, a column for each input; of one input also a list",
                described_by<&StateSpaceBlock::B>),
     matrix_key("C", "a row of n numbers", described_by<&StateSpaceBlock::C>),
     matrix_key("D", "a number for each input; without it 0", described_by<&StateSpaceBlock::D>,
                false),
     block_start_key(described_by<&StateSpaceBlock::initial>)});

void state_space_validate(const ElementCheck& check) {
  validate_sampling(check);
  const auto& keys = std::get<StateSpaceBlock>(check.description().kind);
  const Eigen::Index n = keys.A.rows(), m = std::ssize(keys.inputs);
  const auto expect = [&](const char* key, Eigen::Index rows, Eigen::Index columns) {
    const MatX M = check.matrix(key);
    if (check.wrong.contains(key) || M.size() == 0) return;
    if (M.rows() != rows || M.cols() != columns)
      check.error(ErrorCode::wrong_count, key,
                  sentences::matrix_size(M.rows(), M.cols(), rows, columns));
  };
  if (m == 0 && !check.wrong.contains("inputs"))
    check.error(ErrorCode::missing, "inputs", sentences::no_signals());
  if (check.wrong.contains("A") || n == 0) return;
  expect("A", n, n);
  expect("C", 1, n);
  if (check.wrong.contains("inputs") || m == 0) return;
  if (m > 1 || keys.B.rows() != 1 || keys.B.cols() != n) expect("B", n, m);
  expect("D", 1, m);
}

void state_space_states(Element& element) {
  const auto& keys = *std::get_if<StateSpaceBlock>(element.keys.get());
  const Eigen::Index n = keys.A.rows(), m = std::ssize(keys.inputs);
  take_linear_block(element,
                    {keys.A,
                     keys.B.reshaped(n, m),
                     keys.C,
                     keys.D.size() > 0 ? keys.D : MatX(MatX::Zero(1, m)),
                     {}},
                    keys.initial, keys);
}

ElementExample state_space_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  StateSpaceBlock f;
  f.inputs = {x.linked_signal(numbers), x.signal(numbers), x.linked_signal(numbers)};
  f.A = MatX(2, 2);
  f.B = MatX(2, 3);
  f.C = MatX(1, 2);
  f.D = MatX(1, 3);
  for (MatX* M : {&f.A, &f.B, &f.C, &f.D})
    for (Eigen::Index i = 0; i < M->size(); ++i) (*M)(i) = numbers(-3.0, 3.0);
  if (regime == 1) f.period = 0.1, f.delay = 0.25;
  return block_example(std::move(x), std::move(f), numbers);
}

}  // namespace

constinit const ElementKind state_space_element = [] {
  auto kind = block_kind<StateSpaceBlock>(
      "a linear system with states, of several inputs and with one value", state_space_keys,
      state_space_example);
  kind.validate = state_space_validate;
  kind.states = state_space_states;
  kind.start = start_linear_block;
  kind.sample = sample_linear_block;
  kind.dual = state_space_law<Dual>;
  kind.regimes = sampled_regimes;
  return kind;
}();

}  // namespace floatframe
