#pragma once
// Common functions of the readers of geometry files: points and triangles, checked and counted.
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
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
  /// `line`: of a text file, else 0.
  template <class... Args>
  [[noreturn]] void stop(ErrorCode code, int line, fmt::format_string<Args...> text,
                         Args&&... args) const {
    throw InputError(code, SourceMark{name_, line, 0},
                     fmt::format(text, std::forward<Args>(args)...));
  }
  template <class... Args>
  [[noreturn]] void stop(ErrorCode code, fmt::format_string<Args...> text, Args&&... args) const {
    stop(code, 0, text, std::forward<Args>(args)...);
  }

  TriangleGeometry finish() const;

 private:
  std::string name_;
  std::vector<Vec3> points_;
  std::vector<std::array<int, 3>> triangles_;
};

/// JSON, or the binary container if the bytes begin with its signature.
void parse_gltf(std::string_view bytes, const GeometryLoader& loader, GeometryBuilder& out);

}  // namespace floatframe
