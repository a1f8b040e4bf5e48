#include "floatframe/history/history_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "floatframe/body/alike.hpp"
#include "floatframe/body/body_shape.hpp"
#include "floatframe/body/modal_mass.hpp"
#include "floatframe/core/enum_index.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/model/model_hash.hpp"

namespace floatframe {
namespace {

/// Arrays for a file, row by row.
class ArrayList {
 public:
  explicit ArrayList(HistoryContent& content) : content_(content) {}

  /// `number(k)`: the k-th number of the array, with the last index running fastest.
  template <class Number, class Get>
  void add(const std::string& name, const char* type, std::vector<std::uint64_t> shape,
           Get number) {
    HistoryArray array{name, type, std::move(shape)};
    std::string bytes(array_bytes(array), '\0');
    for (std::size_t k = 0; k < bytes.size() / sizeof(Number); ++k) {
      const auto x = static_cast<Number>(number(static_cast<Eigen::Index>(k)));
      std::memcpy(bytes.data() + k * sizeof x, &x, sizeof x);
    }
    content_.header.arrays.push_back(std::move(array));
    content_.arrays.push_back(std::move(bytes));
  }

  template <class Rows>
  void add_indices(const std::string& name, const Rows& rows, std::size_t width) {
    add<std::uint32_t>(name, "u32", {rows.size(), width}, [&](Eigen::Index k) {
      const auto n = static_cast<std::size_t>(k);
      return rows[n / width][n % width];
    });
  }

 private:
  HistoryContent& content_;
};

void add_nodes(const FlexibleBody& body, const std::string& at, ArrayList& arrays) {
  const std::vector<ModalNode>& nodes = body.nodes;
  const Eigen::Index nm = body.modes();
  const auto count = static_cast<std::uint64_t>(nodes.size()),
             modes = static_cast<std::uint64_t>(nm);
  arrays.add<double>(at + "node_positions", "f64", {count, 3}, [&](Eigen::Index k) {
    return nodes[static_cast<std::size_t>(k / 3)].p[k % 3];
  });
  if (nm == 0) return;
  for (const bool turn : {false, true})
    arrays.add<double>(at + (turn ? "node_rotations" : "node_modes"), "f64", {count, 3, modes},
                       [&](Eigen::Index k) {
                         const ModalNode& n = nodes[static_cast<std::size_t>(k / (3 * nm))];
                         const Mat3X& X = turn ? n.X_theta : n.X;
                         return X(k / nm % 3, k % nm);
                       });
}

void add_shape(const BodyShape& shape, Eigen::Index nm, const std::string& at, ArrayList& arrays) {
  const auto points = static_cast<std::uint64_t>(shape.positions.cols());
  if (points > 0) {
    arrays.add<float>(at + "surface_positions", "f32", {points, 3},
                      [&](Eigen::Index k) { return shape.positions(k % 3, k / 3); });
    if (nm > 0 && shape.modes.size() > 0)
      arrays.add<float>(at + "surface_modes", "f32", {points, 3, static_cast<std::uint64_t>(nm)},
                        [&](Eigen::Index k) { return shape.modes(k / nm, k % nm); });
    arrays.add_indices(at + "surface_triangles", shape.triangles, 3);
    if (!shape.lines.empty()) arrays.add_indices(at + "surface_lines", shape.lines, 2);
    if (!shape.nodes.empty())
      arrays.add<std::uint32_t>(at + "surface_nodes", "u32", {points},
                                [&](Eigen::Index k) { return shape.nodes[k]; });
  }
  if (shape.bars.empty()) return;
  const std::vector<BodyShape::Bar>& bars = shape.bars;
  arrays.add<std::uint32_t>(at + "bars", "u32", {bars.size(), 2}, [&](Eigen::Index k) {
    const BodyShape::Bar& b = bars[static_cast<std::size_t>(k / 2)];
    return k % 2 == 0 ? b.from : b.to;
  });
  arrays.add<double>(at + "bar_sections", "f64", {bars.size(), 7}, [&](Eigen::Index k) {
    const BodyShape::Bar& b = bars[static_cast<std::size_t>(k / 7)];
    const double numbers[7] = {
        b.round ? 1.0 : 0.0, b.width, b.height, b.inner, b.y.x(), b.y.y(), b.y.z()};
    return numbers[k % 7];
  });
}

void add_bodies(const Model& model, const StateLayout& layout, HistoryContent& content) {
  HistoryHeader& h = content.header;
  ArrayList arrays(content);
  std::vector<const FlexibleBody*> known;  // one for each shape
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const FlexibleBody& data = *model.bodies[i].data;
    const StateLayout::BodyColumns& columns = layout.bodies[i];
    HistoryBody b;
    b.name = model.bodies[i].name;
    b.mass = data.invariants.m;
    b.modes = names_of_modes(data);
    for (const double f : own_frequencies(data))
      b.frequencies.push_back(std::isfinite(f) ? f : -1.0);
    b.pose = columns.pose;
    b.amplitudes = columns.amplitudes;
    b.rates = columns.rates;
    if (columns.pose >= 0 && (!data.nodes.empty() || (data.shape && !data.shape->empty()))) {
      const auto at = std::find_if(known.begin(), known.end(), [&](const FlexibleBody* other) {
        return look_alike(*other, data);
      });
      b.shape = static_cast<int>(at - known.begin());
      if (at == known.end()) {
        known.push_back(&data);
        const std::string name = fmt::format("shapes/{}/", b.shape);
        HistoryShape shape;
        for (const ModalNode& n : data.nodes) shape.nodes.push_back(n.name);
        if (data.shape) shape.color = data.shape->color;
        h.shapes.push_back(std::move(shape));
        add_nodes(data, name, arrays);
        if (data.shape) add_shape(*data.shape, data.modes(), name, arrays);
      }
    }
    h.bodies.push_back(std::move(b));
  }
}

}  // namespace

std::vector<std::string> names_of_modes(const FlexibleBody& body) {
  std::vector<std::string> out = body.mode_names;
  for (int k = static_cast<int>(out.size()); k < body.modes(); ++k)
    out.push_back(fmt::format("mode {}", k + 1));
  return out;
}

std::vector<double> own_frequencies(const FlexibleBody& body) {
  const MatX M = modal_mass(body.invariants);
  std::vector<double> out;
  for (Eigen::Index k = 0; k < M.rows(); ++k)
    out.push_back(std::sqrt(body.K(k, k) / M(k, k)) / (2.0 * std::numbers::pi));
  return out;
}

HistoryContent history_content(const Model& model, const SimulationDescription& options,
                               const StateLayout& layout, HistoryOrigin origin) {
  HistoryContent content;
  HistoryHeader& h = content.header;
  h.origin = std::move(origin);
  h.model = model.name;
  h.model_hash = model_hash(model);
  h.coordinates = rules::coordinates[index_of(options.coordinates)];
  h.inertia = rules::inertia_methods[index_of(options.inertia)];
  h.step = options.step;
  h.duration = options.duration;
  h.output_interval = options.output_interval;
  h.columns = static_cast<std::size_t>(layout.columns);
  for (const StateLayout::Group& g : layout.groups)
    h.groups.push_back(
        {g.name, static_cast<std::size_t>(g.first), static_cast<std::size_t>(g.count)});
  h.configurations = layout.configurations;
  h.velocities = layout.velocities;
  h.q = layout.q;
  h.v = layout.v;
  h.owners = layout.owners;
  for (const HealthColumn& c : layout.health)
    h.health.push_back({c.name, c.unit, c.group, c.body, c.size});
  add_bodies(model, layout, content);
  return content;
}

}  // namespace floatframe
