#pragma once
// A linear system as the law of an element, its data: zdot = A z + B u, y = C z + D u, with the
// inputs u, its only signals, and the values y; sampled (sampling.hpp) it is z_k+1 = A z_k + B u_k.
#include "floatframe/model/sampling_keys.hpp"

namespace floatframe {

struct LinearBlock {
  MatX A, B, C, D;
  MatX rest;  ///< z = rest u at a start; 0 x 0: z = 0
};

/// With A, B, C, D: the states of the element, and where they begin.
void take_linear_block(Element& element, LinearBlock block, BlockStart initial,
                       const Sampling& sampling = {});

template <class S>
S& value_of_block(EffortsOf<S>& out, Eigen::Index k) noexcept {
  return k == 0 ? out.force : out.further[k - 1];
}
template <class S>
void linear_block_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  if (holds_value(in, out)) return;
  const auto& block = in.template data<LinearBlock>();
  const Eigen::Index n = block.A.rows();
  for (Eigen::Index j = 0; j < block.B.cols(); ++j) {
    const S u = in.signal(j).f;
    for (Eigen::Index k = 0; k < block.D.rows(); ++k) value_of_block(out, k) += block.D(k, j) * u;
    for (Eigen::Index i = 0; i < n; ++i) out.state_rates[i] += block.B(i, j) * u;
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < block.C.rows(); ++k)
      value_of_block(out, k) += block.C(k, i) * in.state(i);
    for (Eigen::Index j = 0; j < n; ++j) {
      if (block.A(i, j) == 0.0) continue;
      out.state_rates[i] += block.A(i, j) * in.state(j);
      out.state_slopes[i * n + j] = block.A(i, j);
    }
  }
}

void start_linear_block(const Ports& in, double* states) noexcept;
void sample_linear_block(const Ports& in, double* own, double* y) noexcept;

inline constexpr const char* block_start_words[] = {"rest", "zero"};
constexpr ElementKey block_start_key(KeyMember member) {
  return {.name = "initial",
          .kind = KeyKind::word,
          .about =
              "its states at the start: at rest for its input there, if it has no pole at 0; "
              "or zero",
          .words = block_start_words,
          .member = member};
}
constexpr ElementKey input_key(KeyMember member) {
  return {.name = "input",
          .kind = KeyKind::load,
          .about = "what it acts on",
          .required = true,
          .axis = ElementAxis::none,
          .member = member};
}

inline constexpr ElementRegime block_regimes[] = {
    {.name = "value", .conservative = false, .acts = false}};
inline constexpr ElementRegime sampled_regimes[] = {
    {.name = "value", .conservative = false, .acts = false},
    {.name = "sampled", .conservative = false, .acts = false}};
inline constexpr ElementRegime limit_regimes[] = {
    {.name = "between", .conservative = false, .acts = false},
    {.name = "limited", .conservative = false, .acts = false}};
/// An example of a block with these keys, behind signals that it has been given.
template <class Keys>
ElementExample block_example(ElementExample x, Keys keys, ExampleNumbers& numbers) {
  x.keys(std::move(keys));
  x.t = numbers(0.0, 1.0);
  while (std::ssize(x.states) < x.element.states + x.element.kept)
    x.states.push_back(numbers(-2.0, 2.0));
  x.state_weight = numbers(0.5, 200.0);
  return x;
}

/// What blocks, elements whose only result is their value, have in common.
template <class Keys>
constexpr ElementKind block_kind(const char* about, std::span<const ElementKey> keys) {
  return {.about = about,
          .keys = keys,
          .list = ElementList::controllers,
          .energy = EnergyCategory::loads,
          .axis = ElementAxis::none,
          .measured = false,
          .blank = [] { return ElementKeys(Keys()); },
          .build = [](ElementBuild&) { return true; },
          .regimes = block_regimes};
}

}  // namespace floatframe
