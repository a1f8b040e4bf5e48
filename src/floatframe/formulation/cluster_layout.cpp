// Load time of the tangent: elements of the clusters, memory, the dense Jacobian.
#include <algorithm>

#include "floatframe/formulation/cluster_tangent.hpp"
#include "floatframe/math/partial_ldlt.hpp"

namespace floatframe {

ClusterTangent::ClusterTangent(const TreeKinematics& tree, const ConstraintSet& constraints,
                               const ElementSet& forces, std::vector<Cluster> clusters)
    : tree_(tree),
      constraints_(constraints),
      forces_(forces),
      clusters_(std::move(clusters)),
      loads_(tree.body_vectors()),
      increments_(loads_) {
  for (int i = 0; i < tree.body_count(); ++i) {
    const TreeBody& b = tree.body(i);
    BodyTangent t;
    t.data = tree.model().bodies[i].data.get();
    t.T = MatX::Zero(6 + b.nm, 6 + b.nm);
    t.U = Mat6X::Zero(6, b.nj + b.nm);
    t.Mz_Phi = Mat6X::Zero(6, b.nm_parent);
    t.G_modal = Mat3X::Zero(3, b.nm);
    const Body& body = tree_.model().bodies[i];
    const bool second_order = body.stiffens() || (body.modes() > 0 && body.data->turning);
    if (second_order) t.K_G = MatX::Zero(b.nm, b.nm);
    second_order_ = second_order_ || second_order;
    bodies_.push_back(std::move(t));
  }
  for (const Cluster& c : clusters_)
    fronts_.push_back({{}, VecX::Zero(c.n), VecX::Zero(front_stride(c.n)), {}});
  make_elements();
  for (std::size_t k = 0; k < clusters_.size(); ++k) fronts_[k].profile = profile_of(k);
  std::size_t widest = 64, gradients = 0;
  for (const TreeBody& b : tree.bodies())
    widest = std::max(widest, static_cast<std::size_t>(6 + b.nm));
  for (const std::vector<TreeElement>* elements : {&part_elements_, &force_elements_})
    for (const TreeElement& e : *elements)
      widest = std::max(widest, static_cast<std::size_t>(e.width));
  scratch_ = VecX::Zero(3 * static_cast<Eigen::Index>(widest));
  for (std::size_t k = 0; k < part_elements_.size(); ++k)
    gradients += static_cast<std::size_t>(part_elements_[k].width * constraints.parts()[k].rows());
  for (Factors& f : factors_) {
    for (const TreeBody& b : tree.bodies()) f.bodies.push_back({b.own, b.of_parent});
    for (std::size_t k = 0; k < clusters_.size(); ++k) {
      const int n = clusters_[k].n;
      // Pages that no column reaches take no memory until they are touched.
      f.fronts.emplace_back(front_stride(n), n);
      if (fronts_[k].profile.empty()) f.fronts.back().setZero();
    }
    f.gradients.assign(gradients, 0.0);
  }
}

void ClusterTangent::make_elements() {
  std::vector<int> cluster_of_body(tree_.body_count(), -1);
  for (std::size_t k = 0; k < clusters_.size(); ++k)
    for (const int i : clusters_[k].bodies) cluster_of_body[i] = static_cast<int>(k);
  int gradients = 0;
  for (std::size_t k = 0; k < constraints_.parts().size(); ++k) {
    TreeElement e;  // of a part that continues another: none
    if (!constraints_.continues(k))
      e = make_element(tree_, clusters_, cluster_of_body, constraints_.markers(k));
    row_.resize(std::max(row_.size(), e.markers.size()));
    e.gradient = gradients;
    gradients += e.width * constraints_.parts()[k].rows();
    if (e.cluster >= 0) fronts_[e.cluster].parts.push_back(static_cast<int>(k));
    part_elements_.push_back(std::move(e));
  }
  for (const Element& element : tree_.model().elements) {
    if (!element.exerts()) {
      force_elements_.emplace_back();
      continue;
    }
    const std::vector<int> bodies = bodies_of(tree_, element.markers);
    if (bodies.size() > 1) {
      force_elements_.push_back(make_element(tree_, clusters_, cluster_of_body, element.markers));
    } else {
      TreeElement e;
      e.markers = element.markers;
      e.body = bodies.empty() ? -1 : bodies[0];
      force_elements_.push_back(std::move(e));
    }
  }
}

FrontProfile ClusterTangent::profile_of(std::size_t cluster) const {
  const Cluster& c = clusters_[cluster];
  if (c.size < wide_cluster) return {};
  FrontProfile end(c.size, 0);
  const auto reach = [&](int first, int last, int row) {
    for (int j = first; j < std::min(last, c.size); ++j) end[j] = std::max(end[j], row);
  };
  for (const int i : c.bodies) {
    const TreeBody& b = tree_.body(i);
    const int at = b.iv - c.offset, row = at + b.nj + b.nm;
    reach(at, row, row);
    for (int p = b.parent; p >= 0 && p != c.parent; p = tree_.body(p).parent) {
      const int above = tree_.body(p).iv - c.offset;
      reach(above, above + tree_.body(p).nj + tree_.body(p).nm, row);
    }
  }
  for (const std::vector<TreeElement>* elements : {&part_elements_, &force_elements_})
    for (const TreeElement& e : *elements)
      if (e.cluster == static_cast<int>(cluster))
        reach(e.first, e.first + e.width, e.first + e.width);
  // A column causes fill in later columns within its height.
  int farthest = 0;
  double entries = 0.0;
  for (int j = 0; j < c.size; ++j) {
    farthest = std::max(farthest, std::min(end[j], c.size));
    end[j] = (farthest + 3) & ~3;
    entries += end[j] - j;
  }
  if (entries > 0.25 * c.size * c.size) return {};
  return end;
}

SparseRowMatrix ClusterTangent::constraint_rows() {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < part_elements_.size(); ++k) {
    const TreeElement& e = part_elements_[k];
    if (e.cluster < 0) continue;
    const Cluster& c = clusters_[e.cluster];
    for (int r = 0; r < constraints_.parts()[k].rows(); ++r) {
      const int row = constraints_.offset(k) + r;
      constraints_.gradient(k, r, row_);
      fill_gradient(tree_, e, row_.data(), scratch_.data());
      for (int j = 0; j < e.width; ++j) {
        const int front = e.first + j;
        // Never touched: the parent's twist, and the padding rows of the last lanes.
        if ((front >= c.size && front < c.size + 6) || front >= c.n) continue;
        const int column =
            front < c.size ? c.offset + front : tree_.body(c.parent).iy + front - c.size - 6;
        if (scratch_[j] != 0.0) entries.emplace_back(row, column, scratch_[j]);
      }
    }
  }
  SparseRowMatrix J(constraints_.count(), tree_.velocity_count());
  J.setFromTriplets(entries.begin(), entries.end());
  return J;
}

}  // namespace floatframe
