#include "floatframe/fe/model_checks.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/fe/dependent_dofs.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/springs.hpp"

namespace floatframe {
namespace {

constexpr int named = 5;

struct Edge {
  int a, b, middle;  ///< local nodes; -1: no middle node
};

std::vector<Edge> edges_of(FeElementType type) {
  std::vector<Edge> edges;
  for (const FaceNodes& f : element_faces(type)) {
    for (int i = 0; i < f.corners; ++i) {
      const int a = f.nodes[i], b = f.nodes[(i + 1) % f.corners];
      const int middle = f.count > f.corners ? f.nodes[i + f.corners] : -1;
      const bool known = std::any_of(edges.begin(), edges.end(), [&](const Edge& e) {
        return (e.a == a && e.b == b) || (e.a == b && e.b == a);
      });
      if (!known) edges.push_back({a, b, middle});
    }
  }
  return edges;
}

const std::vector<Edge>& edges(FeElementType type) {
  static const std::vector<std::vector<Edge>> all = [] {
    std::vector<std::vector<Edge>> made;
    for (const FeElementType t : fe_element_types) made.push_back(edges_of(t));
    return made;
  }();
  return all[index_of(type)];
}

Vec3 position_of(const FeModel& model, const FeElement& e, int local) {
  const int node = e.nodes[local];
  return model.positions[node];
}

/// Direction of the edge from corner a to b at a.
Vec3 tangent(const FeModel& model, const FeElement& e, int a, int b) {
  for (const Edge& edge : edges(e.type)) {
    if (!((edge.a == a && edge.b == b) || (edge.a == b && edge.b == a))) continue;
    if (edge.middle < 0) break;
    return 4.0 * position_of(model, e, edge.middle) - 3.0 * position_of(model, e, a) -
           position_of(model, e, b);
  }
  return position_of(model, e, b) - position_of(model, e, a);
}

/// "12 elements ...: worst element 4 (tet10) 0.03, ..."
void warn(const FeModel& model, std::vector<std::pair<double, int>> found, bool large_is_bad,
          const std::string& what, std::vector<std::string>& out) {
  if (found.empty()) return;
  std::sort(found.begin(), found.end());
  if (large_is_bad) std::reverse(found.begin(), found.end());
  std::string list;
  for (std::size_t i = 0; i < found.size() && i < named; ++i) {
    list += fmt::format("{}{}: {:.3g}", i == 0 ? "" : ", ", model.element_label(found[i].second),
                        found[i].first);
  }
  if (found.size() > named) list += fmt::format(" and {} more", found.size() - named);
  out.push_back(fmt::format("{} {} {}; worst: {}", found.size(),
                            found.size() == 1 ? "element has" : "elements have", what, list));
}

double integral(const FeModel& model, bool density) {
  double sum = 0.0;
  MatX scalar;
  for (const FeElement& e : model.elements) {
    ElementInput in = gather(model, e);
    if (!density) {
      in.material.density = 1.0;
      in.shell.mass = 0.0;
      for (LayupPly& ply : in.plies) ply.density = 1.0;
      if (in.layers) in.layers->mass = in.shell.thickness;
    }
    element_kernel(e.type).scalar_mass(in, scalar);
    sum += scalar.sum();
  }
  return sum;
}

void warn_duplicates(const FeModel& model, std::vector<std::string>& out) {
  std::vector<std::pair<std::array<int, 20>, int>> keys;
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    std::array<int, 20> key;
    key.fill(-1);
    const auto& nodes = model.elements[e].nodes;
    const int count = element_kernel(model.elements[e].type).nodes;
    std::copy_n(nodes.begin(), count, key.begin());
    std::sort(key.begin(), key.begin() + count);
    keys.emplace_back(key, static_cast<int>(e));
  }
  std::sort(keys.begin(), keys.end());
  int count = 0;
  std::string first;
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (keys[i].first != keys[i - 1].first) continue;
    if (count++ == 0) {
      first =
          model.element_label(keys[i - 1].second) + " and " + model.element_label(keys[i].second);
    }
  }
  if (count == 0) return;
  out.push_back(
      fmt::format("{} {} on the nodes of another one: mass and stiffness count twice "
                  "there; first: {}",
                  count, count == 1 ? "element lies" : "elements lie", first));
}

}  // namespace

