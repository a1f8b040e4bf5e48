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

/// Nodes and elements of bars, in the order of the bars; all errors are collected.
class FrameBuilder {
 public:
  explicit FrameBuilder(const BarFrame& frame) : frame_(frame) {
    model_.materials.push_back(frame.material);
    for (const auto& [name, p] : frame.points) {
      if (!points_.emplace(name, p).second)
        add(ErrorCode::duplicate, "point '" + name + "' is given twice");
    }
  }

  FeModel build() {
    for (const Bar& bar : frame_.bars) this->bar(bar);
    for (const auto& [name, mass] : frame_.masses) point_mass(name, mass);
    if (frame_.bars.empty()) add(ErrorCode::missing, "the frame has no bars");
    errors_.throw_if_any();
    validate(model_);
    return std::move(model_);
  }

 private:
  void add(ErrorCode code, const std::string& text) { errors_.add(code, {}, text); }

  int new_node(const Vec3& p, const std::string& name) {
    model_.positions.push_back(p);
    model_.node_names.push_back(name);
    return model_.nodes() - 1;
  }

  /// The node at a point, created when a bar first ends there.
  int end_node(const Bar& bar, const std::string& name) {
    const auto known = node_of_point_.find(name);
    if (known != node_of_point_.end()) return known->second;
    const auto p = points_.find(name);
    if (p == points_.end()) {
      add(ErrorCode::not_found, "bar '" + bar.name + "': there is no point '" + name + "'");
      return -1;
    }
    const int node = new_node(p->second, name);
    node_of_point_.emplace(name, node);
    return node;
  }

  /// The start node of a bar; -1 after an error.
  int first_node(const Bar& bar, const std::string& label) {
    if (bar.from_bar.empty()) return end_node(bar, bar.from);
    const auto other = nodes_of_bar_.find(bar.from_bar);
    if (other == nodes_of_bar_.end()) {
      add(ErrorCode::not_found,
          label + " starts at bar '" + bar.from_bar + "', which is not an earlier bar");
      return -1;
    }
    const int elements = static_cast<int>(other->second.size()) - 1;
    if (elements <= 0) return -1;  // this bar has its own error
    const int k = node_at(bar.from_fraction, elements);
    if (k >= 0) return other->second[k];
    add(ErrorCode::not_found,
        label + ": bar '" + bar.from_bar + "' with " + std::to_string(elements) +
            " elements has no node at the fraction " + number(bar.from_fraction) +
            "; the nearest are at " + nearest_fractions(bar.from_fraction, elements));
    return -1;
  }

  void bar(const Bar& bar) {
    const std::string label = "bar '" + bar.name + "'";
    if (nodes_of_bar_.count(bar.name) != 0) add(ErrorCode::duplicate, label + " is given twice");
    const int first = first_node(bar, label);
    std::vector<int>& nodes = nodes_of_bar_[bar.name];
    if (bar.elements < 1)
      return add(ErrorCode::out_of_range, label +
                                              ": the number of elements must be at least 1, not " +
                                              std::to_string(bar.elements));
    // The end node exists already if an earlier bar ends there; a new one comes after the inner
    // nodes.
    const auto end = points_.find(bar.to);
    if (end == points_.end())
      return add(ErrorCode::not_found, label + ": there is no point '" + bar.to + "'");
    if (first < 0) return;
    const Vec3 a = model_.positions[first], b = end->second;
    if (!((b - a).norm() > 1e-12 * (a.norm() + b.norm())))
      return add(ErrorCode::geometry, label + " has zero length");
    const int section = static_cast<int>(model_.sections.size());
    model_.sections.push_back(bar.section);
    nodes.push_back(first);
    for (int k = 1; k <= bar.elements; ++k) {
      const double s = static_cast<double>(k) / bar.elements;
      nodes.push_back(k == bar.elements ? end_node(bar, bar.to) : new_node(a + s * (b - a), ""));
      FeElement element;
      element.type = FeElementType::beam2;
      element.nodes[0] = nodes[k - 1];
      element.nodes[1] = nodes[k];
      element.section = section;
      element.reference = bar.reference;
      element.name = label + ", element " + std::to_string(k);
      model_.elements.push_back(element);
    }
  }

  void point_mass(const std::string& name, double mass) {
    PointMass p;
    p.node = model_.find_node(name);
    p.mass = mass;
    if (p.node < 0) return add(ErrorCode::not_found, "point mass: there is no node '" + name + "'");
    model_.masses.push_back(p);
  }

  const BarFrame& frame_;
  ErrorList errors_;
  FeModel model_;
  std::map<std::string, Vec3> points_;
  std::map<std::string, int> node_of_point_;
  std::map<std::string, std::vector<int>> nodes_of_bar_;
};

}  // namespace

FeModel build_bar_frame(const BarFrame& frame) { return FrameBuilder(frame).build(); }

}  // namespace floatframe
