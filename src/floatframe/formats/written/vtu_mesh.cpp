// A .vtu file of a finite-element model: elements as cells with their materials and sections,
// spiders as lines from their reference, point masses as vertices; node sets and element sets as
// arrays of 0 and 1.
#include <fmt/format.h>

#include "floatframe/core/plural.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/formats/vtk/vtk_file.hpp"
#include "floatframe/formats/written/mesh_writers.hpp"
#include "floatframe/formats/written/written_numbers.hpp"

namespace floatframe {
namespace {

/// Sets beyond this number are omitted: arrays of each cell would fill the memory.
constexpr std::size_t most_sets = 200;

/// Data of a cell.
struct Cells {
  std::vector<std::int32_t> element, kind, material;
  std::vector<double> young, density, thickness;

  void add(int number, int kind_of, int material_of, const Material& m, double t) {
    element.push_back(number);
    kind.push_back(kind_of);
    material.push_back(material_of);
    young.push_back(m.young);
    density.push_back(m.density);
    thickness.push_back(t);
  }
};

void add_cell(VtkGrid& grid, std::uint8_t type, std::span<const int> nodes) {
  grid.connectivity.insert(grid.connectivity.end(), nodes.begin(), nodes.end());
  grid.offsets.push_back(static_cast<std::int32_t>(grid.connectivity.size()));
  grid.types.push_back(type);
}

void add_element_cells(const FeModel& model, const WrittenNumbers& numbers, VtkGrid& grid,
                       Cells& cells) {
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const FeElement& element = model.elements[e];
    std::array<int, 20> nodes = element.nodes;
    // Nodes are in the order of VTK, but in the quadratic beam.
    if (element.type == FeElementType::beam3) std::swap(nodes[1], nodes[2]);
    const WrittenCell& cell = written_cell(element.type);
    add_cell(grid, cell.vtk, std::span(nodes).first(static_cast<std::size_t>(cell.nodes)));
    const auto m = static_cast<std::size_t>(element.material);
    const auto s = static_cast<std::size_t>(element.section);
    const bool known = element.material >= 0 && m < model.materials.size();
    const bool shell = has_shell_section(element.type) && s < model.shells.size();
    cells.add(numbers.element[e], static_cast<int>(element.type), known ? element.material : -1,
              known ? model.materials[m] : Material{}, shell ? model.shells[s].thickness : 0.0);
  }
}

/// Behind the elements: spiders as lines, point masses as vertices.
void add_other_cells(const FeModel& model, VtkGrid& grid, Cells& cells) {
  const int spider = static_cast<int>(std::size(fe_element_types)), mass = spider + 1;
  for (const Spider& s : model.spiders) {
    if (s.reference < 0) continue;
    for (const int node : s.nodes) {
      add_cell(grid, vtk_cell::line, std::array{s.reference, node});
      cells.add(0, spider, -1, {}, 0.0);
    }
  }
  for (const PointMass& m : model.masses) {
    add_cell(grid, vtk_cell::vertex, std::array{m.node});
    cells.add(0, mass, -1, {}, 0.0);
  }
}

VtkArray marks(const std::string& name, std::size_t size, const std::vector<int>& members) {
  std::vector<std::int32_t> values(size, 0);
  for (const int i : members) values[static_cast<std::size_t>(i)] = 1;
  return {name, 1, std::move(values)};
}

void add_set_arrays(const FeModel& model, VtkGrid& grid, std::vector<std::string>& notes) {
  std::set<std::string> used_by_points, used_by_cells;
  RenamedNames renamed;
  std::size_t left_out = 0;
  const auto add = [&](const auto& sets, std::size_t size, std::set<std::string>& used,
                       std::vector<VtkArray>& arrays) {
    std::size_t count = 0;
    for (const auto& [name, members] : sets) {
      if (++count > most_sets) {
        ++left_out;
        continue;
      }
      arrays.push_back(marks(written_name("set_" + name, false, used), size, members));
      renamed.add("set_" + name, arrays.back().name);
    }
  };
  add(model.node_sets, model.positions.size(), used_by_points, grid.point_data);
  add(model.element_sets, grid.types.size(), used_by_cells, grid.cell_data);
  renamed.note(notes);
  if (left_out > 0)
    notes.push_back(
        fmt::format("{} sets are left out: only the first {} of nodes and of elements are written",
                    left_out, most_sets));
  if (!model.surfaces.empty())
    notes.push_back(fmt::format(
        "{} not written", plural(static_cast<long>(model.surfaces.size()),
                                 "surface of element faces is", "surfaces of element faces are")));
}

}  // namespace

WrittenMesh vtu_mesh(const FeModel& model, const MeshWriteOptions&) {
  WrittenMesh out;
  const WrittenNumbers numbers = written_numbers(model, out.notes);
  VtkGrid grid;
  for (const Vec3& p : model.positions) grid.points.insert(grid.points.end(), {p(0), p(1), p(2)});
  Cells cells;
  add_element_cells(model, numbers, grid, cells);
  add_other_cells(model, grid, cells);
  grid.point_data.push_back(
      {"node_number", 1, std::vector<std::int32_t>(numbers.node.begin(), numbers.node.end())});
  grid.cell_data = {{"element_number", 1, std::move(cells.element)},
                    {"element_type", 1, std::move(cells.kind)},
                    {"material", 1, std::move(cells.material)},
                    {"young", 1, std::move(cells.young)},
                    {"density", 1, std::move(cells.density)},
                    {"thickness", 1, std::move(cells.thickness)}};
  add_set_arrays(model, grid, out.notes);
  if (!model.springs.empty())
    out.notes.push_back(fmt::format("{} springs left out", model.springs.size()));
  std::vector<std::string> types(std::begin(fe_element_words), std::end(fe_element_words)),
      materials;
  types.insert(types.end(), {"spider", "point_mass"});
  for (std::size_t m = 0; m < model.materials.size(); ++m)
    materials.push_back(written_material(model, static_cast<int>(m)));
  grid.texts = {{"element_type_names", std::move(types)}, {"material_names", std::move(materials)}};
  out.bytes = vtu_bytes(grid);
  return out;
}

}  // namespace floatframe
