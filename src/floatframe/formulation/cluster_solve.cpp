// Solution with a factorised tangent. With the linear terms of the minimisation 1/2 x^T T x - b^T x
// propagated inwards as wrenches on the bodies, each front is eliminated leaves to root; then the
// increments [Z; y] of the bodies propagate outwards and each front gives those of its coordinates.
#include <cassert>
#include <cmath>

#include "floatframe/formulation/cluster_tangent.hpp"
#include "floatframe/math/partial_ldlt.hpp"
#include "floatframe/math/small_products.hpp"

namespace floatframe {

/// Phi_q^T w of the parts of cluster k, over its front.
void ClusterTangent::add_part_loads(const Factors& factors, std::size_t k, const VecX& w) noexcept {
  assert(w.size() == constraints_.count());
  double* work = fronts_[k].work.data();
  for (const int q : fronts_[k].parts) {
    const TreeElement& e = part_elements_[q];
    const double* g = factors.gradients.data() + e.gradient;
    double* out = work + e.first;
    assert(e.first + e.width <= fronts_[k].work.size());
    const double* f = w.data() + constraints_.offset(q);
    const int rows = constraints_.parts()[q].rows();
    if (rows == 3) {
      for (int j = 0; j < e.width; j += 4)
        lanes(out + j) +=
            f[0] * lanes(g + j) + f[1] * lanes(g + e.width + j) + f[2] * lanes(g + 2 * e.width + j);
      continue;
    }
    for (int r = 0; r < rows; ++r, g += e.width)
      for (int j = 0; j < e.width; j += 4) lanes(out + j) += f[r] * lanes(g + j);
  }
}

/// Contributions of the children of the bodies of cluster k to its front.
void ClusterTangent::gather_loads(const Factors& factors, std::size_t k) noexcept {
  const Cluster& c = clusters_[k];
  double* work = fronts_[k].work.data();
  for (std::size_t l = c.bodies.size(); l-- > 0;) {
    const int i = c.bodies[l];
    const TreeBody& b = tree_.body(i);
    const Directions& d = factors.bodies[i];
    const VecX& load = loads_[i];
    assert(d.own.cols() == b.nj + b.nm && load.size() == 6 + b.nm);
    const Vec6 wrench = load.head<6>();
    double* own = work + (b.iv - c.offset);
    add_transposed_times(d.own.data(), b.moving(), wrench.data(), own);
    for (int j = 0; j < b.nm; ++j) own[b.nj + j] += load[6 + j];
    if (b.parent < 0) continue;
    double* up = b.parent != c.parent ? loads_[b.parent].data() : work + c.size;
    for (int j = 0; j < 6; ++j) up[j] += wrench[j];
    if (b.parent_moves_F)
      add_transposed_times(d.of_parent.data(), b.nm_parent, wrench.data(), up + 6);
  }
}

/// Phi_q x of the parts of cluster k.
void ClusterTangent::part_increments(const Factors& factors, std::size_t k,
                                     VecX& increments) const noexcept {
  const double* work = fronts_[k].work.data();
  for (const int q : fronts_[k].parts) {
    const TreeElement& e = part_elements_[q];
    const double* g = factors.gradients.data() + e.gradient;
    const double* in = work + e.first;
    for (int r = 0; r < constraints_.parts()[q].rows(); ++r, g += e.width) {
      Lanes products = {};
      for (int j = 0; j < e.width; j += 4) products += lanes(g + j) * lanes(in + j);
      increments[constraints_.offset(q) + r] = sum(products);
    }
  }
}

/// Increments of the bodies of cluster k from those of its coordinates.
void ClusterTangent::spread_increments(const Factors& factors, std::size_t k) noexcept {
  const Cluster& c = clusters_[k];
  const double* work = fronts_[k].work.data();
  for (const int i : c.bodies) {
    const TreeBody& b = tree_.body(i);
    const Directions& d = factors.bodies[i];
    Vec6 z = Vec6::Zero();
    if (b.parent >= 0) {
      const VecX& up = increments_[b.parent];
      z = up.head<6>();
      if (b.parent_moves_F) add_times(d.of_parent.data(), b.nm_parent, up.data() + 6, z.data());
    }
    const double* own = work + (b.iv - c.offset);
    add_times(d.own.data(), b.moving(), own, z.data());
    VecX& increment = increments_[i];
    assert(increment.size() == 6 + b.nm);
    for (int j = 0; j < b.nm; ++j) increment[6 + j] = own[b.nj + j];
    increment.head<6>() = z;
  }
}

void ClusterTangent::solve(VecX& x, const VecX* w, VecX* increments, int slot) noexcept {
  assert((slot == 0 || slot == 1) && x.size() == tree_.velocity_count());
  assert(!increments || increments->size() == constraints_.count());
  const Factors& factors = factors_[slot];
  for (VecX& load : loads_) load.setZero();
  if (increments) increments->setZero();
  for (std::size_t k = clusters_.size(); k-- > 0;) {
    const Cluster& c = clusters_[k];
    VecX& front = fronts_[k].work;
    assert(front.size() == factors.fronts[k].rows());
    double* work = front.data();
    for (int j = 0; j < c.size; ++j) work[j] = x[c.offset + j];
    for (int j = c.size; j < front.size(); ++j) work[j] = 0.0;
    if (w) add_part_loads(factors, k, *w);
    gather_loads(factors, k);
    const FrontProfile& profile = fronts_[k].profile;
    if (profile.empty())
      partial_forward(factors.fronts[k].data(), c.n, c.size, work);
    else
      profile_forward(factors.fronts[k].data(), c.n, c.size, work, profile);
    if (c.parent >= 0) {
      double* up = loads_[c.parent].data();
      for (int j = c.size; j < c.n; ++j) up[j - c.size] += work[j];
    }
  }
  for (std::size_t k = 0; k < clusters_.size(); ++k) {
    const Cluster& c = clusters_[k];
    double* work = fronts_[k].work.data();
    if (c.parent >= 0) {
      const double* up = increments_[c.parent].data();
      for (int j = c.size; j < c.n; ++j) work[j] = up[j - c.size];
    }
    const FrontProfile& profile = fronts_[k].profile;
    if (profile.empty())
      partial_backward(factors.fronts[k].data(), c.n, c.size, work);
    else
      profile_backward(factors.fronts[k].data(), c.n, c.size, work, profile);
    for (int j = 0; j < c.size; ++j) x[c.offset + j] = work[j];
    if (increments) part_increments(factors, k, *increments);
    spread_increments(factors, k);
  }
}

double ClusterTangent::log_pivots(int slot) const noexcept {
  assert(slot == 0 || slot == 1);
  double sum = 0.0;
  for (std::size_t k = 0; k < clusters_.size(); ++k) {
    const MatX& front = factors_[slot].fronts[k];
    double product = 1.0;  // of four factors, to save logarithms
    for (int j = 0; j < clusters_[k].size; ++j) {
      product *= front(j, j);
      if (j % 4 != 3) continue;
      sum -= std::log(std::abs(product));
      product = 1.0;
    }
    sum -= std::log(std::abs(product));
  }
  return sum;
}

int ClusterTangent::negative_pivots(int slot) const noexcept {
  assert(slot == 0 || slot == 1);
  int count = 0;
  for (std::size_t k = 0; k < clusters_.size(); ++k)
    for (int j = 0; j < clusters_[k].size; ++j)
      if (factors_[slot].fronts[k](j, j) < 0.0) ++count;
  return count;
}

}  // namespace floatframe
