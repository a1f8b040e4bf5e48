// Finite-element models from arrays prepared by meshes.py.
#include <nanobind/stl/tuple.h>

#include <limits>

#include "views.hpp"

namespace floatframe::python {
namespace {

using Connectivity = nb::ndarray<const std::int64_t, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
/// Type, nodes, index of the material, index of the section, reference direction of beams.
using Block = std::tuple<std::string, Connectivity, int, int, Vector3>;

int node_index(std::int64_t k, std::size_t nodes, const std::string& where) {
  if (k < 0 || k >= static_cast<std::int64_t>(nodes))
    throw InputError(ErrorCode::out_of_range,
                     where + ": found the node " + std::to_string(k) + ", expected 0 to " +
                         std::to_string(static_cast<std::int64_t>(nodes) - 1));
  return static_cast<int>(k);
}

void add_block(FeModel& model, const Block& block) {
  const auto& [word, connectivity, material, section, reference] = block;
  FeElement element;
  bool known = false;
  for (const FeElementType type : fe_element_types)
    if (word == fe_element_name(type)) {
      element.type = type;
      known = true;
    }
  if (!known || connectivity.shape(1) > element.nodes.size())
    throw InputError(ErrorCode::not_found, "cells: unknown element type '" + word + "'");
  element.material = material;
  element.section = section;
  element.reference = vec3_of(reference);
  const std::int64_t* k = connectivity.data();
  for (std::size_t e = 0; e < connectivity.shape(0); ++e) {
    for (std::size_t i = 0; i < connectivity.shape(1); ++i, ++k)
      element.nodes[i] =
          node_index(*k, model.positions.size(), "cells: " + word + " number " + std::to_string(e));
    model.elements.push_back(element);
  }
}

std::shared_ptr<FeModel> make_mesh(const Points& points, const std::vector<Block>& blocks,
                                   const std::vector<std::pair<std::string, Indices>>& sets,
                                   const std::vector<std::array<double, 3>>& materials,
                                   const std::vector<double>& thicknesses,
                                   const std::vector<std::array<double, 4>>& sections) {
  if (points.shape(0) == 0 || points.shape(0) > std::numeric_limits<int>::max() / 6)
    throw InputError(ErrorCode::out_of_range,
                     "points: expected the shape (nodes, 3) with at least one node");
  auto model = std::make_shared<FeModel>();
  for (std::size_t k = 0; k < points.shape(0); ++k)
    model->positions.emplace_back(Eigen::Map<const Vec3>(points.data() + 3 * k));
  for (const auto& [young, poisson, density] : materials)
    model->materials.push_back({young, poisson, density});
  for (const double t : thicknesses) model->shells.push_back({t});
  for (const auto& [A, Iy, Iz, J] : sections) {
    BeamSection s;
    s.A = A, s.Iy = Iy, s.Iz = Iz, s.J = J;
    model->sections.push_back(s);
  }
  for (const Block& block : blocks) add_block(*model, block);
  for (const auto& [name, nodes] : sets) {
    std::vector<int>& set = model->node_sets[name];
    for (std::size_t k = 0; k < nodes.size(); ++k)
      set.push_back(node_index(nodes.data()[k], points.shape(0), "the node set '" + name + "'"));
  }
  return model;
}

}  // namespace

void bind_mesh(nb::module_& m) {
  nb::class_<FeModel>(m, "FeModel")
      .def_prop_ro("nodes", &FeModel::nodes)
      .def_prop_ro("elements", [](const FeModel& model) { return model.elements.size(); });
  m.def("make_mesh", make_mesh);
  m.def("element_words", [] {
    return std::vector<std::string>(std::begin(fe_element_words), std::end(fe_element_words));
  });
}

}  // namespace floatframe::python
