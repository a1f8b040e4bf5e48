// Paths along flexible bodies whose modes are too few for the deflection below a load on them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "floatframe/math/dense.hpp"
#include "floatframe/math/sparse_factors.hpp"
#include "floatframe/model/build_flexible.hpp"
#include "floatframe/model/hint_list.hpp"
#include "floatframe/model/loop_mobility.hpp"
#include "floatframe/model/slide_path.hpp"
#include "floatframe/reduction/fixed_interface.hpp"

namespace floatframe {

namespace {

/// What a unit force at nodes of the finite elements does there, in axes of the body.
class SagOfNodes {
 public:
  SagOfNodes(const FeModel& fe, const std::vector<NodeDofs>& clamped) {
    std::vector<char> held(6 * fe.positions.size(), 0);
    for (const NodeDofs& c : clamped)
      for (int axis = 0; axis < 6; ++axis)
        if (const int node = fe.find_node(c.node); node >= 0 && ((c.mask >> axis) & 1u))
          held[6 * node + axis] = 1;
    place_.assign(held.size(), -1);
    for (std::size_t i = 0; i < held.size(); ++i)
      if (!held[i]) {
        place_[i] = std::ssize(free_);
        free_.push_back(i);
      }
    factors_.emplace(pick(assemble_stiffness(fe), free_, free_));
  }
  bool regular() const { return factors_->singular() < 0; }
  Mat3 at(int node) const {
    MatX F = MatX::Zero(std::ssize(free_), 3);
    for (int k = 0; k < 3; ++k)
      if (place_[6 * node + k] >= 0) F(place_[6 * node + k], k) = 1.0;
    return F.transpose() * factors_->solve(F);
  }

 private:
  std::vector<int> free_, place_;
  std::optional<SparseFactors> factors_;
};

/// A part of the deflection below a force, and the direction of both in axes of the body.
struct MissingSag {
  double part = 0.0;
  Vec3 along = Vec3::Zero();
};

/// The largest part of the deflection below a force across the path, of those directions in which
/// the modes bend most, that the modes do not have.
MissingSag missing_sag(const SlidePath& path, const FlexibleBody& body, const SagOfNodes& whole) {
  constexpr Eigen::Index most_places = 40;
  const Eigen::Index n = path.size(), step = 1 + (n - 1) / most_places;
  MissingSag missing;
  double largest_sag = 0.0;
  for (Eigen::Index k = 0; k < n; k += step) {
    const int node = path.nodes()[k];
    const Vec3 along = (path.points().col(std::min(k + 1, n - 1)) -
                        path.points().col(std::max<Eigen::Index>(k - 1, 0)))
                           .normalized();
    const Mat3 across = Mat3::Identity() - along * along.transpose();
    const Mat3X X = across * body.nodes[node].X;
    const SymmetricEigen reduced = symmetric_eigen(MatX(X * ldlt_solve(body.K, X.transpose())));
    const Vec3 direction = reduced.vectors.col(2);
    const double sag = direction.dot(whole.at(node) * direction);
    largest_sag = std::max(largest_sag, sag);
    if (!(reduced.values[2] > 0.0) || !(sag > 1e-3 * largest_sag)) continue;
    const double part = 1.0 - reduced.values[2] / sag;
    if (part > missing.part) missing = {part, direction};
  }
  return missing;
}

/// "y", or a unit vector; of either sense.
std::string line_text(const Vec3& d) {
  for (int k = 0; k < 3; ++k)
    if (std::abs(d[k]) > 1.0 - 1e-6) return std::string(1, "xyz"[k]);
  return fmt::format("[{:.3g}, {:.3g}, {:.3g}]", d.x(), d.y(), d.z());
}

}  // namespace

void hint_at_paths(const ModelDescription& description, const Model& model, HintList& out) {
  constexpr int most_nodes = 2000;
  constexpr double noticeable = 0.002;
  for (const Element& e : model.elements) {
    if (e.markers.empty() || e.markers[0] < 0) continue;
    const Marker& m = model.markers[e.markers[0]];
    if (!m.path) continue;
    const BodyDescription& body = description.bodies[m.body];
    const auto* frame = std::get_if<FlexibleDescription>(&body.kind);
    if (!frame || frame->analytic || frame->basis || body.mirror != Mat3::Identity()) continue;
    const FeModel fe = bar_model(body);
    if (fe.nodes() > most_nodes) continue;
    const SagOfNodes whole(fe, frame->clamped);
    if (!whole.regular()) continue;
    const MissingSag missing = missing_sag(*m.path, *model.bodies[m.body].data, whole);
    if (!(missing.part > noticeable)) continue;
    const Mat3 R = design_pose(model, e.markers[0]).R * m.X_NM.R.transpose();
    out.add("constraint", e.name,
            fmt::format("the modes of body '{}' leave out up to {:.2g} % of the sag below a force "
                        "on the path along {}: path_shapes of its bars add it",
                        body.name, 100.0 * missing.part, line_text(R * missing.along)));
  }
}

}  // namespace floatframe
