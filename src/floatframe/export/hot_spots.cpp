#include "floatframe/export/hot_spots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/model/gauge.hpp"

namespace floatframe {
namespace {

/// A node with the largest stress of its places, and its neighbours.
struct HotNode {
  int place = -1;
  bool doubtful = false;
  std::set<int> next;  ///< nodes
};

std::map<int, HotNode> worst_places(const BodyStress& stress, const VecX& von_mises) {
  std::map<int, HotNode> nodes;
  for (int k = 0; k < static_cast<int>(stress.places.size()); ++k) {
    const StressPlace& place = stress.places[static_cast<std::size_t>(k)];
    HotNode& node = nodes[place.node];
    if (node.place < 0 || von_mises(k) > von_mises(node.place)) node.place = k;
    node.doubtful = node.doubtful || place.doubtful;
  }
  return nodes;
}

void join(std::map<int, HotNode>& nodes, int a, int b) {
  const auto first = nodes.find(a), second = nodes.find(b);
  if (a == b || first == nodes.end() || second == nodes.end()) return;
  first->second.next.insert(b);
  second->second.next.insert(a);
}

void find_neighbours(const FlexibleBody& body, std::map<int, HotNode>& nodes) {
  const BodyStress& stress = *body.stress;
  std::map<int, int> node_of_point;
  for (const StressPlace& place : stress.places)
    if (place.point >= 0) node_of_point[place.point] = place.node;
  const auto node_at = [&](int point) {
    const auto it = node_of_point.find(point);
    return it == node_of_point.end() ? -1 : it->second;
  };
  if (body.shape)
    for (const std::array<int, 3>& t : body.shape->triangles)
      for (const auto& [a, b] : {std::pair(t[0], t[1]), {t[1], t[2]}, {t[2], t[0]}})
        join(nodes, node_at(a), node_at(b));
  for (std::size_t s = 1; s < stress.sections.size(); ++s)
    if (stress.sections[s].element == stress.sections[s - 1].element)
      join(nodes, stress.sections[s - 1].node, stress.sections[s].node);
}

}  // namespace

std::vector<HotSpot> hot_spots(const FlexibleBody& body, const StressEnvelope& envelope, int top) {
  const VecX& vm = envelope.von_mises;
  std::map<int, HotNode> nodes = worst_places(*body.stress, vm);
  find_neighbours(body, nodes);
  // Of equal values, the first one.
  const auto hotter = [&](int a, int b) { return vm(a) > vm(b) || (vm(a) == vm(b) && a < b); };
  std::vector<int> peaks;
  for (const auto& [index, node] : nodes) {
    const bool hidden = std::any_of(node.next.begin(), node.next.end(), [&](int other) {
      const HotNode& neighbour = nodes.at(other);
      return (node.doubtful || !neighbour.doubtful) && hotter(neighbour.place, node.place);
    });
    if (!hidden && vm(node.place) > 0.0) peaks.push_back(node.place);
  }
  std::sort(peaks.begin(), peaks.end(), hotter);
  std::vector<HotSpot> out;
  int trusted = 0, doubtful = 0;
  for (const int k : peaks) {
    if (trusted == top) break;
    const bool doubt = nodes.at(body.stress->places[static_cast<std::size_t>(k)].node).doubtful;
    if (++(doubt ? doubtful : trusted) > top) continue;
    out.push_back({k, doubt, vm(k), envelope.time(k), principal_stresses(envelope.stress.col(k))});
  }
  return out;
}

std::vector<SectionPeak> section_peaks(const BodyStress& stress, const StressEnvelope& envelope) {
  std::vector<SectionPeak> out;
  if (stress.sections.empty()) return out;
  for (int c = 0; c < 6; ++c) {
    SectionPeak peak{c, 0, envelope.largest(c, 0), envelope.largest_time(c, 0)};
    for (int s = 0; s < static_cast<int>(stress.sections.size()); ++s) {
      if (std::abs(envelope.largest(c, s)) > std::abs(peak.value))
        peak = {c, s, envelope.largest(c, s), envelope.largest_time(c, s)};
      if (std::abs(envelope.least(c, s)) > std::abs(peak.value))
        peak = {c, s, envelope.least(c, s), envelope.least_time(c, s)};
    }
    out.push_back(peak);
  }
  return out;
}

const char* section_force_name(int component) noexcept {
  constexpr const char* names[] = {"N", "Vy", "Vz", "T", "My", "Mz"};
  return names[component];
}

const char* section_force_unit(int component) noexcept { return component < 3 ? "N" : "Nm"; }

const char* layer_name(StressPlace::Layer layer) noexcept {
  constexpr const char* words[] = {"solid", "top", "bottom", "section"};
  return words[static_cast<std::size_t>(layer)];
}

std::string stress_node_text(const FlexibleBody& body, int node, int number) {
  if (number > 0) return fmt::format("{}", number);
  const auto at = static_cast<std::size_t>(node);
  if (at < body.nodes.size() && !body.nodes[at].name.empty()) return body.nodes[at].name;
  return fmt::format("#{}", node);
}

}  // namespace floatframe
