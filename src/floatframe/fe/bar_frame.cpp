#include "floatframe/fe/bar_frame.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {
namespace {

std::string number(double x) {
  std::ostringstream s;
  s << x;
  return s.str();
}

/// Index of the node at a fraction of a bar with `elements` elements, -1 if there is none.
int node_at(double fraction, int elements) {
  const double k = fraction * elements;
  const double nearest = std::round(k);
  if (!(std::abs(k - nearest) < 1e-6) || nearest < 0.0 || nearest > elements) return -1;
  return static_cast<int>(nearest);
}

std::string nearest_fractions(double fraction, int elements) {
  if (!(fraction >= 0.0)) return number(0.0);
  if (fraction > 1.0) return number(1.0);
  const double k = std::floor(fraction * elements);
  return number(k / elements) + " and " + number((k + 1.0) / elements);
}

}  // namespace

FeModel build_bar_frame(const BarFrame& frame) {
  Faults faults;
  const auto add = [&](const std::string& text) { faults.add({}, text); };
  FeModel model;
  model.materials.push_back(frame.material);

  std::map<std::string, Vec3> points;
  for (const auto& [name, p] : frame.points) {
    if (!points.emplace(name, p).second) add("point '" + name + "' is given twice");
  }
  std::map<std::string, int> node_of_point;
  std::map<std::string, std::vector<int>> nodes_of_bar;

  const auto new_node = [&](const Vec3& p, const std::string& name) {
    model.positions.push_back(p);
    model.node_names.push_back(name);
    return model.nodes() - 1;
  };
  const auto end_node = [&](const Bar& bar, const std::string& name) {
    const auto known = node_of_point.find(name);
    if (known != node_of_point.end()) return known->second;
    const auto p = points.find(name);
    if (p == points.end()) {
      add("bar '" + bar.name + "': there is no point '" + name + "'");
      return -1;
    }
    const int node = new_node(p->second, name);
    node_of_point.emplace(name, node);
    return node;
  };

  for (const Bar& bar : frame.bars) {
    const std::string label = "bar '" + bar.name + "'";
    if (nodes_of_bar.count(bar.name) != 0) add(label + " is given twice");
    int first = -1;
    if (bar.from_bar.empty()) {
      first = end_node(bar, bar.from);
    } else {
      const auto other = nodes_of_bar.find(bar.from_bar);
      if (other == nodes_of_bar.end()) {
        add(label + " starts at bar '" + bar.from_bar + "', which is not an earlier bar");
      } else {
        const int elements = static_cast<int>(other->second.size()) - 1;
        const int k = elements > 0 ? node_at(bar.from_fraction, elements) : -1;
        if (k >= 0) {
          first = other->second[k];
        } else if (elements > 0) {
          add(label + ": bar '" + bar.from_bar + "' with " + std::to_string(elements) +
              " elements has no node at the fraction " + number(bar.from_fraction) +
              "; the nearest are at " + nearest_fractions(bar.from_fraction, elements));
        }
      }
    }
    std::vector<int>& nodes = nodes_of_bar[bar.name];
    if (bar.elements < 1) {
      add(label + ": the number of elements must be at least 1, not " +
          std::to_string(bar.elements));
      continue;
    }
    // The end node exists already if an earlier bar ends there; a new one comes after the inner
    // nodes.
    const auto end = points.find(bar.to);
    if (end == points.end()) {
      add(label + ": there is no point '" + bar.to + "'");
      continue;
    }
    if (first < 0) continue;
    const Vec3 a = model.positions[first];
    const Vec3 b = end->second;
    if (!((b - a).norm() > 1e-12 * (a.norm() + b.norm()))) {
      add(label + " has zero length");
      continue;
    }
    const int section = static_cast<int>(model.sections.size());
    model.sections.push_back(bar.section);
    nodes.push_back(first);
    for (int k = 1; k <= bar.elements; ++k) {
      const double s = static_cast<double>(k) / bar.elements;
      nodes.push_back(k == bar.elements ? end_node(bar, bar.to) : new_node(a + s * (b - a), ""));
      Element element;
      element.type = ElementType::beam2;
      element.nodes[0] = nodes[k - 1];
      element.nodes[1] = nodes[k];
      element.section = section;
      element.reference = bar.reference;
      element.name = label + ", element " + std::to_string(k);
      model.elements.push_back(element);
    }
  }
  for (const auto& [name, mass] : frame.masses) {
    const int node = model.find_node(name);
    if (node < 0) {
      add("point mass: there is no node '" + name + "'");
      continue;
    }
    PointMass p;
    p.node = node;
    p.mass = mass;
    model.masses.push_back(p);
  }
  if (frame.bars.empty()) add("the frame has no bars");
  faults.throw_if_any();
  validate(model);
  return model;
}

}  // namespace floatframe
