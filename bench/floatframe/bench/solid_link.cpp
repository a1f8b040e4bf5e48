#include "floatframe/bench/solid_link.hpp"

namespace floatframe {

FeModel solid_link(int across, int along) {
  constexpr double length = 1.0, side = 0.02;  // [m]
  FeModel model;
  model.materials = {{2.0e11, 0.3, 7500.0}, {2.0e13, 0.3, 0.0}};  // steel, the star
  // As thin as the bricks: short thick rays would be stiffer than the digits of the bricks allow.
  model.sections = {BeamSection::solid_round(side / across)};
  const int n = across + 1;
  const auto node = [n](int i, int j, int k) { return (i * n + j) * n + k; };
  for (int i = 0; i <= along; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k)
        model.positions.emplace_back(length * i / along,
                                     side * (static_cast<double>(j) / across - 0.5),
                                     side * (static_cast<double>(k) / across - 0.5));
    }
  }
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < across; ++j) {
      for (int k = 0; k < across; ++k) {
        FeElement brick;
        brick.type = FeElementType::hex8;
        brick.nodes = {node(i, j, k),
                       node(i + 1, j, k),
                       node(i + 1, j + 1, k),
                       node(i, j + 1, k),
                       node(i, j, k + 1),
                       node(i + 1, j, k + 1),
                       node(i + 1, j + 1, k + 1),
                       node(i, j + 1, k + 1)};
        model.elements.push_back(brick);
      }
    }
  }
  model.node_names.resize(model.positions.size());
  for (const int face : {0, along}) {
    const int centre = model.nodes();
    model.positions.emplace_back(length * face / along, 0.0, 0.0);
    model.node_names.emplace_back(face == 0 ? "start" : "end");
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        FeElement ray;
        ray.type = FeElementType::beam2;
        ray.nodes = {centre, node(face, j, k)};
        ray.material = 1;
        ray.reference = Vec3::UnitX();
        model.elements.push_back(ray);
      }
    }
  }
  return model;
}

}  // namespace floatframe
