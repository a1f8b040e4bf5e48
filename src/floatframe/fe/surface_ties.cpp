#include "floatframe/fe/surface_ties.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/face_shape.hpp"

namespace floatframe {
namespace {

struct Face {
  int count = 0, corners = 0;
  std::array<int, 8> nodes{};  ///< of the model
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;
};

FaceShape shape_at(const Face& face, double r, double s) {
  return face_shape(face.corners, face.count, r, s);
}

struct FacePoint {
  double r = 0.0, s = 0.0, distance = std::numeric_limits<double>::infinity();
  Vec3 p = Vec3::Zero(), along_r = Vec3::Zero(), along_s = Vec3::Zero();
};

FacePoint point_at(const FeModel& model, const Face& face, double r, double s, const Vec3& x) {
  const FaceShape f = shape_at(face, r, s);
  FacePoint out{r, s};
  for (int i = 0; i < face.count; ++i) {
    const Vec3& p = model.positions[face.nodes[i]];
    out.p += f.N[i] * p;
    out.along_r += f.r[i] * p;
    out.along_s += f.s[i] * p;
  }
  out.distance = (out.p - x).norm();
  return out;
}

/// Into the face.
void clamp_to(const Face& face, double& r, double& s) {
  if (face.corners == 4) {
    r = std::clamp(r, -1.0, 1.0);
    s = std::clamp(s, -1.0, 1.0);
    return;
  }
  // The nearest point of the triangle in area coordinates, with sides of length one.
  if (r + s > 1.0) {
    const double more = (r + s - 1.0) / 2.0;
    r -= more;
    s -= more;
    if (r < 0.0) r = 0.0, s = 1.0;
    if (s < 0.0) r = 1.0, s = 0.0;
  }
  r = std::clamp(r, 0.0, 1.0);
  s = std::clamp(s, 0.0, 1.0);
}

/// The point of the face nearest to x: Gauss-Newton, held inside the face, halved where the
/// distance grows.
FacePoint nearest_point(const FeModel& model, const Face& face, const Vec3& x) {
  const double middle = face.corners == 3 ? 1.0 / 3.0 : 0.0;
  FacePoint at = point_at(model, face, middle, middle, x);
  for (int iteration = 0; iteration < 50; ++iteration) {
    Eigen::Matrix2d A;
    A << at.along_r.squaredNorm(), at.along_r.dot(at.along_s), at.along_r.dot(at.along_s),
        at.along_s.squaredNorm();
    const Vec3 d = x - at.p;
    const double det = A.determinant();
    if (!(det > 1e-24 * A(0, 0) * A(1, 1))) break;
    const double gr = at.along_r.dot(d), gs = at.along_s.dot(d);
    double dr = (A(1, 1) * gr - A(0, 1) * gs) / det, ds = (A(0, 0) * gs - A(1, 0) * gr) / det;
    FacePoint next;
    for (int half = 0; half < 30; ++half) {
      double r = at.r + dr, s = at.s + ds;
      clamp_to(face, r, s);
      next = point_at(model, face, r, s, x);
      if (next.distance <= at.distance) break;
      dr /= 2.0;
      ds /= 2.0;
    }
    const double step = std::abs(next.r - at.r) + std::abs(next.s - at.s);
    if (!(next.distance <= at.distance)) break;
    at = next;
    if (step < 1e-14) break;
  }
  // Along an edge the clamped steps zigzag: the sides are treated separately.
  const auto side = [&](double r0, double s0, double r1, double s1) {
    double low = 0.0, high = 1.0;
    for (int k = 0; k < 90; ++k) {
      const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
      const auto distance = [&](double t) {
        return point_at(model, face, r0 + t * (r1 - r0), s0 + t * (s1 - s0), x).distance;
      };
      (distance(a) < distance(b) ? high : low) = distance(a) < distance(b) ? b : a;
    }
    const double t = (low + high) / 2.0;
    const FacePoint p = point_at(model, face, r0 + t * (r1 - r0), s0 + t * (s1 - s0), x);
    if (p.distance < at.distance) at = p;
  };
  const bool edge = face.corners == 3 ? at.r < 1e-9 || at.s < 1e-9 || at.r + at.s > 1.0 - 1e-9
                                      : std::max(std::abs(at.r), std::abs(at.s)) > 1.0 - 1e-9;
  if (edge && face.corners == 3) side(0, 0, 1, 0), side(1, 0, 0, 1), side(0, 1, 0, 0);
  if (edge && face.corners == 4)
    side(-1, -1, 1, -1), side(1, -1, 1, 1), side(1, 1, -1, 1), side(-1, 1, -1, -1);
  return at;
}

/// Faces by the cells of a grid that their centres are in; a cell is as large as the reach of a
/// face, so that all near faces are in the 27 cells around.
class FaceGrid {
 public:
  FaceGrid(const std::vector<Face>& faces, double distance) : faces_(faces) {
    for (const Face& f : faces) cell_ = std::max(cell_, f.radius + distance);
    for (std::size_t k = 0; k < faces.size(); ++k)
      cells_[key(faces[k].centre, 0, 0, 0)].push_back(static_cast<int>(k));
  }
  template <class Visit>
  void near(const Vec3& x, const Visit& visit) const {
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          if (const auto it = cells_.find(key(x, i, j, k)); it != cells_.end())
            for (const int f : it->second) visit(faces_[f]);
  }

