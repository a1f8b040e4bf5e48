#include "floatframe/packed/pack.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/body/body_stress.hpp"
#include "floatframe/body/surface_points.hpp"
#include "floatframe/model/element_keys.hpp"
#include "floatframe/model/model_hash.hpp"
#include "floatframe/model/slide_path.hpp"

namespace floatframe {
namespace {

/// Nodes of one body that a model uses: those that markers are at, and those whose place or shapes
/// decide a scale - the reach of the body, the largest motion of a mode.
class UsedNodes {
 public:
  UsedNodes(const Model& model, int index)
      : body_(*model.bodies[index].data), used_(body_.nodes.size(), false) {
    for (const Marker& m : model.markers) {
      if (m.body != index) continue;
      use(m.node);
      if (m.path)
        for (const int node : m.path->nodes()) use(node);
      if (m.node >= 0 && m.rotates) ends_beside(m);
    }
    for (const InterfaceDofs& i : body_.interfaces) use(i.node);
    for (std::size_t k = 0; k < used_.size(); ++k)
      if (is_surface_point(body_.nodes[k])) used_[k] = true;
    reach();
    for (int k = 0; k < body_.modes(); ++k) largest_motions(k);
  }
  const std::vector<bool>& used() const noexcept { return used_; }

 private:
  void use(int node) {
    if (node >= 0) used_[node] = true;
  }
  /// The first of the nodes with the largest value.
  template <class Value>
  void use_largest(const Value& value_of) {
    int best = -1;
    double most = -INFINITY;
    for (std::size_t k = 0; k < used_.size(); ++k)
      if (const double value = value_of(body_.nodes[k]); value > most) {
        most = value;
        best = int(k);
      }
    use(best);
  }
  void reach() {
    use_largest([](const ModalNode& n) { return n.p.norm(); });
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      use_largest([&](const ModalNode& n) { return n.p[axis]; });
      use_largest([&](const ModalNode& n) { return -n.p[axis]; });
    }
  }
  /// Of the sum X^2 + l^2 theta^2 for any l: the corners of the convex hull.
  void largest_motions(int mode) {
    const auto move = [&](const ModalNode& n) { return n.X.col(mode).norm(); };
    const auto turn = [&](const ModalNode& n) { return n.X_theta.col(mode).norm(); };
    use_largest(move);
    use_largest(turn);
    struct Place {
      double x, y;
      int node;
    };
    std::vector<Place> places, hull;
    for (std::size_t k = 0; k < used_.size(); ++k) {
      const ModalNode& n = body_.nodes[k];
      places.push_back({n.X.col(mode).squaredNorm(), n.X_theta.col(mode).squaredNorm(), int(k)});
    }
    std::ranges::stable_sort(places, [](const Place& a, const Place& b) {
      return a.x > b.x || (a.x == b.x && a.y > b.y);
    });
    for (const Place& p : places) {
      if (!hull.empty() && p.y <= hull.back().y) continue;
      while (hull.size() > 1) {
        const Place &a = hull[hull.size() - 2], &b = hull.back();
        if ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0.0) break;
        hull.pop_back();
      }
      hull.push_back(p);
    }
    for (const Place& p : hull) use(p.node);
  }
  /// A node along the axis of the marker and one across: notes of a start say whether a joint
  /// slides along its body.
  void ends_beside(const Marker& m) {
    const Vec3 from = body_.nodes[m.node].p, axis = m.X_NM.R.col(2);
    const auto first = [&](const auto& fits) {
      for (std::size_t k = 0; k < used_.size(); ++k) {
        const Vec3 d = body_.nodes[k].p - from;
        if (d.norm() > 0.0 && fits(std::abs(d.dot(axis)), d.norm())) return use(int(k));
      }
    };
    first([](double along, double length) { return along > 0.9 * length; });
    first([](double along, double length) { return along < 0.4 * length; });
  }

  const FlexibleBody& body_;
  std::vector<bool> used_;
};

