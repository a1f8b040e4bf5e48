#include "floatframe/model/linear_block.hpp"

#include "floatframe/math/balancing.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {

void take_linear_block(Element& element, LinearBlock block, BlockStart initial) {
  const Eigen::Index n = block.A.rows();
  element.states = n;
  MatX A = block.A;
  balance(A);
  if (initial == BlockStart::rest && n > 0 && pivoted_rank(A) == n)
    block.rest = lu_solve(-block.A, block.B);
  element.data = std::make_shared<const LinearBlock>(std::move(block));
}

void start_linear_block(const Ports& in, double* states) noexcept {
  const MatX& rest = in.data<LinearBlock>().rest;
  std::fill_n(states, in.element.states, 0.0);
  for (Eigen::Index j = 0; j < rest.cols(); ++j) {
    const double u = in.signal(j).f;
    for (Eigen::Index i = 0; i < rest.rows(); ++i) states[i] += rest(i, j) * u;
  }
}

}  // namespace floatframe
