// Springs, bushings and the torsion of rods in the model. Directions are those of the displacement
// system CD of each node.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "floatframe/decks/nastran/nastran_build.hpp"
#include "floatframe/fe/springs.hpp"

namespace floatframe {
namespace {

class SpringBuilder {
 public:
  explicit SpringBuilder(NastranBuild& build) : b_(build), springs_(build.content.springs) {}

  void build() {
    std::map<int, FeSource> seen;
    for (const NastranSpring& s : springs_.list) {
      const auto [it, fresh] = seen.try_emplace(s.id, s.at);
      if (!fresh && s.id > 0)
        error(ErrorCode::duplicate, s,
              fmt::format("this element number is in the file twice, first in line {}",
                          it->second.line));
      if (s.card == std::string_view("CBUSH")) {
        bushing(s);
      } else if (s.card == std::string_view("CBUSH1D")) {
        line_bushing(s);
      } else {
        scalar(s);
      }
    }
    if (springs_.damping)
      b_.note(*springs_.damping,
              "damping of springs and bushings (GE, B) is ignored: the part has modal damping");
  }

 private:
  static std::string label(const NastranSpring& s) { return fmt::format("{} {}", s.card, s.id); }
  void error(ErrorCode code, const NastranSpring& s, const std::string& text) {
    b_.source.error(code, s.at, "{}: {}", label(s), text);
  }
  const Vec3& position(int node) const { return b_.model.positions[node]; }

  /// Nodes of the model; the second -1: the ground. False with an error.
  bool nodes(const NastranSpring& s, std::array<int, 2>& out) {
    out = {-1, -1};
    for (int end = 0; end < 2; ++end) {
      if (s.nodes[end] == 0) continue;
      out[end] = b_.node(s.nodes[end], s.at, label(s));
      if (out[end] < 0) return false;
    }
    return out[0] >= 0;
  }

  /// One end in the model; -1: the ground. False with an error.
  bool scalar_end(const NastranSpring& s, int end, int& node, Vec6& direction) {
    node = -1;
    direction.setZero();
    const int id = s.nodes[end], c = s.components[end];
    const double sign = end == 0 ? -1.0 : 1.0;
    if (id == 0) return true;
    if (b_.content.scalar_points.contains(id)) {
      if (c > 0) {
        error(ErrorCode::wrong_value, s,
              fmt::format(
                  "the component is {}, but {} is a scalar point, which has one only (0 or blank)",
                  c + 1, id));
        return false;
      }
      const NastranScalarPoint* point = b_.scalars.find(id);
      if (point == nullptr) return true;
      node = point->node;
      direction(point->axis) = sign;
      return true;
    }
    node = b_.node(id, s.at, label(s));
    if (node < 0) return false;
    if (c < 0) {
      error(ErrorCode::missing, s,
            fmt::format("the component of node {} is missing, expected one of 1 to 6", id));
      return false;
    }
    direction.segment<3>(c < 3 ? 0 : 3) = sign * b_.axes(node).col(c % 3);
    return true;
  }

  void scalar(const NastranSpring& s) {
    Spring spring;
    for (int end = 0; end < 2; ++end)
      if (!scalar_end(s, end, spring.nodes[end], spring.directions[end])) return;
    if (spring.nodes[0] < 0) {  // the ground comes second
      std::swap(spring.nodes[0], spring.nodes[1]);
      std::swap(spring.directions[0], spring.directions[1]);
    }
    spring.name = label(s);
    spring.source = s.at;
    double k = s.stiffness.value_or(0.0);
    if (!s.stiffness) {
      const auto it = springs_.pelas.find(s.property);
      if (it == springs_.pelas.end()) {
        error(ErrorCode::not_found, s,
              fmt::format("property {} (PELAS) is not in the file", s.property));
        return;
      }
      k = it->second.first;
    }
    spring.stiffness = k * b_.content.stiffness_factor;
    if (spring.nodes[0] < 0) return;           // points that are held
    if (spring.nodes[0] == spring.nodes[1]) {  // two directions of one node
      spring.directions[0] += spring.directions[1];
      spring.directions[1].setZero();
      if (spring.directions[0].isZero(0.0)) return;
    }
    if (k != 0.0) b_.model.springs.push_back(std::move(spring));
  }

  void bushing(const NastranSpring& s) {
    std::array<int, 2> n{};
    if (!nodes(s, n)) return;
    const auto it = springs_.pbush.find(s.property);
    if (it == springs_.pbush.end()) {
      error(ErrorCode::not_found, s,
            fmt::format("property {} (PBUSH) is not in the file", s.property));
      return;
    }
    const Vec6 k = it->second.first * b_.content.stiffness_factor;
    Mat3 axes = Mat3::Identity();
    if (!bushing_axes(s, n, k, axes)) return;
    Vec3 at = position(n[0]);
    if (s.offset_system >= 0) {
      const Mat3 R = s.offset_system > 0 ? nastran_axes_at(b_.frame(s.offset_system, s.at), at)
                                         : Mat3(Mat3::Identity());
      at += R * s.offset;
    } else if (n[1] >= 0) {
      at += s.place * (position(n[1]) - at);
    }
    add_bushing(b_.model, n[0], n[1], at, axes, k, label(s), s.at);
  }

