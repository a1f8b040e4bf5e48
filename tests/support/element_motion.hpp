#pragma once
// Small motions of an example of an element, its efforts, and its tangents in the order of its
// markers: (dr, dpi) or (v, w) of each.
#include "floatframe/model/element_kind.hpp"
#include "support/marker_motion.hpp"

namespace floatframe::test {

/// The ports of an example, which must outlive this.
class Placed {
 public:
  explicit Placed(const ElementExample& x) : x_(x), element_(x.element) {
    for (const MarkerState& m : x.markers) {
      element_.markers.push_back(static_cast<int>(markers_.size()));
      markers_.push_back(&m);
    }
  }
  Ports ports() const {
    return {x_.model,
            element_,
            markers_.data(),
            x_.origin,
            x_.t,
            x_.reference_angle,
            x_.inputs,
            free_branch,
            x_.states.data(),
            x_.state_weight,
            x_.links.data(),
            nullptr,
            x_.states.data() + x_.element.states};
  }

 private:
  const ElementExample& x_;
  Element element_;
  std::vector<const MarkerState*> markers_;
};

inline Efforts efforts(const ElementExample& x) {
  Efforts out(x.markers.size(), static_cast<std::size_t>(x.element.states),
              static_cast<std::size_t>(x.element.further()));
  evaluate_element(Placed(x).ports(), out);
  return out;
}

inline VecX stacked(const Efforts& e) {
  VecX out(6 * static_cast<Eigen::Index>(e.markers()));
  for (std::size_t i = 0; i < e.markers(); ++i)
    out.segment<6>(6 * static_cast<Eigen::Index>(i)) << e.wrench[i].F, e.wrench[i].T;
  return out;
}

inline VecX velocities(const ElementExample& x) {
  VecX out(6 * static_cast<Eigen::Index>(x.markers.size()));
  for (std::size_t i = 0; i < x.markers.size(); ++i)
    out.segment<6>(6 * static_cast<Eigen::Index>(i)) << x.markers[i].v, x.markers[i].w;
  return out;
}

/// Translations in world axes, rotations from the left; velocities held.
inline ElementExample moved(const ElementExample& x, const VecX& d) {
  ElementExample out = x;
  Eigen::Index at = 0;
  for (MarkerState& m : out.markers) {
    m.r += d.segment<3>(at);
    m.R = rotation_exp(d.segment<3>(at + 3)) * m.R;
    at += 6;
  }
  return out;
}

inline ElementExample faster(const ElementExample& x, const VecX& d) {
  ElementExample out = x;
  Eigen::Index at = 0;
  for (MarkerState& m : out.markers) {
    m.v += d.segment<3>(at);
    m.w += d.segment<3>(at + 3);
    at += 6;
  }
  return out;
}

inline void at_rest(ElementExample& x) {
  for (MarkerState& m : x.markers) m.v = m.w = Vec3::Zero();
}

/// dz of the states.
inline ElementExample switched(const ElementExample& x, const VecX& dz) {
  ElementExample out = x;
  for (Eigen::Index i = 0; i < dz.size(); ++i) out.states[static_cast<std::size_t>(i)] += dz[i];
  return out;
}
inline VecX state_rates(const ElementExample& x) {
  const Efforts e = efforts(x);
  return VecX::Map(e.state_rates.data(), static_cast<Eigen::Index>(e.state_rates.size()));
}

/// Changes of the inner variables of an EffortTangent: states, then signals of other elements.
inline ElementExample changed(const ElementExample& x, const VecX& inner) {
  ElementExample out = switched(x, inner.head(x.element.states));
  for (Eigen::Index i = x.element.states; i < inner.size(); ++i)
    out.links[static_cast<std::size_t>(i - x.element.states)] += inner[i];
  return out;
}
inline Eigen::Index inner_count(const ElementExample& x) {
  return x.element.states + std::ssize(x.links);
}
/// zdot, force, length, rate, further values.
inline VecX results(const ElementExample& x) {
  const Efforts e = efforts(x);
  VecX out(x.element.states + 3 + x.element.further());
  out << state_rates(x), e.force, e.length, e.rate,
      VecX::Map(e.further.data(), x.element.further());
  return out;
}
inline double largest_entry(const MatX& X) { return X.size() > 0 ? X.cwiseAbs().maxCoeff() : 0.0; }

struct RowTangent {
  MatX K, C;
};
/// sum k g g^T and sum c g g^T
inline RowTangent tangent_of_rows(const Efforts& e) {
  const Eigen::Index n = 6 * static_cast<Eigen::Index>(e.markers());
  RowTangent out{MatX::Zero(n, n), MatX::Zero(n, n)};
  for (int r = 0; r < e.row_count; ++r) {
    VecX g(n);
    for (std::size_t i = 0; i < e.markers(); ++i)
      g.segment<6>(6 * static_cast<Eigen::Index>(i)) << e.gradient(r)[i].F, e.gradient(r)[i].T;
    out.K += e.rows[r].k * g * g.transpose();
    out.C += e.rows[r].c * g * g.transpose();
  }
  return out;
}

}  // namespace floatframe::test
