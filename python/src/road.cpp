// Roads: heights above places, of a model or of an OpenCRG file.
#include <algorithm>

#include "bindings.hpp"

namespace floatframe::python {
namespace {

using Places = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

CrgBorder border_of(const char* name, const std::string& word) {
  return word_of<CrgBorder>(name, word,
                            {{"none", CrgBorder::none},
                             {"zero", CrgBorder::zero},
                             {"keep", CrgBorder::keep},
                             {"repeat", CrgBorder::repeat},
                             {"reflect", CrgBorder::reflect}});
}

Road read_road(const std::string& file, const std::string& interpolation,
               const std::optional<std::string>& border_u,
               const std::optional<std::string>& border_v, const std::string& begin) {
  const auto kind = word_of<CrgInterpolation>(
      "interpolation", interpolation,
      {{"linear", CrgInterpolation::linear}, {"cubic", CrgInterpolation::cubic}});
  const bool moved = word_of<bool>("begin", begin, {{"file", false}, {"origin", true}});
  std::optional<CrgBorder> u, v;
  if (border_u) u = border_of("border_u", *border_u);
  if (border_v) v = border_of("border_v", *border_v);
  Unlocked released;
  auto crg = std::make_shared<CrgRoad>(read_crg(std::filesystem::path(file)));
  crg->interpolation = kind;
  if (u) crg->edge_u.mode = *u;
  if (v) crg->edge_v.mode = *v;
  if (moved) begin_at_origin(*crg);
  RoadSurface surface;
  surface.crg = std::move(crg);
  Road road;
  road.name = file;
  road.surface = std::make_shared<const RoadSurface>(std::move(surface));
  return road;
}

Road road_of(const Model& model, const std::string& name) {
  const auto it = std::ranges::find(model.roads, name, &Road::name);
  if (it != model.roads.end()) return *it;
  std::string names;
  for (const Road& road : model.roads) names += (names.empty() ? "'" : ", '") + road.name + "'";
  throw UnknownName(ErrorCode::not_found,
                    "found no road '" + name + "', expected one of " +
                        (names.empty() ? std::string("none: the model has no roads") : names));
}

/// A row for each place: height, slopes along x and y, friction.
RealArray surface_points(const Road& road, const Places& x, const Places& y) {
  MatX out(std::ssize(x), 4);
  {
    Unlocked released;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const SurfacePoint p = surface_at(road, x.data()[k], y.data()[k]);
      out.row(k) << p.z, p.zx, p.zy, p.friction;
    }
  }
  return array_of(out);
}

std::vector<std::string> notes_of(const Road& road) {
  return road.surface && road.surface->crg ? road.surface->crg->notes : std::vector<std::string>();
}

}  // namespace

void bind_road(nb::module_& m) {
  nb::class_<Road>(m, "Road", "Heights over x and y.")
      .def_ro("name", &Road::name)
      .def_prop_ro("notes", notes_of)
      .def("points", surface_points);
  m.def("read_road", read_road, nb::arg("file"), nb::arg("interpolation"),
        nb::arg("border_u").none(), nb::arg("border_v").none(), nb::arg("begin"));
  m.def("road_of", road_of);
}

}  // namespace floatframe::python