double corner_quality(const FeModel& model, const FeElement& e) {
  const auto& [faces, corners, regular] = element_kernel(e.type).shape;
  double worst = 1.0;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    Mat3 t;
    for (int i = 0; i < 3; ++i) {
      t.col(i) = tangent(model, e, static_cast<int>(c), corners[c][i]);
    }
    const double lengths = t.colwise().norm().prod();
    worst = std::min(worst, lengths > 0.0 ? t.determinant() / (lengths * regular) : 0.0);
  }
  return worst;
}

double aspect_ratio(const FeModel& model, const FeElement& e) {
  double shortest = INFINITY, longest = 0.0;
  for (const Edge& edge : edges(e.type)) {
    const double length = (position_of(model, e, edge.a) - position_of(model, e, edge.b)).norm();
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  return longest > 0.0 ? longest / shortest : 1.0;
}

std::vector<std::string> shape_warnings(const FeModel& model) {
  std::vector<std::pair<double, int>> flat, slender;
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    const double quality = corner_quality(model, model.elements[i]);
    const double aspect = aspect_ratio(model, model.elements[i]);
    if (quality < 0.01) flat.emplace_back(quality, static_cast<int>(i));
    if (aspect > 20.0) slender.emplace_back(aspect, static_cast<int>(i));
  }
  std::vector<std::string> out;
  warn(model, std::move(flat), false,
       "a corner whose Jacobian is below 0.01 of that of the regular shape", out);
  warn(model, std::move(slender), true, "edges whose longest is more than 20 times the shortest",
       out);
  return out;
}

std::vector<int> unreferenced_nodes(const FeModel& model) {
  const DofTable table = dof_table(model);
  std::vector<char> used(model.positions.size(), 0);
  for (int k = 0; k < model.nodes(); ++k) used[k] = table.count(k) > 0;
  for (const Spider& s : model.spiders) {
    if (s.rotation_node >= 0) used[s.rotation_node] = 1;
  }
  std::vector<int> out;
  for (int k = 0; k < model.nodes(); ++k) {
    if (used[k] == 0) out.push_back(k);
  }
  return out;
}

std::vector<std::string> model_warnings(const FeModel& model) {
  std::vector<std::string> out = shape_warnings(model);
  std::vector<int> elements(model.materials.size(), 0);
  for (const FeElement& e : model.elements) ++elements[e.material];
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    if (elements[i] == 0 || model.materials[i].density > 0.0) continue;
    const bool has_name = i < model.material_names.size() && !model.material_names[i].empty();
    out.push_back(fmt::format("material {} has no density: {} {} without mass",
                              has_name ? "'" + model.material_names[i] + "'" : std::to_string(i),
                              elements[i], elements[i] == 1 ? "element is" : "elements are"));
  }
  warn_duplicates(model, out);
  const auto list = [&](const std::vector<int>& nodes) {
    std::string text;
    for (std::size_t i = 0; i < nodes.size() && i < named; ++i)
      text += (i == 0 ? "" : ", ") + model.node_label(nodes[i]);
    if (nodes.size() > named) text += fmt::format(" and {} more", nodes.size() - named);
    return text;
  };
  const std::vector<int> unused = unreferenced_nodes(model);
  if (!unused.empty())
    out.push_back(
        fmt::format("{} {} in no element, mass or constraint (as those that only orient "
                    "beams): {}",
                    unused.size(), unused.size() == 1 ? "node is" : "nodes are", list(unused)));
  const std::vector<int> hanging = nodes_on_springs(model);
  if (!hanging.empty())
    out.push_back(fmt::format(
        "{} {} on springs alone, without mass, and follow{}: a spring that ends there and nowhere "
        "else does nothing, unless its end is an interface: {}",
        hanging.size(), hanging.size() == 1 ? "node hangs" : "nodes hang",
        hanging.size() == 1 ? "s" : "", list(hanging)));
  return out;
}

double volume(const FeModel& model) { return integral(model, false); }

double volume_times_density(const FeModel& model) {
  double mass = integral(model, true);
  for (const PointMass& p : model.masses) mass += p.mass;
  return mass;
}

}  // namespace floatframe