/// Without the nodes that are not used. The body has neither shape nor stress.
void drop_nodes(FlexibleBody& body, const std::vector<bool>& used) {
  std::vector<int> place(used.size(), -1);
  std::vector<ModalNode> nodes;
  for (std::size_t k = 0; k < used.size(); ++k)
    if (used[k]) {
      place[k] = int(nodes.size());
      nodes.push_back(std::move(body.nodes[k]));
    }
  body.nodes = std::move(nodes);
  for (InterfaceDofs& i : body.interfaces) i.node = place[i.node];
  if (!body.second_order) return;
  SecondOrder kept = *body.second_order;
  std::erase_if(kept.nodes, [&](const SecondOrderNode& n) { return place[n.node] < 0; });
  for (SecondOrderNode& n : kept.nodes) n.node = place[n.node];
  body.second_order = std::make_shared<const SecondOrder>(std::move(kept));
}

bool has_gauge(const Model& model, std::size_t body) {
  return std::ranges::any_of(model.gauges,
                             [&](const Gauge& g) { return g.body == std::ptrdiff_t(body); });
}

FlexibleBody packed_body(const Model& model, std::size_t index, const PackOptions& options) {
  FlexibleBody body = *model.bodies[index].data;
  if (model.simulation.inertia != InertiaMethod::projection &&
      body.mass_model != MassModel::six_dof)
    body.projection = nullptr;
  if (options.contents != PackOptions::Contents::steps) return body;
  body.shape = nullptr;
  if (has_gauge(model, index)) return body;
  body.stress = nullptr;
  if (options.drop_nodes) drop_nodes(body, UsedNodes(model, int(index)).used());
  return body;
}

/// Texts of files that elements read when they are built.
void keep_files(std::vector<ElementDescription>& elements) {
  for (ElementDescription& e : elements)
    for (const ElementKey& key : element_keys(e.type())) {
      if (!key.content) continue;
      const auto path = key_value(e, key), text = key.content->member.read(e);
      if (path && text && std::get<std::string>(*text).empty())
        key.content->member.write(e, key.content->read(std::get<std::string>(*path)));
    }
}

/// Hints but for those that are found again when the model is built, which come first.
ModelHints hints_of(const ModelDescription& reduced, const Model& model) {
  const Model again = PackedModel(reduced, {}).build();
  ModelHints hints = model.hints;
  const auto found = std::min(again.hints.notes.size(), hints.notes.size());
  hints.notes.erase(hints.notes.begin(), hints.notes.begin() + std::ptrdiff_t(found));
  return hints;
}

bool is_same(const PackedModel& packed, const Model& model) {
  const Model built = packed.build();
  return built.markers.size() == model.markers.size() && built.hints.notes == model.hints.notes &&
         model_hash(built) == model_hash(model);
}

}  // namespace

ModelDescription with_reduced_bodies(const ModelDescription& description, const Model& model,
                                     const PackOptions& options) {
  ModelDescription d = description;
  d.hints = nullptr;
  for (std::size_t i = 0; i < d.bodies.size(); ++i) {
    BodyDescription& b = d.bodies[i];
    if (auto* rigid = std::get_if<RigidDescription>(&b.kind)) {
      if (options.contents == PackOptions::Contents::steps) rigid->shape = nullptr;
      continue;
    }
    b.kind = packed_body(model, i, options);
    b.mirror = Mat3::Identity();
    b.X_WT = b.X_WB;
  }
  for (auto* list : {&d.rods, &d.constraints, &d.couplings, &d.controllers, &d.forces})
    keep_files(*list);
  return d;
}

PackedModel packed(const ModelDescription& description, const Model& model,
                   const PackOptions& options) {
  ModelDescription reduced = with_reduced_bodies(description, model, options);
  const ModelHints hints = hints_of(reduced, model);
  PackedModel out(reduced, hints);
  if (is_same(out, model)) return out;
  PackOptions all_nodes = options;
  all_nodes.drop_nodes = false;
  out = PackedModel(with_reduced_bodies(description, model, all_nodes), hints);
  if (is_same(out, model)) return out;
  throw InputError(ErrorCode::contradiction,
                   "found a model that differs from what its packed model builds, expected the "
                   "same: please report it");
}

}  // namespace floatframe
