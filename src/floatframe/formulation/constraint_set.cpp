#include "floatframe/formulation/constraint_set.hpp"

#include <cassert>

namespace floatframe {

ConstraintSet::ConstraintSet(const Model& model, std::span<const int> joints) : model_(model) {
  for (const int j : joints) append_joint_parts(model, j, parts_);
  for (std::size_t k = 0; k < model.elements.size(); ++k)
    append_element_parts(model, static_cast<int>(k), parts_);
}

void ConstraintSet::number_rows(int first) {
  assert(first >= 0);
  first_ = count_ = first;
  offsets_.clear();
  for (const ConstraintPart& p : parts_) {
    offsets_.push_back(count_);
    count_ += p.rows();
  }
  rows_.resize(count_ - first_);
  values_ = multipliers_ = weights_ = VecX::Zero(count_);
}

std::size_t ConstraintSet::part_of_row(int i) const noexcept {
  assert(i >= 0 && i < count_);
  std::size_t k = parts_.size();
  while (k-- > 0 && offsets_[k] > i) {
  }
  return k < parts_.size() ? k : parts_.size();
}

std::string ConstraintSet::owner_of_row(int i) const {
  const std::size_t k = part_of_row(i);
  return k < parts_.size() ? owner_name(model_, parts_[k].owner) : "the constraints";
}

WrenchRow ConstraintSet::wrench(std::size_t part, const VecX& w) const noexcept {
  assert(part < parts_.size() && w.size() == count_);
  WrenchRow sum;
  sum.a.F.setZero();
  sum.a.T.setZero();
  sum.b.F.setZero();
  sum.b.T.setZero();
  if (constraint_kind(parts_[part].type).gradients == PartGradients::unit) {
    sum.b.F = w.segment<3>(offsets_[part]);
    sum.a.F = -sum.b.F;
    return sum;
  }
  for (int r = 0; r < parts_[part].rows(); ++r) {
    const double x = w[offsets_[part] + r];
    const WrenchRow& g = row_of(part, r).gradient;
    sum.a.F += x * g.a.F;
    sum.a.T += x * g.a.T;
    sum.b.F += x * g.b.F;
    sum.b.T += x * g.b.T;
  }
  return sum;
}

double ConstraintSet::motion_power(const VecX& lambda) const noexcept {
  assert(lambda.size() == count_);
  double sum = 0.0;
  for (std::size_t r = 0; r < rows_.size(); ++r)
    sum += lambda[first_ + static_cast<Eigen::Index>(r)] * rows_[r].phi_t;
  return sum;
}

}  // namespace floatframe