 private:
  using Key = std::array<long, 3>;
  struct Hash {
    std::size_t operator()(const Key& k) const noexcept {
      std::size_t h = 0;
      for (const long x : k) h = h * 1000003u + std::hash<long>()(x);
      return h;
    }
  };
  Key key(const Vec3& x, int i, int j, int k) const {
    const auto cell = [&](double value, int more) {
      return static_cast<long>(std::floor(value / cell_)) + more;
    };
    return {cell(x.x(), i), cell(x.y(), j), cell(x.z(), k)};
  }
  const std::vector<Face>& faces_;
  double cell_ = 0.0;
  std::unordered_map<Key, std::vector<int>, Hash> cells_;
};

std::vector<Face> gather_faces(const FeModel& model, const std::vector<ElementFace>& list) {
  std::vector<Face> faces;
  faces.reserve(list.size());
  for (const ElementFace& item : list) {
    const FeElement& element = model.elements[item.element];
    const FaceNodes& local = element_faces(element.type)[item.face];
    Face f{local.count, local.corners};
    for (int i = 0; i < f.count; ++i) f.nodes[i] = element.nodes[local.nodes[i]];
    for (int i = 0; i < f.corners; ++i) f.centre += model.positions[f.nodes[i]] / f.corners;
    for (int i = 0; i < f.count; ++i)
      f.radius = std::max(f.radius, (model.positions[f.nodes[i]] - f.centre).norm());
    faces.push_back(f);
  }
  return faces;
}

/// u of the node by the formula in the header: an equation for each direction.
void add_equations(FeModel& model, int node, const Face& face, const FacePoint& at, bool rotations,
                   const FeSource& source) {
  const FaceShape f = shape_at(face, at.r, at.s);
  Vec3 normal = at.along_r.cross(at.along_s);
  const double area = normal.norm();
  const Vec3 gap = model.positions[node] - at.p;
  normal = area > 0.0 ? Vec3(normal / area) : Vec3::Zero();
  const double g = gap.dot(normal);
  // Gradients along the face: of coordinates (r, s) on the plane of the two tangents.
  Vec3 gr = Vec3::Zero(), gs = Vec3::Zero();
  if (area > 0.0) {
    gr = at.along_s.cross(normal) / area;
    gs = normal.cross(at.along_r) / area;
  }
  for (int axis = 0; axis < 3; ++axis) {
    LinearEquation equation;
    equation.source = source;
    equation.terms.push_back({node, axis, 1.0});
    for (int i = 0; i < face.count; ++i) {
      const Vec3 grad = f.r[i] * gr + f.s[i] * gs;
      for (int k = 0; k < 3; ++k) {
        // A node outside the face moves with the plane that continues it.
        const double factor =
            (axis == k ? f.N[i] + grad.dot(gap) : 0.0) - g * grad(axis) * normal(k);
        if (std::abs(factor) > 1e-14) equation.terms.push_back({face.nodes[i], k, -factor});
      }
    }
    model.equations.push_back(std::move(equation));
    if (!rotations) continue;
    LinearEquation turn{{{node, axis + 3, 1.0}}, source};
    for (int i = 0; i < face.count; ++i)
      if (std::abs(f.N[i]) > 1e-14) turn.terms.push_back({face.nodes[i], axis + 3, -f.N[i]});
    model.equations.push_back(std::move(turn));
  }
}

}  // namespace

TiedNodes add_surface_tie(FeModel& model, const SurfaceTie& tie, std::vector<char>& taken) {
  const std::vector<Face> faces = gather_faces(model, tie.faces);
  TiedNodes out;
  out.distance = tie.distance;
  if (faces.empty()) return out;
  if (!(out.distance > 0.0)) {
    double size = 0.0;
    for (const Face& f : faces) size += 2.0 * f.radius / std::sqrt(2.0);
    out.distance = tie.part_of_size * size / static_cast<double>(faces.size());
  }
  std::vector<char> of_faces(model.positions.size(), 0);
  for (const Face& f : faces)
    for (int i = 0; i < f.count; ++i) of_faces[f.nodes[i]] = 1;
  const FaceGrid grid(faces, out.distance);
  out.nearest_free = std::numeric_limits<double>::infinity();
  struct Found {
    int node;
    const Face* face;
    FacePoint at;
  };
  std::vector<Found> found;
  for (const int node : tie.nodes) {
    if (of_faces[node] != 0 || taken[node] != 0) continue;
    Found best{node, nullptr, {}};
    const Vec3& x = model.positions[node];
    grid.near(x, [&](const Face& face) {
      if ((x - face.centre).norm() > face.radius + std::min(out.distance, best.at.distance)) return;
      const FacePoint at = nearest_point(model, face, x);
      if (at.distance < best.at.distance) best.face = &face, best.at = at;
    });
    if (best.face != nullptr && best.at.distance <= out.distance) {
      found.push_back(best);
      taken[node] = 1;
    } else {
      out.free.push_back(node);
      out.nearest_free = std::min(out.nearest_free, best.at.distance);
    }
  }
  std::vector<char> turns(model.positions.size(), 0);  // nodes with rotations
  for (const FeElement& e : model.elements) {
    const ElementKernel& kernel = element_kernel(e.type);
    for (int i = 0; kernel.dofs_per_node == 6 && i < kernel.nodes; ++i) turns[e.nodes[i]] = 1;
  }
  for (const Found& f : found) {
    if (tie.adjust) {
      out.moved = std::max(out.moved, f.at.distance);
      model.positions[f.node] = f.at.p;
    }
    bool rotations = tie.rotations && turns[f.node] != 0;
    for (int i = 0; i < f.face->count; ++i) rotations = rotations && turns[f.face->nodes[i]] != 0;
    add_equations(model, f.node, *f.face, f.at, rotations, tie.source);
  }
  out.tied = static_cast<int>(found.size());
  return out;
}

}  // namespace floatframe
