// The key `geometry` of a body: a surface drawn by another program. It has no effect on the motion.
#include <fmt/format.h>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/formats/geometry/geometry_file.hpp"
#include "floatframe/model_file/read_parts.hpp"
#include "floatframe/parts/part_job.hpp"

namespace floatframe {
namespace {

constexpr double farthest_geometry = 1e6;  // [m]; pages have single precision

std::string read_color(const YamlValue& value) {
  const auto text = value.text("a colour \"#rrggbb\"");
  if (!text) return {};
  const bool good = text->size() == 7 && text->front() == '#' &&
                    text->find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (good) return *text;
  value.unexpected("a colour \"#rrggbb\" (in quotes), as in \"#3a6ea5\"");
  return {};
}

}  // namespace

std::shared_ptr<const BodyShape> read_body_geometry(const ModelInstance& self,
                                                    const YamlValue& value) {
  auto s = value.section("a map with file, scale, position, orientation, color");
  if (!s) return nullptr;
  const auto file = s->require("file");
  const double scale = s->number("scale", positive_number(""), 1.0);
  Pose X_BG;
  s->vector("position", "m", X_BG.p);
  if (const auto v = s->get("orientation")) X_BG.R = read_orientation(*v);
  auto shape = std::make_shared<BodyShape>();
  if (const auto v = s->get("color")) shape->color = read_color(*v);
  s->finish();
  const auto name =
      file ? file->text("the name of a file (.stl, .obj, .gltf, .glb)") : std::nullopt;
  if (!name) return nullptr;
  try {
    const std::string path = sibling_path(self, *name);
    TriangleGeometry geometry = read_geometry(path);
    note_file_read(path, file_hash(path));
    for (const auto& other : geometry.others) note_file_read(other.string(), file_hash(other));
    shape->positions = (scale * X_BG.R * geometry.positions).colwise() + X_BG.p;
    shape->triangles = std::move(geometry.triangles);
  } catch (const InputError& error) {
    add_errors(*file, error);
    return nullptr;
  }
  const double reach = shape->positions.colwise().norm().maxCoeff();
  if (!(reach <= farthest_geometry)) {
    file->error(ErrorCode::out_of_range,
                fmt::format("found a point {:.3g} m from the origin of the body, expected at most "
                            "{:.0e} m (does 'scale' fit the units of the file?)",
                            reach, farthest_geometry));
    return nullptr;
  }
  return shape;
}

}  // namespace floatframe
