// Straight beams beside their nodes that meet at angles: each keeps the length between its nodes,
// so that their centroids overlap or gape. Abaqus reckons so too; CalculiX 2.20 lets the sections
// of neighbours meet half way, up to angles of 19 degrees, as the volumes that it prints show.
#include <fmt/format.h>

#include <cmath>

#include "floatframe/formats/abaqus/abaqus_build.hpp"

namespace floatframe {
namespace {

constexpr double largest_silent_difference = 0.01;  // of the length of a beam

struct OffsetBeam {
  int element = -1;            // in the model
  std::array<int, 2> nodes{};  // of the deck
  double missing = 0.0;        // of its length up to the lines of its neighbours
};

/// Beams of two nodes that are beside them, by section.
std::map<int, std::vector<OffsetBeam>> offset_beams(const AbaqusBuild& build) {
  std::map<int, std::vector<OffsetBeam>> out;
  const AbaqusContent& c = build.content;
  for (std::size_t k = 0; k < c.elements.size(); ++k) {
    const int index = build.element_index[k];
    if (index < 0) continue;
    const Element& e = build.model.elements[static_cast<std::size_t>(index)];
    if (e.type != ElementType::beam2) continue;
    OffsetBeam beam{index};
    bool beside = true;
    for (std::size_t i = 0; i < 2; ++i) {
      const int id = c.element_nodes[c.elements[k].first + i];
      beam.nodes[i] = c.node_of_label.at(AbaqusContent::label(c.elements[k].scope, id));
      beside = beside && beam.nodes[i] != e.nodes[i];
    }
    if (beside) out[e.section].push_back(beam);
  }
  return out;
}

/// From the end of one beam to that of its neighbour: half of the gap is missing at each.
void share_gap(const FeModel& model, OffsetBeam& beam, std::size_t end, const OffsetBeam& other,
               std::size_t other_end) {
  const auto at = [&](const OffsetBeam& b, std::size_t k) {
    return model.positions[model.elements[static_cast<std::size_t>(b.element)].nodes[k]];
  };
  const Vec3 outwards = (at(beam, end) - at(beam, 1 - end)).stableNormalized();
  beam.missing += 0.5 * (at(other, other_end) - at(beam, end)).dot(outwards);
}

void look_at_neighbours(const FeModel& model, std::vector<OffsetBeam>& beams) {
  std::map<int, std::vector<std::pair<std::size_t, std::size_t>>> ends;  // beam, end by node
  for (std::size_t k = 0; k < beams.size(); ++k)
    for (std::size_t i = 0; i < 2; ++i) ends[beams[k].nodes[i]].emplace_back(k, i);
  for (const auto& [node, list] : ends) {
    if (list.size() != 2) continue;
    const auto& [a, i] = list[0];
    const auto& [b, j] = list[1];
    share_gap(model, beams[a], i, beams[b], j);
    share_gap(model, beams[b], j, beams[a], i);
  }
}

}  // namespace

void note_abaqus_curved_offsets(AbaqusBuild& build) {
  for (auto& [section, beams] : offset_beams(build)) {
    look_at_neighbours(build.model, beams);
    long count = 0;
    double largest = 0.0;
    const Element* worst = nullptr;
    for (const OffsetBeam& beam : beams) {
      const Element& e = build.model.elements[static_cast<std::size_t>(beam.element)];
      const double length =
          (build.model.positions[e.nodes[1]] - build.model.positions[e.nodes[0]]).stableNorm();
      const double change = beam.missing / length;
      if (!(std::abs(change) > largest_silent_difference)) continue;
      ++count;
      if (std::abs(change) <= (1.0 + 1e-9) * std::abs(largest)) continue;
      largest = change;
      worst = &e;
    }
    if (count == 0) continue;
    build.note(
        worst->source,
        fmt::format("{} 2-node beam{} with an offset meet{} others at an angle and keep{} the "
                    "length between their nodes; the line of their centroids is up to {:.2g} "
                    "% {} (element {}), and in CalculiX, for angles up to 19 degrees, so is "
                    "their mass",
                    count, count == 1 ? "" : "s", count == 1 ? "s" : "", count == 1 ? "s" : "",
                    100.0 * std::abs(largest), largest > 0.0 ? "longer" : "shorter", worst->id));
  }
}

}  // namespace floatframe
