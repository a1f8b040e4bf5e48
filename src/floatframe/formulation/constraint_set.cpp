#include "floatframe/formulation/constraint_set.hpp"

#include <cassert>
#include <cmath>

namespace floatframe {

ConstraintSet::ConstraintSet(const Model& model, std::span<const int> joints) : model_(model) {
  for (const int j : joints) append_joint_parts(model, j, parts_);
  for (std::size_t k = 0; k < model.elements.size(); ++k)
    append_element_parts(model, static_cast<int>(k), parts_);
}

void ConstraintSet::number_rows(int first) {
  assert(first >= 0);
  count_ = first;
  offsets_.clear();
  stored_.clear();
  int stored = 0;
  for (const ConstraintPart& p : parts_) {
    offsets_.push_back(p.continues ? count_ - 1 : count_);
    stored_.push_back(stored);
    if (!p.continues) count_ += p.rows();
    stored += p.rows();
  }
  rows_.resize(stored);
  values_ = multipliers_ = weights_ = VecX::Zero(count_);
}

void ConstraintSet::count_turns_with(const ElementSet& elements) {
  for (ConstraintPart& p : parts_)
    if (p.coordinate >= 0) p.angle = elements.angle(elements.slot(p.owner.element, p.coordinate));
}

std::size_t ConstraintSet::part_of_row(int i) const noexcept {
  assert(i >= 0 && i < count_);
  std::size_t k = parts_.size();
  while (k-- > 0 && (offsets_[k] > i || parts_[k].continues)) {
  }
  return k < parts_.size() ? k : parts_.size();
}

std::string ConstraintSet::owner_of_row(int i) const {
  const std::size_t k = part_of_row(i);
  return k < parts_.size() ? owner_name(model_, parts_[k].owner) : "the constraints";
}

std::vector<int> ConstraintSet::markers(std::size_t part) const {
  std::vector<int> all;
  do {
    all.insert(all.end(), {parts_[part].a, parts_[part].b});
  } while (continues(++part));
  return all;
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
    const WrenchRow& g = row(part, r).gradient;
    sum.a.F += x * g.a.F;
    sum.a.T += x * g.a.T;
    sum.b.F += x * g.b.F;
    sum.b.T += x * g.b.T;
  }
  return sum;
}

double ConstraintSet::force_of(std::size_t part, const double* lambda) const noexcept {
  assert(part < parts_.size() && parts_[part].owner.element >= 0);
  const ConstraintPart& first = parts_[part];
  const bool points = constraint_kind(first.type).points;
  double square = 0.0;
  int rows = 0;
  for (std::size_t k = part; k < parts_.size(); ++k) {
    const ConstraintPart& p = parts_[k];
    if (p.owner.element != first.owner.element) break;
    if (p.continues || constraint_kind(p.type).points != points) continue;
    for (int r = 0; r < p.rows(); ++r, ++rows) {
      const double force = p.force * lambda[offsets_[k] - offsets_[part] + r];
      square += force * force;
    }
  }
  return rows == 1 ? first.force * *lambda : std::sqrt(square);
}

double ConstraintSet::motion_power(const VecX& lambda) const noexcept {
  assert(lambda.size() == count_);
  double sum = 0.0;
  for (std::size_t k = 0; k < parts_.size(); ++k)
    for (int r = 0; r < parts_[k].rows(); ++r) sum += lambda[offsets_[k] + r] * row(k, r).phi_t;
  return sum;
}

}  // namespace floatframe
