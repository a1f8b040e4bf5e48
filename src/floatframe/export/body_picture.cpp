#include "floatframe/export/body_picture.hpp"

#include <cmath>
#include <map>
#include <numbers>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/model/element_outputs.hpp"
#include "floatframe/page/scene_mesh.hpp"

namespace floatframe {
namespace {

using Origin = BodyPicture::Origin;

class PictureBuilder {
 public:
  PictureBuilder(const Model& model, int index)
      : model_(model), index_(index), body_(model.bodies[static_cast<std::size_t>(index)]) {}

  BodyPicture build() {
    surface();
    for (const Element& e : model_.elements)
      if (is_wheel_of(model_, e, index_)) wheel(picture_of(e));
    if (points_.empty()) box();
    for (const int n : named_nodes(*body_.data)) {
      const ModalNode& node = body_.data->nodes[static_cast<std::size_t>(n)];
      point(node.p, Origin::node, n);
      picture_.names.push_back(node.name);
    }
    if (body_.data->shape) picture_.color = body_.data->shape->color;
    picture_.points.resize(3, static_cast<Eigen::Index>(points_.size()));
    for (std::size_t k = 0; k < points_.size(); ++k)
      picture_.points.col(static_cast<Eigen::Index>(k)) = points_[k];
    modes();
    second_order();
    return std::move(picture_);
  }

 private:
  int point(const Vec3& p, Origin origin, int node = -1) {
    points_.push_back(p);
    picture_.origins.push_back(origin);
    picture_.nodes.push_back(node);
    return static_cast<int>(points_.size()) - 1;
  }

  void surface() {
    mesh_ = surface_mesh(*body_.data);
    const Origin origin = mesh_.bar_ends.empty() ? Origin::surface : Origin::bars;
    for (Eigen::Index k = 0; k < mesh_.positions.cols(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      point(mesh_.positions.col(k), origin, i < mesh_.nodes.size() ? mesh_.nodes[i] : -1);
    }
    picture_.triangles = mesh_.triangles;
    picture_.lines = mesh_.lines;
    picture_.bar_ends = mesh_.bar_ends;
  }

  /// A cylinder as wide as a car wheel: the model does not give the width.
  void wheel(const Picture& tyre) {
    const Marker& m = model_.markers[tyre.a];
    const Vec3 axis = (m.X_NM.R * tyre.axis).normalized();
    cylinder(place(m), 0.5 * tyre.width * axis, tyre.radius, Origin::wheel);
  }

  /// `half`: from its middle to the centre of an end.
  void cylinder(const Vec3& middle, const Vec3& half, double radius, Origin origin) {
    constexpr int corners = 48;
    const Vec3 axis = half.normalized();
    const Vec3 across = axis.unitOrthogonal(), third = axis.cross(across);
    const auto ring = [&](double side) {
      const int first = static_cast<int>(points_.size());
      for (int k = 0; k < corners; ++k) {
        const double a = 2.0 * std::numbers::pi * k / corners;
        point(middle + side * half + radius * (std::cos(a) * across + std::sin(a) * third), origin);
      }
      return first;
    };
    const int low = ring(-1.0), high = ring(1.0);
    const auto face = [&](int a, int b, int c) { picture_.triangles.push_back({a, b, c}); };
    for (int k = 0; k < corners; ++k) {
      const int next = (k + 1) % corners;
      face(low + k, low + next, high + next);
      face(low + k, high + next, high + k);
      if (k < 2) continue;
      face(low, low + k, low + k - 1);
      face(high, high + k - 1, high + k);
    }
  }

  void box() {
    std::vector<Vec3> held;
    for (const Marker& m : model_.markers)
      if (m.body == index_) held.push_back(place(m));
    const SceneBox box = scene_box(*body_.data, held, scene_extent(model_));
    if (box.round)
      return cylinder(box.position, 0.5 * box.size.z() * box.axes.col(2), 0.5 * box.size.x(),
                      Origin::box);
    const int first = static_cast<int>(points_.size());
    for (int k = 0; k < 8; ++k) {
      const Vec3 corner((k & 1) != 0 ? 0.5 : -0.5, (k & 2) != 0 ? 0.5 : -0.5,
                        (k & 4) != 0 ? 0.5 : -0.5);
      point(box.position + box.axes * corner.cwiseProduct(box.size), Origin::box);
    }
    constexpr int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& f : faces) {
      picture_.triangles.push_back({first + f[0], first + f[1], first + f[2]});
      picture_.triangles.push_back({first + f[0], first + f[2], first + f[3]});
    }
  }

  Vec3 place(const Marker& m) const {
    if (m.node < 0) return m.X_NM.p;
    return body_.data->nodes[static_cast<std::size_t>(m.node)].p + m.X_NM.p;
  }

  void modes() {
    const int nm = body_.modes();
    if (nm == 0) return;
    picture_.modes = MatX::Zero(3 * picture_.points.cols(), nm);
    if (mesh_.modes.size() > 0) picture_.modes.topRows(mesh_.modes.rows()) = mesh_.modes;
    for (Eigen::Index k = picture_.surface_points(); k < picture_.points.cols(); ++k)
      picture_.modes.middleRows<3>(3 * k) = node_of(k).X;
  }
  const ModalNode& node_of(Eigen::Index point) const {
    return body_.data
        ->nodes[static_cast<std::size_t>(picture_.nodes[static_cast<std::size_t>(point)])];
  }

  /// A swept point moves with its node.
  void second_order() {
    if (!body_.stiffens()) return;
    std::map<int, const SecondOrderNode*> known;
    for (const SecondOrderNode& n : body_.data->second_order->nodes) known.emplace(n.node, &n);
    for (std::size_t k = 0; k < picture_.nodes.size(); ++k) {
      if (picture_.origins[k] != Origin::bars && picture_.origins[k] != Origin::node) continue;
      const auto found = known.find(picture_.nodes[k]);
      if (found != known.end())
        picture_.bent.push_back({static_cast<Eigen::Index>(k), found->second});
    }
  }

  const Model& model_;
  int index_;
  const Body& body_;
  SurfaceMesh mesh_;
  std::vector<Vec3> points_;
  BodyPicture picture_;
};

}  // namespace

BodyPicture body_picture(const Model& model, int body) {
  return PictureBuilder(model, body).build();
}

bool same_picture(const BodyPicture& a, const BodyPicture& b) {
  return a.points.cols() == b.points.cols() && a.modes.rows() == b.modes.rows() &&
         a.modes.cols() == b.modes.cols() && a.names == b.names && a.color == b.color &&
         a.triangles == b.triangles && a.lines == b.lines && a.origins == b.origins &&
         a.points == b.points && a.modes == b.modes;
}

void move_picture(const BodyPicture& picture, const BodyInstant& motion, PictureMotion& out) {
  const Eigen::Index n = picture.points.cols();
  out.u.setZero(3, n);
  out.rate.setZero(3, n);
  if (picture.modes.size() > 0) {
    Eigen::Map<VecX>(out.u.data(), 3 * n).noalias() = picture.modes * motion.y;
    Eigen::Map<VecX>(out.rate.data(), 3 * n).noalias() = picture.modes * motion.yd;
  }
  for (const BodyPicture::Bent& b : picture.bent) {
    out.u.col(b.point) += 0.5 * second_order_product(b.node->h, motion.y, motion.y);
    out.rate.col(b.point) += second_order_product(b.node->h, motion.y, motion.yd);
  }
}

}  // namespace floatframe
