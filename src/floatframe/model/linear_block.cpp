#include "floatframe/model/linear_block.hpp"

#include "floatframe/math/balancing.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {

void take_linear_block(Element& element, LinearBlock block, BlockStart initial,
                       const Sampling& sampling) {
  const int n = block.A.rows();
  MatX A = block.A;  // A z + B u = 0, or z
  if (sampling.period)
    A.diagonal().array() -= 1.0;
  else
    element.states = n;
  take_clock(element, sampling, 2 * n);
  MatX balanced = A;
  balance(balanced);
  if (initial == BlockStart::rest && n > 0 && pivoted_rank(balanced) == n)
    block.rest = lu_solve(-A, block.B);
  element.data = std::make_shared<const LinearBlock>(std::move(block));
}

void start_linear_block(const Ports& in, double* states) noexcept {
  const auto& [A, B, C, D, rest] = in.data<LinearBlock>();
  if (in.element.clock.ticks()) states = own_numbers(in.element, states);
  std::fill_n(states, A.rows(), 0.0);
  for (Eigen::Index j = 0; j < rest.cols(); ++j) {
    const double u = in.signal(j).f;
    for (Eigen::Index i = 0; i < rest.rows(); ++i) states[i] += rest(i, j) * u;
  }
}

/// z, and room for the next one.
void sample_linear_block(const Ports& in, double* own, double* values) noexcept {
  const auto& [A, B, C, D, rest] = in.data<LinearBlock>();
  const Eigen::Index n = A.rows();
  Eigen::Map<VecX> z(own, n), next(own + n, n);
  Eigen::Map<VecX> y(values, C.rows());
  y.noalias() = C * z;
  next.noalias() = A * z;
  for (Eigen::Index j = 0; j < B.cols(); ++j) {
    const double u = in.signal(j).f;
    y += D.col(j) * u;
    next += B.col(j) * u;
  }
  z = next;
}

}  // namespace floatframe