  /// Along the line of its nodes, or axis 1 of CID at GA.
  void line_bushing(const NastranSpring& s) {
    Spring spring;
    if (!nodes(s, spring.nodes)) return;
    const auto it = springs_.pbush1d.find(s.property);
    if (it == springs_.pbush1d.end()) {
      error(ErrorCode::not_found, s,
            fmt::format("property {} (PBUSH1D) is not in the file", s.property));
      return;
    }
    const Vec3 a = position(spring.nodes[0]);
    Vec3 x = Vec3::UnitX();
    if (s.system > 0) {
      x = nastran_axes_at(b_.frame(s.system, s.at), a).col(0);
    } else if (s.system < 0) {
      const Vec3 d = spring.nodes[1] < 0 ? Vec3(Vec3::Zero()) : Vec3(position(spring.nodes[1]) - a);
      if (!(d.norm() > 1e-9 * a.norm())) {
        error(ErrorCode::incomplete, s,
              "it has no line from node to node; give a coordinate system CID");
        return;
      }
      x = d.normalized();
    }
    spring.directions[0].head<3>() = -x;
    if (spring.nodes[1] >= 0) spring.directions[1].head<3>() = x;
    spring.stiffness = it->second.first * b_.content.stiffness_factor;
    spring.name = label(s);
    spring.source = s.at;
    if (spring.stiffness != 0.0) b_.model.springs.push_back(std::move(spring));
  }

  bool bushing_axes(const NastranSpring& s, const std::array<int, 2>& n, const Vec6& k,
                    Mat3& axes) {
    const Vec3 a = position(n[0]);
    if (s.system >= 0) {
      if (s.system > 0) axes = nastran_axes_at(b_.frame(s.system, s.at), a);
      return true;
    }
    const Vec3 d = n[1] >= 0 ? Vec3(position(n[1]) - a) : Vec3(Vec3::Zero());
    if (!(d.norm() > 1e-9 * a.norm())) {
      error(ErrorCode::incomplete, s,
            n[1] < 0
                ? "it ends at the ground and has no axes; give a coordinate system CID"
                : "its nodes are at one place, so it has no axis; give a coordinate system CID");
      return false;
    }
    Vec3 v = b_.axes(n[0]) * s.orientation;
    if (s.orientation_node > 0) {
      const int go = b_.node(s.orientation_node, s.at, label(s));
      if (go < 0) return false;
      v = position(go) - a;
    }
    const Vec3 x = d.normalized();
    const bool across = k(1) != 0.0 || k(2) != 0.0 || k(4) != 0.0 || k(5) != 0.0;
    if (v.isZero(0.0)) {
      // Equal across the axis: any directions there will do.
      if (across && (k(1) != k(2) || k(4) != k(5))) {
        error(ErrorCode::incomplete, s,
              "it has stiffness across its axis, but no orientation; give GO, a vector or CID");
        return false;
      }
      v = x.cross(std::abs(x(0)) < 0.7 ? Vec3::UnitX() : Vec3::UnitY());
    }
    const Vec3 z = x.cross(v);
    if (!(z.norm() > 1e-6 * v.norm())) {
      error(ErrorCode::geometry, s, "its orientation vector is parallel to its axis");
      return false;
    }
    axes << x, z.normalized().cross(x), z.normalized();
    return true;
  }

  NastranBuild& b_;
  const NastranSprings& springs_;
};

}  // namespace

void build_nastran_springs(NastranBuild& build) { SpringBuilder(build).build(); }

void build_nastran_torsion(NastranBuild& build) {
  FeModel& model = build.model;
  for (const Element& e : model.elements) {
    if (e.type != ElementType::rod2) continue;
    const double J = model.sections[e.section].J;
    const Vec3 d = model.positions[e.nodes[1]] - model.positions[e.nodes[0]];
    if (!(J > 0.0) || !(d.norm() > 0.0)) continue;
    Spring s;
    s.nodes = {e.nodes[0], e.nodes[1]};
    s.directions[0].tail<3>() = -d.normalized();
    s.directions[1].tail<3>() = d.normalized();
    s.stiffness = model.materials[e.material].shear() * J / d.norm();
    s.name = fmt::format("the torsion of rod {}", e.id);
    s.source = e.source;
    model.springs.push_back(std::move(s));
  }
}

}  // namespace floatframe
