// Springs, bushings and the torsion of rods in the model. Directions are those of the displacement
// system CD of each node.
#include <cmath>

#include "floatframe/decks/nastran/nastran_build.hpp"
#include "floatframe/fe/springs.hpp"

namespace floatframe {
namespace {

class SpringBuilder {
 public:
  explicit SpringBuilder(NastranBuild& build) : b_(build), c_(build.content) {}

  void build() {
    std::map<int, FeSource> seen;
    for (const NastranSpring& s : c_.springs) {
      const auto [it, fresh] = seen.try_emplace(s.id, s.at);
      if (!fresh && s.id > 0)
        b_.error(ErrorCode::duplicate, s,
                 "this element number is in the file twice, first in line {}", it->second.line);
      if (s.card == "CBUSH")
        bushing(s);
      else if (s.card == "CBUSH1D")
        line_bushing(s);
      else
        scalar(s);
    }
    if (c_.damping)
      b_.note(*c_.damping,
              "damping of springs and bushings (GE, B) is ignored: the part has modal damping");
  }

 private:
  const Vec3& position(int node) const { return b_.model.positions[node]; }

  /// Nodes of the model; the second -1: the ground. False with an error.
  bool nodes(const NastranSpring& s, std::array<int, 2>& out) {
    out = {-1, -1};
    for (int end = 0; end < 2; ++end) {
      if (s.nodes[end] == 0) continue;
      out[end] = b_.node(s.nodes[end], s);
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
    if (c_.scalar_points.contains(id)) {
      if (c > 0)
        return b_.fail(
            ErrorCode::wrong_value, s,
            "the component is {}, but {} is a scalar point, which has one only (0 or blank)", c + 1,
            id);
      const NastranScalarPoint* point = b_.scalars.find(id);
      if (point == nullptr) return true;
      node = point->node;
      direction(point->axis) = sign;
      return true;
    }
    node = b_.node(id, s);
    if (node < 0) return false;
    if (c < 0)
      return b_.fail(ErrorCode::missing, s,
                     "the component of node {} is missing, expected one of 1 to 6", id);
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
    double k = s.value.value_or(0.0);
    if (!s.value) {
      const auto* const p = b_.property(c_.pelas, s.property, "PELAS", s);
      if (p == nullptr) return;
      k = p->value;
    }
    if (spring.nodes[0] < 0) return;           // points that are held
    if (spring.nodes[0] == spring.nodes[1]) {  // two directions of one node
      spring.directions[0] += spring.directions[1];
      spring.directions[1].setZero();
      if (spring.directions[0].isZero(0.0)) return;
    }
    add(spring, k, s);
  }

  void add(Spring& spring, double k, const NastranSpring& s) {
    spring.name = s.label();
    spring.source = s.at;
    spring.stiffness = k * c_.stiffness_factor;
    if (spring.stiffness != 0.0) b_.model.springs.push_back(std::move(spring));
  }

  void bushing(const NastranSpring& s) {
    std::array<int, 2> n{};
    if (!nodes(s, n)) return;
    const auto* const p = b_.property(c_.pbush, s.property, "PBUSH", s);
    if (p == nullptr) return;
    const Vec6 k = p->stiffness * c_.stiffness_factor;
    Mat3 axes = Mat3::Identity();
    if (!bushing_axes(s, n, k, axes)) return;
    Vec3 at = position(n[0]);
    if (s.offset_system >= 0)
      at += b_.axes_of_system(s.offset_system, s.at, n[0]) * s.offset;
    else if (n[1] >= 0)
      at += s.place * (position(n[1]) - at);
    add_bushing(b_.model, n[0], n[1], at, axes, k, s.label(), s.at);
  }

  /// Along the line of its nodes, or axis 1 of CID at GA.
  void line_bushing(const NastranSpring& s) {
    Spring spring;
    if (!nodes(s, spring.nodes)) return;
    const auto* const p = b_.property(c_.pbush1d, s.property, "PBUSH1D", s);
    if (p == nullptr) return;
    Vec3 x;
    if (s.system >= 0)
      x = b_.axes_of_system(s.system, s.at, spring.nodes[0]).col(0);
    else if (!line_of(spring.nodes, x))
      return b_.error(ErrorCode::incomplete, s,
                      "it has no line from node to node; give a coordinate system CID");
    spring.directions[0].head<3>() = -x;
    if (spring.nodes[1] >= 0) spring.directions[1].head<3>() = x;
    add(spring, p->value, s);
  }

  /// The direction from node to node; false if there is none.
  bool line_of(const std::array<int, 2>& n, Vec3& x) const {
    if (n[1] < 0) return false;
    const Vec3 a = position(n[0]), d = position(n[1]) - a;
    x = d.normalized();
    return d.norm() > 1e-9 * a.norm();
  }

  bool bushing_axes(const NastranSpring& s, const std::array<int, 2>& n, const Vec6& k,
                    Mat3& axes) {
    if (s.system >= 0) {
      axes = b_.axes_of_system(s.system, s.at, n[0]);
      return true;
    }
    Vec3 x;
    if (!line_of(n, x))
      return b_.fail(
          ErrorCode::incomplete, s, "{}",
          n[1] < 0 ? "it ends at the ground and has no axes; give a coordinate system CID"
                   : "its nodes are at one place, so it has no axis; give a coordinate system CID");
    Vec3 v;
    if (!b_.direction(s.orientation, n[0], true, s, v)) return false;
    const bool across = k(1) != 0.0 || k(2) != 0.0 || k(4) != 0.0 || k(5) != 0.0;
    if (v.isZero(0.0)) {
      // Equal across the axis: any directions there will do.
      if (across && (k(1) != k(2) || k(4) != k(5)))
        return b_.fail(
            ErrorCode::incomplete, s,
            "it has stiffness across its axis, but no orientation; give GO, a vector or CID");
      v = x.cross(std::abs(x(0)) < 0.7 ? Vec3::UnitX() : Vec3::UnitY());
    }
    const Vec3 z = x.cross(v);
    if (!(z.norm() > 1e-6 * v.norm()))
      return b_.fail(ErrorCode::geometry, s, "its orientation vector is parallel to its axis");
    axes << x, z.normalized().cross(x), z.normalized();
    return true;
  }

  NastranBuild& b_;
  const NastranContent& c_;
};

}  // namespace

void build_nastran_springs(NastranBuild& build) { SpringBuilder(build).build(); }

void build_nastran_torsion(NastranBuild& build) {
  FeModel& model = build.model;
  for (const FeElement& e : model.elements) {
    if (e.type != FeElementType::rod2) continue;
    const double J = model.sections[e.section].J;
    const Vec3 d = model.positions[e.nodes[1]] - model.positions[e.nodes[0]];
    if (!(J > 0.0) || !(d.norm() > 0.0)) continue;
    Vec6 turn = Vec6::Zero();
    turn.tail<3>() = d.normalized();
    model.springs.push_back({{e.nodes[0], e.nodes[1]},
                             {Vec6(-turn), turn},
                             model.materials[e.material].shear() * J / d.norm(),
                             fmt::format("the torsion of rod {}", e.id),
                             e.source});
  }
}

}  // namespace floatframe
