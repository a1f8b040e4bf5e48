#pragma once
// What the readers of geometry files share: points and triangles as they come, checked and counted.
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/formats/geometry/geometry_file.hpp"

namespace floatframe {

class GeometryBuilder {
 public:
  explicit GeometryBuilder(std::string name) : name_(std::move(name)) {}

  /// Index of the point. `line`: of a text file, else 0.
  int point(const Vec3& p, int line = 0);
  /// Indices of points that were given.
  void triangle(int a, int b, int c);
  std::size_t points() const noexcept { return points_.size(); }
  [[noreturn]] void stop(ErrorCode code, const std::string& sentence, int line = 0) const;

  TriangleGeometry finish() const;

 private:
  std::string name_;
  std::vector<Vec3> points_;
  std::vector<std::array<int, 3>> triangles_;
};

void parse_stl(std::string_view bytes, GeometryBuilder& out);
void parse_obj(std::string_view bytes, GeometryBuilder& out);
/// JSON, or the binary container if the bytes begin as one.
void parse_gltf(std::string_view bytes, const GeometryLoader& loader, GeometryBuilder& out);

}  // namespace floatframe
