#include "floatframe/body/solid_shapes.hpp"

#include <cmath>
#include <numbers>

namespace floatframe {
namespace {

constexpr int corners_around = 32;   // of a circle
constexpr int rings_of_quarter = 8;  // of a sphere, from its pole to its equator
constexpr double pi = std::numbers::pi;

/// A point of the line that is turned about z: distance from z, height.
struct ProfilePoint {
  double r = 0.0, z = 0.0;
};
using Profile = std::vector<ProfilePoint>;

struct SolidMesh {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;

  int add(const Vec3& p) {
    points.push_back(p);
    return int(points.size()) - 1;
  }
};

/// From the lower pole to the upper one; a point on the axis is one vertex.
SolidMesh revolved(const Profile& profile) {
  SolidMesh out;
  struct Ring {
    int first = 0;
    bool pole = false;
    int at(int k) const { return pole ? first : first + k % corners_around; }
  };
  std::vector<Ring> rings;
  for (const auto& [r, z] : profile) {
    Ring ring{int(out.points.size()), r == 0.0};
    for (int k = 0; k < (ring.pole ? 1 : corners_around); ++k) {
      const double angle = 2.0 * pi * k / corners_around;
      out.add({r * std::cos(angle), r * std::sin(angle), z});
    }
    rings.push_back(ring);
  }
  for (std::size_t i = 1; i < rings.size(); ++i) {
    const Ring &low = rings[i - 1], &high = rings[i];
    for (int k = 0; k < corners_around; ++k) {
      if (!low.pole) out.triangles.push_back({low.at(k), low.at(k + 1), high.at(k + 1)});
      if (!high.pole) out.triangles.push_back({low.at(k), high.at(k + 1), high.at(k)});
    }
  }
  return out;
}

/// Half circles about z = -half and z = half.
Profile rounded_profile(double radius, double half) {
  Profile out{{0.0, -half - radius}};
  for (int side = -1; side <= 1; side += 2) {
    for (int k = 0; k <= rings_of_quarter; ++k) {
      const int step = side < 0 ? k : rings_of_quarter - k;
      const double angle = 0.5 * pi * step / rings_of_quarter;
      const bool pole = step == 0, twice = side > 0 && k == 0 && half == 0.0;
      if (!pole && !twice)
        out.push_back({radius * std::sin(angle), side * (half + radius * std::cos(angle))});
    }
  }
  out.push_back({0.0, half + radius});
  return out;
}

SolidMesh mesh_of(const BoxSolid& box) {
  SolidMesh out;
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner((k & 1) != 0 ? 0.5 : -0.5, (k & 2) != 0 ? 0.5 : -0.5,
                      (k & 4) != 0 ? 0.5 : -0.5);
    out.add(corner.cwiseProduct(box.size));
  }
  constexpr int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    out.triangles.push_back({f[0], f[1], f[2]});
    out.triangles.push_back({f[0], f[2], f[3]});
  }
  return out;
}
SolidMesh mesh_of(const ConeSolid& cone) {
  const double half = 0.5 * cone.length;
  Profile profile{{0.0, -half}, {cone.radius, -half}, {cone.top, half}};
  if (cone.top > 0.0) profile.push_back({0.0, half});
  return revolved(profile);
}
SolidMesh mesh_of(const CylinderSolid& cylinder) {
  return mesh_of(ConeSolid{cylinder.radius, cylinder.length, cylinder.radius});
}
SolidMesh mesh_of(const SphereSolid& sphere) {
  return revolved(rounded_profile(sphere.radius, 0.0));
}
SolidMesh mesh_of(const CapsuleSolid& capsule) {
  return revolved(rounded_profile(capsule.radius, 0.5 * capsule.length));
}

}  // namespace

void add_triangles(const Mat3X& positions, const std::vector<std::array<int, 3>>& triangles,
                   const std::string& color, BodyShape& shape) {
  const int first = int(shape.triangles.size()), moved = int(shape.positions.cols());
  if (first == 0) {
    shape.color = color;
  } else if (color != (shape.paints.empty() ? shape.color : shape.paints.back().color)) {
    if (shape.paints.empty()) shape.paints.push_back({0, shape.color});
    shape.paints.push_back({first, color});
  }
  shape.positions.conservativeResize(3, moved + positions.cols());
  shape.positions.rightCols(positions.cols()) = positions;
  for (const auto& [a, b, c] : triangles)
    shape.triangles.push_back({a + moved, b + moved, c + moved});
}

void add_solid(const PlacedSolid& placed, BodyShape& shape) {
  const SolidMesh mesh = std::visit([](const auto& solid) { return mesh_of(solid); }, placed.solid);
  Mat3X positions(3, std::ssize(mesh.points));
  Eigen::Index column = 0;
  for (const Vec3& p : mesh.points) positions.col(column++) = placed.X_BS * p;
  add_triangles(positions, mesh.triangles, placed.color, shape);
}

std::shared_ptr<const BodyShape> shape_of_solids(const std::vector<PlacedSolid>& solids) {
  auto out = std::make_shared<BodyShape>();
  for (const PlacedSolid& solid : solids) add_solid(solid, *out);
  return out;
}

}  // namespace floatframe
